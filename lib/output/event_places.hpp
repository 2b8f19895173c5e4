#pragma once

#include <arcslip/observables/response.hpp>

#include <cstddef>
#include <vector>

namespace arcslip::output {

/// For each event of the branch the number of points that come before it. Events come in the order of the
/// branch; each stands where going through it in the (parameter, frequency, amplitude, phase) space is the
/// least detour; an unbounded peak ends its branch.
std::vector<std::size_t> points_before_events(const observables::ResponseBranch& branch);

}  // namespace arcslip::output
