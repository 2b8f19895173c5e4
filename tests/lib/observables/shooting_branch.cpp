// Branches of exact periodic motions over the frequency, against closed forms,
// tests/reference/exact_1dof.json and the numbers of NLvib's example 03.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/observables/reference.hpp"

#include <arcslip/observables/frequency_response.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using observables::FrequencyRange;
using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponseMethod;
using observables::Status;
using reference::error;

namespace {

FrequencyRange range(double from, double to, ResponseMethod method, bool stability = true) {
  FrequencyRange range{from, to, stability};
  range.method = method;
  return range;
}

ResponseBranch shot(const scene::Scene& s, double from, double to) {
  auto branches = observables::frequency_response(s, range(from, to, ResponseMethod::shooting));
  REQUIRE(branches.size() == 1);
  CAPTURE(branches[0].stop.message);
  REQUIRE_FALSE(branches[0].points.empty());
  return branches[0];
}

ResponseBranch complete(const scene::Scene& s, double from, double to) {
  auto branch = shot(s, from, to);
  CAPTURE(branch.stop.message);
  REQUIRE(branch.status == Status::complete);
  return branch;
}

std::vector<ResponseEvent> events(const ResponseBranch& branch, const std::string& kind) {
  std::vector<ResponseEvent> found;
  for (const auto& event : branch.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

scene::Scene two_masses_and_stop(const std::string& elements) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k12", "between": ["x1", "x2"], "value": 1}, {"name": "k2", "at": "x2", "value": 1}],
      "dampers": [{"name": "c12", "between": ["x1", "x2"], "value": 0.03},
                  {"name": "c2", "at": "x2", "value": 0.03}]},
    "elements": [)" + elements +
                       R"(], "harmonics": {"order": 21},
    "excitation": [{"name": "force", "at": "x2", "cosine": 0.1}], "response": {"at": "x1"}})");
}

const char* stop = R"({"name": "stop", "type": "gap_spring", "at": "x1", "stiffness": 100, "gap": 1})";

void print(const ResponseBranch& branch) {
  std::printf("%s: %zu points, %ld rejected, %ld residuals, %ld jacobians, %.3f s; %s\n",
              branch.stop.reason.code.data(), branch.points.size(), branch.solver.rejected_steps,
              branch.solver.residuals, branch.solver.jacobians, branch.solver.seconds,
              branch.stop.message.c_str());
  for (const auto& e : branch.events)
    std::printf("  %-18s w %.12g A %.12g %s%s\n", e.kind.c_str(), e.point.omega, e.point.amplitude,
                e.nonsmooth ? "nonsmooth " : "", e.located ? "" : "not located");
}

}  // namespace

TEST_CASE("a linear oscillator by shooting has its closed form along the branch and at its peak") {
  const double c = 0.05;
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3, "sine": 0.4}], "response": {"at": "x"}})");
  const auto branch = complete(s, 0.4, 2);
  print(branch);
  CHECK(branch.points.size() > 100);
  const auto exact = [&](double w) { return 0.5 / std::hypot(1 - w * w, c * w); };
  for (const auto& point : branch.points) {
    CHECK(error(point.amplitude, exact(point.omega)) < 1e-10);
    CHECK(error(point.energy_viscous, std::acos(-1.0) * c * point.omega * std::pow(point.amplitude, 2)) <
          1e-9);
    CHECK(error(point.energy_input, point.energy_viscous) < 1e-9);
    REQUIRE(point.stability);
    const double decay = std::exp(-0.5 * c * 2 * std::acos(-1.0) / point.omega);
    for (const auto& each : point.stability->multipliers) CHECK(error(std::abs(each), decay) < 1e-10);
  }
  REQUIRE(branch.events.size() == 1);
  CHECK(branch.events[0].kind == "peak");
  CHECK(error(branch.events[0].point.omega, std::sqrt(1 - 0.5 * c * c)) < 1e-9);
}

TEST_CASE("the paper's peaks, amplitudes and multipliers are exact on branches by shooting") {
  for (const auto& row : reference::exact("resonance_peaks")) {
    const double hertz = row["frequency_hz"], load = row["normal_load"];
    CAPTURE(hertz, load);
    const auto branch = complete(scenes::paper(15, load), 17, 23);
    std::printf("load %g hertz %.12g A %.12g\n", load, hertz, row["amplitude"].get<double>());
    print(branch);
    const auto peaks = events(branch, "peak");
    REQUIRE(peaks.size() == 1);
    CHECK(error(peaks[0].point.omega, hertz * scenes::hertz) < 1e-9);
    CHECK(error(peaks[0].point.amplitude, row["amplitude"]) < 1e-10);
    CHECK(std::abs(peaks[0].point.elements.at(0).stick_percent - row["stick_percent"].get<double>()) < 1e-4);
  }
}

TEST_CASE("two masses and a stop by shooting lose their stability where NLvib's example 03 does") {
  const auto branch = complete(two_masses_and_stop(stop), 0.57, 0.77);
  print(branch);
}

TEST_CASE("harmonic balance converges to the branch by shooting with the third power of its order") {
  for (const double load : {0.5, 3.0}) {
    const double at = 20;
    const auto exact = complete(scenes::paper(15, load), 19.9, at).points.back();
    double before = 0;
    for (const int order : {9, 27, 81}) {
      const auto branch = observables::frequency_response(scenes::paper(order, load), {19.9, at});
      const double off = branch[0].points.back().amplitude / exact.amplitude - 1;
      std::printf("load %g order %d error %.3e\n", load, order, off);
      if (before != 0) CHECK(std::abs(off) < 1.5 * before / 27);
      before = std::abs(off);
    }
  }
}
