#pragma once
// Motions in time as results, format "arcslip-time-1": a table of their history, by columns.

#include <arcslip/analyses/modes_and_time/time_results.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/presentation/result_description.hpp>

#include <span>

namespace arcslip::studies {

/// The schema of a study. See docs/results.md for all fields.
Described<observables::Motion> motions(const scene::Scene& scene, const RunOptions& options);

/// The results of existing motions.
results::Results results_of(const scene::Scene& scene, std::span<const observables::Motion> all,
                            const RunOptions& options = {});

}  // namespace arcslip::studies
