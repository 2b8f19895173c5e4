// Curves of resonance peaks and of folds, which differ only in the points they continue.
#include <arcslip/observables/curves.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>

namespace arcslip::studies {
namespace {

using observables::CurveRange;

scene::file::KeysOf<CurveRange> keys() {
  scene::file::KeysOf<CurveRange> keys;
  keys.add(scene::file::range_over(&CurveRange::over, &CurveRange::from, &CurveRange::to));
  keys.add(scene::file::window(&CurveRange::frequency_from, &CurveRange::frequency_to));
  keys.add(scene::file::flag("stability", &CurveRange::stability, stability_of_points_help));
  return keys;
}

}  // namespace

const scene::StudyType& peaks() {
  static const StudyOf<CurveRange, observables::ResponseBranch> type(
      branch_kind<observables::resonance_peaks, BranchKind::peaks>(
          "peaks", "resonance peaks over a parameter, with their minima and maxima", keys()));
  return type;
}

const scene::StudyType& folds() {
  static const StudyOf<CurveRange, observables::ResponseBranch> type(
      branch_kind<observables::fold_curves, BranchKind::folds>(
          "folds", "folds of the frequency response over a parameter, with their cusps", keys()));
  return type;
}

}  // namespace arcslip::studies
