#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

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

template <class Scalar>
double LU<Scalar>::reciprocal_condition() const {
  return lu_->of.rcond();
}

template <class Scalar>
auto LU<Scalar>::factors() const -> const Matrix& {
  return lu_->of.matrixLU();
}

template <class Scalar>
const Eigen::VectorXi& LU<Scalar>::row_places() const {
  return lu_->of.permutationP().indices();
}

template class LU<double>;
template class LU<std::complex<double>>;

Matrix solve(const Matrix& A, const Matrix& B) {
  return A.partialPivLu().solve(B);
}

Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) {
  return A.partialPivLu().solve(B);
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

}  // namespace arcslip::continuation
