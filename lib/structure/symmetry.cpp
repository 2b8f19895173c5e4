#include <arcslip/structure/blocks.hpp>

#include <cstddef>
#include <memory>

namespace arcslip::structure {
namespace {

// (A + sign A^T)/2
scene::SparseMatrix with_transpose(const scene::SparseMatrix& A, double sign) {
  std::vector<scene::MatrixEntry> entries;
  entries.reserve(2 * A.entries());
  for (int j = 0; j < A.columns; ++j)
    for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k) {
      entries.push_back({A.row_of[k], j, 0.5 * A.values[k]});
      entries.push_back({j, A.row_of[k], sign * 0.5 * A.values[k]});
    }
  return scene::sparse_matrix(A.rows, A.columns, entries);
}

}  // namespace

scene::Matrices symmetric_parts(scene::Matrices matrices) {
  const auto replace = [](scene::MatrixFile& file) {
    file.matrix = std::make_shared<const scene::SparseMatrix>(with_transpose(*file.matrix, 1));
  };
  if (matrices.unsymmetric_stiffness) replace(matrices.stiffness);
  if (matrices.unsymmetric_damping) replace(matrices.damping);
  return matrices;
}

std::vector<Skew> skew_parts(const scene::Matrices& of) {
  std::vector<Skew> all;
  const auto add = [&](bool of_velocity, bool by_speed, const scene::MatrixFile& file) {
    if (file.matrix) all.push_back({of_velocity, by_speed, with_transpose(*file.matrix, -1)});
  };
  add(true, true, of.gyroscopic);
  add(false, true, of.circulatory);
  if (of.unsymmetric_stiffness) add(false, false, of.stiffness);
  if (of.unsymmetric_damping) add(true, false, of.damping);
  return all;
}

}  // namespace arcslip::structure
