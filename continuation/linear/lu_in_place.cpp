#include <arcslip/continuation/linear/cpu_dispatch.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/lapack.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr Eigen::Index panel = 4;  // columns

// The row of the largest entry of a column from its diagonal on.
Eigen::Index pivot_row(const double* column, Eigen::Index diagonal, Eigen::Index rows) {
  Eigen::Index row = diagonal;
  double largest = std::abs(column[diagonal]);
  for (Eigen::Index i = diagonal + 1; i < rows; ++i)
    if (const double size = std::abs(column[i]); size > largest) row = i, largest = size;
  return row;
}

// a -= u b.
[[gnu::always_inline]] inline void subtract(double* __restrict a, double u, const double* __restrict b,
                                            Eigen::Index n) {
  for (Eigen::Index i = 0; i < n; ++i) a[i] -= u * b[i];
}

[[gnu::always_inline]] inline void factorize(double* A, int* order, Eigen::Index n) {
  for (Eigen::Index i = 0; i < n; ++i) order[i] = static_cast<int>(i);
  for (Eigen::Index begin = 0; begin < n; begin += panel) {
    const Eigen::Index end = std::min(begin + panel, n);
    for (Eigen::Index k = begin; k < end; ++k) {
      double* column = A + k * n;
      const Eigen::Index pivot = pivot_row(column, k, n), below = n - k - 1;
      if (pivot != k) {
        std::swap(order[k], order[pivot]);
        for (Eigen::Index j = 0; j < n; ++j) std::swap(A[k + j * n], A[pivot + j * n]);
      }
      double* multipliers = column + k + 1;
      if (column[k] != 0)
        for (Eigen::Index i = 0; i < below; ++i) multipliers[i] /= column[k];
      for (Eigen::Index j = k + 1; j < end; ++j)
        subtract(A + j * n + k + 1, A[k + j * n], multipliers, below);
    }
    if (end == n) break;
    const double *l0 = A + begin * n, *l1 = l0 + n, *l2 = l1 + n, *l3 = l2 + n;
    for (Eigen::Index j = end; j < n; ++j) {
      double* __restrict a = A + j * n;
      double* u = a + begin;
      u[1] -= l0[begin + 1] * u[0];
      u[2] -= l0[begin + 2] * u[0] + l1[begin + 2] * u[1];
      u[3] -= l0[begin + 3] * u[0] + l1[begin + 3] * u[1] + l2[begin + 3] * u[2];
      const double u0 = u[0], u1 = u[1], u2 = u[2], u3 = u[3];
      for (Eigen::Index i = end; i < n; ++i) a[i] -= u0 * l0[i] + u1 * l1[i] + u2 * l2[i] + u3 * l3[i];
    }
  }
}

void factorize_large(Eigen::Index n, double* A, int* order, int* exchanges) {
  std::iota(order, order + n, 0);
  Eigen::Map<Matrix> matrix(A, n, n);
  if (!matrix.allFinite()) {
    matrix.diagonal().setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  lapack::factorize(static_cast<int>(n), A, exchanges);
  for (Eigen::Index i = 0; i < n; ++i) std::swap(order[i], order[exchanges[i] - 1]);
}

}  // namespace

void factorize_in_place(Eigen::Index n, double* A, int* order, int* work) {
  if (n >= lapack::smallest_lu) return factorize_large(n, A, order, work);
  widest([&]() __attribute__((always_inline)) { factorize(A, order, n); });
}

}  // namespace arcslip::continuation
