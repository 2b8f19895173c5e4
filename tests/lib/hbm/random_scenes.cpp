#include "lib/hbm/random_scenes.hpp"

#include "random.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace random_scenes {

using namespace arcslip;
using test_random::Random;

namespace {

// Mass i relative to the one before it in the chain, or to the ground.
scene::Direction tie(int i, bool to_ground) {
  if (i == 0 || to_ground) return {{i, 1.0}};
  return {{i, 1.0}, {i - 1, -1.0}};
}

scene::Study frf(double from, double to) {
  return {"frf", &studies::frf(), scene::Settings::of(observables::FrequencyRange{from, to})};
}

}  // namespace

scene::Scene make(std::uint64_t seed, Excitation excitation) {
  Random random(seed);
  scene::Scene s;
  const int masses = random.count(1, 5), dampers = random.count(1, 5);
  for (int i = 0; i < masses; ++i) {
    const std::string number = std::to_string(i + 1);
    s.dofs.push_back("x" + number);
    s.masses.push_back({"m" + number, &scene::mass_type(), {{{i, 1.0}}}, {random.between(0.8, 1.2)}});
    s.springs.push_back({"k" + number, &scene::spring_type(), {tie(i, false)}, {random.between(5e3, 2e4)}});
    s.dampers.push_back({"c" + number, &scene::damper_type(), {tie(i, false)}, {random.between(0.1, 4)}});
  }
  for (int e = 0; e < dampers; ++e) {
    const int at = random.count(0, masses - 1);
    const bool to_ground = random.count(0, 1) == 1;
    const double stiffness = random.logarithmic(1e3, 2e4), mu = random.between(0.3, 0.6);
    s.elements.push_back({"d" + std::to_string(e + 1),
                          &elements::jenkins(),
                          {tie(at, to_ground)},
                          {stiffness, mu, random.logarithmic(0.05, 10)}});
  }
  const int at = random.count(0, masses - 1);
  s.excitation.push_back({"f1", &scene::force_type(), {{{at, 1.0}}}, {1, 0}, 1});
  if (excitation != Excitation::first) {
    const int harmonic = excitation == Excitation::first_and_third ? 3 : 2;
    const int other = random.count(0, masses - 1);
    const double cosine = random.between(0.2, 1), sine = random.between(-1, 1);
    s.excitation.push_back(
        {"f" + std::to_string(harmonic), &scene::force_type(), {{{other, 1.0}}}, {cosine, sine}, harmonic});
  }
  s.harmonics.order = std::array{3, 5, 7, 9, 15}[static_cast<std::size_t>(random.count(0, 4))];
  s.response() = {{random.count(0, masses - 1), 1.0}};
  const double from = random.between(4, 20);
  s.studies.push_back(frf(from, from + random.between(5, 20)));
  scene::check(s);
  return s;
}

scene::Scene hard(std::uint64_t seed) {
  Random random(seed + 0x9e3779b97f4a7c15u);
  scene::Scene s;
  s.frequency_unit = scene::FrequencyUnit::radian_per_second;
  const int masses = random.count(1, 6), dampers = random.count(1, 5), forces = random.count(1, 2);
  const double mass = random.logarithmic(0.05, 10), stiffness = random.logarithmic(1, 1e4),
               force = random.logarithmic(0.01, 100);
  const auto add_spring = [&](const std::string& number, const scene::Direction& direction) {
    const double k = stiffness * random.logarithmic(0.3, 3);
    s.springs.push_back({"k" + number, &scene::spring_type(), {direction}, {k}});
    s.dampers.push_back({"c" + number,
                         &scene::damper_type(),
                         {direction},
                         {2 * random.logarithmic(1e-4, 3e-2) * std::sqrt(k * mass)}});
  };
  for (int i = 0; i < masses; ++i) {
    const std::string number = std::to_string(i + 1);
    s.dofs.push_back("x" + number);
    s.masses.push_back(
        {"m" + number, &scene::mass_type(), {{{i, 1.0}}}, {mass * random.logarithmic(0.3, 3)}});
    add_spring(number, tie(i, false));
  }
  if (random.count(0, 1) == 1) add_spring("end", {{masses - 1, 1.0}});
  const auto between = [&] {
    const int a = random.count(0, masses - 1), b = random.count(-1, masses - 1);
    return b < 0 || a == b ? scene::Direction{{a, 1.0}} : scene::Direction{{a, 1.0}, {b, -1.0}};
  };
  for (int e = 0; e < dampers; ++e) {
    const auto direction = between();
    const double kd = stiffness * random.logarithmic(0.05, 5), mu = random.between(0.1, 0.9);
    const double load = random.count(1, 12) == 1 ? 0 : force * random.logarithmic(0.01, 100);
    s.elements.push_back({"d" + std::to_string(e + 1), &elements::jenkins(), {direction}, {kd, mu, load}});
  }
  int highest = 1;
  for (int f = 0; f < forces; ++f) {
    const auto direction = between();
    const int harmonic = random.count(1, 3);
    highest = std::max(highest, harmonic);
    const double size = force * random.logarithmic(0.1, 1), angle = random.between(0, 6.28);
    s.excitation.push_back({"f" + std::to_string(f + 1),
                            &scene::force_type(),
                            {direction},
                            {size * std::cos(angle), size * std::sin(angle)},
                            harmonic});
  }
  s.harmonics.order = std::array{3, 5, 7}[static_cast<std::size_t>(random.count(0, 2))];
  s.response() = {{random.count(0, masses - 1), 1.0}};
  const double frequency = std::sqrt(stiffness / mass);
  const double from = frequency * random.between(0.1, 0.8) / highest;
  s.studies.push_back(frf(from, from + frequency * random.between(0.5, 2)));
  scene::check(s);
  return s;
}

scene::Scene make_hardening(std::uint64_t seed) {
  Random random(seed);
  scene::Scene s;
  const int masses = random.count(1, 4);
  for (int i = 0; i < masses; ++i) {
    const std::string number = std::to_string(i + 1);
    s.dofs.push_back("x" + number);
    s.masses.push_back({"m" + number, &scene::mass_type(), {{{i, 1.0}}}, {random.between(0.8, 1.2)}});
    s.springs.push_back({"k" + number, &scene::spring_type(), {tie(i, false)}, {random.between(0.5, 2)}});
    s.dampers.push_back(
        {"c" + number, &scene::damper_type(), {tie(i, false)}, {random.logarithmic(5e-3, 0.08)}});
  }
  const int cubic = random.count(1, 2), dampers = random.count(0, 2);
  for (int e = 0; e < cubic + dampers; ++e) {
    const int at = random.count(0, masses - 1);
    const scene::Direction direction = tie(at, random.count(0, 1) == 1);
    const std::string number = std::to_string(e + 1);
    if (e < cubic) {
      s.elements.push_back(
          {"s" + number, &elements::cubic_spring(), {direction}, {random.logarithmic(0.05, 2)}});
      continue;
    }
    const double stiffness = random.logarithmic(0.1, 2), mu = random.between(0.3, 0.6);
    s.elements.push_back(
        {"d" + number, &elements::jenkins(), {direction}, {stiffness, mu, random.logarithmic(0.01, 1)}});
  }
  const int at = random.count(0, masses - 1);
  s.excitation.push_back({"f1", &scene::force_type(), {{{at, 1.0}}}, {random.logarithmic(0.02, 0.5), 0}, 1});
  if (random.count(0, 2) == 0) {
    const int other = random.count(0, masses - 1), harmonic = random.count(2, 3);
    const double cosine = random.between(0, 0.1), sine = random.between(-0.1, 0.1);
    s.excitation.push_back({"f2", &scene::force_type(), {{{other, 1.0}}}, {cosine, sine}, harmonic});
  }
  s.harmonics.order = std::array{3, 5, 7, 9}[static_cast<std::size_t>(random.count(0, 3))];
  s.response() = {{random.count(0, masses - 1), 1.0}};
  s.frequency_unit = scene::FrequencyUnit::radian_per_second;
  const double from = random.between(0.15, 0.6);
  s.studies.push_back(frf(from, from + random.between(1, 2.5)));
  scene::check(s);
  return s;
}

}  // namespace random_scenes
