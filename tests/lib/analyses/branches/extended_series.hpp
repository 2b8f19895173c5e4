#pragma once
// Fourier series in extended precision: values, roots, extremes.

#include <complex>
#include <numbers>
#include <utility>
#include <vector>

namespace extended {

using Real = long double;  // 64 bits of mantissa on x86
using Complex = std::complex<Real>;

inline constexpr Real pi = std::numbers::pi_v<Real>, turn = 2 * pi;

/// exp(i theta)
Complex unit(Real theta);

/// x(theta) = Re sum X_n exp(i n theta).
class Series {
 public:
  Series() = default;
  explicit Series(std::vector<Complex> X);

  bool empty() const { return X_.empty(); }
  Real value(Real theta) const;
  Real bound() const { return bound_; }  // of |x|: sum |X_n|
  Series rate() const;                   // dx/dtheta
  Series times(Real factor) const;
  Series plus(const Series& other) const;
  Series plus(Real constant) const;
  Real moving() const { return moving_; }  // bound() without the mean
  /// In one period from `begin` on, ascending, but for those that only touch.
  std::vector<Real> roots(Real begin) const;
  /// The highest and the lowest value.
  std::pair<Real, Real> range() const;
  Complex operator[](int n) const { return X_[static_cast<std::size_t>(n)]; }
  int order() const { return static_cast<int>(X_.size()) - 1; }

 private:
  std::vector<Complex> X_;
  Real bound_ = 0, moving_ = 0;
};

/// The root of g = level in [a, b], where g - level has one sign at a (or is 0 there) and the other at b.
Real bisected(const Series& g, const Series& rate, Real level, Real a, Real b);

}  // namespace extended
