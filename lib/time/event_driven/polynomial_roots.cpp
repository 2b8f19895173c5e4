#include <arcslip/time/event_driven/polynomial_roots.hpp>

#include <cmath>
#include <limits>

namespace arcslip::time {
namespace {

constexpr double roundoff = std::numeric_limits<double>::epsilon();

struct Sample {
  double s, g;
};

class Search {
 public:
  explicit Search(Coefficients c) : c_(c) {}

  // The changes of sign in (a, b], in their order; `visit` returns true to end the search.
  template <class Visit>
  bool run(const Sample& a, const Sample& b, Visit&& visit) const {
    const double h = b.s - a.s, m = 0.5 * (a.s + b.s);
    const bool change = (a.g > 0) != (b.g > 0);
    const auto [size, curvature] = bounds(b.s);
    const double sag = curvature * h * h / 8;
    if (!change && std::min(std::abs(a.g), std::abs(b.g)) >= sag) return false;
    const bool monotone = std::abs(slope(m)) > 0.5 * curvature * h;
    if (monotone || !(sag > roundoff * size)) return change && visit(polish(a, b));
    const Sample middle{m, value(c_, m)};
    return run(a, middle, visit) || run(middle, b, visit);
  }

 private:
  struct Bounds {
    double size, curvature;
  };

  // Of |g|, or what it is the sum of, and of |g''| on [0, s].
  Bounds bounds(double s) const {
    double size = 0, curvature = 0;
    for (std::size_t k = c_.size(); k-- > 0;) {
      size = size * s + std::abs(c_[k]);
      if (k >= 2) curvature = curvature * s + static_cast<double>(k * (k - 1)) * std::abs(c_[k]);
    }
    return {size, curvature};
  }

  double slope(double s) const {
    double d = 0;
    for (std::size_t k = c_.size(); k-- > 1;) d = d * s + static_cast<double>(k) * c_[k];
    return d;
  }

  // Newton's method kept in the bracket.
  double polish(Sample a, Sample b) const {
    double s = a.s + (b.s - a.s) * (a.g / (a.g - b.g)), last = b.s - a.s;
    for (int i = 0; i < 200; ++i) {
      if (!(s > a.s && s < b.s)) s = 0.5 * (a.s + b.s);
      if (s <= a.s || s >= b.s) break;
      const double g = value(c_, s);
      if (g == 0) return s;
      ((g > 0) == (a.g > 0) ? a : b) = {s, g};
      const double step = -g / slope(s);
      if (std::abs(step) <= 0.5 * std::numeric_limits<double>::epsilon() * s) return s;
      s = std::abs(step) < 0.5 * std::abs(last) ? s + step : 0.5 * (a.s + b.s);
      last = step;
    }
    return std::abs(a.g) < std::abs(b.g) ? a.s : b.s;
  }

  Coefficients c_;
};

}  // namespace

double value(Coefficients c, double s) {
  double g = 0;
  for (std::size_t k = c.size(); k-- > 0;) g = g * s + c[k];
  return g;
}

void sign_changes(Coefficients c, std::vector<double>& found) {
  found.clear();
  while (!c.empty() && c.front() == 0) c = c.subspan(1);
  Search(c).run({0, value(c, 0)}, {1, value(c, 1)}, [&](double s) {
    found.push_back(s);
    return false;
  });
}

std::optional<double> first_fall(Coefficients c, double rounding) {
  while (!c.empty() && std::abs(c.front()) <= rounding) c = c.subspan(1);
  if (c.empty()) return {};
  if (c.front() < 0) return 0.0;
  double rest = 0;
  for (std::size_t k = 1; k < c.size(); ++k) rest += std::abs(c[k]);
  if (rest < c.front()) return {};
  std::optional<double> first;
  Search(c).run({0, c.front()}, {1, value(c, 1)}, [&](double s) {
    first = s;
    return true;
  });
  return first;
}

}  // namespace arcslip::time
