#pragma once
// Reading what a study of kind "optimum" varies, within which limits, and what it is to serve. Not installed.

#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/scene/study_keys.hpp>

#include <vector>

namespace arcslip::optimize {

/// The parameters of a design in "over", and as many pairs in "bounds".
void read_design(const scene::file::Reading& reading, OptimumProblem& problem);

/// "constraints": limits on observables and on sums of parameters of the design.
void read_constraints(const scene::file::Reading& reading, OptimumProblem& problem);

/// "cases": values of parameters, whose product is the cases, or a list of cases.
void read_cases(const scene::file::Reading& reading, OptimumProblem& problem);

/// "scatter": pairs [lower, upper] by the names of parameters.
void read_scatter(const scene::file::Reading& reading, OptimumProblem& problem);

/// Whether what counts of the cases agrees with them, and with what scatters.
void check_criterion(const scene::file::Reading& reading, const OptimumProblem& problem);

/// The parameters of the design, of its cases, and those that scatter.
std::vector<scene::Taken> taken(const OptimumProblem& problem);

}  // namespace arcslip::optimize
