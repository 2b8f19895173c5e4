#pragma once
// What is used of BLAS and LAPACK, for matrices whose columns are contiguous. Not installed.

#include <complex>
#include <mutex>

namespace arcslip::continuation::lapack {

// From here on LAPACK is faster than Eigen: with SSE2 1.6 times at 100, 2.0 at 160, 2.8 at 840 unknowns.
inline constexpr int smallest_lu = 100;

/// To be held while BLAS is called, also by other libraries: where it may not be called by several threads at
/// a time, they wait for each other. Throws std::bad_alloc where OpenBLAS would not get the memory of its
/// first use, for which it asks without an end. The functions below hold it.
[[nodiscard]] std::unique_lock<std::mutex> use();

/// P A = L U in place, rows i and exchanges[i] - 1 exchanged one after the other. A zero pivot stays in U. A
/// NaN may be lost, as a kernel may pass over products with 0.
void factorize(int n, double* A, int* exchanges);
void factorize(int n, std::complex<double>* A, int* exchanges);

/// T^-1 B in place, T the lower triangle of A with a diagonal of 1 ("L", "U"), or the upper one ("U", "N").
void solve_triangle(const char* part, const char* diagonal, int n, int columns, const double* A, double* B);
void solve_triangle(const char* part, const char* diagonal, int n, int columns, const std::complex<double>* A,
                    std::complex<double>* B);

/// A matrix in memory, its columns `stride` apart.
struct Columns {
  const double* data;
  int rows, cols, stride;
};
/// C = alpha A B + beta C, or with A^T in place of A; the columns of C are `stride` apart.
void multiply(bool transposed, double alpha, const Columns& A, const Columns& B, double beta, double* C,
              int stride);

/// A V = V diag(values) of a symmetric A, n x n, or A V = B V diag(values), V^T B V = 1, of a positive
/// definite B, which its factor replaces; null: none. By divide and conquer; lower triangles alone are read,
/// and V takes the place of A. False: not converged, or B is not positive definite.
bool symmetric_modes(bool with_vectors, int n, double* A, double* B, double* values);

}  // namespace arcslip::continuation::lapack
