// One design for several cases.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/observables/reference.hpp"

#include <arcslip/optimize/optimum_study.hpp>
#include <arcslip/optimize/robust.hpp>

#include <cmath>

using namespace arcslip;
using optimize::Robust;
constexpr double pi = std::numbers::pi;

namespace {

const optimize::OptimumProblem over_load{{{"damper.normal_load", 0.1, 100}}, 18, 22};

// c = 0, one harmonic: kd A = p^2/(p - q), p = mu Fn, q = pi f0/4.
scene::Scene closed_form() {
  scene::Scene s = scenes::paper(1, 5);
  scene::set(s, "c.value", 0);
  return s;
}

double peak(double p, double f0) {
  return p * p / (p - pi * f0 / 4) / 3500;
}

}  // namespace

TEST_CASE("a friction coefficient between 0.4 and 0.6: both ends have the same peak at the best load") {
  const auto found = optimize::robust_optimum(
      closed_form(), over_load,
      {{{{"damper.friction_coefficient", 0.4}}}, {{{"damper.friction_coefficient", 0.6}}}}, Robust::worst);
  CHECK(found.status == observables::Status::complete);
  // 0.16/(0.4 F - q) = 0.36/(0.6 F - q) at F = q/0.24.
  const double load = pi / 4 / 0.24;
  CHECK(reference::error(found.design[0], load) < 1e-7);
  CHECK(reference::error(found.value, peak(0.4 * load, 1)) < 1e-8);
  CHECK(reference::error(found.amplitudes[0], found.amplitudes[1]) < 1e-7);
}

TEST_CASE("the best load for the worst of several levels of excitation is that of the highest") {
  const auto found = optimize::robust_optimum(
      closed_form(), over_load, {{{{"force.cosine", 0.5}}}, {{{"force.cosine", 1}}}}, Robust::worst);
  CHECK(reference::error(found.design[0], pi) < 1e-6);
  CHECK(reference::error(found.value, peak(pi / 2, 1)) < 1e-10);
}

TEST_CASE("a start of a robust search outside the bounds is moved, and that is said") {
  scene::Scene s = closed_form();
  scene::set(s, "damper.normal_load", 200);
  const auto found = optimize::robust_optimum(s, over_load, {{{{"force.cosine", 1}}}}, Robust::worst);
  CHECK(reference::error(found.design[0], pi) < 1e-6);
  REQUIRE(found.notes.size() == 1);
  CHECK(found.notes[0].find("was moved to 100") != std::string::npos);
}

TEST_CASE("the best load for the weighted mean over levels is where the mean's derivative vanishes") {
  const auto found = optimize::robust_optimum(
      closed_form(), over_load, {{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}, Robust::mean);
  CHECK(found.status == observables::Status::complete);
  const auto mean = [](double p) { return (3 * peak(p, 0.5) + peak(p, 1)) / 4; };
  CHECK(reference::error(found.value, mean(0.5 * found.design[0])) < 1e-10);
  const double p = 0.5 * found.design[0];
  const auto slope = [&](double f0) {
    const double q = pi * f0 / 4;
    return p * (p - 2 * q) / ((p - q) * (p - q));
  };
  CHECK(std::abs(3 * slope(0.5) + slope(1)) < 1e-6);
}

TEST_CASE("a case in which the start is unbounded, and cases that make no sense, are told") {
  const scene::Scene s = closed_form();
  const auto found = optimize::robust_optimum(
      s, over_load, {{{{"force.cosine", 1}}}, {{{"force.cosine", 10}}}}, Robust::worst);
  CHECK(found.status == observables::Status::failed);
  CHECK(found.stop.reason == "unbounded");
  const auto error_of = [&](const std::vector<optimize::RobustCase>& cases) {
    try {
      optimize::robust_optimum(s, over_load, cases, Robust::mean);
    } catch (const optimize::OptionsError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(error_of({}) == "there is no case");
  CHECK(error_of({{{}, 0}}) == "the weight of a case is 0, must be above 0");
  CHECK(error_of({{{{"damper.normal_load", 3}}}}) ==
        "a case sets \"damper.normal_load\", which the search is over");
}

TEST_CASE("the optimal load grows in proportion to the excitation, and not where a spring hardens") {
  scene::Study study;
  study.kind = scene::StudyKind::optimum;
  study.design = {{"damper.normal_load", 0.1, 100}};
  study.frequency_from = 18;
  study.frequency_to = 22;
  study.for_each = {{"force.cosine", {1, 2, 4}}};
  const auto loads = [&](const scene::Scene& s) {
    std::vector<double> all;
    for (const auto& result : optimize::optimum_study(s, study)) {
      CHECK(result.status == observables::Status::complete);
      if (result.direct.found) CHECK(result.difference_of_design() < 1e-6);
      all.push_back(result.optimum.design[0]);
    }
    return all;
  };
  const scene::Scene s = scenes::paper(5);
  const auto linear = loads(s);
  REQUIRE(linear.size() == 3);
  CHECK(reference::error(linear[1], 2 * linear[0]) < 1e-7);
  CHECK(reference::error(linear[2], 4 * linear[0]) < 1e-7);
  scene::Scene hardening = s;
  hardening.elements.push_back({"spring", &scene::cubic_spring_type, s.elements[0].direction, {5e7}, 1});
  const auto bent = loads(hardening);
  REQUIRE(bent.size() == 3);
  const auto highest = [&](double load) {  // of a new response
    scene::Scene at = hardening;
    scene::set(at, "force.cosine", 4);
    scene::set(at, "damper.normal_load", load);
    double most = 0;
    for (const auto& branch : observables::frequency_response(at, at.studies[0]))
      for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
    return most;
  };
  CHECK(highest(0.99 * bent[2]) > highest(bent[2]));
  CHECK(highest(1.01 * bent[2]) > highest(bent[2]));
  CHECK(reference::error(bent[2], 4 * bent[0]) > 1e-3);
}
