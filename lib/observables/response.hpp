#pragma once
// What an engineer reads off a branch of periodic responses, as plain data.

#include <arcslip/results/reason.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A force relative to a displacement of the same harmonic: in phase with it, and a quarter period ahead.
struct PhaseParts {
  double in_phase = 0, out_of_phase = 0;
};

/// Largest absolute values over the period of an element's force, as the series of the harmonics kept, and of
/// its cosine and sine parts, N: ||f_nl||, F_nlcos and F_nlsin of Al Sayed et al. (2011, Eqs. 17 to 21).
/// no_value where they were not asked for (force_components.hpp).
struct ForceMaxima {
  double force = no_value, cosine = no_value, sine = no_value;
};

/// What one nonlinear element does over a period. Empty vectors and zeros where it has no such thing.
struct ElementResponse {
  std::string name;
  bool has_stick = false;               // true for friction elements
  double stick_percent = 0;             // share of the period in stick, 0 to 100
  std::vector<double> slip_angles;      // onset of each slip phase, rad in [0, 2 pi)
  std::vector<double> reversal_angles;  // end of each slip phase, rad in [0, 2 pi)
  double energy = 0;                    // dissipated per period, J

  // Where there is one stick and one slip phase in each half period: theta_0 in [0, 2 pi), where the
  // element's displacement is largest and stick begins; theta_star in (theta_0, theta_0 + 2 pi), the next
  // onset of slip, rad. Antisymmetric motion: stick_percent = 100 (theta_star - theta_0)/pi.
  double theta_0 = no_value, theta_star = no_value;

  // The fundamental of the force relative to that of the element's own displacement, of amplitude X at the
  // frequency w: N; k_eq = in_phase/X, N/m; c_eq = out_of_phase/(w X), N s/m.
  PhaseParts fundamental{no_value, no_value};
  double equivalent_stiffness = no_value, equivalent_damping = no_value;

  ForceMaxima maxima{};
};

/// The equation of motion of the fundamental, of order n, along the motion itself and per unit displacement
/// of the response, N/m (force_components.hpp):
///   F_p/x: inertia + spring + in-phase parts of contact and nonlinear_spring = in-phase part of excitation
///   F_o/x: viscous + out-of-phase parts of contact and nonlinear_spring = out-of-phase part of excitation
/// One mass: inertia = -m (n omega)^2, spring = k, viscous = c n omega. no_value where the response has no
/// fundamental.
struct ForceComponents {
  double inertia = no_value, spring = no_value, viscous = no_value;
  PhaseParts contact{}, nonlinear_spring{};  // of the friction elements; of all others
  PhaseParts excitation{};

  /// F_p/x and F_o/x.
  PhaseParts total() const {
    return {inertia + spring + contact.in_phase + nonlinear_spring.in_phase,
            viscous + contact.out_of_phase + nonlinear_spring.out_of_phase};
  }
};

/// Largest absolute values over the period, of all harmonics: of the response's velocity (m/s) and
/// acceleration (m/s^2) and, for one degree of freedom, the sums of maxima by which Al Sayed et al. (2011,
/// Eqs. 22, 23) define F_p/x and F_o/x, N/m. no_value where they were not asked for.
struct MotionMaxima {
  double velocity = no_value, acceleration = no_value;
  PhaseParts force_per_displacement{no_value, no_value};
};

/// One of the responses that a scene names.
struct NamedResponse {
  double amplitude = 0;  // max over the period of |x|, m
  double phase = 0;      // rad, lag of its fundamental behind the force's
};

/// One periodic response.
struct ResponsePoint {
  double omega = 0;                 // excitation frequency, rad/s
  double over = 0;                  // the parameter ResponseBranch::over, if there is one
  double amplitude = 0;             // max over the period of |x|, m, at the scene's response
  double phase = 0;                 // rad, lag of the response's fundamental behind the force's
  double truncation_estimate = 0;   // m, what the neglected harmonics would add to the amplitude
  bool truncation_flagged = false;  // the estimate may be too low (truncation.hpp)
  double energy_friction = 0;       // J per period
  double energy_viscous = 0;        // J per period
  bool unbounded = false;           // the amplitude grows without bound here; `amplitude` has no meaning
  std::vector<ElementResponse> elements;
  std::vector<NamedResponse> responses;  // those that the scene names, in its order
  std::vector<double>
      coefficients;              // of the response: the pair a_n, b_n for each n of ResponseBranch::harmonics
  std::vector<double> unknowns;  // all of the motion, as hbm/problem.hpp has it: see histories.hpp
  double energy_input = 0;       // work of the excitation, J per period; equals energy_total()
  ForceComponents forces{};
  MotionMaxima maxima{};

  double energy_total() const { return energy_friction + energy_viscous; }
  /// Share of friction in the energy dissipated, 0 to 100; no_value where there is none.
  double friction_percent() const {
    return energy_total() > 0 ? 100 * energy_friction / energy_total() : no_value;
  }
};

struct ResponseEvent {
  std::string kind;        // of event_kinds (event_kinds.hpp)
  bool nonsmooth = false;  // at a kink of the branch
  bool located = true;     // false: the corrector failed at it; the point is the nearest one of the branch
  ResponsePoint point;
  std::size_t after = 0;  // index of the point of the branch before it
};

struct Stop {
  results::Reason reason;       // reasons.hpp
  double value = 0, limit = 0;  // the numbers that decided it
  std::string message;          // one sentence for people
};

/// complete: over the whole window, or up to an unbounded peak beyond which another branch goes on.
/// stopped: right as far as it goes, but ended by the user, by a limit, or at the window's edge where it
/// began. failed: it could not be begun or followed.
using results::name;
using results::Status;

struct SolverSummary {
  std::string linear_solver;  // "dense LU"
  int unknowns = 0;
  long points = 0, rejected_steps = 0, residuals = 0, jacobians = 0, factorizations = 0, solves = 0;
  double seconds = 0;
};

/// A branch of responses: over the excitation frequency, or over a parameter at a fixed frequency, or a curve
/// of resonance peaks or folds over a parameter.
struct ResponseBranch {
  std::string study, kind;  // name and kind of the study that asked for it; empty where nobody said so
  int parent = 0;  // the branch that it goes on from, so many before it in the list of all: across an
                   // unbounded peak, or from the part of its curve before it; 0: none
  Status status = Status::complete;
  Stop stop;
  std::string over;  // name of the free parameter beside, or in place of, the frequency; empty for frf
  std::vector<std::pair<std::string, double>> set;         // what for_each gave this branch
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  std::vector<int> harmonics;                              // orders n of the coefficients
  std::vector<ResponsePoint> points;
  std::vector<ResponseEvent> events;
  std::string doubt;  // of a branch that reached its end in its rounding: why digits are lost; empty: none
  SolverSummary solver;
};

}  // namespace arcslip::observables
