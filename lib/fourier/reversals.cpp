#include <arcslip/fourier/reversals.hpp>

#include <arcslip/fourier/bracketed_root.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace arcslip::elements {
namespace {

constexpr int deepest = 14;   // halvings of a sampling step
constexpr int tabulated = 2;  // the first of them

}  // namespace

Reversals::Reversals(const Harmonics& harmonics)
    : harmonics_(harmonics),
      intervals_((harmonics.odd ? 1 : 2) * (harmonics.order + 15)),
      start_(0.0871),
      step_(harmonics.span() / intervals_),
      derivative_(intervals_, harmonics.size()),
      between_(harmonics.size(), 3 * intervals_),
      samples_(intervals_) {
  std::vector<std::complex<double>> waves(static_cast<std::size_t>(harmonics.order + 1));
  const auto set_slopes = [&](double theta, auto&& row) {  // of the basis
    powers(theta, harmonics.order + 1, waves.data());
    for (int i = 0; i < harmonics.cosines(); ++i) {
      const int n = harmonics.cosine_order(i);
      row[i] = -n * waves[static_cast<std::size_t>(n)].imag();
    }
    for (int j = 0; j < harmonics.sines(); ++j) {
      const int n = harmonics.sine_order(j);
      row[harmonics.cosines() + j] = n * waves[static_cast<std::size_t>(n)].real();
    }
  };
  for (int k = 0; k < intervals_; ++k) {
    set_slopes(start_ + k * step_, derivative_.row(k));
    for (int i = 0; i < 3; ++i) set_slopes(start_ + (k + 0.25 * (i + 1)) * step_, between_.col(3 * k + i));
  }
  found_.reserve(static_cast<std::size_t>(4 * harmonics.order + 16));
}

Reversal Reversals::polish(In u, const Slope& from, const Slope& to) const {
  const double rise = to.d1 - from.d1;
  const double secant = rise != 0 ? from.theta - from.d1 * (to.theta - from.theta) / rise : from.theta;
  Values v{};
  double x = 0;
  const double theta = bracketed_root(
      harmonics_.order,
      [&](double t) {
        v = series_values(harmonics_, u, t);
        return Slopes{v.d1, v.d2, v.d3};
      },
      from.theta, to.theta, secant, to.positive, [&](double d) { x = v.x + d * (v.d1 + 0.5 * d * v.d2); });
  return {theta, x};
}

// column: of between_, for the first halvings.
void Reversals::search(In u, const Slope& from, const Slope& to, double M, int depth, int column) {
  const double h = to.theta - from.theta, bend = M * h * h;
  const bool changes = from.positive != to.positive;
  if (changes ? (std::abs(to.d1 - from.d1) > bend / 2 || depth == 0)
              : (std::min(std::abs(from.d1), std::abs(to.d1)) > bend / 8 || depth == 0)) {
    if (changes) found_.push_back(polish(u, from, to));
    return;
  }
  const double theta = 0.5 * (from.theta + to.theta);
  const double d1 =
      depth > deepest - tabulated ? between_.col(column).dot(u) : series_values(harmonics_, u, theta).d1;
  const Slope middle{theta, d1, d1 > 0};
  search(u, from, middle, M, depth - 1, column - 1);
  search(u, middle, to, M, depth - 1, column + 1);
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
  const double bend = M * step_ * step_;
  const bool first_positive = samples_[0] > 0;
  bool positive = first_positive;
  for (int k = 0; k < intervals_; ++k) {
    const bool last = k + 1 == intervals_;
    const double d0 = samples_[k],
                 d1 = last ? (harmonics_.odd ? -samples_[0] : samples_[0]) : samples_[k + 1];
    // The span closes on itself: what is positive at its start is, where the motion is odd, not so at its
    // end.
    const bool before = std::exchange(positive, last ? first_positive != harmonics_.odd : d1 > 0);
    if (before == positive && std::min(std::abs(d0), std::abs(d1)) > bend / 8) continue;
    const Slope from{start_ + k * step_, d0, before}, to{start_ + (k + 1) * step_, d1, positive};
    search(u, from, to, M, deepest, 3 * k + 1);
  }
  return found_;
}

const std::vector<Reversal>& Reversals::within(In u, double begin, double end) {
  found_.clear();
  const auto at = [&](double theta) {
    const double d1 = series_values(harmonics_, u, theta).d1;
    return Slope{theta, d1, d1 > 0};
  };
  search(u, at(begin), at(end), series_bound(harmonics_, u, 3), deepest - tabulated, 0);
  return found_;
}

double Reversals::crossing(In u, const Reversal& from, const Reversal& to, double target) const {
  const double range = from.x - to.x;
  const double share = (2 * target - from.x - to.x) / range;
  if (share >= 1) return from.theta;
  if (share <= -1) return to.theta;
  // Exact for one harmonic: between two reversals x runs like a cosine.
  const double guess = from.theta + (to.theta - from.theta) * std::acos(share) / std::numbers::pi;
  return bracketed_root(
      harmonics_.order,
      [&](double t) {
        const Values v = series_values(harmonics_, u, t);
        return Slopes{v.x - target, v.d1, v.d2};
      },
      from.theta, to.theta, guess, range < 0, [](double) {});
}

}  // namespace arcslip::elements
