// examples/bladed_ring: a tuned ring moves as one wave, whose amplitude with one harmonic is a closed form.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/scene/combinations.hpp>

#include <cmath>
#include <complex>
#include <numbers>

using namespace arcslip;
using std::numbers::pi;

namespace {

constexpr double mass = 0.5, coupling = 20000, contact = 30000, force = 2, coefficient = 0.4, zeta = 0.001;
const double stiffness = mass * std::pow(2 * pi * 150, 2);
// Of neighbours, with a lag of 2 pi 3/12 between them.
const double half_lag = pi * 3 / 12;

// Force over displacement of a slider with the given limit, at an amplitude a: both of one harmonic. Within a
// period it dissipates 4 limit (a - limit/contact).
std::complex<double> slider(double a, double limit) {
  if (contact * a <= limit) return contact;
  const double angle = std::acos(1 - 2 * limit / (contact * a));
  return {contact / pi * (angle - std::sin(angle) * std::cos(angle)),
          4 * limit / (pi * a) * (1 - limit / (contact * a))};
}

// The force that a wave of amplitude a takes: each blade has neighbours on both sides.
double force_of(double a, double w, double load) {
  const double stretch = 2 * std::sin(half_lag);
  const std::complex<double> between = coupling + slider(stretch * a, coefficient * load);
  const double damping = 2 * zeta * std::sqrt(stiffness * mass);
  return a * std::abs(stiffness - mass * w * w + std::complex<double>(0, w * damping) +
                      stretch * stretch * between);
}

}  // namespace

TEST_CASE("the ring of blades moves as a wave with the amplitude of the describing function") {
  scene::Scene s = scenes::example("bladed_ring");
  s.harmonics.order = 1;
  const auto range = scenes::window(s);
  for (const double load : {2.0, 15.0, 60.0}) {
    CAPTURE(load);
    scene::set(s, "load", load);
    const auto branches = observables::frequency_response(s, range);
    REQUIRE(branches.size() == 1);
    const auto& branch = branches[0];
    REQUIRE(branch.status == observables::Status::complete);
    REQUIRE(branch.points.size() > 20);
    for (const auto& point : branch.points) {
      CHECK(std::abs(force_of(point.amplitude, point.omega, load) / force - 1) < 1e-11);
      REQUIRE(point.responses.size() == 12);
      for (std::size_t i = 0; i < 12; ++i) {
        CHECK(std::abs(point.responses[i].amplitude / point.amplitude - 1) < 1e-11);
        const double lag = point.responses[i].phase - point.phase - 2 * half_lag * static_cast<double>(i);
        CHECK(std::abs(std::remainder(lag, 2 * pi)) < 1e-11);
      }
    }
  }
}

// The truncation of friction with a stiffness is of third order in 1/N.
TEST_CASE("the ring of blades comes to its exact motion in time with the third power of the order") {
  scene::Scene s = scenes::example("bladed_ring");
  scene::set(s, "load", 5);
  const observables::Motion exact = observables::motion_in_time(s, {161});
  REQUIRE(exact.status == observables::Status::complete);
  for (const int order : {1, 3, 5, 9, 17, 33}) {
    s.harmonics.order = order;
    const auto found = observables::point_responses(s, {.frequency = 161});
    REQUIRE(found.size() == 1);
    const double error = std::abs(found[0].point.amplitude / exact.amplitude - 1);
    CAPTURE(order, error);
    CHECK(error < 5e-3 / std::pow(order, 3));
  }
}

TEST_CASE("a mistuned ring of blades has other amplitudes, and its samples are the rows of the scene") {
  scene::Scene s = scenes::example("bladed_ring");
  const scene::Combinations samples(s.studies[2]);
  REQUIRE(samples.size() == 2);
  for (std::size_t k = 0; k < 3; ++k) {
    scene::Scene sample = s;
    const bool tuned = k == 2;
    if (!tuned)
      for (const auto& [name, value] : samples[k]) scene::set(sample, name, value);
    const auto found = observables::point_responses(sample, {.frequency = 158});
    REQUIRE(found.size() == 1);
    double least = 1, most = 0;
    for (const auto& blade : found[0].point.responses) {
      least = std::min(least, blade.amplitude);
      most = std::max(most, blade.amplitude);
    }
    CHECK((most / least > 1.2) != tuned);
    CHECK((most / least < 1 + 1e-9) == tuned);
  }
}
