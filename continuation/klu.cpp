#include <arcslip/continuation/bordered_sparse.hpp>
#include <arcslip/continuation/linear_solver.hpp>

#include <klu.h>

#include <cmath>
#include <limits>

namespace arcslip::continuation {
namespace {

class Klu final : public LinearSolver {
 public:
  Klu() { klu_defaults(&common_); }
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;
  ~Klu() override {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }

  const char* name() const override { return "KLU"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) override {
    const auto* J = std::get_if<SparseMatrix>(&jacobian);
    if (!J) return false;
    const bool new_pattern = matrix_.assemble(*J, borders);
    SparseMatrix& A = matrix_.matrix();
    const int n = static_cast<int>(A.rows());
    if (new_pattern || !symbolic_) {
      klu_free_numeric(&numeric_, &common_);
      klu_free_symbolic(&symbolic_, &common_);
      symbolic_ = klu_analyze(n, A.outerIndexPtr(), A.innerIndexPtr(), &common_);
      if (!symbolic_) return false;
    }
    klu_free_numeric(&numeric_, &common_);
    numeric_ = klu_factor(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), symbolic_, &common_);
    return numeric_ && common_.status == KLU_OK;
  }

  void solve(Out x) const override {
    if (!klu_solve(symbolic_, numeric_, static_cast<int>(x.size()), 1, x.data(), &common_))
      x.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

  bool solve_transposed(Out x) const override {
    if (!klu_tsolve(symbolic_, numeric_, static_cast<int>(x.size()), 1, x.data(), &common_))
      x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return true;
  }

 private:
  BorderedSparse matrix_;
  mutable klu_common common_;
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> klu() {
  return std::make_unique<Klu>();
}

}  // namespace arcslip::continuation
