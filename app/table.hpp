#pragma once

#include <arcslip/observables/motion.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>

namespace arcslip::app {

/// The events of each branch of one study for people: set parameters, the parameter that the branch is over,
/// what it is, frequency, amplitude, stick share and how the branch ended, in aligned columns.
void write_table(std::ostream& out, const scene::Scene& scene,
                 std::span<const observables::ResponseBranch> branches);

/// A row for each motion: set parameters, how it was found, frequency, amplitude, stick share, energies per
/// period, the largest Floquet multiplier and how it ended.
void write_table(std::ostream& out, const scene::Scene& scene, std::span<const observables::Motion> motions);

}  // namespace arcslip::app
