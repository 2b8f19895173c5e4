#pragma once
// A solution branch of F(u, p) = 0 in one free parameter, and why it ended.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/continuation/problem/stability.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace arcslip::continuation {

/// A solution point. Arclength and tangent use the problem's scales: |t|^2 = sum (t_i / scale_i)^2 = 1.
struct Point {
  Vector u;                            // n
  double parameter = 0;                // value of the free parameter
  Vector tangent;                      // n + 1: du/ds, dp/ds
  double arclength = 0;                // from the start
  int iterations = 0;                  // of the corrector
  double correction = 0;               // relative size of the last correction
  std::optional<Spectrum> spectrum{};  // with Options::stability
  Vector state{};  // with Options::keep_states: that the problem is in from here on. Of a kink within a step,
                   // which is a trial: that it was computed from. Of events: none
};

/// A coefficient of a normal form with an estimate of its error. Not a number: not known, as where F has no
/// derivatives, or the linear solver no transposed solves.
struct Coefficient {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();

  bool known() const { return std::isfinite(value) && std::isfinite(error); }
  /// Whether the sign is certain: the value is larger than its error.
  bool signed_by_value() const { return known() && std::abs(value) > error; }
};

/// Whether what emerges at a special point is stable where all other eigenvalues are: `supercritical`, or
/// unstable: `subcritical`. Unknown where the coefficient that decides it is zero within its error.
enum class Criticality { unknown, supercritical, subcritical };

const char* name(Criticality criticality);

// Conventions of the coefficients, of u' = F(u, p) with p its free parameter, p_0 its value at the point:
// J q = 0 and J^T w = 0 (at a Hopf point J q = i omega q, J^T w = -i omega w) with <q, q> = <w, q> = 1 and
// <a, b> = sum conj(a_i) b_i, in the units of the unknowns, without scales; B and C are the second and third
// derivatives of F in u (Kuznetsov, Elements of Applied Bifurcation Theory, 2004, chapters 3, 5 and 8). The
// unit of time is that of u' = F.

/// A smooth fold in the free parameter. u' = F is z' = b (p - p_0) + a z^2 there, with q in the direction of
/// right_null. Not known where the eigenvalue 0 is double.
struct Fold {
  Vector right_null;        // J v = 0, n, |v| = 1 in scales
  Vector left_null;         // w J = 0, n, |w| = 1; empty if the linear solver has no transposed solves
  double curvature = 0;     // d2p/ds2: > 0 if the branch lies at larger parameters than the fold
  Coefficient quadratic{};  // a = <w, B(q, q)> / 2
  Coefficient unfolding{};  // b = <w, F_p>
};

/// A branch point. Simple: J has rank n - 1 and F_p lies in its range, so that two smooth branches cross.
/// `multiple`: [J F_p] has rank n - 2 or less, and any number of branches may cross.
///
/// Along a branch through the point with dp/ds != 0, the first one of `tangents` that has it, u' = F is
///
///   z' = d (p - p_0) z + a z^2           transcritical
///   z' = d (p - p_0) z + c z^3           pitchfork, of a symmetric F: a = 0
///
/// so that a pitchfork with c < 0 is supercritical. Not known if multiple.
struct BranchPoint {
  enum class Type { transcritical, pitchfork, multiple };  // pitchfork: dp/ds = 0 on one of the branches
  Type type = Type::transcritical;
  std::vector<Vector> tangents;  // of the branches, n + 1; first that of the branch traced
  Vector left_null;              // w J = 0, w . F_p = 0, n, |w| = 1; empty if multiple
  Coefficient crossing{};   // d = <w, d(J q)/dp along the branch>: the rate of the eigenvalue that crosses
  Coefficient quadratic{};  // a = <w, B(q, q)> / 2
  Coefficient cubic{};      // c = <w, C(q, q, q) + 3 B(q, h)> / 6, J h = -B(q, q) + 2 a q
  Criticality criticality = Criticality::unknown;  // of a pitchfork
};

/// A Hopf point of u' = F(u, p): J (a + ib) = i omega (a + ib). Cycles emerge, u' = F is
///
///   z' = (i omega + mu_p (p - p_0)) z + c z |z|^2,   u = u_0 + 2 Re(z q) + ...
///
/// with q along a + ib. They are stable, if all other eigenvalues are, where l1 < 0.
struct Hopf {
  double frequency = 0;  // omega > 0
  Vector real, imaginary;

  Coefficient lyapunov{};  // l1 = Re c / omega, c = <w, C(q,q,q*) + 2 B(q,h11) + B(q*,h20)> / 2
  Coefficient detuning{};  // Im c
  Coefficient growth{};    // Re mu_p: d Re mu / dp along the branch
  Coefficient drift{};     // Im mu_p
  Criticality criticality = Criticality::unknown;

  // The cycles of a small amplitude e, to terms of order e^3 (cycle_near() in events/hopf.hpp):
  //   u = u_0 + 2 e Re(q exp(i theta)) + e^2 (mean + Re((second_real + i second_imaginary) exp(2 i theta)))
  //   p = p_0 + e^2 parameter_shift,   frequency = omega + e^2 frequency_shift
  Vector mean, second_real, second_imaginary;                         // empty: not known
  double parameter_shift = std::numeric_limits<double>::quiet_NaN();  // -Re c / growth
  double frequency_shift = std::numeric_limits<double>::quiet_NaN();  // Im c + drift parameter_shift
};

/// A kink: the branch is continuous, its tangent is not.
struct Kink {
  Vector before, after;  // tangents, n + 1
};

// Points of curves of folds and of Hopf points, with the coefficients of Kuznetsov, SIAM J. Numer. Anal. 36,
// 1999, where all critical eigenvalues are named; w_0, w_1 are critical unknowns.

/// A cusp of a curve of folds: w' = c w^3 at a = 0.
struct Cusp {
  Coefficient cubic{};  // c = <w, C(q, q, q) + 3 B(q, h)> / 6
};

/// A Bogdanov-Takens point, a double eigenvalue zero with J q_0 = 0, J q_1 = q_0, J^T w_1 = 0, J^T w_0 = w_1,
/// <q_0, q_0> = <w_0, q_0> = <w_1, q_1> = 1, <q_0, q_1> = <w_0, q_1> = 0:
///   w_0' = w_1,   w_1' = beta_1 + beta_2 w_0 + a w_0^2 + b w_0 w_1.
/// Where a b < 0 the Hopf points that leave it are supercritical.
struct BogdanovTakens {
  Coefficient a{}, b{};  // a = <w_1, B(q_0, q_0)> / 2, b = <w_0, B(q_0, q_0)> + <w_1, B(q_0, q_1)>
  Criticality criticality = Criticality::unknown;
};

/// A generalized Hopf (Bautin) point: l1 = 0, z' = i omega z + c z |z|^2 + c2 z |z|^4. Cycles that meet there
/// have a fold, of stable and unstable ones; where l2 < 0 the stable ones are the larger.
struct GeneralizedHopf {
  double frequency = 0;
  Coefficient lyapunov{};         // l1, zero within its error
  Coefficient detuning{};         // Im c of the normal form of Hopf
  Coefficient second_lyapunov{};  // l2 = Re c2 / omega; not known where J consists of differences
};

/// A zero-Hopf point: eigenvalues 0 and +- i frequency,
///   w_0' = g200 w_0^2 / 2 + g011 |w_1|^2 + g300 w_0^3 / 6 + g111 w_0 |w_1|^2
///   w_1' = i omega w_1 + g110 w_0 w_1 + g210 w_0^2 w_1 / 2 + g021 w_1 |w_1|^2 / 2.
struct ZeroHopf {
  double frequency = 0;
  Coefficient g200{}, g011{}, g300{}, g111{};
  Coefficient g110_real{}, g110_imaginary{}, g210_real{}, g210_imaginary{}, g021_real{}, g021_imaginary{};
};

/// A double Hopf point: two pairs, the first one that of the curve,
///   w_1' = i omega_1 w_1 + g2100 w_1 |w_1|^2 / 2 + g1011 w_1 |w_2|^2
///   w_2' = i omega_2 w_2 + g1110 w_2 |w_1|^2 + g0021 w_2 |w_2|^2 / 2,
/// with the real parts of the coefficients, that do not belong to a resonance k omega_1 = l omega_2, k + l
/// <= 4.
struct DoubleHopf {
  double frequency = 0, other_frequency = 0;
  Coefficient g2100{}, g1011{}, g1110{}, g0021{};
};

using EventData = std::variant<std::monostate, Fold, BranchPoint, Hopf, Kink, Cusp, BogdanovTakens,
                               GeneralizedHopf, ZeroHopf, DoubleHopf>;

/// A zero of a monitor.
struct Event {
  std::string monitor;
  Point point;
  double value = 0;        // of the monitor, at the point
  bool nonsmooth = false;  // the monitor jumps across zero at a kink
  bool located = true;     // false: the corrector failed between the points; `point` is the nearer one, and a
                           // warning of the branch says so
  std::size_t after = 0;   // index of the preceding point of the branch
  EventData data{};        // data specific to the kind of event
};

// clang-format off
/// Why a branch ended. `value` and `limit` are the two sides of the condition.
///   boundary         p = lower or p = upper: the free parameter reached a bound of the window. The usual end.
///   closed           |v - v_start| <= rounding: the branch is a closed loop.
///   event            the first event of a terminal monitor: value is that of the monitor.
///   start_failed     |correction| > tolerance: Newton's method at the start did not converge. Causes: a start far
///                    from a solution, a wrong Jacobian, no solution there.
///   step_too_small   |ds| < smallest step. Causes: a wrong Jacobian, an end of the branch, a
///                    tolerance below rounding, a multiple branch point.
///   state_too_large  |u| > largest state, in scales: a branch that goes to infinity, such as an undamped resonance.
///   point_limit      points >= limit.
///   time_limit       seconds >= limit.
///   memory_limit     bytes of the points kept >= limit.
///   user             the callback requested a stop.
///   not_evaluated    the problem could not be evaluated, returned non-finite values, or it or its linear solver threw
///                    an exception, which the message quotes. value is the last step tried, limit the smallest.
///   monitor_failed   a function of a monitor threw: the message names the monitor and quotes the exception. value is
///                    the parameter.
///   wrong_jacobian   the branch cannot be continued, and an entry of J or dF/dp, named by the message, is wrong: value
///                    is the relative error of the entry, limit the tolerance.
///   known_branch     the branch met another one that was traced before: of a diagram only.
// clang-format on
enum class StopReason {
  boundary,
  closed,
  event,
  start_failed,
  step_too_small,
  state_too_large,
  point_limit,
  time_limit,
  memory_limit,
  user,
  not_evaluated,
  monitor_failed,
  wrong_jacobian,
  known_branch
};

const char* name(StopReason reason);

struct BranchStop {
  StopReason reason = StopReason::boundary;
  double value = 0, limit = 0;  // of the condition of the reason
  std::string message;          // one sentence for the user
};

/// Work counters.
struct Counts {
  long points = 0, rejected_steps = 0, residuals = 0, jacobians = 0, factorizations = 0, solves = 0;

  Counts& operator+=(const Counts& other) {
    points += other.points;
    rejected_steps += other.rejected_steps;
    residuals += other.residuals;
    jacobians += other.jacobians;
    factorizations += other.factorizations;
    solves += other.solves;
    return *this;
  }
};

struct Branch {
  std::vector<Point> points;
  std::vector<Event> events;  // in the order of arclength
  BranchStop stop;
  Counts counts;
  std::string linear_solver;  // name of the linear solver used
  Vector state{};             // of a problem with a state: that the last point left

  /// Reasons to doubt the branch, one sentence each: a monitor that is NaN at a point, so that zeros next to
  /// it are missed; an event that is not located (Event::located), the first one of each monitor; a wrong
  /// Jacobian, so that tangents and events may be wrong.
  std::vector<std::string> warnings;
};

/// Points first to last of a branch, which have the same number of unstable eigenvalues. Points without a
/// spectrum belong to the range before them, those before all to the first one.
struct StabilityRange {
  std::size_t first = 0, last = 0;
  int unstable = 0;
  bool complete = false;  // of all points that have a spectrum: `unstable` is the number. False: found
};

/// The ranges of stability of a branch; none without Options::stability. They change at the events
/// between their points, if these are monitored.
std::vector<StabilityRange> stability_ranges(const Branch& branch);

/// The point at share s, in [0, 1] or beyond, of the cubic through two points with their tangents (Hermite);
/// length: of the chord.
void hermite(const Vector& v0, const Vector& t0, const Vector& v1, const Vector& t1, double length, double s,
             Vector& v);

/// The point at an arclength within the branch by cubic Hermite interpolation between the neighbouring
/// points, without correction. Throws std::out_of_range beyond the ends by more than rounding, or if points
/// keep no unknowns.
Point interpolate(const Branch& branch, double arclength);

}  // namespace arcslip::continuation
