#include "continuation/suite/problems.hpp"

#include <cmath>
#include <numbers>

namespace suite {

using arcslip::continuation::from_functions;
using std::numbers::e;
using std::numbers::pi;

ProblemPtr freudenstein_roth() {
  return from_functions(
      2, {parameter("x3", 0)},
      [](In u, In p, Out F) {
        const double x = u[0], y = u[1];
        F[0] = x - y * y * y + 5 * y * y - 2 * y - 13 + 34 * (p[0] - 1);
        F[1] = x + y * y * y + y * y - 14 * y - 29 + 10 * (p[0] - 1);
      },
      [](In u, In, MatrixOut J) {
        const double y = u[1];
        J << 1, -3 * y * y + 10 * y - 2, 1, 3 * y * y + 2 * y - 14;
      },
      [](In, In, int, Out dF) { dF << 34, 10; }, Vector::Constant(2, 10));
}

namespace {

// G(x) + (lambda - 1) G(start): the start at lambda = 0, a zero of G at lambda = 1.
template <class Function, class Slope>
ProblemPtr homotopy(const Eigen::Vector2d& start, Function G, Slope dG, double scale) {
  const Eigen::Vector2d at_start = G(start);
  return from_functions(
      2, {parameter("lambda", 0)},
      [=](In u, In p, Out F) { F = G(Eigen::Vector2d(u)) + (p[0] - 1) * at_start; },
      [=](In u, In, MatrixOut J) { J = dG(Eigen::Vector2d(u)); }, [=](In, In, int, Out dF) { dF = at_start; },
      Vector::Constant(2, scale));
}

}  // namespace

ProblemPtr boggs(const Eigen::Vector2d& start) {
  return homotopy(
      start,
      [](const Eigen::Vector2d& x) {
        return Eigen::Vector2d(x[0] * x[0] - x[1] + 1, x[0] - std::cos(pi * x[1] / 2));
      },
      [](const Eigen::Vector2d& x) {
        Eigen::Matrix2d d;
        d << 2 * x[0], -1, 1, pi / 2 * std::sin(pi * x[1] / 2);
        return d;
      },
      1);
}

ProblemPtr powell(const Eigen::Vector2d& start) {
  return homotopy(
      start,
      [](const Eigen::Vector2d& x) {
        return Eigen::Vector2d(1e4 * x[0] * x[1] - 1, std::exp(-x[0]) + std::exp(-x[1]) - 1.0001);
      },
      [](const Eigen::Vector2d& x) {
        Eigen::Matrix2d d;
        d << 1e4 * x[1], 1e4 * x[0], -std::exp(-x[0]), -std::exp(-x[1]);
        return d;
      },
      1);
}

ProblemPtr broyden(const Eigen::Vector2d& start) {
  return homotopy(
      start,
      [](const Eigen::Vector2d& x) {
        return Eigen::Vector2d(0.5 * std::sin(x[0] * x[1]) - x[1] / (4 * pi) - 0.5 * x[0],
                               (1 - 1 / (4 * pi)) * (std::exp(2 * x[0]) - e) + e * x[1] / pi - 2 * e * x[0]);
      },
      [](const Eigen::Vector2d& x) {
        const double c = 0.5 * std::cos(x[0] * x[1]);
        Eigen::Matrix2d d;
        d << x[1] * c - 0.5, x[0] * c - 1 / (4 * pi), (1 - 1 / (4 * pi)) * 2 * std::exp(2 * x[0]) - 2 * e,
            e / pi;
        return d;
      },
      1);
}

ProblemPtr wacker(double A) {
  return from_functions(
      3, {parameter("x4", 0), parameter("A", A)},
      [](In u, In p, Out F) {
        const double t = p[0], a = p[1];
        F[0] = (1 - a * t) * u[0] + t * (std::exp(-u[1]) / 3 + a - 1 - 1 / (3 * e));
        F[1] = (1 - a * t) * u[1] + t * (-std::log(1 + u[2] * u[2]) / 5 + a - 1 - std::log(2.0) / 5);
        F[2] = (1 - a * u[2]) * u[2] + t * (std::sin(u[0]) + a - 1 - std::sin(1.0));
      },
      [](In u, In p, MatrixOut J) {
        const double t = p[0], a = p[1];
        J << 1 - a * t, -t * std::exp(-u[1]) / 3, 0,                //
            0, 1 - a * t, -t * 2 * u[2] / (5 * (1 + u[2] * u[2])),  //
            t * std::cos(u[0]), 0, 1 - 2 * a * u[2];
      },
      [](In u, In p, int k, Out dF) {
        const double t = p[0], a = p[1];
        if (k == 0)
          dF << -a * u[0] + std::exp(-u[1]) / 3 + a - 1 - 1 / (3 * e),
              -a * u[1] - std::log(1 + u[2] * u[2]) / 5 + a - 1 - std::log(2.0) / 5,
              std::sin(u[0]) + a - 1 - std::sin(1.0);
        else
          dF << t * (1 - u[0]), t * (1 - u[1]), t - u[2] * u[2];
      });
}

ProblemPtr cell_kinetics(int n) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    A(i, i) += 1;
    A(i + 1, i + 1) += 1;
    A(i, i + 1) -= 1;
    A(i + 1, i) -= 1;
  }
  return from_functions(
      n, {parameter("lambda", 0, 10)},
      [=](In u, In p, Out F) {
        F = A * u;
        for (int i = 0; i < n; ++i) F[i] += 100 * u[i] / (1 + u[i] + u[i] * u[i]) - p[0];
      },
      [=](In u, In, MatrixOut J) {
        J = A;
        for (int i = 0; i < n; ++i) J(i, i) += 100 * (1 - u[i] * u[i]) / std::pow(1 + u[i] + u[i] * u[i], 2);
      },
      [](In, In, int, Out dF) { dF.setConstant(-1); });
}

ProblemPtr trigger_circuit() {
  const double s0 = 1 / 1e4, s1 = 1 / 39.0, s2 = 1 / 51.0, s3 = 1 / 10.0, s4 = 1 / 25.5, s5 = 1 / 1.0,
               s6 = 1 / 0.62, s7 = 1 / 13.0, s8 = 1 / 0.201;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6);
  const auto between = [&](int i, int j, double s) {
    A(i, i) += s;
    A(j, j) += s;
    A(i, j) -= s;
    A(j, i) -= s;
  };
  between(0, 2, s0);
  between(0, 1, s1);
  between(1, 5, s3);
  between(2, 3, s4);
  between(3, 4, s5);
  between(4, 5, s7);
  A(0, 0) += s2;
  A(3, 3) += s6;
  A(5, 5) += s8;
  return from_functions(
      6, {parameter("input", 0)},
      [=](In u, In p, Out F) {
        F = A * u;
        F[0] += s2 * p[0];
        for (int i : {1, 4}) F[i] += 5.6e-8 * (std::exp(25 * u[i]) - 1);
        F[5] -= s8 * 7.65 * std::atan(1962 * (u[2] - u[0]));
      },
      [=](In u, In, MatrixOut J) {
        J = A;
        for (int i : {1, 4}) J(i, i) += 5.6e-8 * 25 * std::exp(25 * u[i]);
        const double z = 1962 * (u[2] - u[0]), slope = s8 * 7.65 * 1962 / (1 + z * z);
        J(5, 2) -= slope;
        J(5, 0) += slope;
      },
      [=](In, In, int, Out dF) {
        dF.setZero();
        dF[0] = s2;
      });
}

ProblemPtr ab() {
  return from_functions(
      2, {parameter("p1", 0, 0.1), parameter("p2", 14), parameter("p3", 2)},
      [](In u, In p, Out F) {
        const double rate = p[0] * (1 - u[0]) * std::exp(u[1]);
        F[0] = -u[0] + rate;
        F[1] = -u[1] + p[1] * rate - p[2] * u[1];
      },
      [](In u, In p, MatrixOut J) {
        const double by_x = -p[0] * std::exp(u[1]), by_y = p[0] * (1 - u[0]) * std::exp(u[1]);
        J << -1 + by_x, by_y, p[1] * by_x, -1 - p[2] + p[1] * by_y;
      },
      [](In u, In p, int k, Out dF) {
        const double by_p1 = (1 - u[0]) * std::exp(u[1]);
        if (k == 0)
          dF << by_p1, p[1] * by_p1;
        else if (k == 1)
          dF << 0, p[0] * by_p1;
        else
          dF << 0, -u[1];
      });
}

}  // namespace suite
