#pragma once

#include <arcslip/output/figure_data.hpp>
#include <arcslip/output/figures.hpp>

#include <string>

namespace arcslip::output {

/// Writes the sources of figures and draws them, as write_figures() says.
Figures draw_figures(const scene::Scene& scene, const FigureData& data, const std::string& folder,
                     const std::string& name, const scene::StopRequest& stop = {});

}  // namespace arcslip::output
