#pragma once
// Why the engine ended a branch, as one of the reasons of results.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/results/reason.hpp>

namespace arcslip::observables {

/// The reason with the code name(reason).
results::Reason reason_of(continuation::StopReason reason);

}  // namespace arcslip::observables
