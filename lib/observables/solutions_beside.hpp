#pragma once
// Solutions of harmonic balance beside those that are known, at one frequency: a search by deflation
// (continuation/diagrams/deflation.hpp), which may miss some.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/response.hpp>

#include <optional>
#include <span>
#include <vector>

namespace arcslip::observables {

/// A motion and its images: later by periods of the excitation, where it takes several to repeat, and
/// mirrored where the equations have this symmetry and the motion has not.
std::vector<continuation::Vector> images(const hbm::HbmProblem& problem, const continuation::Vector& u);

/// Of a branch of `problem`: at omega, rad/s.
std::vector<continuation::Vector> solutions_at(const hbm::HbmProblem& problem,
                                               std::span<const ResponsePoint> branch, double omega);

/// One that is none of those known, which stand for all of their images.
std::optional<continuation::Vector> solution_beside(const hbm::HbmProblem& problem, double omega,
                                                    const std::vector<continuation::Vector>& known,
                                                    const GoOn& go_on);

}  // namespace arcslip::observables
