#include <arcslip/continuation/problem/options.hpp>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace arcslip::continuation {
namespace {

void require(bool holds, const char* what, double value, const char* bound) {
  if (holds) return;
  std::ostringstream text;
  text.precision(17);
  text << what << " is " << value << ", must be " << bound;
  throw std::invalid_argument(text.str());
}

}  // namespace

const char* name(Rejected why) {
  switch (why) {
    case Rejected::not_converged:
      return "not_converged";
    case Rejected::not_evaluated:
      return "not_evaluated";
    case Rejected::singular:
      return "singular";
    case Rejected::turn:
      return "turn";
    case Rejected::another_branch:
      return "another_branch";
    case Rejected::branch_points:
      return "branch_points";
    case Rejected::parameter_step:
      return "parameter_step";
    case Rejected::curve:
      return "curve";
    case Rejected::quantity:
      return "quantity";
    case Rejected::end_of_window:
      return "end_of_window";
  }
  return "unknown";
}

void check(const Options& o) {
  require(std::isfinite(o.lower), "options.lower", o.lower, "finite");
  require(std::isfinite(o.upper) && o.upper > o.lower, "options.upper", o.upper,
          "finite and above options.lower");
  require(o.newton.tolerance > 0, "newton.tolerance", o.newton.tolerance, "> 0");
  require(o.newton.rounding_level >= o.newton.tolerance, "newton.rounding_level", o.newton.rounding_level,
          ">= newton.tolerance");
  require(o.newton.iterations >= 2, "newton.iterations", o.newton.iterations, ">= 2");
  require(o.newton.start_iterations >= 2, "newton.start_iterations", o.newton.start_iterations, ">= 2");
  require(o.newton.transient_steps >= 0, "newton.transient_steps", o.newton.transient_steps, ">= 0");
  require(o.newton.chord_contraction >= 0 && o.newton.chord_contraction < 1, "newton.chord_contraction",
          o.newton.chord_contraction, "in [0, 1)");
  require(o.step.initial >= 0, "step.initial", o.step.initial, ">= 0");
  require(o.step.smallest > 0, "step.smallest", o.step.smallest, "> 0");
  require(o.step.largest >= 0, "step.largest", o.step.largest, ">= 0");
  require(o.step.curve_tolerance >= 0, "step.curve_tolerance", o.step.curve_tolerance, ">= 0");
  require(!o.step.pass_kinks || o.step.curve_tolerance > 0, "step.curve_tolerance", o.step.curve_tolerance,
          "> 0 with step.pass_kinks");
  require(o.seconds >= 0, "options.seconds", o.seconds, ">= 0");
  require(o.step.largest_parameter >= 0, "step.largest_parameter", o.step.largest_parameter, ">= 0");
  require(o.step.relative_parameter >= 0, "step.relative_parameter", o.step.relative_parameter, ">= 0");
  require(o.step.relative_state > 0, "step.relative_state", o.step.relative_state, "> 0");
  require(o.step.angle > 0 && o.step.angle < o.step.largest_angle, "step.angle", o.step.angle,
          "> 0 and below step.largest_angle");
  require(o.step.largest_angle < 1.5, "step.largest_angle", o.step.largest_angle, "< 1.5");
  require(o.step.contraction > 0 && o.step.contraction < 1, "step.contraction", o.step.contraction,
          "in (0, 1)");
  require(o.points >= 1, "options.points", static_cast<double>(o.points), ">= 1");
  require(o.largest_state > 0, "options.largest_state", o.largest_state, "> 0");
  require(o.event_tolerance > 0, "options.event_tolerance", o.event_tolerance, "> 0");
}

}  // namespace arcslip::continuation
