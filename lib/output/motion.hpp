#pragma once
// Motions in time as CSV and figures.

#include <arcslip/observables/motion.hpp>
#include <arcslip/output/figure_data.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>
#include <string>

namespace arcslip::output {

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
