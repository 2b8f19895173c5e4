#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>

using namespace arcslip;
using continuation::Needs;
using continuation::Vector;

namespace {

struct Worst {
  double jacobian = 0, parameters = 0;
  int checked = 0;
};

// Largest difference from central differences, relative to the row sums of |J| (|dR/dp|), off kinks.
Worst worst_derivative(const scene::Scene& scene, double amplitude, double frequency, double load,
                       unsigned seed) {
  scene::Scene s = scene;
  for (const auto& element : s.elements)
    if (element.type == &elements::jenkins()) scene::set(s, element.name + ".normal_load", load);
  for (auto& force : s.excitation)  // forces of the size of the motion, so that differences keep their digits
    for (double& value : force.values) value *= amplitude;
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, amplitude, frequency);
  const auto at = problem.hbm_evaluator();
  std::srand(seed);
  Vector u = amplitude * Vector::Random(problem.size());
  const int c = problem.harmonics().size();
  for (int i = 0; i < u.size(); ++i) {
    const int k = i % c, cosines = problem.harmonics().cosines();
    const int n =
        k < cosines ? problem.harmonics().cosine_order(k) : problem.harmonics().sine_order(k - cosines);
    u[i] /= std::max(1, n * n);
  }
  const Vector p = hbm::parameters_at(problem, frequency);
  Worst worst;
  REQUIRE(at->move_to(u, p, Needs::jacobian) == continuation::Evaluated::ok);
  const auto J = std::get<Eigen::MatrixXd>(at->jacobian());
  const auto piece = at->piece();
  const auto differ = [&](Vector v, Vector q, Vector w, Vector r, double width, const Vector& derivative,
                          double size, double& result) {
    at->move_to(v, q, Needs::residual);
    const Vector plus = at->residual();
    const bool kink = at->piece() != piece;
    at->move_to(w, r, Needs::residual);
    if (kink || at->piece() != piece) return;
    ++worst.checked;
    result = std::max(result, ((plus - at->residual()) / width - derivative).cwiseAbs().maxCoeff() / size);
  };
  const double size = J.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double step = 3e-6 * amplitude;
    Vector plus = u, minus = u;
    plus[i] += step;
    minus[i] -= step;
    differ(plus, p, minus, p, 2 * step, J.col(i), size, worst.jacobian);
  }
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    if (p[k] == 0) continue;
    Vector dR(problem.size());
    at->move_to(u, p, Needs::jacobian);
    at->parameter_derivative(static_cast<int>(k), dR);
    const double step = 1e-5 * p[k];
    Vector plus = p, minus = p;
    plus[k] += step;
    minus[k] -= step;
    const double scale = dR.cwiseAbs().maxCoeff() + 1e-3 * size * amplitude / std::abs(p[k]);
    differ(u, plus, u, minus, 2 * step, dR, scale, worst.parameters);
  }
  return worst;
}

}  // namespace

TEST_CASE("dR/du and dR/dp of every named parameter are those of central differences, over decades") {
  for (const bool even : {false, true})
    for (double amplitude : {1e-6, 1e-3, 1.0, 1e2})
      for (double frequency : {1e-2, 0.3, 1.1, 20.0})
        for (double load : {0.3, 1.0, 30.0}) {
          const Worst worst =
              worst_derivative(scenes::chain(5, even), amplitude, frequency, load * amplitude, 3);
          CAPTURE(even, amplitude, frequency, load, worst.checked);
          CHECK(worst.checked > 10);
          CHECK(worst.jacobian < 1e-6);
          CHECK(worst.parameters < 1e-5);
        }
}

TEST_CASE("the same holds for the paper's oscillator from full slip to full stick") {
  for (int order : {1, 7, 55})
    for (double amplitude : {1e-6, 1e-3, 1.0})
      for (double load : {1e-3, 0.3, 1.0, 1e3})
        for (double hz : {0.1, 20.0, 1000.0}) {
          const Worst worst = worst_derivative(scenes::paper(order), amplitude, hz * scenes::hertz,
                                               load * amplitude * 3500, 7);
          CAPTURE(order, amplitude, load, hz, worst.checked);
          CHECK(worst.checked > 2);
          CHECK(worst.jacobian < 1e-6);
          CHECK(worst.parameters < 1e-5);
        }
}

TEST_CASE("a tie is one parameter whose derivative is the sum over its members") {
  scene::Scene s = scenes::chain(3, false);
  scene::set(s, "d2.normal_load", 0.9);
  const auto apart = std::make_shared<const model::Model>(model::build(s));
  scenes::tie(s, "load", {"d1.normal_load", "d2.normal_load"});
  const auto tied = std::make_shared<const model::Model>(model::build(s));
  CHECK(tied->parameters.size() + 1 == apart->parameters.size());
  const hbm::HbmProblem one(tied, tied->harmonics, 1, 1), two(apart, apart->harmonics, 1, 1);
  const Vector u = 3 * Vector::Random(one.size());
  const auto a = one.hbm_evaluator(), b = two.hbm_evaluator();
  a->move_to(u, hbm::parameters_at(one, 1), Needs::jacobian);
  b->move_to(u, hbm::parameters_at(two, 1), Needs::jacobian);
  Vector sum(u.size()), first(u.size()), second(u.size());
  a->parameter_derivative(model::parameter_index(*tied, "load"), sum);
  b->parameter_derivative(model::parameter_index(*apart, "d1.normal_load"), first);
  b->parameter_derivative(model::parameter_index(*apart, "d2.normal_load"), second);
  CHECK((sum - first - second).norm() < 1e-14);
  CHECK(sum.norm() > 0.1);
  CHECK_THROWS_WITH(model::parameter_index(*apart, "d1.normal_lod"), Catch::Contains("d1.normal_load"));
}

TEST_CASE("the Jacobian of one order is made of the entries of the whole one") {
  scene::Scene s = scenes::example("gap_limited_chain");
  s.harmonics.order = 3;
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const auto at = problem.hbm_evaluator();
  std::srand(5);
  const Vector u = Vector::Random(problem.size());
  REQUIRE(at->move_to(u, hbm::parameters_at(problem, 1.3), Needs::jacobian) == continuation::Evaluated::ok);
  const auto& h = problem.harmonics();
  const auto J = std::get<Eigen::MatrixXd>(at->jacobian());
  for (int n = 1; n <= 3; ++n) {
    Eigen::MatrixXd J_n(2 * problem.blocks(), 2 * problem.blocks());
    at->jacobian_of_order(n, J_n);
    const int place[2] = {h.cosine_index(n), h.sine_index(n)};
    for (int i = 0; i < J_n.rows(); ++i)
      for (int j = 0; j < J_n.cols(); ++j)
        CHECK(std::abs(J_n(i, j) - J(i / 2 * h.size() + place[i % 2], j / 2 * h.size() + place[j % 2])) <
              1e-13 * J.cwiseAbs().maxCoeff());
  }
}

TEST_CASE(
    "with the linear part of another evaluator the equations are the same, at its parameters and others") {
  const auto model = std::make_shared<const model::Model>(model::build(scenes::chain(3, false)));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const auto other = problem.hbm_evaluator(), next = problem.hbm_evaluator(), alone = problem.hbm_evaluator();
  const Vector p = hbm::parameters_at(problem, 1.1), moved = hbm::parameters_at(problem, 1.2);
  const Vector u = Vector::Random(problem.size()), v = Vector::Random(problem.size());
  REQUIRE(other->move_to(u, p, continuation::Needs::residual) == continuation::Evaluated::ok);
  for (const Vector& at : {p, moved, p}) {
    REQUIRE(next->move_next_to(*other, v, at, continuation::Needs::jacobian) == continuation::Evaluated::ok);
    REQUIRE(alone->move_to(v, at, continuation::Needs::jacobian) == continuation::Evaluated::ok);
    CHECK((next->residual() - alone->residual()).norm() == 0);
    CHECK(
        (std::get<Eigen::MatrixXd>(next->jacobian()) - std::get<Eigen::MatrixXd>(alone->jacobian())).norm() ==
        0);
    CHECK((&next->stiffness() == &other->stiffness()) == (at == p));
  }
}
