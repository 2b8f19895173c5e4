#include <arcslip/scene/sparse_matrix.hpp>

#include <algorithm>

namespace arcslip::scene {

// Sorted by rows, then, keeping that order, by columns.
SparseMatrix sparse_matrix(int rows, int columns, const std::vector<MatrixEntry>& entries) {
  const auto sorted_by = [](int count, const auto& place, const std::vector<MatrixEntry>& all,
                            std::vector<int>& starts) {
    starts.assign(static_cast<std::size_t>(count) + 1, 0);
    for (const MatrixEntry& entry : all) ++starts[static_cast<std::size_t>(place(entry)) + 1];
    for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
    std::vector<int> next(starts.begin(), starts.end() - 1);
    std::vector<MatrixEntry> sorted(all.size());
    for (const MatrixEntry& entry : all)
      sorted[static_cast<std::size_t>(next[static_cast<std::size_t>(place(entry))]++)] = entry;
    return sorted;
  };
  std::vector<int> starts;
  auto sorted = sorted_by(rows, [](const MatrixEntry& e) { return e.row; }, entries, starts);
  sorted = sorted_by(columns, [](const MatrixEntry& e) { return e.column; }, sorted, starts);
  SparseMatrix A{rows, columns, {0}, {}, {}};
  A.starts.reserve(static_cast<std::size_t>(columns) + 1);
  A.row_of.reserve(sorted.size());
  A.values.reserve(sorted.size());
  for (std::size_t j = 0; j < static_cast<std::size_t>(columns); ++j) {
    const auto first = A.values.size();
    for (auto k = static_cast<std::size_t>(starts[j]); k < static_cast<std::size_t>(starts[j + 1]); ++k) {
      if (A.values.size() > first && A.row_of.back() == sorted[k].row) {
        A.values.back() += sorted[k].value;
      } else {
        A.row_of.push_back(sorted[k].row);
        A.values.push_back(sorted[k].value);
      }
    }
    A.starts.push_back(static_cast<int>(A.values.size()));
  }
  return A;
}

double value_at(const SparseMatrix& A, int row, int column) {
  const auto first = A.row_of.begin() + A.starts[static_cast<std::size_t>(column)];
  const auto last = A.row_of.begin() + A.starts[static_cast<std::size_t>(column) + 1];
  const auto found = std::lower_bound(first, last, row);
  return found != last && *found == row ? A.values[static_cast<std::size_t>(found - A.row_of.begin())] : 0;
}

}  // namespace arcslip::scene
