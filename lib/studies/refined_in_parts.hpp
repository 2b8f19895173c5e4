#pragma once
// KindOf::refine of studies of responses: more harmonics where they need them.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/studies/study_of.hpp>

#include <optional>
#include <span>
#include <utility>

namespace arcslip::studies {

template <class Range>
std::optional<Refined<observables::ResponseBranch>> refined_in_parts(
    const Case& at, const Range& range, std::span<const observables::ResponseBranch> coarse, double accuracy,
    const results::ProgressCallback& progress) {
  auto refined = observables::refined_response(at.scene, range, coarse, accuracy, progress);
  if (!refined) return std::nullopt;
  return Refined<observables::ResponseBranch>{std::move(refined->branches), refined->change};
}

}  // namespace arcslip::studies
