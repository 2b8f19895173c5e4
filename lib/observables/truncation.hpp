#pragma once
// Estimate of the truncation error: the first-order effect of the harmonics above N on the amplitude.
//
// At a solution (u, q) of order N, on a branch over q (the frequency, or another parameter), the equations of
// 2 N + 9 harmonics (of a motion over several periods of the excitation, 9 of each) have the residual r, in
// the harmonics neglected and, where the scene samples its friction, in those kept. Their linearization
// (extended_harmonics.hpp) with the branch's border row gives the change d to the branch of more harmonics,
// which is regular at folds, up to a step c along the tangent t. The condition of the point determines c:
//
//   a value of q       d_q + c t_q + c^2 q''/2 = 0, the root that is next to 0
//   an extremum        none: dA/ds = 0
//   a fold             it moves along the branch to where dq/ds is zero again, c = -d_q' / q''
//   a corner           h = 0 (hbm/grazing_problem.hpp) holds for d + c t
//   a branch point     not known: the linearization is singular there
//
// The place of an event in q moves by d_q + c t_q; that of an extremum, which is where dA/ds is zero again,
// by the same with c = -(dA)'/A''.
//
// Derivatives with respect to s are differences along t. The estimate is |dA|, not a bound; where dA all but
// vanishes, as where it changes sign, |dx|/20 with the change dx of the response, since the harmonics beyond
// add a few percent of that. Where a natural frequency with all elements at maximum stiffness is above N
// omega, a second correction with the same factors, d_2, adds |dA_2|, as it does where laws have unknowns of
// their own, whose equations the sweeps solve less well: there |dx|/5 counts in place of |dx|/20. Where one
// is above (2 N + 9) omega, the estimate is at least what its mode answers at resonance, with forces that
// fall as n^-2 (unresolved_resonances.hpp).
//
// It is flagged if it may be far too low: that resonance has no bound, or may add a tenth of the amplitude;
// the sweeps do not converge; the change of the response is not small; samples do not resolve a force of the
// velocity; the branch of more harmonics has no point at this q; or the condition of the point cannot be
// differentiated.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/observables/amplitude.hpp>
#include <arcslip/observables/extended_harmonics.hpp>
#include <arcslip/observables/unresolved_resonances.hpp>
#include <arcslip/results/response.hpp>

#include <optional>
#include <span>
#include <vector>

namespace arcslip::observables {

/// Where changes cancel: what remains of the change of the response, or of parts.
inline constexpr double uncancelled = 0.05;

struct TruncationEstimate {
  double amplitude = 0;  // m
  double change = 0;     // dA, m, with its sign
  bool flagged = false;
  double location = no_value;         // of an event, in units of q; no_value: not known
  double location_change = no_value;  // the same with its sign
};

/// The condition that defines a point of a branch.
enum class PointCondition { parameter, extremum, fold, corner, branch_point };
PointCondition held_by(const continuation::Event& event);

class Truncation {
 public:
  /// p: at the start of the branch. free: its parameter.
  Truncation(const hbm::HbmProblem& problem, int free, const continuation::Vector& p);

  /// At an accepted point of a branch (of a problem with the same harmonics); extreme: of its response.
  TruncationEstimate estimate(const continuation::Accepted& now, const Extreme& extreme, PointCondition held);

  /// Whether no harmonics are neglected, at the point of the last estimate().
  bool is_exact() const { return exact_; }

  /// The solution of more harmonics next to the point of the last estimate(), to first order.
  struct Refined {
    const hbm::HbmProblem& problem;
    const continuation::Vector& u;  // until the next call of estimate()
    const hbm::HbmEvaluator* at;    // the same; null where it is not evaluated
    continuation::Vector p;
  };
  enum class Reach { all, half };  // of the harmonics above N
  std::optional<Refined> refined(const continuation::Accepted& now, Reach reach, bool evaluated);

 private:
  struct Step {
    double length;
    bool known;  // otherwise what holds the point may need another one
  };

  using Change = WideEquations::Change;
  std::optional<Change> bend_of_branch(const continuation::Accepted& now);
  std::optional<Change> slope_along(WideEquations& in, const Change& x, bool with_residual,
                                    const continuation::Accepted& now);
  struct Shift {
    double change = no_value;
    double parts = 0;  // the sum of their sizes
  };
  struct Correction {
    Shift location;  // of an event
    bool is_at_corner;
    bool is_known;  // otherwise it may be far from the point
  };
  Correction correct(const continuation::Accepted& now, const Extreme& extreme, PointCondition held);
  Shift shift_of_extremum(const continuation::Accepted& now, const Extreme& extreme);
  elements::Values response_to(WideEquations& in, const Change& x, const continuation::Accepted& now,
                               const Extreme& extreme);
  Step step_along(const continuation::Accepted& now, PointCondition held);
  bool to_corner(const continuation::Accepted& now);
  double change_of_amplitude(const Change& x, const continuation::Accepted& now, const Extreme& extreme,
                             PointCondition held);
  double further_change(const continuation::Accepted& now, const Extreme& extreme, PointCondition held,
                        bool is_at_corner);
  double highest_natural_frequency_above(double reach, const continuation::Accepted& now);
  double response_beyond(const continuation::Accepted& now) const;
  std::vector<double> largest_motions() const;
  double not_cancelled(double change, double size, double amplitude) const;
  bool neglects_nothing() const;
  bool samples_too_few() const;
  bool has_internal() const;  // laws with unknowns of their own

  const hbm::HbmProblem& problem_;
  int free_;
  WideEquations wide_, narrow_;  // narrow_: those of order N, with exact friction
  continuation::Vector p_;
  double bound_of_highest_;                              // natural frequency, from below
  std::optional<std::vector<ResonantMode>> high_modes_;  // when first asked for: all, in place of the gain
                                                         // with the largest gain/omega^2 from the mode on
  bool stiffens_, exact_ = false;
  std::unique_ptr<continuation::LinearSolver> solver_;  // of a corner, with its border
  WideEquations::Border border_;
  WideEquations::Change change_, tangent_;
  continuation::Vector base_, along_, residual_, response_, by_parameter_;
};

/// Where along a branch of many unknowns the truncation estimate is computed, and what points between have.
/// It costs as much as several Newton iterations, and varies slowly.
///
/// It is computed at events, at the points next to them, and at every k-th one: k = 1, 2, 4, 8 while a line
/// through the last two gives the next one within 10 %; but not further apart than 0.5 % of the parameter.
/// Where both are flagged, and may be too low, k doubles without it, and they are not further apart than 2 %.
/// Points between have that of the line between their neighbours, and the last one until the next is
/// computed. Where the neighbours differ by more than half, as next to a resonance of a harmonic left out,
/// they have the larger one and are flagged; so are they if a neighbour is.
class SpacedEstimates {
 public:
  /// The next point has its own.
  void restart();
  /// Whether the point at this arclength has its own. parameter: the free one.
  bool is_due(double arclength, double parameter) const;
  /// A point without its own.
  void pass(double arclength, Solution& point);
  /// A point with its own, after those that passed, the last ones of `before`.
  void take(double arclength, double parameter, const Solution& point, std::span<ResponsePoint> before);

 private:
  struct Computed {
    double arclength = no_value, parameter = no_value, estimate = no_value, change = no_value;
    bool flagged = false;
  };
  void fill(const Computed& next, std::span<ResponsePoint> before) const;

  Computed last_;
  double slope_ = no_value;     // of the estimate, up to the last one
  std::vector<double> passed_;  // arclengths since
  int spacing_ = 1;
};

}  // namespace arcslip::observables
