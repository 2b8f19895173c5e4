#pragma once
// Problems whose minima are known.

#include <arcslip/optimize/nlopt/minimize.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

/// Rosenbrock 1960: 0 at (1, 1).
inline arcslip::optimize::NonlinearProgram rosenbrock() {
  auto f = [](std::span<const double> x, std::span<double> g) {
    const double a = 1 - x[0], b = x[1] - x[0] * x[0];
    if (!g.empty()) {
      g[0] = -2 * a - 400 * x[0] * b;
      g[1] = 200 * b;
    }
    return a * a + 100 * b * b;
  };
  return {.objective = f, .lower = {-2, -2}, .upper = {2, 2}};
}

/// Dixon & Szego 1978: six minima, the two lowest -1.0316284535.
inline arcslip::optimize::NonlinearProgram six_hump_camel() {
  auto f = [](std::span<const double> p, std::span<double> g) {
    const double x = p[0], y = p[1];
    if (!g.empty()) {
      g[0] = 8 * x - 8.4 * std::pow(x, 3) + 2 * std::pow(x, 5) + y;
      g[1] = x - 8 * y + 16 * std::pow(y, 3);
    }
    return (4 - 2.1 * x * x + std::pow(x, 4) / 3) * x * x + x * y + (-4 + 4 * y * y) * y * y;
  };
  return {.objective = f, .lower = {-3, -2}, .upper = {3, 2}};
}

/// Hock & Schittkowski 1981, problem 71: min x0 x3 (x0 + x1 + x2) + x2, x0 x1 x2 x3 >= 25, |x|^2 <= 40, 1 <=
/// x <= 5.
inline arcslip::optimize::NonlinearProgram hock_schittkowski_71() {
  auto f = [](std::span<const double> x, std::span<double> g) {
    if (!g.empty()) {
      g[0] = x[3] * (2 * x[0] + x[1] + x[2]);
      g[1] = x[0] * x[3];
      g[2] = x[0] * x[3] + 1;
      g[3] = x[0] * (x[0] + x[1] + x[2]);
    }
    return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
  };
  auto product = [](std::span<const double> x, std::span<double> g) {
    const double all = x[0] * x[1] * x[2] * x[3];
    for (std::size_t i = 0; i < g.size(); ++i) g[i] = -all / x[i];
    return 25 - all;
  };
  auto square = [](std::span<const double> x, std::span<double> g) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * x[i];
    for (std::size_t i = 0; i < g.size(); ++i) g[i] = 2 * x[i];
    return sum - 40;
  };
  return {.objective = f,
          .lower = {1, 1, 1, 1},
          .upper = {5, 5, 5, 5},
          .constraints = {{"product", product}, {"square", square}}};
}

/// Peak amplitude kd A = p / (1 - pi / (4 p)) of an undamped oscillator with a friction damper of slip force
/// p under a force of 1 N, in one harmonic; unbounded for p <= pi / 4.
inline arcslip::optimize::NonlinearProgram friction_damper(double lower, double upper) {
  auto f = [](std::span<const double> x, std::span<double> g) {
    const double p = x[0], quarter = std::numbers::pi / 4;
    if (p <= quarter) return std::numeric_limits<double>::infinity();
    const double over = p - quarter;
    if (!g.empty()) g[0] = p * (p - 2 * quarter) / (over * over);
    return p * p / over;
  };
  return {.objective = f, .lower = {lower}, .upper = {upper}};
}
