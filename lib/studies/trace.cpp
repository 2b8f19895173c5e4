#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/method_key.hpp>
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

const StudyKind& trace() {
  static const StudyKind kind(
      {.name = "trace",
       .help = "responses over a parameter at a fixed frequency, with their extrema and folds"},
      keys_of_trace(),
      computed_branches<observables::parameter_response, BranchKind::over_parameter, ParameterRange>);
  return kind;
}

}  // namespace arcslip::studies
