// Branches of exact periodic motions over the frequency and over other parameters, against closed forms,
// tests/reference/exact_1dof.json and the numbers of NLvib's example 03.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>

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
  return branches[0];
}

ResponseBranch complete(const scene::Scene& s, double from, double to) {
  auto branch = shot(s, from, to);
  CAPTURE(branch.stop.message);
  REQUIRE(branch.status == Status::complete);
  return branch;
}

/// Over a parameter at one frequency.
ResponseBranch shot_over(const scene::Scene& s, const std::string& over, double from, double to,
                         double frequency, const control::Control& control = {}) {
  auto branches = observables::parameter_response(
      s, {over, from, to, frequency, true, ResponseMethod::shooting}, control);
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].over == over);
  return branches[0];
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

}  // namespace

TEST_CASE("a linear oscillator by shooting has its closed form along the branch and at its peak") {
  const double c = 0.05;
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3, "sine": 0.4}], "response": {"at": "x"}})");
  const auto branch = complete(s, 0.4, 2);
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
    const auto peaks = events(branch, "peak");
    REQUIRE(peaks.size() == 1);
    CHECK(error(peaks[0].point.omega, hertz * scenes::hertz) < 1e-9);
    CHECK(error(peaks[0].point.amplitude, row["amplitude"]) < 1e-10);
    CHECK(std::abs(peaks[0].point.elements.at(0).stick_percent - row["stick_percent"].get<double>()) < 1e-4);
  }
}

TEST_CASE("the paper's amplitudes, sticking and multipliers are exact where branches by shooting end") {
  for (const auto& row : reference::exact("fixed_frequency")) {
    const double hertz = row["frequency_hz"], load = row["normal_load"], energy = row["energy_friction"];
    CAPTURE(hertz, load);
    const auto end = complete(scenes::paper(15, load), 17.5, hertz).points.back();
    CHECK(error(end.amplitude, row["amplitude"]) < 1e-10);
    CHECK(std::abs(end.elements.at(0).stick_percent - row["stick_percent"].get<double>()) < 1e-6);
    CHECK(std::abs(end.energy_friction - energy) < 1e-8 * energy + 1e-13);
    CHECK(std::isnan(end.phase));
  }
  const auto end = complete(scenes::paper(15, 3), 18, 20).points.back();
  REQUIRE(end.stability);
  const auto& multipliers = end.stability->multipliers;
  REQUIRE(multipliers.size() == 3);
  CHECK(std::abs(multipliers[0] - 0.84767) < 5e-6);
  CHECK(std::abs(multipliers[1] - 0.81154) < 5e-6);
  CHECK(std::abs(multipliers[2]) < 1e-12);
}

TEST_CASE("two masses and a stop by shooting lose their stability where NLvib's example 03 does") {
  const auto branch = complete(two_masses_and_stop(stop), 0.57, 0.77);
  const auto tori = events(branch, "neimark_sacker"), doublings = events(branch, "period_doubling"),
             folds = events(branch, "fold");
  REQUIRE(tori.size() == 2);
  const double grazing = 0.58189963904;  // where the linear |x1| is 1
  CHECK(tori[0].point.omega > grazing);
  CHECK(tori[0].point.omega < grazing + 1.4e-6);
  CHECK(std::abs(tori[1].point.omega - 0.6186069) < 5.1e-8);
  for (const auto& event : tori) CHECK(event.point.stability->rotation > 0);
  REQUIRE(doublings.size() == 2);
  CHECK(std::abs(doublings[0].point.omega - 0.7387830) < 5.1e-8);
  CHECK(std::abs(doublings[1].point.omega - 0.7555862) < 5.1e-8);
  REQUIRE(folds.size() == 2);
  // By NLvib's harmonic balance 0.7556255; that of this project converges with its order to the one by
  // shooting.
  CHECK(std::abs(folds[0].point.omega - 0.7556255) < 2e-6);
  auto series = two_masses_and_stop(stop);
  series.harmonics.order = 120;
  const auto by_series = events(observables::frequency_response(series, {0.6, 0.77}).at(0), "fold");
  REQUIRE(by_series.size() == 2);
  CHECK(std::abs(folds[0].point.omega - by_series[0].point.omega) < 2e-9);
  CHECK(std::abs(folds[1].point.omega - by_series[1].point.omega) < 1e-9);
  // The stop is touched above an amplitude of 1 alone.
  for (const auto& point : branch.points) {
    REQUIRE(point.stability);
    CHECK(point.stability->error == 0);
    if (point.amplitude < 1) CHECK(point.stability->unstable == 0);
  }
}

TEST_CASE("harmonic balance converges to the branch by shooting with the third power of its order") {
  for (const double load : {0.5, 3.0}) {
    const auto exact = complete(scenes::paper(15, load), 19.9, 20).points.back();
    for (const int order : {9, 27, 81}) {
      const auto branch = observables::frequency_response(scenes::paper(order, load), {19.9, 20});
      CAPTURE(load, order);
      CHECK(error(branch.at(0).points.back().amplitude, exact.amplitude) < 5e-3 / std::pow(order, 3));
    }
  }
}

TEST_CASE("branches by shooting pass through full stick, full slip and their onset") {
  // Sticks throughout, or slips throughout: linear.
  const auto peak = [](double load, double stiffness) {
    const auto branch = complete(scenes::paper(15, load), 17, 23);
    const auto peaks = events(branch, "peak");
    REQUIRE(peaks.size() == 1);
    const double m = 1.24, c = 0.134, w2 = stiffness / m - 0.5 * c * c / (m * m);
    CHECK(error(peaks[0].point.omega, std::sqrt(w2)) < 1e-9);
    return branch;
  };
  for (const auto& point : peak(3000, 17890 + 3500).points) {
    CHECK(std::abs(point.elements.at(0).stick_percent - 100) < 1e-10);
    CHECK(point.energy_friction == 0);
  }
  peak(0, 17890);
  // Slips about the resonance only.
  const auto onset = complete(scenes::paper(15, 8), 10, 60);
  CHECK(std::abs(onset.points.front().elements.at(0).stick_percent - 100) < 1e-10);
  CHECK(std::abs(onset.points.back().elements.at(0).stick_percent - 100) < 1e-10);
  CHECK(events(onset, "peak").at(0).point.elements.at(0).stick_percent < 75);
}

TEST_CASE("branches by shooting go through several slips a period and through bouncing") {
  std::vector<std::size_t> slips_of;
  for (const auto& branch :
       {complete(scenes::paper(101, 0.1), 1, 1.3),
        complete(
            two_masses_and_stop(
                R"({"name": "d", "type": "jenkins", "at": "x1", "stiffness": 1, "friction_coefficient": 0.5,
                         "normal_load": 0.1},
                        {"name": "e", "type": "jenkins", "at": "x2", "stiffness": 1, "friction_coefficient": 0.5,
                         "normal_load": 0.1},
                        {"name": "stop", "type": "gap_spring", "at": "x1", "stiffness": 100, "gap": 0.1})"),
            0.1, 2.5)}) {
    std::size_t slips = 0;
    for (const auto& point : branch.points) {
      CHECK(std::isfinite(point.amplitude));
      CHECK(std::abs(point.energy_input - point.energy_total()) < 1e-8 * point.energy_input);
      const auto& element = point.elements.at(0);
      CHECK(element.slip_angles.size() == element.reversal_angles.size());
      slips = std::max(slips, element.slip_angles.size());
    }
    slips_of.push_back(slips);
  }
  CHECK(slips_of[0] >= 4);
  CHECK(slips_of[1] >= 2);
}

TEST_CASE("a branch by shooting that cannot be says why") {
  const auto ends = [](const scene::Scene& s, const std::string& reason, const std::string& words) {
    const auto branch = shot(s, 0.5, 2);
    CHECK(branch.status == Status::failed);
    CHECK(branch.stop.reason.code == reason);
    CHECK(branch.points.empty());
    CAPTURE(branch.stop.message);
    CHECK(branch.stop.message.find(words) != std::string::npos);
  };
  ends(two_masses_and_stop(R"({"name": "s", "type": "cubic_spring", "at": "x1", "stiffness": 1})"),
       "not_piecewise_linear", "the element \"s\" is not; use the method harmonic_balance");
  auto massless = two_masses_and_stop(stop);
  scene::set(massless, "m1.value", 0);
  ends(massless, "massless", "degree of freedom \"x1\" has no mass of its own");
  ends(
      two_masses_and_stop(
          R"({"name": "d", "type": "coulomb", "at": "x1", "friction_coefficient": 0.5, "normal_load": 0.1})"),
      "set_valued", "the friction of \"d\" has no stiffness");
}

TEST_CASE("a branch by shooting is stopped by its caller") {
  const auto branch = observables::frequency_response(
      two_masses_and_stop(stop), range(0.57, 0.77, ResponseMethod::shooting),
      controls::reporting([](const control::Progress& progress) { return progress.points < 5; }));
  REQUIRE(branch.size() == 1);
  CHECK(branch[0].status == Status::stopped);
  CHECK(branch[0].stop.reason.code == "user");
  CHECK(branch[0].points.size() == 5);
}

TEST_CASE("over a parameter, a linear oscillator by shooting has its closed form") {
  const auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3, "sine": 0.4}], "response": {"at": "x"}})");
  const double w = 1.1, c = 0.05;
  for (const bool down : {false, true}) {  // across the resonance at k = w^2
    const auto branch = shot_over(s, "k.value", down ? 2.0 : 0.6, down ? 0.6 : 2.0, w);
    CAPTURE(branch.stop.message);
    REQUIRE(branch.status == Status::complete);
    CHECK(branch.stop.message ==
          std::string("reached the end of the range at k.value = ") + (down ? "0.6" : "2"));
    CHECK(branch.points.size() > 100);
    for (const auto& point : branch.points) {
      CHECK(point.omega == w);
      CHECK(error(point.amplitude, 0.5 / std::hypot(point.over - w * w, c * w)) < 1e-10);
      REQUIRE(point.stability);
      CHECK(error(std::abs(point.stability->multipliers.at(0)), std::exp(-c * std::acos(-1.0) / w)) < 1e-10);
    }
    REQUIRE(branch.events.size() == 1);
    CHECK(branch.events[0].kind == "maximum");
    CHECK(error(branch.events[0].point.over, w * w) < 1e-8);
  }
}

TEST_CASE("over the load, the paper's amplitudes and its optimum are exact on branches by shooting") {
  for (const auto& row : reference::exact("fixed_frequency")) {
    const double hertz = row["frequency_hz"], load = row["normal_load"];
    CAPTURE(hertz, load);
    const auto branch = shot_over(scenes::paper(15, 1), "damper.normal_load", 0.6 * load, load, hertz);
    REQUIRE(branch.status == Status::complete);
    CHECK(error(branch.points.back().amplitude, row["amplitude"]) < 1e-10);
    CHECK(std::abs(branch.points.back().elements.at(0).stick_percent - row["stick_percent"].get<double>()) <
          1e-6);
  }
  // Where the peak is least, its amplitude is stationary in the load at a fixed frequency as well.
  for (const auto& row : reference::exact("optima")) {
    const double damping = row["c"], load = row["normal_load"], hertz = row["frequency_hz"];
    if (damping == 0) continue;  // other responses are unbounded
    CAPTURE(damping);
    auto s = scenes::paper(15, 1);
    scene::set(s, "c.value", damping);
    const auto branch = shot_over(s, "damper.normal_load", 1, 30, hertz);
    REQUIRE(branch.status == Status::complete);
    const auto stationary = events(branch, "maximum");
    REQUIRE(stationary.size() == 1);
    const auto& point = stationary[0].point;
    CHECK(error(point.over, load) < 1e-6);
    CHECK(error(point.amplitude, row["amplitude"]) < 1e-9);
    CHECK(std::abs(point.elements.at(0).stick_percent - row["stick_percent"].get<double>()) < 1e-4);
  }
}

TEST_CASE(
    "over seven decades of a damper's stiffness, the amplitude falls to a thousandth without an event") {
  // At full stick c = 0 leaves 1/A = |k + k_d - m w^2|/F.
  auto s = scenes::paper(15, 3);
  const double hertz = 20, from = 10, to = 1e7;
  const auto up = shot_over(s, "damper.stiffness", from, to, hertz);
  const auto down = shot_over(s, "damper.stiffness", to, from, hertz);
  for (const auto* branch : {&up, &down}) {
    CAPTURE(branch->stop.message);
    REQUIRE(branch->status == Status::complete);
    CHECK(branch->points.size() < 500);
    REQUIRE(branch->events.size() == 1);
    CHECK(branch->events[0].kind == "maximum");
  }
  CHECK(error(up.events[0].point.over, down.events[0].point.over) < 1e-9);
  // The mass on both springs, and its own dashpot.
  const auto model = model::build(s);
  const auto p = [&](const char* name) {
    return model.parameters[static_cast<std::size_t>(model::parameter_index(model, name))].value;
  };
  const double w = hertz * scenes::hertz;
  int stuck = 0;
  for (const auto& point : up.points) {
    if (point.elements.at(0).stick_percent < 100) continue;
    ++stuck;
    const double exact =
        p("force.cosine") / std::hypot(p("k.value") + point.over - p("m.value") * w * w, p("c.value") * w);
    CAPTURE(point.over);
    CHECK(error(point.amplitude, exact) < 1e-9);
  }
  CHECK(stuck > 100);
}

TEST_CASE("over the load from nothing, and over eighteen decades, there are the same three extrema") {
  const auto from_nothing = shot_over(scenes::paper(15, 1), "damper.normal_load", 0, 10, 20);
  const auto up = shot_over(scenes::paper(15, 1), "damper.normal_load", 1e-9, 1e9, 20);
  const auto down = shot_over(scenes::paper(15, 1), "damper.normal_load", 1e9, 1e-9, 20);
  auto kinds = [](const observables::ResponseBranch& branch) {
    std::vector<std::string> all;
    for (const auto& event : branch.events) all.push_back(event.kind);
    return all;
  };
  for (const auto* branch : {&from_nothing, &up, &down}) {
    CAPTURE(branch->stop.message);
    REQUIRE(branch->status == Status::complete);
    REQUIRE(kinds(*branch) == std::vector<std::string>{"minimum", "maximum", "minimum"});
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& event = branch->events[branch == &down ? 2 - i : i];
      CHECK(event.located);
      CHECK(error(event.point.over, up.events[i].point.over) < 1e-8);
      CHECK(error(event.point.amplitude, up.events[i].point.amplitude) < 1e-10);
    }
  }
}

TEST_CASE(
    "over the force, a mass at a stop has the folds by many harmonics, and the doublings over the "
    "frequency") {
  const double w = 0.7;
  const auto branch = shot_over(two_masses_and_stop(stop), "force.cosine", 0.02, 0.3, w);
  CAPTURE(branch.stop.message);
  REQUIRE(branch.status == Status::complete);
  auto series = two_masses_and_stop(stop);
  series.harmonics.order = 120;
  const auto by_series = observables::parameter_response(series, {"force.cosine", 0.02, 0.3, w, true});
  REQUIRE_FALSE(by_series.empty());
  for (const char* kind : {"fold", "maximum", "minimum"}) {
    const auto here = events(branch, kind), there = events(by_series[0], kind);
    CAPTURE(kind, here.size(), there.size());
    REQUIRE(here.size() == there.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
      CAPTURE(here[i].point.over, there[i].point.over);
      CHECK(error(here[i].point.over, there[i].point.over) < 1e-6);
      CHECK(error(here[i].point.amplitude, there[i].point.amplitude) < 1e-6);
    }
  }
  CHECK(events(branch, "fold").size() == 2);
  const auto doublings = events(branch, "period_doubling");
  REQUIRE(doublings.size() == 1);
  auto s = two_masses_and_stop(stop);
  scene::set(s, "force.cosine", doublings[0].point.over);
  double nearest = HUGE_VAL;
  for (const auto& event : events(complete(s, 0.57, 0.9), "period_doubling"))
    nearest = std::min(nearest, std::abs(event.point.omega - w));
  CHECK(nearest < 1e-7);
}

TEST_CASE(
    "over a gap, the fold just after grazing is at one place whatever the steps, and that of the exact "
    "motion") {
  auto s = scenes::example("unilateral_oscillator");
  s.harmonics = {};
  s.harmonics.order = 21;
  const auto fold = [&](double from, double to, ResponseMethod method) {
    const auto branches = observables::parameter_response(s, {"stop.gap", from, to, 0.7, false, method});
    REQUIRE(branches.size() == 1);
    const auto folds = events(branches[0], "fold");
    REQUIRE(folds.size() == 2);
    return from < to ? folds[1] : folds[0];
  };
  const auto exact = fold(0, 10, ResponseMethod::shooting);
  CHECK(exact.located);
  for (const auto& [from, to] :
       {std::pair{0.0, 10.0}, {0.0, 5.0}, {0.1, 10.0}, {0.0, 4.0}, {0.2, 8.0}, {5.0, 0.1}}) {
    CAPTURE(from, to);
    const auto found = fold(from, to, ResponseMethod::harmonic_balance);
    CHECK(found.located);
    CHECK(error(found.point.over, 0.433728199724) < 1e-10);
    CHECK(error(found.point.over, exact.point.over) < 1e-6);
    CHECK(error(found.point.amplitude, exact.point.amplitude) < 1e-6);
  }
}

TEST_CASE("over a parameter, a branch by shooting that cannot be, or is stopped, says why") {
  const auto failed =
      shot_over(two_masses_and_stop(R"({"name": "s", "type": "cubic_spring", "at": "x1", "stiffness": 1})"),
                "force.cosine", 0.1, 0.2, 0.6);
  CHECK(failed.status == Status::failed);
  CHECK(failed.stop.reason.code == "not_piecewise_linear");
  CHECK_THROWS_AS(shot_over(two_masses_and_stop(stop), "force.cosin", 0.1, 0.2, 0.6), scene::ParameterError);
  const auto stopped =
      shot_over(two_masses_and_stop(stop), "force.cosine", 0.1, 0.2, 0.6,
                controls::reporting([](const control::Progress& progress) { return progress.points < 5; }));
  CHECK(stopped.status == Status::stopped);
  CHECK(stopped.stop.reason.code == "user");
  CHECK(stopped.points.size() == 5);
}
