#include <arcslip/continuation/bordered_lu.hpp>

#include <cmath>

namespace arcslip::continuation {

BorderedLU::BorderedLU(int n) : matrix_(n + 1, n + 1), lu_(n + 1), work_(n + 1) {}

bool BorderedLU::factorize(const Jacobian& J, In F_p, In row) {
  const Eigen::Index n = J.rows();
  // Rows of equal magnitude: partial pivoting compares entries of J with entries of the border.
  const double largest = row.head(n).cwiseAbs().maxCoeff();
  const double magnitude = J.cwiseAbs().maxCoeff();
  row_scale_ = largest > 0 && magnitude > 0 ? magnitude / largest : 1.0;
  if (!std::isfinite(row_scale_)) return false;
  matrix_.topLeftCorner(n, n) = J;
  matrix_.col(n).head(n) = F_p;
  matrix_.row(n) = row_scale_ * row.transpose();
  lu_.compute(matrix_);

  double sign = lu_.permutationP().determinant() > 0 ? 1 : -1;
  const auto pivots = lu_.matrixLU().diagonal();
  for (Eigen::Index i = 0; i <= n; ++i) {
    if (pivots[i] == 0 || !std::isfinite(pivots[i])) return false;
    if (pivots[i] < 0) sign = -sign;
  }
  sign_ = sign > 0 ? 1 : -1;
  return true;
}

void BorderedLU::solve(Out x) const {
  const Eigen::Index n = x.size() - 1;
  work_.noalias() = lu_.permutationP() * x;
  // The last equation was multiplied by row_scale_; its place after the permutation holds g.
  work_[lu_.permutationP().indices()[n]] *= row_scale_;
  lu_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(work_);
  lu_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(work_);
  x = work_;
}

void BorderedLU::solve_transposed(Out x) const {
  const Eigen::Index n = x.size() - 1;
  work_ = x;
  lu_.matrixLU().triangularView<Eigen::Upper>().transpose().solveInPlace(work_);
  lu_.matrixLU().triangularView<Eigen::UnitLower>().transpose().solveInPlace(work_);
  x.noalias() = lu_.permutationP().transpose() * work_;
  x[n] *= row_scale_;
}

}  // namespace arcslip::continuation
