#pragma once
// Random structures with friction, the same ones on every machine.

#include <arcslip/scene/scene.hpp>

#include <cstdint>

namespace random_scenes {

/// What is excited: one harmonic, a second odd one, or an even one, which brings in the mean.
enum class Excitation { first, first_and_third, first_and_second };

/// A chain of 1 to 5 masses of about 1 kg from the ground on, with springs of 5 to 20 kN/m and dampers of
/// 0.1 to 4 N s/m, and 1 to 5 friction dampers of 1 to 20 kN/m between neighbours or to the ground, with
/// normal loads of 0.05 to 10 N (evenly over the logarithm), N of 3, 5, 7, 9 or 15, forces of 0.2 to 1 N, and
/// a window within 4 Hz to 40 Hz.
arcslip::scene::Scene make(std::uint64_t seed, Excitation excitation);

/// Harder ones: a chain of 1 to 6 masses, tied to the ground at one end or at both, with masses and springs
/// over a decade and viscous damping of 0.01 % to 3 %; 1 to 5 friction dampers between any two masses or to
/// the ground, over two decades of stiffness and four of load, one in twelve without load; one or two forces
/// in the first three harmonics; N of 3, 5 or 7, and a window around the resonances.
arcslip::scene::Scene hard(std::uint64_t seed);

/// Chains of one to four masses with one or two hardening cubic springs and up to two friction dampers, so
/// that most responses have folds; odd or all harmonics, order 3 to 9.
arcslip::scene::Scene make_hardening(std::uint64_t seed);

}  // namespace random_scenes
