// Localized patterns of the Swift-Hohenberg equation (Burke and Knobloch, Phys. Lett. A 360, 2007),
//
//   u_t = r u - (1 + d^2/dx^2)^2 u + b u^2 - u^3,   b = 1.8,   u even at x = 0 and x = L,
//
// snake: two branches, with a maximum and a minimum at x = 0, leave r = 0 as
//
//   u = +-2 sqrt(-2 r / (38 b^2 / 9 - 3)) sech(x sqrt(-r) / 2) cos x
//
// and gain a wave on each side from fold to fold, which approach r = -0.3390 on the left and r = -0.2593 on
// the right. Between these, at the Maxwell point r = -0.3128, the periodic pattern of least energy
//
//   E = < -r u^2 / 2 + (u + u_xx)^2 / 2 - b u^3 / 3 + u^4 / 4 >
//
// among all wave numbers k has the energy of u = 0. Points are in the middle of equal intervals, differences
// of order 4.
//
//   snaking [n = 500]

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <utility>

using namespace arcslip::continuation;

namespace {

constexpr double b = 1.8, L = 100;

// d^2/dx^2 at n points h apart, of functions that are even at both ends.
SparseMatrix second_derivative(int n, double h) {
  const double weights[] = {-30 / (12 * h * h), 16 / (12 * h * h), -1 / (12 * h * h)};
  SparseMatrix D(n, n);
  for (int i = 0; i < n; ++i)
    for (int k = -2; k <= 2; ++k) {
      const int j = i + k;
      D.coeffRef(i, j < 0 ? -1 - j : j < n ? j : 2 * n - 1 - j) += weights[std::abs(k)];
    }
  D.makeCompressed();
  return D;
}

std::shared_ptr<const Problem> swift_hohenberg(int n) {
  SparseMatrix A = second_derivative(n, L / n);
  A.diagonal().array() += 1;
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

// A pattern over half a wave of the wave number k, which is the last unknown: dE/dk = 0.
int maxwell_point() {
  const int n = 60;
  const double h = std::numbers::pi / n;
  const SparseMatrix D = second_derivative(n, h);
  Functions pattern;
  pattern.size = n + 1;
  pattern.parameters = {{"r", ""}};
  pattern.residual = [=](In v, In p, Out F) {
    const Vector u = v.head(n), Du = D * u;
    const double k = v[n];
    const Vector w = u + k * k * Du;
    F.head(n) = (p[0] * u.array() + b * u.array().square() - u.array().cube()).matrix() - w - k * k * (D * w);
    F[n] = k * w.dot(Du) / n;
  };
  const Monitor energy{
      .name = "maxwell", .value = [=](const Accepted& now) {
        const Eigen::ArrayXd u = now.u.head(n);
        const Vector w = now.u.head(n) + now.u[n] * now.u[n] * (D * now.u.head(n));
        return w.squaredNorm() / 2 -
               (now.p[0] * u.square() / 2 + b * u.cube() / 3 - u.square().square() / 4).sum();
      }};
  Vector v(n + 1);
  for (int i = 0; i < n; ++i) v[i] = 0.3 + std::cos((i + 0.5) * h);
  v[n] = 1;
  const Branch branch =
      trace(from_functions(std::move(pattern)), {.u = v, .p = Vector{{-0.25}}, .direction = -1},
            {.lower = -0.35, .upper = -0.2}, {energy});
  for (const Event& event : branch.events)
    std::printf("maxwell point at r = %.10f, k = %.10f\n", event.point.parameter, event.point.u[n]);
  return branch.events.empty();
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
  return maxwell_point();
}
