#include <arcslip/elements/reversals.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

constexpr int deepest = 14;       // halvings of a sampling step
constexpr int newton_steps = 60;  // with bisection where Newton leaves the bracket
constexpr double settled = 3e-9;  // rad

// Newton's method for a monotonic function in a bracket, with bisection if it leaves the bracket. The last
// step is below `settled`; the error is its square, at rounding level. values(t) -> {f, f'}. Returns the root
// and calls at_last(root - t) with its distance from the last evaluation.
template <class Function, class AtLast>
double bracketed_newton(Function&& values, double lower, double upper, double guess, bool rising,
                        AtLast&& at_last) {
  double t = guess > lower && guess < upper ? guess : 0.5 * (lower + upper);
  for (int k = 0;; ++k) {
    const auto [f, slope] = values(t);
    ((f > 0) == rising ? upper : lower) = t;
    double next = f == 0 ? t : t - f / slope;
    if (!(next >= lower && next <= upper)) next = 0.5 * (lower + upper);
    if (std::abs(next - t) <= settled || k == newton_steps) {
      at_last(next - t);
      return next;
    }
    t = next;
  }
}

}  // namespace

Reversals::Reversals(const Harmonics& harmonics)
    : harmonics_(harmonics),
      intervals_((harmonics.odd ? 1 : 2) * (harmonics.order + 15)),
      start_(0.0871),
      step_(harmonics.span() / intervals_),
      derivative_(intervals_, harmonics.size()),
      samples_(intervals_) {
  for (int k = 0; k < intervals_; ++k) {
    const double theta = start_ + k * step_;
    for (int i = 0; i < harmonics.cosines(); ++i) {
      const int n = harmonics.cosine_order(i);
      derivative_(k, i) = -n * std::sin(n * theta);
    }
    for (int j = 0; j < harmonics.sines(); ++j) {
      const int n = harmonics.sine_order(j);
      derivative_(k, harmonics.cosines() + j) = n * std::cos(n * theta);
    }
  }
  found_.reserve(static_cast<std::size_t>(4 * harmonics.order + 16));
}

Reversal Reversals::polish(In u, double t0, double g0, double t1, double g1, bool rising) const {
  const double secant = g1 != g0 ? t0 - g0 * (t1 - t0) / (g1 - g0) : t0;
  Values v{};
  double x = 0;
  const double theta = bracketed_newton(
      [&](double t) {
        v = series_values(harmonics_, u, t);
        return std::pair{v.d1, v.d2};
      },
      t0, t1, secant, rising, [&](double d) { x = v.x + d * (v.d1 + 0.5 * d * v.d2); });
  return {theta, x};
}

void Reversals::search(In u, double t0, double g0, bool positive0, double t1, double g1, bool positive1,
                       double M, int depth) {
  const double h = t1 - t0, bend = M * h * h;
  const bool changes = positive0 != positive1;
  if (changes ? (std::abs(g1 - g0) > bend / 2 || depth == 0)
              : (std::min(std::abs(g0), std::abs(g1)) > bend / 8 || depth == 0)) {
    if (changes) found_.push_back(polish(u, t0, g0, t1, g1, positive1));
    return;
  }
  const double middle = 0.5 * (t0 + t1);
  const double g = series_values(harmonics_, u, middle).d1;
  search(u, t0, g0, positive0, middle, g, g > 0, M, depth - 1);
  search(u, middle, g, g > 0, t1, g1, positive1, M, depth - 1);
}

// a cos theta + b sin theta turns at atan2(b, a) and half a period later.
void Reversals::one_harmonic(In u) {
  const double a = u[harmonics_.cosine_index(1)], b = u[harmonics_.sine_index(1)];
  const double amplitude = std::sqrt(a * a + b * b), mean = harmonics_.odd ? 0 : u[0];
  double theta = std::atan2(b, a), x = amplitude;
  for (; theta < start_; theta += std::numbers::pi) x = -x;
  found_.push_back({theta, mean + x});
  if (harmonics_.odd) return;
  theta += std::numbers::pi;
  if (theta < start_ + harmonics_.span())
    found_.push_back({theta, mean - x});
  else
    found_.insert(found_.begin(), {theta - 2 * std::numbers::pi, mean - x});
}

const std::vector<Reversal>& Reversals::find(In u) {
  found_.clear();
  const double M = series_bound(harmonics_, u, 3);
  if (!(M > 0) || !std::isfinite(M)) return found_;
  if (harmonics_.sines() == 1) {
    one_harmonic(u);
    return found_;
  }
  samples_.noalias() = derivative_ * u;
  const bool first_positive = samples_[0] > 0;
  bool positive = first_positive;
  for (int k = 0; k < intervals_; ++k) {
    const bool last = k + 1 == intervals_;
    const double g0 = samples_[k],
                 g1 = last ? (harmonics_.odd ? -samples_[0] : samples_[0]) : samples_[k + 1];
    // The span closes on itself: what is positive at its start is, where the motion is odd, not so at its
    // end.
    const bool positive1 = last ? first_positive != harmonics_.odd : g1 > 0;
    search(u, start_ + k * step_, g0, positive, start_ + (k + 1) * step_, g1, positive1, M, deepest);
    positive = positive1;
  }
  return found_;
}

double Reversals::crossing(In u, const Reversal& from, const Reversal& to, double target) const {
  const double range = from.x - to.x;
  const double share = (2 * target - from.x - to.x) / range;
  if (share >= 1) return from.theta;
  if (share <= -1) return to.theta;
  // Exact for one harmonic: between two reversals x runs like a cosine.
  const double guess = from.theta + (to.theta - from.theta) * std::acos(share) / std::numbers::pi;
  return bracketed_newton(
      [&](double t) {
        const Values v = series_values(harmonics_, u, t);
        return std::pair{v.x - target, v.d1};
      },
      from.theta, to.theta, guess, range < 0, [](double) {});
}

}  // namespace arcslip::elements
