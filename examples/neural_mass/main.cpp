// A column of the visual cortex by Jansen and Rit (Biol. Cybern. 73, 1995), u' = F(u, p) with the mean
// potentials y_0, y_1, y_2 in mV, their rates, and the firing rate p of the input in 1/s:
//
//   y_0'' = A a S(y_1 - y_2) - 2 a y_0' - a^2 y_0
//   y_1'' = A a (p + 4/5 C S(C y_0)) - 2 a y_1' - a^2 y_1          S(v) = 5 / (1 + exp(0.56 (6 - v)))
//   y_2'' = B b C/4 S(C y_0 / 4) - 2 b y_2' - b^2 y_2
//
// The S-shaped branch of equilibria has two folds and, for p > 0, Hopf points at p = 89.83 and 315.70,
// between which the column oscillates at about 10 Hz, the alpha rhythm (Grimbert and Faugeras, Neural
// Computation 18, 2006).

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

using namespace arcslip::continuation;

namespace {

constexpr double A = 3.25, B = 22, a = 100, b = 50, C = 135;

double S(double v) {
  return 5 / (1 + std::exp(0.56 * (6 - v)));
}

}  // namespace

int main() {
  Functions column;
  column.size = 6;
  column.parameters = {{"p", "1/s"}};
  column.scales = Vector{{0.1, 20, 20, 1, 100, 100}};
  column.residual = [](In y, In p, Out F) {
    F << y[3], y[4], y[5], A * a * S(y[1] - y[2]) - 2 * a * y[3] - a * a * y[0],
        A * a * (p[0] + 0.8 * C * S(C * y[0])) - 2 * a * y[4] - a * a * y[1],
        B * b * 0.25 * C * S(0.25 * C * y[0]) - 2 * b * y[5] - b * b * y[2];
  };
  const auto problem = from_functions(std::move(column));

  auto monitors = hopf_monitors(*problem);
  monitors.push_back(fold_monitor());
  Options options{.lower = -50, .upper = 400};
  options.stability.emplace();
  const Branch branch =
      trace(problem, {.u = Vector::Zero(6), .p = Vector{{-50.0}}}, options, std::move(monitors));

  for (const Event& event : branch.events) {
    if (const auto* hopf = std::get_if<Hopf>(&event.data))
      std::printf("hopf at p = %.6f, frequency = %.4f Hz, l1 = %.4e, %s\n", event.point.parameter,
                  hopf->frequency / (2 * std::numbers::pi), hopf->lyapunov.value, name(hopf->criticality));
    else
      std::printf("%s at p = %.6f, y_1 - y_2 = %.6f\n", event.monitor.c_str(), event.point.parameter,
                  event.point.u[1] - event.point.u[2]);
  }
  for (const StabilityRange& range : stability_ranges(branch))
    std::printf("range from p = %.2f to %.2f: unstable = %d\n", branch.points[range.first].parameter,
                branch.points[range.last].parameter, range.unstable);
}
