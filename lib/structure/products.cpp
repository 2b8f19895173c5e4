#include <arcslip/structure/products.hpp>

#include <algorithm>

extern "C" {
// NOLINTBEGIN(readability-identifier-naming)
void dgemm_(const char* transposed_A, const char* transposed_B, const int* m, const int* n, const int* k,
            const double* alpha, const double* A, const int* lda, const double* B, const int* ldb,
            const double* beta, double* C, const int* ldc);
void dsyevd_(const char* job, const char* part, const int* n, double* A, const int* lda, double* values,
             double* work, const int* work_size, int* integers, const int* integers_size, int* info);
void dsygvd_(const int* type, const char* job, const char* part, const int* n, double* A, const int* lda,
             double* B, const int* ldb, double* values, double* work, const int* work_size, int* integers,
             const int* integers_size, int* info);
// NOLINTEND(readability-identifier-naming)
}

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

// C = alpha op(A) B + beta C
void multiply_by_blas(bool transposed, double alpha, const Columns& A, const Columns& B, double beta,
                      MatrixXd& C) {
  if (C.size() == 0) return;
  if (B.rows() == 0) {
    C *= beta;
    return;
  }
  const auto stride = [](Index of) { return static_cast<int>(std::max<Index>(of, 1)); };
  const int m = static_cast<int>(C.rows()), n = static_cast<int>(C.cols()), k = static_cast<int>(B.rows()),
            lda = stride(A.outerStride()), ldb = stride(B.outerStride()), ldc = stride(C.outerStride());
  dgemm_(transposed ? "T" : "N", "N", &m, &n, &k, &alpha, A.data(), &lda, B.data(), &ldb, &beta, C.data(),
         &ldc);
}

// By divide and conquer, with B where there is one, which its factor replaces. False: not converged.
bool decompose(const char* job, MatrixXd& A, MatrixXd* B, VectorXd& values) {
  const int n = static_cast<int>(A.rows()), type = 1;
  values.resize(n);
  if (n == 0) return true;
  if (!A.allFinite() || (B != nullptr && !B->allFinite())) return false;
  int info = 0, integers_size = -1, work_size = -1;
  VectorXd work(1);
  Eigen::VectorXi integers(1);
  const auto call = [&] {
    if (B == nullptr)
      dsyevd_(job, "L", &n, A.data(), &n, values.data(), work.data(), &work_size, integers.data(),
              &integers_size, &info);
    else
      dsygvd_(&type, job, "L", &n, A.data(), &n, B->data(), &n, values.data(), work.data(), &work_size,
              integers.data(), &integers_size, &info);
  };
  call();
  work_size = static_cast<int>(work[0]);
  integers_size = integers[0];
  work.resize(work_size);
  integers.resize(integers_size);
  call();
  return info == 0;
}

}  // namespace

MatrixXd product(const Columns& A, const Columns& B) {
  MatrixXd C = MatrixXd::Zero(A.rows(), B.cols());
  multiply_by_blas(false, 1, A, B, 0, C);
  return C;
}

MatrixXd transposed_product(const Columns& A, const Columns& B) {
  MatrixXd C = MatrixXd::Zero(A.cols(), B.cols());
  multiply_by_blas(true, 1, A, B, 0, C);
  return C;
}

void subtract_product(MatrixXd& C, const Columns& A, const Columns& B) {
  multiply_by_blas(false, -1, A, B, 1, C);
}

continuation::SymmetricModes large_symmetric_modes(const MatrixXd& A) {
  continuation::SymmetricModes modes{{}, A};
  if (!decompose("V", modes.V, nullptr, modes.values)) return {};
  return modes;
}

continuation::SymmetricModes large_symmetric_modes(const MatrixXd& A, const MatrixXd& B) {
  continuation::SymmetricModes modes{{}, A};
  MatrixXd of_B = B;
  if (!decompose("V", modes.V, &of_B, modes.values)) return {};
  return modes;
}

VectorXd large_symmetric_eigenvalues(const MatrixXd& A) {
  MatrixXd of = A;
  VectorXd values;
  if (!decompose("N", of, nullptr, values)) return {};
  return values;
}

}  // namespace arcslip::structure
