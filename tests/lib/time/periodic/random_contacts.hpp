#pragma once
// Stops and contacts in planes on a random structure, sized by its motion without them.

#include "lib/time/periodic/compared_with_exact.hpp"
#include "random.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>

namespace random_contacts {

using namespace arcslip;
using test_random::Random;

// A stop of up to ten times the stiffest spring at each of one or two masses, where the motion without it
// comes to between 0.9 and 3 times the gap.
inline scene::Scene with_stops(scene::Scene s, std::uint64_t seed, double at) {
  const auto free = compared_with_exact::balanced(s, at);
  const auto amplitudes = time::dof_coefficients(*free.problem, free.u, free.p);
  Random random(seed);
  const int count = std::min<int>(random.count(1, 2), static_cast<int>(s.dofs.size()));
  for (int k = 0; k < count; ++k) {
    const int dof = random.count(0, static_cast<int>(s.dofs.size()) - 1);
    const double size = amplitudes.col(dof).norm(), weight = random.count(0, 1) == 1 ? 1 : -1;
    s.elements.push_back({"stop" + std::to_string(k),
                          &elements::gap_spring(),
                          {{{dof, weight}}},
                          {random.logarithmic(1e3, 2e5), size / random.between(0.9, 3)}});
  }
  return s;
}

// One to three contacts, each between two degrees of freedom or within one, with loads from a gap to such as
// are always in contact.
inline scene::Scene with_contacts(scene::Scene s, std::uint64_t seed, double at) {
  const auto free = compared_with_exact::balanced(s, at);
  const auto amplitudes = time::dof_coefficients(*free.problem, free.u, free.p);
  Random random(seed);
  const int dofs = static_cast<int>(s.dofs.size());
  for (int k = random.count(1, 3); k > 0; --k) {
    const int tangential = random.count(0, dofs - 1), normal = random.count(0, dofs - 1);
    const double stiffness = random.logarithmic(1e3, 2e5), weight = random.count(0, 1) == 1 ? 1 : -1;
    const double load = stiffness * amplitudes.col(normal).norm() * random.between(-0.7, 1.5);
    scene::Part contact;
    contact.name = "contact" + std::to_string(k);
    contact.type = &elements::contact_2d();
    contact.directions = {{{tangential, 1.0}}, {{normal, weight}}};
    contact.values = {random.logarithmic(1e3, 2e5), stiffness, random.between(0.05, 0.5), load};
    s.elements.push_back(contact);
  }
  return s;
}

}  // namespace random_contacts
