#pragma once
// Reads the design parameters, limits and load cases of a study of kind "optimum". Not installed.

#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <vector>

namespace arcslip::optimize {

/// "over" and "bounds": the design parameters, with a pair of bounds for each.
void read_design(const scene::file::Reading& reading, OptimumProblem& problem);

/// "constraints": limits on observables and on linear combinations of design parameters.
void read_constraints(const scene::file::Reading& reading, OptimumProblem& problem);

/// "cases": a list of cases, or lists of parameter values with all their combinations.
void read_cases(const scene::file::Reading& reading, OptimumProblem& problem);

/// "scatter": pairs [lower, upper] by the names of parameters.
void read_scatter(const scene::file::Reading& reading, OptimumProblem& problem);

/// Checks the criterion against the cases and the scatter.
void check_criterion(const scene::file::Reading& reading, const OptimumProblem& problem);

/// The parameters of the design, of its cases and of the scatter.
std::vector<scene::ParameterUse> taken(const OptimumProblem& problem);

}  // namespace arcslip::optimize
