#pragma once
// Branches of periodic responses and their observables, as plain data.

#include <arcslip/results/contact_interval.hpp>
#include <arcslip/results/reason.hpp>

#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A force relative to a displacement of the same harmonic: the part in phase, and the part a quarter
/// period ahead.
struct PhaseParts {
  double in_phase = 0, out_of_phase = 0;
};

/// Largest absolute values over the period of the truncated Fourier series of an element's force, and of its
/// cosine and sine parts, N: ||f_nl||, F_nlcos and F_nlsin of Al Sayed et al. (2011, Eqs. 17 to 21). no_value
/// if not requested (observables/force_components.hpp).
struct ForceMaxima {
  double force = no_value, cosine = no_value, sine = no_value;
};

/// Extremes over the contacts of a patch; no_value if not applicable.
struct ContactExtremes {
  double stick_percent_min = no_value;    // share of the period in stick, 0 to 100
  double pressure_max = no_value;         // Pa, of the normal load over the area
  double energy_per_area_max = no_value;  // J/m^2, dissipated per period
  double wear_depth_rate_max = no_value;  // m/s
};

/// Observables of one nonlinear element over a period; empty or zero if not applicable.
struct ElementResponse {
  std::string name;
  bool has_stick = false;                          // true for friction elements
  double stick_percent = 0;                        // share of the period in stick, 0 to 100
  std::vector<double> slip_angles;                 // onset of each slip phase, rad in [0, 2 pi)
  std::vector<double> reversal_angles;             // end of each slip phase, rad in [0, 2 pi)
  double energy = 0;                               // dissipated per period, J
  std::vector<elements::ContactInterval> contact;  // of the period, in order; empty: not reported

  // With a normal load that varies: the share of the period in separation, 0 to 100, and that load, N.
  bool has_normal_load = false;
  double open_percent = 0, normal_load_max = 0, normal_load_min = 0;
  double stick_estimate = no_value;  // %, effect of the neglected harmonics; no_value: not known
  double wear_rate = no_value;       // m^3/s; no_value without a wear coefficient
  bool of_patch = false;             // one of ResponsePoint::patches has it

  // What the mean force may be, N: more than one where a slider sticks throughout the period, and the offset
  // chosen for it decides. no_value: not reported.
  double mean_force_min = no_value, mean_force_max = no_value;

  // With one stick and one slip phase in each half period: theta_0 in [0, 2 pi), the angle of the largest
  // displacement of the element, where stick starts; theta_star in (theta_0, theta_0 + 2 pi), the next onset
  // of slip, rad. For antisymmetric motion stick_percent = 100 (theta_star - theta_0)/pi.
  double theta_0 = no_value, theta_star = no_value;

  // The fundamental of the force relative to that of the element's own displacement, of amplitude X at the
  // frequency w: N; k_eq = in_phase/X, N/m; c_eq = out_of_phase/(w X), N s/m.
  PhaseParts fundamental{no_value, no_value};
  double equivalent_stiffness = no_value, equivalent_damping = no_value;

  ForceMaxima maxima{};
  ContactExtremes extremes{};  // of a patch
};

/// The equation of motion of the fundamental, harmonic n, along the motion and per unit displacement of the
/// response, N/m (observables/force_components.hpp):
///   F_p/x: inertia + spring + in-phase parts of contact and nonlinear_spring = in-phase part of excitation
///   F_o/x: viscous + out-of-phase parts of contact and nonlinear_spring = out-of-phase part of excitation
/// One mass: inertia = -m (n omega)^2, spring = k, viscous = c n omega. no_value if the response has
/// no fundamental.
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

/// Largest absolute values over the period, with all harmonics, of the response's velocity (m/s) and
/// acceleration (m/s^2) and, for one degree of freedom, the sums of maxima that define F_p/x and F_o/x in Al
/// Sayed et al. (2011, Eqs. 22, 23), N/m. no_value if not requested.
struct MotionMaxima {
  double velocity = no_value, acceleration = no_value;
  PhaseParts force_per_displacement{no_value, no_value};
};

/// A named response. At several places: of the one with the largest amplitude.
struct NamedResponse {
  double amplitude = 0;  // max over the period of |x|, m
  double phase = 0;      // rad, lag of its fundamental behind the force's
  double rms = 0;        // root of the mean of x^2 over the period, m
  // Largest absolute values over the period, m/s and m/s^2; no_value if not requested.
  double velocity = no_value, acceleration = no_value;
};

/// The Floquet multipliers of a response over its period (stability/stability.hpp).
struct Stability {
  std::vector<std::complex<double>> multipliers;  // by falling modulus; none of sliders that stick throughout
  int kept = 0;                                   // how many of them results have; 0: all
  int unstable = 0;                               // outside the unit circle
  double error = no_value;     // estimated effect of the neglected harmonics; no_value: not known
  double rotation = no_value;  // at a Neimark-Sacker point: argument of the pair over 2 pi
};

/// The forced responses next to a mode, by one-mode synthesis
/// (analyses/modes_and_time/one_mode_synthesis.hpp); no_value: there are none.
struct Synthesis {
  double level = no_value;  // of the excitation whose response has its peak at this amplitude
  double omega = no_value;  // rad/s, of that peak
  double below = no_value,
         above = no_value;  // rad/s, where the response to the excitation has this amplitude
  double true_omega = no_value, true_amplitude = no_value;  // of the true peak at that level, rad/s, m
};

/// One periodic response, as algorithms read it.
struct Solution {
  double omega = 0;              // excitation frequency, rad/s
  double over = 0;               // the parameter ResponseBranch::over, if there is one
  double amplitude = 0;          // max over the period of |x|, m, at the scene's response; at several
                                 // places: the largest, to which all else of the response belongs
  std::vector<double> unknowns;  // of the whole motion, as in hbm/problem.hpp: see observables/histories.hpp
  std::vector<double>
      coefficients;  // of the response: the pair a_n, b_n for each n of ResponseBranch::harmonics
  int order = 0;  // N of the harmonics kept, of the base frequency; 0: those of the whole branch. Where the
                  // branch has more, their coefficients and unknowns are 0
  double truncation_estimate = 0;        // m, estimated effect of the neglected harmonics on the amplitude
  double truncation_change = no_value;   // m, the same with its sign, which may cancel; no_value: not known
  bool truncation_flagged = false;       // the estimate may be too low (observables/truncation.hpp)
  double parameter_estimate = no_value;  // of an event of a curve: the same effect on over
  double location_estimate = no_value;   // of an event: the same effect on omega or over; no_value: not known
  double location_change = no_value;     // the same with its sign
  std::string stops;                     // an element whose motion stops where it reverses
                                         // (observables/sticking_at_reversal.hpp); empty: none
  bool unbounded = false;                // the amplitude grows without bound; `amplitude` is undefined
};

/// What is computed of a response next to its omega, amplitude and coefficients, and whether it stops.
struct Observed {
  bool estimates = true;  // what the harmonics left out would change; known where the stability is
  bool motion = true;     // phases, forces, energies, elements, named responses
  bool maxima = false;    // over the period, the most expensive, with what the estimates say of the stick

  friend bool operator==(const Observed&, const Observed&) = default;
  friend Observed operator|(const Observed& a, const Observed& b) {
    return {a.estimates || b.estimates, a.motion || b.motion, a.maxima || b.maxima};
  }
};
inline constexpr Observed solution_alone{.estimates = false, .motion = false};
inline constexpr Observed everything{.maxima = true};

/// One periodic response with its observables. Where they are not asked for they have their defaults.
struct ResponsePoint : Solution {
  double rms = no_value;       // root of the mean of x^2 over the period, m
  double phase = 0;            // rad, lag of the response's fundamental behind the force's
  double energy_friction = 0;  // J per period
  double energy_viscous = 0;   // J per period
  std::vector<ElementResponse> elements;
  std::vector<ElementResponse> patches;  // their totals (observables/patch_totals.hpp)
  std::vector<NamedResponse> responses;  // the named responses, in the order of the scene
  double energy_input = 0;               // work of the excitation, J per period; equals energy_total()
  double damping_ratio = no_value;       // of a mode (hbm/mode.hpp)
  double energy = no_value;              // of a mode, J (observables/mechanical_energy.hpp)
  Synthesis synthesis{};                 // of a mode
  ForceComponents forces{};
  MotionMaxima maxima{};
  std::optional<Stability> stability{};  // if requested and known

  double energy_total() const { return energy_friction + energy_viscous; }
  /// Share of friction in the dissipated energy, 0 to 100; no_value without dissipation, or where the
  /// elements feed the motion.
  double friction_percent() const {
    const bool feeds = energy_friction < -1e-9 * energy_viscous;  // more than rounding
    return energy_total() > 0 && !feeds ? 100 * energy_friction / energy_total() : no_value;
  }
};

struct ResponseEvent {
  std::string kind;        // of event_kinds (event_kinds.hpp)
  bool nonsmooth = false;  // at a kink of the branch
  bool located = true;     // false: the corrector failed at it; the point is the nearest one of the branch
  ResponsePoint point;
  std::size_t after = 0;  // index of the preceding point of the branch
};

struct Stop {
  results::Reason reason;       // reasons.hpp
  double value = 0, limit = 0;  // that triggered it
  std::string message;          // one sentence for the user
};

/// What a shift by half a period does to the motions of a branch, mirrored: nothing where they are
/// antisymmetric; of mirror_pair it gives another motion, which is on the branch as well.
enum class Symmetry { none, antisymmetric, mirror_pair };

/// The event of its parent at which a branch leaves it.
struct Leaves {
  std::string kind{};     // empty: it leaves none
  std::size_t event = 0;  // its index
  double omega = 0;       // of the branch point, rad/s
};

/// complete: over the whole window, or up to an unbounded peak, beyond which another branch continues.
/// stopped: correct up to where it ends, by the user, by a limit, or back at the end of the window where it
/// started. failed: it could not be started or continued.
using results::name;
using results::Status;

struct SolverSummary {
  std::string linear_solver;  // "dense LU"; of parts that differ all, "a, b"; empty: nothing was traced
  int unknowns = 0;
  long points = 0, rejected_steps = 0, residuals = 0, jacobians = 0, factorizations = 0, solves = 0;
  double seconds = 0;
};

/// Of responses that were searched in vain: what the harmonics that were left out may have hidden.
struct LookedAt {
  double amplitude = 0;        // the largest, m
  double estimate = no_value;  // the largest effect of these harmonics on an amplitude, m
  bool flagged = false;        // the estimate may be far too low
};

/// A branch of responses: over the excitation frequency, or over a parameter at a fixed frequency, or a curve
/// of resonance peaks or folds over a parameter.
struct ResponseBranch {
  std::string study, kind;  // name and kind of its study; may be empty
  int parent = 0;  // the branch that it continues, counted backwards in the list: across an unbounded peak,
                   // from the preceding part of its curve, or from where it leaves it; 0: none
  Leaves leaves{};
  bool isolated = false;  // found by a search: no other branch reaches it
  int period = 1;         // of the motions, in periods of the excitation
  Symmetry symmetry = Symmetry::none;
  Status status = Status::complete;
  Stop stop;
  std::string over;  // the continuation parameter; empty for frequency responses
  std::string of{};  // the kind of bifurcation of a curve of such ones (event_kinds.hpp)
  std::vector<std::pair<std::string, double>> set;         // set by for_each
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  std::vector<int> harmonics;                              // n of the coefficients
  std::vector<ResponsePoint> points;
  std::vector<ResponseEvent> events;
  std::vector<ResponsePoint> marks{};  // of a mode: amplitude, frequency and damping ratio at amplitudes that
                                       // are the same for all orders
  std::string doubt;                   // why it is not accurate, or others may be missing; empty: neither
  std::string no_peak{};               // where a complete frequency response has none: where resonances lie
  std::string unknown_stability{};     // why its points have no stability, where it is requested
  std::optional<LookedAt> found_none{};  // in place of points, where a search has come to its end
  std::vector<std::string>
      untraced{};  // branches that leave it, or the responses looked at, and were not followed, and why
  SolverSummary solver;
};

}  // namespace arcslip::observables
