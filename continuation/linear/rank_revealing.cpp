// Decompositions of dense matrices whose rank may be deficient: least squares, bases of subspaces, singular
// values.
#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace arcslip::continuation {
namespace {

template <class Decomposition>
LeastSquares solved_by(const Matrix& A, const Matrix& B, double threshold) {
  Decomposition of(A.rows(), A.cols());
  if (threshold > 0) of.setThreshold(threshold);
  of.compute(A);
  return {of.solve(B), of.rank()};
}

}  // namespace

Vector solve_any(const Matrix& A, const Vector& b) {
  return A.fullPivLu().solve(b);
}

LeastSquares least_squares(const Matrix& A, const Matrix& B, double threshold) {
  return solved_by<Eigen::ColPivHouseholderQR<Matrix>>(A, B, threshold);
}

LeastSquares shortest_least_squares(const Matrix& A, const Matrix& B, double threshold) {
  return solved_by<Eigen::CompleteOrthogonalDecomposition<Matrix>>(A, B, threshold);
}

Matrix orthonormal_columns(const Matrix& A) {
  return Eigen::HouseholderQR<Matrix>(A).householderQ() * Matrix::Identity(A.rows(), A.cols());
}

Matrix orthogonal_complement(const Matrix& A) {
  const Matrix Q = Eigen::HouseholderQR<Matrix>(A).householderQ();
  return Q.rightCols(A.rows() - A.cols());
}

Matrix orthogonal_complement(const Matrix& A, double threshold) {
  Eigen::ColPivHouseholderQR<Matrix> qr(A);
  qr.setThreshold(threshold);
  const Matrix Q = qr.householderQ();
  return Q.rightCols(A.rows() - qr.rank());
}

Matrix kernel(const Matrix& A) {
  const Eigen::FullPivLU<Matrix> lu(A);
  if (lu.dimensionOfKernel() == 0) return Matrix(A.cols(), 0);
  return lu.kernel();
}

struct NullSpaces::Decomposition {
  Eigen::ColPivHouseholderQR<Matrix> of;
  Eigen::RowVectorXd row;
};

NullSpaces::NullSpaces() : qr_(std::make_unique<Decomposition>()) {}
NullSpaces::~NullSpaces() = default;

// With A P = Q R, R upper triangular with k rows of zeros last: the last k columns of Q span `left`, and
// `right` solves R P^T right = 0.
void NullSpaces::compute(const Matrix& A, Eigen::Index k) {
  const Eigen::Index n = A.rows();
  auto& qr = qr_->of;
  qr.compute(A);
  columns_.setZero(n, k);
  columns_.bottomRows(k).setIdentity();
  left_ = columns_;
  qr.householderQ().applyThisOnTheLeft(left_, qr_->row);
  if (n > k) {
    auto above = columns_.topRows(n - k);
    above = -qr.matrixQR().topRightCorner(n - k, k);
    qr.matrixQR().topLeftCorner(n - k, n - k).triangularView<Eigen::Upper>().solveInPlace(above);
  }
  right_ = qr.colsPermutation() * columns_;
}

SingularValues singular_values(const Matrix& A) {
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace arcslip::continuation
