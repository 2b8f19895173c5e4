#include <arcslip/continuation/bordered_sparse.hpp>

#include <algorithm>

namespace arcslip::continuation {

bool BorderedSparse::assemble(const SparseMatrix& J, const Borders& borders) {
  const int n = static_cast<int>(J.rows()), m = borders.width();
  const bool new_pattern = matrix_.rows() != n + m || nonzeros_of_J_ != J.nonZeros();
  if (new_pattern) {
    matrix_ = SparseMatrix(n + m, n + m);
    matrix_.resizeNonZeros(J.nonZeros() + 2 * n * m + m * m);
    nonzeros_of_J_ = J.nonZeros();
  }
  int* outer = matrix_.outerIndexPtr();
  int* inner = matrix_.innerIndexPtr();
  double* value = matrix_.valuePtr();
  int k = 0;
  for (int j = 0; j < n; ++j) {
    outer[j] = k;
    for (int l = J.outerIndexPtr()[j]; l < J.outerIndexPtr()[j + 1]; ++l, ++k) {
      inner[k] = J.innerIndexPtr()[l];
      value[k] = J.valuePtr()[l];
    }
    for (int i = 0; i < m; ++i, ++k) {
      inner[k] = n + i;
      value[k] = borders.rows(j, i);
    }
  }
  for (int j = 0; j < m; ++j) {
    outer[n + j] = k;
    for (int i = 0; i < n + m; ++i, ++k) {
      inner[k] = i;
      value[k] = i < n ? borders.columns(i, j) : borders.corner(i - n, j);
    }
  }
  outer[n + m] = k;
  return new_pattern;
}

}  // namespace arcslip::continuation
