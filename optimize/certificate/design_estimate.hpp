#pragma once
// How far the harmonics left out may move the optimum, to first order. With more harmonics the active peaks
// have the amplitudes A_i + dA_i (observables/truncation.hpp), and the conditions of the minimum
//
//   sum_i mu_i w_i d(A_i + dA_i)/dp = 0,   w_i (A_i + dA_i) = tau_g,   sum_i mu_i = 1 in each group g
//
// hold at p + dp with
//
//   sum_i mu_i w_i H_i dp + sum_i dmu_i w_i g_i = -sum_i mu_i w_i d(dA_i)/dp
//   w_i g_i . dp - dtau_g = -w_i dA_i,   sum_i dmu_i = 0
//
// where g_i and H_i are the derivatives of A_i, and parameters at a bound stay there. Not installed.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/certificate/multipliers.hpp>

#include <vector>

namespace arcslip::optimize {

struct DesignEstimate {
  std::vector<double> change;  // |dp|, in the units of the parameters; empty: not known, as at a kink, where
                               // a limit is active, or where the equations are singular
  bool flagged = false;        // the estimate may be too low
};

/// At the current design of the cases, with its balance. control: asked before each derivative; at its
/// end the estimate is not known.
DesignEstimate design_estimate(const LoadCases& cases, const Balance& balance,
                               const control::Control& control = {});

}  // namespace arcslip::optimize
