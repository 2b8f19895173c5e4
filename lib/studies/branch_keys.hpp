#pragma once
// The keys of studies that look at all branches of a frequency response.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <array>
#include <string>
#include <utility>

namespace arcslip::studies {

inline constexpr std::array<scene::file::Word<observables::Branches>, 2> branch_words = {
    {{"one", observables::Branches::one}, {"all", observables::Branches::all}}};

/// A limit of all branches; without them it is not written.
template <class Range>
scene::file::KeyGroup<Range> limit_of_branches(scene::file::KeyGroup<observables::BranchLimits> of) {
  auto group = scene::file::within(&Range::limits, std::move(of));
  group.write = [write = group.write](const Range& range, const scene::Scene& scene,
                                      scene::file::Node::Object& to) {
    if (range.branches == observables::Branches::all) write(range, scene, to);
  };
  return group;
}

/// Of a Range with members `branches` and `limits`.
template <class Range>
void add_branch_keys(scene::file::KeysOf<Range>& keys, std::string help) {
  using observables::BranchLimits;
  constexpr int most_doublings = 6, most_branches = 10'000, most_searches = 1000;
  keys.add(scene::file::word("branches", &Range::branches, branch_words, std::move(help)));
  keys.add(limit_of_branches<Range>(
      scene::file::whole("doublings", &BranchLimits::doublings, 0, most_doublings,
                         "with all branches: number of successive period doublings to follow")));
  keys.add(limit_of_branches<Range>(scene::file::whole("most_branches", &BranchLimits::most_branches, 1,
                                                       most_branches,
                                                       "with all branches: maximum number of branches")));
  keys.add(limit_of_branches<Range>(
      scene::file::whole("searches", &BranchLimits::searches, 0, most_searches,
                         "with all branches: number of frequencies at which to search for isolated branches, "
                         "between the first and the last one")));
}

}  // namespace arcslip::studies
