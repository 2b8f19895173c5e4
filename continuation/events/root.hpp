#pragma once
// A bracketed zero of a function of one variable, by Chandrupatla's method (Adv. Eng. Software 28, 1997):
// inverse quadratic interpolation where safe, otherwise bisection. A jump across zero is bracketed as well.

#include <cmath>
#include <utility>

namespace arcslip::continuation {

struct Root {
  double x;                 // the better end of the bracket
  double lower, upper;      // the bracket, lower < upper
  double f_lower, f_upper;  // of opposite sign, or one of them zero
  int evaluations;
};

/// f(a) = fa and f(b) = fb of opposite sign, a < b. The bracket is narrowed to `tolerance`. first: the share
/// of the way from a to b to look at first.
template <class Function>
Root find_root(Function&& f, double a, double fa, double b, double fb, double tolerance, double first) {
  const auto root = [&](double x1, double f1, double x2, double f2, int evaluations) {
    const double best = std::abs(f1) < std::abs(f2) ? x1 : x2;
    if (x1 > x2) {
      std::swap(x1, x2);
      std::swap(f1, f2);
    }
    return Root{best, x1, x2, f1, f2, evaluations};
  };
  double x1 = a, f1 = fa, x2 = b, f2 = fb, t = first;
  if (!(t > 0 && t < 1)) t = 0.5;
  const int most = 200;
  for (int evaluations = 1;; ++evaluations) {
    if (f1 == 0 || f2 == 0 || std::abs(x2 - x1) <= tolerance || evaluations > most)
      return root(x1, f1, x2, f2, evaluations - 1);
    const double margin = 0.5 * tolerance / std::abs(x2 - x1);
    t = std::min(1 - margin, std::max(margin, t));
    const double x = x1 + t * (x2 - x1);
    const double fx = f(x);
    double x3, f3;
    if ((fx > 0) == (f1 > 0)) {  // the new point replaces x1
      x3 = x1, f3 = f1;
    } else {
      x3 = x2, f3 = f2;
      x2 = x1, f2 = f1;
    }
    x1 = x, f1 = fx;
    const double xi = (x1 - x2) / (x3 - x2), phi = (f1 - f2) / (f3 - f2);
    if (1 - std::sqrt(1 - xi) < phi && phi < std::sqrt(xi))
      t = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2);
    else
      t = 0.5;
  }
}

/// The secant first.
template <class Function>
Root find_root(Function&& f, double a, double fa, double b, double fb, double tolerance) {
  return find_root(std::forward<Function>(f), a, fa, b, fb, tolerance, fa / (fa - fb));
}

}  // namespace arcslip::continuation
