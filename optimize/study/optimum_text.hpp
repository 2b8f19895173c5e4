#pragma once
// Optima for people.

#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>

namespace arcslip::optimize {

/// What was set, the design with its amplitude, its cases and limits, the work, and what the certificate
/// says; of a curve, its ends and its events. Lines.
std::string text_of(const scene::Scene& scene, const OptimumResult& result);
std::string text_of(const scene::Scene& scene, const OptimumCurveResult& result);

// What tells a case from the others.

/// "force.cosine = 1 N, k.value = 3 N/m, response at blade 2", with what scatters; "the scene as it is" where
/// it changes nothing.
std::string case_text(const scene::Scene& scene, const OptimumProblem& problem, const CaseResult& of);

/// The same for a figure whose key has the names: "1 N, 3 N/m, blade 2"; "as it is".
std::string case_label(const scene::Scene& scene, const OptimumProblem& problem, const CaseResult& of);

/// Where the response is read: "blade 2", "blade 1 - blade 2".
std::string direction_text(const scene::Scene& scene, const scene::Direction& direction);

}  // namespace arcslip::optimize
