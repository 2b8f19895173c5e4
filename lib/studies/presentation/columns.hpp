#pragma once
// The quantities of responses (observables/quantities.hpp) as a table, and the common parts of all results,
// in the units of the scene.

#include <arcslip/results/response.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/run_options.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <string>
#include <vector>

namespace arcslip::studies {

/// Optional columns of responses.
struct Asked {
  std::string over{};         // the continuation parameter, the first column
  bool maxima = false;        // over the period
  bool coefficients = false;  // Fourier coefficients of the response
  bool amplitude = true;      // false: given elsewhere
  bool mode = false;          // of modes
  bool stability = false;     // Floquet multipliers
  bool leaving = false;       // of branches that leave others
  bool located = false;       // the events of a curve have estimates of their places
  bool order = false;         // of the harmonics, where it may differ from point to point
};

/// The quantities of responses of a scene, by element in an object "elements", by patch in "patches".
results::TableOf<observables::ResponsePoint> responses(const scene::Scene& scene, const Asked& asked = {});

/// The columns of these parameters, without existing ones.
void add_columns(const scene::Scene& scene, const NamedValues& set, std::vector<results::Column>& columns);

/// The columns of friction elements and patches in text output: the share of the period, or of the time, in
/// stick. doubts: results::Shown::doubtful.
void add_stick(const scene::Scene& scene, std::vector<results::Shown>& shown,
               const std::vector<std::string>& doubts = {"truncation_flagged"});

/// Why results with a structure that is reduced by modes may be wrong up to a frequency, in the scene's unit;
/// 0: all that the reduction is for. Empty: no reason.
std::string doubt_of_reduction(const scene::Scene& scene, double highest_harmonic,
                               const control::Control& control = {});

/// Reduces the matrices of the scene, if they are to be: observables::reduction().
results::Header header(const scene::Scene& scene);

results::Object stop(const observables::Stop& stop);
results::Object solver(const observables::SolverSummary& summary);

/// The doubt about a motion that stops (Solution::stops); empty: none.
std::string doubt_of_stops(const std::string& element);

/// Where the responses of a branch are unstable, a sentence; empty: nowhere, or not known.
std::string unstable_ranges(const scene::Scene& scene, const observables::ResponseBranch& branch);

/// The branches that leave a branch and were not followed, a sentence; empty: none.
std::string untraced(const observables::ResponseBranch& branch);

/// The doubts about a branch (ResponseBranch::doubt, motions that stop, an unknown stability), as the end of
/// a sentence; empty: none.
std::string doubt_of(const observables::ResponseBranch& branch);

}  // namespace arcslip::studies
