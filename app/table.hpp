#pragma once

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>

namespace arcslip::app {

/// The peaks and folds of each branch for people: set parameters, what it is, frequency, amplitude, stick
/// share and how the branch ended, in aligned columns.
void write_table(std::ostream& out, const scene::Scene& scene,
                 std::span<const observables::ResponseBranch> branches);

}  // namespace arcslip::app
