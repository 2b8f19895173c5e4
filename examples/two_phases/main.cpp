// Two phases that share a given mass, as in an alloy (Cahn and Hilliard 1958): along a line of length 1
// without flux at its ends, in n cells,
//
//   eps^2 u'' + u - u^3 + mu = 0,   mean(u) = mass
//
// The chemical potential mu is a parameter of the equation, and follows from the mass, which is a constraint.
// The mixture u = mass separates into waves of k halves where 1 - 3 mass^2 = eps^2 (2 n sin(k pi / 2 n))^2.

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

using namespace arcslip::continuation;

namespace {

constexpr int n = 400;
constexpr double eps = 0.12, d = eps * eps * n * n;

}  // namespace

int main() {
  Functions alloy;
  alloy.size = n;
  alloy.parameters = {{"mu", ""}};
  alloy.residual = [](In u, In p, Out F) {
    for (int i = 0; i < n; ++i) {
      const double left = u[i > 0 ? i - 1 : i], right = u[i + 1 < n ? i + 1 : i];
      F[i] = d * (left - 2 * u[i] + right) + u[i] - u[i] * u[i] * u[i] + p[0];
    }
  };
  alloy.sparse_jacobian = [](In u, In, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      const int neighbours = (i > 0) + (i + 1 < n);
      entries.emplace_back(i, i, 1 - 3 * u[i] * u[i] - d * neighbours);
      if (i > 0) entries.emplace_back(i, i - 1, d);
      if (i + 1 < n) entries.emplace_back(i, i + 1, d);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  alloy.derivative = [](In, In, int, Out dF) { dF.setOnes(); };
  alloy.scales = Vector::Constant(n, std::sqrt(n));

  // One more equation, mean(u) = mass, and one more unknown, mu. The mass is a parameter.
  const Constraint mass = weighted_sum({"mass", ""}, Vector::Constant(n, 1.0 / n));
  const auto closed = with_constraints(from_functions(std::move(alloy)), {mass}, {"mu"});
  Vector mixed(n + 1);
  mixed << Vector::Constant(n, -0.9), -0.9 * 0.9 * 0.9 + 0.9;
  const Start mixture{.u = mixed, .p = Vector{{0.0, -0.9}}, .free = "mass"};
  const Branch branch = trace(closed, mixture, {.lower = -0.9, .upper = 0}, {branch_point_monitor()});

  for (const Event& event : branch.events)
    std::printf("phases separate at mass = %.10f, mu = %.10f\n", event.point.parameter, event.point.u[n]);
  std::printf("%s, by %s\n", branch.stop.message.c_str(), branch.linear_solver.c_str());
}
