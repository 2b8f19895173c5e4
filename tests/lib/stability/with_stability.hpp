#pragma once
// Frequency responses with stability.

#include "catch.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>

#include <string>
#include <vector>

namespace with_stability {

using namespace arcslip;
using observables::ResponseBranch, observables::ResponseEvent;

inline std::vector<ResponseEvent> events(const ResponseBranch& branch, const std::string& kind) {
  std::vector<ResponseEvent> found;
  for (const auto& event : branch.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

inline ResponseBranch response(const scene::Scene& s, double from, double to) {
  const auto branches = observables::frequency_response(s, {from, to, true});
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  return branches[0];
}

}  // namespace with_stability
