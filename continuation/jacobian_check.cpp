#include <arcslip/continuation/jacobian_check.hpp>

#include <arcslip/continuation/linear_solver.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace arcslip::continuation {
namespace {

constexpr double difference_step = 6e-6;  // the cube root of the rounding
constexpr double wider = 4;               // another step, in steps
constexpr double agreement = 1e-4;        // relative differences below are not worth a message

}  // namespace

JacobianError check_jacobian(const Problem& problem, In u, In p) {
  const Eigen::Index n = problem.size();
  const auto parameters = problem.parameters();
  if (u.size() != n || p.size() != static_cast<Eigen::Index>(parameters.size()))
    throw std::invalid_argument("a place of " + std::to_string(u.size()) + " unknowns and " +
                                std::to_string(p.size()) + " parameters, the problem has " +
                                std::to_string(n) + " and " + std::to_string(parameters.size()));
  const Vector scales = problem.scales();
  const auto here = problem.evaluator(), beside = problem.evaluator();
  JacobianError worst;
  if (here->move_to(u, p, Needs::jacobian) != Evaluated::ok) return worst;
  Vector at_u = u, at_p = p, column(n), plus(n), unit = Vector::Zero(n);
  const auto rounding = std::numeric_limits<double>::epsilon() * here->residual().cwiseAbs().maxCoeff();

  const auto compare = [&](int index, double& x, double scale) {
    const double at = x, h = difference_step * std::max(std::abs(at), scale);
    x = at + h;
    bool usable =
        beside->move_to(at_u, at_p, Needs::residual) == Evaluated::ok && beside->piece() == here->piece();
    plus = beside->residual();
    x = at - h;
    usable = usable && beside->move_to(at_u, at_p, Needs::residual) == Evaluated::ok &&
             beside->piece() == here->piece();
    x = at;
    if (!usable) return;
    const Vector difference = (plus - beside->residual()) / (2 * h);
    // What differences of another step say tells how good they are.
    x = at + wider * h;
    if (beside->move_to(at_u, at_p, Needs::residual) == Evaluated::ok) plus = beside->residual();
    x = at - wider * h;
    if (beside->move_to(at_u, at_p, Needs::residual) == Evaluated::ok) plus -= beside->residual();
    x = at;
    const double doubt = (plus / (2 * wider * h) - difference).cwiseAbs().maxCoeff();
    const double size = std::max(difference.cwiseAbs().maxCoeff(), column.cwiseAbs().maxCoeff()) +
                        rounding / h + (beside->piece() == here->piece() ? doubt : 0.0) / agreement;
    if (size == 0) return;
    Eigen::Index row = 0;
    const double relative = (difference - column).cwiseAbs().maxCoeff(&row) / size;
    if (!(relative > worst.relative)) return;
    worst = {static_cast<int>(row), index, column[row], difference[row], relative, {}};
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    unit[j] = 1;
    apply(here->jacobian(), unit, column);
    unit[j] = 0;
    compare(static_cast<int>(j), at_u[j], scales[j]);
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto index = static_cast<Eigen::Index>(k);
    here->parameter_derivative(static_cast<int>(k), column);
    compare(static_cast<int>(n + index), at_p[index], parameters[k].change());
  }
  if (worst.relative > agreement) worst.message = describe(worst, problem);
  return worst;
}

}  // namespace arcslip::continuation
