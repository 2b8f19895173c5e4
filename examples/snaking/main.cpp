// Localized patterns of the Swift-Hohenberg equation (Burke and Knobloch, Phys. Lett. A 360, 2007),
//
//   u_t = r u - (1 + d^2/dx^2)^2 u + b u^2 - u^3,   b = 1.8,   u even at x = 0 and x = L,
//
// snake: two branches, with a maximum and a minimum at x = 0, leave r = 0 as
//
//   u = +-2 sqrt(-2 r / (38 b^2 / 9 - 3)) sech(x sqrt(-r) / 2) cos x
//
// and gain a wave on each side from fold to fold, which approach r = -0.3390 on the left and r = -0.2593 on
// the right. The points are in the middle of n equal intervals; differences are of order 4.
//
//   snaking [n = 500]

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

using namespace arcslip::continuation;

namespace {

constexpr double b = 1.8, L = 100;

// 1 + d^2/dx^2, of functions that are even at both ends.
SparseMatrix one_plus_second_derivative(int n) {
  const double h = L / n, weights[] = {-30 / (12 * h * h), 16 / (12 * h * h), -1 / (12 * h * h)};
  SparseMatrix A(n, n);
  A.setIdentity();
  for (int i = 0; i < n; ++i)
    for (int k = -2; k <= 2; ++k) {
      const int j = i + k;
      A.coeffRef(i, j < 0 ? -1 - j : j < n ? j : 2 * n - 1 - j) += weights[std::abs(k)];
    }
  A.makeCompressed();
  return A;
}

std::shared_ptr<const Problem> swift_hohenberg(int n) {
  const SparseMatrix A = one_plus_second_derivative(n);
  Functions equation;
  equation.size = n;
  equation.parameters = {{"r", ""}};
  equation.scales = Vector::Constant(n, std::sqrt(n));  // lengths are root mean squares
  equation.residual = [A](In u, In p, Out F) {
    F = (p[0] * u.array() + b * u.array().square() - u.array().cube()).matrix() - A * (A * u);
  };
  equation.sparse_jacobian = [linear = SparseMatrix(-A * A)](In u, In p, SparseMatrix& J) {
    J = linear;
    J.diagonal() += (p[0] + 2 * b * u.array() - 3 * u.array().square()).matrix();
  };
  equation.derivative = [](In u, In, int, Out dF) { dF = u; };
  return from_functions(std::move(equation));
}

Vector first_guess(int n, double r, double sign) {
  Vector u(n);
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) * L / n;
    u[i] =
        sign * 2 * std::sqrt(-2 * r / (38 * b * b / 9 - 3)) * std::cos(x) / std::cosh(x * std::sqrt(-r) / 2);
  }
  return u;
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 500;
  const auto problem = swift_hohenberg(n);
  // The pattern has come to x = L.
  const Monitor full{.name = "full",
                     .value = [](const Accepted& now) { return std::abs(now.u[now.u.size() - 1]) - 0.1; },
                     .terminal = true};
  for (const double sign : {1.0, -1.0}) {
    const double r = -0.1;
    const Start start{.u = first_guess(n, r, sign), .p = Vector{{r}}, .direction = -1};
    const Branch snake = trace(problem, start, {.lower = -0.5, .upper = -0.05}, {fold_monitor(), full});
    int folds = 0;
    for (const Event& event : snake.events)
      if (const auto* fold = std::get_if<Fold>(&event.data))
        std::printf("fold %d at r = %.12f, on the %s, |u| = %.6f\n", ++folds, event.point.parameter,
                    fold->curvature > 0 ? "left" : "right", std::sqrt(2 * L / n) * event.point.u.norm());
    std::printf("branch with a %s: folds = %d, points = %ld, residuals = %ld, factorizations = %ld; %s\n",
                sign > 0 ? "maximum" : "minimum", folds, snake.counts.points, snake.counts.residuals,
                snake.counts.factorizations, snake.stop.message.c_str());
  }
}
