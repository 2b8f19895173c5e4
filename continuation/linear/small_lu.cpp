#include <arcslip/continuation/linear/small_lu.hpp>

#include <algorithm>
#include <cmath>
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

}  // namespace

void factorize_small(Matrix& A, Eigen::VectorXi& order) {
  const Eigen::Index n = A.rows();
  for (Eigen::Index i = 0; i < n; ++i) order[i] = static_cast<int>(i);
  for (Eigen::Index begin = 0; begin < n; begin += panel) {
    const Eigen::Index end = std::min(begin + panel, n);
    for (Eigen::Index k = begin; k < end; ++k) {
      const Eigen::Index pivot = pivot_row(A.col(k).data(), k, n), below = n - k - 1;
      if (pivot != k) {
        std::swap(order[k], order[pivot]);
        for (Eigen::Index j = 0; j < n; ++j) std::swap(A(k, j), A(pivot, j));
      }
      const auto multipliers = A.col(k).tail(below);
      if (A(k, k) != 0) A.col(k).tail(below) /= A(k, k);
      for (Eigen::Index j = k + 1; j < end; ++j) A.col(j).tail(below) -= A(k, j) * multipliers;
    }
    if (end == n) break;
    const auto L = A.middleCols<panel>(begin);
    const auto below = L.bottomRows(n - end);
    for (Eigen::Index j = end; j < n; ++j) {
      double* u = A.col(j).data() + begin;
      u[1] -= L(begin + 1, 0) * u[0];
      u[2] -= L(begin + 2, 0) * u[0] + L(begin + 2, 1) * u[1];
      u[3] -= L(begin + 3, 0) * u[0] + L(begin + 3, 1) * u[1] + L(begin + 3, 2) * u[2];
      A.col(j).tail(n - end) -=
          u[0] * below.col(0) + u[1] * below.col(1) + u[2] * below.col(2) + u[3] * below.col(3);
    }
  }
}

}  // namespace arcslip::continuation
