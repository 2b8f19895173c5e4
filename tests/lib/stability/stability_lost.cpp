// Where stability is lost at the birth of slip or of contact, next to folds that explain it or do not.
#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/stability/with_stability.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using with_stability::events, with_stability::response;

TEST_CASE("a loss of stability next to a fold that does not explain it is reported") {
  // Two oscillators that nothing couples: a Duffing oscillator, and one that is self-excited in stick and
  // stable in slip, whose slip is born 1e-9 above the force of the second fold.
  const auto two = [&](double limit) {
    auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", )" +
                           scenes::uncoupled({{"a", 1, 5, 0}, {"b", 1, 1, 0.1}}) + R"(,
      "elements": [{"name": "feed", "type": "van_der_pol", "at": "a", "coefficient": 0.02, "amplitude": 1e6},
        {"name": "damper", "type": "jenkins", "at": "a", "stiffness": 1, "friction_coefficient": 1,
         "normal_load": 1},
        {"name": "cubic", "type": "cubic_spring", "at": "b", "stiffness": 0.1}],
      "excitation": [{"name": "force", "at": "b", "cosine": 1}], "response": {"at": "a"},
      "harmonics": {"order": 9}})");
    s.excitation[0].directions = {{{0, 1.0}, {1, 1.0}}};
    scene::set(s, "damper.normal_load", limit);
    return observables::parameter_response(s, {"force.cosine", 0.2, 3, 1.4, true}).at(0);
  };
  const double stuck = std::hypot(5 + 1 - 1.4 * 1.4, 0.02 * 1.4);
  const auto folds = events(two(1e3), "fold");
  REQUIRE(folds.size() == 2);
  const double force = folds[1].point.over * (1 + 1e-9);
  const auto branch = two(force / stuck);
  const auto lost = events(branch, "stability_lost");
  REQUIRE(lost.size() == 2);  // and once before, far from the folds
  for (const auto& event : lost) CHECK(reference::error(event.point.over, force) < 1e-7);
  CHECK(events(branch, "fold").size() == 2);
}

TEST_CASE("where the birth of slip is a fold, the fold reports the multiplier that becomes unstable") {
  // Two masses, the first one fed, the second one damped, stable in stick. The force at the first one is |D|
  // A with its dynamic stiffness D of the stuck structure; slip adds 4i/pi k_t (A - A_0), which makes that
  // fall: |D|^2 + 4/pi k_t Im D < 0.
  const double w = 3.1, kt = 6;
  const std::complex<double> second(7.5 - w * w, 0.5 * w);
  const std::complex<double> D = std::complex<double>(8.5 - w * w, -0.2 * w) - 1.5 * 1.5 / second;
  REQUIRE(std::norm(D) + 4 / std::acos(-1.0) * kt * D.imag() < 0);
  const auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "at": "b", "value": 6},
                  {"name": "kab", "between": ["a", "b"], "value": 1.5}],
      "dampers": [{"name": "cb", "at": "b", "value": 0.5}]},
    "elements": [{"name": "feed", "type": "van_der_pol", "at": "a", "coefficient": 0.2, "amplitude": 1e5},
      {"name": "damper", "type": "jenkins", "at": "a", "stiffness": 6, "friction_coefficient": 0.5,
       "normal_load": 12}],
    "excitation": [{"name": "force", "at": "a", "cosine": 1}], "response": {"at": "a"},
    "harmonics": {"order": 9}})");
  const auto branches = observables::parameter_response(s, {"force.cosine", 0.05, 2, w, true});
  REQUIRE(branches.size() == 1);
  const auto& branch = branches[0];
  const auto folds = events(branch, "fold");
  REQUIRE(folds.size() == 2);
  CHECK(folds[0].nonsmooth);
  CHECK(reference::error(folds[0].point.over, std::abs(D)) < 1e-9);  // A_0 = 1 m
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const bool between = i > folds[0].after && i <= folds[1].after;
    CHECK(branch.points[i].stability->unstable == (between ? 1 : 0));
  }
  CHECK(std::abs(branch.points[folds[0].after + 1].stability->multipliers.front()) > 1.01);
  CHECK(events(branch, "stability_lost").empty());
}

TEST_CASE("at a fold just after grazing a multiplier goes steeply through 1, and the fold alone reports it") {
  // Next to grazing it grows like a root of the amplitude.
  const auto s = scenes::example("unilateral_oscillator");
  for (const double from : {0.3, 0.37, 0.45, 0.62}) {
    CAPTURE(from);
    const auto branch = response(s, from, 0.9);
    const auto folds = events(branch, "fold");
    REQUIRE_FALSE(folds.empty());
    CHECK(reference::error(folds.back().point.omega, 0.6534401344692) < 1e-10);
    CHECK(events(branch, "stability_lost").empty());
  }
}

TEST_CASE("where slip is born, a self-excited structure that is unstable in stick becomes stable at once") {
  // A force c x' along the motion; in stick the multipliers are exp(c T/2m) in size. The birth of slip is at
  // the amplitude limit/k_t of the stuck structure.
  const double c = 0.05, m = 1.24, k = 17890 + 3500, hertz = 25;
  const auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1.24}],
      "springs": [{"name": "k", "at": "x", "value": 17890}]},
    "elements": [{"name": "feed", "type": "van_der_pol", "at": "x", "coefficient": 0.05, "amplitude": 1e3},
      {"name": "damper", "type": "jenkins", "at": "x", "stiffness": 3500, "friction_coefficient": 0.5,
       "normal_load": 3}],
    "excitation": [{"name": "force", "at": "x", "cosine": 1}], "response": {"at": "x"},
    "harmonics": {"order": 9}})");
  const auto branches = observables::parameter_response(s, {"force.cosine", 0.05, 10, hertz, true});
  REQUIRE(branches.size() == 1);
  const auto lost = events(branches[0], "stability_lost");
  REQUIRE(lost.size() == 1);
  CHECK(lost[0].nonsmooth);
  const double omega = hertz * scenes::hertz;
  const double amplitude = 3 * 0.5 / 3500;
  const double force = amplitude * std::hypot(k - m * omega * omega, c * omega);
  CHECK(reference::error(lost[0].point.over, force) < 1e-8);
  for (const auto& point : branches[0].points) {
    if (point.over > 2 * force) continue;
    CHECK(point.stability->unstable == (point.over < force ? 2 : 0));
  }
}
