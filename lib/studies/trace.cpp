#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/method_key.hpp>
#include <arcslip/studies/refined_in_parts.hpp>
#include <arcslip/studies/stability_keys.hpp>

namespace arcslip::studies {
namespace {

using observables::ParameterRange;

scene::file::KeysOf<ParameterRange> keys_of_trace() {
  scene::file::KeysOf<ParameterRange> keys;
  keys.add(scene::file::range_over(&ParameterRange::over, &ParameterRange::from, &ParameterRange::to));
  keys.add(scene::file::one_frequency(&ParameterRange::frequency, "the excitation frequency"));
  add_method_key(keys);
  add_stability_keys(keys, stability_help);
  keys.check(check_method<ParameterRange>);
  return keys;
}

}  // namespace

const scene::StudyType& trace() {
  static const StudyOf<ParameterRange, observables::ResponseBranch> type([] {
    auto kind = branch_kind<observables::parameter_response, BranchKind::over_parameter>(
        "trace", "responses over a parameter at a fixed frequency, with their extrema and folds",
        keys_of_trace());
    kind.refine = refined_in_parts<ParameterRange>;
    return kind;
  }());
  return type;
}

}  // namespace arcslip::studies
