#pragma once
// Systems u' = F(u, p) with known Hopf points.

#include "continuation/problems.hpp"

#include <numbers>

namespace problems {

// AUTO-07p, tutorial ab; parameters p1, p2, p3.
inline std::shared_ptr<const Problem> ab() {
  return from_functions(
      2, {parameter("p1", 0), parameter("p2", 14), parameter("p3", 2)},
      [](In u, In p, Out F) {
        const double rate = p[0] * (1 - u[0]) * std::exp(u[1]);
        F[0] = -u[0] + rate;
        F[1] = -u[1] + p[1] * rate - p[2] * u[1];
      },
      [](In u, In p, Eigen::Ref<Matrix> J) {
        const double e = p[0] * std::exp(u[1]), rate = (1 - u[0]) * e;
        J << -1 - e, rate, -p[1] * e, -1 + p[1] * rate - p[2];
      });
}

// Parameters A, B; the Hopf point is at B = 1 + A^2, omega = A (Prigogine and Lefever 1968).
inline std::shared_ptr<const Problem> brusselator() {
  Functions f;
  f.size = 2;
  f.parameters = {parameter("A", 1), parameter("B", 1)};
  f.residual = [](In u, In p, Out F) {
    const double x2y = u[0] * u[0] * u[1];
    F[0] = p[0] - (p[1] + 1) * u[0] + x2y;
    F[1] = p[1] * u[0] - x2y;
  };
  f.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) {
    const double xy = 2 * u[0] * u[1], x2 = u[0] * u[0];
    J << xy - p[1] - 1, x2, p[1] - xy, -x2;
  };
  f.second = [](In u, In, In w, In v, In q, Out du, Out dp) {
    const double left = w[0] - w[1];
    du[0] = left * (2 * u[1] * v[0] + 2 * u[0] * v[1] - q[1]);
    du[1] = left * 2 * u[0] * v[0];
    dp[0] = 0;
    dp[1] = -left * v[0];
  };
  return from_functions(std::move(f));
}

// The same along a line, x_t = .. + d1 x_ss, y_t = .. + d2 y_ss, with x = A, y = B/A at both ends, at `nodes`
// inner nodes; parameters B, A. Its homogeneous state loses stability to the mode sin k pi s, in differences
// too.
struct Line {
  int nodes = 20;
  double d1 = 0.008, d2 = 0.004;

  double wave(int k) const {
    return std::pow(2 * (nodes + 1) * std::sin(k * std::numbers::pi / (2 * (nodes + 1))), 2);
  }
  double B(int k, double A) const { return 1 + A * A + (d1 + d2) * wave(k); }
  double frequency(int k, double A) const {
    return std::sqrt(A * A + A * A * (d1 - d2) * wave(k) - std::pow(d2 * wave(k), 2));
  }
  Vector homogeneous(double A, double B) const { return Vector{{A, B / A}}.replicate(nodes, 1); }
  double rate(double d) const { return d * (nodes + 1) * (nodes + 1); }

  std::shared_ptr<const Problem> problem() const {
    const Line line = *this;
    Functions f;
    f.size = 2 * nodes;
    f.parameters = {parameter("B", 1), parameter("A", 2)};
    f.residual = [line](In u, In p, Out F) {
      const int m = line.nodes;
      const double c1 = line.rate(line.d1), c2 = line.rate(line.d2), B = p[0], A = p[1], y_end = B / A;
      for (int i = 0; i < m; ++i) {
        const double x = u[2 * i], y = u[2 * i + 1];
        const double xl = i > 0 ? u[2 * i - 2] : A, xr = i + 1 < m ? u[2 * i + 2] : A;
        const double yl = i > 0 ? u[2 * i - 1] : y_end, yr = i + 1 < m ? u[2 * i + 3] : y_end;
        F[2 * i] = A - (B + 1) * x + x * x * y + c1 * (xl - 2 * x + xr);
        F[2 * i + 1] = B * x - x * x * y + c2 * (yl - 2 * y + yr);
      }
    };
    f.sparse_jacobian = [line](In u, In p, SparseMatrix& J) {
      const int m = line.nodes;
      const double c1 = line.rate(line.d1), c2 = line.rate(line.d2);
      std::vector<Eigen::Triplet<double>> entries;
      for (int i = 0; i < m; ++i) {
        const double x = u[2 * i], y = u[2 * i + 1];
        entries.emplace_back(2 * i, 2 * i, 2 * x * y - p[0] - 1 - 2 * c1);
        entries.emplace_back(2 * i, 2 * i + 1, x * x);
        entries.emplace_back(2 * i + 1, 2 * i, p[0] - 2 * x * y);
        entries.emplace_back(2 * i + 1, 2 * i + 1, -x * x - 2 * c2);
        for (int j : {i - 1, i + 1})
          if (j >= 0 && j < m) {
            entries.emplace_back(2 * i, 2 * j, c1);
            entries.emplace_back(2 * i + 1, 2 * j + 1, c2);
          }
      }
      J.setFromTriplets(entries.begin(), entries.end());
    };
    return from_functions(std::move(f));
  }
};

// Parameters r, sigma, b.
inline std::shared_ptr<const Problem> lorenz() {
  return from_functions(
      3, {parameter("r", 2), parameter("sigma", 10), parameter("b", 8.0 / 3)},
      [](In u, In p, Out F) {
        F[0] = p[1] * (u[1] - u[0]);
        F[1] = u[0] * (p[0] - u[2]) - u[1];
        F[2] = u[0] * u[1] - p[2] * u[2];
      },
      [](In u, In p, Eigen::Ref<Matrix> J) {
        J << -p[1], p[1], 0, p[0] - u[2], -1, -u[0], u[1], u[0], -p[2];
      });
}

}  // namespace problems
