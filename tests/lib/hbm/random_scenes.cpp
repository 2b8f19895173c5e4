#include "lib/hbm/random_scenes.hpp"

#include <array>
#include <cmath>
#include <random>
#include <string>

namespace random_scenes {

using namespace arcslip;

namespace {

// The distributions of the standard library differ from one to the other; its generators do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double between(double lower, double upper) {
    return lower + (upper - lower) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  double logarithmic(double lower, double upper) {
    return std::exp(between(std::log(lower), std::log(upper)));
  }
  int count(int lower, int upper) {
    return lower + static_cast<int>(bits_() % static_cast<std::uint64_t>(upper - lower + 1));
  }

 private:
  std::mt19937_64 bits_;
};

// Mass i relative to the one before it in the chain, or to the ground.
scene::Direction tie(int i, bool to_ground) {
  if (i == 0 || to_ground) return {{i, 1.0}};
  return {{i, 1.0}, {i - 1, -1.0}};
}

}  // namespace

scene::Scene make(std::uint64_t seed, Excitation excitation) {
  Random random(seed);
  scene::Scene s;
  const int masses = random.count(1, 5), dampers = random.count(1, 5);
  for (int i = 0; i < masses; ++i) {
    const std::string number = std::to_string(i + 1);
    s.dofs.push_back("x" + number);
    s.masses.push_back({"m" + number, &scene::mass_type, {{i, 1.0}}, {random.between(0.8, 1.2)}});
    s.springs.push_back({"k" + number, &scene::spring_type, tie(i, false), {random.between(5e3, 2e4)}});
    s.dampers.push_back({"c" + number, &scene::damper_type, tie(i, false), {random.between(0.1, 4)}});
  }
  for (int e = 0; e < dampers; ++e) {
    const int at = random.count(0, masses - 1);
    const bool to_ground = random.count(0, 1) == 1;
    const double stiffness = random.logarithmic(1e3, 2e4), mu = random.between(0.3, 0.6);
    s.elements.push_back({"d" + std::to_string(e + 1),
                          &scene::jenkins_type,
                          tie(at, to_ground),
                          {stiffness, mu, random.logarithmic(0.05, 10)}});
  }
  const int at = random.count(0, masses - 1);
  s.excitation.push_back({"f1", &scene::force_type, {{at, 1.0}}, {1, 0}, 1});
  if (excitation != Excitation::first) {
    const int harmonic = excitation == Excitation::first_and_third ? 3 : 2;
    const int other = random.count(0, masses - 1);
    const double cosine = random.between(0.2, 1), sine = random.between(-1, 1);
    s.excitation.push_back(
        {"f" + std::to_string(harmonic), &scene::force_type, {{other, 1.0}}, {cosine, sine}, harmonic});
  }
  s.harmonics.order = std::array{3, 5, 7, 9, 15}[static_cast<std::size_t>(random.count(0, 4))];
  s.response = {{random.count(0, masses - 1), 1.0}};
  scene::Study study;
  study.name = "frf";
  study.from = random.between(4, 20);
  study.to = study.from + random.between(5, 20);
  s.studies.push_back(study);
  scene::check(s);
  return s;
}

}  // namespace random_scenes
