// The lists of reasons and of kinds of events: what they say is what is written and documented.

#include "catch.hpp"
#include "environment.hpp"

#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/results/event_kinds.hpp>
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

std::string event_rows(std::span<const results::EventKind> all) {
  std::string text;
  for (const results::EventKind& each : all)
    text.append("| `").append(each.name).append("` | ").append(each.of).append(" | ").append(each.help) +=
        " |\n";
  return text;
}

void check_name(std::string_view name) {
  CHECK_FALSE(name.empty());
  CHECK(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_1234") == std::string_view::npos);
}

void check_help(std::string_view help) {
  CHECK_FALSE(help.empty());
  CHECK(help.find_first_of("|\n") == std::string_view::npos);
}

void check_words(const results::Reason& reason) {
  CAPTURE(reason);
  check_name(reason.code);
  check_help(reason.help);
}

const std::span<const results::Reason> lists[] = {
    observables::reasons::of_branches,    observables::reasons::of_motions,
    observables::reasons::of_responses,   observables::reasons::of_sweeps,
    observables::reasons::of_comparisons, optimize::reasons::of_optima,
    optimize::reasons::of_optimum_curves};

const std::span<const results::EventKind> lists_of_kinds[] = {observables::event_kinds::all,
                                                              optimize::event_kinds::of_curves};

std::string documented_results() {
  std::ifstream file(source_folder() + "/docs/results.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the documentation of results has the rows of the lists of reasons and of kinds of events") {
  const std::string text = documented_results();
  for (const auto& list : lists) {
    INFO("the table is to be:\n" << reason_rows(list));
    CHECK(text.find("|---|---|\n" + reason_rows(list) + "\n") != std::string::npos);
  }
  for (const auto& list : lists_of_kinds) {
    INFO("the table is to be:\n" << event_rows(list));
    CHECK(text.find("|---|---|---|\n" + event_rows(list) + "\n") != std::string::npos);
  }
}

TEST_CASE("every kind of events has a name of its own, words, a help and results that have it") {
  std::set<std::string_view> names, words;
  for (const auto& list : lists_of_kinds) {
    for (const results::EventKind& each : list) {
      CAPTURE(each);
      check_name(each.name);
      check_help(each.help);
      check_help(each.of);
      CHECK(names.insert(each.name).second);
      CHECK(words.insert(each.words).second);
    }
  }
}

TEST_CASE("a kind of events is found by the name of its monitor, which may be a user's own") {
  namespace kinds = observables::event_kinds;
  CHECK(kinds::kind_named("neimark_sacker") == kinds::neimark_sacker);
  CHECK(kinds::words_of("neimark_sacker") == "Neimark-Sacker point");
  CHECK(kinds::words_of("lift_off") == "lift_off");
  CHECK(kinds::kind_named("lift_off").mark.shape == results::Shape::none);
  CHECK(observables::ResponseEvent{kinds::fold, false, true, {}}.kind == kinds::fold);
  CHECK(std::string("lift_off") == results::EventKind{.name = "lift_off"});
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
