#include <arcslip/structure/products.hpp>

#include <arcslip/continuation/linear/lapack.hpp>

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
  const auto columns = [](const Columns& of) {
    return continuation::lapack::Columns{of.data(), static_cast<int>(of.rows()), static_cast<int>(of.cols()),
                                         static_cast<int>(of.outerStride())};
  };
  continuation::lapack::multiply(transposed, alpha, columns(A), columns(B), beta, C.data(),
                                 static_cast<int>(C.outerStride()));
}

// With B where there is one, which its factor replaces. False: not converged.
bool decompose(bool with_vectors, MatrixXd& A, MatrixXd* B, VectorXd& values) {
  values.resize(A.rows());
  if (A.rows() == 0) return true;
  if (!A.allFinite() || (B != nullptr && !B->allFinite())) return false;
  return continuation::lapack::symmetric_modes(with_vectors, static_cast<int>(A.rows()), A.data(),
                                               B == nullptr ? nullptr : B->data(), values.data());
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
  if (!decompose(true, modes.V, nullptr, modes.values)) return {};
  return modes;
}

continuation::SymmetricModes large_symmetric_modes(const MatrixXd& A, const MatrixXd& B) {
  continuation::SymmetricModes modes{{}, A};
  MatrixXd of_B = B;
  if (!decompose(true, modes.V, &of_B, modes.values)) return {};
  return modes;
}

VectorXd large_symmetric_eigenvalues(const MatrixXd& A) {
  MatrixXd of = A;
  VectorXd values;
  if (!decompose(false, of, nullptr, values)) return {};
  return values;
}

}  // namespace arcslip::structure
