#pragma once
// Branches of responses as results, format "arcslip-branches-1": tables of points and of events.

#include <arcslip/observables/response.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/columns.hpp>

#include <span>

namespace arcslip::studies {

/// docs/results.md tells all that there is.
results::Results results_of(const scene::Scene& scene, std::span<const observables::ResponseBranch> branches,
                            const RunOptions& options = {});

}  // namespace arcslip::studies
