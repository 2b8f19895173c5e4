#pragma once
// Energies of one period, J, from the coefficients of motion and force.
//
//   of a force (F^c, F^s) on the motion (a, b):  E = integral of f dx/dtheta = pi sum_n n (F^c_n b_n - F^s_n
//   a_n)
//
// In a periodic motion the excitation puts in what friction and dampers take out; springs, linear or not,
// take nothing. Harmonic balance keeps that exactly at any order, since harmonics of a force above N do no
// work on the motion kept.

#include <arcslip/hbm/problem.hpp>

namespace arcslip::observables {

/// Taken out by an element; motion, force: their coefficients, harmonics.size() of each direction. With one
/// it is the area of the loop that the force makes over the element's displacement.
double element_energy(const elements::Harmonics& harmonics, elements::In motion, elements::In force);

/// Put in by the excitation at unknowns u, with the parameters of the last place of `at`.
double input_energy(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In u);

}  // namespace arcslip::observables
