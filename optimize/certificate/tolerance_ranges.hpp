#pragma once
// The tolerance ranges of an optimum. Not installed.
//
// Each end is where V is (1 + share) V_opt, or the limit or bound that comes first, by peaks that are
// tracked. Where new responses at the end or on the way to it show that one was lost, by new responses alone.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/certificate/certificate.hpp>
#include <arcslip/optimize/evaluation/load_cases.hpp>

#include <functional>
#include <span>
#include <vector>

namespace arcslip::optimize {

/// Adds ranges to the certificate, by its curvature, and lower_design. The cases are at the optimum, and move
/// to other designs. lower to control: as of certify().
void add_ranges(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                const std::function<double()>& margin, const control::Control& control,
                Certificate& certificate);

}  // namespace arcslip::optimize
