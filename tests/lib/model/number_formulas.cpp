// Numbers of models that are formulas of parameters: their derivatives, in harmonics and in time.
#include <arcslip/hbm/problem.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/time/equation/parameter_derivatives.hpp>

#include <cmath>

#include "catch.hpp"
#include "lib/hbm/scenes.hpp"

using namespace arcslip;
using continuation::Needs;
using Eigen::VectorXd;

namespace {

// Every kind of number follows s, t or another formula, smoothly and with curvature.
scene::Scene with_formulas() {
  return scenes::parse(R"x({"format": "arcslip-scene-2", "frequency_unit": "rad/s",
    "constants": {"s": 0.7, "t": {"value": 1.3, "unit": "m"}, "both": "s^2*exp(0.3*t)"},
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": "1 + s^2"}, {"name": "mb", "at": "b", "value": "1*exp(s)"}],
      "springs": [{"name": "ka", "at": "a", "value": "2*both"}, {"name": "kb", "between": ["a", "b"], "value": 3}],
      "dampers": [{"name": "c", "at": "a", "value": "0.1*sqrt(ka*ma)"}],
      "damping": [{"name": "rayleigh", "type": "rayleigh", "alpha": "0.02*s", "beta": "0.01*both"}]},
    "elements": [
      {"name": "d", "type": "jenkins", "at": "b", "stiffness": "0.5*kb/s", "normal_load": "both + s",
       "friction_coefficient": 0.4},
      {"name": "n", "type": "cubic_spring", "at": "a", "stiffness": "sin(s)*ka/t^2"}],
    "excitation": [{"name": "f", "at": "a", "cosine": "3*s^3", "sine": "both"},
                   {"name": "g", "type": "base_acceleration", "cosine": "0.1*s"}],
    "harmonics": {"order": 5}, "response": {"at": "b"}})x");
}

double length(const VectorXd& v) {
  return v.norm();
}

}  // namespace

TEST_CASE("derivatives of the residual by a parameter go through all formulas") {
  const scene::Scene s = with_formulas();
  const auto model = std::make_shared<const model::Model>(model::build(s));
  CHECK(model->formulas.size() == 12);
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const auto evaluator = problem.hbm_evaluator();
  VectorXd p = hbm::parameters_at(problem, 1.1);
  const VectorXd u = VectorXd::LinSpaced(problem.size(), -1.5, 2);
  for (const char* name : {"s", "t", "kb.value"}) {
    CAPTURE(name);
    const int k = model::parameter_index(*model, name);
    VectorXd by(problem.size());
    REQUIRE(evaluator->move_to(u, p, Needs::jacobian) == continuation::Evaluated::ok);
    evaluator->parameter_derivative(k, by);
    const auto at = [&](double h) {
      VectorXd moved = p;
      moved[k] += h;
      REQUIRE(evaluator->move_to(u, moved, Needs::residual) == continuation::Evaluated::ok);
      return VectorXd(evaluator->residual());
    };
    const double h = 1e-5;  // fourth order; events of the friction element do not change within it
    const VectorXd difference = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    CHECK(length(by) > 0.1);
    CHECK(length(by - difference) < 1e-8 * length(by));
  }
}

TEST_CASE("a residual with formulas is that with their values") {
  const scene::Scene s = with_formulas();
  scene::Scene plain = s;
  for (auto* section :
       {&plain.masses, &plain.springs, &plain.dampers, &plain.damping, &plain.elements, &plain.excitation})
    for (scene::Part& part : *section) part.texts.clear();
  plain.constants.clear();
  const auto residual = [](const scene::Scene& of) {
    const auto model = std::make_shared<const model::Model>(model::build(of));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    const auto evaluator = problem.hbm_evaluator();
    evaluator->move_to(VectorXd::LinSpaced(problem.size(), -1, 2), hbm::parameters_at(problem, 1.1),
                       Needs::residual);
    return VectorXd(evaluator->residual());
  };
  CHECK(length(residual(s) - residual(plain)) < 1e-14 * length(residual(plain)));
}

TEST_CASE("derivatives of the equation in time by a parameter go through all formulas") {
  const model::Model model = model::build(with_formulas());
  const VectorXd p = model::defaults(model);
  for (const char* name : {"s", "t"}) {
    CAPTURE(name);
    const int k = model::parameter_index(model, name);
    const auto rates = time::equation_rates(model, p, k);
    REQUIRE(rates);
    const auto by = [&](auto&& matrix) {
      const auto at = [&](double h) {
        VectorXd moved = p;
        moved[k] += h;
        return Eigen::MatrixXd(matrix(model, moved));
      };
      const double h = 1e-3;
      return Eigen::MatrixXd((8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h));
    };
    const auto check = [](const Eigen::MatrixXd& found, const Eigen::MatrixXd& wanted) {
      const Eigen::MatrixXd rate = found.size() > 0 ? found : Eigen::MatrixXd::Zero(wanted.rows(), wanted.cols());
      CHECK((rate - wanted).norm() < 1e-9 * (1 + wanted.norm()));
    };
    check(rates->M, by(model::mass_matrix));
    check(rates->C, by(model::damping_matrix));
    check(rates->K, by(model::stiffness_matrix));
  }
}

TEST_CASE("a number that leaves its bounds along a curve is outside of the domain") {
  scene::Scene s = scenes::paper(3);
  scenes::tie(s, "shift", {"damper.stiffness"});
  scene::set_text(s, "damper.stiffness", "shift - 1000");
  const auto model = std::make_shared<const model::Model>(model::build(s));
  VectorXd p = model::defaults(*model);
  CHECK(model::within_bounds(*model, p));
  p[model::parameter_index(*model, "shift")] = 999;
  CHECK_FALSE(model::within_bounds(*model, p));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const auto evaluator = problem.hbm_evaluator();
  VectorXd all = hbm::parameters_at(problem, 100);
  all[model::parameter_index(*model, "shift")] = 999;
  CHECK(evaluator->move_to(VectorXd::Zero(problem.size()), all, Needs::residual) ==
        continuation::Evaluated::outside_domain);
}
