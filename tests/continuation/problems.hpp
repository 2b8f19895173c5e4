#pragma once
// Test problems with known folds; numbers from tests/reference/continuation.json.

#include <arcslip/continuation/functions.hpp>
#include <arcslip/continuation/tracer.hpp>

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

/// mu + lambda x - x^3 = 0
inline std::shared_ptr<const Problem> cusp() {
  return from_functions(
      1, {parameter("mu", 0), parameter("lambda", 1)},
      [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[1] - 3 * u[0] * u[0]; });
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

inline std::vector<Event> events_named(const Branch& branch, const std::string& name) {
  std::vector<Event> found;
  for (const Event& event : branch.events)
    if (event.monitor == name) found.push_back(event);
  return found;
}

}  // namespace problems
