#pragma once
// Motions and hysteresis loops at points of frequency responses, to look at next to their curves.

#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace arcslip::studies {

/// Returns the motions at events and at points between them, `most` of them at most. record: of a point.
/// Points whose motion is not known as a series have none.
std::vector<results::FigureMotion> motions_on(
    const scene::Scene& scene, const std::vector<const observables::ResponseBranch*>& branches,
    std::size_t most, const std::function<results::Record(const observables::ResponsePoint&)>& record);

}  // namespace arcslip::studies
