#pragma once
// The curve that the memory of a hysteretic law (laws/hysteresis.hpp) runs along between any two
// reversals, up to a shift of g:
//
//   dx/dg = r(x),  x(0) = 0
//
// in x = sgn(q') z/b and the distance g of q in units of b. Private. It is tabulated once for all motions, up
// to x = -1 and to r < 1e-13, where the memory is at its bound: in cells in which r is a polynomial of degree
// 11 to rounding, solved by collocation at the nodes of Gauss. They begin at x = 0, where the law may have no
// further derivative.

#include <arcslip/laws/hysteresis.hpp>
#include <arcslip/stability/legendre_fit.hpp>

#include <array>
#include <span>
#include <vector>

namespace arcslip::time {

class HysteresisCurve {
 public:
  static constexpr double at_bound = 1e-13;  // r

  HysteresisCurve(const elements::Hysteresis& law, std::span<const double> fields);

  double x(double g) const;
  /// The g of an x, -1 <= x <= 1.
  double g(double x) const;
  /// r there; 0 where z is at its bound.
  double rate_at(double g) const;
  double rate(double x) const { return law_->rate(fields_, x); }
  /// From here on x = 1.
  double end() const { return up_.end; }

 private:
  static constexpr int nodes = 12;
  // r = sum_j by_s[j] s^j, s = (|g| - g)/length; |x| = x + length times its integral
  struct Cell {
    double g, length, x;
    std::array<double, nodes> by_s;

    double x_at(double s) const;
    double rate_at(double s) const;
  };
  // Of x >= 0 or of x <= 0.
  struct Side {
    std::vector<Cell> cells;
    double end = 0;
  };

  Side tabulate(double sign) const;
  // Null: at the bound.
  static const Cell* cell_at(const Side& side, double size);
  // False: it is too long for a polynomial.
  bool solve(const LegendreFit& fit, double sign, Cell& cell) const;

  const elements::Hysteresis* law_;
  std::vector<double> fields_;
  Side up_, down_;
};

}  // namespace arcslip::time
