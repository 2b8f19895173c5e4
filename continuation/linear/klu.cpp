// KLU (Davis, Palamadai Natarajan, ACM TOMS 37, 2010): P A Q = L U + F, the blocks of L U on the diagonal and
// F above them, so that det A has the sign of det P det Q prod U_kk.
//
// Other values in the same pattern are refactorized with the same pivots, without search and allocation,
// unless the factors grow: the reciprocal pivot growth is min_j max_i |A_ij| / max_i |U_ij|. Refinement
// restores the digits lost by growth, and by pivots chosen for sparsity.

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/linear/refinement.hpp>

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace arcslip::continuation {
namespace {

// The bordered matrix [J C; R D] (linear_solver.hpp) as one sparse matrix, for the sparse solvers, scaled by
// powers of two: the largest entry of each row of J is near 1, of each row of R near n^-5, and of each column
// of [C; D], D by n^5, near 1.
//
// C does not enter the row scales: where F_p is large in some rows, as e^u at the top of a peak, J would be
// smaller than the borders there, and these would be chosen as pivots.
//
// Why so small: the rows of [R D] are full. If one of them is chosen as pivot early, it fills all following
// rows (a tridiagonal J of 3000, indefinite: 3.7 million entries instead of 9000), and during elimination
// they grow like R J^-1, by n^2 for a Laplacian. Small rows are chosen last. Refinement restores the accuracy
// lost by small pivots of J: see block_elimination.cpp, which is the same elimination.
class BorderedSparse {
 public:
  /// True: the pattern is new. Otherwise only values were written, without allocation.
  /// Throws std::length_error if there are more entries than an int can count.
  bool assemble(const SparseMatrix& J, const Borders& borders);

  SparseMatrix& matrix() { return matrix_; }  // compressed, (n + m) x (n + m)
  const SparseMatrix& matrix() const { return matrix_; }

  /// The row scales, > 0; unusable if finite() is false.
  const Vector& scales() const { return scales_; }
  /// The scales of its last m columns, m: the unknowns are those of the scaled matrix divided by them.
  const Vector& column_scales() const { return column_scales_; }
  /// Sums of the magnitudes in its rows, and in its columns before its rows were scaled; more for the
  /// borders, so that residuals relative to them are rounding.
  const Vector& row_sums() const { return row_sums_; }
  const Vector& column_sums() const { return column_sums_; }
  bool finite() const { return column_sums_.allFinite(); }

 private:
  void scale(int n);

  SparseMatrix matrix_;
  Vector scales_, column_scales_, row_sums_, column_sums_;
};

constexpr double border_power = -5;  // of n: the size of [R D] next to [J C]

double power_of_two(double largest) {
  return largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0;
}

int number_of_entries(const SparseMatrix& J, std::int64_t m) {
  const std::int64_t entries = J.nonZeros() + 2 * m * J.rows() + m * m;
  if (entries > std::numeric_limits<int>::max())
    throw std::length_error("the bordered matrix has " + std::to_string(entries) +
                            " entries, more than the " + std::to_string(std::numeric_limits<int>::max()) +
                            " that a sparse matrix of int indices holds");
  return static_cast<int>(entries);
}

// The pattern is compared while the values are copied, at negligible cost.
bool BorderedSparse::assemble(const SparseMatrix& J, const Borders& borders) {
  const int n = static_cast<int>(J.rows()), m = borders.width(), entries = number_of_entries(J, m);
  bool new_pattern = matrix_.rows() != n + m || matrix_.nonZeros() != entries;
  if (new_pattern) {
    matrix_ = SparseMatrix(n + m, n + m);
    matrix_.resizeNonZeros(entries);
  }
  int* outer = matrix_.outerIndexPtr();
  int* inner = matrix_.innerIndexPtr();
  double* value = matrix_.valuePtr();
  int k = 0;
  for (int j = 0; j < n; ++j) {
    new_pattern = new_pattern || outer[j] != k;
    outer[j] = k;
    const int begin = J.outerIndexPtr()[j];
    const int count = J.isCompressed() ? J.outerIndexPtr()[j + 1] - begin : J.innerNonZeroPtr()[j];
    const int* rows = J.innerIndexPtr() + begin;
    new_pattern = new_pattern || !std::equal(rows, rows + count, inner + k);
    std::copy_n(rows, count, inner + k);
    std::copy_n(J.valuePtr() + begin, count, value + k);
    k += count;
    for (int i = 0; i < m; ++i, ++k) {
      inner[k] = n + i;
      value[k] = borders.rows(j, i);
    }
  }
  for (int j = 0; j < m; ++j) {
    outer[n + j] = k;
    for (int i = 0; i < n + m; ++i, ++k) {
      inner[k] = i;
      value[k] = i < n ? borders.columns(i, j) : borders.corner(i - n, j);
    }
  }
  outer[n + m] = k;
  scale(n);
  return new_pattern;
}

void BorderedSparse::scale(int n) {
  const int* outer = matrix_.outerIndexPtr();
  const int* inner = matrix_.innerIndexPtr();
  double* value = matrix_.valuePtr();
  const Eigen::Index size = matrix_.rows();
  const int of_borders = static_cast<int>(border_power * std::log2(n + 1.0));
  scales_.setZero(size);
  row_sums_.setZero(size);
  column_sums_.setZero(size);
  for (int k = 0; k < outer[n]; ++k) scales_[inner[k]] = std::max(scales_[inner[k]], std::abs(value[k]));
  for (double& scale : scales_) scale = power_of_two(scale);
  column_scales_.setZero(size - n);
  for (Eigen::Index j = n; j < size; ++j) {
    double& scale = column_scales_[j - n];
    for (int k = outer[j]; k < outer[j + 1]; ++k)
      scale = std::max(scale, std::abs(value[k]) * scales_[inner[k]]);
    scale = power_of_two(scale);
    for (int k = outer[j]; k < outer[j + 1]; ++k) value[k] *= scale;
  }
  scales_.tail(size - n) *= std::ldexp(1.0, of_borders);
  for (Eigen::Index j = 0; j < size; ++j)
    for (int k = outer[j]; k < outer[j + 1]; ++k) {
      column_sums_[j] += std::abs(value[k]);
      value[k] *= scales_[inner[k]];
      row_sums_[inner[k]] += std::abs(value[k]);
    }
  row_sums_.tail(size - n) *= Refinement::of_full_row(n);
  column_sums_.tail(size - n) *= Refinement::of_full_row(n);
}

constexpr double kept_growth = 1e-2;  // of the reciprocal pivot growth when the pivots were chosen

class Klu final : public LinearSolver {
 public:
  Klu() {
    klu_defaults(&common_);
    common_.scale = 0;  // matrix_ has scaled rows
  }
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;
  ~Klu() override { forget(); }

  const char* name() const override { return "KLU"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) override {
    const auto* J = std::get_if<SparseMatrix>(&jacobian);
    if (!J) refuse_kind(name(), "sparse");
    if (matrix_.assemble(*J, borders)) forget();
    if (!matrix_.finite()) return false;
    SparseMatrix& A = matrix_.matrix();
    if (!symbolic_) {
      symbolic_ = klu_analyze(static_cast<int>(A.rows()), A.outerIndexPtr(), A.innerIndexPtr(), &common_);
      if (!usable(symbolic_)) return false;
      refinement_.resize(A.rows());
    }
    keeps_pivots_ = numeric_ && with_kept_pivots(A);
    return keeps_pivots_ || with_new_pivots(A);
  }

  bool keeps_pivots() const override { return keeps_pivots_; }
  void forget_pivots() override { klu_free_numeric(&numeric_, &common_); }

  void solve(Out x) const override {
    const SparseMatrix& A = matrix_.matrix();
    x.array() *= matrix_.scales().array();
    const auto eliminate = [this](const Vector& b, Vector& z) {
      z = b;
      return klu_solve(symbolic_, numeric_, static_cast<int>(z.size()), 1, z.data(), &common_) != 0;
    };
    const auto multiply = [&A](const Vector& z, Vector& y) {
      y.noalias() = A * z;
      return true;
    };
    if (!numeric_ || !refinement_.solve(x, matrix_.row_sums(), eliminate, multiply))
      x.setConstant(std::numeric_limits<double>::quiet_NaN());
    x.tail(matrix_.column_scales().size()).array() *= matrix_.column_scales().array();
  }

  bool solve_transposed(Out x) const override {
    const SparseMatrix& A = matrix_.matrix();
    const Vector& scales = matrix_.scales();
    x.tail(matrix_.column_scales().size()).array() *= matrix_.column_scales().array();
    const auto eliminate = [&](const Vector& b, Vector& z) {
      z = b;
      if (!klu_tsolve(symbolic_, numeric_, static_cast<int>(z.size()), 1, z.data(), &common_)) return false;
      z.array() *= scales.array();
      return true;
    };
    const auto multiply = [&](const Vector& z, Vector& y) {
      y.noalias() = A.transpose() * z.cwiseQuotient(scales);
      return true;
    };
    if (!numeric_ || !refinement_.solve(x, matrix_.column_sums(), eliminate, multiply))
      x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return true;
  }

  std::optional<int> determinant_sign() const override { return sign_; }

 private:
  void forget() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }

  // False: singular. Lack of memory is an exception, not a property of the matrix.
  bool usable(const void* result) const {
    if (common_.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status == KLU_TOO_LARGE)
      throw std::length_error("the KLU factors have more entries than an int can count");
    return result && common_.status == KLU_OK;
  }

  bool with_kept_pivots(SparseMatrix& A) {
    return klu_refactor(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), symbolic_, numeric_, &common_) &&
           common_.status == KLU_OK && growth(A) >= kept_growth * chosen_growth_ && take_signs();
  }

  bool with_new_pivots(SparseMatrix& A) {
    klu_free_numeric(&numeric_, &common_);
    numeric_ = klu_factor(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), symbolic_, &common_);
    if (!usable(numeric_)) {
      klu_free_numeric(&numeric_, &common_);
      return false;
    }
    chosen_growth_ = growth(A);
    parity_ = parity(numeric_->Pnum) * parity(symbolic_->Q);
    return take_signs();
  }

  double growth(SparseMatrix& A) {
    klu_rgrowth(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), symbolic_, numeric_, &common_);
    return common_.rgrowth;
  }

  // False where a pivot is zero or not finite.
  bool take_signs() {
    const auto* pivots = static_cast<const double*>(numeric_->Udiag);
    bool odd = parity_ < 0;
    for (int k = 0; k < numeric_->n; ++k) {
      if (pivots[k] == 0 || !std::isfinite(pivots[k])) return false;
      odd ^= pivots[k] < 0;
    }
    sign_ = odd ? -1 : 1;
    return true;
  }

  // Sign of a permutation: each cycle of even length changes it.
  int parity(const int* permutation) {
    const auto n = static_cast<std::size_t>(symbolic_->n);
    seen_.assign(n, 0);
    bool odd = false;
    for (std::size_t i = 0; i < n; ++i) {
      for (auto k = i; !seen_[k]; k = static_cast<std::size_t>(permutation[k])) {
        seen_[k] = 1;
        odd ^= static_cast<std::size_t>(permutation[k]) != i;
      }
    }
    return odd ? -1 : 1;
  }

  BorderedSparse matrix_;
  mutable Refinement refinement_;
  mutable klu_common common_;
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  double chosen_growth_ = 0;
  std::vector<char> seen_;
  int parity_ = 1, sign_ = 1;
  bool keeps_pivots_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> klu() {
  return std::make_unique<Klu>();
}

}  // namespace arcslip::continuation
