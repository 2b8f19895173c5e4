#include <arcslip/observables/curves.hpp>
#include <arcslip/studies/branches.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/studies/study_of.hpp>

namespace arcslip::studies {
namespace {

using observables::ParameterRange;
using observables::ResponseBranch;

scene::file::KeysOf<ParameterRange> keys() {
  scene::file::KeysOf<ParameterRange> keys;
  keys.add(scene::file::range_over(&ParameterRange::over, &ParameterRange::from, &ParameterRange::to));
  keys.add(scene::file::one_frequency(&ParameterRange::frequency, "the frequency"));
  return keys;
}

}  // namespace

const scene::StudyType& trace() {
  static const StudyOf<ParameterRange, ResponseBranch> type(
      {.name = "trace",
       .help = "responses over a parameter at a fixed frequency, with their extremes and folds",
       .keys = keys(),
       .compute =
           [](const Case& at, const ParameterRange& range, const results::ProgressCallback& progress) {
             return observables::parameter_response(at.scene, range, progress);
           },
       .results =
           [](const scene::Scene& scene, const ParameterRange& range, const scene::RunOptions& options) {
             return branches(scene, range.over, false, options);
           },
       .figures =
           [](const scene::Scene& scene, std::span<const ResponseBranch> branches) {
             return std::vector{figures_of(scene, BranchKind::over_parameter, branches)};
           }});
  return type;
}

}  // namespace arcslip::studies
