// The lists of reasons: what they say is what is written and documented.

#include "catch.hpp"
#include "environment.hpp"

#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/results/response.hpp>

#include <algorithm>
#include <fstream>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

using namespace arcslip;

namespace {

std::string reason_rows(std::span<const results::Reason> all) {
  std::string text;
  for (const results::Reason& each : all)
    text.append("| `").append(each.code).append("` | ").append(each.help) += " |\n";
  return text;
}

void check_words(const results::Reason& reason) {
  CAPTURE(reason);
  CHECK_FALSE(reason.code.empty());
  CHECK(reason.code.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string_view::npos);
  CHECK_FALSE(reason.help.empty());
  CHECK(reason.help.find_first_of("|\n") == std::string_view::npos);
}

const std::span<const results::Reason> lists[] = {
    observables::reasons::of_branches,    observables::reasons::of_motions,
    observables::reasons::of_responses,   observables::reasons::of_sweeps,
    observables::reasons::of_comparisons, optimize::reasons::of_optima,
    optimize::reasons::of_optimum_curves};

}  // namespace

TEST_CASE("the documentation of results has the rows of the lists of reasons") {
  std::ifstream file(source_folder() + "/docs/results.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const auto& list : lists) {
    INFO("the table is to be:\n" << reason_rows(list));
    CHECK(text.str().find("|---|---|\n" + reason_rows(list) + "\n") != std::string::npos);
  }
}

TEST_CASE("every reason has a code of its own in its list, and a help") {
  for (const auto& list : lists) {
    std::set<std::string_view> codes;
    for (const results::Reason& each : list) {
      check_words(each);
      CHECK(codes.insert(each.code).second);
    }
  }
}

TEST_CASE("reasons are equal where their codes are, and there is none by default") {
  using namespace optimize::reasons;
  CHECK(flat == results::Reason{"flat", ""});
  CHECK(flat != infeasible);
  CHECK(unbounded == observables::reasons::unbounded);
  CHECK(observables::Stop{}.reason == results::Reason{});
  CHECK(observables::Stop{}.reason.code.empty());
}

TEST_CASE("the reasons of the continuation and of NLopt keep their names") {
  using continuation::StopReason;
  for (int k = 0; k <= static_cast<int>(StopReason::wrong_jacobian); ++k) {
    const auto reason = static_cast<StopReason>(k);
    CHECK(observables::reason_of(reason).code == continuation::name(reason));
    check_words(observables::reason_of(reason));
  }
  std::set<std::string_view> codes;
  for (int k = 0; k <= static_cast<int>(optimize::MinimizeReason::failed); ++k) {
    const auto reason = static_cast<optimize::MinimizeReason>(k);
    CHECK(optimize::reason_of(reason).code == name(reason));
    CHECK(codes.insert(name(reason)).second);
    CHECK(std::count(optimize::reasons::of_optima.begin(), optimize::reasons::of_optima.end(),
                     optimize::reason_of(reason)) == 1);
  }
}
