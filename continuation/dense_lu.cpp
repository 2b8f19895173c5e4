#include <arcslip/continuation/linear_solver.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {
namespace {

class DenseLU final : public LinearSolver {
 public:
  const char* name() const override { return "dense LU"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) override {
    const auto* J = std::get_if<Matrix>(&jacobian);
    if (!J) return false;
    const Eigen::Index n = J->rows(), m = borders.width();
    if (matrix_.rows() != n + m) {
      matrix_.resize(n + m, n + m);
      lu_ = Eigen::PartialPivLU<Matrix>(n + m);
      work_.resize(n + m);
    }
    // Rows of equal magnitude: partial pivoting compares entries of J with entries of the border, and a J of
    // a single entry may vanish beside its columns.
    const double largest = m > 0 && n > 0 ? borders.rows.cwiseAbs().maxCoeff() : 0;
    double magnitude = n > 0 ? J->cwiseAbs().maxCoeff() : 0;
    if (n == 1 && m > 0) magnitude = std::max(magnitude, borders.columns.cwiseAbs().maxCoeff());
    row_scale_ = largest > 0 && magnitude > 0 ? magnitude / largest : 1.0;
    if (!std::isfinite(row_scale_)) return false;
    matrix_.topLeftCorner(n, n) = *J;
    matrix_.topRightCorner(n, m) = borders.columns;
    matrix_.bottomLeftCorner(m, n) = row_scale_ * borders.rows.transpose();
    matrix_.bottomRightCorner(m, m) = row_scale_ * borders.corner;
    lu_.compute(matrix_);
    borders_ = m;

    double sign = lu_.permutationP().determinant() > 0 ? 1 : -1;
    const auto pivots = lu_.matrixLU().diagonal();
    for (Eigen::Index i = 0; i < n + m; ++i) {
      if (pivots[i] == 0 || !std::isfinite(pivots[i])) return false;
      if (pivots[i] < 0) sign = -sign;
    }
    sign_ = sign > 0 ? 1 : -1;
    return true;
  }

  void solve(Out x) const override {
    work_.noalias() = lu_.permutationP() * x;
    // The last equations were multiplied by row_scale_; their places after the permutation hold g.
    const auto& to = lu_.permutationP().indices();
    for (Eigen::Index i = x.size() - borders_; i < x.size(); ++i) work_[to[i]] *= row_scale_;
    lu_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(work_);
    lu_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(work_);
    x = work_;
  }

  bool solve_transposed(Out x) const override {
    work_ = x;
    lu_.matrixLU().triangularView<Eigen::Upper>().transpose().solveInPlace(work_);
    lu_.matrixLU().triangularView<Eigen::UnitLower>().transpose().solveInPlace(work_);
    x.noalias() = lu_.permutationP().transpose() * work_;
    x.tail(borders_) *= row_scale_;
    return true;
  }

  std::optional<int> determinant_sign() const override { return sign_; }

 private:
  Matrix matrix_;
  Eigen::PartialPivLU<Matrix> lu_{0};
  mutable Vector work_;
  double row_scale_ = 1;
  Eigen::Index borders_ = 0;
  int sign_ = 1;
};

}  // namespace

std::unique_ptr<LinearSolver> dense_lu() {
  return std::make_unique<DenseLU>();
}

}  // namespace arcslip::continuation
