#include <arcslip/continuation/monitor.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace arcslip::continuation {
namespace {

constexpr double difference = 6e-6;  // relative, of central differences

// Relative to u in each unknown, whatever its unit: |v| = 1 in scales, so that |v_i| is a change of u_i that
// is not too large.
double step_along(In u, const Vector& v) {
  double h = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (v[i] != 0) h = std::min(h, std::abs(u[i] / v[i]));
  return difference * (std::isfinite(h) ? std::max(1.0, h) : 1.0);
}

// y = F_uu v v. False where F cannot be evaluated beside u.
bool second_along(const Accepted& now, const Vector& v, Vector& y) try {
  const double h = step_along(now.u, v);
  const Vector ahead = now.u + h * v, behind = now.u - h * v;
  Vector minus(v.size());
  if (now.at.move_to(ahead, now.p, Needs::jacobian) != Evaluated::ok) return false;
  apply(now.at.jacobian(), v, y);
  if (now.at.move_to(behind, now.p, Needs::jacobian) != Evaluated::ok) return false;
  apply(now.at.jacobian(), v, minus);
  y = (y - minus) / (2 * h);
  return true;
} catch (const std::exception&) {
  return false;
}

// With B = [J F_p; r^T], whose tangent at the fold is t = (v, 0): B^T (w, 0) = e_{n+1}, and by
// differentiating F(u(s), p(s)) = 0 twice, J u'' + F_p p'' = -F_uu v v, so that p'' is the last entry of
// -B^-1 (F_uu v v, 0).
EventData describe(const Accepted& now) {
  const Eigen::Index n = now.u.size();
  Fold fold;
  fold.right_null = now.tangent.head(n);
  Vector x = Vector::Zero(n + 1);
  x[n] = 1;
  if (now.bordered.solve_transposed(x)) fold.left_null = x.head(n).normalized();
  Vector second(n);
  if (!second_along(now, fold.right_null, second)) return {};
  x << -second, 0;
  now.bordered.solve(x);
  fold.curvature = x[n];
  return fold;
}

}  // namespace

Monitor fold_monitor() {
  Monitor monitor;
  monitor.name = "fold";
  monitor.value = [](const Accepted& now) { return now.tangent[now.tangent.size() - 1]; };
  monitor.quantity = [](const Accepted& now) { return now.parameter; };
  monitor.describe = describe;
  return monitor;
}

}  // namespace arcslip::continuation
