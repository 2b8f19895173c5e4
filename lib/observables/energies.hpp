#pragma once
// Energies of one period, J, from the coefficients of motion and force.
//
//   of a force (F^c, F^s) on the motion (a, b):  E = integral of f dx/dtheta = pi sum_n n (F^c_n b_n - F^s_n
//   a_n)
//
// In a periodic motion the work of the excitation equals the dissipation by friction and dampers; springs,
// linear or not, do no work. Harmonic balance satisfies this exactly at any order, since harmonics of a force
// above N do no work on the truncated motion.

#include <arcslip/hbm/problem.hpp>

namespace arcslip::observables {

/// Dissipated by an element; motion, force: their coefficients, harmonics.size() for each direction. With one
/// direction it is the area of the hysteresis loop.
double element_energy(const elements::Harmonics& harmonics, elements::In motion, elements::In force);

/// Work of the excitation at unknowns u, with the parameters of the last point of `at`.
double input_energy(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In u);

}  // namespace arcslip::observables
