#include <arcslip/optimize/release.hpp>

#include <arcslip/hbm/slip_corner.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

constexpr double no_influence = 1e-12;  // of d ln A / d ln p
constexpr double as_high = 1e-6;        // relative: a peak nearer to the highest is one of them

bool moves_highest(const PeakState& state, std::size_t k) {
  return std::any_of(state.peaks.begin(), state.peaks.end(), [&](const Peak& peak) {
    return peak.amplitude >= (1 - as_high) * state.amplitude() &&
           std::abs(peak.gradient[static_cast<Eigen::Index>(k)] * state.design[k]) >
               no_influence * peak.amplitude;
  });
}

// k_d X over mu F_n, the most among the elements that stick at a peak and whose limit parameter k is.
double closest_to_slip(PeakAmplitude& peaks, const observables::ResponsePoint& point, int parameter) {
  double most = 0;
  const Vector p = peaks.parameters(peaks.state().design);
  for (std::size_t e = 0; e < point.elements.size(); ++e) {
    const auto& fields = peaks.problem()->model().elements[e].parameters;
    const auto& element = point.elements[e];
    if (!element.has_stick || (fields[1] != parameter && fields[2] != parameter)) continue;
    if (element.slip_angles.empty() && element.fundamental.in_phase > 0)
      most = std::max(
          most, element.fundamental.in_phase / hbm::slip_limit(*peaks.problem(), static_cast<int>(e), p));
  }
  return most;
}

}  // namespace

std::optional<std::vector<double>> released(const Cases& cases, std::span<const int> over,
                                            std::span<const double> lower, double share) {
  std::optional<std::vector<double>> design;
  for (std::size_t k = 0; k < over.size(); ++k) {
    bool moves = false;
    double most = 0;
    for (std::size_t g = 0; g < cases.groups() && !moves; ++g) {
      PeakAmplitude& peaks = cases.peaks(cases.highest_of(g));
      const PeakState& state = peaks.state();
      moves = moves_highest(state, k);
      if (!moves)
        most = std::max(most, closest_to_slip(peaks, peaks.observe(state.peaks[state.highest]), over[k]));
    }
    if (moves || most == 0) continue;
    const std::vector<double>& at = cases.state(0).design;
    const double value = std::max(lower[k], share * most * at[k]);
    if (!(value < at[k])) continue;
    if (!design) design = at;
    (*design)[k] = value;
  }
  return design;
}

}  // namespace arcslip::optimize
