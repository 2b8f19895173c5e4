#pragma once
// The methods of Craig and Bampton and of Rubin (reduction.hpp): V from modes.

#include <arcslip/structure/blocks.hpp>
#include <arcslip/structure/interior_factor.hpp>
#include <arcslip/structure/static_condensation.hpp>

#include <Eigen/Core>

namespace arcslip::structure {

/// Modes A v theta = M v, V^T A V = 1, from the largest theta on.
struct LargestModes {
  Eigen::VectorXd theta;
  Eigen::MatrixXd V;
};

/// The modes of a positive definite A and a positive semidefinite M: `count` of them, or without a count (-1)
/// those above `least` > 0; fewer where there are no more with mass. By Lanczos' method for blocks, with full
/// orthogonalisation, until A^-1 M v - theta v is below 1e-8 theta in the norm of A (G. H. Golub and R.
/// Underwood, The block Lanczos method for computing eigenvalues, Mathematical Software III, 1977).
LargestModes largest_modes(const InteriorFactor& A, const Sparse& M, Eigen::Index count, double least);

/// Gives V its vectors, by purpose.method. of: condensed, with an empty V.
void take_modes(StaticCondensation& of, const Purpose& purpose, const control::Control& control);

}  // namespace arcslip::structure
