#pragma once
// Decompositions of dense matrices, by Eigen: compiled once, in one file, and not wherever one is used.
//
// Where a decomposition does not converge, what it returns is empty. Matrices with no rows are allowed.

#include <arcslip/continuation/problem/problem.hpp>

#include <complex>

namespace arcslip::continuation {

/// LU with partial pivoting, P A = L U. Nothing allocates after the first matrix of a size.
template <class Scalar>
class LU {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  explicit LU(Eigen::Index n = 0);
  ~LU();
  LU(LU&&) noexcept;
  LU& operator=(LU&&) noexcept;

  /// A singular A leaves a pivot 0, and solutions that are not finite.
  void factorize(const Matrix& A);

  /// x = A^-1 b and x = A^-T b, x another vector than b.
  void solve(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const;
  void solve_transposed(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const;
  /// X = A^-1 B; X is another matrix than B.
  void solve_columns(const Matrix& B, Matrix& X) const;

  Scalar pivot(Eigen::Index i) const;  // of U
  double permutation_sign() const;     // det P
  Scalar determinant() const;

 private:
  struct Decomposition;
  std::unique_ptr<Decomposition> lu_;
};

extern template class LU<double>;
extern template class LU<std::complex<double>>;

/// A^-1 B by LU with partial pivoting.
Matrix solve(const Matrix& A, const Matrix& B);
Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);

/// A solution of A x = b by LU with full pivoting, where A may be singular.
Vector solve_any(const Matrix& A, const Vector& b);

/// A^-1 B of a symmetric and positive definite A, by A = L L^T.
class Cholesky {
 public:
  /// False: A is not positive definite.
  bool factorize(const Matrix& A);
  void solve_in_place(Matrix& B) const;
  Matrix solve(const Matrix& B) const;
  /// L^-1 S L^-T, whose eigenvalues are those of S v = mu A v.
  Matrix reduced(const Matrix& S) const;

 private:
  Matrix L_;
};

/// min |A x - b| for each column of B, where A has full rank; x is the shortest of many where it has not.
/// `threshold`: what counts as zero, of the largest pivot. 0: rounding.
struct LeastSquares {
  Matrix X;
  Eigen::Index rank = 0;
};
LeastSquares least_squares(const Matrix& A, const Matrix& B, double threshold = 0);
LeastSquares shortest_least_squares(const Matrix& A, const Matrix& B, double threshold = 0);

/// An orthonormal basis of the columns of A, which are independent: n x m.
Matrix orthonormal_columns(const Matrix& A);
/// Of what is orthogonal to them: n x (n - m).
Matrix orthogonal_complement(const Matrix& A);
/// The same where columns may depend on each other, to `threshold` of the largest: n x (n - rank).
Matrix orthogonal_complement(const Matrix& A, double threshold);
/// Columns that span A x = 0, by LU with full pivoting.
Matrix kernel(const Matrix& A);
/// A right = 0 and A^T left = 0 of an n x n matrix whose rank is n - k; both n x k. Nothing allocates after
/// the first matrix of a size.
class NullSpaces {
 public:
  NullSpaces();
  ~NullSpaces();
  void compute(const Matrix& A, Eigen::Index k);
  const Matrix& right() const { return right_; }
  const Matrix& left() const { return left_; }

 private:
  struct Decomposition;
  std::unique_ptr<Decomposition> qr_;
  Matrix right_, left_, columns_;
};

/// A = U diag(values) V^T with falling values; U is not computed.
struct SingularValues {
  Vector values;
  Matrix V;
};
SingularValues singular_values(const Matrix& A);

/// A = V diag(values) V^T of a symmetric A, with rising values.
struct SymmetricModes {
  Vector values;
  Matrix V;
};
SymmetricModes symmetric_modes(const Matrix& A);
Vector symmetric_eigenvalues(const Matrix& A);
/// mu of A v = mu B v, rising, with B positive definite.
Vector symmetric_eigenvalues(const Matrix& A, const Matrix& B);

/// A V = V diag(values) of any real A.
struct Modes {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd V;
};
Modes modes(const Matrix& A);
Eigen::VectorXcd eigenvalues(const Matrix& A);

/// The same for matrices of one size; nothing allocates after the first.
class Eigenvalues {
 public:
  Eigenvalues();
  ~Eigenvalues();
  /// False: not converged.
  bool compute(const Matrix& A);
  const Eigen::VectorXcd& values() const;

 private:
  struct Decomposition;
  std::unique_ptr<Decomposition> of_;
};

}  // namespace arcslip::continuation
