// One design for several cases.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/observables/reference.hpp"

#include <arcslip/optimize/optimum_study.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;
using scene::Criterion;
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

optimize::OptimumProblem over_load_in(const std::vector<scene::DesignCase>& cases,
                                      Criterion criterion = Criterion::worst) {
  optimize::OptimumProblem problem = over_load;
  problem.cases = cases;
  problem.criterion = criterion;
  return problem;
}

}  // namespace

TEST_CASE("a friction coefficient between 0.4 and 0.6: both ends have the same peak at the best load") {
  const auto found = optimize::optimum(closed_form(), over_load_in({{{{"damper.friction_coefficient", 0.4}}},
                                                                    {{{"damper.friction_coefficient", 0.6}}}},
                                                                   Criterion::worst));
  CHECK(found.status == observables::Status::complete);
  // 0.16/(0.4 F - q) = 0.36/(0.6 F - q) at F = q/0.24.
  const double load = pi / 4 / 0.24;
  CHECK(reference::error(found.design[0], load) < 1e-7);
  CHECK(reference::error(found.amplitude, peak(0.4 * load, 1)) < 1e-8);
  CHECK(reference::error(found.cases[0].amplitude, found.cases[1].amplitude) < 1e-7);
}

TEST_CASE("the best load for the worst of several levels of excitation is that of the highest") {
  const auto found = optimize::optimum(
      closed_form(), over_load_in({{{{"force.cosine", 0.5}}}, {{{"force.cosine", 1}}}}, Criterion::worst));
  CHECK(reference::error(found.design[0], pi) < 1e-6);
  CHECK(reference::error(found.amplitude, peak(pi / 2, 1)) < 1e-10);
}

TEST_CASE("a start of a robust search outside the bounds is moved, and that is said") {
  scene::Scene s = closed_form();
  scene::set(s, "damper.normal_load", 200);
  const auto found = optimize::optimum(s, over_load_in({{{{"force.cosine", 1}}}}, Criterion::worst));
  CHECK(reference::error(found.design[0], pi) < 1e-6);
  REQUIRE(found.notes.size() == 1);
  CHECK(found.notes[0].find("was moved to 100") != std::string::npos);
}

TEST_CASE("the best load for the weighted mean over levels is where the mean's derivative vanishes") {
  const auto found = optimize::optimum(
      closed_form(),
      over_load_in({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}, Criterion::mean));
  CHECK(found.status == observables::Status::complete);
  const auto mean = [](double p) { return (3 * peak(p, 0.5) + peak(p, 1)) / 4; };
  CHECK(reference::error(found.amplitude, mean(0.5 * found.design[0])) < 1e-10);
  const double p = 0.5 * found.design[0];
  const auto slope = [&](double f0) {
    const double q = pi * f0 / 4;
    return p * (p - 2 * q) / ((p - q) * (p - q));
  };
  CHECK(std::abs(3 * slope(0.5) + slope(1)) < 1e-6);
}

TEST_CASE("a start that is unbounded in one case is moved to where it is finite in all, and that is said") {
  scene::Scene s = closed_form();
  scene::set(s, "damper.normal_load", 2);  // mu Fn = 1 is above pi/4, and below pi/2
  const auto found = optimize::optimum(s, over_load_in({{{{"force.cosine", 1}}}, {{{"force.cosine", 2}}}}));
  CHECK(found.status == observables::Status::complete);
  CHECK(reference::error(found.design[0], 2 * pi) < 1e-6);
  REQUIRE(found.notes.size() == 1);
  CHECK(found.notes[0].find("the start damper.normal_load = 2 was moved to damper.normal_load = ") == 0);
  CHECK(found.notes[0].find(": in case 2: the resonance is unbounded") != std::string::npos);
}

TEST_CASE("bounds within which a case is unbounded everywhere leave nothing to be found, and that is said") {
  const auto found =
      optimize::optimum(closed_form(), over_load_in({{{{"force.cosine", 1}}}, {{{"force.cosine", 100}}}}));
  CHECK(found.status == observables::Status::failed);
  CHECK(found.stop.reason == "unbounded");
  CHECK(found.stop.message.find("no start was found within the bounds") == 0);
  CHECK(found.cases.empty());
}

TEST_CASE("cases that make no sense are told") {
  const scene::Scene s = closed_form();
  const auto error_of = [&](const scene::DesignCase& one) {
    try {
      optimize::optimum(s, over_load_in({{}, one}));
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(error_of({{}, 0}) == "the weight of a case is 0, must be above 0");
  CHECK(error_of({{}, -1}) == "the weight of a case is -1, must be above 0");
  CHECK(error_of({{}, HUGE_VAL}) == "the weight of a case is inf, must be above 0");
  CHECK(error_of({{{"damper.normal_load", 3}}}) ==
        "a case sets \"damper.normal_load\", which the search is over");
  CHECK(error_of({{{"damper.normal_laod", 3}}}).find("damper.normal_load") != std::string::npos);
  CHECK(error_of({{{"damper.stiffness", -1}}}).find("damper.stiffness") != std::string::npos);
  CHECK(error_of({{}, 1, scene::Direction{}}) == "the response of a case is at no degree of freedom");
  CHECK(error_of({{}, 1, scene::Direction{{0, 0}}}) == "the response of a case is at no degree of freedom");
  CHECK(error_of({{}, 1, scene::Direction{{1, 1}}}) ==
        "the response of a case is at degree of freedom 1 of 1");
  auto direct = over_load_in({{}});
  CHECK_THROWS_WITH(optimize::direct_optimum(s, direct),
                    "the direct way takes no cases, and nothing that scatters");
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
