#include "study_result.hpp"

#include <arcslip/observables/curves.hpp>
#include <arcslip/observables/time_study.hpp>
#include <arcslip/optimize/optimum_figures.hpp>
#include <arcslip/optimize/optimum_results.hpp>
#include <arcslip/studies/branches.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/studies/motions.hpp>

#include <span>

namespace arcslip::app {
namespace {

using observables::Motion;
using observables::ResponseBranch;
using optimize::OptimumCurveResult;
using optimize::OptimumResult;
using results::FigureData;

/// Hands a study to the function of its kind, and what that gives to visit.
template <class Visit>
auto computed(const scene::Scene& scene, const scene::Study& study,
              const observables::ProgressCallback& progress, const Visit& visit) {
  switch (study.kind) {
    case scene::StudyKind::trace:
      return visit(observables::parameter_response(scene, study, progress));
    case scene::StudyKind::peaks:
      return visit(observables::resonance_peaks(scene, study, progress));
    case scene::StudyKind::folds:
      return visit(observables::fold_curves(scene, study, progress));
    case scene::StudyKind::time:
      return visit(observables::motions_in_time(scene, study, progress));
    case scene::StudyKind::optimum:
      if (study.along) {
        return visit(optimize::optimum_curve_study(scene, study, progress));
      }
      return visit(optimize::optimum_study(scene, study, progress));
    case scene::StudyKind::frf:
      break;
  }
  return visit(observables::frequency_response(scene, study, progress));
}

results::Results results_of(const scene::Scene& scene, std::span<const ResponseBranch> branches,
                            bool coefficients) {
  return studies::results_of(scene, branches, {coefficients});
}

results::Results results_of(const scene::Scene& scene, std::span<const Motion> motions,
                            bool /*coefficients*/) {
  return studies::results_of(scene, motions);
}

template <class Of>  // optima, curves of them
results::Results results_of(const scene::Scene& scene, std::span<const Of> all, bool /*coefficients*/) {
  return optimize::results_of(scene, all);
}

std::vector<FigureData> figures_of(const scene::Scene& scene, scene::StudyKind kind,
                                   std::span<const ResponseBranch> branches) {
  return {studies::figures_of(scene, kind, branches)};
}

std::vector<FigureData> figures_of(const scene::Scene& scene, scene::StudyKind /*kind*/,
                                   std::span<const Motion> motions) {
  return {studies::figures_of(scene, motions)};
}

std::vector<FigureData> figures_of(const scene::Scene& scene, scene::StudyKind /*kind*/,
                                   std::span<const OptimumResult> optima) {
  return optimize::figures_of(scene, optima);
}

std::vector<FigureData> figures_of(const scene::Scene& scene, scene::StudyKind /*kind*/,
                                   std::span<const OptimumCurveResult> curves) {
  return {optimize::figures_of(scene, curves)};
}

}  // namespace

StudyResult compute(const scene::Scene& scene, const scene::Study& study, bool coefficients, bool figures,
                    const observables::ProgressCallback& progress) {
  return computed(scene, study, progress, [&](auto items) {
    for (auto& item : items) {
      item.study = study.name;
      item.kind = scene::kind_name(study.kind);
    }
    const std::span<const typename decltype(items)::value_type> all = items;
    return StudyResult{results_of(scene, all, coefficients),
                       figures ? figures_of(scene, study.kind, all) : std::vector<FigureData>()};
  });
}

std::string list_of(const scene::Study& study) {
  switch (study.kind) {
    case scene::StudyKind::time:
      return "motions";
    case scene::StudyKind::optimum:
      return study.along ? "optimum_curves" : "optima";
    default:
      return "branches";
  }
}

}  // namespace arcslip::app
