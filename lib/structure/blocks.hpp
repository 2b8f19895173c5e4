#pragma once
// The rows of large matrices that are linked to those kept, b, and the others among them, i; matrices as
// symmetric and skew-symmetric ones.

#include <arcslip/scene/matrices.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace arcslip::structure {

using Sparse = Eigen::SparseMatrix<double>;

/// Rows of the matrices as places in (b, i); -1: no entry links it to b.
struct Partition {
  std::vector<int> place;
  Eigen::Index kept = 0, others = 0;
};

/// matrices: those that link rows, each symmetric or skew-symmetric, of one size; null: none.
Partition partition(int size, const std::vector<const scene::SparseMatrix*>& matrices,
                    const std::vector<int>& kept);

/// The blocks of a symmetric matrix in (b, i), or of a skew-symmetric one, whose bi is -ib^T.
struct Blocks {
  Eigen::MatrixXd bb;
  Sparse ib, ii;
};

/// The whole matrix in (b, i).
Sparse whole(const scene::SparseMatrix& A, const Partition& parts);

Blocks blocks(const scene::SparseMatrix& A, const Partition& parts);

/// With the symmetric parts of C and K.
scene::Matrices symmetric_parts(scene::Matrices matrices);

/// A skew-symmetric matrix: with the velocity or the displacement, times the speed of rotation or not.
struct Skew {
  bool of_velocity, by_speed;
  scene::SparseMatrix A;
};

/// G, N, and the skew-symmetric parts of C and K.
std::vector<Skew> skew_parts(const scene::Matrices& of);

}  // namespace arcslip::structure
