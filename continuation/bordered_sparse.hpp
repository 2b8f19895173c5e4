#pragma once
// The bordered matrix [J C; R D] (linear_solver.hpp) as one sparse matrix, for the sparse solvers, scaled by
// powers of two: the largest entry of each row of J is near 1, of each row of R near n^-5, and of each column
// of [C; D], D by n^5, near 1.
//
// C has no part in the scales of the rows: where F_p is large in some of them, as e^u is at the top of a
// peak, J would there be smaller than the borders, and these be chosen as pivots.
//
// Why so small: the rows of [R D] are full. Where pivots are chosen by size, one of them chosen early fills
// all rows that follow (a tridiagonal J of 3000, indefinite: 3.7 million entries instead of 9000), and as
// elimination goes on they grow like R J^-1, by n^2 for a Laplacian. Made small, they wait until J leaves
// nothing else. What accuracy is lost by small pivots of J refinement restores: see block_elimination.cpp,
// which is the same elimination.

#include <arcslip/continuation/linear_solver.hpp>

namespace arcslip::continuation {

class BorderedSparse {
 public:
  /// True: the pattern is a new one. Otherwise only values were written, and nothing was allocated.
  /// Throws std::length_error where there are more entries than an int counts.
  bool assemble(const SparseMatrix& J, const Borders& borders);

  SparseMatrix& matrix() { return matrix_; }  // compressed, (n + m) x (n + m)
  const SparseMatrix& matrix() const { return matrix_; }

  /// The factors of its rows, > 0; not finite or without use where finite() is false.
  const Vector& scales() const { return scales_; }
  /// The factors of its last m columns, m: the unknowns are those of the matrix over them.
  const Vector& column_scales() const { return column_scales_; }
  /// Sums of the magnitudes in its rows, and in its columns before its rows were scaled; more for the
  /// borders, so that residuals relative to them are rounding.
  const Vector& row_sums() const { return row_sums_; }
  const Vector& column_sums() const { return column_sums_; }
  bool finite() const { return column_sums_.allFinite(); }

 private:
  void scale(int n);

  SparseMatrix matrix_;
  Vector scales_, column_scales_, row_sums_, column_sums_;
};

}  // namespace arcslip::continuation
