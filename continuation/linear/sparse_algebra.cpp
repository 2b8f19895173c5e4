#include <arcslip/continuation/linear/sparse_algebra.hpp>

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

namespace arcslip::continuation {
namespace {

using Complex = std::complex<double>;

constexpr double suspicious = 1e-8;  // of the largest entry of its column: a pivot
constexpr int equilibrations = 20;

// The layout of KLU: pairs, real part first, like std::complex.
double* pairs(Complex* of) {
  return reinterpret_cast<double*>(of);
}

struct Scales {
  Eigen::VectorXd rows, columns;
};

// With which the largest entry of each row and of each column is about 1 (Ruiz 2001).
Scales equilibration(const ComplexSparseLU::Matrix& A) {
  Scales scales{Eigen::VectorXd::Ones(A.rows()), Eigen::VectorXd::Ones(A.cols())};
  const auto halve = [](Eigen::VectorXd& scale, const Eigen::VectorXd& largest) {
    for (Eigen::Index i = 0; i < scale.size(); ++i)
      if (largest[i] > 0) scale[i] /= std::sqrt(largest[i]);
  };
  for (int k = 0; k < equilibrations; ++k) {
    Eigen::VectorXd of_rows = Eigen::VectorXd::Zero(A.rows()), of_columns = Eigen::VectorXd::Zero(A.cols());
    for (Eigen::Index j = 0; j < A.outerSize(); ++j)
      for (ComplexSparseLU::Matrix::InnerIterator entry(A, j); entry; ++entry) {
        const double size = std::abs(entry.value()) * scales.rows[entry.row()] * scales.columns[j];
        of_rows[entry.row()] = std::max(of_rows[entry.row()], size);
        of_columns[j] = std::max(of_columns[j], size);
      }
    halve(scales.rows, of_rows);
    halve(scales.columns, of_columns);
  }
  return scales;
}

}  // namespace

struct ComplexSparseLU::Decomposition {
  Decomposition() {
    klu_defaults(&common);
    common.scale = 0;  // pivots are compared with the entries of A
    common.tol = 1;    // the largest entry is the pivot
    common.btf = 0;    // one block, so that U has all pivots
  }
  Decomposition(const Decomposition&) = delete;
  Decomposition& operator=(const Decomposition&) = delete;
  ~Decomposition() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }
  // Lack of memory is an exception, not a property of the matrix.
  void check_memory() const {
    if (common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common.status == KLU_TOO_LARGE)
      throw std::length_error("the KLU factors have more entries than an int can count");
  }

  mutable klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  Matrix A;  // KLU does not modify it, but takes no const
};

ComplexSparseLU::ComplexSparseLU(const Matrix& pattern) : lu_(std::make_unique<Decomposition>()) {
  Decomposition& d = *lu_;
  d.A = pattern;
  d.A.makeCompressed();
  d.symbolic = klu_analyze(static_cast<int>(d.A.rows()), d.A.outerIndexPtr(), d.A.innerIndexPtr(), &d.common);
  d.check_memory();
}

ComplexSparseLU::~ComplexSparseLU() = default;
ComplexSparseLU::ComplexSparseLU(ComplexSparseLU&&) noexcept = default;
ComplexSparseLU& ComplexSparseLU::operator=(ComplexSparseLU&&) noexcept = default;

double ComplexSparseLU::multiplications() const {
  return lu_->symbolic ? lu_->symbolic->est_flops / 2 : std::numeric_limits<double>::infinity();
}

bool ComplexSparseLU::factorize(const Matrix& A, double least) {
  Decomposition& d = *lu_;
  klu_free_numeric(&d.numeric, &d.common);
  if (!d.symbolic) return false;
  d.A = A;
  Matrix& M = d.A;
  d.numeric = klu_z_factor(M.outerIndexPtr(), M.innerIndexPtr(), pairs(M.valuePtr()), d.symbolic, &d.common);
  d.check_memory();
  if (!d.numeric || d.common.status != KLU_OK) return false;
  const auto* pivots = static_cast<const Complex*>(d.numeric->Udiag);
  bool is_suspicious = false;
  for (int k = 0; k < d.symbolic->n; ++k) {
    double largest = 0;
    for (Matrix::InnerIterator entry(M, d.symbolic->Q[k]); entry; ++entry)
      largest = std::max(largest, std::abs(entry.value()));
    if (!(std::abs(pivots[k]) > least * largest)) return false;
    is_suspicious = is_suspicious || std::abs(pivots[k]) < suspicious * largest;
  }
  return !is_suspicious || !grows(1 / least);
}

// The last pivot of a nearly singular matrix is its smallest singular value over the last entries of the
// singular vectors, which may be small.
bool ComplexSparseLU::grows(double most) const {
  const Scales scales = equilibration(lu_->A);
  Eigen::MatrixXcd x(scales.rows.size(), 1);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const auto k = static_cast<double>(i);
    x(i, 0) = std::polar(1 / scales.rows[i], k * k);  // of no symmetry
  }
  solve_in_place(x);
  return !((x.col(0).cwiseAbs().array() / scales.columns.array()) < most).all();
}

void ComplexSparseLU::solve_in_place(Eigen::MatrixXcd& B) const {
  klu_z_solve(lu_->symbolic, lu_->numeric, static_cast<int>(B.rows()), static_cast<int>(B.cols()),
              pairs(B.data()), &lu_->common);
}

void ComplexSparseLU::solve_transposed_in_place(Eigen::MatrixXcd& B) const {
  constexpr int conjugated = 0;
  klu_z_tsolve(lu_->symbolic, lu_->numeric, static_cast<int>(B.rows()), static_cast<int>(B.cols()),
               pairs(B.data()), conjugated, &lu_->common);
}

}  // namespace arcslip::continuation
