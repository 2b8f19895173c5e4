#pragma once

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>

namespace arcslip::app {

/// The events of each branch of one study for people: set parameters, the parameter that the branch is over,
/// what it is, frequency, amplitude, stick share and how the branch ended, in aligned columns.
void write_table(std::ostream& out, const scene::Scene& scene,
                 std::span<const observables::ResponseBranch> branches);

}  // namespace arcslip::app
