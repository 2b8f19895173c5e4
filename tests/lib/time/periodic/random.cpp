// Random structures with friction: exact periodic motions of all of them, and harmonic balance next to them.
// ARCSLIP_SCENES is how many of each kind of excitation; by default 40, or 1000 with ARCSLIP_FULL=1.
#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/time/equation/systems.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"
#include "lib/time/periodic/random_contacts.hpp"
#include "random.hpp"

#include <arcslip/stability/state_from_harmonics.hpp>

#include <cmath>
#include <cstdlib>

using namespace arcslip;
using random_contacts::with_contacts;
using random_contacts::with_stops;
using random_scenes::Excitation;

namespace {

constexpr Excitation kinds[] = {Excitation::first, Excitation::first_and_third, Excitation::first_and_second};

std::uint64_t scenes_of_each_kind() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return std::getenv("ARCSLIP_FULL") ? 1000 : 40;
}

double frequency(const scene::Scene& s, double part) {
  const auto& window = scenes::window(s);
  return window.from + part * (window.to - window.from);
}

// Forces within their limits, and sliders that move only at the limit: no event was missed.
void check_contact(const time::EquationOfMotion& equation, const time::TimeHistory& history) {
  for (std::size_t e = 0; e < equation.elements.size(); ++e) {
    const double limit = systems::limit_of(equation.elements[e]), rounding = 1e-13 * limit;
    const std::vector<double>&force = history.elements[e].force, &slider = history.elements[e].slider;
    double worst = 0, moved_in_stick = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      worst = std::max(worst, std::abs(force[i]));
      if (i == 0) continue;
      const double moved = slider[i] - slider[i - 1];
      const double nearest = std::max(std::abs(force[i]), std::abs(force[i - 1]));
      // A slip wholly between two instants is the only other way to move.
      if (nearest < 0.9 * limit) moved_in_stick = std::max(moved_in_stick, std::abs(moved));
      if (std::abs(force[i]) >= limit - rounding && std::abs(force[i - 1]) >= limit - rounding &&
          force[i] * force[i - 1] > 0)
        CHECK(moved * force[i] >= -1e-13 * limit * limit / equation.elements[e].fields[0]);
    }
    CHECK(worst <= limit + rounding);
    CHECK(moved_in_stick == 0);
  }
}

}  // namespace

TEST_CASE("every random structure has a stable periodic motion, found from rest, whose energies balance") {
  for (std::uint64_t seed = 0; seed < scenes_of_each_kind(); ++seed)
    for (const Excitation kind : kinds)
      for (const double part : {0.2, 0.4, 0.6, 0.8}) {
        const auto s = random_scenes::make(seed, kind);
        CAPTURE(seed, static_cast<int>(kind), part);
        const auto model = model::build(s);
        continuation::Vector p(static_cast<Eigen::Index>(model.parameters.size()));
        for (Eigen::Index k = 0; k < p.size(); ++k)
          p[k] = model.parameters[static_cast<std::size_t>(k)].value;
        p[model::frequency] = frequency(s, part) * scene::to_rad_per_s(s.frequency_unit);
        const auto equation = time::equation_of_motion(model, p);
        time::EventDriven integrator(equation);
        const auto motion = time::periodic_motion(integrator, time::at_rest(equation), {},
                                                  compared_with_exact::over_period(equation, 2000));
        REQUIRE(motion.converged());
        CHECK(motion.shooting.stable);
        CHECK(motion.shooting.maps < 100);
        const auto& energy = motion.period.energy;
        CHECK(std::abs(energy.defect()) < 1e-12 * energy.input);
        CHECK(std::abs(energy.stored) < 1e-9 * energy.input);
        check_contact(equation, motion.period.history);
      }
}

TEST_CASE("harmonic balance of random structures converges to the exact motion at least like N^-3") {
  double logarithms = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < scenes_of_each_kind() / 2; ++seed)
    for (const Excitation kind : kinds)
      for (const double part : {0.3, 0.7}) {
        auto s = random_scenes::make(seed, kind);
        CAPTURE(seed, static_cast<int>(kind), part);
        s.harmonics.order = 41;
        const double coarse =
            compared_with_exact::difference(compared_with_exact::balanced(s, frequency(s, part)), 500)
                .displacement;
        s.harmonics.order = 81;
        const double fine =
            compared_with_exact::difference(compared_with_exact::balanced(s, frequency(s, part)), 500)
                .displacement;
        CHECK(coarse < 1e-4);
        CHECK(fine < 1e-5);
        if (coarse < 1e-10) continue;  // stuck: no truncation
        logarithms += std::log(coarse / fine);
        ++count;
      }
  // Single scenes scatter, since errors change their sign with N; above resonances they fall faster, like
  // 1/(n^2 - a).
  const double ratio = std::exp(logarithms / count), third_power = std::pow(81.0 / 41, 3);
  CAPTURE(ratio, count);
  CHECK(count > 50);
  CHECK(ratio > third_power);
}

// The errors of harmonic balance fall like N^-3; a third of the motions goes through a mode of this name.
void check_decay(scene::Scene (*with)(scene::Scene, std::uint64_t, double), std::string_view mode) {
  double logarithms = 0;
  int count = 0, met = 0;
  for (std::uint64_t seed = 0; seed < scenes_of_each_kind(); ++seed)
    for (const Excitation kind : kinds) {
      auto s = random_scenes::make(seed, kind);
      const double at = frequency(s, 0.3 + 0.4 * static_cast<double>(seed % 2));
      s = with(s, seed, at);
      CAPTURE(seed, static_cast<int>(kind));
      s.harmonics.order = 41;
      const auto narrow = compared_with_exact::balanced(s, at);
      const auto nearby = compared_with_exact::difference(narrow, 500);
      s.harmonics.order = 81;
      const auto wide = compared_with_exact::balanced(s, at);
      const double fine = compared_with_exact::difference(wide, 500).displacement;
      CHECK(nearby.displacement < 1e-3);
      CHECK(fine < 2e-4);
      met += std::any_of(nearby.exact.period.events.begin(), nearby.exact.period.events.end(),
                         [&](const auto& event) { return event.to == mode; });
      if (nearby.displacement < 1e-9) continue;
      logarithms += std::log(nearby.displacement / fine);
      ++count;
    }
  const double ratio = std::exp(logarithms / count), third_power = std::pow(81.0 / 41, 3);
  CAPTURE(ratio, count, met);
  CHECK(met > count / 3);
  CHECK(ratio > 0.8 * third_power);
}

TEST_CASE("random structures with friction and stops come to the exact motion at least like N^-3") {
  check_decay(with_stops, "closed");
}

TEST_CASE("random structures with contacts that slip and open come to the exact motion at least like N^-3") {
  check_decay(with_contacts, "open");
}
