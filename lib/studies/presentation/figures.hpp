#pragma once
// The figures of studies, as data.

#include <arcslip/analyses/modes_and_time/time_results.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::studies {

/// The kind of branches: responses over the frequency, responses over a parameter, resonance peaks, folds,
/// other bifurcations, or modes.
enum class BranchKind { responses, over_parameter, peaks, folds, bifurcations, modes };

/// Figures of branches of this kind, with a line for each combination of set parameters, numbered where these
/// take too much room for a legend. Columns: the continuation parameter if it is not the frequency, the
/// frequency, the amplitude (m), stick (%) of each friction element. For frequency responses and traces: the
/// amplitude and the stick share of each friction element ("amplitude", "stick"). For resonance peaks: their
/// amplitude, their frequency ("frequency"), and the amplitude over the stick share of each friction element
/// ("amplitude_over_stick"). For folds: the parameter over the frequency ("folds"); the same
/// for bifurcations ("bifurcations"), with a line for each kind of them. For modes, whose columns
/// are amplitude, frequency, damping ratio and stick: all over the amplitude. Of a single line, but folds,
/// also what each contact does (figure_parts.hpp).
results::FigureData figures_of(const scene::Scene& scene, BranchKind kind,
                               std::span<const observables::ResponseBranch> branches);

/// The branches of one line, and the line without data.
struct LineOfBranches {
  results::FigureLine line;
  std::vector<const observables::ResponseBranch*> branches;
};

/// The same for lines grouped by the caller.
results::FigureData figures_of(const scene::Scene& scene, BranchKind kind, std::vector<LineOfBranches> lines);

/// The columns of the frequency, and of the amplitude, in that data.
std::size_t frequency_column(BranchKind kind);
std::size_t amplitude_column(BranchKind kind);

/// The displacement over time ("displacement"), and for each friction element its hysteresis loop
/// ("hysteresis") and its force over time ("force"), with a line for each motion. Columns: time, displacement
/// of the response, then displacement and force of each friction element. More than 20 000 instants are
/// thinned.
results::FigureData figures_of(const scene::Scene& scene, std::span<const observables::Motion> motions);

/// A line of these set parameters, without data: "3 N, 0.1 N s/m".
results::FigureLine line_of(const scene::Scene& scene,
                            const std::vector<std::pair<std::string, double>>& set);

}  // namespace arcslip::studies
