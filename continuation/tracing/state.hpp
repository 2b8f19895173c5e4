#pragma once
// Where a trace stands: all that decides how it goes on. Resumed from it, a trace goes on bit for bit as the
// one that was saved, which saving does not change.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/tracing/corrector.hpp>
#include <arcslip/continuation/tracing/place.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::continuation {

/// An event, and the place where it is.
struct LocatedEvent {
  Event event;
  Place place;
  double quantity = 0, rounding = 0;  // of what the monitor is the slope of: q and r
};

/// What is known of the quantity whose slope a monitor is.
struct Course {
  std::optional<double> last;  // at its last certain extreme, or at the start
  std::optional<LocatedEvent> waiting;
  int side = 1;  // of the waiting one: +1 for a maximum, -1 for a minimum
};

struct State {
  Branch branch;
  int free = 0, direction = 1;
  Vector p;     // all parameters; the free one as at the start
  Place start;  // the first point
  Place here, before;
  bool has_before = false;  // so that a cubic leads on
  bool begun = false, ended = false;
  double step = 0, last_step = 0;  // to be tried next; from `before` to `here`
  double curve_error = 0;          // of the curve there, over that allowed
  int rejections = 0;              // since here.arclength passed trouble_end
  double trouble_end = -1;
  double unresolved_end = -1, unresolved_step = 0;  // a stretch whose slopes did not tell its quantities
  struct Turn {  // a turn of the tangent that was rejected: how much, over which step, and where it is passed
    double angle = 0, step = 0, end = -1;
  } turn;
  std::vector<Course> courses;  // of the monitors
  double longest = 0;           // of the steps so far
  int slow = 0;                 // corrections that did not converge as Newton's method does
  std::string jacobian_doubt;   // the entry of J that was found to be wrong
  double jacobian_error = 0;    // its relative error
  bool factors_fit = false;     // those of the last correction serve the next one
  FactorMemory factors;         // as the trace was saved
};

/// As JSON ("arcslip-state-1"): every number to its last bit.
std::string to_json(const State& state);

/// Throws std::invalid_argument where the text is not that of a state, and says where it fails.
State state_from_json(const std::string& text);

}  // namespace arcslip::continuation
