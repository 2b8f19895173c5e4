// How far the harmonics left out move an optimum, next to searches with more harmonics.

#include "catch.hpp"
#include "controls.hpp"

#include "optimize/paper_optimum.hpp"
#include "optimize/row.hpp"

#include <arcslip/optimize/certificate/certify.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <cmath>
#include <memory>

using namespace arcslip;
using optimize::Criterion, optimize::OptimumProblem;

namespace {

// Error of the design with a few harmonics, and its estimate.
struct Moved {
  std::vector<double> error, estimate;
  bool flagged;
};

Moved moved(scene::Scene s, const OptimumProblem& problem, int few, int many) {
  s.harmonics.order = few;
  const auto found = optimize::optimum(s, problem);
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  REQUIRE(found.certificate);
  for (std::size_t k = 0; k < found.design.size(); ++k) scene::set(s, problem.over[k].name, found.design[k]);
  s.harmonics.order = many;
  const auto exact = optimize::optimum(s, problem, {.certificate = false});
  CHECK(exact.status == observables::Status::complete);
  Moved all{{}, found.certificate->design_estimate, found.certificate->design_flagged};
  for (std::size_t k = 0; k < found.design.size(); ++k)
    all.error.push_back(std::abs(found.design[k] - exact.design[k]));
  return all;
}

void check(const Moved& of, double within = 0.25) {
  REQUIRE(of.estimate.size() == of.error.size());
  CHECK_FALSE(of.flagged);
  for (std::size_t k = 0; k < of.error.size(); ++k) {
    CAPTURE(k, of.error[k], of.estimate[k]);
    // A design at its bound is there to rounding.
    CHECK(of.estimate[k] == Approx(of.error[k]).epsilon(within).margin(1e-14));
  }
}

OptimumProblem in_cases(std::vector<optimize::LoadCase> cases, Criterion criterion = Criterion::worst) {
  OptimumProblem problem = paper_optimum::over_load;
  problem.cases = std::move(cases);
  problem.criterion = criterion;
  return problem;
}

}  // namespace

TEST_CASE("the estimate of the best load is what more harmonics change, and falls with theirs") {
  for (const int order : {3, 5, 9, 15}) check(moved(scenes::paper(1), paper_optimum::over_load, order, 101));
}

TEST_CASE("the estimate of a load at which two cases are equally high, or their mean is least") {
  const auto s = paper_optimum::closed_form();
  const OptimumProblem crossing =
      in_cases({{{{"damper.friction_coefficient", 0.4}}}, {{{"damper.friction_coefficient", 0.6}}}});
  check(moved(s, crossing, 5, 101));
  check(moved(s, in_cases({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}), 5, 101));
  check(moved(s, in_cases({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}, Criterion::mean), 5,
              101));
}

TEST_CASE("the estimates of two loads, with as many equal peaks or fewer") {
  check(moved(row(2, 2, 5), over_loads(2, 8, 45), 7, 61), 0.05);  // 1/12 with a wrong sign
  // At a bound of one of them.
  OptimumProblem bounded = over_loads(2, 8, 45);
  bounded.over[0].upper = 0.5;
  const Moved at_bound = moved(row(2, 2, 5), bounded, 7, 61);
  REQUIRE(at_bound.estimate.size() == 2);
  check(at_bound);
}

TEST_CASE(
    "where a limit is active the estimate of the design is not known, and it is said where it is doubtful") {
  OptimumProblem limited = paper_optimum::over_load;
  limited.limits = {{"damper.stick_percent", 60, HUGE_VAL}};
  auto s = scenes::paper(5);
  const auto found = optimize::optimum(s, limited);
  REQUIRE(found.certificate);
  CHECK_FALSE(found.certificate->limits.empty());
  CHECK(found.certificate->design_estimate.empty());

  // Nothing bounds the resonance of a light mass at 2000 Hz.
  s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
    "structure": {"dofs": ["blade", "tip"],
      "masses": [{"name": "m", "at": "blade", "value": 1.24}, {"name": "light", "at": "tip", "value": 1e-4}],
      "springs": [{"name": "k", "at": "blade", "value": 17890}, {"name": "stiff", "between": ["blade", "tip"], "value": 15791}],
      "dampers": [{"name": "c", "at": "blade", "value": 0.134}]},
    "elements": [{"name": "damper", "type": "jenkins", "at": "blade", "stiffness": 3500, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "force", "at": "blade", "cosine": 1}], "harmonics": {"order": 3}, "response": {"at": "tip"},
    "studies": [{"kind": "frf", "from": 18, "to": 22}]})");
  const auto doubtful = optimize::optimum(s, paper_optimum::over_load);
  REQUIRE(doubtful.certificate);
  CHECK(doubtful.certificate->design_flagged == doubtful.point.truncation_flagged);
  CHECK(doubtful.certificate->design_flagged);
}

TEST_CASE("a stop in the middle of the estimate leaves it unknown") {
  const auto model = std::make_shared<const model::Model>(model::build(scenes::paper(5)));
  optimize::LoadCases cases(Criterion::worst);
  cases.add(std::make_unique<optimize::PeakAmplitude>(
                model, std::vector{model::parameter_index(*model, "damper.normal_load")},
                observables::FrequencyWindow{18 * scenes::hertz, 22 * scenes::hertz}),
            1);
  const double lower = 0.1, upper = 100;
  cases.trace(std::vector{3.09});
  const auto balance = optimize::balance(cases, {&lower, 1}, {&upper, 1}, {});
  CHECK(optimize::design_estimate(cases, balance).change.size() == 1);
  CHECK(optimize::design_estimate(cases, balance, controls::stopped()).change.empty());
}
