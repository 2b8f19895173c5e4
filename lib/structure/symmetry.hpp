#pragma once
// The matrices of a structure as symmetric and skew-symmetric ones.

#include <arcslip/scene/matrices.hpp>

#include <vector>

namespace arcslip::structure {

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
