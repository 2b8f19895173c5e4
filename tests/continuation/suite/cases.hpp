#pragma once
// The problems of the suite with a start, a window and the folds that are known.

#include "continuation/suite/problems.hpp"

#include <arcslip/continuation/tracing/tracer.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suite {

using arcslip::continuation::Branch;
using arcslip::continuation::Event;
using arcslip::continuation::Options;
using arcslip::continuation::Start;

struct Case {
  std::string name;
  ProblemPtr problem;
  Start start;  // direction included
  double lower = 0, upper = 0;
  std::optional<std::vector<double>> folds = {};  // of the free parameter, in the order of the branch
  double digits = 0;                              // a unit of the last digit given: sources cut or round
  bool branch_points = false;                     // the branch crosses others
};

Options window(double lower, double upper);

/// Every case; those of continuation.json first.
std::vector<Case> cases();

/// The case of that name.
Case named(const std::string& name);

/// Traces with the fold monitor.
Branch trace(const Case& c);
Branch trace(const Case& c, const Options& options);

std::vector<Event> folds(const Branch& branch);

}  // namespace suite
