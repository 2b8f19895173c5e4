// A controller pulls a spring to the place p, with a force f of at most 2, and against a stop at x = 1:
//
//   x + 4 max(x - 1, 0) - f = 0,   f - clamp(4 (p - x), -2, 2) = 0
//
// Contact and limit are choices, made in the residual and nowhere else: no `piece`, no Jacobian. x = 4/5 p up
// to the stop at p = 5/4, beyond it 4/9 (p + 1), and 6/5 from p = 17/10 on, where the force is at its limit.

#include <arcslip/continuation.hpp>

#include <cstdio>
#include <utility>

using namespace arcslip::continuation;

int main() {
  Functions push;
  push.size = 2;
  push.parameters = {{"p", "m", 0}};
  push.choosing.residual = [](In u, In p, Choices& choose, Out F) {
    const double x = u[0], f = u[1];
    F[0] = x + 4 * choose.positive(x - 1) - f;
    F[1] = f - choose.clamp(4 * (p[0] - x), -2, 2);
  };
  const auto problem = from_functions(std::move(push));

  const Start start{.u = Vector::Zero(2), .p = parameter_values(*problem)};
  const Branch branch = trace(problem, start, {.lower = 0, .upper = 3}, {kink_monitor()});
  for (const Event& event : branch.events) {
    const Kink& kink = std::get<Kink>(event.data);
    std::printf("kink at p = %.9f, x = %.9f, dx/dp before = %.9f, beyond = %.9f\n", event.point.parameter,
                event.point.u[0], kink.before[0] / kink.before[2], kink.after[0] / kink.after[2]);
  }
  const Point& end = branch.points.back();
  std::printf("end at p = %.9f, x = %.9f, f = %.9f; %s\n", end.parameter, end.u[0], end.u[1],
              branch.stop.message.c_str());
}
