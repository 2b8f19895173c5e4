// KLU (Davis, Palamadai Natarajan, ACM TOMS 37, 2010): P A Q = L U + F, the blocks of L U on the diagonal and
// F above them, so that det A has the sign of det P det Q prod U_kk.
//
// Other values in the same pattern are factorized with the pivots that are there, which takes no search and
// no memory, unless the factors grow: the reciprocal pivot growth is min_j max_i |A_ij| / max_i |U_ij|. What
// digits are lost by growth, and by pivots that are chosen for sparsity, refinement restores.

#include <arcslip/continuation/bordered_sparse.hpp>
#include <arcslip/continuation/linear_solver.hpp>
#include <arcslip/continuation/refinement.hpp>
#include <arcslip/continuation/refused_kind.hpp>

#include <klu.h>

#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

namespace arcslip::continuation {
namespace {

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

  // False: singular. That the machine is too small is no property of the matrix.
  bool usable(const void* result) const {
    if (common_.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status == KLU_TOO_LARGE)
      throw std::length_error("the factors by KLU have more entries than an int counts");
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

  // Of a permutation: each cycle of even length changes it.
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
