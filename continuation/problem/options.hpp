#pragma once
// Settings of a trace. All have defaults; check() says what is out of bounds.

#include <arcslip/continuation/problem/problem.hpp>

#include <cstddef>
#include <functional>
#include <string>

namespace arcslip::continuation {

/// pseudo_arclength: in the plane through the prediction, across the last tangent (Keller 1977).
/// moore_penrose: by the smallest correction at each iteration, across the tangent there.
enum class CorrectorKind { pseudo_arclength, moore_penrose };

/// tangent: along the last tangent. secant: through the last two points. cubic: through the last two points
/// with their tangents (Hermite). At the start and beyond kinks the tangent serves all.
enum class Predictor { tangent, secant, cubic };

struct NewtonOptions {
  double tolerance = 1e-9;  // of the last correction, relative to |u| in scales; the error left is its square
  double rounding_level =
      1e-7;            // a correction that stagnates below this is accepted as rounding; >= tolerance
  int iterations = 8;  // at most
  CorrectorKind corrector = CorrectorKind::pseudo_arclength;
  bool chord = true;               // first with the factors of the point before
  double chord_contraction = 0.3;  // these are kept while corrections shrink at least so fast; in [0, 1)
};

struct StepOptions {
  Predictor predictor = Predictor::cubic;
  double initial = 0;             // first step in scaled arclength; 0: chosen from `largest_parameter`
  double smallest = 1e-10;        // relative to 1 + |u| in scales
  double largest = 0;             // in scaled arclength; 0: no such limit
  double largest_parameter = 0;   // |dp| of a step; 0: a hundredth of the window
  double relative_parameter = 0;  // |dp| <= relative_parameter * |p|; 0: no such limit
  double relative_state = 0.5;    // |du| <= relative_state * (1 + |u|), in scales; > 0

  /// The accuracy of the curve between the points: the largest distance of the branch from the cubic through
  /// two neighbouring points with their tangents (interpolate() in branch.hpp), in scales, relative to
  /// the larger |u| of the two, to 1e-6 at least. Measured in the middle of each step, of one with kinks in
  /// the middle of each of its smooth parts, by one residual and one solve. 0: not asked for.
  double curve_tolerance = 0;

  double angle = 0.2;          // rad between the tangents of neighbouring points, aimed at
  double largest_angle = 0.6;  // rad; more is a jump to another branch, unless it is a kink
  double contraction = 0.3;    // of the corrector's first two corrections, aimed at
};

/// Why a step was tried in vain: its corrector did not converge, or the problem could not be evaluated; the
/// matrix was singular; the tangent turned by more than largest_angle; the branch would have gone back, or to
/// another branch near by; more modes may pass zero than branch points are told apart (value, limit); the
/// parameter moved too far; the curve is not within curve_tolerance; a monitored quantity may have extremes
/// between the points; the end of the window was not reached.
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

/// A step that was tried in vain from the last point of a branch.
struct Rejection {
  Rejected why = Rejected::not_converged;
  double arclength = 0, parameter = 0;  // of the last point
  double step = 0;                      // that was tried, in scaled arclength
  double value = 0, limit = 0;          // the numbers that decided it, where there are such
  std::string words;                    // what the problem threw; the monitor of the quantity
};

struct Options {
  double lower = 0,
         upper = 0;  // window of the free parameter, lower < upper, within the parameter's own bounds
  NewtonOptions newton{};
  StepOptions step{};
  long points = 100000;              // at most
  double seconds = 0;                // at most, of wall time; 0: no limit
  std::size_t memory = 0;            // bytes of the points that are kept, at most; 0: no limit
  bool keep_points = true;           // false: points keep no unknowns and no tangent; an observer sees them
  double largest_state = 1e12;       // |u| in scales
  double event_tolerance = 1e-12;    // relative, of the free parameter at an event
  MakeLinearSolver linear_solver{};  // none: the problem's own, or what suits its Jacobian

  /// Asked before each attempt of a step, so that a trace whose steps are rejected can be stopped, too: false
  /// ends it with reason `user`. Unlike an observer it needs no evaluation.
  std::function<bool()> go_on{};

  /// J and dF/dp are compared with differences of F along a direction or two: at points 1, 8, 64, 512 ...,
  /// and where Newton's method does not converge as it should, as seldom (doubt_jacobian() in
  /// jacobian_check.hpp). What is found is told in Branch::warnings. For derivatives that are known to be
  /// right: false.
  bool check_jacobian = true;

  /// Called at each step that was tried in vain, with the reason: for a log.
  std::function<void(const Rejection&)> on_rejection{};
};

/// Throws std::invalid_argument with the value and its bound.
void check(const Options& options);

}  // namespace arcslip::continuation
