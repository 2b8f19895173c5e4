// The pitchfork lambda u - u^3 + eps = 0, in one unknown.
//
// With eps = 0 the branches u = 0 and lambda = u^2 cross at lambda = 0. Any other eps breaks them apart: for
// eps > 0 the lower branch has a fold at lambda = 3 (eps/2)^(2/3), u = -(eps/2)^(1/3).

#include <arcslip/continuation.hpp>

#include <cstdio>
#include <utility>

using namespace arcslip::continuation;

int main() {
  Functions pitchfork;
  pitchfork.size = 1;
  pitchfork.parameters = {{"lambda", "", -1}, {"eps", "", 0}};
  pitchfork.residual = [](In u, In p, Out F) { F[0] = p[0] * u[0] - u[0] * u[0] * u[0] + p[1]; };
  pitchfork.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - 3 * u[0] * u[0]; };
  const auto problem = from_functions(std::move(pitchfork));
  const int lambda = parameter_index(*problem, "lambda");
  const Options window{.lower = -1, .upper = 1};

  const Start straight{.u = Vector::Zero(1), .p = parameter_values(*problem), .free = lambda};
  const Branch trivial = trace(problem, straight, window, {branch_point_monitor()});
  std::printf("u = 0: %s\n", trivial.stop.message.c_str());

  for (const Event& event : trivial.events) {
    const auto* crossing = std::get_if<BranchPoint>(&event.data);
    if (!crossing) continue;
    std::printf("crossing at lambda = %.12f, u = %.12f, a %s\n", event.point.parameter, event.point.u[0],
                crossing->type == BranchPoint::Type::pitchfork ? "pitchfork" : "transcritical point");
    for (const double side : {1.0, -1.0}) {
      // Shortly along the tangent of the other branch; the solution is sought across it.
      const Vector tangent = side * crossing->tangents[1];
      Start aside{.u = event.point.u + 0.1 * tangent.head(1), .p = straight.p, .tangent = tangent};
      aside.p[lambda] = event.point.parameter + 0.1 * tangent[1];
      const Point end = trace(problem, aside, window).points.back();
      std::printf("end of the other branch at lambda = %.12f, u = %.12f\n", end.parameter, end.u[0]);
    }
  }

  const Vector imperfect{{1.0, 0.02}};
  const Start below{.u = Vector{{-1.0}}, .p = imperfect, .direction = -1};
  for (const Event& fold : trace(problem, below, window, {fold_monitor()}).events)
    std::printf("fold of eps = 0.02 at lambda = %.12f, u = %.9f, curvature = %.6f\n", fold.point.parameter,
                fold.point.u[0], std::get<Fold>(fold.data).curvature);
}
