#pragma once
// Iterative refinement of M x = b: inexact solves for the residual, until it is at rounding level or
// stagnates. Residuals are measured by the backward error, the maximum over the rows of |b - M x| / (|b| +
// |row| |x|), with |row| the sum of magnitudes in the row and |x| the largest entry.

#include <arcslip/continuation/problem/problem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::continuation {

class Refinement {
 public:
  void resize(Eigen::Index n) {
    for (Vector* v : {&b_, &x_, &next_, &residual_, &next_residual_}) v->resize(n);
  }

  /// For |row| of a full row: the rounding error of sums of n terms grows like sqrt(n).
  static double of_full_row(Eigen::Index n) {
    return std::max(1.0, 0.25 * std::sqrt(static_cast<double>(n)));
  }

  /// x = M^-1 x. False: failed, x is unchanged. row_sums: |row| for each row.
  /// eliminate(b, x): x = M^-1 b approximately, bool; multiply(x, y): y = M x, bool.
  template <class Eliminate, class Multiply>
  bool solve(Out x, const Vector& row_sums, const Eliminate& eliminate, const Multiply& multiply) {
    b_ = x;
    if (!eliminate(b_, x_) || !multiply(x_, residual_)) return false;
    double error = subtract(x_, row_sums, residual_);
    for (int k = 0; k < sweeps && error > rounding; ++k) {
      if (!eliminate(residual_, next_)) return false;
      next_ += x_;
      if (!multiply(next_, next_residual_)) return false;
      const double now = subtract(next_, row_sums, next_residual_);
      if (!(now < error)) break;
      std::swap(x_, next_);
      std::swap(residual_, next_residual_);
      const bool stagnates = now > progress * error;
      error = now;
      if (stagnates) break;
    }
    if (!(error <= useful)) return false;
    x = x_;
    return true;
  }

 private:
  static constexpr int sweeps = 12;
  static constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  static constexpr double useful = 1e-8;   // backward errors above are failures
  static constexpr double progress = 0.5;  // ratio of the backward errors of two sweeps: more is stagnation

  // Mx becomes the residual b - M x; returns its backward error.
  double subtract(const Vector& x, const Vector& row_sums, Vector& Mx) const {
    const double largest = x.lpNorm<Eigen::Infinity>();
    double error = 0;
    for (Eigen::Index i = 0; i < b_.size(); ++i) {
      const double r = Mx[i] = b_[i] - Mx[i];
      const double size = std::abs(b_[i]) + row_sums[i] * largest;
      if (!std::isfinite(r)) return std::numeric_limits<double>::infinity();
      if (std::abs(r) > error * size) error = std::abs(r) / size;
    }
    return error;
  }

  Vector b_, x_, next_, residual_, next_residual_;
};

}  // namespace arcslip::continuation
