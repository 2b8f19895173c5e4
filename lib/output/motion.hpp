#pragma once
// Figures of motions in time.

#include <arcslip/observables/motion.hpp>
#include <arcslip/output/figure_data.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>

namespace arcslip::output {

/// Displacement over time (NAME_displacement), and for each friction element its hysteresis loop
/// (NAME_hysteresis) and its force over time (NAME_force), with a line for each motion. Data of more than 20
/// 000 instants are thinned.
Figures write_figures(const scene::Scene& scene, scene::StudyKind kind,
                      std::span<const observables::Motion> motions, const std::string& folder,
                      const std::string& name, const scene::StopRequest& stop = {});

/// Columns: time, displacement of the response, then displacement and force of each friction element.
FigureData figure_data(const scene::Scene& scene, std::span<const observables::Motion> motions);

}  // namespace arcslip::output
