// Responses that grow without bound, against Den Hartog's closed form of the isolator with friction, and
// those that only grow much.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace arcslip;

namespace {

// A mass of 1 kg on a spring of 1 N/m and a slider, on a ground that moves by cos wt m.
scene::Scene isolator(const std::string& stiffness, double load, int order, double from, double to) {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}]},
    "elements": [{"name": "fr", "type": "jenkins", "at": "x", "stiffness": )" +
                                 stiffness + R"(, "friction_coefficient": 1, "normal_load": 0.5}],
    "excitation": [{"name": "base", "type": "base_displacement", "cosine": 1}],
    "harmonics": {"order": )" + std::to_string(order) +
                                 R"(}, "response": {"at": "x"},
    "studies": [{"kind": "frf", "from": 0.3, "to": 3}]})");
  scene::set(s, "fr.normal_load", load);
  scenes::window(s).from = from;
  scenes::window(s).to = to;
  return s;
}

// With one harmonic and a rigid slider, as it slips: the force w^2, less friction in quadrature to it. That
// of stiffness k is as large to some 1/sqrt(k A).
double amplitude(double omega, double load) {
  const double force = omega * omega, friction = 4 * load / std::numbers::pi;
  return std::sqrt(force * force - friction * friction) / std::abs(1 - omega * omega);
}

// The largest relative difference from the closed form of one harmonic between these frequencies, and of the
// frequencies of two points in turn there: a hole is as wide.
struct Defect {
  double amplitude = 0, hole = 0;
};

Defect defect(const std::vector<observables::ResponseBranch>& branches, double load, double from, double to) {
  Defect found;
  double last = from;
  for (const auto& branch : branches)
    for (const auto& point : branch.points) {
      if (point.omega < from || point.omega > to) continue;
      found.hole = std::max(found.hole, point.omega / last - 1);
      last = point.omega;
      found.amplitude =
          std::max(found.amplitude, std::abs(point.amplitude / amplitude(point.omega, load) - 1));
    }
  found.hole = std::max(found.hole, to / last - 1);
  return found;
}

// The frequencies of the unbounded peaks.
std::vector<double> poles(const std::vector<observables::ResponseBranch>& branches) {
  std::vector<double> found;
  for (const auto& branch : branches)
    for (const auto& event : branch.events)
      if (event.point.unbounded) found.push_back(event.point.omega);
  return found;
}

bool has_point(const std::vector<observables::ResponseBranch>& branches, double from, double to) {
  return std::any_of(branches.begin(), branches.end(), [&](const auto& branch) {
    return std::any_of(branch.points.begin(), branch.points.end(),
                       [&](const auto& point) { return point.omega >= from && point.omega <= to; });
  });
}

}  // namespace

TEST_CASE(
    "a response that begins stuck is unbounded at the natural frequency, and is there on both sides of it") {
  // Stuck, it moves 1e-3 to 1e-11 m.
  for (const std::string stiffness : {"100", "1e4", "1e6", "1e8", "1e10"}) {
    const auto branches = observables::frequency_response(isolator(stiffness, 0.5, 1, 0.3, 3), {0.3, 3});
    CAPTURE(stiffness);
    REQUIRE(branches.size() == 2);
    CHECK(branches[0].stop.reason == observables::reasons::unbounded);
    CHECK(branches[1].stop.reason == observables::reasons::boundary);
    REQUIRE(poles(branches).size() == 1);
    CHECK(std::abs(poles(branches)[0] - 1) < 1e-8);
    CHECK(has_point(branches, 1 - 1e-4, 1 - 1e-6));
    CHECK(has_point(branches, 1 + 1e-6, 1 + 1e-4));
    const Defect there = defect(branches, 0.5, 0.9, 2.5);
    CHECK(there.amplitude < 1 / std::sqrt(std::stod(stiffness)));
    CHECK(there.hole < 0.026);
  }
}

TEST_CASE("the isolator with friction is as large as by integration in time on both sides of its resonance") {
  for (const auto& [omega, exact] : {std::pair{0.98, 18.269}, std::pair{1.1, 4.831}}) {
    const auto branches = observables::frequency_response(isolator("1e4", 0.5, 55, 0.3, omega), {0.3, omega});
    CAPTURE(omega);
    REQUIRE(branches.back().stop.reason == observables::reasons::boundary);
    CHECK(std::abs(branches.back().points.back().amplitude / exact - 1) < 6e-4);
  }
}

TEST_CASE("a ground that hardly moves at the low end of the window leaves the resonance where it is") {
  for (const double from : {1e-4, 1e-2}) {
    const auto branches = observables::frequency_response(isolator("100", 0, 1, from, 3), {from, 3});
    CAPTURE(from);
    REQUIRE(branches.size() == 2);
    REQUIRE(poles(branches).size() == 1);
    CHECK(std::abs(poles(branches)[0] - 1) < 1e-9);
    const Defect there = defect(branches, 0, 0.5, 2.5);
    CHECK(there.amplitude < 1e-8);
    CHECK(there.hole < 0.06);
  }
}

TEST_CASE("friction just above pi/4 of the force bounds the resonance, just below it does not") {
  const double threshold = std::numbers::pi / 4;
  for (const double share : {0.5, 0.999, 1.001}) {
    const auto branches =
        observables::frequency_response(isolator("1e4", share * threshold, 1, 0.3, 3), {0.3, 3});
    CAPTURE(share, branches[0].stop.message);
    REQUIRE(poles(branches).size() == (share < 1 ? 1 : 0));
    // Next to the threshold the amplitude depends on the frequency also by the share that friction takes.
    if (share < 1) CHECK(std::abs(poles(branches)[0] - 1) < (share > 0.9 ? 1e-6 : 1e-9));
    CHECK(branches.back().stop.reason == observables::reasons::boundary);
  }
}

TEST_CASE(
    "a window that ends before the natural frequency has no unbounded resonance, however near it ends") {
  for (const double to : {0.99, 0.9999, 0.9999999}) {
    const auto branches = observables::frequency_response(isolator("1e4", 0.5, 1, 0.3, to), {0.3, to});
    CAPTURE(to);
    REQUIRE(branches.size() == 1);
    CHECK(branches[0].stop.reason == observables::reasons::boundary);
    CHECK(std::abs(branches[0].points.back().amplitude / amplitude(to, 0.5) - 1) < 2e-3);
  }
}

TEST_CASE("each of two undamped modes is unbounded at its natural frequency") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "m", "at": "x", "value": 1}, {"name": "n", "at": "y", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}, {"name": "l", "at": "y", "value": 1},
        {"name": "j", "between": ["x", "y"], "value": 1}]},
    "elements": [{"name": "fr", "type": "jenkins", "at": "x", "stiffness": 1e4, "friction_coefficient": 1,
      "normal_load": 0.1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}, {"name": "g", "at": "y", "cosine": 0.5}],
    "harmonics": {"order": 1}, "response": {"at": "x"}, "studies": [{"kind": "frf", "from": 0.3, "to": 3}]})");
  const auto branches = observables::frequency_response(s, {0.3, 3});
  REQUIRE(branches.size() == 3);
  const auto found = poles(branches);
  REQUIRE(found.size() == 2);
  CHECK(std::abs(found[0] - 1) < 1e-9);
  CHECK(std::abs(found[1] - std::sqrt(3.0)) < 1e-9);
  CHECK(has_point(branches, 1 + 1e-6, 1.001));
}

TEST_CASE("beyond the fold of a branch that turns back to a pole, peaks are found from the other end") {
  // x on a spring of 1 N/m that yields to 1/4 N/m beyond 1 m, without damping: its branch from rest has a
  // fold below 1 rad/s, and turns back to the pole of the far stiffness, 0.5 rad/s. Next to it a mass y on a
  // spring of 2.25 N/m with a damper of 0.1 N s/m, whose peak is beyond.
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"], "masses": [{"name": "m", "at": "x", "value": 1}, {"name": "n", "at": "y", "value": 1}],
      "springs": [{"name": "k", "at": "y", "value": 2.25}], "dampers": [{"name": "c", "at": "y", "value": 0.1}]},
    "elements": [{"name": "s", "type": "bilinear_spring", "at": "x", "stiffness": 1, "stiffness_beyond": 0.25, "corner": 1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.1}, {"name": "g", "at": "y", "cosine": 0.1}],
    "harmonics": {"order": 1}, "response": {"at": "y"}})");
  const auto branches = observables::frequency_response(s, {0.2, 2});
  REQUIRE(branches.size() == 2);
  CAPTURE(branches[0].stop.message, branches[1].stop.message);
  CHECK(branches[0].stop.reason == observables::reasons::unbounded);
  CHECK(std::abs(branches[0].events.back().point.omega / 0.5 - 1) < 1e-6);
  CHECK(branches[0].points.back().omega > 0.5);  // reached on the way down
  const auto peak = std::find_if(branches[1].events.begin(), branches[1].events.end(), [](const auto& event) {
    return event.kind == "peak" && event.point.omega > 1;
  });
  REQUIRE(peak != branches[1].events.end());
  const auto curves = observables::resonance_peaks(s, {"f.cosine", 0.1, 0.12, 0.2, 2});
  REQUIRE(curves.size() == 2);  // the other is where x has its fold
  const auto& curve = curves[0].points[0].omega > 1 ? curves[0] : curves[1];
  CHECK(curve.points.front().over == 0.1);
  CHECK(curve.points.back().over == 0.12);
  for (const auto& point : curve.points) {
    CHECK(std::abs(point.omega * point.omega / (2.25 - 0.005) - 1) < 1e-9);
    CHECK(std::abs(point.amplitude * std::sqrt(2.25 - 0.0025) - 1) < 1e-9);
  }
}
