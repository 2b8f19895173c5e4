#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/optimize/certificate/multipliers.hpp>
#include <arcslip/optimize/evaluation/design_space.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace arcslip::optimize {

using continuation::text;
namespace {

constexpr double least_peak = 0.3;  // of the highest peak: lower ones are not followed

// Of the curves of the result. Where another peak is higher at one, a sentence about it.
std::string least_minimum(const scene::Scene& scene, const OptimumProblem& problem, const DesignSpace& space,
                          control::Control control, DirectOptimum& result) {
  const double unit = scene::to_rad_per_s(scene.frequency_unit);
  PeakAmplitude peaks(space.model(), space.parameters(),
                      {problem.frequency_from * unit, problem.frequency_to * unit}, std::move(control));
  std::string higher;
  for (const auto& curve : result.curves)
    for (const auto& event : curve.events) {
      if (event.kind != observables::event_kinds::minimum ||
          (result.found && event.point.amplitude >= result.point.amplitude))
        continue;
      const double highest = peaks.trace(std::span(&event.point.over, 1)).amplitude();
      if (!(highest > (1 + as_high) * event.point.amplitude)) {
        result.found = true;
        result.point = event.point;
      } else if (higher.empty()) {
        higher = text("a curve of peaks has a minimum of ", event.point.amplitude, " m at ",
                      problem.over[0].name, " = ", event.point.over, ", where the largest amplitude is ",
                      highest, " m: another peak is higher there");
      }
    }
  return higher;
}

// Each sample that sticks or slips is a kink of a response: no curve of peaks is smooth.
bool has_sampled_friction(const scene::Scene& scene) {
  const bool slides = !scene.patches.empty() || std::any_of(scene.elements.begin(), scene.elements.end(),
                                                            observables::is_friction_part);
  return slides && scene.harmonics.friction == scene::Friction::sampled;
}

}  // namespace

std::vector<observables::ResponseBranch> curves_of_peaks(const scene::Scene& scene,
                                                         const OptimumProblem& problem,
                                                         const control::Control& control) {
  if (has_sampled_friction(scene)) return {};
  const DesignVariable& over = problem.over.front();
  return observables::high_resonance_peaks(
      scene, {over.name, over.lower, over.upper, problem.frequency_from, problem.frequency_to}, least_peak,
      control);
}

DirectOptimum direct_optimum(const scene::Scene& scene, const OptimumProblem& problem,
                             const control::Control& control) {
  if (problem.over.size() != 1)
    throw OptionsError(text("the direct method requires one design parameter, not ", problem.over.size()));
  if (!problem.cases.empty() || !problem.scatter.empty())
    throw OptionsError("the direct method supports neither cases nor scatter");
  const DesignSpace space(scene, problem);
  DirectOptimum result;
  if (has_sampled_friction(scene)) {
    result.message =
        "curves of peaks are continued with exact friction only: with sampled friction a response has a kink "
        "wherever a sample changes between stick and slip";
    return result;
  }
  result.curves = curves_of_peaks(scene, problem, control);
  std::string higher;
  try {
    higher = least_minimum(scene, problem, space, control, result);
  } catch (const Interrupted&) {
  }
  if (control.ending().reason != control::EndReason::none) {
    result.found = false;
    result.message = "stopped by the caller";
  } else if (!result.found) {
    result.message = !higher.empty() ? higher
                                     : "no curve of peaks has a minimum within the bounds; " +
                                           result.curves.front().stop.message;
  }
  return result;
}

}  // namespace arcslip::optimize
