#pragma once
// What a study gives, and all that the command does with it. A kind of results is one alternative of the
// variant, with a function of its own for each of these (results_of, figures_of, write_table, noun, end)
// and the members study, kind and set; the rest knows no kinds.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/motion.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/optimize/optimum_study.hpp>
#include <arcslip/results/figure.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

namespace arcslip::app {

using StudyResult =
    std::variant<std::vector<observables::ResponseBranch>, std::vector<observables::Motion>,
                 std::vector<optimize::OptimumResult>, std::vector<optimize::OptimumCurveResult>>;

/// Nothing yet of what such a study gives.
StudyResult no_result(const scene::Study& study);

/// Every result says which study it is of.
StudyResult compute(const scene::Scene& scene, const scene::Study& study,
                    const observables::ProgressCallback& progress);

/// For each part that ended early, which and why.
std::vector<std::string> early_ends(const scene::Scene& scene, const StudyResult& result);

/// For each part that is complete, but has lost digits, which and why.
std::vector<std::string> doubts(const scene::Scene& scene, const StudyResult& result);

/// Aligned columns for people.
void write_table(std::ostream& out, const scene::Scene& scene, const StudyResult& result);

/// coefficients: with the harmonics of the responses.
results::Results results_of(const scene::Scene& scene, const StudyResult& result, bool coefficients);

/// Each has a name of its own; with a single one there may be nothing on it.
std::vector<results::FigureData> figures_of(const scene::Scene& scene, scene::StudyKind kind,
                                            const StudyResult& result);

}  // namespace arcslip::app
