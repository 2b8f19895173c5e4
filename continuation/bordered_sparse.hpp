#pragma once
// The bordered matrix [J C; R D] (linear_solver.hpp) as one sparse matrix, for the sparse solvers, its rows
// scaled by powers of two: the largest entry of each row of [J C] is near 1, of each row of [R D] near n^-5.
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
  /// Sums of the magnitudes in its rows, and in the columns of the matrix before it was scaled; more for the
  /// borders, so that residuals relative to them are rounding.
  const Vector& row_sums() const { return row_sums_; }
  const Vector& column_sums() const { return column_sums_; }
  bool finite() const { return column_sums_.allFinite(); }

 private:
  void scale(int n);

  SparseMatrix matrix_;
  Vector scales_, row_sums_, column_sums_;
};

}  // namespace arcslip::continuation
