// The truncation estimate against the error that a much higher order reports, on random hardening structures.

#include "catch.hpp"

#include "lib/analyses/branches/same_event.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/observables/in_more_harmonics.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

using namespace arcslip;

namespace {

constexpr double error_floor = 1e-8;  // of amplitudes: errors below are not looked at

}  // namespace

TEST_CASE(
    "truncation estimates of random hardening structures that are not flagged hold at events and between") {
  // None is above the amplitude, and places are estimated as well. At events none is below a quarter of the
  // error, at other points one in 500 below half of it.
  const std::uint64_t seeds = std::getenv("ARCSLIP_FULL") ? 400 : 40;
  long events = 0, flagged = 0, corners = 0;
  in_more_harmonics::Compared between;
  std::vector<double> places;  // estimate over error
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    scene::Scene s = random_scenes::make_hardening(seed);
    const auto branch = same_event::response(s);
    const elements::Harmonics kept = model::build(s).harmonics;
    s.harmonics.order = 3 * s.harmonics.order + 12;
    const auto higher = same_event::response(s);
    for (const auto& point : branch.points)
      if (!point.truncation_flagged) CHECK(point.truncation_estimate <= 0.1 * point.amplitude * (1 + 1e-9));
    for (const auto& event : branch.events) {
      CAPTURE(event.kind, event.nonsmooth, event.point.omega, event.point.truncation_estimate);
      ++events;
      if (event.point.truncation_flagged) ++flagged;
      if (event.point.truncation_flagged) continue;
      CHECK(event.point.truncation_estimate < event.point.amplitude);
      const auto* exact = same_event::find(event, higher);
      if (!exact) continue;
      const double error = std::abs(event.point.amplitude - exact->amplitude);
      if (event.nonsmooth) ++corners;
      if (error > error_floor * exact->amplitude) CHECK(event.point.truncation_estimate > 0.25 * error);
      const double moved = std::abs(event.point.omega - exact->omega);
      if (!(moved > error_floor * exact->omega)) continue;
      REQUIRE(event.point.location_estimate > 0);
      places.push_back(event.point.location_estimate / moved);
    }
    in_more_harmonics::compare(std::make_shared<const model::Model>(model::build(s)), kept, branch, 15,
                               error_floor, between);
  }
  CHECK(3 * flagged < events);
  CAPTURE(between.points, between.above_twice);
  CHECK(500 * (between.above_twice - 1) <= between.points);  // one more by chance, where they are few
  CHECK(between.above_ten_times == 0);
  CHECK(corners > 0);
  // Of a place, which may change by the difference of several parts: one in 50 below 0.4 of the error.
  REQUIRE(places.size() > 50);
  std::sort(places.begin(), places.end());
  const auto quantile = [&](double share) {
    return places[static_cast<std::size_t>(share * static_cast<double>(places.size()))];
  };
  CHECK(quantile(0.02) > 0.4);
  CHECK(quantile(0.5) == Approx(1).epsilon(0.02));
  CHECK(quantile(0.95) < 3);
}
