#pragma once
// The scaled variable y of a parameter: ln p if both bounds have the same sign and are not zero, otherwise p
// over the larger bound. Not installed.

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {

struct ScaledParameter {
  ScaledParameter(double lower_bound, double upper_bound)
      : lower(lower_bound),
        upper(upper_bound),
        logarithmic(lower > 0 || upper < 0),
        unit(std::max(std::abs(lower), std::abs(upper))) {}

  double scaled(double value) const {
    return !logarithmic ? value / unit : lower > 0 ? std::log(value) : -std::log(-value);
  }
  double value(double y) const { return !logarithmic ? y * unit : lower > 0 ? std::exp(y) : -std::exp(-y); }
  double slope(double value) const { return logarithmic ? std::abs(value) : unit; }  // dp/dy
  double second(double value) const { return logarithmic ? value : 0; }              // d2p/dy2
  double bound(int side) const { return side < 0 ? lower : upper; }

  double lower, upper;
  bool logarithmic;
  double unit;
};

}  // namespace arcslip::optimize
