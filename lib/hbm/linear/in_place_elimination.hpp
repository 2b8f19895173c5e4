#pragma once
// Elimination of a few complex unknowns, in the matrix itself.

#include <arcslip/hbm/linear/linear_operator.hpp>

#include <algorithm>
#include <array>

namespace arcslip::hbm {

/// Of a pivot, relative to the largest entry of its column: below, a block Z_ll is singular.
inline constexpr double singular_pivot = 1e-14;
/// Coordinates up to which this costs less than elimination.hpp.
inline constexpr Eigen::Index in_place_up_to = 8;

/// a - b c, without the tests for infinity of operator*.
inline Complex less_product(Complex a, Complex b, Complex c) {
  return {a.real() - b.real() * c.real() + b.imag() * c.imag(),
          a.imag() - b.real() * c.imag() - b.imag() * c.real()};
}

inline constexpr Eigen::Index most_in_place = std::max<Eigen::Index>(in_place_up_to, most_changes);

/// B := A^-1 B for an A of up to most_in_place rows, which is overwritten, by elimination with row pivots.
/// False: A is singular.
inline bool eliminate(ComplexMatrix& A, ComplexMatrix& B) {
  const Eigen::Index n = A.rows(), m = B.cols();
  std::array<double, most_in_place> least;
  for (Eigen::Index k = 0; k < n; ++k)
    least[static_cast<std::size_t>(k)] = singular_pivot * singular_pivot * A.col(k).cwiseAbs2().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = 0;
    const double square = A.col(k).tail(n - k).cwiseAbs2().maxCoeff(&pivot);
    if (!(square > least[static_cast<std::size_t>(k)])) return false;
    if (pivot > 0) {
      A.row(k).tail(n - k).swap(A.row(k + pivot).tail(n - k));
      B.row(k).swap(B.row(k + pivot));
    }
    const Complex inverse = std::conj(A(k, k)) / square;
    A(k, k) = inverse;
    for (Eigen::Index i = k + 1; i < n; ++i) A(i, k) *= inverse;
    for (Eigen::Index j = k + 1; j < n; ++j)
      for (Eigen::Index i = k + 1; i < n; ++i) A(i, j) = less_product(A(i, j), A(i, k), A(k, j));
    for (Eigen::Index j = 0; j < m; ++j)
      for (Eigen::Index i = k + 1; i < n; ++i) B(i, j) = less_product(B(i, j), A(i, k), B(k, j));
  }
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index k = n - 1; k >= 0; --k) {
      B(k, j) *= A(k, k);
      for (Eigen::Index i = 0; i < k; ++i) B(i, j) = less_product(B(i, j), A(i, k), B(k, j));
    }
  return true;
}

}  // namespace arcslip::hbm
