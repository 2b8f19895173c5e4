#pragma once
// The current point of a curve of optima: an active set, the unknowns of its equations (optimality.hpp), the
// direction, and the identification of the active peaks in another response. Not installed.

#include <arcslip/optimize/curve/optimality.hpp>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace arcslip::optimize {

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
