#pragma once
// Decompositions of dense matrices by Eigen, compiled once.
//
// A decomposition that does not converge returns empty results. Matrices without rows are allowed.

#include <arcslip/continuation/problem/problem.hpp>

#include <complex>

namespace arcslip::continuation {

/// LU with partial pivoting, P A = L U. No allocation after the first matrix of a size.
template <class Scalar>
class LU {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  explicit LU(Eigen::Index n = 0);
  ~LU();
  LU(LU&&) noexcept;
  LU& operator=(LU&&) noexcept;

  /// A singular A gives a zero pivot and non-finite solutions.
  void factorize(const Matrix& A);

  /// x = A^-1 b and x = A^-T b; x must not alias b.
  void solve(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const;
  void solve_transposed(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const;
  /// X = A^-1 B; X must not alias B.
  void solve_columns(const Matrix& B, Matrix& X) const;

  Scalar pivot(Eigen::Index i) const;  // of U
  double permutation_sign() const;     // det P
  Scalar determinant() const;
  double reciprocal_condition() const;        // in the norm of columns, estimated
  const Matrix& factors() const;              // L, whose diagonal is 1, below U
  const Eigen::VectorXi& row_places() const;  // row i of A is row row_places()[i] of P A

 private:
  struct Decomposition;
  std::unique_ptr<Decomposition> lu_;
};

/// LU with partial pivoting in place: A, n x n by columns, becomes L, whose diagonal of ones is not stored,
/// and U; row i of L U is row order[i] of A. order, work: n. A singular A gives a zero pivot, and one that is
/// not finite a pivot that is not. Does not allocate. Below 100 rows four columns are eliminated at once, so
/// that what is left is read and written a fourth as often; from there on by LAPACK.
void factorize_in_place(Eigen::Index n, double* A, int* order, int* work);

extern template class LU<double>;
extern template class LU<std::complex<double>>;

/// A^-1 B by LU with partial pivoting.
Matrix solve(const Matrix& A, const Matrix& B);
Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);

/// C = A^T B by BLAS. No allocation after the first matrices of a size.
void transposed_product(const Matrix& A, const Matrix& B, Matrix& C);

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

/// Minimizes |A x - b| for each column b of B; x is the minimum-norm solution if A is rank deficient.
/// threshold: pivots below this share of the largest count as zero; 0: rounding.
struct LeastSquares {
  Matrix X;
  Eigen::Index rank = 0;
};
LeastSquares least_squares(const Matrix& A, const Matrix& B, double threshold = 0);
LeastSquares shortest_least_squares(const Matrix& A, const Matrix& B, double threshold = 0);

/// An orthonormal basis of the column space of A, n x m, whose columns are independent.
Matrix orthonormal_columns(const Matrix& A);
/// An orthonormal basis of the orthogonal complement, n x (n - m).
Matrix orthogonal_complement(const Matrix& A);
/// The same for columns that may be dependent, to `threshold` relative to the largest pivot: n x (n - rank).
Matrix orthogonal_complement(const Matrix& A, double threshold);
/// A basis of the null space of A, by LU with full pivoting.
Matrix kernel(const Matrix& A);
/// Null spaces A right = 0 and A^T left = 0 of an n x n matrix of rank n - k; both n x k. No allocation after
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

/// A = U diag(values) V^T with values in decreasing order; U is not computed.
struct SingularValues {
  Vector values;
  Matrix V;
};
SingularValues singular_values(const Matrix& A);

/// A = V diag(values) V^T of a symmetric A, with values in increasing order.
struct SymmetricModes {
  Vector values;
  Matrix V;
};
SymmetricModes symmetric_modes(const Matrix& A);
Vector symmetric_eigenvalues(const Matrix& A);
/// A V = B V diag(values), V^T B V = 1, of a symmetric A and a positive definite B.
SymmetricModes symmetric_modes(const Matrix& A, const Matrix& B);
/// Eigenvalues mu of A v = mu B v in increasing order, B positive definite.
Vector symmetric_eigenvalues(const Matrix& A, const Matrix& B);

/// Balances A: D^-1 A D, with rows and columns of similar norms and D = diag(scales) of powers of 2, has the
/// eigenvalues of A, with rounding errors relative to its own norm (Parlett and Reinsch, Numer. Math. 13,
/// 1969; norms as of LAPACK's dgebal, James, Langou and Lowery 2014).
void balance(Matrix& A, Vector& scales);

/// A V = V diag(values) of a general real A, by QR of the balanced A.
struct Modes {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd V;
};
Modes modes(const Matrix& A);
Eigen::VectorXcd eigenvalues(const Matrix& A);
/// The finite eigenvalues mu of A v = mu B v, B general and possibly singular, by QZ. Those beyond 1e7 |A| /
/// |B| count as infinite.
Eigen::VectorXcd finite_eigenvalues(const Matrix& A, const Matrix& B);

/// Y of the Lyapunov equation T Y + Y T^T + C C^T = 0, by the complex Schur form of T (R. H. Bartels, G. W.
/// Stewart, Comm. ACM 15, 1972). Sums of two eigenvalues that are 0 to rounding count as that rounding.
/// Throws std::runtime_error where the form does not converge.
Matrix lyapunov_solution(const Matrix& T, const Matrix& C);

/// Eigenvalues of matrices of one size, balanced; no allocation after the first.
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
