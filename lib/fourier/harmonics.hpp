#pragma once
// The Fourier convention of Arcslip, stated once.
//
//   x(theta) = a_0 + sum_n a_n cos n theta + b_n sin n theta,   theta = base frequency * t
//
// The base frequency is that of the excitation, or an integer fraction of it where the motion takes several
// of its periods to repeat: a subharmonic response.
//
// The coefficients of one coordinate are stored as [a_0, a_1 ... a_N, b_1 ... b_N] or, where the motion is
// antisymmetric (x(theta + pi) = -x(theta)), as [a_1, a_3 ... , b_1, b_3 ...]: cosines, then sines. Several
// coordinates follow one another. The complex amplitude of a harmonic is X_n = a_n - i b_n: x = Re sum X_n
// exp(i n theta).

#include <Eigen/Core>

#include <numbers>

namespace arcslip::elements {

inline constexpr double whole_turn = 2 * std::numbers::pi;  // rad
/// kappa: a_n is this times the integral of x cos n theta over a full turn, and the mean half of that.
inline constexpr double fourier_factor = 1 / std::numbers::pi;

/// Which harmonics of the base frequency a motion has: all from the mean to `order`, or the odd ones up to
/// `order`. A value.
struct Harmonics {
  int order = 1;     // N >= 1
  bool odd = false;  // odd harmonics only, no mean
  int period = 1;    // of the motion, in periods of the excitation; base frequency = its frequency/period

  int cosines() const { return odd ? (order + 1) / 2 : order + 1; }
  int sines() const { return odd ? (order + 1) / 2 : order; }
  int size() const { return cosines() + sines(); }                 // coefficients of one coordinate
  int stride() const { return odd ? 2 : 1; }                       // between neighbouring orders
  int cosine_order(int i) const { return odd ? 2 * i + 1 : i; }    // n of a_n at index i
  int sine_order(int j) const { return odd ? 2 * j + 1 : j + 1; }  // n of b_n at index cosines() + j
  int cosine_index(int n) const { return odd ? (n - 1) / 2 : n; }
  int sine_index(int n) const { return cosines() + (odd ? (n - 1) / 2 : n - 1); }  // n >= 1
  bool has(int n) const { return n <= order && n >= 0 && (!odd || n % 2 == 1); }
  double base_frequency(double excitation) const { return excitation / period; }  // both in rad/s
  int excited(int n) const { return n * period; }  // the order at which harmonic n of the excitation stands
  double span() const { return odd ? std::numbers::pi : 2 * std::numbers::pi; }  // all of the motion is in it

  friend bool operator==(const Harmonics&, const Harmonics&) = default;
};

/// The coefficients of one or several functions in other harmonics of the same excitation: the terms whose
/// frequencies are among them, and 0 for those that are new.
void transfer(const Harmonics& from, Eigen::Ref<const Eigen::VectorXd> u, const Harmonics& to,
              Eigen::Ref<Eigen::VectorXd> v);

}  // namespace arcslip::elements
