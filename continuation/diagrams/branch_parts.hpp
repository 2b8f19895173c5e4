#pragma once
// Assembly of the branches of a diagram from traces: reverse, shift, append, cut.

#include <arcslip/continuation/problem/branch.hpp>

namespace arcslip::continuation {

/// (u, p), n + 1
Vector joined(const Vector& u, double parameter);

/// A branch point where smooth branches cross.
bool simple(const Event& event);

/// Reverses the order of points and events and the sign of the arclength. The last points of ranges of
/// stability have spectra that are counts.
void reverse(Branch& branch);

/// Adds to the arclength of all points and events.
void shift(Branch& branch, double arclength);

/// Appends `next`, which continues `branch` from its end.
void append(Branch& branch, Branch&& next);

/// Sets Event::after of all events.
void number(Branch& branch);

/// Drops the last point but one if it equals the last one to rounding, as when a trace starts at a bound.
void drop_empty_step(Branch& branch);

/// Cuts a loop from a branch point back to it at `end`: drops the part beyond. miss, reach: of its stop.
void cut(Branch& branch, const Event& end, double miss, double reach);

}  // namespace arcslip::continuation
