#pragma once
// Branches of responses as results, format "arcslip-branches-1": tables of points and of events.

#include <arcslip/observables/response.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/columns.hpp>
#include <arcslip/studies/described.hpp>

#include <span>
#include <string>

namespace arcslip::studies {

/// The schema of a study. over: the continuation parameter, if it is not the frequency; maxima: whether its
/// points have maxima. See docs/results.md for all fields.
Described<observables::ResponseBranch> branches(const scene::Scene& scene, const std::string& over,
                                                bool maxima, const RunOptions& options);

/// The results of existing branches, of any studies.
results::Results results_of(const scene::Scene& scene, std::span<const observables::ResponseBranch> all,
                            const RunOptions& options = {});

}  // namespace arcslip::studies
