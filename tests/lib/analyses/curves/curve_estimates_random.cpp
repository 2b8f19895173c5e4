// The estimates of events of curves of peaks against the errors that a much higher order reports, on random
// structures.

#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace arcslip;
using observables::ResponseEvent;
using observables::ResponsePoint;

namespace {

std::vector<ResponseEvent> events_over_load(scene::Scene s, int order) {
  s.harmonics.order = order;
  const auto& window = scenes::window(s);
  std::vector<ResponseEvent> events;
  for (const auto& curve :
       observables::resonance_peaks(s, {s.elements[0].name + ".normal_load", 0.1, 5, window.from, window.to}))
    events.insert(events.end(), curve.events.begin(), curve.events.end());
  return events;
}

/// The same event of another order: one in a thousandth that has no other within ten times that.
const ResponsePoint* find(const ResponseEvent& event, const std::vector<ResponseEvent>& others) {
  const auto distance = [&](const ResponseEvent& other) {
    return other.kind != event.kind ? HUGE_VAL
                                    : std::abs(other.point.over / event.point.over - 1) +
                                          std::abs(other.point.omega / event.point.omega - 1);
  };
  const auto within = [&](double most) {
    return std::count_if(others.begin(), others.end(),
                         [&](const ResponseEvent& other) { return distance(other) < most; });
  };
  if (within(1e-3) != 1 || within(1e-2) != 1) return nullptr;
  return &std::min_element(others.begin(), others.end(), [&](const auto& a, const auto& b) {
            return distance(a) < distance(b);
          })->point;
}

}  // namespace

TEST_CASE("estimates of extrema and turns of curves of peaks of random structures are their errors") {
  const std::uint64_t seeds = std::getenv("ARCSLIP_FULL") ? 150 : 12;
  long events = 0, known = 0, low = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    const scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first);
    const auto few = events_over_load(s, 7), many = events_over_load(s, 31);
    for (const ResponseEvent& event : few) {
      const ResponsePoint& at = event.point;
      CAPTURE(event.kind, at.over, at.omega);
      if (event.kind != "corner") ++events;
      if (std::isnan(at.parameter_estimate)) CHECK(std::isnan(at.location_estimate));
      if (std::isnan(at.parameter_estimate) || at.truncation_flagged) continue;
      ++known;
      const ResponsePoint* exact = find(event, many);
      if (!exact) continue;
      const double error = std::abs(exact->over - at.over);
      CAPTURE(error, at.parameter_estimate);
      if (!(error > 1e-7 * at.over)) continue;
      CHECK(at.parameter_estimate > 0.1 * error);
      low += at.parameter_estimate < 0.5 * error;
    }
  }
  CAPTURE(events, known, low);
  CHECK(2 * known > events);
  CHECK(30 * low <= known + 15);
}
