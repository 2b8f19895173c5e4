#pragma once

#include <arcslip/observables/response.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::studies {

/// Names of the elements that stick and slip, in the order of the points.
std::vector<std::string> friction_elements(std::span<const observables::ResponseBranch* const> branches);

/// Share of the period in which this element sticks (%); NaN where the point does not know.
double stick_percent(const observables::ResponsePoint& point, std::string_view element);

}  // namespace arcslip::studies
