#pragma once
// Test problems with known folds; numbers from tests/reference/continuation.json.

#include <arcslip/continuation/problem/problem_from_functions.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>

#include <cmath>

namespace problems {

using namespace arcslip::continuation;

inline Parameter parameter(std::string name, double value, double scale = 1) {
  return {std::move(name), "", value, scale, -1e300, 1e300};
}

inline Options window(double lower, double upper) {
  Options options;
  options.lower = lower;
  options.upper = upper;
  return options;
}

/// Of one unknown.
inline Start at(double u, double p, int direction = 1) {
  return {.u = Vector{{u}}, .p = Vector{{p}}, .free = 0, .direction = direction};
}

/// mu + lambda x - x^3 = 0
inline std::shared_ptr<const Problem> cusp() {
  return from_functions(
      1, {parameter("mu", 0), parameter("lambda", 1)},
      [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[1] - 3 * u[0] * u[0]; });
}

/// u^2 + p^2 = 1 by a turn about (0, 0): a closed branch with two folds.
inline std::shared_ptr<const Problem> circle() {
  return from_functions({.size = 1,
                         .parameters = {parameter("p", 0)},
                         .residual = [](In u, In p, Out F) { F[0] = u[0] * u[0] + p[0] * p[0] - 1; },
                         .jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0]; },
                         .derivative = [](In, In p, int, Out dF) { dF[0] = 2 * p[0]; }});
}

/// PITCON test_con 1; the free parameter is x3.
inline std::shared_ptr<const Problem> freudenstein_roth() {
  return from_functions(
      2, {parameter("x3", 0)},
      [](In u, In p, Out F) {
        F[0] = u[0] - std::pow(u[1], 3) + 5 * u[1] * u[1] - 2 * u[1] - 13 + 34 * (p[0] - 1);
        F[1] = u[0] + std::pow(u[1], 3) + u[1] * u[1] - 14 * u[1] - 29 + 10 * (p[0] - 1);
      },
      {}, {}, Vector::Constant(2, 10));
}

/// LOCA ChanProblem, n nodes, beta = 0.
inline std::shared_ptr<const Problem> chan(int n) {
  const double h = 1.0 / (n - 1);
  const auto rate = [](double T) { return 1 + (T + T * T / 2) / (1 + T * T / 100); };
  const auto slope = [](double T) {
    const double d = 1 + T * T / 100;
    return ((1 + T) * d - (T + T * T / 2) * T / 50) / (d * d);
  };
  return from_functions(
      n, {parameter("alpha", 0)},
      [=](In u, In p, Out F) {
        F[0] = u[0];
        F[n - 1] = u[n - 1];
        for (int i = 1; i + 1 < n; ++i) F[i] = u[i - 1] - 2 * u[i] + u[i + 1] + p[0] * h * h * rate(u[i]);
      },
      [=](In u, In p, Eigen::Ref<Eigen::MatrixXd> J) {
        J.setZero();
        J(0, 0) = J(n - 1, n - 1) = 1;
        for (int i = 1; i + 1 < n; ++i) {
          J(i, i - 1) = J(i, i + 1) = 1;
          J(i, i) = -2 + p[0] * h * h * slope(u[i]);
        }
      });
}

/// u'' + (lambda sin u + kappa u) = 0, u(0) = u(1) = 0, on n inner nodes, h = 1 / (n + 1): an elastic rod,
/// whose branches leave u = 0 at lambda = (2 / h)^2 sin^2(k pi h / 2) - kappa in the direction sin(k pi x).
/// Equations times h^2; kappa is a parameter of rods on a foundation only.
inline Functions rod(int n, bool on_foundation = false) {
  const double h2 = 1.0 / ((n + 1.0) * (n + 1.0));
  const auto kappa = [=](In p) { return on_foundation ? p[1] : 0; };
  Functions f;
  f.size = n;
  f.parameters = {parameter("lambda", 0, 10)};
  if (on_foundation) f.parameters.push_back(parameter("kappa", 0, 10));
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < n; ++i)
      F[i] = (i ? u[i - 1] : 0) - 2 * u[i] + (i + 1 < n ? u[i + 1] : 0) +
             h2 * (p[0] * std::sin(u[i]) + kappa(p) * u[i]);
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, -2 + h2 * (p[0] * std::cos(u[i]) + kappa(p)));
      if (i) entries.emplace_back(i, i - 1, 1), entries.emplace_back(i - 1, i, 1);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int k, Out dF) {
    for (int i = 0; i < n; ++i) dF[i] = h2 * (k == 0 ? std::sin(u[i]) : u[i]);
  };
  f.scales = Vector::Constant(n, std::sqrt(n));
  return f;
}

/// The same with a dense Jacobian.
inline Functions dense(Functions f) {
  f.jacobian = [sparse = f.sparse_jacobian](In u, In p, Eigen::Ref<Matrix> J) {
    SparseMatrix entries(J.rows(), J.cols());
    sparse(u, p, entries);
    J = entries;
  };
  f.sparse_jacobian = {};
  return f;
}

inline std::vector<Event> events_named(const Branch& branch, const std::string& name) {
  std::vector<Event> found;
  for (const Event& event : branch.events)
    if (event.monitor == name) found.push_back(event);
  return found;
}

}  // namespace problems
