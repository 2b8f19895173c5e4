#pragma once
// What tells a case from the others.

#include <arcslip/optimize/optimum.hpp>

#include <string>

namespace arcslip::optimize {

/// "force.cosine = 1 N, k.value = 3 N/m, response at blade 2", with what scatters; "the scene as it is" where
/// it changes nothing.
std::string case_text(const scene::Scene& scene, const OptimumProblem& problem, const CaseResult& of);

/// The same for a figure whose key has the names: "1 N, 3 N/m, blade 2"; "as it is".
std::string case_label(const scene::Scene& scene, const OptimumProblem& problem, const CaseResult& of);

/// Where the response is read: "blade 2", "blade 1 - blade 2".
std::string direction_text(const scene::Scene& scene, const scene::Direction& direction);

}  // namespace arcslip::optimize
