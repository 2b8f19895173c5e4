#pragma once
// Checkpoint of a trace: all state that determines how it continues. A trace resumed from it continues bit
// for bit like the saved one, which saving does not affect.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/correction/curve_point.hpp>
#include <arcslip/continuation/problem/branch.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::continuation {

/// An event and its place.
struct LocatedEvent {
  Event event;
  CurvePoint place;
  double quantity = 0, rounding = 0;  // q and r of the quantity whose slope the monitor is
  Vector accepted{};                  // of one that was pending: the problem's state when it was located
};

/// The state of the quantity whose slope a monitor is.
struct Course {
  std::optional<double> last;  // at its last certain extremum, or at the start
  std::optional<LocatedEvent> waiting;
  int side = 1;  // of the pending extremum: +1 for a maximum, -1 for a minimum
};

struct State {
  Branch branch;
  int free = 0, direction = 1;
  Vector p;          // all parameters; the free one at its start value
  CurvePoint start;  // the first point
  CurvePoint here, before;
  Vector accepted;              // state of the problem that `here` left
  Vector left_at_start{};       // that of the first point
  double largest_accepted = 0;  // the largest norm of these states
  bool has_before = false;      // so that the cubic predictor applies
  bool begun = false, ended = false;
  double step = 0, last_step = 0;  // to try next; from `before` to `here`
  double curve_error = 0;          // of the curve there, relative to its tolerance
  int rejections = 0;              // since here.arclength passed trouble_end
  double trouble_end = -1;
  double unresolved_end = -1, unresolved_step = 0;  // a stretch whose slopes did not determine its quantities
  struct Turn {  // a rejected turn of the tangent: its angle, the step, and the arclength beyond it
    double angle = 0, step = 0, end = -1;
  } turn;
  struct Transverse {  // TransverseSpace, where the linear solver does not know the sign of the determinant
    Vector b, basis;   // its borders, and its basis here: columns of n + 1
  } transverse;
  std::vector<Course> courses;  // of the monitors
  double longest = 0;           // step so far
  int slow = 0;                 // number of slowly converging corrections
  std::string jacobian_doubt;   // the wrong entry of J
  double jacobian_error = 0;    // its relative error
  long expected = 0;         // points accepted by their expected error; -1: none, since one had a larger one
  bool factors_fit = false;  // the last factors can be used for the next correction
  FactorMemory factors;      // when the trace was saved
};

/// As JSON ("arcslip-state-1"), with numbers exact to the last bit.
std::string to_json(const State& state);

/// Throws std::invalid_argument, with the position, if the text is not a valid state.
State state_from_json(const std::string& text);

}  // namespace arcslip::continuation
