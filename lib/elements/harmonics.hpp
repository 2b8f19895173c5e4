#pragma once
// The Fourier convention of Arcslip, stated once.
//
//   x(theta) = a_0 + sum_n a_n cos n theta + b_n sin n theta,   theta = omega t
//
// The coefficients of one coordinate are stored as [a_0, a_1 ... a_N, b_1 ... b_N] or, where the motion is
// antisymmetric (x(theta + pi) = -x(theta)), as [a_1, a_3 ... , b_1, b_3 ...]: cosines, then sines. Several
// coordinates follow one another. The complex amplitude of a harmonic is X_n = a_n - i b_n: x = Re sum X_n
// exp(i n theta).

#include <Eigen/Core>

#include <numbers>

namespace arcslip::elements {

/// Which harmonics a motion has: all from the mean to `order`, or the odd ones up to `order`. A value.
struct Harmonics {
  int order = 1;     // N >= 1
  bool odd = false;  // odd harmonics only, no mean

  int cosines() const { return odd ? (order + 1) / 2 : order + 1; }
  int sines() const { return odd ? (order + 1) / 2 : order; }
  int size() const { return cosines() + sines(); }                 // coefficients of one coordinate
  int stride() const { return odd ? 2 : 1; }                       // between neighbouring orders
  int cosine_order(int i) const { return odd ? 2 * i + 1 : i; }    // n of a_n at index i
  int sine_order(int j) const { return odd ? 2 * j + 1 : j + 1; }  // n of b_n at index cosines() + j
  int cosine_index(int n) const { return odd ? (n - 1) / 2 : n; }
  int sine_index(int n) const { return cosines() + (odd ? (n - 1) / 2 : n - 1); }  // n >= 1
  bool has(int n) const { return n <= order && n >= 0 && (!odd || n % 2 == 1); }
  double span() const { return odd ? std::numbers::pi : 2 * std::numbers::pi; }  // all of the motion is in it

  friend bool operator==(const Harmonics&, const Harmonics&) = default;
};

}  // namespace arcslip::elements
