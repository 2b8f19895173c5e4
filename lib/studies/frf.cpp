#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/studies/branch_keys.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/method_key.hpp>
#include <arcslip/studies/stability_keys.hpp>

namespace arcslip::studies {
namespace {

using observables::Branches;
using observables::FrequencyRange;
using observables::ResponseMethod;

// Shooting follows one branch.
void check_shooting(const scene::file::Reading& reading, FrequencyRange& range) {
  check_method(reading, range);
  if (range.method == ResponseMethod::shooting && range.branches == Branches::all)
    reading.faults.add(reading.keys.find("branches").pointer,
                       "found \"all\" next to the method \"shooting\", which follows one branch");
}

scene::file::KeysOf<FrequencyRange> keys_of_frf() {
  scene::file::KeysOf<FrequencyRange> keys;
  keys.add(scene::file::frequency_range(&FrequencyRange::from, &FrequencyRange::to));
  add_method_key(keys);
  add_stability_keys(keys, stability_help);
  add_branch_keys(keys,
                  "the branch that begins at the first frequency, or also all that leave it, directly or "
                  "through others, at symmetry breaking, period doublings and branch points");
  keys.check(check_shooting);
  return keys;
}

}  // namespace

const StudyKind& frf() {
  static const StudyKind kind(
      {.name = "frf", .help = "frequency responses, with their peaks and folds"}, keys_of_frf(),
      computed_branches<observables::frequency_response, BranchKind::responses, FrequencyRange>);
  return kind;
}

}  // namespace arcslip::studies
