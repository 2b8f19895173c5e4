#pragma once
// The bordered matrix [J C; R D] (linear_solver.hpp) as one sparse matrix, for the sparse solvers.

#include <arcslip/continuation/linear_solver.hpp>

namespace arcslip::continuation {

class BorderedSparse {
 public:
  /// True: the pattern is a new one. Otherwise only values were written.
  bool assemble(const SparseMatrix& J, const Borders& borders);
  SparseMatrix& matrix() { return matrix_; }  // compressed, (n + m) x (n + m)

 private:
  SparseMatrix matrix_;
  Eigen::Index nonzeros_of_J_ = -1;
};

}  // namespace arcslip::continuation
