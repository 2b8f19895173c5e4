#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace arcslip::continuation {
namespace {

// A single column uses Eigen's matrix-vector product, like a vector.
template <class Triangular>
void solve_triangular(const Triangular& T, Matrix& B) {
  if (B.cols() == 1) {
    auto b = B.col(0);
    T.solveInPlace(b);
  } else {
    T.solveInPlace(B);
  }
}

template <class Decomposition>
LeastSquares solved_by(const Matrix& A, const Matrix& B, double threshold) {
  Decomposition of(A.rows(), A.cols());
  if (threshold > 0) of.setThreshold(threshold);
  of.compute(A);
  return {of.solve(B), of.rank()};
}

}  // namespace

template <class Scalar>
struct LU<Scalar>::Decomposition {
  explicit Decomposition(Eigen::Index n) : of(n) {}
  Eigen::PartialPivLU<Matrix> of;
};

template <class Scalar>
LU<Scalar>::LU(Eigen::Index n) : lu_(std::make_unique<Decomposition>(n)) {}
template <class Scalar>
LU<Scalar>::~LU() = default;
template <class Scalar>
LU<Scalar>::LU(LU&&) noexcept = default;
template <class Scalar>
LU<Scalar>& LU<Scalar>::operator=(LU&&) noexcept = default;

template <class Scalar>
void LU<Scalar>::factorize(const Matrix& A) {
  lu_->of.compute(A);
}

template <class Scalar>
void LU<Scalar>::solve(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const {
  x = lu_->of.solve(b);
}

template <class Scalar>
void LU<Scalar>::solve_transposed(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const {
  x = lu_->of.transpose().solve(b);
}

template <class Scalar>
void LU<Scalar>::solve_columns(const Matrix& B, Matrix& X) const {
  X = lu_->of.solve(B);
}

template <class Scalar>
Scalar LU<Scalar>::pivot(Eigen::Index i) const {
  return lu_->of.matrixLU()(i, i);
}

template <class Scalar>
double LU<Scalar>::permutation_sign() const {
  return static_cast<double>(lu_->of.permutationP().determinant());
}

template <class Scalar>
Scalar LU<Scalar>::determinant() const {
  return lu_->of.determinant();
}

template class LU<double>;
template class LU<std::complex<double>>;

Matrix solve(const Matrix& A, const Matrix& B) {
  return A.partialPivLu().solve(B);
}

Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) {
  return A.partialPivLu().solve(B);
}

Vector solve_any(const Matrix& A, const Vector& b) {
  return A.fullPivLu().solve(b);
}

bool Cholesky::factorize(const Matrix& A) {
  const Eigen::LLT<Matrix> llt(A);
  L_ = llt.matrixLLT();
  return llt.info() == Eigen::Success;
}

void Cholesky::solve_in_place(Matrix& B) const {
  solve_triangular(L_.triangularView<Eigen::Lower>(), B);
  solve_triangular(L_.transpose().triangularView<Eigen::Upper>(), B);
}

Matrix Cholesky::solve(const Matrix& B) const {
  Matrix X = B;
  solve_in_place(X);
  return X;
}

Matrix Cholesky::reduced(const Matrix& S) const {
  const Matrix half = L_.triangularView<Eigen::Lower>().solve(S);
  return L_.triangularView<Eigen::Lower>().solve(half.transpose());
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
