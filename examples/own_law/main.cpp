// A law of force of one's own in a scene: a rotor that rubs. main SCENE
#include "rub.hpp"

#include <arcslip/optimize.hpp>

#include <cstdio>
#include <iostream>

int main(int argc, char** argv) {
  using namespace arcslip;
  scene::Catalogue catalogue = studies::catalogue();
  optimize::add_studies(catalogue);
  catalogue.elements.push_back(std::make_shared<Rub>());

  if (argc < 2) return 1;
  const scene::Scene scene = scene::read_file(argv[1], catalogue);
  const double speed = 1.2;
  for (const auto& response : observables::point_responses(scene, {.frequency = speed})) {
    const auto& point = response.point;
    std::printf("orbit radius = %.12f, energy = %.12f, balance = %.1e\n", point.amplitude, point.energy_input,
                point.energy_total() / point.energy_input - 1);
  }
  const auto motion = observables::motion_in_time(
      scene, {.frequency = speed, .method = observables::TimeMethod::newmark_shooting, .steps = 2000});
  std::printf("steps radius = %.9f, energy = %.9f\n", motion.amplitude, motion.energy.input);

  results::write_table(std::cout, studies::run(scene));
}
