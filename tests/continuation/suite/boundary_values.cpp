#include "continuation/suite/problems.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace suite {

using arcslip::continuation::from_functions;
using std::numbers::pi;

namespace {

// A u + lambda B f(u) = 0
template <class Function, class Slope>
ProblemPtr reaction(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Function f, Slope slope) {
  return from_functions(
      static_cast<int>(A.rows()), {parameter("lambda", 0)},
      [=](In u, In p, Out F) {
        const Vector rate = u.unaryExpr(f);
        F = A * u + p[0] * (B * rate);
      },
      [=](In u, In p, MatrixOut J) {
        const Vector by_u = u.unaryExpr(slope);
        J = A + p[0] * (B * by_u.asDiagonal());
      },
      [=](In u, In, int, Out dF) {
        const Vector rate = u.unaryExpr(f);
        dF = B * rate;
      });
}

double exponential(double u) {
  return std::exp(u);
}

Eigen::MatrixXd tridiagonal(int n, double centre, double side) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  T.diagonal().setConstant(centre);
  T.diagonal(1).setConstant(side);
  T.diagonal(-1).setConstant(side);
  return T;
}

}  // namespace

// Trefethen, Spectral Methods in MATLAB, 2000, theorem 7, on [0, 1].
ProblemPtr bratu_chebyshev(int n) {
  const int N = n + 1;
  Eigen::MatrixXd D(N + 1, N + 1);
  const auto c = [N](int j) { return (j == 0 || j == N ? 2.0 : 1.0) * (j % 2 ? -1 : 1); };
  for (int i = 0; i <= N; ++i) {
    D(i, i) = 0;
    for (int j = 0; j <= N; ++j) {
      if (i == j) continue;
      // x_i - x_j, x_j = (1 - cos(pi j / N)) / 2, without cancellation
      const double difference = std::sin((i + j) * pi / (2 * N)) * std::sin((i - j) * pi / (2 * N));
      D(i, j) = c(i) / c(j) / difference;
    }
    D(i, i) = -D.row(i).sum();
  }
  const Eigen::MatrixXd second = (D * D).block(1, 1, n, n);
  return reaction(second, Eigen::MatrixXd::Identity(n, n), exponential, exponential);
}

ProblemPtr bratu_differences(int n, int order) {
  const double h = 1.0 / (n + 1);
  const Eigen::MatrixXd second = tridiagonal(n, -2, 1) / (h * h);
  if (order == 2) return reaction(second, Eigen::MatrixXd::Identity(n, n), exponential, exponential);
  if (order != 4) throw std::invalid_argument("differences of order 2 or 4");
  // Numerov's average takes e^0 = 1 at both ends as well.
  const double end = 1.0 / 12;
  return from_functions(
      n, {parameter("lambda", 0)},
      [=](In u, In p, Out F) {
        F = second * u;
        for (int i = 0; i < n; ++i)
          F[i] +=
              p[0] / 12 *
              ((i > 0 ? std::exp(u[i - 1]) : 1) + 10 * std::exp(u[i]) + (i + 1 < n ? std::exp(u[i + 1]) : 1));
      },
      [=](In u, In p, MatrixOut J) {
        J = second;
        for (int i = 0; i < n; ++i) {
          if (i > 0) J(i, i - 1) += p[0] / 12 * std::exp(u[i - 1]);
          J(i, i) += p[0] * 10 / 12 * std::exp(u[i]);
          if (i + 1 < n) J(i, i + 1) += p[0] / 12 * std::exp(u[i + 1]);
        }
      },
      [=](In u, In, int, Out dF) {
        for (int i = 0; i < n; ++i)
          dF[i] = (i > 0 ? std::exp(u[i - 1]) / 12 : end) + 10 * std::exp(u[i]) / 12 +
                  (i + 1 < n ? std::exp(u[i + 1]) / 12 : end);
      });
}

ProblemPtr chan(int n) {
  const double h2 = 1.0 / ((n - 1) * (n - 1));
  const auto rate = [](double T) { return 1 + (T + T * T / 2) / (1 + T * T / 100); };
  const auto slope = [](double T) {
    const double d = 1 + T * T / 100;
    return ((1 + T) * d - (T + T * T / 2) * T / 50) / (d * d);
  };
  return from_functions(
      n, {parameter("alpha", 0), parameter("beta", 0)},
      [=](In u, In p, Out F) {
        F[0] = u[0] - p[1];
        F[n - 1] = u[n - 1] - p[1];
        for (int i = 1; i + 1 < n; ++i) F[i] = u[i - 1] - 2 * u[i] + u[i + 1] + p[0] * h2 * rate(u[i]);
      },
      [=](In u, In p, MatrixOut J) {
        J.setZero();
        J(0, 0) = J(n - 1, n - 1) = 1;
        for (int i = 1; i + 1 < n; ++i) {
          J(i, i - 1) = J(i, i + 1) = 1;
          J(i, i) = -2 + p[0] * h2 * slope(u[i]);
        }
      },
      [=](In u, In, int k, Out dF) {
        dF.setZero();
        if (k == 1)
          dF[0] = dF[n - 1] = -1;
        else
          for (int i = 1; i + 1 < n; ++i) dF[i] = h2 * rate(u[i]);
      });
}

ProblemPtr simpson(int m, bool rational) {
  const double h2 = 1.0 / ((m + 1) * (m + 1));
  const auto f = [=](double u) {
    return rational ? (100 + 100 * u + 51 * u * u) / (100 + u * u) : std::exp(u);
  };
  const auto slope = [=](double u) {
    const double d = 100 + u * u;
    return rational ? ((100 + 102 * u) * d - (100 + 100 * u + 51 * u * u) * 2 * u) / (d * d) : std::exp(u);
  };
  const int n = m * m;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n), B = Eigen::MatrixXd::Zero(n, n);
  Vector outside = Vector::Zero(n);  // neighbours on the boundary, where f = f(0)
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int di = -1; di <= 1; ++di)
        for (int dj = -1; dj <= 1; ++dj) {
          const int steps = std::abs(di) + std::abs(dj), at = i + m * j;
          const double average = steps == 0 ? 8.0 / 12 : steps == 1 ? 1.0 / 12 : 0;
          if (i + di < 0 || i + di >= m || j + dj < 0 || j + dj >= m) {
            outside[at] += average;
            continue;
          }
          const int other = i + di + m * (j + dj);
          A(at, other) = (steps == 0 ? -20.0 : steps == 1 ? 4.0 : 1.0) / (6 * h2);
          B(at, other) = average;
        }
  const Vector boundary = outside * f(0);
  return from_functions(
      n, {parameter("lambda", 0)},
      [=](In u, In p, Out F) { F = A * u + p[0] * (B * u.unaryExpr(f) + boundary); },
      [=](In u, In p, MatrixOut J) {
        const Vector by_u = u.unaryExpr(slope);
        J = A + p[0] * (B * by_u.asDiagonal());
      },
      [=](In u, In, int, Out dF) { dF = B * u.unaryExpr(f) + boundary; });
}

ProblemPtr keller(int m) {
  constexpr double alpha = 0.1, beta = 0.1, gamma = 0.1;
  const double h = 1.0 / (m - 2);
  const auto square = [](double x) { return x * x; };
  // The flux t^2 (1 + lambda / (w + alpha)^2) (u - v) between neighbours, w their mean, and its derivatives.
  struct Flux {
    double value, by_u, by_v, by_lambda;
  };
  const auto flux = [=](double t, double u, double v, double lambda) {
    const double w = 0.5 * (u + v) + alpha, f = 1 + lambda / (w * w), f_u = -lambda / (w * w * w);
    return Flux{t * t * f * (u - v), t * t * (f + f_u * (u - v)), t * t * (-f + f_u * (u - v)),
                t * t * (u - v) / (w * w)};
  };
  return from_functions(
      m, {parameter("lambda", 0)},
      [=](In u, In p, Out F) {
        F[0] = u[2] - u[0];
        F[m - 1] = u[m - 1] - 1;
        for (int i = 1; i + 1 < m; ++i)
          F[i] = flux((i - 1.5) * h, u[i], u[i - 1], p[0]).value +
                 flux((i - 0.5) * h, u[i], u[i + 1], p[0]).value +
                 h * h * square((i - 1) * h) * u[i] / (beta * (u[i] + gamma));
      },
      [=](In u, In p, MatrixOut J) {
        J.setZero();
        J(0, 2) = 1;
        J(0, 0) = -1;
        J(m - 1, m - 1) = 1;
        for (int i = 1; i + 1 < m; ++i) {
          const Flux left = flux((i - 1.5) * h, u[i], u[i - 1], p[0]);
          const Flux right = flux((i - 0.5) * h, u[i], u[i + 1], p[0]);
          J(i, i - 1) = left.by_v;
          J(i, i + 1) = right.by_v;
          J(i, i) =
              left.by_u + right.by_u + h * h * square((i - 1) * h) * gamma / (beta * square(u[i] + gamma));
        }
      },
      [=](In u, In p, int, Out dF) {
        dF.setZero();
        for (int i = 1; i + 1 < m; ++i)
          dF[i] = flux((i - 1.5) * h, u[i], u[i - 1], p[0]).by_lambda +
                  flux((i - 0.5) * h, u[i], u[i + 1], p[0]).by_lambda;
      });
}

ProblemPtr moore_spence(int m) {
  constexpr double beta = 0.4, gamma = 20;
  const auto rate = [](double y) { return y * std::exp(beta * gamma * (1 - y) / (1 + beta * (1 - y))); };
  const auto slope = [=](double y) {
    const double d = 1 + beta * (1 - y);
    return std::exp(beta * gamma * (1 - y) / d) * (1 - y * beta * gamma / (d * d));
  };
  const double h = 1.0 / (m - 1);
  Eigen::MatrixXd K(m, m);  // -(kernel x weights)
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) K(i, j) = -h * (j == 0 || j == m - 1 ? 0.5 : 1) * (std::max(i, j) * h - 1);
  return from_functions(
      m, {parameter("lambda", 0, 0.1)},
      [=](In u, In p, Out F) { F = (u.array() - 1).matrix() + p[0] * (K * u.unaryExpr(rate)); },
      [=](In u, In p, MatrixOut J) {
        const Vector by_u = u.unaryExpr(slope);
        J = Eigen::MatrixXd::Identity(m, m) + p[0] * (K * by_u.asDiagonal());
      },
      [=](In u, In, int, Out dF) { dF = K * u.unaryExpr(rate); });
}

ProblemPtr torsion(int m) {
  const double h = 1.0 / (m + 1);
  const auto index = [m](int i, int j) {  // -1 on the boundary, where u = 0
    return i < 1 || i > m || j < 1 || j > m ? -1 : (j - 1) * m + i - 1;
  };
  // Each cell is cut from south-west to north-east; a triangle (end, corner, end) with the right angle at its
  // corner.
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= m; ++j) {
      const int low = index(i, j), high = index(i + 1, j + 1);
      triangles.push_back({low, index(i + 1, j), high});
      triangles.push_back({low, index(i, j + 1), high});
    }
  // Of each triangle: half of phi((a^2 + b^2) / h^2) times the gradient of (a^2 + b^2) / 2.
  struct Slopes {
    double a, b, phi;
  };
  const auto slopes = [=](In u, const std::array<int, 3>& t) {
    const auto at = [&](int i) { return i < 0 ? 0.0 : u[i]; };
    const double a = at(t[0]) - at(t[1]), b = at(t[2]) - at(t[1]);
    return Slopes{a, b, std::exp(5 * (a * a + b * b) / (h * h))};
  };
  return from_functions(
      m * m, {parameter("lambda", 0)},
      [=](In u, In p, Out F) {
        F.setConstant(-p[0] * h * h);
        for (const auto& t : triangles) {
          const Slopes s = slopes(u, t);
          const double g[3] = {s.a, -s.a - s.b, s.b};
          for (std::size_t i = 0; i < 3; ++i)
            if (t[i] >= 0) F[t[i]] += 0.5 * s.phi * g[i];
        }
      },
      [=](In u, In, MatrixOut J) {
        J.setZero();
        for (const auto& t : triangles) {
          const Slopes s = slopes(u, t);
          const double g[3] = {s.a, -s.a - s.b, s.b};
          const double H[3][3] = {{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}};
          for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
              if (t[i] >= 0 && t[j] >= 0)
                J(t[i], t[j]) += 0.5 * s.phi * (H[i][j] + 10 / (h * h) * g[i] * g[j]);
        }
      },
      [=](In, In, int, Out dF) { dF.setConstant(-h * h); });
}

}  // namespace suite
