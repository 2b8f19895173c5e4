#pragma once
// The state at t = 0 of a motion that harmonic balance gives: a start for shooting.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/time/equation_of_motion.hpp>

namespace arcslip::time {

/// u, p: as of a solution of `problem`. The sliders are where the truncated friction force puts them.
MotionState state_of(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p);

/// Coefficients of every degree of freedom, one column each, in the layout of elements/harmonics.hpp.
Matrix dof_coefficients(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p);

}  // namespace arcslip::time
