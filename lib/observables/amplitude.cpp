#include <arcslip/observables/amplitude.hpp>

#include <cmath>

namespace arcslip::observables {

Extreme Amplitude::of(elements::In x) {
  Extreme extreme;
  if (!harmonics_.odd) extreme = {std::abs(x[0]), 0, x[0] < 0 ? -1.0 : 1.0};
  const auto& turns = reversals_.find(x);
  if (!turns.empty()) extreme.amplitude = -1;
  for (const auto& turn : turns)
    if (std::abs(turn.x) > extreme.amplitude)
      extreme = {std::abs(turn.x), turn.theta, turn.x < 0 ? -1.0 : 1.0};
  return extreme;
}

double amplitude_change(const elements::Harmonics& harmonics, const Extreme& extreme, elements::In dx) {
  return extreme.sign * elements::series_values(harmonics, dx, extreme.theta).x;
}

}  // namespace arcslip::observables
