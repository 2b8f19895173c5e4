#pragma once
// What is looked up in branches and in curves of peaks.

#include <arcslip/results/response.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace observables_test {

using arcslip::observables::ResponseBranch;
using arcslip::observables::ResponseEvent;
using arcslip::observables::ResponsePoint;

inline std::vector<ResponseEvent> events(const ResponseBranch& branch, const std::string& kind) {
  std::vector<ResponseEvent> found;
  for (const ResponseEvent& event : branch.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

/// How many curves have this peak, by the chords between their points.
inline int curves_with(const std::vector<ResponseBranch>& curves, const ResponsePoint& peak, double over) {
  int found = 0;
  for (const ResponseBranch& curve : curves)
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const ResponsePoint &a = curve.points[i - 1], &b = curve.points[i];
      if ((a.over - over) * (b.over - over) > 0 || a.over == b.over) continue;
      const double share = (over - a.over) / (b.over - a.over);
      const double omega = std::lerp(a.omega, b.omega, share),
                   amplitude = std::lerp(a.amplitude, b.amplitude, share);
      found += std::abs(peak.omega - omega) <= 0.5 * std::abs(a.omega - b.omega) + 1e-4 * omega &&
               std::abs(peak.amplitude - amplitude) <=
                   0.5 * std::abs(a.amplitude - b.amplitude) + 1e-3 * amplitude;
    }
  return found;
}

}  // namespace observables_test
