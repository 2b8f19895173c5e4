#include "catch.hpp"

#include "continuation/suite/cases.hpp"

using namespace suite;
using arcslip::continuation::Evaluated;
using arcslip::continuation::Needs;

namespace {

// d F / d x at x = 0, x -> F(x), by differences of order four.
template <class Function>
Vector slope(Function F, double h) {
  return (8 * (F(h) - F(-h)) - (F(2 * h) - F(-2 * h))) / (12 * h);
}

// Relative to the largest entry, and to the rounding of F in the differences.
double error(const Vector& analytic, const Vector& differences, const Vector& F, double terms, double h) {
  const double rounding = 1e-15 * (F.cwiseAbs().maxCoeff() + terms) / h;
  return (analytic - differences).cwiseAbs().maxCoeff() /
         (analytic.cwiseAbs().maxCoeff() + 1e7 * rounding + 1e-300);
}

void check_derivatives(const Problem& problem, const Vector& u, const Vector& p, double h = 1e-4) {
  const auto at = problem.evaluator();
  const Vector scales = problem.scales();
  REQUIRE(at->move_to(u, p, Needs::jacobian) == Evaluated::ok);
  const Vector F = at->residual();
  const auto J = std::get<Eigen::MatrixXd>(at->jacobian());
  std::vector<Vector> by_p(problem.parameters().size(), Vector(u.size()));
  for (std::size_t k = 0; k < by_p.size(); ++k) at->parameter_derivative(static_cast<int>(k), by_p[k]);
  const double terms = (J.cwiseAbs() * u.cwiseAbs()).maxCoeff();
  const auto residual = [&](const Vector& v, const Vector& q) {
    REQUIRE(at->move_to(v, q, Needs::residual) == Evaluated::ok);
    return Vector(at->residual());
  };
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double step = h * scales[i];
    const auto along = [&](double x) {
      Vector v = u;
      v[i] += x;
      return residual(v, p);
    };
    CAPTURE(i);
    CHECK(error(J.col(i), slope(along, step), F, terms, step) < 1e-8);
  }
  for (std::size_t k = 0; k < by_p.size(); ++k) {
    const double step = h * problem.parameters()[k].scale;
    const auto along = [&](double x) {
      Vector q = p;
      q[static_cast<Eigen::Index>(k)] += x;
      return residual(u, q);
    };
    CAPTURE(k);
    CHECK(error(by_p[k], slope(along, step), F, terms, step) < 1e-8);
  }
}

}  // namespace

TEST_CASE(
    "Jacobians and parameter derivatives of the suite are those of its residuals, on and off the branch") {
  for (const Case& c : cases()) {
    if (c.name == "powell_4") continue;  // a singular start: no branch
    // Slopes of the circuit's amplifier change within 1/1962 V: see below.
    if (c.name == "trigger_circuit") continue;
    Options options = window(c.lower, c.upper);
    options.points = 41;
    const Branch branch = trace(c, options);
    for (std::size_t i : {std::size_t{0}, std::size_t{20}, std::size_t{40}}) {
      if (i >= branch.points.size()) break;
      CAPTURE(c.name, i);
      Vector u = branch.points[i].u, p = c.start.p;
      p[c.start.free.in(*c.problem)] = branch.points[i].parameter;
      check_derivatives(*c.problem, u, p);
      u.array() *= 1.01;
      u += 0.003 * c.problem->scales();
      check_derivatives(*c.problem, u, p);
    }
  }
}

TEST_CASE("the derivatives of the trigger circuit are those of its residual, within its amplifier's width") {
  const Vector u{{0.236, 0.55, 0.2365, 0.237, 0.5, 8}};
  check_derivatives(*trigger_circuit(), u, Vector::Constant(1, 0.32), 1e-6);
}

TEST_CASE("exchanging an unknown and a parameter twice gives the problem back") {
  const ProblemPtr once = exchanged(duffing_1harmonic(0.1), 1, 2);
  const ProblemPtr twice = exchanged(once, 1, 2);
  const Vector u{{0.3, -0.2}}, p{{1.1, 0.1, 0.05, 0.7}};
  check_derivatives(*once, u, p);
  const auto a = duffing_1harmonic(0.1)->evaluator(), b = twice->evaluator();
  REQUIRE(a->move_to(u, p, Needs::jacobian) == Evaluated::ok);
  REQUIRE(b->move_to(u, p, Needs::jacobian) == Evaluated::ok);
  CHECK(a->residual() == b->residual());
  CHECK(std::get<Eigen::MatrixXd>(a->jacobian()) == std::get<Eigen::MatrixXd>(b->jacobian()));
}
