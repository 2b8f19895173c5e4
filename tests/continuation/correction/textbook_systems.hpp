#pragma once
// Small systems of textbooks, and where guesses of their solutions may lie.

#include "continuation/problems.hpp"

#include <functional>
#include <string>
#include <vector>

namespace textbook {

using namespace arcslip::continuation;

struct System {
  std::string name;
  int size;
  double p;             // the parameter
  double lower, upper;  // of the unknowns of a guess, in scales
  std::function<void(In, In, Out)> residual;
  int damped = 0;  // of 1000 guesses that Newton's method with an absolute natural test and 30 iterations
                   // solves, by a program that is not part of this project; 0: not known
  Vector scales{};

  Vector scale() const { return scales.size() > 0 ? scales : Vector(Vector::Ones(size)); }
  std::shared_ptr<const Problem> problem() const {
    return from_functions(size, {{"p", "", p}}, residual, {}, {}, scale());
  }
};

inline void lorenz(In u, In p, Out F) {
  F << 10 * (u[1] - u[0]), u[0] * (p[0] - u[2]) - u[1], u[0] * u[1] - 8.0 / 3 * u[2];
}

/// -u'' on n inner points of (0, 1), times h^2.
inline double second_difference(In u, Eigen::Index i) {
  const Eigen::Index n = u.size();
  return 2 * u[i] - (i > 0 ? u[i - 1] : 0) - (i + 1 < n ? u[i + 1] : 0);
}

// clang-format off
/// Those of the findings' survey come first.
inline std::vector<System> systems() {
  std::vector<System> all;
  all.push_back({"p u + u^3", 1, 2, -1, 1,
                 [](In u, In p, Out F) { F[0] = p[0] * u[0] + u[0] * u[0] * u[0]; }, 1000});
  all.push_back({"pendulum pair", 2, 2, -1, 1, [](In u, In p, Out F) {
    F << std::sin(u[0]) + p[0] * u[1], u[1] * (1 + u[0]) + 0.3 * u[0] * u[0]; }, 869});
  all.push_back({"Lorenz, all motions end at rest", 3, 0.5, -1, 1, lorenz, 1000});
  all.push_back({"Lorenz, rho = 24", 3, 24, -20, 20, lorenz, 842});
  all.push_back({"repressilator", 3, 10, 0, 100, [](In u, In p, Out F) {
    const auto hill = [&](double z) { return p[0] * 8000 / (8000 + z * z * z); };
    F << hill(u[2]) - 0.1 * u[0], hill(u[0]) - 0.1 * u[1], hill(u[1]) - 0.1 * u[2]; }, 813});
  all.push_back({"sigma factor", 2, 15, 0, 50, [](In u, In p, Out F) {
    const double a = std::pow(p[0] * u[0], 3), b = std::pow(9 * u[1], 3);
    F << 0.01 + 2 * a / (a + b + 8000) - 0.05 * u[0], 0.005 * (u[0] - u[1]); }, 830});
  all.push_back({"FitzHugh-Nagumo", 2, 0, -1, 1, [](In u, In p, Out F) {
    F << u[0] - u[0] * u[0] * u[0] / 3 - u[1] + p[0], 0.08 * (u[0] - 0.8 * u[1]); }, 1000});
  all.push_back({"Bratu", 20, 1, 0, 3, [](In u, In p, Out F) {
    for (Eigen::Index i = 0; i < u.size(); ++i) F[i] = second_difference(u, i) - p[0] / 441 * std::exp(u[i]); }, 999});
  all.push_back({"Allen-Cahn", 20, 5, -0.5, 0.5, [](In u, In p, Out F) {
    for (Eigen::Index i = 0; i < u.size(); ++i)
      F[i] = second_difference(u, i) - p[0] / 441 * (u[i] - u[i] * u[i] * u[i]); }, 1000});
  all.push_back({"stirred tank", 2, 280, 0.9, 1.5, [](In u, In p, Out F) {
    const double rate = 7.2e10 * std::exp(-8750 / u[1]) * u[0];
    F << 1 - u[0] - rate, 350 - u[1] + 5e4 / 239 * rate + 5e4 / (100 * 239) * (p[0] - u[1]); }, 992,
    Vector{{1.0, 300.0}}});
  all.push_back({"Brusselator", 2, 2.5, 0, 5, [](In u, In p, Out F) {
    const double react = u[0] * u[0] * u[1];
    F << 1 - (p[0] + 1) * u[0] + react, p[0] * u[0] - react; }});
  all.push_back({"Roessler", 3, 0.2, -10, 10, [](In u, In p, Out F) {
    F << -u[1] - u[2], u[0] + p[0] * u[1], 0.2 + u[2] * (u[0] - 5.7); }});
  all.push_back({"Rosenzweig-MacArthur", 2, 3, 0, 4, [](In u, In p, Out F) {
    const double eaten = u[0] * u[1] / (1 + u[0]);
    F << u[0] * (1 - u[0] / p[0]) - eaten, eaten - 0.4 * u[1]; }});
  all.push_back({"toggle switch", 2, 4, 0, 5, [](In u, In p, Out F) {
    F << p[0] / (1 + u[1] * u[1]) - u[0], p[0] / (1 + u[0] * u[0]) - u[1]; }});
  all.push_back({"Oregonator", 3, 1, 0, 1, [](In u, In p, Out F) {
    F << (u[1] * (8e-4 - u[0]) + u[0] * (1 - u[0])) / 0.1, (-u[1] * (8e-4 + u[0]) + p[0] * u[2]), u[0] - u[2]; }});
  all.push_back({"Lorenz-84", 3, 5, -3, 3, [](In u, In p, Out F) {
    F << -u[1] * u[1] - u[2] * u[2] - 0.25 * (u[0] - p[0]), u[0] * u[1] - 4 * u[0] * u[2] - u[1] + 1,
         4 * u[0] * u[1] + u[0] * u[2] - u[2]; }});
  all.push_back({"von Mises truss", 1, 0.05, -3, 3, [](In u, In p, Out F) {
    const double height = 0.5 - u[0];
    F[0] = p[0] - (1 / std::sqrt(1 + height * height) - 1 / std::sqrt(1.25)) * -height; }});
  all.push_back({"Rosenbrock", 2, 1, -2, 2, [](In u, In p, Out F) {
    F << p[0] - u[0], 10 * (u[1] - u[0] * u[0]); }});
  all.push_back({"Freudenstein-Roth", 2, 0, -20, 20, [](In u, In p, Out F) {
    F << u[0] - std::pow(u[1], 3) + 5 * u[1] * u[1] - 2 * u[1] - 13 + p[0],
         u[0] + std::pow(u[1], 3) + u[1] * u[1] - 14 * u[1] - 29; }});
  all.push_back({"Himmelblau", 2, 11, -5, 5, [](In u, In p, Out F) {
    F << u[0] * u[0] + u[1] - p[0], u[0] + u[1] * u[1] - 7; }});
  all.push_back({"Broyden, tridiagonal", 10, 1, -2, 2, [](In u, In p, Out F) {
    const Eigen::Index n = u.size();
    for (Eigen::Index i = 0; i < n; ++i)
      F[i] = (3 - 2 * u[i]) * u[i] - (i > 0 ? u[i - 1] : 0) - 2 * (i + 1 < n ? u[i + 1] : 0) + p[0]; }});
  all.push_back({"Brown, almost linear", 5, 6, -1, 2, [](In u, In p, Out F) {
    F = u.array() + u.sum() - p[0];
    F[4] = u.prod() - 1; }});
  all.push_back({"static Duffing beam", 1, 0.3, -2, 2, [](In u, In p, Out F) {
    F[0] = u[0] * u[0] * u[0] - u[0] - p[0]; }});
  all.push_back({"parabola from its fold", 1, 1, -2, 2, [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0]; }});
  return all;
}
// clang-format on

}  // namespace textbook
