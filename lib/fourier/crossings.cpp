#include <arcslip/fourier/crossings.hpp>

#include <arcslip/fourier/bracketed_root.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::elements {
namespace {

constexpr int most_halvings = 3;          // of a sampling step, before its reversals are found
constexpr double level_rounding = 1e-12;  // of the farthest that the motion may come from its mean

}  // namespace

Crossings::Crossings(const Harmonics& harmonics)
    : harmonics_(harmonics),
      intervals_(2 * (harmonics.order + 15)),
      start_(0.0871),
      step_(harmonics.span() / intervals_),
      values_(intervals_, harmonics.size()),
      samples_(intervals_) {
  Eigen::VectorXd phi(harmonics.size());
  for (int k = 0; k < intervals_; ++k) {
    series_basis(harmonics, start_ + k * step_, phi);
    values_.row(k) = phi.transpose();
  }
  found_.reserve(static_cast<std::size_t>(2 * harmonics.order + 2));
}

const std::vector<Crossing>& Crossings::find(In u, double level, Reversals& reversals) {
  found_.clear();
  level_ = level;
  M_ = series_bound(harmonics_, u, 2);
  above_ = u[0] > level;
  if (!(M_ > 0) || !std::isfinite(M_) || !std::isfinite(level)) return found_;
  if (std::abs(u[0] - level) > (1 + level_rounding) * series_bound(harmonics_, u, 0)) return found_;
  samples_.noalias() = values_ * u;
  samples_.array() -= level;
  const double near = M_ * step_ * step_ / 8;
  above_ = samples_[0] > 0;
  bool above = above_;
  for (int k = 0; k < intervals_; ++k) {
    const bool last = k + 1 == intervals_;
    const double from = samples_[k], to = samples_[last ? 0 : k + 1];
    const bool before = std::exchange(above, to > 0);
    if (before == above && std::min(std::abs(from), std::abs(to)) > near) continue;
    search(u, {start_ + k * step_, from, before}, {start_ + (k + 1) * step_, to, above}, most_halvings,
           reversals);
  }
  return found_;
}

void Crossings::search(In u, const Sample& from, const Sample& to, int depth, Reversals& reversals) {
  const double h = to.theta - from.theta, bend = M_ * h * h;
  if (from.above != to.above ? std::abs(to.excess - from.excess) > bend / 2
                             : std::min(std::abs(from.excess), std::abs(to.excess)) > bend / 8)
    return pass(u, from, to);
  if (depth > 0) {
    const double theta = 0.5 * (from.theta + to.theta);
    const double excess = series_values(harmonics_, u, theta).x - level_;
    const Sample middle{theta, excess, excess > 0};
    search(u, from, middle, depth - 1, reversals);
    search(u, middle, to, depth - 1, reversals);
    return;
  }
  Sample begin = from;
  for (const Reversal& turn : reversals.within(u, from.theta, to.theta)) {
    const Sample end{turn.theta, turn.x - level_, turn.x > level_};
    pass(u, begin, end);
    begin = end;
  }
  pass(u, begin, to);
}

// Adds the crossing between two places where x is monotone between them, or has no crossing.
void Crossings::pass(In u, const Sample& from, const Sample& to) {
  if (from.above == to.above) return;
  const double secant = from.theta - from.excess * (to.theta - from.theta) / (to.excess - from.excess);
  const double theta = bracketed_root(
      harmonics_.order,
      [&](double t) {
        const Values v = series_values(harmonics_, u, t);
        return Slopes{v.x - level_, v.d1, v.d2};
      },
      from.theta, to.theta, secant, to.above, [](double) {});
  found_.push_back({theta, to.above});
}

}  // namespace arcslip::elements
