// Curves of Hopf points and of branch points in two parameters.
//
// Hopf points: the Brusselator (Prigogine and Lefever 1968), u' = F(u, p) with u = (x, y),
//
//   x' = A - (B + 1) x + x^2 y,   y' = B x - x^2 y,
//
// rests at x = A, y = B/A, and begins to oscillate at B = 1 + A^2, with the frequency A.
//
// Branch points: a rod under the load p with a spring of the stiffness c, p u - c u - u^3 = 0, leaves u = 0
// at p = c.

#include <arcslip/continuation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

using namespace arcslip::continuation;

namespace {

int hopf_curve() {
  Functions brusselator;
  brusselator.size = 2;
  brusselator.parameters = {{"A", "", 1}, {"B", "", 1}};
  brusselator.residual = [](In u, In p, Out F) {
    F[0] = p[0] - (p[1] + 1) * u[0] + u[0] * u[0] * u[1];
    F[1] = p[1] * u[0] - u[0] * u[0] * u[1];
  };
  brusselator.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) {
    const double xy = 2 * u[0] * u[1], x2 = u[0] * u[0];
    J << xy - p[1] - 1, x2, p[1] - xy, -x2;
  };
  const auto problem = from_functions(std::move(brusselator));
  const int A = parameter_index(*problem, "A"), B = parameter_index(*problem, "B");
  const Vector p = parameter_values(*problem);

  const Start rest{.u = Vector::Ones(2), .p = p, .free = B};
  const Branch branch = trace(problem, rest, {.lower = 1, .upper = 3}, hopf_monitors(*problem));
  if (branch.events.empty()) return 1;
  const Event& onset = branch.events.front();
  const double frequency = std::get<Hopf>(onset.data).frequency;
  std::printf("hopf at B = %.12f, frequency = %.12f\n", onset.point.parameter, frequency);
  const Hopf& hopf = std::get<Hopf>(onset.data);
  std::printf("%s: l1 = %.12f, error %.0e\n", name(hopf.criticality), hopf.lyapunov.value,
              hopf.lyapunov.error);
  const NearbyCycle cycle = cycle_near(onset, 0.1);  // amplitude; the cycles lie at larger B
  std::printf("cycle at B = %.6f, frequency = %.6f\n", cycle.parameter, cycle.frequency);

  Options options{.lower = 1, .upper = 3};
  options.stability.emplace();  // of u' = F
  const Branch stable = trace(problem, rest, options, hopf_monitors(*problem));
  for (const StabilityRange& range : stability_ranges(stable))
    std::printf("stability: B = %.4f to %.4f, unstable = %d\n", stable.points[range.first].parameter,
                stable.points[range.last].parameter, range.unstable);

  // The unknowns are now (x, y, B, frequency^2), and A is free.
  const Start oscillation{.u = with_frequency(onset), .p = p, .free = A};
  const Branch curve = trace(hopf_points(problem, B, frequency), oscillation, {.lower = 0.5, .upper = 2},
                             {zero_frequency_monitor()});
  double off = 0;
  for (const Point& point : curve.points) {
    const double a = point.parameter;
    off = std::max({off, std::abs(point.u[2] - (1 + a * a)), std::abs(point.u[3] - a * a)});
  }
  std::printf("curve of %zu Hopf points, |B - 1 - A^2|, |frequency^2 - A^2| <= off = %.1e; %s\n",
              curve.points.size(), off, curve.stop.message.c_str());
  return 0;
}

int branch_point_curve() {
  const auto rod = from_functions(
      1, {{"p", "", -1}, {"c", "", 0.5}},
      [](In u, In p, Out F) { F[0] = (p[0] - p[1]) * u[0] - u[0] * u[0] * u[0]; },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - p[1] - 3 * u[0] * u[0]; });
  const int load = parameter_index(*rod, "p"), stiffness = parameter_index(*rod, "c");
  const Vector p = parameter_values(*rod);

  const Start straight{.u = Vector::Zero(1), .p = p, .free = load};
  Options options{.lower = -1, .upper = 1};
  options.on_rejection = [](const Rejection& step) {
    std::fprintf(stderr, "step %.1e at %.6g: %s, %.2e against %.2e %s\n", step.step, step.parameter,
                 name(step.why), step.value, step.limit, step.words.c_str());
  };
  const Branch branch = trace(rod, straight, options, {branch_point_monitor()});
  if (branch.events.empty()) return 1;
  const Event& buckling = branch.events.front();
  std::printf("branch_point at p = %.12f, u = %.12f\n", buckling.point.parameter, buckling.point.u[0]);

  // The unknowns are now (u, p, beta), where beta = 0 says that branches cross, and c is free.
  Vector x(2);
  x << buckling.point.u, buckling.point.parameter;
  const auto crossing = locate_branch_point(rod, p, load, x);
  if (!crossing) return 1;
  const Start buckled{.u = crossing->unknowns(), .p = p, .free = stiffness};
  const Branch curve =
      trace(branch_points(rod, load, crossing->unfolding), buckled, {.lower = 0, .upper = 2});
  double off = 0;
  for (const Point& point : curve.points)
    off = std::max({off, std::abs(point.u[1] - point.parameter), std::abs(point.u[2])});
  std::printf("curve of %zu branch points, |p - c|, |beta| <= off = %.1e; %s\n", curve.points.size(), off,
              curve.stop.message.c_str());
  return 0;
}

}  // namespace

int main() {
  return hopf_curve() + branch_point_curve();
}
