#pragma once
// The branches that are timed against AUTO-07p, in the same windows and with analytic derivatives in both.

#include <arcslip/continuation/tracing/tracer.hpp>

#include <string>

namespace arcslip::bench {

/// One branch, ready to trace. `folds`: how many it has.
struct Case {
  std::shared_ptr<const continuation::Problem> problem;
  continuation::Start start;
  continuation::Options options;
  std::size_t folds = 0;
};

/// cusp, ab, freudenstein_roth, chan (100 nodes), or duffing/N: harmonic balance with N harmonics. Throws
/// std::invalid_argument where the name is none of them.
Case branch_case(const std::string& name);

}  // namespace arcslip::bench
