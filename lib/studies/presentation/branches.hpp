#pragma once
// Branches of responses as results, format "arcslip-branches-1": tables of points and of events.

#include <arcslip/results/response.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/presentation/result_description.hpp>

#include <span>
#include <string>

namespace arcslip::studies {

/// The schema of a study, with the columns asked of its points. See docs/results.md for all fields.
Described<observables::ResponseBranch> branches(const scene::Scene& scene, Asked asked,
                                                const RunOptions& options);

/// The results of existing branches, of any studies.
results::Results results_of(const scene::Scene& scene, std::span<const observables::ResponseBranch> all,
                            const RunOptions& options = {});

}  // namespace arcslip::studies
