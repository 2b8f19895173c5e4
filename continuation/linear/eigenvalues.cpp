// Eigenvalues and eigenvectors of dense matrices.
#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace arcslip::continuation {

SymmetricModes symmetric_modes(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> of(A);
  if (of.info() != Eigen::Success) return {};
  return {of.eigenvalues(), of.eigenvectors()};
}

Vector symmetric_eigenvalues(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> of(A, Eigen::EigenvaluesOnly);
  return of.info() == Eigen::Success ? of.eigenvalues() : Vector();
}

SymmetricModes symmetric_modes(const Matrix& A, const Matrix& B) {
  const Eigen::LLT<Matrix> factors(B);
  if (factors.info() != Eigen::Success) return {};
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> of(A, B);
  if (of.info() != Eigen::Success) return {};
  return {of.eigenvalues(), of.eigenvectors()};
}

Vector symmetric_eigenvalues(const Matrix& A, const Matrix& B) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> of(A, B, Eigen::EigenvaluesOnly);
  return of.info() == Eigen::Success ? of.eigenvalues() : Vector();
}

Modes modes(const Matrix& A) {
  const Eigen::EigenSolver<Matrix> of(A);
  if (of.info() != Eigen::Success) return {};
  return {of.eigenvalues(), of.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(const Matrix& A) {
  Eigenvalues of;
  return of.compute(A) ? of.values() : Eigen::VectorXcd();
}

struct Eigenvalues::Decomposition {
  Eigen::EigenSolver<Matrix> of;
};

Eigenvalues::Eigenvalues() : of_(std::make_unique<Decomposition>()) {}
Eigenvalues::~Eigenvalues() = default;

bool Eigenvalues::compute(const Matrix& A) {
  return of_->of.compute(A, false).info() == Eigen::Success;
}

const Eigen::VectorXcd& Eigenvalues::values() const {
  return of_->of.eigenvalues();
}

}  // namespace arcslip::continuation
