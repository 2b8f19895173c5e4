#pragma once
// The state at t = 0 of a motion that harmonic balance gives: a start for shooting.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/stability/floquet.hpp>
#include <arcslip/time/equation/equation_of_motion.hpp>

namespace arcslip::time {

/// u, p: as of a solution of `problem`. The sliders are where the truncated friction force puts them.
MotionState state_of(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p);

/// Coefficients of every degree of freedom, one column each, in the layout of fourier/harmonics.hpp.
Matrix dof_coefficients(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p);

/// The motions along the elements and what they tell of their contacts, at the last place of an evaluator of
/// `problem`, for Floquet::compute().
void courses_of(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at,
                std::vector<ElementCourse>& courses);
/// The same at unknowns of `problem`, where no element reports contacts.
void courses_of(const hbm::HbmProblem& problem, elements::In u, std::vector<ElementCourse>& courses);

}  // namespace arcslip::time
