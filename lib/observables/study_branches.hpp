#pragma once
// What all branches of responses have in common: their description, and how they end.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// An empty branch of a model: its parameters, harmonics and solver. over: the free parameter, if it is not
/// the frequency.
ResponseBranch described(const model::Model& model, const std::string& over = {});

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
