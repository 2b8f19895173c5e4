#pragma once
// The equation w'(theta) = 0 of an angle by which a corner is reported.

#include <arcslip/laws/grazing_condition.hpp>

namespace arcslip::elements {

/// Of the range of a motion: reversals so close to the highest or lowest are next to be it.
inline constexpr double next_extreme = 1e-3;

/// The reversal next to theta: of maxima of sign w. False where there is none within 0.3 rad.
bool polish_reversal(const Harmonics& harmonics, In w, double sign, double& theta);

/// Row `row` of the equations: w' at angle number row - 1. The motion is all of its unknowns.
void set_reversal_row(const Harmonics& harmonics, const Corner& corner, In w, int row,
                      Corners::Equations& at);

}  // namespace arcslip::elements
