#include <arcslip/continuation/special_points/branch_point.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double smallest_distance = 1e-7;      // of two branches, relative, that Newton's method resolves
constexpr double rounding_displacement = 1e-9;  // relative, over which F changes by rounding only
constexpr int displacements = 8;
constexpr double newton_divergence = 2;    // of Newton's corrections, from one to the next
constexpr double double_point = 1e-8;      // distance in scales from a further rank loss of A
constexpr double newton_rounding = 1e-14;  // of a correction, relative: converged
constexpr double rounding_safety = 20;     // times the spread of repeated evaluations
constexpr double eigenvalue_error = 1e-9;  // ratio of the form's eigenvalues: their error
constexpr double smallest_slope = 1e-6;    // dp/ds != 0, in scales

// Whether the equations are regular: a change of F of size b_0, that of its quadratic terms at distances of 1
// in scales, moves x by less than 1 / double_point. If A loses another rank, a point that Newton's method
// finds as well, or the form is singular, the change of x is unbounded.
bool regular(const Vector& unfolding, const Vector& scale, const LinearSolver& solver) {
  const Eigen::Index n = unfolding.size();
  Vector x = Vector::Zero(n + 2);
  for (Eigen::Index i = 0; i < n; ++i)
    x[i] = std::sin(0.7 * static_cast<double>(i * i) + 0.3) * unfolding.norm();
  solver.solve(x);
  return x.allFinite() && x.head(n + 1).cwiseQuotient(scale.head(n + 1)).norm() * double_point < 1;
}

// Corrections are relative to |v| in scales, or absolute if it is less than 1: branch points at 0 are common.
// On return, evaluator and factors are at the start of the last correction, within its square of v.
bool newton(Evaluator& at, LinearSolver& solver, const Vector& p, const Vector& scale,
            const NewtonOptions& options, Vector& v) {
  const Borders none(static_cast<int>(v.size()), 0);
  Vector dv(v.size());
  double before = 0;
  bool converged = false;
  for (int k = 0; k <= options.iterations; ++k) {
    if (at.move_to(v, p, Needs::jacobian) != Evaluated::ok || !solver.factorize(at.jacobian(), none))
      return false;
    dv = -at.residual();
    solver.solve(dv);
    v += dv;
    if (converged) return v.allFinite();
    const double now = dv.cwiseQuotient(scale).norm() / std::max(1.0, v.cwiseQuotient(scale).norm());
    if (!std::isfinite(now) || (k > 1 && now > newton_divergence * before)) return false;
    const bool stagnates = k > 0 && now > 0.5 * before && now <= options.rounding_level;
    converged = now <= options.tolerance || stagnates;
    if (now <= newton_rounding) return true;
    before = now;
  }
  return false;
}

// The rounding error of beta: its spread near x, at points where F in the direction of beta equals that of x
// to second order. solver: of the linearization at x.
double rounding_of_beta(const Problem& problem, Vector p, int along, const Vector& x, const Vector& scale,
                        const LinearSolver& solver) {
  const Eigen::Index n = x.size() - 1;
  const auto at = problem.evaluator();
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  Vector nearby(n + 1), correction(n + 2);
  for (int k = 0; k < displacements; ++k) {
    for (Eigen::Index i = 0; i <= n; ++i)
      nearby[i] = x[i] + rounding_displacement * std::sin(1.0 + 7.0 * static_cast<double>(i) + 3.0 * k) *
                             std::max(std::abs(x[i]), 1e-3 * scale[i]);
    p[along] = nearby[n];
    if (at->move_to(nearby.head(n), p, Needs::residual) != Evaluated::ok) continue;
    correction.setZero();
    correction.head(n) = at->residual();
    solver.solve(correction);
    lowest = std::min(lowest, correction[n + 1]);
    highest = std::max(highest, correction[n + 1]);
  }
  const double size = std::max(1.0, x.cwiseQuotient(scale.head(n + 1)).norm());
  return std::max(rounding_safety * (highest - lowest),
                  0.5 * smallest_distance * smallest_distance * size * size);
}

// <a, b> in the problem's metric and the scale of the parameter.
double product(const Problem& problem, double parameter_scale, const Vector& a, const Vector& b) {
  const Eigen::Index n = a.size() - 1;
  Vector Mb(n);
  if (!problem.metric(b.head(n), Mb)) Mb = b.head(n).cwiseQuotient(problem.scales().cwiseAbs2());
  return a.head(n).dot(Mb) + a[n] * b[n] / (parameter_scale * parameter_scale);
}

void check_sizes(const Problem& problem, const Vector& p, const Vector& guess) {
  if (p.size() != static_cast<Eigen::Index>(problem.parameters().size()))
    throw std::invalid_argument(std::to_string(p.size()) + " parameters are given, the problem has " +
                                std::to_string(problem.parameters().size()));
  if (guess.size() != problem.size() + 1)
    throw std::invalid_argument("the guess has " + std::to_string(guess.size()) + " entries, needs " +
                                std::to_string(problem.size()) + " unknowns and a parameter");
}

}  // namespace

Vector BranchPointLocation::unknowns() const {
  Vector v(x.size() + 1);
  v << x, imperfection;
  return v;
}

std::optional<BranchPointLocation> locate_branch_point(std::shared_ptr<const Problem> problem,
                                                       const Vector& p, int along, const Vector& guess,
                                                       MakeLinearSolver make_solver,
                                                       const NewtonOptions& options) {
  check_sizes(*given(problem), p, guess);
  const Eigen::Index n = problem->size();
  Vector v(n + 2);
  v << guess, 0;
  BranchPointLocation found;
  {
    const auto rough = branch_points(problem, along, Vector::Zero(n), make_solver)->evaluator();
    if (rough->move_to(v, p, Needs::jacobian) != Evaluated::ok) return {};
    const NullSpace space = null_space(*rough);
    if (!space.form.allFinite()) return {};
    found.unfolding = space.form.norm() * space.complement;
  }

  const auto equations = branch_points(problem, along, found.unfolding, std::move(make_solver));
  const auto at = equations->evaluator();
  const auto solver = equations->linear_solver();
  const Vector scale = equations->scales();
  if (!newton(*at, *solver, p, scale, options, v)) return {};
  found.x = v.head(n + 1);
  found.imperfection = v[n + 1];
  found.null_space = null_space(*at);
  if (!found.null_space.form.allFinite()) return {};
  if (!regular(found.unfolding, scale, *solver)) return {};
  found.rounding = rounding_of_beta(*problem, p, along, found.x, scale, *solver);
  return found;
}

std::optional<BranchPoint> describe_branch_point(const Problem& problem, int along,
                                                 const BranchPointLocation& at, const Vector& tangent) {
  if (!at.branches_cross()) return {};
  const SymmetricModes form = symmetric_modes(at.null_space.form);
  if (form.values.size() < 2) return {};
  const double negative = form.values[0], positive = form.values[1];
  const double larger = std::max(positive, -negative), smaller = std::min(positive, -negative);
  if (!(smaller > eigenvalue_error * larger)) return {};
  const double parameter_scale = problem.parameters()[static_cast<std::size_t>(along)].change();

  BranchPoint point;
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Vector2d y =
        std::sqrt(positive) * form.V.col(0) + sign * std::sqrt(-negative) * form.V.col(1);
    Vector t = at.null_space.right * y;
    t /= std::sqrt(product(problem, parameter_scale, t, t));
    if (product(problem, parameter_scale, t, tangent) < 0) t = -t;
    if (std::abs(t[t.size() - 1]) < smallest_slope * parameter_scale)
      point.type = BranchPoint::Type::pitchfork;
    point.tangents.push_back(std::move(t));
  }
  if (product(problem, parameter_scale, point.tangents[1], tangent) >
      product(problem, parameter_scale, point.tangents[0], tangent))
    std::swap(point.tangents[0], point.tangents[1]);
  if (at.null_space.left.size() > 0) point.left_null = at.null_space.left.normalized();
  return point;
}

}  // namespace arcslip::continuation
