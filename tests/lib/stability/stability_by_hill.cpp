// Multipliers by Hill's method on request, next to those of the variational equation.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/observables/quantities.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

using namespace arcslip;
using observables::ResponseBranch;
using observables::StabilityRequest;

namespace {

StabilityRequest by_hill() {
  StabilityRequest request = true;
  request.by_hill = true;
  return request;
}

scene::Scene cubic_oscillator() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.5}], "harmonics": {"order": 11},
    "response": {"at": "x"}})");
}

}  // namespace

TEST_CASE("Hill's method finds the multipliers of the variational equation, and their error") {
  int responses = 0, unstable = 0;
  for (const double omega : {0.8, 1.6, 2.0}) {
    observables::PointSettings settings{omega};
    settings.stability = true;
    const auto first = observables::point_responses(cubic_oscillator(), settings);
    settings.stability = by_hill();
    const auto second = observables::point_responses(cubic_oscillator(), settings);
    REQUIRE(first.size() == second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      REQUIRE(first[i].point.stability);
      REQUIRE(second[i].point.stability);
      const auto &a = *first[i].point.stability, &b = *second[i].point.stability;
      CAPTURE(omega, first[i].point.amplitude);
      CHECK(observables::distance(a.multipliers, b.multipliers) < 1e-8);
      CHECK(a.unstable == b.unstable);
      CHECK(std::abs(a.error - b.error) < 1e-8);
      ++responses;
      unstable += a.unstable > 0;
    }
  }
  CHECK(responses == 7);
  CHECK(unstable == 2);
}

TEST_CASE("Hill's method refuses laws with memory, and the branch says so") {
  observables::FrequencyRange range{19, 21};
  range.stability = by_hill();
  const auto branch = observables::frequency_response(scenes::paper(5), range).front();
  CHECK(branch.status == observables::Status::complete);
  CHECK(branch.points.size() > 20);
  for (const auto& point : branch.points) CHECK_FALSE(point.stability);
  INFO(branch.unknown_stability);
  CHECK(branch.unknown_stability.find("Hill's method is for laws without memory") != std::string::npos);
}

TEST_CASE("results have as many multipliers as the study asks for, and the verdict is of all of them") {
  observables::FrequencyRange range{0.3, 2.5, true};
  range.stability.multipliers = 1;
  const auto branch = observables::frequency_response(cubic_oscillator(), range).front();
  const auto all = observables::stability_quantities();
  const auto column =
      std::find_if(all.begin(), all.end(), [](const auto& q) { return q.path == "multipliers"; });
  REQUIRE(column != all.end());
  for (const auto& point : branch.points) {
    REQUIRE(point.stability);
    CHECK(point.stability->multipliers.size() == 2);
    const results::Value shown =
        std::get<results::Value (*)(const observables::Stability&)>(column->get)(*point.stability);
    CHECK(std::get<results::Value::List>(shown.get()).size() == 1);
  }
}
