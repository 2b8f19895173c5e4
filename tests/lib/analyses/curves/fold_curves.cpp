// Curves of folds over a parameter.

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using observables::ResponseBranch;

namespace {

scene::Scene duffing(double force) {
  scene::Scene s = scenes::example("duffing");
  scene::set(s, "c.value", 0.1);
  scene::set(s, "hardening.stiffness", 1);
  scene::set(s, "force.cosine", force);
  s.harmonics.order = 1;
  return s;
}

}  // namespace

TEST_CASE("both folds of the Duffing oscillator lie on one curve over the force, with a cusp between them") {
  const auto branches = observables::fold_curves(duffing(1), {"force.cosine", 0.1, 0.01, 0.5, 2});
  REQUIRE(branches.size() == 1);
  const ResponseBranch& curve = branches[0];
  CHECK(curve.status == observables::Status::complete);
  CHECK(curve.over == "force.cosine");
  CHECK(std::abs(curve.points.front().omega - 1.227095772) < 1e-9);
  CHECK(std::abs(curve.points.back().omega - 1.157717746) < 1e-9);
  CHECK(curve.points.front().over == 0.1);
  CHECK(curve.points.back().over == 0.1);
  CHECK(curve.solver.linear_solver == "block elimination in the branch's factors");
  REQUIRE(curve.events.size() == 1);
  CHECK(curve.events[0].kind == "cusp");
  CHECK(std::abs(curve.events[0].point.omega - 1.090345535) < 1e-9);
  CHECK(std::abs(curve.events[0].point.over - 0.0515845499) < 1e-10);
}

TEST_CASE("a fold curve of the Duffing oscillator solves dg/dA = 0 of its closed form") {
  // g^2 = A^2 ((1 - w^2 + 3/4 A^2)^2 + 0.01 w^2), and at folds in w its derivative by A^2 vanishes.
  const auto branches = observables::fold_curves(duffing(1), {"force.cosine", 0.06, 0.3, 0.5, 4});
  REQUIRE(branches.size() == 2);
  for (const ResponseBranch& curve : branches) {
    CAPTURE(curve.stop.message);
    CHECK(curve.status == observables::Status::complete);
    CHECK(curve.points.back().over == 0.3);
    for (const auto& point : curve.points) {
      const double y = point.amplitude * point.amplitude, w2 = point.omega * point.omega;
      const double detuning = 1 - w2 + 0.75 * y;
      CHECK(std::abs(y * (detuning * detuning + 0.01 * w2) / (point.over * point.over) - 1) < 1e-9);
      CHECK(std::abs(detuning * detuning + 0.01 * w2 + 1.5 * y * detuning) < 1e-9);
    }
  }
}

TEST_CASE("folds of the Jenkins and Duffing oscillator over the load, and where they turn in the frequency") {
  const auto branches =
      observables::fold_curves(scenes::duffing_jenkins(), {"d.normal_load", 0.8, 3, 0.5, 4});
  REQUIRE(branches.size() >= 2);
  CHECK(std::abs(branches[0].points.front().omega - 2.1150531362) < 1e-9);
  CHECK(std::abs(branches[1].points.front().omega - 1.5063740448) < 1e-9);
  std::vector<observables::ResponsePoint> turns;
  for (const auto& event : branches[0].events)
    if (event.kind == "turn") turns.push_back(event.point);
  REQUIRE(turns.size() == 1);
  CHECK(std::abs(turns[0].omega - 1.911489205) < 1e-9);
  CHECK(std::abs(turns[0].over - 1.215318824) < 1e-8);
  CHECK(branches[0].status == observables::Status::complete);
  // The other fold goes through a cusp and along the corner to full stick, which no load changes any more: it
  // is the upper fold of x'' + 0.02 x' + 1.5 x + 0.5 x^3, whose amplitude is where it leaves the corner.
  const ResponseBranch& stuck = branches[1];
  CAPTURE(stuck.stop.message);
  CHECK(stuck.status == observables::Status::complete);
  std::vector<std::string> kinds;
  for (const auto& event : stuck.events) kinds.push_back(event.kind);
  CHECK(kinds == std::vector<std::string>{"cusp", "corner", "corner"});
  const auto& end = stuck.points.back();
  CHECK(end.over == 3);
  const double y = end.amplitude * end.amplitude, w2 = end.omega * end.omega;
  const double detuning = 1.5 - w2 + 0.375 * y;
  CHECK(std::abs(y * (detuning * detuning + 4e-4 * w2) / 0.25 - 1) < 1e-9);
  CHECK(std::abs(detuning * detuning + 4e-4 * w2 + 0.75 * y * detuning) < 1e-9);
  CHECK(end.elements[1].stick_percent == 100);
}
