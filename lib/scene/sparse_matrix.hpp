#pragma once

#include <cstddef>
#include <vector>

namespace arcslip::scene {

/// A sparse matrix by columns, rows and columns from 0. The entries of column j are those from
/// starts[j] to starts[j + 1], in the order of their rows. Of a symmetric matrix both triangles are there.
struct SparseMatrix {
  int rows = 0, columns = 0;
  std::vector<int> starts{0}, row_of;
  std::vector<double> values;

  std::size_t entries() const { return values.size(); }
};

/// One entry of a list.
struct MatrixEntry {
  int row, column;
  double value;
};

/// Entries in the same place are added.
SparseMatrix sparse_matrix(int rows, int columns, const std::vector<MatrixEntry>& entries);
/// The value in one place, 0 where there is none.
double value_at(const SparseMatrix& A, int row, int column);

}  // namespace arcslip::scene
