#pragma once
// Branches as JSON, format "arcslip-branches-1".

#include <arcslip/observables/response.hpp>
#include <arcslip/output/json_document.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>

namespace arcslip::output {

struct JsonOptions {
  bool coefficients = false;  // also the harmonics of the response: a_n, b_n for each n of "harmonics"
};

/// Writes one object, {"format", "program", "scene_hash", "title", "frequency_unit", "branches": [B, ...]},
/// with
///   B = {"study", "kind", "status", "stop": {"reason", "value", "limit", "message"}, "over", "set",
///   "parameters", "points",
///        "events", "solver"};
/// "study" and "kind" only where the branch knows the study it belongs to, "over" only where it is over a
/// parameter, whose value each point and event holds by its name then.
/// Points and events hold omega (rad/s), frequency (scene's unit), amplitude (m), phase (rad),
/// truncation_estimate (m), energies (J per period), friction_percent (share of friction in energy_total),
/// force_per_displacement (N/m; F_p/x and F_o/x with their parts), and under "elements" what each element has
/// (angles in rad, forces in N, equivalent_stiffness in N/m, equivalent_damping in N s/m). Events and curves
/// of peaks and folds also hold "maxima" over the period: of the response (m/s, m/s^2, N/m), and of each
/// friction element's force (N). All are defined in observables/response.hpp. Numbers are the shortest that
/// read back exactly; what is not finite is null. Where the amplitude is unbounded it is null, as is all that
/// depends on it, and "unbounded" is true. A point a line; written as it goes.
void write_json(std::ostream& out, const scene::Scene& scene,
                std::span<const observables::ResponseBranch> branches, const JsonOptions& options = {});

/// The same branches as a part of a document. Refers to its arguments.
JsonSection json_section(const scene::Scene& scene, std::span<const observables::ResponseBranch> branches,
                         const JsonOptions& options = {});

}  // namespace arcslip::output
