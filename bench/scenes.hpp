#pragma once
// The scenes that are timed: those of examples/, and the same with other sizes.

#include <arcslip/optimize/studies.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <string>

namespace arcslip::bench {

inline scene::Catalogue catalogue() {
  scene::Catalogue all = studies::catalogue();
  optimize::add_studies(all);
  return all;
}

/// examples/NAME/scene.json
inline scene::Scene example(const std::string& name) {
  return scene::read_file("examples/" + name + "/scene.json", catalogue());
}

/// The oscillator of Al Sayed et al. (2011) with a normal load of 3 N, between 18 and 22 Hz.
inline scene::Scene paper(int order) {
  scene::Scene scene = example("al_sayed_2011");
  scene.harmonics.order = order;
  scene::set(scene, "damper.normal_load", 3);
  return scene;
}

/// n masses and dampers in proportion, between a wall and the last mass, with friction dampers to the ground
/// at `contacts` equally spaced masses, 7 harmonics. The lowest natural frequency is about 1 rad/s.
scene::Scene chain(int n, int contacts);

/// Six masses with a friction damper between all neighbours.
scene::Scene damped_chain();

/// n masses that move in three directions, each on a contact_3d that slips, and linked in a ring. Order 5.
scene::Scene rubbing_masses(int n);

/// examples/cantilever/beam.json with n beam elements.
scene::Scene beam(int n);

/// examples/bladed_ring with n blades, at its second normal load.
scene::Scene ring(int n);

}  // namespace arcslip::bench
