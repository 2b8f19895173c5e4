#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <arcslip/continuation/linear/lu_in_place.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {

std::unique_ptr<LinearSolver> suitable_solver(const Jacobian& J) {
  if (std::holds_alternative<Matrix>(J)) return dense_lu();
  if (std::holds_alternative<SparseMatrix>(J)) return klu();
  throw std::invalid_argument(
      "the Jacobian is an operator: set its linear solver (options.linear_solver), for example "
      "block_elimination() around a solver of J");
}

void refuse_kind(const std::string& solver, const std::string& kind) {
  throw std::invalid_argument(solver + " takes " + kind + " Jacobians, and that of this problem is not " +
                              kind + ": set no linear solver for the default");
}

namespace {

class DenseLU final : public LinearSolver {
 public:
  const char* name() const override { return "dense LU"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) override {
    const auto* J = std::get_if<Matrix>(&jacobian);
    if (!J) refuse_kind(name(), "dense");
    const Eigen::Index n = J->rows(), m = borders.width();
    if (matrix_.rows() != n + m) {
      matrix_.resize(n + m, n + m);
      order_.resize(n + m);
      left_.resize(n + m);
      work_.resize(n + m);
    }
    balance(*J, borders);
    matrix_.topLeftCorner(n, n) = *J;
    matrix_.topRightCorner(n, m) = borders.columns * columns_.asDiagonal();
    matrix_.bottomLeftCorner(m, n) = rows_.asDiagonal() * borders.rows.transpose();
    matrix_.bottomRightCorner(m, m) = rows_.asDiagonal() * borders.corner * columns_.asDiagonal();
    factorize_in_place(matrix_, order_, left_);
    double sign = sign_of_permutation();
    const auto pivots = matrix_.diagonal();
    for (Eigen::Index i = 0; i < n + m; ++i) {
      if (pivots[i] == 0 || !std::isfinite(pivots[i])) return false;
      if (pivots[i] < 0) sign = -sign;
    }
    sign_ = sign > 0 ? 1 : -1;
    return true;
  }

  void solve(Out x) const override {
    x.tail(rows_.size()).array() *= rows_.array();
    for (Eigen::Index i = 0; i < x.size(); ++i) work_[i] = x[order_[i]];
    matrix_.triangularView<Eigen::UnitLower>().solveInPlace(work_);
    matrix_.triangularView<Eigen::Upper>().solveInPlace(work_);
    x = work_;
    x.tail(columns_.size()).array() *= columns_.array();
  }

  bool solve_transposed(Out x) const override {
    work_ = x;
    work_.tail(columns_.size()).array() *= columns_.array();
    matrix_.triangularView<Eigen::Upper>().transpose().solveInPlace(work_);
    matrix_.triangularView<Eigen::UnitLower>().transpose().solveInPlace(work_);
    for (Eigen::Index i = 0; i < x.size(); ++i) x[order_[i]] = work_[i];
    x.tail(rows_.size()).array() *= rows_.array();
    return true;
  }

  std::optional<int> determinant_sign() const override { return sign_; }

 private:
  // Partial pivoting compares the entries of J with those of the border rows, and a row that is large only in
  // its corner, where the parameter has no influence, would swamp J if chosen as pivot: each border is scaled
  // to the size of J, its columns first. A J no larger than the border could be lost next to it.
  void balance(const Matrix& J, const Borders& borders) {
    const Eigen::Index n = J.rows(), m = borders.width();
    rows_.setOnes(m);
    columns_.setOnes(m);
    if (n == 0 || m == 0) return;
    double magnitude = J.cwiseAbs().maxCoeff();
    if (n <= m) magnitude = std::max(magnitude, borders.columns.cwiseAbs().maxCoeff());
    if (!(magnitude > 0)) return;
    for (Eigen::Index j = 0; j < m; ++j) {
      const double largest = borders.columns.col(j).cwiseAbs().maxCoeff();
      columns_[j] = factor(magnitude, largest);
    }
    for (Eigen::Index i = 0; i < m; ++i) {
      const double largest =
          std::max(borders.rows.col(i).cwiseAbs().maxCoeff(),
                   (borders.corner.row(i).transpose().array() * columns_.array()).abs().maxCoeff());
      rows_[i] = factor(magnitude, largest);
    }
  }

  // By transpositions back to the identity; Eigen's determinant() of a permutation allocates.
  double sign_of_permutation() {
    left_ = order_;
    double sign = 1;
    for (Eigen::Index i = 0; i < left_.size(); ++i)
      while (left_[i] != i) {
        std::swap(left_[i], left_[left_[i]]);
        sign = -sign;
      }
    return sign;
  }

  static double factor(double to, double from) {
    const double factor = to / from;
    return factor > 0 && std::isfinite(factor) ? factor : 1;
  }

  Matrix matrix_;          // L and U
  Eigen::VectorXi order_;  // row i of L U is equation order_[i]
  Eigen::VectorXi left_;
  mutable Vector work_;
  Vector rows_, columns_;  // factors of the last equations and of the last unknowns
  int sign_ = 1;
};

}  // namespace

std::unique_ptr<LinearSolver> dense_lu() {
  return std::make_unique<DenseLU>();
}

}  // namespace arcslip::continuation
