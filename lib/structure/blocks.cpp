#include <arcslip/structure/blocks.hpp>

#include <cstddef>

namespace arcslip::structure {

using Eigen::Index, Eigen::MatrixXd;

Partition partition(int size, const std::vector<const scene::SparseMatrix*>& matrices,
                    const std::vector<int>& kept) {
  Partition parts;
  parts.kept = static_cast<Index>(kept.size());
  parts.place.assign(static_cast<std::size_t>(size), -1);
  std::vector<int> reached = kept;
  for (std::size_t i = 0; i < kept.size(); ++i)
    parts.place[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (const scene::SparseMatrix* matrix : matrices) {
      if (matrix == nullptr) continue;
      const scene::SparseMatrix& A = *matrix;
      const auto j = static_cast<std::size_t>(reached[next]);
      for (auto k = static_cast<std::size_t>(A.starts[j]); k < static_cast<std::size_t>(A.starts[j + 1]);
           ++k) {
        const auto row = static_cast<std::size_t>(A.row_of[k]);
        if (parts.place[row] >= 0 || A.values[k] == 0) continue;
        parts.place[row] = static_cast<int>(reached.size());
        reached.push_back(A.row_of[k]);
      }
    }
  parts.others = static_cast<Index>(reached.size()) - parts.kept;
  return parts;
}

Sparse whole(const scene::SparseMatrix& A, const Partition& parts) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(A.entries());
  for (std::size_t c = 0; c < parts.place.size(); ++c)
    for (auto k = static_cast<std::size_t>(A.starts[c]); k < static_cast<std::size_t>(A.starts[c + 1]); ++k)
      if (const int i = parts.place[static_cast<std::size_t>(A.row_of[k])]; i >= 0 && parts.place[c] >= 0)
        entries.emplace_back(i, parts.place[c], A.values[k]);
  const Index size = parts.kept + parts.others;
  Sparse of(size, size);
  of.setFromTriplets(entries.begin(), entries.end());
  return of;
}

Blocks blocks(const scene::SparseMatrix& A, const Partition& parts) {
  Blocks of{MatrixXd::Zero(parts.kept, parts.kept), Sparse(parts.others, parts.kept),
            Sparse(parts.others, parts.others)};
  std::vector<Eigen::Triplet<double>> ib, ii;
  ii.reserve(A.entries());
  const auto kept = static_cast<int>(parts.kept);
  for (std::size_t c = 0; c < parts.place.size(); ++c) {
    const int j = parts.place[c];
    if (j < 0) continue;
    for (auto k = static_cast<std::size_t>(A.starts[c]); k < static_cast<std::size_t>(A.starts[c + 1]); ++k) {
      const int i = parts.place[static_cast<std::size_t>(A.row_of[k])];
      if (i < 0) continue;
      if (i < kept && j < kept)
        of.bb(i, j) = A.values[k];
      else if (i >= kept && j < kept)
        ib.emplace_back(i - kept, j, A.values[k]);
      else if (i >= kept && j >= kept)
        ii.emplace_back(i - kept, j - kept, A.values[k]);
    }
  }
  of.ib.setFromTriplets(ib.begin(), ib.end());
  of.ii.setFromTriplets(ii.begin(), ii.end());
  return of;
}

}  // namespace arcslip::structure
