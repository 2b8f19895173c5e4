#include <arcslip/output/event_places.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace arcslip::output {
namespace {

using observables::ResponsePoint;
using Position = std::array<double, 4>;

/// Omega and amplitude as shares of their largest value, and the phase without its jump at 2 pi.
Position position(const ResponsePoint& point, double omega_scale, double amplitude_scale) {
  return {point.omega / omega_scale, point.amplitude / amplitude_scale, std::cos(point.phase),
          std::sin(point.phase)};
}

double distance(const Position& a, const Position& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return std::sqrt(sum);
}

}  // namespace

std::vector<std::size_t> points_before_events(const observables::ResponseBranch& branch) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = 0;
  double amplitude_scale = 0;
  for (const ResponsePoint& point : branch.points) {
    lowest = std::min(lowest, point.omega);
    highest = std::max(highest, point.omega);
    amplitude_scale = std::max(amplitude_scale, point.unbounded ? 0.0 : point.amplitude);
  }
  const double omega_scale = highest > lowest ? highest - lowest : 1.0;
  amplitude_scale = amplitude_scale > 0 ? amplitude_scale : 1.0;
  std::vector<Position> positions;
  positions.reserve(branch.points.size());
  for (const ResponsePoint& point : branch.points) {
    positions.push_back(position(point, omega_scale, amplitude_scale));
  }

  std::vector<std::size_t> before;
  before.reserve(branch.events.size());
  std::size_t first = std::min<std::size_t>(1, positions.size());
  for (const observables::ResponseEvent& event : branch.events) {
    const Position here = position(event.point, omega_scale, amplitude_scale);
    std::size_t best = std::max(first, positions.size());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < positions.size() && !event.point.unbounded; ++i) {
      const double detour = distance(positions[i - 1], here) + distance(here, positions[i]) -
                            distance(positions[i - 1], positions[i]);
      if (detour < least) {
        least = detour;
        best = i;
      }
    }
    before.push_back(best);
    first = best;
  }
  return before;
}

}  // namespace arcslip::output
