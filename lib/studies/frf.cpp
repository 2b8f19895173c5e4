#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>

namespace arcslip::studies {
namespace {

using observables::FrequencyRange;

scene::file::KeysOf<FrequencyRange> keys() {
  scene::file::KeysOf<FrequencyRange> keys;
  keys.add(scene::file::frequency_range(&FrequencyRange::from, &FrequencyRange::to));
  keys.add(scene::file::flag("stability", &FrequencyRange::stability, stability_help));
  return keys;
}

}  // namespace

const scene::StudyType& frf() {
  static const StudyOf<FrequencyRange, observables::ResponseBranch> type(
      branch_kind<observables::frequency_response, BranchKind::responses>(
          "frf", "frequency responses, with their peaks and folds", keys()));
  return type;
}

}  // namespace arcslip::studies
