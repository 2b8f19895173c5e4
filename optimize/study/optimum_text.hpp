#pragma once
// Text output of optima.

#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>

namespace arcslip::optimize {

/// Lines with the parameters set, the design with its amplitude, cases and limits, the work, and the
/// certificate; for a curve, its ends and its events.
std::string text_of(const scene::Scene& scene, const OptimumResult& result);
std::string text_of(const scene::Scene& scene, const OptimumCurveResult& result);

// Labels of cases.

/// "force.cosine = 1 N, k.value = 3 N/m, response at blade 2", including scatter; "the scene as it is" if it
/// changes nothing.
std::string case_text(const scene::Scene& scene, const OptimumProblem& problem, const LoadCaseResult& of);

/// The same for a figure with the names in its key: "1 N, 3 N/m, blade 2"; "as it is".
std::string case_label(const scene::Scene& scene, const OptimumProblem& problem, const LoadCaseResult& of);

/// The response location: "blade 2", "blade 1 - blade 2".
std::string direction_text(const scene::Scene& scene, const scene::Direction& direction);

}  // namespace arcslip::optimize
