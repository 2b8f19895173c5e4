#pragma once
// The kinds of studies that trace branches of responses; they differ in their keys and in the curves
// they trace.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/studies/presentation/branches.hpp>
#include <arcslip/studies/presentation/figure_parts.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace arcslip::studies {

/// What the results of a study of branches have, besides what its scene and its options decide.
template <class Range>
Asked asked_for(BranchKind drawn, const scene::Scene& scene, const Range& range) {
  Asked asked;
  if constexpr (requires { range.over; }) asked.over = range.over;
  asked.maxima =
      drawn == BranchKind::peaks || drawn == BranchKind::folds || drawn == BranchKind::bifurcations;
  asked.mode = drawn == BranchKind::modes;
  asked.stability = drawn == BranchKind::bifurcations;
  asked.located = drawn == BranchKind::peaks || drawn == BranchKind::folds;
  if constexpr (requires { range.resonance; })
    asked.located = asked.located && range.resonance == decltype(range.resonance)::amplitude;
  if constexpr (requires { range.stability; }) asked.stability = range.stability;
  if constexpr (requires { range.method; })  // of those that may have been refined in parts
    asked.order = scene.harmonics.accuracy > 0 && range.method != decltype(range.method)::shooting;
  if constexpr (requires { range.branches; }) {
    asked.leaving = range.branches == decltype(range.branches)::all;
    asked.stability = asked.stability || asked.leaving;
  }
  return asked;
}

/// Whether the accuracy of the branches depends on the harmonics.
template <class Range>
bool has_harmonics(const Range& range) {
  if constexpr (requires { range.method; }) return range.method != decltype(range.method)::shooting;
  return true;
}

/// Returns a range whose branches have what is read of them: with long steps, where that is events only. An
/// accuracy is that of all points, and a flat peak takes the estimates of its neighbours.
template <class Range>
Range as_read(Range range, const RunOptions& options, bool has_accuracy) {
  if constexpr (requires { range.steps; })
    if (options.events_only && !has_accuracy) range.steps = observables::Steps::events;
  if constexpr (requires { range.points; }) {
    if (!options.point_columns.empty() && !options.figures) {
      range.points = observables::needed_by(options.point_columns);
      range.points.maxima = false;  // of events alone
    }
    if (!options.event_columns.empty()) range.events = observables::needed_by(options.event_columns);
    if (!options.points && !options.figures && !options.motions) range.points = observables::solution_alone;
    range.events.estimates = range.events.estimates || has_accuracy;
    range.points.estimates = range.points.estimates || range.events.estimates;
  }
  return range;
}

/// follow(scene, range, control) returns the branches of one combination, over the parameter range.over, or
/// over the frequency if the Range has none. Responses get more harmonics only where they need them.
template <auto follow, BranchKind drawn, class Range>
std::unique_ptr<Computation> computed_branches(const scene::Scene& scene, const Range& range,
                                               const RunOptions& options) {
  using observables::ResponseBranch;
  using Branches = std::span<const ResponseBranch>;
  auto of = std::make_unique<ComputationOf<ResponseBranch>>(
      branches(scene, asked_for(drawn, scene, range), options),
      [range = as_read(range, options, scene.harmonics.accuracy > 0)](
          const Case& at, const control::Control& control) { return follow(at.scene, range, control); },
      [&scene](Branches branches) {
        std::vector<results::FigureData> figures{figures_of(scene, drawn, branches)};
        if (drawn == BranchKind::responses)
          for (results::FigureData& map : patch_maps(scene, branches)) figures.push_back(std::move(map));
        return figures;
      });
  if (has_harmonics(range))
    of->truncation_of_items = [](Branches branches) {
      return truncation_of(branches, drawn != BranchKind::modes);
    };
  if constexpr (std::is_same_v<Range, observables::FrequencyRange> ||
                std::is_same_v<Range, observables::ParameterRange>)
    of->refine_items = [range = as_read(range, options, true)](
                           const Case& at, Branches coarse, double accuracy,
                           const control::Control& control) -> std::optional<Refined<ResponseBranch>> {
      auto refined = observables::refined_response(at.scene, range, coarse, accuracy, control);
      if (!refined) return std::nullopt;
      return Refined<ResponseBranch>{std::move(refined->branches), refined->change};
    };
  return of;
}

}  // namespace arcslip::studies
