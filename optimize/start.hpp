#pragma once
// Where a search begins. Not installed.

#include <arcslip/optimize/trials.hpp>
#include <arcslip/results/reason.hpp>

#include <string>
#include <vector>

namespace arcslip::optimize {

/// What is wrong with a design as a start. Reason unbounded, no_response or flat (no parameter moves the
/// amplitude, since no friction element slips); none: nothing.
struct Fault {
  results::Reason reason;
  std::string message;
};

struct Start {
  bool found = false;
  std::vector<double> design;  // where the cases stand then
  Fault fault;                 // of the design that was asked for
};

/// A design at which V is finite and the parameters change it: the one given, or one on the diagonal of the
/// bounds, which is noted. None is found within an interruption.
Start find_start(Trials& trials, const std::vector<double>& given, std::vector<std::string>& notes);

}  // namespace arcslip::optimize
