#pragma once
// Branches as a table of comma-separated values (RFC 4180).

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>

namespace arcslip::output {

/// A header with units, then a row a point and a row an event, in the order of the branches. Columns: the
/// study, where the branches are of more than one; one for each parameter that a branch sets or is over,
/// "damper.normal_load (N)"; branch (from 1); event (empty,
/// "peak", "fold", "maximum", ...); frequency; amplitude (m); phase (rad); stick (%) of each friction
/// element; the truncation estimate; energies per period (J); friction (%), the share of friction in what is
/// dissipated; F_p/x and F_o/x (N/m); theta_0 and theta_star (rad), equivalent stiffness (N/m) and damping
/// (N s/m) of each friction element. See observables/response.hpp. New columns come last. An unbounded
/// amplitude reads "inf", what has no value is empty.
void write_csv(std::ostream& out, const scene::Scene& scene,
               std::span<const observables::ResponseBranch> branches);

}  // namespace arcslip::output
