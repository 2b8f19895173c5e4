#pragma once
// What all studies have in common: the combinations of their lists, and the description of a branch.

#include <arcslip/continuation/branch.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

using scene::Setting;

/// Those of the study's for_each lists. Refers to the study.
inline scene::Combinations combinations(const scene::Study& study) {
  return scene::Combinations(study);
}

/// An empty branch of a model: its parameters, harmonics and solver. over: the free parameter, if there is
/// one in the study.
ResponseBranch described(const model::Model& model, const Setting& set, const std::string& over = {});

/// Whether the amplitude departs from an extreme at an arclength, on both sides, by more than rounding: it
/// does not where all friction elements that the free parameter acts on stick, or slip, and nothing changes.
/// course: arclength and amplitude of the points of the branch.
bool departs(const std::vector<std::pair<double, double>>& course, double arclength, double amplitude);

void add(const continuation::Counts& counts, SolverSummary& to);
void add(const continuation::Counts& counts, continuation::Counts& to);

Status status_of(continuation::StopReason reason);

/// omega (rad/s) in the scene's unit, with its name.
std::string frequency_text(double omega, scene::FrequencyUnit unit);

}  // namespace arcslip::observables
