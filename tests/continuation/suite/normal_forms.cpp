#include "continuation/suite/problems.hpp"

#include <cmath>

namespace suite {

using arcslip::continuation::from_functions;

ProblemPtr cusp() {
  return from_functions(
      1, {parameter("mu", 0), parameter("lambda", 1)},
      [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - u[0] * u[0] * u[0]; },
      [](In u, In p, MatrixOut J) { J(0, 0) = p[1] - 3 * u[0] * u[0]; },
      [](In u, In, int k, Out dF) { dF[0] = k == 0 ? 1 : u[0]; });
}

ProblemPtr pitchfork(double eps) {
  return from_functions(
      1, {parameter("lambda", 0), parameter("eps", eps)},
      [](In u, In p, Out F) { F[0] = p[0] * u[0] - u[0] * u[0] * u[0] + p[1]; },
      [](In u, In p, MatrixOut J) { J(0, 0) = p[0] - 3 * u[0] * u[0]; },
      [](In u, In, int k, Out dF) { dF[0] = k == 0 ? u[0] : 1; });
}

ProblemPtr transcritical(double eps) {
  return from_functions(
      1, {parameter("lambda", 0), parameter("eps", eps)},
      [](In u, In p, Out F) { F[0] = p[0] * u[0] - u[0] * u[0] + p[1]; },
      [](In u, In p, MatrixOut J) { J(0, 0) = p[0] - 2 * u[0]; },
      [](In u, In, int k, Out dF) { dF[0] = k == 0 ? u[0] : 1; });
}

namespace {

// Q = I - 2 h h^T / h.h with h = (1, 2, .. n)
Eigen::MatrixXd reflection(int n) {
  const Vector h = Vector::LinSpaced(n, 1, n);
  return Eigen::MatrixXd::Identity(n, n) - 2 / h.squaredNorm() * h * h.transpose();
}

}  // namespace

ProblemPtr turned_pitchfork(int n, double eps) {
  const Eigen::MatrixXd Q = reflection(n);
  return from_functions(
      n, {parameter("lambda", 0), parameter("eps", eps)},
      [=](In u, In p, Out F) {
        const Vector y = Q * u;
        Vector f(n);
        f[0] = p[0] * y[0] - y[0] * y[0] * y[0] + p[1];
        for (int i = 1; i < n; ++i) f[i] = y[i] - (i + 1) * y[0] * y[0];
        F = Q * f;
      },
      [=](In u, In p, MatrixOut J) {
        const Vector y = Q * u;
        Eigen::MatrixXd j = Eigen::MatrixXd::Identity(n, n);
        j(0, 0) = p[0] - 3 * y[0] * y[0];
        for (int i = 1; i < n; ++i) j(i, 0) = -2 * (i + 1) * y[0];
        J = Q * j * Q;
      },
      [=](In u, In, int k, Out dF) { dF = (k == 0 ? Q.row(0).dot(u) : 1.0) * Q.col(0); });
}

Vector turned_pitchfork_state(int n, double y0) {
  Vector y = Vector::LinSpaced(n, 1, n) * y0 * y0;
  y[0] = y0;
  return reflection(n) * y;
}

ProblemPtr circle() {
  return from_functions(
      1, {parameter("lambda", 0)}, [](In u, In p, Out F) { F[0] = u[0] * u[0] + p[0] * p[0] - 1; },
      [](In u, In, MatrixOut J) { J(0, 0) = 2 * u[0]; }, [](In, In p, int, Out dF) { dF[0] = 2 * p[0]; });
}

ProblemPtr brusselator() {
  return from_functions(
      2, {parameter("B", 1), parameter("A", 1)},
      [](In u, In p, Out F) {
        const double x = u[0], y = u[1];
        F[0] = p[1] - (p[0] + 1) * x + x * x * y;
        F[1] = p[0] * x - x * x * y;
      },
      [](In u, In p, MatrixOut J) {
        const double x = u[0], y = u[1];
        J << -(p[0] + 1) + 2 * x * y, x * x, p[0] - 2 * x * y, -x * x;
      },
      [](In u, In, int k, Out dF) {
        if (k == 0)
          dF << -u[0], u[0];
        else
          dF << 1, 0;
      });
}

}  // namespace suite
