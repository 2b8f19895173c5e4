// Two bars that meet at a hinge (von Mises 1923), at the height h over supports 2 l apart. Pressed down by w
// under the load P, with bars of the axial stiffness EA that are stretched by the measure of Green, (L^2 -
// L_0^2) / 2 L_0^2,
//
//   P = EA / L_0^3 w (h - w) (2 h - w),   L_0^2 = l^2 + h^2,
//
// the truss snaps through at h - w = h / sqrt(3), P = 2 EA h^3 / (3 sqrt(3) L_0^3). A steep one, h^2 > 3 l^2,
// buckles sideways before, where (h - w)^2 = h^2 - 2 l^2, at a subcritical pitchfork: its load falls on the
// way out.

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <utility>

using namespace arcslip::continuation;

namespace {

constexpr double EA = 1, l = 1, h = 2;
const double L0 = std::sqrt(l * l + h * h);

}  // namespace

int main() {
  Functions truss;  // unknowns: the way down w, and sideways v; the load P
  truss.size = 2;
  truss.parameters = {{"P", ""}};
  truss.residual = [](In u, In p, Out F) {
    const double w = u[0], v = u[1], z = h - w;
    // The forces of both bars over their lengths.
    const double left = EA / (2 * L0 * L0 * L0) * ((l + v) * (l + v) + z * z - L0 * L0);
    const double right = EA / (2 * L0 * L0 * L0) * ((l - v) * (l - v) + z * z - L0 * L0);
    F << p[0] + (left + right) * z, right * (l - v) - left * (l + v);
  };
  const auto problem = from_functions(std::move(truss));

  const Diagram diagram = trace_diagram(problem, {.u = Vector::Zero(2), .p = Vector{{0.0}}},
                                        {.lower = -0.5, .upper = 0.5}, {.depth = 1}, {fold_monitor()});
  const DiagramBranch& upright = diagram.branches.front();
  for (const Event& event : upright.branch.events) {
    if (const auto* fold = std::get_if<Fold>(&event.data))
      std::printf("fold at P = %.9f, w = %.9f, curvature = %.4f\n", event.point.parameter, event.point.u[0],
                  fold->curvature);
    if (const auto* point = std::get_if<BranchPoint>(&event.data))
      std::printf("buckling at P = %.9f, w = %.9f, %s\n", event.point.parameter, event.point.u[0],
                  name(point->criticality));
  }
  std::printf("diagram of %zu branches; %s\n", diagram.branches.size(),
              diagram.complete ? "complete" : diagram.message.c_str());
}
