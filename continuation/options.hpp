#pragma once
// Settings of a trace. All have defaults; check() says what is out of bounds.

namespace arcslip::continuation {

struct NewtonOptions {
  double tolerance = 1e-9;  // of the last correction, relative to |u| in scales; the error left is its square
  double rounding_level =
      1e-7;            // a correction that stagnates below this is accepted as rounding; >= tolerance
  int iterations = 8;  // at most
  double chord_contraction = 0.3;  // factors are kept while corrections shrink at least so fast; in [0, 1)
};

struct StepOptions {
  double initial = 0;             // first step in scaled arclength; 0: chosen from `largest_parameter`
  double smallest = 1e-10;        // relative to 1 + |u| in scales
  double largest_parameter = 0;   // |dp| of a step; 0: a hundredth of the window
  double relative_parameter = 0;  // |dp| <= relative_parameter * |p|; 0: no such limit
  double relative_state = 0.5;    // |du| <= relative_state * (1 + |u|), in scales; > 0
  double angle = 0.2;             // rad between the tangents of neighbouring points, aimed at
  double largest_angle = 0.6;     // rad; more is a jump to another branch, unless it is a kink
  double contraction = 0.3;       // of the corrector's first two corrections, aimed at
};

struct Options {
  double lower = 0, upper = 0;  // window of the free parameter, lower < upper
  NewtonOptions newton{};
  StepOptions step{};
  long points = 100000;            // at most
  double largest_state = 1e12;     // |u| in scales
  double event_tolerance = 1e-12;  // relative, of the free parameter at an event
};

/// Throws std::invalid_argument with the value and its bound.
void check(const Options& options);

}  // namespace arcslip::continuation
