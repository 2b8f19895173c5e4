#include "continuation/suite/problems.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace suite {

using arcslip::continuation::from_functions;
using std::numbers::pi;

ProblemPtr aircraft(double elevator) {
  // Columns: roll, pitch, yaw, angle of attack, sideslip; elevator, aileron, rudder.
  Eigen::Matrix<double, 5, 8> B;
  B << -3.933, 0.107, 0.126, 0, -9.99, 0, -45.83, -7.64,  //
      0, -0.987, 0, -22.95, 0, -28.37, 0, 0,              //
      0.002, 0, -0.235, 0, 5.67, 0, -0.921, -6.51,        //
      0, 1, 0, -1, 0, -0.168, 0, 0,                       //
      0, 0, -1, 0, -0.196, 0, -0.0071, 0;
  constexpr int aileron = 6;
  struct Product {
    int equation, j, k;
    double factor;
  };
  const std::array<Product, 11> products = {{{0, 1, 2, -0.727},
                                             {0, 2, 3, 8.39},
                                             {0, 3, 4, -684.4},
                                             {0, 3, aileron, 63.5},
                                             {1, 0, 2, 0.949},
                                             {1, 0, 4, 0.173},
                                             {2, 0, 1, -0.716},
                                             {2, 0, 3, -1.578},
                                             {2, 3, aileron, 1.132},
                                             {3, 0, 4, -1},
                                             {4, 0, 3, 1}}};
  const auto all = [](In u, In p) {
    Vector x(8);
    x << u, p[1], p[0], p[2];
    return x;
  };
  return from_functions(
      5, {parameter("aileron", 0), parameter("elevator", elevator), parameter("rudder", 0)},
      [=](In u, In p, Out F) {
        const Vector x = all(u, p);
        F = B * x;
        for (const Product& q : products) F[q.equation] += q.factor * x[q.j] * x[q.k];
      },
      [=](In u, In p, MatrixOut J) {
        const Vector x = all(u, p);
        J = B.leftCols<5>();
        for (const Product& q : products) {
          J(q.equation, q.j) += q.factor * x[q.k];
          if (q.k < 5) J(q.equation, q.k) += q.factor * x[q.j];
        }
      },
      [=](In u, In, int k, Out dF) {
        dF = B.col(k == 0 ? aileron : k == 1 ? 5 : 7);
        if (k != 0) return;
        for (const Product& q : products)
          if (q.k == aileron) dF[q.equation] += q.factor * u[q.j];
      });
}

ProblemPtr riks() {
  Eigen::Matrix3d support;  // columns
  support << 2, -1, -1,     //
      0, 1, -2,             //
      0, 0, 1;
  const Eigen::Vector3d stiffness = Eigen::Vector3d(10, 6, 5) / 21;
  return from_functions(
      3, {parameter("load_z", 0), parameter("load_x", 0), parameter("load_y", 0)},
      [=](In u, In p, Out F) {
        F << p[1], p[2], p[0];
        for (int i = 0; i < 3; ++i) {
          const Eigen::Vector3d d = u - support.col(i);
          F += stiffness[i] * (1 - support.col(i).norm() / d.norm()) * d;
        }
      },
      [=](In u, In, MatrixOut J) {
        J.setZero();
        for (int i = 0; i < 3; ++i) {
          const Eigen::Vector3d d = u - support.col(i);
          const double length = support.col(i).norm(), r = d.norm();
          J.diagonal().array() += stiffness[i] * (1 - length / r);
          J += stiffness[i] * length / (r * r * r) * d * d.transpose();
        }
      },
      [](In, In, int k, Out dF) {
        dF.setZero();
        dF[k == 0 ? 2 : k - 1] = 1;
      });
}

ProblemPtr oden(double angle) {
  constexpr double height = 2;
  return from_functions(
      2, {parameter("load", 0), parameter("angle", angle)},
      [](In u, In p, Out F) {
        const double x = u[0], y = u[1];
        F[0] = x * x * x - 3 * height * x * x + 2 * height * height * x + x * y * y - height * y * y -
               p[0] * std::cos(p[1]);
        F[1] = x * x * y - 2 * height * x * y + y * y * y + 2 * y - p[0] * std::sin(p[1]);
      },
      [](In u, In, MatrixOut J) {
        const double x = u[0], y = u[1];
        const double coupling = 2 * x * y - 2 * height * y;
        J << 3 * x * x - 6 * height * x + 2 * height * height + y * y, coupling, coupling,
            x * x - 2 * height * x + 3 * y * y + 2;
      },
      [](In, In p, int k, Out dF) {
        if (k == 0)
          dF << -std::cos(p[1]), -std::sin(p[1]);
        else
          dF << p[0] * std::sin(p[1]), -p[0] * std::cos(p[1]);
      });
}

ProblemPtr buckling_spring(double mu) {
  return from_functions(
      2, {parameter("lambda", 0), parameter("mu", mu)},
      [](In u, In p, Out F) {
        const double s = std::sin(u[1]), c = std::cos(u[1]);
        F[0] = -2 * (1 - u[0]) + 2 * p[0] * c + p[1] * s;
        F[1] = 0.5 * u[1] - 2 * p[0] * u[0] * s + p[1] * u[0] * c;
      },
      [](In u, In p, MatrixOut J) {
        const double s = std::sin(u[1]), c = std::cos(u[1]);
        J << 2, -2 * p[0] * s + p[1] * c, -2 * p[0] * s + p[1] * c,
            0.5 - 2 * p[0] * u[0] * c - p[1] * u[0] * s;
      },
      [](In u, In, int k, Out dF) {
        const double s = std::sin(u[1]), c = std::cos(u[1]);
        if (k == 0)
          dF << 2 * c, -2 * u[0] * s;
        else
          dF << s, u[0] * c;
      });
}

namespace {

// (K - omega^2) u + D (b, -a) = (g, 0), where K and D depend on the amplitude A and on the parameters.
void balance(In u, double K, double D, double g, Out F) {
  F << K * u[0] + D * u[1] - g, K * u[1] - D * u[0];
}

void balance_jacobian(In u, double K, double D, double K_A, double D_A, MatrixOut J) {
  const double A = u.norm();
  const Eigen::Vector2d by_A(K_A * u[0] + D_A * u[1], K_A * u[1] - D_A * u[0]);
  J << K, D, -D, K;
  if (A > 0) J += by_A * u.transpose() / A;
}

}  // namespace

ProblemPtr duffing_1harmonic(double g, double d, double alpha) {
  return from_functions(
      2, {parameter("omega", 1), parameter("g", g, 0.1), parameter("d", d, 0.1), parameter("alpha", alpha)},
      [](In u, In p, Out F) {
        balance(u, 1 - p[0] * p[0] + 0.75 * p[3] * u.squaredNorm(), p[2] * p[0], p[1], F);
      },
      [](In u, In p, MatrixOut J) {
        balance_jacobian(u, 1 - p[0] * p[0] + 0.75 * p[3] * u.squaredNorm(), p[2] * p[0],
                         1.5 * p[3] * u.norm(), 0, J);
      },
      [](In u, In p, int k, Out dF) {
        if (k == 0)
          balance(u, -2 * p[0], p[2], 0, dF);
        else if (k == 1)
          balance(u, 0, 0, 1, dF);
        else if (k == 2)
          balance(u, 0, p[0], 0, dF);
        else
          balance(u, 0.75 * u.squaredNorm(), 0, 0, dF);
      });
}

namespace {

// Jenkins element under x = A cos: force k x + h (dx/dt) / omega. With A0 = mu Fn / kd, the amplitude at
// which it begins to slip, and cos(theta) = 1 - 2 A0 / A: k = kd (theta - sin(theta) cos(theta)) / pi, and h
// = 4 mu Fn (A - A0) / (pi A^2), by the energy dissipated in a period.
struct Describing {
  double k, h, k_A, h_A, k_Fn, h_Fn;
};

constexpr double kd = 0.5, mu = 0.5;

bool slips(double A, double Fn) {
  return kd * A > mu * Fn;
}

Describing jenkins(double A, double Fn) {
  if (!slips(A, Fn)) return {kd, 0, 0, 0, 0, 0};
  const double A0 = mu * Fn / kd;
  const double theta = std::acos(1 - 2 * A0 / A), s = std::sin(theta);
  return {kd / pi * (theta - s * std::cos(theta)),
          4 * mu * Fn / pi * (A - A0) / (A * A),
          -4 * kd * A0 * s / (pi * A * A),
          4 * mu * Fn / pi * (2 * A0 - A) / (A * A * A),
          4 * mu * s / (pi * A),
          4 * mu / pi * (A - 2 * A0) / (A * A)};
}

}  // namespace

ProblemPtr duffing_jenkins_1harmonic(double omega, double Fn) {
  constexpr double c = 0.02, alpha = 0.5, g = 0.5;
  const auto stiffness = [](In u, In p, const Describing& j) {
    return 1 - p[0] * p[0] + 0.75 * alpha * u.squaredNorm() + j.k;
  };
  const ProblemPtr smooth = from_functions(
      2, {parameter("omega", omega), parameter("Fn", Fn)},
      [=](In u, In p, Out F) {
        const Describing j = jenkins(u.norm(), p[1]);
        balance(u, stiffness(u, p, j), c * p[0] + j.h, g, F);
      },
      [=](In u, In p, MatrixOut J) {
        const Describing j = jenkins(u.norm(), p[1]);
        balance_jacobian(u, stiffness(u, p, j), c * p[0] + j.h, 1.5 * alpha * u.norm() + j.k_A, j.h_A, J);
      },
      [=](In u, In p, int k, Out dF) {
        const Describing j = jenkins(u.norm(), p[1]);
        if (k == 0)
          balance(u, -2 * p[0], c, 0, dF);
        else
          balance(u, j.k_Fn, j.h_Fn, 0, dF);
      });
  return in_pieces(smooth, [](In u, In p) -> std::uint64_t { return slips(u.norm(), p[1]); });
}

}  // namespace suite
