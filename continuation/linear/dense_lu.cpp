#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/group_elimination.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::continuation {
namespace {

class DenseLU final : public LinearSolver {
 public:
  explicit DenseLU(const std::vector<int>& groups) : elimination_(groups) {}

  const char* name() const override { return "dense LU"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) override {
    const auto* J = std::get_if<Matrix>(&jacobian);
    if (!J) refuse_kind(name(), "dense");
    const Eigen::Index m = borders.width(), all = J->rows() + m;
    if (work_.size() != all) {
      matrix_.resize(all * all);
      order_.resize(all);
      left_.resize(all);
      work_.resize(all);
      right_.resize(all);
    }
    eliminates_ = elimination_.eliminate(*J, borders);
    size_ = (eliminates_ ? elimination_.kept() : J->rows()) + m;
    Eigen::Map<Matrix> M(matrix_.data(), size_, size_);
    if (eliminates_)
      elimination_.form(*J, borders, M);
    else
      put_together(*J, borders, M);
    balance(M, m);
    factorize_in_place(size_, matrix_.data(), order_.data(), left_.data());
    double sign = sign_of_permutation();
    if (eliminates_) sign *= elimination_.determinant_sign();
    const auto pivots = M.diagonal();
    for (Eigen::Index i = 0; i < size_; ++i) {
      if (pivots[i] == 0 || !std::isfinite(pivots[i])) return false;
      if (pivots[i] < 0) sign = -sign;
    }
    sign_ = sign > 0 ? 1 : -1;
    return true;
  }

  void solve(Out x) const override {
    if (!eliminates_) return solve_rest(x);
    auto f = right_.head(size_);
    elimination_.reduce(x, f);
    solve_rest(f);
    elimination_.expand(f, x);
  }

  bool solve_transposed(Out x) const override {
    if (!eliminates_) {
      solve_rest_transposed(x);
      return true;
    }
    auto f = right_.head(size_);
    elimination_.reduce_transposed(x, f);
    solve_rest_transposed(f);
    elimination_.expand_transposed(f, x);
    return true;
  }

  std::optional<int> determinant_sign() const override { return sign_; }

 private:
  static void put_together(const Matrix& J, const Borders& borders, Eigen::Ref<Matrix> M) {
    const Eigen::Index n = J.rows(), m = borders.width();
    M.topLeftCorner(n, n) = J;
    M.topRightCorner(n, m) = borders.columns;
    M.bottomLeftCorner(m, n) = borders.rows.transpose();
    M.bottomRightCorner(m, m) = borders.corner;
  }

  void solve_rest(Out x) const {
    const Eigen::Map<const Matrix> M(matrix_.data(), size_, size_);
    auto y = work_.head(size_);
    x.tail(rows_.size()).array() *= rows_.array();
    for (Eigen::Index i = 0; i < size_; ++i) y[i] = x[order_[i]];
    M.triangularView<Eigen::UnitLower>().solveInPlace(y);
    M.triangularView<Eigen::Upper>().solveInPlace(y);
    x = y;
    x.tail(columns_.size()).array() *= columns_.array();
  }

  void solve_rest_transposed(Out x) const {
    const Eigen::Map<const Matrix> M(matrix_.data(), size_, size_);
    auto y = work_.head(size_);
    y = x;
    y.tail(columns_.size()).array() *= columns_.array();
    M.triangularView<Eigen::Upper>().transpose().solveInPlace(y);
    M.triangularView<Eigen::UnitLower>().transpose().solveInPlace(y);
    for (Eigen::Index i = 0; i < size_; ++i) x[order_[i]] = y[i];
    x.tail(rows_.size()).array() *= rows_.array();
  }

  // Partial pivoting compares the entries of J with those of the border rows, and a row that is large only in
  // its corner, where the parameter has no influence, would swamp J if chosen as pivot: each border is scaled
  // to the size of J, its columns first. A J no larger than the border could be lost next to it.
  void balance(Eigen::Ref<Matrix> M, Eigen::Index m) {
    const Eigen::Index n = M.rows() - m;
    rows_.setOnes(m);
    columns_.setOnes(m);
    if (n == 0 || m == 0) return;
    auto right = M.topRightCorner(n, m), below = M.bottomLeftCorner(m, n), corner = M.bottomRightCorner(m, m);
    double magnitude = M.topLeftCorner(n, n).cwiseAbs().maxCoeff();
    if (n <= m) magnitude = std::max(magnitude, right.cwiseAbs().maxCoeff());
    if (!(magnitude > 0)) return;
    for (Eigen::Index j = 0; j < m; ++j) columns_[j] = factor(magnitude, right.col(j).cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < m; ++i) {
      const double largest =
          std::max(below.row(i).cwiseAbs().maxCoeff(),
                   (corner.row(i).transpose().array() * columns_.array()).abs().maxCoeff());
      rows_[i] = factor(magnitude, largest);
    }
    right = right * columns_.asDiagonal();
    below = rows_.asDiagonal() * below;
    corner = rows_.asDiagonal() * corner * columns_.asDiagonal();
  }

  // By transpositions back to the identity; Eigen's determinant() of a permutation allocates.
  double sign_of_permutation() {
    left_ = order_;
    double sign = 1;
    for (Eigen::Index i = 0; i < size_; ++i)
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

  GroupElimination elimination_;
  bool eliminates_ = false;
  Eigen::Index size_ = 0;  // of what is left, with borders
  Vector matrix_;          // its L and U
  Eigen::VectorXi order_;  // row i of L U is equation order_[i] of what is left
  Eigen::VectorXi left_;
  mutable Vector right_, work_;
  Vector rows_, columns_;  // factors of the last equations and of the last unknowns
  int sign_ = 1;
};

}  // namespace

std::unique_ptr<LinearSolver> dense_lu() {
  return dense_lu_by_groups({});
}

std::unique_ptr<LinearSolver> dense_lu_by_groups(const std::vector<int>& groups) {
  return std::make_unique<DenseLU>(groups);
}

}  // namespace arcslip::continuation
