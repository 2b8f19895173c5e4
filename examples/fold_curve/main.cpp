// The reaction A -> B, steady states of a stirred tank with conversion x and temperature y (AUTO-07p's demo
// `ab`):
//
//   -x + p1 (1 - x) e^y = 0,   -y + 14 p1 (1 - x) e^y - p3 y = 0
//
// Branches in p1 have two folds, ignition and extinction. They are followed in p1 and the cooling p3 to where
// they meet, at a cusp: p1 = e^-2, p3 = 5/2. On all of the curve p3 = 14 x (1 - x) - 1.

#include <arcslip/continuation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

using namespace arcslip::continuation;

int main() {
  Functions ab;
  ab.size = 2;
  ab.parameters = {{"p1", "", 0}, {"p3", "", 2}};
  ab.residual = [](In u, In p, Out F) {
    const double rate = p[0] * (1 - u[0]) * std::exp(u[1]);
    F[0] = -u[0] + rate;
    F[1] = -u[1] + 14 * rate - p[1] * u[1];
  };
  ab.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) {
    const double e = p[0] * std::exp(u[1]), rate = (1 - u[0]) * e;
    J << -1 - e, rate, -14 * e, -1 + 14 * rate - p[1];
  };
  const auto problem = from_functions(std::move(ab));
  const int p1 = parameter_index(*problem, "p1"), p3 = parameter_index(*problem, "p3");
  const Vector p = parameter_values(*problem);

  const Monitor half{.name = "half", .value = [](const Accepted& now) { return now.u[0] - 0.5; }};
  const Start cold{.u = Vector::Zero(2), .p = p, .free = p1};
  const Branch branch = trace(problem, cold, {.lower = 0, .upper = 0.15}, {fold_monitor(), half});
  std::vector<Point> turns;
  for (const Event& event : branch.events) {
    std::printf("%s at p1 = %.12f, x = %.9f\n", event.monitor.c_str(), event.point.parameter,
                event.point.u[0]);
    if (event.monitor == "fold") turns.push_back(event.point);
  }
  if (turns.empty()) return 1;

  // The same problem with p1 among its unknowns, which are now (x, y, p1), and p3 free.
  const Start ignition{.u = with_parameter(turns.front()), .p = p, .free = p3};
  const Branch curve = trace(folds(problem, p1), ignition, {.lower = 1, .upper = 3},
                             {cusp_monitor(), bogdanov_takens_monitor()});
  for (const Event& event : curve.events)
    std::printf("%s at p1 = %.12f, p3 = %.12f, x = %.9f\n", event.monitor.c_str(), event.point.u[2],
                event.point.parameter, event.point.u[0]);
  double off = 0;
  for (const Point& point : curve.points)
    off = std::max(off, std::abs(point.parameter - (14 * point.u[0] * (1 - point.u[0]) - 1)));
  std::printf("curve of %zu points, |p3 - 14 x (1 - x) + 1| <= off = %.1e; %s\n", curve.points.size(), off,
              curve.stop.message.c_str());

  const auto at = std::find_if(curve.events.begin(), curve.events.end(),
                               [](const Event& each) { return each.monitor == "bogdanov_takens"; });
  if (at == curve.events.end()) return 1;
  const Event& double_zero = *at;
  const HopfCurveOrigin origin = hopf_curve_at(problem, p1, double_zero, p, p3);
  const Branch oscillations =
      trace(origin.curve, {.u = origin.u, .p = origin.p, .free = origin.free, .tangent = origin.tangent},
            {.lower = 1, .upper = 3}, hopf_curve_monitors(*origin.curve));
  // J has the trace 0 there: p3 = 14 x - 2 - x / (1 - x).
  off = 0;
  for (const Point& point : oscillations.points) {
    const double x = point.u[0];
    off = std::max(off, std::abs(point.parameter - (14 * x - 2 - x / (1 - x))));
  }
  std::printf("hopf_points: %zu, |p3 - 14 x + 2 + x / (1 - x)| <= off = %.1e, to p3 = %.3f; %s\n",
              oscillations.points.size(), off, oscillations.points.back().parameter,
              oscillations.stop.message.c_str());
}
