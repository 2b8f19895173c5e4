#pragma once
// The kinds of studies that trace branches of responses; they differ in their keys and in the curves
// they trace.

#include <arcslip/studies/presentation/branches.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/study_of.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::studies {

/// follow(scene, range, progress) returns the branches of one combination, over the parameter range.over, or
/// over the frequency if the Range has none.
template <auto follow, BranchKind drawn, class Range>
KindOf<Range, observables::ResponseBranch> branch_kind(std::string_view name, std::string_view help,
                                                       scene::file::KeysOf<Range> keys) {
  using Branches = std::span<const observables::ResponseBranch>;
  return {
      .name = name,
      .help = help,
      .keys = std::move(keys),
      .compute = [](const Case& at, const Range& range,
                    const results::ProgressCallback& progress) { return follow(at.scene, range, progress); },
      .results =
          [](const scene::Scene& scene, const Range& range, const scene::RunOptions& options) {
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
            if constexpr (requires { range.method; })  // of those that refined_in_parts() may have made
              asked.order = scene.harmonics.accuracy > 0 && range.method != decltype(range.method)::shooting;
            if constexpr (requires { range.branches; }) {
              asked.leaving = range.branches == decltype(range.branches)::all;
              asked.stability = asked.stability || asked.leaving;
            }
            return branches(scene, asked, options);
          },
      .figures = [](const scene::Scene& scene,
                    Branches branches) { return std::vector{figures_of(scene, drawn, branches)}; },
      .truncation = [](const Range& range, Branches branches) -> std::optional<Truncation> {
        if constexpr (requires { range.method; })
          if (range.method == decltype(range.method)::shooting) return std::nullopt;
        return truncation_of(branches, drawn != BranchKind::modes);
      }};
}

}  // namespace arcslip::studies
