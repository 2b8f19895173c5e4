#pragma once
// Three scenes with each parameter over many decades: alone, in pairs, and all at random.

#include "volume.hpp"

#include <arcslip/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace parameter_ranges {

inline constexpr Volume pairs_of_each{"ARCSLIP_PAIRS", 20, 100000};  // the latter: all there are
inline constexpr Volume random_scenes{"ARCSLIP_RANGES", 2000, 100000};

/// oscillator: the paper's, N = 7, from 18 to 22 Hz. chain: two masses with a stop
/// (examples/unilateral_oscillator), N = 7. pad: a contact_2d (examples/rubbing_pad), N = 5.
enum class Family { oscillator, chain, pad };
inline constexpr Family families[] = {Family::oscillator, Family::chain, Family::pad};

const char* name(Family family);

/// At its own values, with one study: its frequency response.
arcslip::scene::Scene base(Family family);

struct Named {
  std::string name;  // "c.value = 1.34e-13, damper.normal_load = 0"
  arcslip::scene::Scene scene;
};

/// Each parameter alone, and each pair, at all factors of its own value: 1e-30, 1e-12, 1e-6, 1e-3 and their
/// inverses, 0 where that is allowed, and negative ones where the bounds of the field allow them; friction
/// coefficients up to 1000. The window of the frequency is one of the parameters, by factors from 1e-6 to
/// 1e6.
std::vector<Named> pairs(Family family);

/// What an element does where one parameter is at an end of its range, whatever the others are: "slip"
/// without friction, "stick" under a load that friction holds, "open" behind a gap that is never closed,
/// "closed" under a preload that is never lost.
struct Limit {
  Family family;
  std::string parameter;
  double value;
  std::string state;
};
std::vector<Limit> limits();

/// The scenes of a limit: each other parameter alone at its extremes.
std::vector<Named> scenes_of(const Limit& limit);

/// All parameters at random: each by a factor of 1e-4 to 1e4, evenly over the logarithm, one in twelve by
/// 1e-12 to 1e12, one in thirty 0, and where that is allowed one in two negative; half of the windows
/// from 0.3 to 3 times a natural frequency, the others anywhere from 1e-4 to 1e4 times the scene's; N from 1
/// to
/// 9. Families take turns.
Named random(std::uint64_t seed);

/// The scene in units that are smaller by these factors: lengths, masses and times are so much larger. By the
/// units of the fields.
arcslip::scene::Scene in_units(const arcslip::scene::Scene& scene, double length, double mass, double time);

}  // namespace parameter_ranges
