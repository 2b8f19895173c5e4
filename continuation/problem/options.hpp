#pragma once
// Options of a trace. All have defaults; check() validates them.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/continuation/problem/stability.hpp>
#include <arcslip/control/run_control.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace arcslip::continuation {

/// Newton's method in the plane through the prediction, normal to the last tangent (Keller 1977).
struct NewtonOptions {
  double tolerance = 1e-9;       // of the last correction, relative to |u| in scales; the error is its square,
                                 // or, at points of a smooth branch, is expected below 1e-3 of the tolerance
  double rounding_level = 1e-7;  // corrections that stagnate below are accepted as rounding; >= tolerance
  int iterations = 8;            // maximum
  int start_iterations = 30;     // maximum from a start without a tangent, damped, and once more undamped
  int transient_steps = 100;     // maximum of u' = F and of u' = -F, where these do not converge; 0: none
  bool chord = true;             // start with the factors of the previous point
  double chord_contraction = 0.3;  // and keep them while corrections contract at least so fast; in [0, 1)
};

struct StepOptions {
  double initial = 0;             // first step in scaled arclength; 0: chosen from `largest_parameter`
  double smallest = 1e-10;        // relative to 1 + |u| in scales
  double largest = 0;             // in scaled arclength; 0: no limit
  double largest_parameter = 0;   // |dp| of a step; 0: 1 % of the window
  double relative_parameter = 0;  // |dp| <= relative_parameter * |p|; 0: no limit
  double relative_state = 0.5;    // |du| <= relative_state * (1 + |u|), in scales; > 0

  /// Tolerance of the interpolated curve: the maximum distance of the branch from the cubic through two
  /// neighbouring points with their tangents (interpolate() in branch.hpp), in scales, relative to the larger
  /// |u| of the two, at least 1e-6. Measured in the middle of each step, or of each smooth section of a step
  /// with kinks, by one residual and one solve. 0: no control.
  double curve_tolerance = 0;

  /// Kinks are passed wherever the branch keeps within curve_tolerance of the cubic across them, and located
  /// only where a monitor may have an event, or asks for kinks: for problems with many kinks, each of which
  /// matters little. An extremum that two kinks make between points may then be missed, if it is no higher
  /// than curve_tolerance allows. Requires curve_tolerance.
  bool pass_kinks = false;

  double angle = 0.2;          // rad, target angle between the tangents of neighbouring points
  double largest_angle = 0.6;  // rad, maximum; more counts as a jump to another branch, unless at a kink
  double contraction = 0.3;    // target ratio of the corrector's first two corrections
};

/// Why a step was rejected: the corrector did not converge, or the problem could not be evaluated; the matrix
/// was singular; the tangent turned by more than largest_angle; the step reversed, or jumped to a nearby
/// branch; more modes may cross zero than branch points can be separated (value, limit); the parameter moved
/// too far; the curve exceeds curve_tolerance; a monitored quantity may have extrema between the points; the
/// end of the window was not reached.
enum class Rejected {
  not_converged,
  not_evaluated,
  singular,
  turn,
  another_branch,
  branch_points,
  parameter_step,
  curve,
  quantity,
  end_of_window
};

const char* name(Rejected why);

/// A rejected step from the last point of a branch.
struct Rejection {
  Rejected why = Rejected::not_converged;
  double arclength = 0, parameter = 0;  // of the last point
  double step = 0;                      // in scaled arclength
  double value = 0, limit = 0;          // of the criterion, if it has any
  std::string words;                    // what the problem threw; or the monitor of the quantity
};

struct Options {
  double lower = 0,
         upper = 0;  // window of the free parameter, lower < upper, within the parameter's own bounds
  NewtonOptions newton{};
  StepOptions step{};
  long points = 100000;            // maximum
  double seconds = 0;              // maximum wall time, a deadline of `control`; 0: no limit
  std::size_t memory = 0;          // maximum bytes of the points kept; 0: no limit
  bool keep_points = true;         // false: points keep neither unknowns nor tangent; only observers see them
  bool keep_states = false;        // of a problem with a state: points keep it (Point::state)
  double largest_state = 1e12;     // |u| in scales
  double event_tolerance = 1e-12;  // of the free parameter at an event, relative
  MakeLinearSolver linear_solver{};  // none: the problem's own, or the default for its Jacobian

  /// The stability of u' = F, or M u' = F: Point::spectrum. None, the default: F is no rate of change.
  std::optional<StabilityOptions> stability{};

  /// Asked before each attempted step, so that a trace can also be stopped while steps are rejected: its end
  /// is that of the trace, with reason `user`. Unlike for an observer, the problem is not evaluated for it.
  control::Control control{};

  /// Compares J and dF/dp with differences of F along one or two directions: at points 1, 8, 64, 512 ...,
  /// and, as rarely, where Newton's method converges too slowly (doubt_jacobian() in jacobian_check.hpp).
  /// Errors are reported in Branch::warnings. false: for derivatives known to be correct.
  bool check_jacobian = true;

  /// Called for each rejected step, with the reason, e.g. for logging.
  std::function<void(const Rejection&)> on_rejection{};
};

/// Throws std::invalid_argument, with the value and its bound, for an invalid option.
void check(const Options& options);

}  // namespace arcslip::continuation
