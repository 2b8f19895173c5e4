#pragma once
// What each contact does, over the branch and over the period: figures of areas.

#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/response.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::studies {

/// A figure for each element whose points tell its contact, but those of patches, over x(point), column 0 of
/// the data: "contact", or "contact_damper" where there are several. y: the angle of the period, degrees.
/// Where the branch turns back, the response that it has first is shown, as in a slow sweep upwards.
std::vector<results::FigureView> contact_figures(
    std::span<const observables::ResponseBranch* const> branches,
    const std::function<double(const observables::ResponsePoint&)>& x);

}  // namespace arcslip::studies
