#include <arcslip/continuation/window.hpp>

#include <algorithm>

namespace arcslip::continuation {
namespace {

constexpr int samples = 16;  // of a step that may pass a bound between its ends
constexpr int bisections = 50;

}  // namespace

std::optional<Exit> leaves(const Window& window, const Place& from, const Place& to, double length,
                           bool straight) {
  const Eigen::Index n = from.v.size() - 1;
  const double p0 = from.v[n], p1 = to.v[n];
  const double t0 = straight ? 0 : length * from.tangent[n], t1 = straight ? 0 : length * to.tangent[n];
  const auto inside_of = [&](double p) { return std::clamp(p, window.lower, window.upper); };
  const auto p = [&](double x) {
    const double y = 1 - x;
    return y * y * (1 + 2 * x) * p0 + x * x * (3 - 2 * x) * p1 + x * y * (y * t0 - x * t1);
  };
  const double p_end = inside_of(p1);
  if (p1 == p_end && t0 * t1 >= 0) return {};
  if (straight) return Exit{(p_end - p0) / (p1 - p0), p_end};
  double inside = 0;
  for (int k = 1; k <= samples; ++k) {
    const double share = static_cast<double>(k) / samples, at = k == samples ? p1 : p(share);
    const double bound = inside_of(at);
    if (at == bound) {
      inside = share;
      continue;
    }
    double outside = share;
    for (int bisection = 0; bisection < bisections; ++bisection) {
      const double middle = 0.5 * (inside + outside), here = p(middle);
      (here == inside_of(here) ? inside : outside) = middle;
    }
    return Exit{outside, bound};
  }
  return {};
}

bool draw_back(Corrector& with, const Place& from, const Exit& exit, int orientation, Place& place,
               Vector& row) {
  const Eigen::Index n = place.v.size() - 1;
  const double length = distance(with, from.v, place.v);
  Vector guess(n + 1);
  hermite(from.v, from.tangent, place.v, place.tangent, length, exit.share, guess);
  guess[n] = exit.bound;
  place.v = guess;
  row = Vector::Unit(n + 1, n);
  if (!with.correct(place.v, row, false).converged) return false;
  place.v[n] = exit.bound;
  if (distance(with, guess, place.v) > length || !settle(with, place)) return false;
  const bool signs = orientation != 0 && place.orientation != 0;
  if (place.piece != from.piece && signs) {  // beyond a kink the tangent may point anywhere
    if (place.orientation != orientation) place.reverse();
  } else {
    if (with.dot(place.tangent, from.tangent) < 0) place.reverse();
    if (signs && place.orientation != orientation) return false;
  }
  place.arclength = from.arclength + distance(with, from.v, place.v);
  return true;
}

}  // namespace arcslip::continuation
