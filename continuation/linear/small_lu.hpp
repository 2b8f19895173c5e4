#pragma once
// LU with partial pivoting of a small dense matrix, in place: four columns are eliminated at once, so that
// what is left is read and written a fourth as often. Eigen's blocked algorithm, which copies its blocks for
// the cache, overtakes it from some 500 rows on.

#include <arcslip/continuation/problem/problem.hpp>

namespace arcslip::continuation {

constexpr Eigen::Index largest_small_lu = 256;  // rows

/// A becomes L, whose diagonal of ones is not stored, and U. order: as many as rows; row i of L U is row
/// order[i] of A. A singular A gives a zero pivot, or one that is not finite. Does not allocate.
void factorize_small(Matrix& A, Eigen::VectorXi& order);

}  // namespace arcslip::continuation
