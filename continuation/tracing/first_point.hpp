#pragma once
// The first point of a branch, from a guess that may be far from it. Not installed.
//
// Newton's method is tried with the natural test (corrector.hpp), then without any, since it may have to pass
// points with larger corrections; then pseudo-transient continuation (pseudo_transient.hpp) in both
// directions of time. The solution that is found need not be the nearest one.

#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/corrector.hpp>

namespace arcslip::continuation {

/// v: n + 1, the guess (u, p), becomes the solution at the same p; where none is found it is the guess, and
/// the result is that of the first try. row: the unit vector of p. options: newton and go_on, which ends the
/// search when it returns false.
Correction first_point(const Problem& problem, Corrector& with, const Options& options, const Vector& row,
                       Vector& v);

}  // namespace arcslip::continuation
