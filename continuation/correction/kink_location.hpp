#pragma once
// The kink at which a smooth piece of F ends, on a branch. Not installed.
//
// The end of the piece is bisected on the predicted branch, which costs only tests of the piece, and
// corrected onto the branch; this is repeated from there: section 8.7 of the theory.

#include <arcslip/continuation/correction/curve_point.hpp>

#include <functional>

namespace arcslip::continuation {

/// Whether the corrector's point v is still in the current smooth piece, or part.
using Inside = std::function<bool(const Vector& v)>;

/// The accuracy of a kink, of the search interval or of |u|: the finest, or where it only divides a curve.
inline constexpr double finest_kink = 1e-12, kink_of_curve = 1e-6;

/// Finds the end of the smooth piece of `from` along its tangent, within [0, length]: the kink, seen from
/// this side. last: the last correction. False if the piece does not end there, or a tangent on the way does
/// not exist. is_inside: none, or a criterion in place of the piece.
bool locate_kink(Corrector& with, const CurvePoint& from, double length, CurvePoint& kink, Correction& last,
                 const Inside& is_inside = {}, double accuracy = finest_kink);

}  // namespace arcslip::continuation
