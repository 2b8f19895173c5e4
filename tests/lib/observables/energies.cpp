// What friction and dampers take out, and what the excitation puts in.

#include "catch.hpp"
#include "size.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

using namespace arcslip;
using observables::ResponsePoint;
using std::numbers::pi;

namespace {

// Largest |input - total| over total, of all points and events of a branch.
double imbalance(const observables::ResponseBranch& branch) {
  double worst = 0;
  const auto look = [&](const ResponsePoint& point) {
    if (point.unbounded) return;
    worst = std::max(worst, std::abs(point.energy_input - point.energy_total()) / point.energy_total());
  };
  for (const auto& point : branch.points) look(point);
  for (const auto& event : branch.events) look(event.point);
  return worst;
}

// The resonance peak of the paper's oscillator at one load.
ResponsePoint peak_at(double load, int order = 55) {
  scene::Scene s = scenes::paper(order, load);
  const auto branch = observables::frequency_response(s, scenes::window(s)).front();
  if (branch.events.size() != 1) throw std::runtime_error("not one peak");
  return branch.events.front().point;
}

}  // namespace

TEST_CASE("with one stick and one slip phase in half a period friction takes 4 mu Fn (A - mu Fn/kd)") {
  for (int order : {1, 3, 15, 55})
    for (double load : {0.5, 1.0, 2.0, 3.0})
      for (double hz : {19.5, 20.0, 20.5, 21.5}) {
        const auto point = scenes::response_at(scenes::paper(order, load), hz);
        if (point.elements[0].slip_angles.size() != 2) continue;
        CAPTURE(order, load, hz);
        const double p = 0.5 * load, area = 4 * p * (point.amplitude - p / 3500);
        CHECK(std::abs(point.energy_friction / area - 1) < 1e-13);
      }
}

TEST_CASE("friction energies are those of the closed-form motion") {
  for (const auto& exact : reference::exact("fixed_frequency")) {
    const double energy = exact["energy_friction"];
    const auto point =
        scenes::response_at(scenes::paper(201, exact["normal_load"]), exact["frequency_hz"].get<double>());
    CAPTURE(exact["normal_load"].get<double>(), exact["frequency_hz"].get<double>());
    CHECK(std::abs(point.energy_friction - energy) <= 2e-9 * energy);
  }
}

TEST_CASE("what the excitation puts in, friction and dampers take out, at every point of every scene") {
  std::vector<std::pair<std::string, scene::Scene>> all = {{"paper, 1", scenes::paper(1, 2)},
                                                           {"paper, 55", scenes::paper(55, 3)},
                                                           {"paper, next to stick", scenes::paper(15, 397)},
                                                           {"paper, next to slip", scenes::paper(15, 1e-3)},
                                                           {"three masses", scenes::chain(7, false)},
                                                           {"three masses, mean", scenes::chain(6, true)},
                                                           {"cubic spring", scenes::duffing_jenkins(5)}};
  scene::Scene low = scenes::paper(101, 0.1);
  scenes::window(low).from = 0.2;
  scenes::window(low).to = 2;
  if (!test_size::sanitized) all.emplace_back("low frequencies", low);
  scene::Scene forces = scenes::chain(5, false);  // two in one harmonic
  forces.excitation.push_back(forces.excitation.front());
  forces.excitation.back().name = "h";
  forces.excitation.back().directions = {{{0, 0.7}}};
  forces.excitation.back().values = {0.3, -0.5};
  all.emplace_back("two forces", forces);
  scene::Scene tied = scenes::chain(5, false);
  scenes::tie(tied, "friction", {"d1.normal_load", "d2.normal_load"});
  scene::set(tied, "friction", 0.6);
  all.emplace_back("tied loads", tied);
  scene::Scene sampled = scenes::paper(7, 3);
  sampled.harmonics.friction = scene::Friction::sampled;
  all.emplace_back("sampled friction", sampled);
  // Slip at every sample (5, 128 and 15, 512), at none but the extremes (10 N and more), and of a mean.
  for (const auto& [order, samples, load] :
       {std::tuple{2, 128, 0.1}, {5, 128, 0.01}, {15, 512, 0.01}, {15, 512, 10.0}, {15, 512, 300.0}}) {
    scene::Scene s = scenes::paper(order, load);
    s.harmonics.friction = scene::Friction::sampled;
    s.harmonics.samples = samples;
    all.emplace_back(std::to_string(samples) + " samples, " + std::to_string(load) + " N", s);
  }
  for (double load : {1e-3, 0.3}) {
    scene::Scene s = scenes::chain(6, true);
    s.harmonics.friction = scene::Friction::sampled;
    s.harmonics.samples = 64;
    scene::set(s, "d1.normal_load", load);
    scene::set(s, "d2.normal_load", load);
    all.emplace_back("sampled, with a mean, " + std::to_string(load) + " N", s);
  }
  for (const auto& [name, s] : all) {
    CAPTURE(name);
    for (const auto& branch : observables::frequency_response(s, scenes::window(s))) {
      CHECK(branch.points.size() > 10);
      CHECK(imbalance(branch) < 1e-10);
    }
  }
}

TEST_CASE("random structures: the energies balance within the tolerance of Newton's last correction, 1e-9") {
  for (const auto excitation : {random_scenes::Excitation::first, random_scenes::Excitation::first_and_third,
                                random_scenes::Excitation::first_and_second})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const scene::Scene s = random_scenes::make(seed, excitation);
      CAPTURE(seed);
      for (const auto& branch : observables::frequency_response(s, scenes::window(s)))
        CHECK(imbalance(branch) < 1e-9);
    }
}

TEST_CASE("friction takes more than 95 % at the peaks from 1.611 N to 18.31 N, and less beyond") {
  for (double load : {1.611, 1.7, 2.0, 3.0, 5.0, 10.0, 18.31}) {
    CAPTURE(load);
    CHECK(peak_at(load).friction_percent() > 95);
  }
  CHECK(peak_at(1.610).friction_percent() < 95);
  CHECK(peak_at(18.32).friction_percent() < 95);
  CHECK(std::abs(peak_at(1).friction_percent() - 63) < 0.5);
  CHECK(std::abs(peak_at(100).friction_percent() - 75) < 0.5);
}

TEST_CASE("there is no share of friction where nothing is dissipated") {
  scene::Scene s = scenes::paper(3, 10);
  scene::set(s, "c.value", 0);
  const auto point = scenes::response_at(s, 18.5);
  CHECK(point.energy_total() == 0);
  CHECK(std::isnan(point.friction_percent()));
}

namespace {

// The load at which the friction energy of the peak is extreme, between two that enclose it: golden section
// in the logarithm, then the parabola through three loads.
ResponsePoint extreme_energy(double lower, double upper, double sign) {
  const double golden = 0.5 * (3 - std::sqrt(5.0));
  const auto energy = [&](double x) { return sign * peak_at(std::exp(x)).energy_friction; };
  double a = std::log(lower), b = std::log(upper), c = a + golden * (b - a), d = b - golden * (b - a);
  double ec = energy(c), ed = energy(d);
  while (b - a > 1e-2)
    if (ec > ed)
      b = d, d = c, ed = ec, c = a + golden * (b - a), ec = energy(c);
    else
      a = c, c = d, ec = ed, d = b - golden * (b - a), ed = energy(d);
  const double m = 0.5 * (a + b), h = 2e-3;
  const double before = energy(m - h), at = energy(m), after = energy(m + h);
  const double x = m + 0.5 * h * (before - after) / (before - 2 * at + after);
  ResponsePoint found = peak_at(std::exp(x));
  found.over = std::exp(x);
  return found;
}

}  // namespace

TEST_CASE("over the load the friction energy of the peak has two maxima and a minimum between them") {
  const auto extrema = reference::exact("energy_extrema");
  REQUIRE(extrema.size() == 3);
  const std::vector<std::pair<double, double>> brackets = {{0.6, 1}, {2.7, 3.5}, {150, 250}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& exact = extrema[k];
    const auto found = extreme_energy(brackets[k].first, brackets[k].second, exact["kind"] == "max" ? 1 : -1);
    CAPTURE(k, found.over);
    CHECK(reference::error(found.over, exact["normal_load"]) < 5e-5);
    CHECK(reference::error(found.energy_friction, exact["energy_friction"]) < 1e-7);
  }
}

TEST_CASE("at both maxima friction takes half of it all, pi f0^2/(4 c w)") {
  // Of the fundamental alone, E = pi X (f0 - c w X) at a phase of pi/2: greatest where c w X = f0/2.
  for (double load : {0.7882, 198.0747}) {
    const auto peak = peak_at(load);
    CAPTURE(load);
    CHECK(std::abs(peak.friction_percent() - 50) < 0.02);
    CHECK(reference::error(peak.energy_friction, pi / (4 * 0.134 * peak.omega)) < 1e-5);
  }
}

TEST_CASE("the least friction energy lies next to the optimum: at the optimum it is more, by 1e-6") {
  const auto optimum = peak_at(reference::exact("optima")[1]["normal_load"]);
  const double least = reference::exact("energy_extrema")[1]["energy_friction"];
  CHECK(optimum.energy_friction > least);
  CHECK(optimum.energy_friction < least * (1 + 1e-5));
}
