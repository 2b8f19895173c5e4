// Branches over a parameter at a fixed frequency.

#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/curves/curves.hpp"
#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>

using namespace arcslip;
using observables::ResponseBranch;
using observables_test::events;

namespace {

observables::ParameterRange parameter_range(const std::string& parameter, double frequency, double from,
                                            double to) {
  return {parameter, from, to, frequency};
}

}  // namespace

TEST_CASE("over the load, at fixed frequency, the paper's oscillator responds exactly to 5e-8") {
  for (double frequency : {18.5, 20.0, 21.5}) {
    for (const auto& exact : reference::exact("fixed_frequency")) {
      const double load = exact["normal_load"];
      if (exact["frequency_hz"] != frequency) continue;
      CAPTURE(frequency, load);
      const auto branches = observables::parameter_response(
          scenes::paper(55), parameter_range("damper.normal_load", frequency, 0.01, load));
      REQUIRE(branches.size() == 1);
      const ResponseBranch& branch = branches[0];
      CHECK(branch.status == observables::Status::complete);
      CHECK(branch.over == "damper.normal_load");
      REQUIRE_FALSE(branch.points.empty());
      const auto& end = branch.points.back();
      CHECK(end.over == load);
      CHECK(end.omega == frequency * scenes::hertz);
      CHECK(reference::error(end.amplitude, exact["amplitude"]) < 5e-8);
      CHECK(std::abs(end.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 1e-4);
    }
  }
}

TEST_CASE("at 20 Hz the response over the load has one maximum, above both responses in its neighbourhood") {
  const auto branch =
      observables::parameter_response(scenes::paper(15), parameter_range("damper.normal_load", 20, 0.01, 500))
          .front();
  CHECK(branch.status == observables::Status::complete);
  CHECK(branch.points.front().over == 0.01);
  CHECK(branch.points.back().over == 500);
  CHECK(branch.points.size() >= 150);
  CHECK(events(branch, "fold").empty());
  const auto maxima = events(branch, "maximum");
  CHECK(maxima.size() == 1);
  // Next to full stick, from where on the load moves nothing, the amplitude may pass a minimum by some 1e-7.
  const auto minima = events(branch, "minimum");
  CHECK(minima.size() <= 1);
  for (const auto& event : minima) CHECK(event.point.amplitude < branch.points.back().amplitude);
  for (const auto& kind : {"maximum", "minimum"})
    for (const auto& event : events(branch, kind)) {
      CAPTURE(kind, event.point.over);
      for (double shift : {-1e-3, 1e-3}) {
        const double nearby =
            scenes::response_at(scenes::paper(15, event.point.over * (1 + shift)), 20).amplitude;
        CHECK((event.kind == "maximum") == (nearby < event.point.amplitude));
      }
    }
}

TEST_CASE("the Jenkins and Duffing oscillator folds in the load where its describing function does") {
  // Below the first fold and above the second there are two responses of large amplitude next to the small
  // one.
  const auto s = scenes::duffing_jenkins();
  const double first = 0.9169049045, second = 1.6884695203;
  for (const auto& [range, fold, other] :
       {std::tuple(parameter_range("d.normal_load", 2, 0.5, 3), first, second),
        std::tuple(parameter_range("d.normal_load", 2, 3, 0.5), second, first)}) {
    const auto branches = observables::parameter_response(s, range);
    CAPTURE(fold);
    REQUIRE(branches.size() == 3);
    const auto beyond = events(branches[2], "fold");  // of those at the end of the range
    REQUIRE(beyond.size() == 1);
    CHECK(std::abs(beyond[0].point.over - other) < 1e-9);
    CHECK(branches[2].points.back().over == range.to);
    for (const auto& branch : branches) CHECK(branch.status == observables::Status::complete);
    CHECK(events(branches[0], "fold").empty());
    CHECK(branches[0].points.back().over == range.to);
    const auto folds = events(branches[1], "fold");
    REQUIRE(folds.size() == 1);
    CHECK(std::abs(folds[0].point.over - fold) < 1e-9);
    CHECK_FALSE(folds[0].nonsmooth);
    CHECK(branches[1].points.back().over == range.from);
  }
}

TEST_CASE("through full stick, where the load moves nothing, no branch over the load is lost") {
  const auto s = scenes::example("duffing_jenkins");
  for (const int order : {5, 15})
    for (const double frequency : {1.2, 1.6, 2.0}) {
      CAPTURE(order, frequency);
      scene::Scene with = s;
      with.harmonics.order = order;
      const auto branches =
          observables::parameter_response(with, parameter_range("damper.normal_load", frequency, 0.01, 3));
      CHECK(branches[0].points.back().over == 3);
      CHECK(branches[0].points.back().elements[1].stick_percent == 100);
      for (const auto& branch : branches) CHECK(branch.status == observables::Status::complete);
    }
}

TEST_CASE("over a tie both of its fields change") {
  scene::Scene s = scenes::paper(7);
  s.elements.push_back(s.elements.front());
  s.elements.back().name = "second";
  for (auto& element : s.elements) element.values[0] = 1750;
  scenes::tie(s, "loads", {"damper.normal_load", "second.normal_load"});
  const auto halves = observables::parameter_response(s, parameter_range("loads", 20, 0.5, 1.5)).front();
  const auto whole =
      observables::parameter_response(scenes::paper(7), parameter_range("damper.normal_load", 20, 1, 3))
          .front();
  CHECK(reference::error(halves.points.back().amplitude, whole.points.back().amplitude) < 1e-10);
  CHECK(reference::error(halves.points.front().amplitude, whole.points.front().amplitude) < 1e-10);
}

TEST_CASE("a parameter that is not there, or may not take the value, is refused by name") {
  CHECK_THROWS_AS(observables::parameter_response(scenes::paper(1), parameter_range("damper.load", 20, 1, 3)),
                  scene::ParameterError);
  CHECK_THROWS_AS(
      observables::parameter_response(scenes::paper(1), parameter_range("damper.normal_load", 20, 1, -3)),
      scene::ParameterError);
}

TEST_CASE("a branch over a parameter ends with the callback, and no other is begun") {
  const auto compute = [](const studies::Case& at, const control::Control& of_case) {
    return observables::parameter_response(at.scene, parameter_range("damper.normal_load", 20, 1, 3),
                                           of_case);
  };
  double share = 0;
  const auto branches =
      studies::for_each<ResponseBranch>(scenes::paper(1), scene::Combinations({{"c.value", {0.1, 0.2}}}),
                                        compute, controls::reporting([&](const control::Progress& progress) {
                                          CHECK(progress.share_done >= share);
                                          CHECK(progress.branches == 2);
                                          share = progress.share_done;
                                          return progress.points < 5;
                                        }));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::stopped);
  CHECK(branches[0].stop.reason == observables::reasons::user);
  CHECK(branches[0].points.size() == 5);
}

TEST_CASE("a branch over a parameter asks in every phase, and is stopped in each") {
  scene::Scene s = scenes::paper(7);
  s.elements.push_back({"h", &elements::cubic_spring(), {{{0, 1.0}}}, {1e9}});
  const auto range = parameter_range("damper.normal_load", 20, 1, 100);
  long asked = 0, before_points = 0;
  bool has_points = false;
  const auto count = controls::polled([&] {
    ++asked;
    if (!has_points) ++before_points;
    return true;
  });
  const auto see = [&](const control::Progress& now) {
    has_points = now.points > 0;
    return true;
  };
  observables::parameter_response(s, range, controls::reporting(see, count));
  CHECK(before_points > 100);  // the first response, and the branch over the frequency to the others
  for (const long last : {1L, 10L, before_points / 2, before_points, (before_points + asked) / 2}) {
    long here = 0;
    const auto branches =
        observables::parameter_response(s, range, controls::polled([&] { return ++here < last; }));
    CAPTURE(last);
    CHECK(here == last);  // never asked again
    REQUIRE(branches.size() == 1);
    CHECK(branches[0].status == observables::Status::stopped);
    CHECK(branches[0].stop.reason == observables::reasons::user);
    CHECK(branches[0].points.empty() == (last <= before_points));
  }
}

TEST_CASE("no study speaks of a Jacobian to the user of a scene") {
  scene::Scene s = scenes::paper(7, 3);
  scene::set(s, "damper.stiffness", 1e32);
  for (const auto& branch :
       observables::parameter_response(s, parameter_range("damper.normal_load", 20, 1, 100))) {
    CAPTURE(branch.stop.message);
    CHECK(branch.stop.message.find("Jacobian") == std::string::npos);
    CHECK(branch.stop.message.find("make damper.stiffness smaller") != std::string::npos);
  }
  for (const auto& branch : observables::resonance_peaks(s, {"damper.normal_load", 1, 100, 18, 22})) {
    CAPTURE(branch.stop.message);
    CHECK(branch.stop.message.find("Jacobian") == std::string::npos);
    CHECK(branch.stop.message.find("make damper.stiffness smaller") != std::string::npos);
  }
}

TEST_CASE("where the resonance is unbounded at the fixed frequency, a branch says so instead of a start") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.5, "friction_coefficient": 0.5,
      "normal_load": 0.1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "harmonics": {"order": 3}, "response": {"at": "x"},
    "studies": [{"kind": "frf", "from": 0.2, "to": 3}]})");
  const auto branch = observables::parameter_response(s, parameter_range("d.normal_load", 1, 0.1, 3)).front();
  CHECK(branch.status == observables::Status::failed);
  CHECK(branch.stop.reason == observables::reasons::start_failed);
  CHECK(branch.stop.message.find("unbounded") != std::string::npos);
}
