// Eigenvalues and eigenvectors of dense matrices.
#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace arcslip::continuation {
namespace {

constexpr double worthwhile = 0.95;  // of the norms of a row and its column, after a scaling
constexpr int most_sweeps = 50;
constexpr double smallest_finite = 1e-7;  // of 1 / mu, for matrices of norm 1
constexpr double farthest_scaling = 0x1p500;

// The power of 2 by which the column divides and the row multiplies, so that both have similar norms.
double balancing_factor(double column, double row) {
  const double sum = column + row;
  double factor = 1;
  for (; column < row / 2 && factor < farthest_scaling; factor *= 2) column *= 2, row /= 2;
  for (; column / 2 >= row && factor > 1 / farthest_scaling; factor /= 2) column /= 2, row *= 2;
  return column + row < worthwhile * sum ? factor : 1;
}

}  // namespace

void balance(Matrix& A, Vector& scales) {
  scales.setOnes(A.rows());
  if (!A.allFinite()) return;
  bool changed = true;
  for (int sweep = 0; changed && sweep < most_sweeps; ++sweep) {
    changed = false;
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const double column = A.col(i).norm(), row = A.row(i).norm();
      if (column == 0 || row == 0) continue;
      const double factor = balancing_factor(column, row), scale = scales[i] * factor;
      if (factor == 1 || !(scale < farthest_scaling && scale > 1 / farthest_scaling)) continue;
      changed = true;
      scales[i] = scale;
      A.col(i) *= factor;
      A.row(i) /= factor;
    }
  }
}

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
  Matrix balanced = A;
  Vector scales;
  balance(balanced, scales);
  const Eigen::EigenSolver<Matrix> of(balanced);
  if (of.info() != Eigen::Success) return {};
  Eigen::MatrixXcd V = of.eigenvectors();
  if ((scales.array() != 1).any()) {
    V.array().colwise() *= scales.cast<std::complex<double>>().array();
    V.colwise().normalize();
  }
  return {of.eigenvalues(), std::move(V)};
}

Eigen::VectorXcd eigenvalues(const Matrix& A) {
  Eigenvalues of;
  return of.compute(A) ? of.values() : Eigen::VectorXcd();
}

Eigen::VectorXcd finite_eigenvalues(const Matrix& A, const Matrix& B) {
  const double of_A = A.norm() > 0 ? A.norm() : 1, of_B = B.norm();
  if (of_B == 0 || A.rows() == 0) return {};
  const Eigen::GeneralizedEigenSolver<Matrix> of(A / of_A, B / of_B, false);
  if (of.info() != Eigen::Success || !of.alphas().allFinite() || !of.betas().allFinite())
    throw std::runtime_error("the eigenvalues of the pair of matrices could not be computed");
  std::vector<std::complex<double>> finite;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (std::abs(of.betas()[i]) > smallest_finite * std::abs(of.alphas()[i]))
      finite.push_back(of.alphas()[i] / of.betas()[i] * (of_A / of_B));
  return Eigen::Map<const Eigen::VectorXcd>(finite.data(), static_cast<Eigen::Index>(finite.size()));
}

Matrix lyapunov_solution(const Matrix& T, const Matrix& C) {
  const Eigen::ComplexSchur<Matrix> schur(T);
  if (schur.info() != Eigen::Success) throw std::runtime_error("the Schur form could not be computed");
  const Eigen::MatrixXcd &U = schur.matrixU(), &R = schur.matrixT();
  const Eigen::MatrixXcd D = U.adjoint() * C;
  const double rounding = 2.2e-16 * T.norm();
  Eigen::MatrixXcd Y = -D * D.adjoint();  // becomes that of R Y + Y R^H + D D^H = 0, from the last column on
  for (Eigen::Index j = T.rows() - 1; j >= 0; --j) {
    Eigen::MatrixXcd shifted = R;
    for (auto& each : shifted.diagonal()) {
      each += std::conj(R(j, j));
      if (std::abs(each) < rounding) each = rounding;
    }
    shifted.triangularView<Eigen::Upper>().solveInPlace(Y.col(j));
    Y.leftCols(j).noalias() -= Y.col(j) * R.col(j).head(j).adjoint();
  }
  return (U * Y * U.adjoint()).real();
}

struct Eigenvalues::Decomposition {
  Eigen::EigenSolver<Matrix> of;
  Matrix balanced;
  Vector scales;
};

Eigenvalues::Eigenvalues() : of_(std::make_unique<Decomposition>()) {}
Eigenvalues::~Eigenvalues() = default;

bool Eigenvalues::compute(const Matrix& A) {
  of_->balanced = A;
  balance(of_->balanced, of_->scales);
  return of_->of.compute(of_->balanced, false).info() == Eigen::Success;
}

const Eigen::VectorXcd& Eigenvalues::values() const {
  return of_->of.eigenvalues();
}

}  // namespace arcslip::continuation
