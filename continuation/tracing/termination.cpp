#include <arcslip/continuation/tracing/termination.hpp>

#include <arcslip/continuation/problem/text.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr double least_power = 0.1;  // of the distance from a bound: u converges at least like this power
constexpr int samples_of_step = 16;  // of a step that may cross a bound between its ends
constexpr int window_bisections = 50;

}  // namespace

std::optional<Exit> leaves(const Window& window, const CurvePoint& from, const CurvePoint& to, double length,
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
  for (int k = 1; k <= samples_of_step; ++k) {
    const double share = static_cast<double>(k) / samples_of_step, at = k == samples_of_step ? p1 : p(share);
    const double bound = inside_of(at);
    if (at == bound) {
      inside = share;
      continue;
    }
    double outside = share;
    for (int bisection = 0; bisection < window_bisections; ++bisection) {
      const double middle = 0.5 * (inside + outside), here = p(middle);
      (here == inside_of(here) ? inside : outside) = middle;
    }
    return Exit{outside, bound};
  }
  return {};
}

std::optional<Exit> cut_at_exit(const Window& window, const CurvePoint& here, TrialStep& trial) {
  const CurvePoint* from = &here;
  for (std::size_t k = 0; k < trial.corners.size(); ++k) {
    const CurvePoint& to = trial.corners[k].before;
    if (const auto found = leaves(window, *from, to, to.arclength - from->arclength, false)) {
      trial.end = to;
      trial.corners.resize(k);
      return found;
    }
    from = &trial.corners[k].beyond;
  }
  const CurvePoint& end = trial.end;
  return leaves(window, *from, end, end.arclength - from->arclength, trial.kink && trial.corners.empty());
}

bool correct_to_bound(Corrector& with, const CurvePoint& from, const Exit& exit, int orientation,
                      CurvePoint& place, Vector& row) {
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

bool approaches_asymptotically(const Corrector& in, const CurvePoint& before, const CurvePoint& here,
                               double bound) {
  const Eigen::Index n = here.v.size() - 1;
  const auto change = [&](const CurvePoint& at) {
    return std::abs(bound - at.v[n]) * in.norm_u(at.tangent) / std::abs(at.tangent[n]);
  };
  const double x = std::abs(bound - here.v[n]), x_before = std::abs(bound - before.v[n]);
  if (!(x > 0 && x < x_before)) return false;
  const double now = change(here), then = change(before);
  return std::isfinite(now) && std::log(now / then) > least_power * std::log(x / x_before);
}

std::optional<BranchStop> limit_reached(const Options& options, const control::Control& timed,
                                        const Branch& branch, int unknowns, double size, double parameter) {
  if (size > options.largest_state)
    return BranchStop{StopReason::state_too_large, size, options.largest_state,
                      "the solution grows without bound near " + text(parameter)};
  const long points = branch.counts.points;
  if (points >= options.points)
    return BranchStop{StopReason::point_limit, static_cast<double>(points),
                      static_cast<double>(options.points),
                      "reached the maximum number of points, " + std::to_string(options.points)};
  if (!timed.keep_going() && options.control.ending().reason == control::EndReason::none)
    return BranchStop{StopReason::time_limit, timed.ending().seconds, options.seconds,
                      "reached the time limit of " + text(options.seconds) + " s"};
  if (options.memory > 0) {
    const auto numbers = 2 * static_cast<std::size_t>(unknowns) + 1;
    const auto states = options.keep_states ? static_cast<std::size_t>(branch.state.size()) : 0;
    const std::size_t each = sizeof(Point) + sizeof(double) * ((options.keep_points ? numbers : 0) + states);
    const std::size_t bytes = each * branch.points.size();
    if (bytes >= options.memory)
      return BranchStop{StopReason::memory_limit, static_cast<double>(bytes),
                        static_cast<double>(options.memory),
                        "the points of the branch reached the memory limit of " +
                            std::to_string(options.memory) + " bytes"};
  }
  return {};
}

namespace {

constexpr int home_bisections = 30;
constexpr double closing_distance = 0.05;  // of a step: a start this close may lie on it
constexpr double rounding_share = 10;  // of the corrector's: closer solutions are the same

}  // namespace

bool may_close(const Corrector& in, const CurvePoint& start, const CurvePoint& from, const CurvePoint& to,
               double length, double largest_angle, Vector& v) {
  if (from.arclength == 0) return false;
  const auto ahead = [&](const Vector& place) { return in.dot(start.v - place, start.tangent); };
  double lower = 0, upper = 1, a = ahead(from.v), b = ahead(to.v);
  if (!(a > 0 && b <= closing_distance * length) || distance(in, from.v, start.v) > (1 + closing_distance) * length)
    return false;
  if (in.dot(start.tangent, to.tangent) < std::cos(largest_angle)) return false;
  v = to.v;
  for (int k = 0; k < home_bisections && b < 0; ++k) {
    const double middle = lower + (upper - lower) * std::clamp(a / (a - b), 0.1, 0.9);
    hermite(from.v, from.tangent, to.v, to.tangent, length, middle, v);
    const double at = ahead(v);
    (at > 0 ? lower : upper) = middle;
    (at > 0 ? a : b) = at;
  }
  return distance(in, v, start.v) <= closing_distance * length;
}

double closing_tolerance(const Corrector& in, const CurvePoint& start, double rounding_level) {
  const double p = std::abs(start.v[start.v.size() - 1]) / in.parameter_scale();
  return rounding_share * rounding_level * (1 + in.norm_u(start.v) + p);
}

}  // namespace arcslip::continuation
