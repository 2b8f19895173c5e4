#pragma once
// The equations of a periodic motion, for a state X = (x, x', z) at the start of its period:
//
//   F(X) = Phi(X) - X = 0,   dF/dX = M - I,   M = dPhi/dX
//
// A slider that rests throughout gives z = z: its row is that of its offset, in place of Phi (RestingSlider).

#include <arcslip/time/equation/period_map.hpp>

#include <complex>
#include <vector>

namespace arcslip::time {

/// (x, x', z) in one vector.
Vector stacked(const MotionState& state);
MotionState unstacked(continuation::In X, Eigen::Index dofs);

/// F at X, where `map` starts.
void defect_of(const PeriodMap& map, continuation::In X, Vector& F);

/// dF/dX there.
void defect_by_start(const PeriodMap& map, Matrix& J);

/// The eigenvalues of M without the sliders that rest throughout, by falling modulus.
std::vector<std::complex<double>> multipliers_of(const PeriodMap& map);

}  // namespace arcslip::time
