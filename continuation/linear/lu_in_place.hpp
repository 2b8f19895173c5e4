#pragma once
// LU with partial pivoting of a dense matrix in place. Below 100 rows four columns are eliminated at once, so
// that what is left is read and written a fourth as often; from there on by LAPACK.

#include <arcslip/continuation/problem/problem.hpp>

namespace arcslip::continuation {

/// A, n x n by columns, becomes L, whose diagonal of ones is not stored, and U; row i of L U is row order[i]
/// of A. order, work: n. A singular A gives a zero pivot, and one that is not finite a pivot that is not.
/// Does not allocate.
void factorize_in_place(Eigen::Index n, double* A, int* order, int* work);

}  // namespace arcslip::continuation
