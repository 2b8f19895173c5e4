#pragma once
// From a study to its results and figures: all that the command knows of its kinds.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/results/figure.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/columns.hpp>

#include <string>
#include <vector>

namespace arcslip::app {

struct StudyResult {
  results::Results results;
  std::vector<results::FigureData>
      figures;  // each has a name of its own; with one there may be nothing on it
};

/// Figures only where they are asked for.
StudyResult compute(const scene::Scene& scene, const scene::Study& study, const studies::Detail& detail,
                    bool figures, const observables::ProgressCallback& progress);

/// The list in which a document holds the results of such a study.
std::string list_of(const scene::Scene& scene, const scene::Study& study);

}  // namespace arcslip::app
