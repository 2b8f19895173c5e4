#pragma once
// Motions in time as files: JSON in the format "arcslip-time-1", CSV, figures.

#include <arcslip/observables/motion.hpp>
#include <arcslip/output/figure_data.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/output/json_document.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>
#include <string>

namespace arcslip::output {

/// "motions": [M, ...] with
///   M = {"study", "kind", "status", "stop": {"reason", "value", "limit", "message"}, "set", "parameters",
///   "method",
///        "integrator", "frequency", "omega", "steps", "periods", "period_change", "amplitude",
///        "energy_input", "energy_friction", "energy_viscous", "energy_stored", "energy_defect",
///        "multipliers", "stable", "stick_percent", "elements": {NAME: {"stick_percent", "energy"}},
///        "history": {"time", "displacement", "velocity", "elements": {NAME: {"displacement", "force",
///        "slider"}}}}.
/// "study" and "kind" only where the motion knows its study; "stable" only where the multipliers are known
/// (each a pair of real and imaginary part); "stick_percent" at the top with one friction element. Units:
/// those of Motion. Refers to its arguments.
JsonSection json_section(const scene::Scene& scene, std::span<const observables::Motion> motions);
void write_json(std::ostream& out, const scene::Scene& scene, std::span<const observables::Motion> motions);

/// A header with units, then a row an instant. Columns: the study, where the motions are of more than one;
/// one for each parameter that is set; motion (from 1); time (s), displacement (m) and velocity (m/s) of the
/// response; and displacement (m), force (N) and slider (m) of each element, "damper.force (N)".
void write_csv(std::ostream& out, const scene::Scene& scene, std::span<const observables::Motion> motions);

/// Displacement over time (NAME_displacement), and for each friction element its hysteresis loop
/// (NAME_hysteresis) and its force over time (NAME_force), with a line for each motion. Data of more than 20
/// 000 instants are thinned.
Figures write_figures(const scene::Scene& scene, scene::StudyKind kind,
                      std::span<const observables::Motion> motions, const std::string& folder,
                      const std::string& name, const scene::StopRequest& stop = {});

/// Columns: time, displacement of the response, then displacement and force of each friction element.
FigureData figure_data(const scene::Scene& scene, std::span<const observables::Motion> motions);

}  // namespace arcslip::output
