#pragma once
// Changes of a scene that leave its responses what they were, but for units and names: the same peaks and
// folds are then to be found. For tests over random scenes (lib/hbm/random_scenes.hpp).

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace invariances {

/// A scene that is another one in other words.
struct Variant {
  std::string name;
  arcslip::scene::Scene scene;  // with its first study, an frf
  double amplitude = 1;         // of the variant's, over that of the first scene
  double frequency = 1;         // the same
  bool backwards = false;       // traced from the upper end of the window to the lower one
  bool powers_of_two = false;   // all factors are: the same bits, but for their exponents
};

/// Forces and friction limits (and cubic springs) for displacements `factor` times as large.
Variant larger(const arcslip::scene::Scene& scene, double factor);

/// Masses, springs, dampers, elements and forces `factor` times as large: the same motion.
Variant heavier(const arcslip::scene::Scene& scene, double factor);

/// Masses and viscous dampers for motions `factor` times as fast.
Variant faster(const arcslip::scene::Scene& scene, double factor);

/// From the upper end of the window to the lower one.
Variant backwards(const arcslip::scene::Scene& scene);

/// Degrees of freedom, parts and terms in another order, with other names; some directions with both signs
/// changed.
Variant reordered(const arcslip::scene::Scene& scene, std::uint64_t seed);

/// A friction element as two in parallel, with half of the stiffness and half of the load each.
Variant split(const arcslip::scene::Scene& scene, std::size_t element);

/// All of these, with factors that are powers of two, powers of ten and neither.
std::vector<Variant> all(const arcslip::scene::Scene& scene, std::uint64_t seed);

/// An event of a frequency response, in the units of the first scene.
struct Seen {
  std::string kind;
  bool nonsmooth, located;
  double omega, amplitude;
};

struct Response {
  std::vector<Seen> events;  // by frequency, along the branch
  std::vector<Seen> points;  // the same of the points
  arcslip::continuation::BranchStop stop;
};

Response response(const Variant& variant);

/// The scene as it is.
Response response(const arcslip::scene::Scene& scene);

/// The same in steps a tenth as long, along a curve that is 1000 times as accurate.
Response in_short_steps(const arcslip::scene::Scene& scene);

/// What differs between the events of two responses, in words; "" where they have the same ones, each located
/// to `tolerance`, relative, in frequency and amplitude.
std::string difference(const Response& one, const Response& other, double tolerance);

}  // namespace invariances
