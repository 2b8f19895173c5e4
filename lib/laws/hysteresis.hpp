#pragma once
// A law with one direction and one memory z that follows the displacement q, however fast it moves:
//
//   f = f_q q + f_z z,   z' = r(z, sgn q') q',   |z| <= b
//
// with constant f_q and f_z, those of TimeLaw::begin(), and the same both ways: r(-z, -1) = r(z, 1). What z
// is along a motion depends on its reversals alone (stability/memory_along.hpp).

#include <span>

namespace arcslip::elements {

/// An optional part of such a law: Law::hysteresis().
class Hysteresis {
 public:
  /// b, m.
  virtual double bound(std::span<const double> fields) const = 0;
  /// r at z = x b while q grows, -1 <= x <= 1: positive, falling from -1 to 1, 0 at 1 alone; its derivatives
  /// may jump at x = 0.
  virtual double rate(std::span<const double> fields, double x) const = 0;

 protected:
  ~Hysteresis() = default;
};

}  // namespace arcslip::elements
