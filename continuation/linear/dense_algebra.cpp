#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <arcslip/continuation/linear/lapack.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <utility>

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

// What Eigen's estimate of the norm of an inverse needs (Higham, ACM Trans. Math. Softw. 14, 1988).
template <class Decomposition, class Vector>
struct Inverse {
  using Scalar = typename Vector::Scalar;
  using RealScalar = double;
  using MatrixType = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  const Decomposition& lu;
  bool conjugate = false;
  Eigen::Index rows() const { return lu.factors.rows(); }
  Eigen::Index cols() const { return lu.factors.cols(); }
  Inverse adjoint() const { return {lu, !conjugate}; }
  Vector solve(const Vector& b) const {
    Vector x(b.size());
    if (conjugate) {
      lu.solve_transposed(b.conjugate(), x);
      x = x.conjugate().eval();
    } else {
      lu.solve(b, x);
    }
    return x;
  }
};

}  // namespace

// By Eigen, or from lapack::smallest_lu on by LAPACK.
template <class Scalar>
struct LU<Scalar>::Decomposition {
  explicit Decomposition(Eigen::Index n) : of(n < lapack::smallest_lu ? n : 0) {}

  void factorize(const Matrix& A) {
    large = A.rows() >= lapack::smallest_lu;
    if (!large) {
      of.compute(A);
      return;
    }
    const Eigen::Index n = A.rows();
    factors = A;
    exchanges.resize(n);
    // A kernel may pass over products with 0, and a NaN would be lost.
    if (!A.allFinite()) {
      factors.setConstant(std::numeric_limits<double>::quiet_NaN());
      norm = std::numeric_limits<double>::quiet_NaN();
      for (Eigen::Index i = 0; i < n; ++i) exchanges[i] = static_cast<int>(i) + 1;
    } else {
      norm = A.cwiseAbs().colwise().sum().maxCoeff();
      lapack::factorize(static_cast<int>(n), factors.data(), exchanges.data());
    }
    take_order();
  }

  void take_order() {
    const Eigen::Index n = exchanges.size();
    order.setLinSpaced(n, 0, static_cast<int>(n) - 1);
    sign = 1;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index other = exchanges[i] - 1;
      if (other == i) continue;
      std::swap(order[i], order[other]);
      sign = -sign;
    }
    places.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) places[order[i]] = static_cast<int>(i);
  }

  void solve(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const {
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = b[order[i]];
    factors.template triangularView<Eigen::UnitLower>().solveInPlace(x);
    factors.template triangularView<Eigen::Upper>().solveInPlace(x);
  }

  void solve_transposed(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const {
    x = b;
    factors.template triangularView<Eigen::Upper>().transpose().solveInPlace(x);
    factors.template triangularView<Eigen::UnitLower>().transpose().solveInPlace(x);
    for (Eigen::Index i = x.size(); i-- > 0;) std::swap(x[i], x[exchanges[i] - 1]);
  }

  void solve_columns(const Matrix& B, Matrix& X) const {
    X.resize(B.rows(), B.cols());
    for (Eigen::Index i = 0; i < B.rows(); ++i) X.row(i) = B.row(order[i]);
    const int n = static_cast<int>(B.rows()), columns = static_cast<int>(B.cols());
    lapack::solve_triangle("L", "U", n, columns, factors.data(), X.data());
    lapack::solve_triangle("U", "N", n, columns, factors.data(), X.data());
  }

  double reciprocal_condition() const {
    return Eigen::internal::rcond_estimate_helper(norm, Inverse<Decomposition, Vector>{*this});
  }

  Eigen::PartialPivLU<Matrix> of;
  bool large = false;
  Matrix factors;
  Eigen::VectorXi exchanges, order, places;  // row i of L U is row order[i] of A
  double sign = 1, norm = 0;
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
  lu_->factorize(A);
}

template <class Scalar>
void LU<Scalar>::solve(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const {
  if (lu_->large)
    lu_->solve(b, x);
  else
    x = lu_->of.solve(b);
}

template <class Scalar>
void LU<Scalar>::solve_transposed(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const {
  if (lu_->large)
    lu_->solve_transposed(b, x);
  else
    x = lu_->of.transpose().solve(b);
}

template <class Scalar>
void LU<Scalar>::solve_columns(const Matrix& B, Matrix& X) const {
  if (lu_->large)
    lu_->solve_columns(B, X);
  else
    X = lu_->of.solve(B);
}

template <class Scalar>
Scalar LU<Scalar>::pivot(Eigen::Index i) const {
  return factors()(i, i);
}

template <class Scalar>
double LU<Scalar>::permutation_sign() const {
  return lu_->large ? lu_->sign : static_cast<double>(lu_->of.permutationP().determinant());
}

template <class Scalar>
Scalar LU<Scalar>::determinant() const {
  return lu_->large ? lu_->sign * lu_->factors.diagonal().prod() : lu_->of.determinant();
}

template <class Scalar>
double LU<Scalar>::reciprocal_condition() const {
  return lu_->large ? lu_->reciprocal_condition() : lu_->of.rcond();
}

template <class Scalar>
auto LU<Scalar>::factors() const -> const Matrix& {
  return lu_->large ? lu_->factors : lu_->of.matrixLU();
}

template <class Scalar>
const Eigen::VectorXi& LU<Scalar>::row_places() const {
  return lu_->large ? lu_->places : lu_->of.permutationP().indices();
}

template class LU<double>;
template class LU<std::complex<double>>;

Matrix solve(const Matrix& A, const Matrix& B) {
  return A.partialPivLu().solve(B);
}

Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) {
  return A.partialPivLu().solve(B);
}

void transposed_product(const Matrix& A, const Matrix& B, Matrix& C) {
  C.resize(A.cols(), B.cols());
  const auto columns = [](const Matrix& of) {
    const auto rows = static_cast<int>(of.rows());
    return lapack::Columns{of.data(), rows, static_cast<int>(of.cols()), rows};
  };
  lapack::multiply(true, 1, columns(A), columns(B), 0, C.data(), static_cast<int>(C.rows()));
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
