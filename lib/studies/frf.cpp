#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/method_key.hpp>
#include <arcslip/studies/refined_in_parts.hpp>
#include <arcslip/studies/stability_keys.hpp>

#include <array>

namespace arcslip::studies {
namespace {

using observables::Branches;
using observables::BranchLimits;
using observables::FrequencyRange;
using observables::ResponseMethod;

constexpr int most_doublings = 6, most_branches = 10'000, most_searches = 1000;

constexpr std::array<scene::file::Word<Branches>, 2> branch_words = {
    {{"one", Branches::one}, {"all", Branches::all}}};

// Shooting follows one branch.
void check_shooting(const scene::file::Reading& reading, FrequencyRange& range) {
  check_method(reading, range);
  if (range.method == ResponseMethod::shooting && range.branches == Branches::all)
    reading.faults.add(reading.keys.find("branches").pointer,
                       "found \"all\" beside the method \"shooting\", which follows one branch");
}

/// A limit of all branches; without them it is not written.
scene::file::KeyGroup<FrequencyRange> limit(scene::file::KeyGroup<BranchLimits> of) {
  auto group = scene::file::within(&FrequencyRange::limits, std::move(of));
  group.write = [write = group.write](const FrequencyRange& range, const scene::Scene& scene,
                                      scene::file::Node::Object& to) {
    if (range.branches == Branches::all) write(range, scene, to);
  };
  return group;
}

scene::file::KeysOf<FrequencyRange> keys_of_frf() {
  scene::file::KeysOf<FrequencyRange> keys;
  keys.add(scene::file::frequency_range(&FrequencyRange::from, &FrequencyRange::to));
  add_method_key(keys);
  add_stability_keys(keys, stability_help);
  keys.add(
      scene::file::word("branches", &FrequencyRange::branches, branch_words,
                        "the branch that begins at the first frequency, or also those that leave it at "
                        "breaks of symmetry, period doublings and branch points, those that leave these, "
                        "and so on"));
  keys.add(limit(scene::file::whole("doublings", &BranchLimits::doublings, 0, most_doublings,
                                    "with all branches: how many period doublings in a row are followed")));
  keys.add(limit(scene::file::whole("most_branches", &BranchLimits::most_branches, 1, most_branches,
                                    "with all branches: how many are traced at most")));
  keys.add(limit(scene::file::whole("searches", &BranchLimits::searches, 0, most_searches,
                                    "with all branches: at how many frequencies between the first and the "
                                    "last one branches that no other reaches are looked for")));
  keys.check(check_shooting);
  return keys;
}

KindOf<FrequencyRange, observables::ResponseBranch> kind() {
  auto kind = branch_kind<observables::frequency_response, BranchKind::responses>(
      "frf", "frequency responses, with their peaks and folds", keys_of_frf());
  kind.refine = refined_in_parts<FrequencyRange>;
  return kind;
}

}  // namespace

const scene::StudyType& frf() {
  static const StudyOf<FrequencyRange, observables::ResponseBranch> type(kind());
  return type;
}

}  // namespace arcslip::studies
