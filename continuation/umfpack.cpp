// UMFPACK (Davis, ACM TOMS 30, 2004): a multifrontal LU with threshold pivoting, whose solves are refined by
// the residual of the matrix itself.

#include <arcslip/continuation/bordered_sparse.hpp>
#include <arcslip/continuation/linear_solver.hpp>
#include <arcslip/continuation/refused_kind.hpp>

#include <umfpack.h>

#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

namespace arcslip::continuation {
namespace {

class Umfpack final : public LinearSolver {
 public:
  Umfpack() {
    umfpack_di_defaults(control_);
    control_[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;  // matrix_ has scaled rows
  }
  Umfpack(const Umfpack&) = delete;
  Umfpack& operator=(const Umfpack&) = delete;
  ~Umfpack() override { forget(); }

  const char* name() const override { return "UMFPACK"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) override {
    const auto* J = std::get_if<SparseMatrix>(&jacobian);
    if (!J) refuse_kind(name(), "sparse");
    const bool new_pattern = matrix_.assemble(*J, borders);
    umfpack_di_free_numeric(&numeric_);
    if (new_pattern) forget();
    keeps_pivots_ = symbolic_ != nullptr;
    if (!matrix_.finite()) return false;
    const SparseMatrix& A = matrix_.matrix();
    const int n = static_cast<int>(A.rows());
    if (!symbolic_) {
      if (!usable(umfpack_di_symbolic(n, n, A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), &symbolic_,
                                      control_, nullptr)))
        return false;
      indices_.resize(static_cast<std::size_t>(n));
      work_.resize(5 * static_cast<std::size_t>(n));  // as wsolve asks for with refinement
      right_.resize(n);
    }
    if (!usable(umfpack_di_numeric(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), symbolic_, &numeric_,
                                   control_, nullptr)) ||
        !take_sign()) {
      umfpack_di_free_numeric(&numeric_);
      return false;
    }
    return true;
  }

  void solve(Out x) const override {
    x.array() *= matrix_.scales().array();
    solve(UMFPACK_A, x);
    x.tail(matrix_.column_scales().size()).array() *= matrix_.column_scales().array();
  }

  bool solve_transposed(Out x) const override {
    x.tail(matrix_.column_scales().size()).array() *= matrix_.column_scales().array();
    solve(UMFPACK_At, x);
    x.array() *= matrix_.scales().array();
    return true;
  }

  // The symbolic analysis looks at values.
  bool keeps_pivots() const override { return keeps_pivots_; }
  void forget_pivots() override { forget(); }

  std::optional<int> determinant_sign() const override { return sign_; }

 private:
  void forget() {
    umfpack_di_free_numeric(&numeric_);
    umfpack_di_free_symbolic(&symbolic_);
  }

  // False: singular. That the machine is too small is no property of the matrix.
  static bool usable(int status) {
    if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
    return status == UMFPACK_OK;
  }

  // False where the determinant is zero or not finite; mantissa and exponent neither overflow nor underflow.
  bool take_sign() {
    double mantissa = 0, exponent = 0;
    const int status = umfpack_di_get_determinant(&mantissa, &exponent, numeric_, nullptr);
    if (status < 0) usable(status);
    sign_ = mantissa > 0 ? 1 : -1;
    return mantissa != 0 && std::isfinite(mantissa);
  }

  void solve(int system, Out x) const {
    const SparseMatrix& A = matrix_.matrix();
    right_ = x;
    const int status = numeric_ ? umfpack_di_wsolve(system, A.outerIndexPtr(), A.innerIndexPtr(),
                                                    A.valuePtr(), x.data(), right_.data(), numeric_, control_,
                                                    nullptr, indices_.data(), work_.data())
                                : UMFPACK_ERROR_invalid_Numeric_object;
    if (status != UMFPACK_OK) x.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

  BorderedSparse matrix_;
  double control_[UMFPACK_CONTROL];
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  mutable std::vector<int> indices_;
  mutable std::vector<double> work_;
  mutable Vector right_;
  int sign_ = 1;
  bool keeps_pivots_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> umfpack() {
  return std::make_unique<Umfpack>();
}

bool has_umfpack() {
  return true;
}

}  // namespace arcslip::continuation
