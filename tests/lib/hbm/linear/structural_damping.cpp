// Damping of a whole structure: Rayleigh, by a loss factor, and by a ratio of each mode.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/reasons.hpp>

#include <cmath>
#include <complex>

using namespace arcslip;
using continuation::Vector;

namespace {

using Complex = std::complex<double>;

// Three masses without elements.
scene::Scene linear_chain() {
  scene::Scene s = scenes::chain(3, false);
  s.elements.clear();
  s.dampers.clear();
  return s;
}

scene::Part damping(const scene::PartType& type, std::vector<double> values) {
  return {"steel", &type, {}, std::move(values)};
}

// The amplitude of the response of harmonic balance at w.
Complex amplitude(const scene::Scene& s, double w) {
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const Vector p = hbm::parameters_at(problem, w);
  const auto at = problem.hbm_evaluator();
  const Vector u = hbm::linear_response(problem, p);
  REQUIRE(at->move_to(u, p, continuation::Needs::residual) == continuation::Evaluated::ok);
  Vector x(problem.harmonics().size());
  at->stiffness().response(u, 1, x);
  return {x[problem.harmonics().cosine_index(1)], -x[problem.harmonics().sine_index(1)]};
}

struct Matrices {
  Eigen::MatrixXd M, K;
  Eigen::VectorXcd f;
  Eigen::VectorXd response;
};
Matrices matrices(const scene::Scene& s) {
  const model::Model model = model::build(s);
  const Vector p = model::defaults(model);
  Matrices all{model::mass_matrix(model, p), model::stiffness_matrix(model, p),
               Eigen::VectorXcd::Zero(model.dofs), model.response};
  for (const auto& force : model.excitation)
    if (force.harmonic == 1) all.f += Complex(force.cosine.value(p), -force.sine.value(p)) * Vector(force.direction);
  return all;
}

}  // namespace

TEST_CASE("proportional damping has the response of the dense complex equation") {
  scene::Scene s = linear_chain();
  const auto [M, K, f, response] = matrices(s);
  for (const double w : {0.3, 1.1, 2.7}) {
    CAPTURE(w);
    const auto expected = [&](const Eigen::MatrixXcd& Z) {
      return Complex(response.dot(continuation::solve_complex(Z, f).col(0)));
    };
    s.damping = {damping(scene::rayleigh_type(), {0.07, 0.02})};
    const Complex rayleigh =
        expected(Complex(1, 0.02 * w) * K.cast<Complex>() + Complex(-w * w, 0.07 * w) * M.cast<Complex>());
    CHECK(std::abs(amplitude(s, w) - rayleigh) < 1e-12 * std::abs(rayleigh));
    s.damping = {damping(scene::loss_factor_type(), {0.05})};
    const Complex structural = expected(Complex(1, 0.05) * K.cast<Complex>() - w * w * M.cast<Complex>());
    CHECK(std::abs(amplitude(s, w) - structural) < 1e-12 * std::abs(structural));
  }
}

TEST_CASE("modal damping gives each mode its ratio") {
  scene::Scene s = linear_chain();
  s.damping = {damping(scene::modal_damping_type(), {0.03})};
  const model::Model model = model::build(s);
  const Vector p = model::defaults(model);
  const Eigen::MatrixXd M = model::mass_matrix(model, p), K = model::stiffness_matrix(model, p);
  const auto modes = continuation::symmetric_modes(K, M);
  const Eigen::MatrixXd C = modes.V.transpose() * model::damping_matrix(model, p) * modes.V;
  const Eigen::VectorXd w = modes.values.cwiseSqrt();
  CHECK((C - Eigen::MatrixXd((0.06 * w).asDiagonal())).cwiseAbs().maxCoeff() < 1e-12 * w.maxCoeff());
  // In the response, and as a parameter.
  const auto [M1, K1, f, response] = matrices(s);
  scene::set(s, "steel.ratio", 0.01);
  Complex sum = 0;
  for (Eigen::Index j = 0; j < w.size(); ++j) {
    const Eigen::VectorXd v = modes.V.col(j);
    sum += response.dot(v) * v.cast<Complex>().dot(f) / Complex(w[j] * w[j] - 1.21, 0.02 * w[j] * 1.1);
  }
  CHECK(std::abs(amplitude(s, 1.1) - sum) < 1e-12 * std::abs(sum));
}

TEST_CASE("a loss factor has no equation in time") {
  scene::Scene s = scenes::chain(3, false);
  s.damping = {damping(scene::loss_factor_type(), {0.05})};
  const auto motion = observables::motion_in_time(s, {.frequency = 1});
  CHECK(motion.status == observables::Status::failed);
  CHECK(motion.stop.reason == observables::reasons::loss_factor);
  CHECK(motion.stop.message.find("give \"beta\" in its place") != std::string::npos);
  scene::set(s, "steel.loss_factor", 0);
  CHECK(observables::motion_in_time(s, {.frequency = 1}).stop.reason != observables::reasons::loss_factor);
}
