#pragma once
// Products and eigenvalues of large dense matrices by BLAS and LAPACK, which a reduction spends its time in.

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <Eigen/Core>

namespace arcslip::structure {

using Columns = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// A B
Eigen::MatrixXd product(const Columns& A, const Columns& B);
/// A^T B
Eigen::MatrixXd transposed_product(const Columns& A, const Columns& B);
/// C -= A B
void subtract_product(Eigen::MatrixXd& C, const Columns& A, const Columns& B);

/// As continuation::symmetric_modes(A) and symmetric_eigenvalues(A), whose lower triangle alone is read;
/// empty where A is not finite.
continuation::SymmetricModes large_symmetric_modes(const Eigen::MatrixXd& A);
/// A V = B V diag(values), V^T B V = 1, of a positive definite B; empty where it is none.
continuation::SymmetricModes large_symmetric_modes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Eigen::VectorXd large_symmetric_eigenvalues(const Eigen::MatrixXd& A);

}  // namespace arcslip::structure
