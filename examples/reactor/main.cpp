// A cooled, stirred tank with an exothermic reaction (Uppal, Ray and Poore, Chem. Eng. Sci. 29, 1974),
// u' = F(u, p) with the conversion x and the temperature y:
//
//   x' = -x + Da (1 - x) e^y,   y' = -y + B Da (1 - x) e^y - beta y,   beta = 3
//
// At rest y = B x / 4, Da = x / (1 - x) e^-y; the trace of J is B x - 4 - 1 / (1 - x), the determinant
// (4 - B x (1 - x)) / (1 - x). With B = 12 the tank oscillates between x = 1/2 and x = 5/6, where the
// frequencies are sqrt(2) and sqrt(14) and the Lyapunov coefficients 6 sqrt(2) / 25 and -306 sqrt(14) / 3577.
//
// In Da and B the Hopf points are B = (4 + 1 / (1 - x)) / x. They begin at a Bogdanov-Takens point, x = 1/4,
// are generalized where 32 x^3 - 100 x^2 + 99 x - 30 = 0, and vanish in pairs at B = 6 + 2 sqrt(5).

#include <arcslip/continuation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

using namespace arcslip::continuation;

namespace {

constexpr double beta = 3;

std::shared_ptr<const Problem> tank() {
  Functions tank;
  tank.size = 2;
  tank.parameters = {{"Da", "", 0.1}, {"B", "", 12}};
  tank.residual = [](In u, In p, Out F) {
    const double rate = p[0] * (1 - u[0]) * std::exp(u[1]);
    F << -u[0] + rate, -u[1] + p[1] * rate - beta * u[1];
  };
  tank.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) {
    const double k = p[0] * std::exp(u[1]), rate = k * (1 - u[0]);
    J << -1 - k, rate, -p[1] * k, -1 + p[1] * rate - beta;
  };
  return from_functions(std::move(tank));
}

}  // namespace

int main() {
  const auto problem = tank();
  const int Da = parameter_index(*problem, "Da"), B = parameter_index(*problem, "B");
  const Vector p = parameter_values(*problem);

  Options options{.lower = 0, .upper = 0.6};
  options.stability.emplace();
  const Branch branch =
      trace(problem, {.u = Vector::Zero(2), .p = p, .free = Da}, options, hopf_monitors(*problem));
  for (const Event& event : branch.events) {
    const Hopf& hopf = std::get<Hopf>(event.data);
    std::printf("hopf at Da = %.12f, x = %.12f, frequency = %.12f, l1 = %.10f, %s\n", event.point.parameter,
                event.point.u[0], hopf.frequency, hopf.lyapunov.value, name(hopf.criticality));
  }
  for (const StabilityRange& range : stability_ranges(branch))
    std::printf("range from Da = %.4f to %.4f: unstable = %d\n", branch.points[range.first].parameter,
                branch.points[range.last].parameter, range.unstable);
  if (branch.events.empty()) return 1;

  // The unknowns are now (x, y, Da, frequency^2), and B is free.
  const Event& onset = branch.events.front();
  const auto hopf = hopf_points(problem, Da, std::get<Hopf>(onset.data).frequency);
  auto monitors = hopf_curve_monitors(*hopf);
  monitors.push_back(fold_monitor());
  const Branch curve = trace_both(hopf, {.u = with_frequency(onset), .p = p, .free = B},
                                  {.lower = 8, .upper = 30}, std::move(monitors))
                           .branch;
  for (const Event& event : curve.events)
    std::printf("%s at Da = %.12f, B = %.12f, x = %.9f\n", event.monitor.c_str(), event.point.u[2],
                event.point.parameter, event.point.u[0]);
  double off = 0;
  for (const Point& point : curve.points) {
    const double x = point.u[0];
    off = std::max(off, std::abs(point.parameter - (1 + beta + 1 / (1 - x)) / x));
  }
  std::printf("curve of %zu points, |B - (4 + 1 / (1 - x)) / x| <= off = %.1e; %s\n", curve.points.size(),
              off, curve.stop.message.c_str());
}
