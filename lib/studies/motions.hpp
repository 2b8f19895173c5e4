#pragma once
// Motions in time as results, format "arcslip-time-1": a table of their history, by columns.

#include <arcslip/observables/motion.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/columns.hpp>

#include <span>

namespace arcslip::studies {

/// docs/results.md tells all that there is.
results::Results results_of(const scene::Scene& scene, std::span<const observables::Motion> motions,
                            const RunOptions& options = {});

}  // namespace arcslip::studies
