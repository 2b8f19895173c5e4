#include <arcslip/fourier/series_maximum.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

constexpr double near_the_largest = 0.98;  // of the highest sample: extrema below it cannot be the largest
constexpr int extremum_newton_steps = 8;   // quadratic from a sample next to an extremum
constexpr double settled_extremum = 1e-8;  // rad: the value there is right to the square of it

}  // namespace

LargestValue::LargestValue(const Harmonics& h)
    : harmonics_(h), basis_((h.odd ? 1 : 2) * (4 * h.order + 16), h.size()), samples_(basis_.rows()) {
  step_ = h.span() / static_cast<double>(basis_.rows());
  Eigen::VectorXd phi(h.size());
  for (Eigen::Index k = 0; k < basis_.rows(); ++k) {
    series_basis(h, static_cast<double>(k) * step_, phi);
    basis_.row(k) = phi.transpose();
  }
}

double LargestValue::sample(Eigen::Index k) const {
  const Eigen::Index count = samples_.size();
  if (k >= 0 && k < count) return samples_[k];
  return (harmonics_.odd ? -1 : 1) * samples_[k < 0 ? k + count : k - count];
}

// |x| at the reversal next to theta.
double LargestValue::polished(In u, double theta) const {
  Values v = series_values(harmonics_, u, theta);
  double largest = std::abs(v.x);
  for (int i = 0; i < extremum_newton_steps && v.d2 != 0; ++i) {
    const double step = -v.d1 / v.d2;
    if (!(std::abs(step) < step_)) break;
    v = series_values(harmonics_, u, theta += step);
    largest = std::max(largest, std::abs(v.x));
    if (std::abs(step) < settled_extremum) break;
  }
  return largest;
}

double LargestValue::of(In u) {
  samples_.noalias() = basis_ * u;
  // The top next to sample k, from the parabola; 0 where there is none.
  const auto top = [&](Eigen::Index k, double& offset) {
    const double sign = samples_[k] < 0 ? -1 : 1;
    const double before = sign * sample(k - 1), at = sign * samples_[k], after = sign * sample(k + 1);
    if (before > at || after > at) return 0.0;
    const double bend = before - 2 * at + after;
    offset = bend < 0 ? 0.5 * (before - after) / bend : 0;
    return at - 0.25 * (before - after) * offset;
  };
  double highest = 0, offset = 0, largest = 0;
  for (Eigen::Index k = 0; k < samples_.size(); ++k) highest = std::max(highest, top(k, offset));
  for (Eigen::Index k = 0; k < samples_.size(); ++k)
    if (top(k, offset) >= near_the_largest * highest)
      largest = std::max(largest, polished(u, (static_cast<double>(k) + offset) * step_));
  return largest;
}

}  // namespace arcslip::elements
