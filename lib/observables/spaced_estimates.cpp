#include <arcslip/observables/truncation.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::observables {
namespace {

constexpr int widest_spacing = 8, widest_flagged_spacing = 32;
constexpr double widest_step = 0.005, widest_flagged_step = 0.02;  // of the parameter, relative
constexpr double foreseen = 0.1, kept_up = 0.3;  // by the line, relative: the spacing doubles, remains
constexpr double alike = 1.5;                    // neighbours, one over the other

}  // namespace

void SpacedEstimates::restart() {
  last_ = {};
  slope_ = no_value;
  passed_.clear();
  spacing_ = 1;
}

bool SpacedEstimates::is_due(double arclength, double parameter) const {
  return !(arclength > last_.arclength) || static_cast<int>(passed_.size()) + 1 >= spacing_ ||
         !(std::abs(parameter - last_.parameter) <
           (last_.flagged ? widest_flagged_step : widest_step) * std::abs(parameter));
}

void SpacedEstimates::pass(double arclength, Solution& point) {
  passed_.push_back(arclength);
  point.truncation_estimate = last_.estimate;
  point.truncation_change = last_.change;
  point.truncation_flagged = last_.flagged || !point.stops.empty();
}

void SpacedEstimates::take(double arclength, double parameter, const Solution& point,
                           std::span<ResponsePoint> before) {
  if (!(arclength > last_.arclength)) restart();
  const Computed next{arclength, parameter, point.truncation_estimate, point.truncation_change,
                      point.truncation_flagged};
  fill(next, before);
  const double step = next.arclength - last_.arclength;
  const double error = std::abs(last_.estimate + slope_ * step - next.estimate);
  const bool both_flagged = next.flagged && last_.flagged;
  if (both_flagged)
    spacing_ = std::min(2 * spacing_, widest_flagged_spacing);
  else if (error <= foreseen * next.estimate && next.flagged == last_.flagged)
    spacing_ = std::min(2 * spacing_, widest_spacing);
  else if (next.flagged != last_.flagged || !(error <= kept_up * next.estimate))
    spacing_ = 1;
  slope_ = (next.estimate - last_.estimate) / step;
  last_ = next;
  passed_.clear();
}

void SpacedEstimates::fill(const Computed& next, std::span<ResponsePoint> before) const {
  if (before.size() < passed_.size()) return;
  const auto [least, most] = std::minmax(last_.estimate, next.estimate);
  const bool are_alike = most <= alike * least;
  auto point = before.end() - static_cast<std::ptrdiff_t>(passed_.size());
  for (const double arclength : passed_) {
    const double share = (arclength - last_.arclength) / (next.arclength - last_.arclength);
    point->truncation_estimate = are_alike ? std::lerp(last_.estimate, next.estimate, share) : most;
    point->truncation_change = std::lerp(last_.change, next.change, share);
    point->truncation_flagged = point->truncation_flagged || next.flagged || !are_alike;
    ++point;
  }
}

}  // namespace arcslip::observables
