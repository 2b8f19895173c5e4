#pragma once
// Parts of figures of branches: what each contact does, over the branch and over the period, as figures of
// areas; maps of patches of contacts; motions and hysteresis loops at points of frequency responses, to look
// at next to their curves.

#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace arcslip::studies {

/// A figure for each element whose points tell its contact, but those of patches, over x(point), column 0 of
/// the data: "contact", or "contact_damper" where there are several. y: the angle of the period, degrees.
/// Where the branch turns back, the response that it has first is shown, as in a slow sweep upwards.
std::vector<results::FigureView> contact_figures(
    std::span<const observables::ResponseBranch* const> branches,
    const std::function<double(const observables::ResponsePoint&)>& x);

/// Maps of each patch whose contacts have a place (scene::PatchRow): the share of the period in stick and in
/// separation, the largest pressure, the energy dissipated per area and the rate of the depth of wear, at the
/// resonance peak with the largest amplitude. A contact is a rectangle of its area, with sides as the spacing
/// of the places in x and y. Without a peak there are none.
std::vector<results::FigureData> patch_maps(const scene::Scene& scene,
                                            std::span<const observables::ResponseBranch> branches);

/// Returns the motions at events and at points between them, `most` of them at most. record: of a point.
/// Points whose motion is not known as a series have none.
std::vector<results::FigureMotion> motions_on(
    const scene::Scene& scene, const std::vector<const observables::ResponseBranch*>& branches,
    std::size_t most, const std::function<results::Record(const observables::ResponsePoint&)>& record);

}  // namespace arcslip::studies
