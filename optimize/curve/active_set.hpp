#pragma once
// The current point of a curve of optima: an active set, the unknowns of its equations (optimality.hpp), the
// direction, and the identification of the active peaks in another response; and changes of the active set.
// Not installed.

#include <arcslip/optimize/curve/optimality.hpp>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace arcslip::optimize {

inline constexpr double higher_peak = 1e-7;  // of ln A: a peak above the active ones

/// The inequalities that may become active or inactive along a curve with this active set: the bounds of all
/// parameters and, if there are several, the active peaks. Other peaks may join.
std::vector<Inequality> inequalities(const ActiveSet& active);

/// Exchanges an inequality violated by more than rounding: a peak above the active ones joins, one with
/// negative weight leaves, a parameter beyond its bound is fixed, one with a negative multiplier is released.
/// False: no violation.
bool exchange(ActiveSet& active, const OptimalityEvaluator& at);

struct Exchanged {
  ActiveSet active;
  std::vector<double> weights;  // of its peaks
  Inequality watched;           // its slack is 0 here and must increase along the curve
};

/// The next active set after the slack of `what` has reached zero: with `what` added if it was inactive,
/// otherwise removed. At most as many inequalities are active as there are conditions, the design parameters
/// + 1; beyond that the one whose multiplier vanishes first as that of `what` increases leaves, and is
/// watched. nullopt: none vanishes.
std::optional<Exchanged> exchanged(const ActiveSet& active, const Inequality& what,
                                   const OptimalityEvaluator& at);

struct KnownPeak {
  PeakKind kind;
  double omega, amplitude;  // rad/s, m
};

struct ActiveSetPoint {
  ActiveSet active;
  Vector z;
  double sigma = 0;
  Vector tangent{};              // d(z, sigma), of length 1; empty: to larger sigma
  int orientation = 0;           // sign of det [E_z E_sigma; tangent^T]: the same on both sides of a kink
  std::vector<double> design{};  // with s last
  std::vector<KnownPeak> peaks{};

  /// Sets design and peaks.
  void take(const OptimalityEvaluator& at);
  /// The unit tangent with row . t > 0, and its orientation. False: it is not unique.
  bool take_tangent(const OptimalityEvaluator& at, const Vector& row);
  void orient(const OptimalityEvaluator& at);
  void turn_back();
  bool move(OptimalityEvaluator& at) const;
  /// Newton's method at fixed sigma.
  bool correct(OptimalityEvaluator& at);
};

/// The peaks of a response that match the wanted ones, at the same or a neighbouring design, in their
/// order: nearest in frequency, with a relative difference in amplitude of at most `tolerance`. Empty: one
/// is missing.
std::vector<std::size_t> find_again(const PeakState& state, const std::vector<KnownPeak>& wanted,
                                    double tolerance);

/// The equations without the active set.
struct OptimalitySetting {
  PeakAmplitude& peaks;
  const std::vector<ScaledParameter>& scaled;
  double reference;

  std::shared_ptr<const OptimalityData> of(const ActiveSet& active) const;
  std::size_t size() const { return scaled.size() - 1; }  // parameters of the design

  /// z and weights at the design of the peaks, an approximate solution of the equations.
  Vector estimate(const ActiveSet& active, Vector& weights) const;

  /// Moves a parameter without influence on the active peaks with nonzero weight, such as the load of a
  /// sticking damper, to the bound up to which it has none, and fixes it there; returns its index and its
  /// previous value. flat: a parameter without such a bound.
  struct Moved {
    std::vector<std::pair<std::size_t, double>> moved;
    std::optional<std::size_t> flat;
  };
  Moved hold_flat(ActiveSet& active, std::vector<double>& design) const;
};

constexpr double same_level = 1e-6;     // of ln A, of one peak in two responses at the same point
constexpr double no_influence = 1e-12;  // of d ln A / dy: less is rounding

}  // namespace arcslip::optimize
