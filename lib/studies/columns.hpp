#pragma once
// The quantities of responses (observables/quantities.hpp) as a table, and what else all results have. Units
// are those of the scene.

#include <arcslip/observables/response.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/studies/units.hpp>

#include <string>
#include <vector>

namespace arcslip::studies {

using scene::RunOptions;

/// What is asked of responses beside all that each has.
struct Asked {
  std::string over{};         // a parameter whose value at the response is a column of its own, the first
  bool maxima = false;        // over the period
  bool coefficients = false;  // the harmonics of the response
  bool amplitude = true;      // false: what the response belongs to has its own
};

/// What can be read off responses of a scene, by element in an object "elements".
results::TableOf<observables::ResponsePoint> responses(const scene::Scene& scene, const Asked& asked = {});

/// The columns of these parameters, but for those that are there.
void add_columns(const scene::Scene& scene, const NamedValues& set, std::vector<results::Column>& columns);

/// What people are shown of friction elements: the share of the period, or of the time, in stick.
void add_stick(const scene::Scene& scene, std::vector<results::Shown>& shown);

results::Header header(const scene::Scene& scene);

results::Object stop(const observables::Stop& stop);
results::Object solver(const observables::SolverSummary& summary);

/// What makes a branch doubtful (ResponseBranch::doubt), as the end of a sentence; empty: nothing.
std::string doubt_of(const observables::ResponseBranch& branch);

}  // namespace arcslip::studies
