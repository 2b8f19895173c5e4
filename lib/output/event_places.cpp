#include <arcslip/output/event_places.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace arcslip::output {
namespace {

using observables::ResponsePoint;
using Position = std::array<double, 5>;

/// What positions are measured in: the ranges of the parameter and omega, the largest amplitude.
struct Scales {
  double over, omega, amplitude;
};

/// Parameter, omega and amplitude in their scales, and the phase without its jump at 2 pi.
Position position(const ResponsePoint& point, const Scales& scales) {
  return {point.over / scales.over, point.omega / scales.omega, point.amplitude / scales.amplitude,
          std::cos(point.phase), std::sin(point.phase)};
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
  const auto range = [&](double ResponsePoint::*value) {
    const auto [least, most] =
        std::minmax_element(branch.points.begin(), branch.points.end(),
                            [&](const auto& a, const auto& b) { return a.*value < b.*value; });
    return least != branch.points.end() && (*most).*value > (*least).*value ? (*most).*value - (*least).*value
                                                                            : 1.0;
  };
  Scales scales{range(&ResponsePoint::over), range(&ResponsePoint::omega), 0};
  for (const ResponsePoint& point : branch.points) {
    scales.amplitude = std::max(scales.amplitude, point.unbounded ? 0.0 : point.amplitude);
  }
  scales.amplitude = scales.amplitude > 0 ? scales.amplitude : 1.0;
  std::vector<Position> positions;
  positions.reserve(branch.points.size());
  for (const ResponsePoint& point : branch.points) {
    positions.push_back(position(point, scales));
  }

  std::vector<std::size_t> before;
  before.reserve(branch.events.size());
  std::size_t first = std::min<std::size_t>(1, positions.size());
  for (const observables::ResponseEvent& event : branch.events) {
    const Position here = position(event.point, scales);
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
