#pragma once
// Iterative refinement of M x = b: sweeps of an inexact solve of the residual, until this is at rounding or
// falls no more. The size of a residual is its backward error, the largest over the rows of
// |b - M x| / (|b| + |row| |x|), with |row| the sum of magnitudes in the row and |x| the largest entry.

#include <arcslip/continuation/problem.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::continuation {

class Refinement {
 public:
  void resize(Eigen::Index n) {
    for (Vector* v : {&b_, &x_, &trial_, &residual_, &product_}) v->resize(n);
  }

  /// x = M^-1 x. False: x is as it was. row_sums: |row| for each row.
  /// eliminate(b, x): x = M^-1 b as well as it can, bool; multiply(x, y): y = M x, bool.
  template <class Eliminate, class Multiply>
  bool solve(Out x, const Vector& row_sums, const Eliminate& eliminate, const Multiply& multiply) {
    b_ = residual_ = x;
    x_.setZero();
    double error = std::numeric_limits<double>::infinity();
    for (int k = 0; k < sweeps && error > rounding; ++k) {
      if (!eliminate(residual_, trial_)) return false;
      trial_ += x_;
      if (!multiply(trial_, product_)) return false;
      const double now = backward_error(row_sums);
      if (!(now < error)) break;
      std::swap(x_, trial_);
      residual_ = b_ - product_;
      const bool stagnates = k > 0 && now > progress * error;
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
  static constexpr double progress = 0.5;  // of the backward error in a sweep: more is stagnation

  double backward_error(const Vector& row_sums) const {
    const double x = trial_.lpNorm<Eigen::Infinity>();
    double error = 0;
    for (Eigen::Index i = 0; i < b_.size(); ++i) {
      const double r = std::abs(b_[i] - product_[i]);
      if (!std::isfinite(r)) return std::numeric_limits<double>::infinity();
      if (r > error * (std::abs(b_[i]) + row_sums[i] * x)) error = r / (std::abs(b_[i]) + row_sums[i] * x);
    }
    return error;
  }

  Vector b_, x_, trial_, residual_, product_;
};

}  // namespace arcslip::continuation
