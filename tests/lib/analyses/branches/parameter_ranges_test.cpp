// Each parameter of three scenes over its whole range: alone, in pairs and all at random. Every point that is
// returned, of random scenes each eighth, is held against equations in extended precision. ARCSLIP_RANGES is
// how many random scenes and ARCSLIP_PAIRS how many pairs of each of the three; ARCSLIP_FIRST_RANGE is the
// seed of the first scene.

#include "catch.hpp"

#include "lib/analyses/branches/parameter_ranges.hpp"
#include "lib/analyses/branches/returned_points.hpp"
#include "random.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace arcslip;
using returned_points::Tally;

namespace {

constexpr std::size_t checked =
    8;  // of a random scene each so many-th point, from one that the seed chooses on

constexpr double lengths[] = {0x1p-30, 0x1p9, 0x1p40}, masses[] = {0x1p-7, 0x1p20}, times[] = {0x1p-9, 0x1p5};

std::string reported(const Tally& tally) {
  std::ostringstream text;
  text << tally.scenes << " scenes, " << tally.branches << " branches, " << tally.points
       << " points: " << tally.flagged << " flagged, " << tally.linear << " in one state, " << tally.rounded
       << " rounded, " << tally.preloaded << " preloaded; without a first response " << tally.drifting
       << " that drift and " << tally.pushed << " with a negative or no spring, and " << tally.held
       << " others; " << tally.seconds << " s.";
  for (const auto& [reason, count] : tally.reasons)
    text << "\n  " << reason << ": " << count << ", as " << tally.first_messages.at(reason);
  text << "\n  worst: residual " << tally.worst.residual << ", distance " << tally.worst.distance
       << ", energy " << tally.worst.energy << ", amplitude " << tally.worst.amplitude << ", closed form "
       << tally.worst.linear;
  return text.str();
}

void require_no_faults(const Tally& tally) {
  WARN(reported(tally));
  for (std::size_t i = 0; i < std::min<std::size_t>(tally.faults.size(), 20); ++i)
    UNSCOPED_INFO(tally.faults[i]);
  CHECK(tally.faults.size() == 0);
}

std::uint64_t first_seed() {
  return Volume{"ARCSLIP_FIRST_RANGE", 0, 0}.count();
}

// Some of a list, spread evenly over it.
std::vector<parameter_ranges::Named> some(const std::vector<parameter_ranges::Named>& all,
                                          std::uint64_t count) {
  if (count >= all.size()) return all;
  std::vector<parameter_ranges::Named> chosen;
  for (std::uint64_t i = 0; i < count; ++i) chosen.push_back(all[i * all.size() / count]);
  return chosen;
}

}  // namespace

TEST_CASE("pairs of extremes: every point is on the branch in extended precision, or is said not to be") {
  for (const auto family : parameter_ranges::families) {
    Tally tally;
    for (const auto& each : some(parameter_ranges::pairs(family), parameter_ranges::pairs_of_each.count()))
      returned_points::check(each.name, each.scene, tally);
    require_no_faults(tally);
  }
}

TEST_CASE("all parameters at random: points are on the branch in extended precision, or are said not to be") {
  Tally tally;
  const std::uint64_t first = first_seed();
  for (std::uint64_t i = 0; i < parameter_ranges::random_scenes.count(); ++i) {
    const std::uint64_t seed = first + i;
    const auto each = parameter_ranges::random(seed);
    returned_points::check(
        each.name, each.scene, tally,
        {.first = seed / std::size(parameter_ranges::families) % checked, .every = checked});
  }
  require_no_faults(tally);
}

TEST_CASE("at the limits of friction, gaps and preloads every point has the linear response in closed form") {
  for (const auto& limit : parameter_ranges::limits()) {
    CAPTURE(limit.parameter, limit.value);
    Tally tally;
    for (const auto& each : parameter_ranges::scenes_of(limit))
      returned_points::check(each.name, each.scene, tally);
    require_no_faults(tally);
    CHECK(tally.points > 1000);
    CHECK(tally.states[limit.state] == tally.points);
  }
}

TEST_CASE("in units of length, mass and time that are powers of two all parameters give the same bits") {
  const std::uint64_t first = first_seed(), count = parameter_ranges::random_scenes.count() / 10;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const auto each = parameter_ranges::random(seed);
    test_random::Random random(seed);
    const double length = random.of(lengths), mass = random.of(masses), time = random.of(times);
    const auto scaled = parameter_ranges::in_units(each.scene, length, mass, time);
    CAPTURE(each.name, length, mass, time);
    CHECK(returned_points::differ_in_bits(each.scene, scaled, length, time) == "");
  }
}

TEST_CASE("in any units the first response is the same to 1e-12 times its condition") {
  const std::uint64_t first = first_seed(), count = parameter_ranges::random_scenes.count() / 10;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const auto each = parameter_ranges::random(seed);
    test_random::Random random(seed);
    const double length = random.logarithmic(1e-6, 1e6), mass = random.logarithmic(1e-6, 1e6),
                 time = random.logarithmic(1e-3, 1e3);
    const auto scaled = parameter_ranges::in_units(each.scene, length, mass, time);
    CAPTURE(each.name, length, mass, time);
    CHECK(returned_points::change_of_first(each.scene, scaled, length) <= 1);
  }
}
