#pragma once
// Matrices of structures with known answers.

#include <arcslip/scene/matrices.hpp>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace structures {

using Entries = std::vector<arcslip::scene::MatrixEntry>;

inline arcslip::scene::MatrixFile matrix(int size, const Entries& entries) {
  return {{"matrix", std::make_shared<const std::string>()},
          std::make_shared<const arcslip::scene::SparseMatrix>(
              arcslip::scene::sparse_matrix(size, size, entries))};
}

/// A prismatic Euler-Bernoulli beam of unit length, bending stiffness and mass per length: deflection and
/// slope of each node in turn. Those of the first node are held where it is clamped.
inline arcslip::scene::Matrices beam(int elements, bool clamped) {
  const double l = 1.0 / elements, k = 1 / (l * l * l), m = l / 420;
  const double Ke[4][4] = {{12, 6 * l, -12, 6 * l},
                           {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                           {-12, -6 * l, 12, -6 * l},
                           {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
  const double Me[4][4] = {{156, 22 * l, 54, -13 * l},
                           {22 * l, 4 * l * l, 13 * l, -3 * l * l},
                           {54, 13 * l, 156, -22 * l},
                           {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
  const int held = clamped ? 2 : 0, size = 2 * (elements + 1) - held;
  Entries M, K;
  for (int e = 0; e < elements; ++e)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int i = 2 * e + a - held, j = 2 * e + b - held;
        if (i < 0 || j < 0) continue;
        K.push_back({i, j, k * Ke[a][b]});
        M.push_back({i, j, m * Me[a][b]});
      }
  arcslip::scene::Matrices all;
  all.mass = matrix(size, M);
  all.stiffness = matrix(size, K);
  return all;
}

inline Eigen::MatrixXd dense(const arcslip::scene::MatrixFile& file) {
  const auto& A = *file.matrix;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(A.rows, A.columns);
  for (int j = 0; j < A.columns; ++j)
    for (int k = A.starts[static_cast<std::size_t>(j)]; k < A.starts[static_cast<std::size_t>(j) + 1]; ++k)
      all(A.row_of[static_cast<std::size_t>(k)], j) = A.values[static_cast<std::size_t>(k)];
  return all;
}

}  // namespace structures
