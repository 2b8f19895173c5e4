#include <arcslip/observables/curves.hpp>
#include <arcslip/optimize/design_space.hpp>
#include <arcslip/optimize/optimum.hpp>
#include <arcslip/optimize/text.hpp>

namespace arcslip::optimize {

DirectOptimum direct_optimum(const scene::Scene& scene, const OptimumProblem& problem) {
  if (problem.over.size() != 1)
    throw OptionsError(text("the direct way is over one parameter, not ", problem.over.size()));
  if (!problem.cases.empty() || !problem.scatter.empty())
    throw OptionsError("the direct way takes no cases, and nothing that scatters");
  const DesignSpace space(scene, problem);
  scene::Study study;
  study.kind = scene::StudyKind::peaks;
  study.over = problem.over[0].name;
  study.from = problem.over[0].lower;
  study.to = problem.over[0].upper;
  study.frequency_from = problem.frequency_from;
  study.frequency_to = problem.frequency_to;
  DirectOptimum result;
  result.curves = observables::resonance_peaks(scene, study);
  for (const auto& curve : result.curves)
    for (const auto& event : curve.events)
      if (event.kind == "minimum" && (!result.found || event.point.amplitude < result.point.amplitude)) {
        result.found = true;
        result.point = event.point;
      }
  if (!result.found)
    result.message =
        "no curve of peaks has a minimum within the bounds; " + result.curves.front().stop.message;
  return result;
}

}  // namespace arcslip::optimize
