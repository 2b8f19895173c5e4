// A load p on a snapping spring in series with a linear one of stiffness k:
//
//   f(u_1 - u_2) - p = 0,   k u_2 - f(u_1 - u_2) = 0
//
// The force f of the snapping spring rises with its stretch e to 1 at e = 1, falls by e/2 to 1/2 at e = 2,
// rises by e again, and from e = 3, a stop, by 3 e. Both ends of the falling part are folds in p without a
// curvature; the stop is a kink and no fold.

#include <arcslip/continuation.hpp>

#include <array>
#include <cstdio>
#include <utility>

using namespace arcslip::continuation;

namespace {

constexpr std::array<double, 4> corner{0, 1, 2, 3}, force{0, 1, 0.5, 1.5}, slope{1, -0.5, 1, 3};

std::size_t part(double e) {
  return e < 1 ? 0 : e < 2 ? 1 : e < 3 ? 2 : 3;
}

}  // namespace

int main() {
  const double k = 4;
  Functions snap;
  snap.size = 2;
  snap.parameters = {{"p", "N", 0}};
  snap.residual = [=](In u, In p, Out F) {
    const double e = u[0] - u[1];
    const double f = force[part(e)] + slope[part(e)] * (e - corner[part(e)]);
    F[0] = f - p[0];
    F[1] = k * u[1] - f;
  };
  snap.jacobian = [=](In u, In, Eigen::Ref<Matrix> J) {
    const double s = slope[part(u[0] - u[1])];
    J << s, -s, -s, k + s;
  };
  snap.piece = [](In u, In) { return part(u[0] - u[1]); };
  const auto problem = from_functions(std::move(snap));

  const Start start{.u = Vector::Zero(2), .p = parameter_values(*problem)};
  const Branch branch = trace(problem, start, {.lower = -1, .upper = 2}, {fold_monitor(), kink_monitor()});
  for (const Event& event : branch.events) {
    std::printf("%s at p = %.9f, u_1 = %.9f%s", event.monitor.c_str(), event.point.parameter,
                event.point.u[0], event.nonsmooth ? ", nonsmooth" : "");
    if (const auto* kink = std::get_if<Kink>(&event.data))
      std::printf(", du_1/dp before = %.9f, beyond = %.9f", kink->before[0] / kink->before[2],
                  kink->after[0] / kink->after[2]);
    std::printf("\n");
  }
  std::printf("end at p = %.9f, u_1 = %.9f; %s\n", branch.points.back().parameter, branch.points.back().u[0],
              branch.stop.message.c_str());
}
