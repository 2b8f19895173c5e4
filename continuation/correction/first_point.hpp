#pragma once
// The first point of a branch, from a guess that may be far from it. Not installed.
//
// Newton's method is tried with the natural test (corrector.hpp), then without any, since it may have to pass
// points with larger corrections; then pseudo-transient continuation (pseudo_transient.hpp) in both
// directions of time. The solution that is found need not be the nearest one.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/problem/options.hpp>

#include <string>

namespace arcslip::continuation {

struct FirstPoint {
  Correction correction;    // to the solution; where none is found, that of the first try
  std::string failure;      // Corrector::failure() of that
  bool is_stopped = false;  // by the control, before any other try
};

/// v: n + 1, the guess (u, p), becomes the solution at the same p; where none is found, the place where the
/// first try ended. row: the unit vector of p.
FirstPoint first_point(const Problem& problem, Corrector& with, const Options& options,
                       const control::Control& control, const Vector& row, Vector& v);

}  // namespace arcslip::continuation
