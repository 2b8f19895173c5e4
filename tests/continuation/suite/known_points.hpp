#pragma once
// Problems whose folds and branch points are known, from closed forms or from the literature, most of them
// with a sparse Jacobian.

#include "continuation/linear/users_solvers.hpp"
#include "continuation/suite/cases.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace known_points {

using namespace suite;
using namespace users;

inline constexpr double pi = std::numbers::pi;

struct Known {
  std::string monitor;
  double parameter;
};

// A problem whose folds and branch points are known, in the order of its branch.
struct Job {
  std::string name;
  ProblemPtr problem;
  Start start;
  Options options;
  std::vector<Known> known;
  double digits;  // of what is known: relative
};

// Cells in a row with free ends, coupled by their differences: cell i has the equations f(u_i) + d (u_(i-1) -
// 2 u_i + u_(i+1)), and on equal cells the coupling has the eigenvalues -d 4 sin^2(k pi / 2 n).
inline double coupling_eigenvalue(int k, int n) {
  return 4 * std::pow(std::sin(k * pi / (2.0 * n)), 2);
}

struct Cell {
  std::function<double(double u, double p)> f, f_u, f_p;
};

inline Functions chain(int n, double d, const Cell& cell, Parameter p) {
  Functions f;
  f.size = n;
  f.parameters = {std::move(p)};
  f.scales = Vector::Constant(n, std::sqrt(n));
  f.residual = [=](In u, In q, Out F) {
    for (int i = 0; i < n; ++i)
      F[i] = cell.f(u[i], q[0]) + d * ((i > 0 ? u[i - 1] - u[i] : 0) + (i + 1 < n ? u[i + 1] - u[i] : 0));
  };
  f.sparse_jacobian = [=](In u, In q, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, cell.f_u(u[i], q[0]) - d * ((i > 0) + (i + 1 < n)));
      if (i > 0) entries.emplace_back(i, i - 1, d), entries.emplace_back(i - 1, i, d);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In q, int, Out dF) {
    for (int i = 0; i < n; ++i) dF[i] = cell.f_p(u[i], q[0]);
  };
  return f;
}

inline Start on_equal(int n, double u, double p) {
  return {Vector::Constant(n, u), Vector{{p}}, 0, 1};
}

// p + u - u^3: folds at u = -+1/sqrt 3 where p = +-2 / (3 sqrt 3); other branches cross where 1 - 3 u^2 = d
// mu_k.
inline Job cubic_cells() {
  const int n = 10;
  const double d = 10, fold = 2 / (3 * std::sqrt(3.0));
  const Cell cell{[](double u, double p) { return p + u - u * u * u; },
                  [](double u, double) { return 1 - 3 * u * u; }, [](double, double) { return 1.0; }};
  std::vector<Known> known{{"fold", fold}};
  const double mu = d * coupling_eigenvalue(1, n);
  if (mu < 1) {
    const double u = std::sqrt((1 - mu) / 3);
    known.push_back({"branch_point", u - u * u * u});
    known.push_back({"branch_point", -(u - u * u * u)});
  }
  known.push_back({"fold", -fold});
  Options options = window(-1, 1);
  options.step.largest_parameter = 1;
  const ProblemPtr problem = from_functions(chain(n, d, cell, parameter("p", -1)));
  return {"cubic cells", problem, on_equal(n, -1.32, -1), options, known, 1e-11};
}

// Semenov's p e^u - u: a fold at u = 1, p = 1/e; others cross where u - 1 = d mu_k, p = u e^-u.
inline Job bratu_cells() {
  const int n = 12;
  const double d = 2;
  const Cell cell{[](double u, double p) { return p * std::exp(u) - u; },
                  [](double u, double p) { return p * std::exp(u) - 1; },
                  [](double u, double) { return std::exp(u); }};
  std::vector<Known> known{{"fold", std::exp(-1.0)}};
  for (int k = 1; k < n; ++k) {
    const double u = 1 + d * coupling_eigenvalue(k, n);
    const double p = u * std::exp(-u);
    if (p > 0.02) known.push_back({"branch_point", p});
  }
  Options options = window(0.02, 1);
  options.step.largest_parameter = 0.01;
  return {"cells of Bratu's reaction",
          from_functions(chain(n, d, cell, parameter("p", 0.02))),
          on_equal(n, 0.02, 0.02),
          options,
          known,
          1e-10};
}

// p u - u^3 in a row: u = 0 is crossed where p = d mu_k.
inline Job pitchfork_cells() {
  const int n = 40;
  const double d = 3;
  const Cell cell{[](double u, double p) { return p * u - u * u * u; },
                  [](double u, double p) { return p - 3 * u * u; }, [](double u, double) { return u; }};
  std::vector<Known> known;
  for (int k = 0; d * coupling_eigenvalue(k, n) < 2; ++k)
    known.push_back({"branch_point", d * coupling_eigenvalue(k, n)});
  return {"coupled pitchforks",
          from_functions(chain(n, d, cell, parameter("p", -1))),
          on_equal(n, 0, -1),
          window(-1, 2),
          known,
          1e-10};
}

// Bratu's problem by Numerov's method, of fourth order: its fold is 3.513830719125 (tests/reference).
inline Job bratu() {
  const int n = 399;
  const double h = 1.0 / (n + 1), c = h * h / 12;
  Functions f;
  f.size = n;
  f.parameters = {parameter("lambda", 0.1)};
  f.scales = Vector::Constant(n, std::sqrt(n));
  const auto reaction = [](In u, int i, int n_) { return i < 0 || i >= n_ ? 1.0 : std::exp(u[i]); };
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? u[i - 1] - u[i] : -u[i], right = i + 1 < n ? u[i + 1] - u[i] : -u[i];
      F[i] =
          left + right + c * p[0] * (reaction(u, i - 1, n) + 10 * reaction(u, i, n) + reaction(u, i + 1, n));
    }
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < n; ++j) {
      const double slope = c * p[0] * std::exp(u[j]);
      entries.emplace_back(j, j, 10 * slope - 2);
      if (j > 0) entries.emplace_back(j - 1, j, 1 + slope);
      if (j + 1 < n) entries.emplace_back(j + 1, j, 1 + slope);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int, Out dF) {
    for (int i = 0; i < n; ++i)
      dF[i] = c * (reaction(u, i - 1, n) + 10 * reaction(u, i, n) + reaction(u, i + 1, n));
  };
  return {"Bratu's problem", from_functions(std::move(f)), {Vector::Zero(n), Vector{{0.1}}, 0, 1},
          window(0.1, 5),    {{"fold", 3.513830719125}},   1e-9};
}

// u'' + lambda (u - u^3), u(0) = u(1) = 0: u = 0 is crossed at (2/h)^2 sin^2(k pi h/2) (Chafee and Infante
// 1974).
inline Job chafee_infante() {
  const int n = 60;
  const double h2 = 1.0 / ((n + 1.0) * (n + 1.0));
  Functions f;
  f.size = n;
  f.parameters = {parameter("lambda", 1, 10)};
  f.scales = Vector::Constant(n, std::sqrt(n));
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < n; ++i)
      F[i] = (i > 0 ? u[i - 1] : 0) - 2 * u[i] + (i + 1 < n ? u[i + 1] : 0) +
             h2 * p[0] * (u[i] - u[i] * u[i] * u[i]);
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, -2 + h2 * p[0] * (1 - 3 * u[i] * u[i]));
      if (i > 0) entries.emplace_back(i, i - 1, 1), entries.emplace_back(i - 1, i, 1);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int, Out dF) { dF = h2 * (u.array() - u.array().cube()); };
  std::vector<Known> known;
  for (int k = 1; k <= 4; ++k)
    known.push_back({"branch_point", 4 / h2 * std::pow(std::sin(k * pi / (2.0 * (n + 1))), 2)});
  const Start start{Vector::Zero(n), Vector{{1.0}}, 0, 1};
  return {"Chafee and Infante's problem", from_functions(std::move(f)), start, window(1, 170), known, 1e-10};
}

// A shallow arch of two bars, load p = u (u - 1) (u - 2) / 2, loaded by a spring: its folds, at u = 1 -+
// 1/sqrt 3, are at p = +-1 / (3 sqrt 3), whatever the spring.
inline Job snapping_arch() {
  const double k = 2, fold = 1 / (3 * std::sqrt(3.0));
  const ProblemPtr dense = from_functions(
      2, {parameter("p", -0.3)},
      [=](In u, In p, Out F) {
        F[0] = k * (u[1] - u[0]) - u[0] * (u[0] - 1) * (u[0] - 2) / 2;
        F[1] = p[0] - k * (u[1] - u[0]);
      },
      [=](In u, In, MatrixOut J) { J << -k - (3 * u[0] * u[0] - 6 * u[0] + 2) / 2, k, k, -k; },
      [](In, In, int, Out dF) { dF << 0, 1; });
  return {"a snapping arch",
          sparse(dense),
          {Vector{{-0.3, -0.5}}, Vector{{-0.3}}, 0, 1},
          window(-0.3, 0.4),
          {{"fold", fold}, {"fold", -fold}},
          1e-11};
}

// The Brusselator in a row of cells: equal ones x = A, y = B/A are left by patterns (Turing) where
// (B - 1 - D mu) (-A^2 - E mu) + A^2 B = 0, so that B = (1 + D mu) (A^2 + E mu) / (E mu), mu = mu_k.
inline Job brusselator_cells() {
  const int cells = 15;
  const double A = 2, D = 1, E = 10;
  Functions f;
  f.size = 2 * cells;
  f.parameters = {parameter("B", 1)};
  f.scales = Vector::Constant(2 * cells, std::sqrt(2 * cells));
  f.residual = [=](In u, In p, Out F) {
    const auto flow = [&](int i, int of) {
      return (i > 0 ? u[2 * i - 2 + of] - u[2 * i + of] : 0) +
             (i + 1 < cells ? u[2 * i + 2 + of] - u[2 * i + of] : 0);
    };
    for (int i = 0; i < cells; ++i) {
      const double x = u[2 * i], y = u[2 * i + 1];
      F[2 * i] = A - (p[0] + 1) * x + x * x * y + D * flow(i, 0);
      F[2 * i + 1] = p[0] * x - x * x * y + E * flow(i, 1);
    }
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < cells; ++i) {
      const double x = u[2 * i], y = u[2 * i + 1];
      const int neighbours = (i > 0) + (i + 1 < cells);
      entries.emplace_back(2 * i, 2 * i, -(p[0] + 1) + 2 * x * y - D * neighbours);
      entries.emplace_back(2 * i, 2 * i + 1, x * x);
      entries.emplace_back(2 * i + 1, 2 * i, p[0] - 2 * x * y);
      entries.emplace_back(2 * i + 1, 2 * i + 1, -x * x - E * neighbours);
      for (const int other : {i - 1, i + 1}) {
        if (other < 0 || other >= cells) continue;
        entries.emplace_back(2 * i, 2 * other, D);
        entries.emplace_back(2 * i + 1, 2 * other + 1, E);
      }
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int, Out dF) {
    for (int i = 0; i < cells; ++i) dF[2 * i] = -u[2 * i], dF[2 * i + 1] = u[2 * i];
  };
  std::vector<Known> known;
  for (int k = 1; k < cells; ++k) {
    const double mu = coupling_eigenvalue(k, cells), B = (1 + D * mu) * (A * A + E * mu) / (E * mu);
    if (B < 4) known.push_back({"branch_point", B});
  }
  std::sort(known.begin(), known.end(),
            [](const Known& a, const Known& b) { return a.parameter < b.parameter; });
  Vector start(2 * cells);
  for (int i = 0; i < cells; ++i) start[2 * i] = A, start[2 * i + 1] = 1 / A;
  return {"a row of Brusselators",
          from_functions(std::move(f)),
          {start, Vector{{1.0}}, 0, 1},
          window(1, 4),
          known,
          1e-10};
}

// A problem of the suite, with the folds that are known of it.
inline Job of_suite(const std::string& name) {
  const Case c = named(name);
  std::vector<Known> known;
  for (const double fold : c.folds.value_or(std::vector<double>{})) known.push_back({"fold", fold});
  return {name, sparse(c.problem), c.start, window(c.lower, c.upper), known, std::max(c.digits, 1e-11)};
}

inline Job normal_form(const std::string& name) {
  Job job = of_suite(name);
  job.known = {{"branch_point", 0}};
  return job;
}

inline std::vector<Job> jobs() {
  return {cubic_cells(),
          bratu(),
          normal_form("pitchfork"),
          normal_form("transcritical"),
          of_suite("duffing_1harmonic"),
          bratu_cells(),
          chafee_infante(),
          snapping_arch(),
          brusselator_cells(),
          pitchfork_cells()};
}

}  // namespace known_points
