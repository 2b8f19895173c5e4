// Random structures at volume: chains of 1 to 6 masses with friction, some with cubic springs, some with
// sampled friction, excited in one or several harmonics. ARCSLIP_STRUCTURES is how many; by default 12, or
// 2000 with ARCSLIP_FULL=1; ARCSLIP_FIRST_STRUCTURE is the seed of the first one.

#include "catch.hpp"

#include "lib/analyses/branches/invariances.hpp"
#include "lib/analyses/branches/structures.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "random.hpp"

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using random_scenes::Excitation;
using test_random::Random;

namespace {

constexpr double tolerance = 1e-9;  // relative, of the frequency and the amplitude of an event

void add_cubic_spring(scene::Scene& s, Random& random) {
  const int at = random.count(0, static_cast<int>(s.dofs.size()) - 1);
  double stiffness = 0, force = 0, damping = 0;
  for (const auto& spring : s.springs) stiffness = std::max(stiffness, spring.values[0]);
  for (const auto& part : s.excitation) force = std::max(force, std::hypot(part.values[0], part.values[1]));
  for (const auto& damper : s.dampers) damping = std::max(damping, damper.values[0]);
  // Hardening by a part of the spring at ten static deflections: some bend over and have folds, most do not.
  const double deflection = 10 * force / stiffness;
  s.elements.push_back({"h",
                        &elements::cubic_spring(),
                        {{{at, 1.0}}},
                        {stiffness / (deflection * deflection) * random.logarithmic(1e-4, 0.1)}});
}

scene::Scene structure(std::uint64_t seed) {
  Random random(seed);
  constexpr Excitation kinds[] = {Excitation::first, Excitation::first_and_third,
                                  Excitation::first_and_second};
  scene::Scene s = random.one_in(2) ? random_scenes::hard(seed) : random_scenes::make(seed, random.of(kinds));
  s.harmonics.order = std::min(s.harmonics.order, 9);
  if (random.one_in(3)) add_cubic_spring(s, random);
  if (random.one_in(5)) {
    s.harmonics.friction = scene::Friction::sampled;
    s.harmonics.samples = 256;
  }
  scene::check(s);
  return s;
}

bool is_sampled(const scene::Scene& s) {
  return s.harmonics.friction == scene::Friction::sampled;
}

bool has_cubic_spring(const scene::Scene& s) {
  return std::any_of(s.elements.begin(), s.elements.end(),
                     [](const auto& element) { return element.type == &elements::cubic_spring(); });
}

std::vector<invariances::Variant> variants(const scene::Scene& s, std::uint64_t seed) {
  Random random(seed);
  std::vector<invariances::Variant> all;
  all.push_back(invariances::larger(s, random.logarithmic(1e-6, 1e6)));
  all.push_back(invariances::heavier(s, random.logarithmic(1e-6, 1e6)));
  all.push_back(invariances::faster(s, random.logarithmic(1e-3, 1e3)));
  all.push_back(invariances::backwards(s));
  all.push_back(invariances::reordered(s, seed));
  std::vector<std::size_t> friction;
  for (std::size_t e = 0; e < s.elements.size(); ++e)
    if (s.elements[e].type == &elements::jenkins()) friction.push_back(e);
  all.push_back(invariances::split(s, random.of(friction)));
  return all;
}

/// What the forces put in is what friction and dampers take out, at every point.
void check_energies(const observables::ResponseBranch& branch) {
  double worst = 0, at = 0;
  for (const auto& point : branch.points) {
    const double defect = std::abs(point.energy_input - point.energy_total()) / point.energy_total();
    if (!point.unbounded && !(defect <= worst)) worst = defect, at = point.omega;
  }
  CAPTURE(at);
  CHECK(worst < 1e-8);
}

/// Next to cubic springs there may be several responses at an end of the window: whether both traces began
/// with the same one, or, backwards, ended where the other one began.
bool same_ends(const invariances::Response& one, const invariances::Response& other, bool backwards) {
  const auto same = [](const auto& a, const auto& b) {
    return std::abs(a.amplitude / b.amplitude - 1) < 1e-6;
  };
  return one.points.size() > 1 && other.points.size() > 1 && same(one.points.front(), other.points.front()) &&
         (!backwards || same(one.points.back(), other.points.back()));
}

/// Where the response from which a branch begins turns back at a fold and leaves the window at its lower end,
/// others above it are on another branch. Only cubic springs bend it over. In a window that begins lower it
/// is the same one, and goes on below.
bool turns_back(const scene::Scene& s, const observables::ResponseBranch& branch) {
  if (!has_cubic_spring(s) || branch.stop.reason != observables::reasons::boundary ||
      branch.points.size() < 3)
    return false;
  const auto& window = scenes::window(s);
  const double unit = scene::to_rad_per_s(s.frequency_unit), from = window.from * unit;
  if (branch.points.back().omega != from) return false;
  int folds = 0, same_folds = 0;
  bool goes_on = false;
  for (const auto& event : branch.events) folds += event.kind == "fold";
  const auto beyond = [&](observables::Observer&, const continuation::Accepted& now,
                          const continuation::Event* event) {
    for (const auto& each : branch.events)
      same_folds += event && event->monitor == "fold" && each.kind == "fold" &&
                    std::abs(now.parameter / each.point.omega - 1) < tolerance;
    goes_on = now.parameter < from;
    return !goes_on;
  };
  observables::frequency_branch(std::make_shared<const model::Model>(model::build(s)),
                                {0.9 * from, window.to * unit}, from, beyond);
  return folds % 2 == 1 && same_folds == folds && goes_on;
}

void check_variants(const scene::Scene& s, std::uint64_t seed) {
  CAPTURE(seed, s.elements.size());
  const auto as_it_is = invariances::response(s);
  for (const auto& variant : variants(s, seed)) {
    CAPTURE(variant.name);
    const auto response = invariances::response(variant);
    if (has_cubic_spring(s) && !same_ends(as_it_is, response, variant.backwards)) continue;
    CHECK(invariances::difference(as_it_is, response, tolerance) == "");
  }
}

}  // namespace

TEST_CASE("random structures have the same events in all units, names, orders and directions") {
  const structures::Seeds seeds = structures::seeds();
  for (std::uint64_t seed = seeds.first; seed < seeds.end; ++seed)
    if (const scene::Scene s = structure(seed); !is_sampled(s)) check_variants(s, seed);
}

// A corner beyond which a piece ends at once; peaks just beyond where another reversal becomes the highest;
// resonances, and pairs of kinks, that are narrower than a step.
TEST_CASE("random structures have the same events in steps a tenth as long") {
  const structures::Seeds seeds = structures::seeds();
  for (std::uint64_t seed = seeds.first; seed < seeds.end; ++seed) {
    const scene::Scene s = structure(seed);
    if (is_sampled(s)) continue;
    CAPTURE(seed, s.elements.size());
    CHECK(invariances::difference(invariances::in_short_steps(s), invariances::response(s), tolerance) == "");
  }
}

TEST_CASE("the hardest of the random structures have the same events in all units, names and orders") {
  for (const std::uint64_t seed : {77, 127, 378, 464, 489, 641, 673, 771, 942, 945, 1008})
    check_variants(structure(seed), seed);
}

// Sampled friction has a kink at every change of a sample, and small peaks between them that a step passes or
// not. At a frequency it is as good as any.
TEST_CASE("random structures with sampled friction have the same responses in all units, names and orders") {
  const structures::Seeds seeds = structures::seeds();
  for (std::uint64_t seed = seeds.first; seed < seeds.end; ++seed) {
    const scene::Scene s = structure(seed);
    if (!is_sampled(s)) continue;
    const auto& window = scenes::window(s);
    const auto all = variants(s, seed);
    for (const double part : {0.2, 0.5, 0.8}) {
      const double frequency = window.from + part * (window.to - window.from);
      const double amplitude = scenes::response_at(s, frequency).amplitude;
      for (const auto& variant : all) {
        CAPTURE(seed, frequency, amplitude, variant.name);
        const double other = scenes::response_at(variant.scene, frequency * variant.frequency).amplitude;
        CHECK(std::abs(other / (amplitude * variant.amplitude) - 1) < tolerance);
      }
    }
  }
}

TEST_CASE("responses of random structures reach the end of their windows, with balanced energies") {
  const structures::Seeds seeds = structures::seeds();
  for (std::uint64_t seed = seeds.first; seed < seeds.end; ++seed) {
    const scene::Scene s = structure(seed);
    CAPTURE(seed, s.elements.size(), is_sampled(s));
    for (const auto& branch : observables::frequency_response(s, scenes::window(s))) {
      CAPTURE(branch.stop.message);
      CHECK((branch.status == observables::Status::complete || turns_back(s, branch)));
      check_energies(branch);
    }
  }
}

TEST_CASE("harmonic balance of random structures is their motion in time") {
  double worst = 0;
  long compared = 0;
  const structures::Seeds seeds = structures::seeds();
  for (std::uint64_t seed = seeds.first; seed < seeds.end; seed += structures::near_time) {
    scene::Scene s = structure(seed);
    Random random(seed);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    const auto is_fold = [](const auto& event) { return event.kind == "fold"; };
    if (branches.size() != 1 || std::any_of(branches[0].events.begin(), branches[0].events.end(), is_fold))
      continue;
    const auto& window = scenes::window(s);
    const double frequency = window.from + random.between(0.1, 0.9) * (window.to - window.from);
    CAPTURE(seed, frequency, is_sampled(s));
    s.harmonics.order = 41;
    s.harmonics.samples = 4096;
    const auto balance = scenes::response_at(s, frequency);
    if (balance.truncation_flagged) continue;
    const auto motion = observables::motion_in_time(s, {.frequency = frequency, .steps = 4000});
    CAPTURE(motion.stop.message, motion.integrator);
    CHECK(motion.status == observables::Status::complete);
    if (motion.stable && !*motion.stable) continue;
    const double difference = std::abs(motion.amplitude / balance.amplitude - 1);
    worst = std::max(worst, difference);
    ++compared;
    CAPTURE(balance.amplitude, motion.amplitude, balance.truncation_estimate);
    CHECK(difference < 1e-3);
  }
  CAPTURE(worst, compared);
  CHECK((compared > 0 || structures::number.count() < 12));
}
