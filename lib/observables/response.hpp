#pragma once
// What an engineer reads off a branch of periodic responses, as plain data.

#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// What one nonlinear element does over a period. Empty vectors and zeros where it has no such thing.
struct ElementResponse {
  std::string name;
  bool has_stick = false;               // true for friction elements
  double stick_percent = 0;             // share of the period in stick, 0 to 100
  std::vector<double> slip_angles;      // onset of each slip phase, rad in [0, 2 pi)
  std::vector<double> reversal_angles;  // end of each slip phase, rad in [0, 2 pi)
  double energy = 0;                    // dissipated per period, J
};

/// One periodic response.
struct ResponsePoint {
  double omega = 0;                // excitation frequency, rad/s
  double over = 0;                 // the parameter ResponseBranch::over, if there is one
  double amplitude = 0;            // max over the period of |x|, m, at the scene's response
  double phase = 0;                // rad, lag of the response's fundamental behind the force's
  double truncation_estimate = 0;  // m, what the neglected harmonics would add to the amplitude
  bool truncation_flagged =
      false;                   // N omega does not pass the structure's resonances: the estimate may be low
  double energy_friction = 0;  // J per period
  double energy_viscous = 0;   // J per period
  bool unbounded = false;      // the amplitude grows without bound here; `amplitude` has no meaning
  std::vector<ElementResponse> elements;
  std::vector<double>
      coefficients;  // of the response: the pair a_n, b_n for each n of ResponseBranch::harmonics
};

struct ResponseEvent {
  std::string kind;        // "peak", "fold"; over a parameter "minimum", "maximum", "cusp", "turn", "corner"
  bool nonsmooth = false;  // at a kink of the branch
  bool located = true;     // false: the corrector failed at it; the point is the nearest one of the branch
  ResponsePoint point;
};

struct Stop {
  std::string reason;           // name of the StopReason
  double value = 0, limit = 0;  // the numbers that decided it
  std::string message;          // one sentence for people
};

/// complete: over the whole window, or up to an unbounded peak beyond which another branch goes on.
/// stopped: right as far as it goes, but ended by the user, by a limit, or at the window's edge where it
/// began. failed: it could not be begun or followed.
enum class Status { complete, stopped, failed };

/// "complete", "stopped" or "failed".
const char* name(Status status);

struct SolverSummary {
  std::string linear_solver;  // "dense LU"
  int unknowns = 0;
  long points = 0, rejected_steps = 0, residuals = 0, jacobians = 0, factorizations = 0, solves = 0;
  double seconds = 0;
};

/// A branch of responses: over the excitation frequency, or over a parameter at a fixed frequency, or a curve
/// of resonance peaks or folds over a parameter.
struct ResponseBranch {
  Status status = Status::complete;
  Stop stop;
  std::string over;  // name of the free parameter beside, or in place of, the frequency; empty for frf
  std::vector<std::pair<std::string, double>> set;         // what for_each gave this branch
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  std::vector<int> harmonics;                              // orders n of the coefficients
  std::vector<ResponsePoint> points;
  std::vector<ResponseEvent> events;
  SolverSummary solver;
};

}  // namespace arcslip::observables
