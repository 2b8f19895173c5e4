#include "lib/analyses/branches/extended_series.hpp"

#include <algorithm>
#include <cmath>

namespace extended {
namespace {

constexpr Real touching = 1e-9L;  // rad: roots of a pair that is nearer change an integral by its cube

}  // namespace

Complex unit(Real theta) {
  return {std::cos(theta), std::sin(theta)};
}

Real bisected(const Series& g, const Series& rate, Real level, Real a, Real b) {
  const Real at_a = g.value(a) - level;
  if (at_a == 0) return a;
  const bool rises = at_a < 0;
  Real theta = (a + b) / 2;
  for (int i = 0; i < 200 && b > a; ++i) {
    const Real value = g.value(theta) - level;
    if (value == 0) return theta;
    ((value < 0) == rises ? a : b) = theta;
    const Real newton = theta - value / rate.value(theta);
    const Real next = newton > a && newton < b ? newton : (a + b) / 2;
    if (std::abs(next - theta) <= 1e-19L * turn || next == a || next == b) return next;
    theta = next;
  }
  return theta;
}

Series::Series(std::vector<Complex> X) : X_(std::move(X)) {
  for (std::size_t n = 1; n < X_.size(); ++n) moving_ += std::abs(X_[n]);
  bound_ = moving_ + (X_.empty() ? Real(0) : std::abs(X_[0]));
}

Real Series::value(Real theta) const {
  const Complex step = unit(theta);
  Complex sum = 0;
  for (std::size_t n = X_.size(); n-- > 1;) sum = (sum + X_[n]) * step;
  return X_[0].real() + sum.real();
}

Series Series::rate() const {
  std::vector<Complex> dX(X_.size());
  for (std::size_t n = 0; n < X_.size(); ++n) dX[n] = Complex(0, static_cast<Real>(n)) * X_[n];
  return Series(std::move(dX));
}

Series Series::times(Real factor) const {
  std::vector<Complex> X = X_;
  for (Complex& each : X) each *= factor;
  return Series(std::move(X));
}

Series Series::plus(const Series& other) const {
  std::vector<Complex> X = X_;
  for (std::size_t n = 0; n < X.size(); ++n) X[n] += other.X_[n];
  return Series(std::move(X));
}

Series Series::plus(Real constant) const {
  std::vector<Complex> X = X_;
  X[0] += constant;
  return Series(std::move(X));
}

std::vector<Real> Series::roots(Real begin) const {
  const Series first = rate();
  const Real steepest = first.bound(), most_bent = first.rate().bound();
  std::vector<Real> found;
  if (steepest == 0) return found;
  const auto search = [&](auto&& self, Real a, Real b, Real at_a, Real at_b) -> void {
    const Real middle = (a + b) / 2, half = (b - a) / 2, at_middle = value(middle);
    if (std::abs(at_middle) > steepest * half) return;
    const bool changes = (at_a <= 0) != (at_b <= 0);
    if (half < touching || std::abs(first.value(middle)) > most_bent * half) {
      if (changes) found.push_back(bisected(*this, first, 0, a, b));
      return;
    }
    self(self, a, middle, at_a, at_middle);
    self(self, middle, b, at_middle, at_b);
  };
  const int pieces = 4 * order();
  const Real at_begin = value(begin);
  Real a = begin, at_a = at_begin;
  for (int i = 1; i <= pieces; ++i) {
    const Real b = begin + turn * static_cast<Real>(i) / static_cast<Real>(pieces);
    const Real at_b = i == pieces ? at_begin : value(b);
    search(search, a, b, at_a, at_b);
    a = b;
    at_a = at_b;
  }
  return found;
}

std::pair<Real, Real> Series::range() const {
  Real high = value(0), low = high;
  for (const Real theta : rate().roots(0.1L)) {
    high = std::max(high, value(theta));
    low = std::min(low, value(theta));
  }
  return {high, low};
}

}  // namespace extended
