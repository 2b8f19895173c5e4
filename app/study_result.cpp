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

/// Hands visit the function that computes a study of this kind.
template <class Visit>
auto with_function(const scene::Study& study, const Visit& visit) {
  switch (study.kind) {
    case scene::StudyKind::trace:
      return visit(observables::parameter_response);
    case scene::StudyKind::peaks:
      return visit(observables::resonance_peaks);
    case scene::StudyKind::folds:
      return visit(observables::fold_curves);
    case scene::StudyKind::time:
      return visit(observables::motions_in_time);
    case scene::StudyKind::optimum:
      return study.along ? visit(optimize::optimum_curve_study) : visit(optimize::optimum_study);
    case scene::StudyKind::frf:
      break;
  }
  return visit(observables::frequency_response);
}

using studies::results_of;

template <class Of>  // optima, curves of them
results::Results results_of(const scene::Scene& scene, std::span<const Of> all,
                            const studies::Detail& /*detail*/) {
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

StudyResult compute(const scene::Scene& scene, const scene::Study& study, const studies::Detail& detail,
                    bool figures, const observables::ProgressCallback& progress) {
  return with_function(study, [&](auto& function) {
    auto items = function(scene, study, progress);
    for (auto& item : items) {
      item.study = study.name;
      item.kind = scene::kind_name(study.kind);
    }
    const std::span<const typename decltype(items)::value_type> all = items;
    return StudyResult{results_of(scene, all, detail),
                       figures ? figures_of(scene, study.kind, all) : std::vector<FigureData>()};
  });
}

std::string list_of(const scene::Scene& scene, const scene::Study& study) {
  return with_function(study, [&](auto& function) {
    using Items = decltype(function(scene, study, observables::ProgressCallback()));
    const std::span<const typename Items::value_type> none;
    return results_of(scene, none, studies::Detail{}).schemas.front().list;
  });
}

}  // namespace arcslip::app
