#pragma once
// A direction of the degrees of freedom in the coordinates y, x = P y (coordinates.hpp).

#include <arcslip/model/model.hpp>

#include <Eigen/SparseCore>

#include <complex>
#include <utility>
#include <vector>

namespace arcslip::hbm {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

/// d in y, by its nonzero entries. Rounding errors in other entries are removed: a stiff part belongs in its
/// own row and column only, and would swamp softer ones.
class DirectionInY {
 public:
  using Entries = std::vector<std::pair<Eigen::Index, double>>;

  DirectionInY(const Eigen::MatrixXd& P, const model::Direction& in_x, const model::Direction& next = {});
  /// Of a force on all rows, with every entry.
  DirectionInY(const Eigen::MatrixXd& P, const Eigen::VectorXd& in_x);

  const Entries& entries() const { return entries_; }
  const Entries& next() const { return next_; }
  /// d . y
  Complex along(const ComplexVector& y, Complex turn) const {
    Complex sum = 0;
    for (const auto& [i, at_i] : entries_) sum += at_i * y[i];
    if (!next_.empty())
      for (const auto& [i, at_i] : next_) sum += turn * (at_i * y[i]);
    return sum;
  }
  /// v += amount conj(d)
  void add(Complex amount, Complex turn, ComplexVector& v) const {
    for (const auto& [i, at_i] : entries_) v[i] += amount * at_i;
    if (!next_.empty())
      for (const auto& [i, at_i] : next_) v[i] += amount * std::conj(turn) * at_i;
  }

 private:
  Entries entries_, next_;
};

}  // namespace arcslip::hbm
