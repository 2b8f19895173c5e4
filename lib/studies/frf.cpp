#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/studies/branches.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/studies/study_of.hpp>

namespace arcslip::studies {
namespace {

using observables::FrequencyRange;
using observables::ResponseBranch;

scene::file::KeysOf<FrequencyRange> keys() {
  scene::file::KeysOf<FrequencyRange> keys;
  keys.add(scene::file::frequency_range(&FrequencyRange::from, &FrequencyRange::to));
  return keys;
}

}  // namespace

const scene::StudyType& frf() {
  static const StudyOf<FrequencyRange, ResponseBranch> type(
      {.name = "frf",
       .help = "frequency responses, with their peaks and folds",
       .keys = keys(),
       .compute =
           [](const Case& at, const FrequencyRange& range, const results::ProgressCallback& progress) {
             return observables::frequency_response(at.scene, range, progress);
           },
       .results = [](const scene::Scene& scene, const FrequencyRange&,
                     const scene::RunOptions& options) { return branches(scene, "", false, options); },
       .figures =
           [](const scene::Scene& scene, std::span<const ResponseBranch> branches) {
             return std::vector{figures_of(scene, BranchKind::responses, branches)};
           }});
  return type;
}

}  // namespace arcslip::studies
