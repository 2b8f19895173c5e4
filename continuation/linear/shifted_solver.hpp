#pragma once
// Solver of (J - s) x = b with a complex shift s, also with a border that keeps it regular at an eigenvalue,
//
//   [ J - s  b ] (x, g) = (f, h).
//   [ c^H    0 ]
//
// Dense J: balanced, by LU. Sparse J: by KLU, with the last row times a factor that keeps it from being a
// pivot early: h is to be 0, or x matters up to its length only. Not installed.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/sparse_algebra.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <complex>
#include <optional>

namespace arcslip::continuation {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

class ShiftedSolver {
 public:
  /// J is copied. errors: of its entries beyond rounding, n x n, or empty. Throws std::invalid_argument for
  /// an operator.
  explicit ShiftedSolver(const Jacobian& J, Matrix errors = {});

  /// False: singular to the last bit.
  bool factorize(Complex shift);
  /// b, c: n.
  bool factorize(Complex shift, const ComplexVector& b, const ComplexVector& c);

  /// x: n, or n + 1 with a border; on entry the right-hand side. False: not finite.
  bool solve(ComplexVector& x) const;
  /// The same with the conjugate transposed matrix.
  bool solve_adjoint(ComplexVector& x) const;

  ComplexVector apply(const ComplexVector& x) const;    // J x
  Vector error_of_apply(const ComplexVector& x) const;  // of J x by that of J
  Eigen::Index size() const { return n_; }
  const Vector& scales() const { return D_; }  // of the unknowns, by which J is balanced

 private:
  bool factorize_dense(Complex shift, const ComplexVector* b, const ComplexVector* c);
  bool factorize_sparse(Complex shift, const ComplexVector* b, const ComplexVector* c);

  Eigen::Index n_ = 0;
  Matrix errors_;
  bool dense_ = true;
  Matrix balanced_;
  Vector D_;  // balanced = D^-1 J D
  LU<Complex> lu_;
  SparseMatrix sparse_;
  std::optional<ComplexSparseLU> klu_;
  Eigen::Index bordered_ = -1;  // rows of the border of klu_
};

/// An eigenvalue of J with its vectors: J right = value right, left^H J = value left^H, |right| = 1,
/// left^H right = 1.
struct Eigenpair {
  Complex value;
  ComplexVector right, left;
};

/// The eigenvalue of J near `value`, from an approximate right vector, by bordered systems. Nothing where it
/// is not apart from the others, or left and right vectors are orthogonal to 1e-10, as at a double
/// eigenvalue.
std::optional<Eigenpair> refined_eigenpair(ShiftedSolver& solver, Complex value, const ComplexVector& right);

}  // namespace arcslip::continuation
