// Curves of resonance peaks and of folds, which differ in what they follow alone.
#include <arcslip/observables/curves.hpp>
#include <arcslip/studies/branches.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/studies/study_of.hpp>

namespace arcslip::studies {
namespace {

using observables::CurveRange;
using observables::ResponseBranch;

scene::file::KeysOf<CurveRange> keys() {
  scene::file::KeysOf<CurveRange> keys;
  keys.add(scene::file::range_over(&CurveRange::over, &CurveRange::from, &CurveRange::to));
  keys.add(scene::file::window(&CurveRange::frequency_from, &CurveRange::frequency_to));
  return keys;
}

}  // namespace

const scene::StudyType& peaks() {
  static const StudyOf<CurveRange, ResponseBranch> type(
      {.name = "peaks",
       .help = "resonance peaks over a parameter, with the least and the greatest",
       .keys = keys(),
       .compute =
           [](const Case& at, const CurveRange& range, const results::ProgressCallback& progress) {
             return observables::resonance_peaks(at.scene, range, progress);
           },
       .results = [](const scene::Scene& scene, const CurveRange& range,
                     const scene::RunOptions& options) { return branches(scene, range.over, true, options); },
       .figures =
           [](const scene::Scene& scene, std::span<const ResponseBranch> branches) {
             return std::vector{figures_of(scene, BranchKind::peaks, branches)};
           }});
  return type;
}

const scene::StudyType& folds() {
  static const StudyOf<CurveRange, ResponseBranch> type(
      {.name = "folds",
       .help = "folds of the frequency response over a parameter, with their cusps",
       .keys = keys(),
       .compute =
           [](const Case& at, const CurveRange& range, const results::ProgressCallback& progress) {
             return observables::fold_curves(at.scene, range, progress);
           },
       .results = [](const scene::Scene& scene, const CurveRange& range,
                     const scene::RunOptions& options) { return branches(scene, range.over, true, options); },
       .figures =
           [](const scene::Scene& scene, std::span<const ResponseBranch> branches) {
             return std::vector{figures_of(scene, BranchKind::folds, branches)};
           }});
  return type;
}

}  // namespace arcslip::studies
