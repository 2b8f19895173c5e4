#include <arcslip/continuation/events/monitor.hpp>

#include <arcslip/continuation/events/monitor_calls.hpp>
#include <arcslip/continuation/events/place_of_event.hpp>
#include <arcslip/continuation/normal_forms/steady_form.hpp>
#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/continuation/problem/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::continuation {
namespace {

Monitor monitor_of(MonitorKind kind, const char* name) {
  Monitor monitor;
  monitor.name = name;
  monitor.value = [](const Accepted&) { return 1.0; };
  monitor.kind = kind;
  return monitor;
}

}  // namespace

MonitorFailure::MonitorFailure(const std::string& monitor, double at, const std::string& what)
    : std::runtime_error("the monitor \"" + monitor + "\" threw at " + text(at) + because(what)),
      parameter(at) {}

Monitor bound_monitor(std::string name, int index, double value) {
  Monitor monitor;
  monitor.name = std::move(name);
  monitor.value = [=](const Accepted& now) {
    if (index < 0 || index >= now.u.size())
      throw std::out_of_range("there is no unknown " + std::to_string(index) + " among " +
                              std::to_string(now.u.size()));
    return now.u[index] - value;
  };
  monitor.terminal = true;
  return monitor;
}

Monitor branch_point_monitor() {
  return monitor_of(MonitorKind::branch_point, "branch_point");
}

Monitor kink_monitor() {
  return monitor_of(MonitorKind::kink, "kink");
}

namespace {

// Relative to u in each unknown, whatever its unit: |v| = 1 in scales, so that |v_i| is a moderate change
// of u_i.
double step_along(In u, const Vector& v) {
  double h = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (v[i] != 0) h = std::min(h, std::abs(u[i] / v[i]));
  return difference_step * (std::isfinite(h) ? std::max(1.0, h) : 1.0);
}

// F_uu v v, by differences of J v. Nothing if the piece of u is too narrow.
std::optional<Vector> second_along(const Accepted& now, const Vector& v) try {
  if (now.at.move_to(now.u, now.p, Needs::jacobian) != Evaluated::ok) return {};
  const std::uint64_t piece = now.at.piece();
  const Eigen::Index n = v.size();
  Vector here(n), u(n);
  std::array<Vector, 2> nearby{Vector(n), Vector(n)};
  apply(now.at.jacobian(), v, here);
  const auto quotient = difference_within_piece(step_along(now.u, v), [&](std::size_t i, double distance) {
    try {
      u = now.u + distance * v;
      if (now.at.move_to(u, now.p, Needs::jacobian) != Evaluated::ok || now.at.piece() != piece) return false;
      apply(now.at.jacobian(), v, nearby[i]);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  });
  if (!quotient) return {};
  return quotient->here * here + quotient->weight[0] * nearby[0] + quotient->weight[1] * nearby[1];
} catch (const std::exception&) {  // outside the domain, as it says
  return {};
}

// With B = [J F_p; r^T], whose tangent at the fold is t = (v, 0): B^T (w, 0) = e_{n+1}, and by
// differentiating F(u(s), p(s)) = 0 twice, J u'' + F_p p'' = -F_uu v v, so that p'' is the last entry of
// -B^-1 (F_uu v v, 0), which is -w . F_uu v v. With the coefficients of the normal form it is -2 a |v|^2 / b.
std::optional<double> fold_curvature(const Accepted& now, const Fold& fold, const Vector& left) {
  Vector du(left.size()), dp(now.p.size());
  if (left.size() > 0 &&
      now.at.second_derivative(left, fold.right_null, Vector::Zero(now.p.size()), du, dp) && du.allFinite())
    return -du.dot(fold.right_null);
  if (fold.quadratic.known() && fold.unfolding.signed_by_value())
    return -2 * fold.quadratic.value * fold.right_null.squaredNorm() / fold.unfolding.value;
  const auto second = second_along(now, fold.right_null);
  if (!second) return {};
  Vector x(now.u.size() + 1);
  x << -*second, 0;
  now.bordered.solve(x);
  return x[now.u.size()];
}

EventData describe_fold(const Accepted& now) {
  const Eigen::Index n = now.u.size();
  Fold fold;
  fold.right_null = now.tangent.head(n);
  Vector x = Vector::Unit(n + 1, n), left;
  if (now.bordered.solve_transposed(x)) {
    left = x.head(n);
    fold.left_null = left.normalized();
    add_normal_form(now.at, place_of_event(now), fold);
    now.at.move_to(now.u, now.p, Needs::jacobian);
  }
  const auto curvature = fold_curvature(now, fold, left);
  if (!curvature) return {};
  fold.curvature = *curvature;
  return fold;
}

}  // namespace

Monitor fold_monitor() {
  Monitor monitor;
  monitor.name = fold_event;
  monitor.value = [](const Accepted& now) { return now.tangent[now.tangent.size() - 1]; };
  monitor.quantity = [](const Accepted& now) { return now.parameter; };
  monitor.quantity_is_parameter = true;
  monitor.describe = describe_fold;
  monitor.at_branch_points = false;
  return monitor;
}

}  // namespace arcslip::continuation
