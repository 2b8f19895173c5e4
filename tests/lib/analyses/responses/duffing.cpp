#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

using namespace arcslip;

namespace {

std::vector<observables::ResponseEvent> folds(const observables::ResponseBranch& branch) {
  std::vector<observables::ResponseEvent> found;
  for (const auto& event : branch.events)
    if (event.kind == "fold") found.push_back(event);
  return found;
}

scene::Scene duffing_example(double damping, double cubic, double force, int order, double to) {
  scene::Scene s = scenes::example("duffing");
  scene::set(s, "c.value", damping);
  scene::set(s, "hardening.stiffness", cubic);
  scene::set(s, "force.cosine", force);
  s.harmonics.order = order;
  scenes::window(s).to = to;
  return s;
}

}  // namespace

TEST_CASE("both folds of the Duffing oscillator of NLvib example 01 are found to 1e-9") {
  const scene::Scene s = duffing_example(0.05, 0.1, 0.18, 15, 1.6);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  CHECK(branches[0].solver.linear_solver == "dense LU");
  const auto found = folds(branches[0]);
  REQUIRE(found.size() == 2);
  CHECK(reference::error(found[0].point.omega, 1.269601955546) < 1e-9);
  CHECK(reference::error(found[1].point.omega, 1.115700251771) < 1e-9);
  CHECK(reference::error(found[0].point.amplitude, 2.871574832) < 1e-9);
  CHECK(reference::error(found[1].point.amplitude, 1.0850358251) < 1e-9);
  for (const auto& fold : found) CHECK_FALSE(fold.nonsmooth);
}

TEST_CASE(
    "with one harmonic the folds are those of the closed form, with many those of the differential "
    "equation") {
  const auto one = folds([] {
    const scene::Scene s = duffing_example(0.1, 1, 0.1, 1, 2);
    return observables::frequency_response(s, scenes::window(s)).front();
  }());
  REQUIRE(one.size() == 2);
  CHECK(std::abs(one[0].point.omega - 1.227095772) < 1e-9);
  CHECK(std::abs(one[1].point.omega - 1.157717746) < 1e-9);
  CHECK(std::abs(one[0].point.amplitude - 0.808418576) < 1e-8);
  CHECK(std::abs(one[1].point.amplitude - 0.424611125) < 1e-8);
  for (int order : {9, 15, 35}) {
    const scene::Scene s = duffing_example(0.1, 1, 0.1, order, 2);
    const auto many = folds(observables::frequency_response(s, scenes::window(s)).front());
    REQUIRE(many.size() == 2);
    CHECK(std::abs(many[0].point.omega - 1.2287354913) < 1e-9);
    CHECK(std::abs(many[1].point.omega - 1.1579517117) < 1e-9);
  }
}

TEST_CASE("the Jenkins and Duffing oscillator folds where its describing function does") {
  const scene::Scene s = scenes::duffing_jenkins();
  const auto found = folds(observables::frequency_response(s, scenes::window(s)).front());
  REQUIRE(found.size() == 2);
  CHECK(reference::error(found[0].point.omega, 2.1150531362) < 1e-9);
  CHECK(reference::error(found[1].point.omega, 1.5063740448) < 1e-9);
}
