#include <arcslip/stability/legendre_fit.hpp>

#include <cmath>
#include <numbers>

namespace arcslip::time {
namespace {

constexpr int node_newton_steps = 20;

using Real = long double;

// P_0 to P_count at x.
Eigen::Matrix<Real, Eigen::Dynamic, 1> legendre(int count, Real x) {
  Eigen::Matrix<Real, Eigen::Dynamic, 1> P(count + 1);
  P[0] = 1;
  P[1] = x;
  for (int l = 1; l < count; ++l) P[l + 1] = ((2 * l + 1) * x * P[l] - l * P[l - 1]) / (l + 1);
  return P;
}

}  // namespace

LegendreFit::LegendreFit(int nodes_count)
    : count(nodes_count),
      nodes(count),
      by_values(count, count),
      powers(Matrix::Zero(count, count)),
      integral(Matrix::Zero(count, count)) {
  for (int i = 0; i < count; ++i) {
    Real x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1;
    for (int k = 0; k < node_newton_steps; ++k) {
      const auto P = legendre(count, x);
      slope = count * (x * P[count] - P[count - 1]) / (x * x - 1);
      x -= P[count] / slope;
    }
    const auto P = legendre(count, x);
    nodes[i] = static_cast<double>((1 + x) / 2);
    const Real weight = 1 / ((1 - x * x) * slope * slope);
    for (int l = 0; l < count; ++l) by_values(l, i) = static_cast<double>((2 * l + 1) * weight * P[l]);
  }
  for (int l = 0; l < count; ++l) {
    powers(l, 0) = l % 2 == 0 ? 1 : -1;
    for (int j = 0; j < l; ++j)
      powers(l, j + 1) = -powers(l, j) * (l - j) * (l + j + 1) / ((j + 1.0) * (j + 1.0));
  }
  for (int i = 0; i < count; ++i) {
    const auto P = legendre(count, 2 * static_cast<Real>(nodes[i]) - 1);
    integral.row(i) = nodes[i] * by_values.row(0);
    for (int l = 1; l < count; ++l)
      integral.row(i) += static_cast<double>((P[l + 1] - P[l - 1]) / (2 * (2 * l + 1))) * by_values.row(l);
  }
}

}  // namespace arcslip::time
