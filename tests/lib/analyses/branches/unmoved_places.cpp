// Peaks of places that do not move: what is seen there is rounding.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace arcslip;

namespace {

// Two oscillators at 1:2 with a quadratic coupling. The force on b moves a only where half of its frequency
// is excited parametrically.
scene::Scene one_to_two(const std::string& response) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "at": "b", "value": 4}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.005}, {"name": "cb", "at": "b", "value": 0.01}]},
    "elements": [{"name": "q", "type": "polynomial_coupling",
      "potential": [{"powers": {"a": 2, "b": 1}, "value": 0.5}]}],
    "excitation": [{"name": "f", "at": "b", "cosine": 0.02}], "response": {"at": ")" +
                       response + R"("}, "harmonics": {"order": 6, "period": 2},
    "studies": [{"kind": "frf", "from": 1.9, "to": 2.1, "branches": "all"}]})");
}

}  // namespace

TEST_CASE(
    "a place that does not move has no peaks, one that does keeps its own, and bifurcations are located") {
  for (const std::string response : {"a", "b"}) {
    const scene::Scene s = one_to_two(response);
    observables::FrequencyRange range{1.9, 2.1};
    range.branches = observables::Branches::all;
    const auto branches = observables::frequency_response(s, range);
    CAPTURE(response);
    REQUIRE_FALSE(branches.empty());
    std::vector<double> peaks, branch_points;
    for (const auto& event : branches[0].events) {
      if (event.kind == "peak") peaks.push_back(event.point.omega);
      if (event.kind == "branch_point") branch_points.push_back(event.point.omega);
    }
    CHECK(peaks.size() == (response == "b" ? 1 : 0));
    REQUIRE(branch_points.size() == 2);
    // |b| where a mode of half the frequency w/2 begins: the closed form of the threshold.
    CHECK(std::abs(branch_points[0] - 1.94977385) < 1e-8);
    CHECK(std::abs(branch_points[1] - 2.04927705) < 1e-8);
  }
}
