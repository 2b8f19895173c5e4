#pragma once
// What a frequency response returns for any scene: whether every point of it is a solution, by equations in
// extended precision, and why it ended.

#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace returned_points {

/// The largest numbers that a scene may take, after which it is cut.
inline constexpr long most_points = 2000, most_steps = 20000;
inline constexpr double most_seconds = 20;  // of processor time

/// Errors over what is allowed for them; above 1 a fault.
struct Ratios {
  double residual = 0;  // of the library's residual, over rounding
  double distance = 0;  // of the point from the branch
  double energy = 0, amplitude = 0, linear = 0;
};

struct Tally {
  long scenes = 0, branches = 0, points = 0;
  long flagged = 0;    // points whose truncation is flagged
  long linear = 0;     // points where each element does one thing throughout
  long rounded = 0;    // points farther from the branch than the corrector's tolerance, by rounding
  long preloaded = 0;  // points whose mean force lost digits in a preload: not judged further
  // Without a first response: nothing holds the mean, a spring pushes or is missing, or stiffnesses are too
  // far apart.
  long drifting = 0, pushed = 0, held = 0;
  std::map<std::string, long> states;                 // points of each, where there is one state throughout
  std::map<std::string, long> reasons;                // ends of branches
  std::map<std::string, std::string> first_messages;  // of each reason: scene and message
  std::vector<std::string> faults;                    // "scene: what"
  Ratios worst;
  double seconds = 0;  // of processor time, without the checks
};

/// Points of a branch, next to its events, that are held against the equations: each `every`-th from `first`
/// on.
struct Some {
  std::size_t first = 0, every = 1;
};

/// Traces the scene in its window and adds to the tally.
void check(const std::string& name, const arcslip::scene::Scene& scene, Tally& tally,
           const Some& points = {});

/// Whether both scenes, of which the second is the first in units that are powers of two, give the same bits
/// but for exponents, in frequencies, amplitudes and truncation estimates; empty, or what differs first.
/// length, time: of the second over the first.
std::string differ_in_bits(const arcslip::scene::Scene& one, const arcslip::scene::Scene& other,
                           double length, double time);

/// The change of the amplitude at the first frequency from one scene to the same in other units, over 1e-12
/// times the condition of its equations. 0 where neither has a response. length: of the second over the
/// first.
double change_of_first(const arcslip::scene::Scene& one, const arcslip::scene::Scene& other, double length);

}  // namespace returned_points
