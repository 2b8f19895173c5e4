#pragma once
// Branches of a diagram put together from their traces: turned, shifted, joined, cut.

#include <arcslip/continuation/problem/branch.hpp>

namespace arcslip::continuation {

/// (u, p), n + 1
Vector joined(const Vector& u, double parameter);

/// A branch point where smooth branches cross.
bool simple(const Event& event);

/// From its end to its beginning, with arclength of the other sign.
void reverse(Branch& branch);

/// Adds to the arclength of all points and events.
void shift(Branch& branch, double arclength);

/// `next` goes on where `branch` ends.
void append(Branch& branch, Branch&& next);

/// Event::after of all events.
void number(Branch& branch);

/// Drops the last point but one where it is the last but for rounding, as where a trace begins at a bound.
void drop_empty_step(Branch& branch);

/// A loop from a branch point back to it, `end`: what was traced beyond is dropped. miss, reach: of its stop.
void cut(Branch& branch, const Event& end, double miss, double reach);

}  // namespace arcslip::continuation
