#pragma once
// Detection of unbounded resonances, by the energy balance in the limit of large amplitudes.
//
// For the motion shape phi of the growing response, almost entirely in one harmonic n, per period and unit
// amplitude, the excitation does work of at most pi n |f . phi|, sliders dissipate 4 n sum mu F_n |d . phi|
// (they slip almost the whole period), and dampers dissipate pi n^2 omega phi^T C phi times the amplitude.
// Without damping and without hardening or softening springs in that shape, the response is bounded only if
// the sliders dissipate more than the excitation supplies. For one mass and one slider: unbounded for F_n <=
// pi f_0/(4 mu).

#include <arcslip/hbm/problem.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

struct UnboundedGrowth {
  bool unbounded = false;
  double input = 0, dissipation = 0;  // N: per period and unit amplitude, divided by pi
  std::string message;
};

/// At a response u of very large amplitude.
UnboundedGrowth unboundedness(const hbm::HbmProblem& problem, const continuation::Vector& p,
                              const continuation::Vector& u);

/// At an excitation frequency omega (rad/s) with the model's own parameters, if the linear response has a
/// pole within about 1e-7 omega; otherwise nothing is unbounded.
UnboundedGrowth unbounded_resonance(const std::shared_ptr<const model::Model>& model, double omega);

/// Where a branch goes on beyond a pole.
struct BeyondPole {
  std::vector<double> starts;  // rad/s: the first of them that has a response
  double displacement = 0;     // m: the scale there; 0: that of the first response
  bool ahead = true;           // above the pole. A branch that turned back has passed below it before
};

/// Beyond a pole (rad/s) that a branch begins at. width: of the frequency window, rad/s.
BeyondPole beyond_pole_at_start(double omega, double width);

/// Along a branch over the frequency: whether it grows without bound, and at which frequency. Next to a pole
/// omega_0 of the response, |u| = c/|omega - omega_0|: it is one where the omega_0 of its last points, over
/// which |u| doubles twice, agree and are close by, and where the balance above holds. A response that has
/// only grown much may be anywhere: one that begins all but stuck, or with the ground all but at rest, has
/// grown a million times far from any resonance.
class PoleWatch {
 public:
  /// Of the frequency window, rad/s. Poles beyond it are none of the branch.
  PoleWatch(double lower, double upper) : lower_(lower), upper_(upper) {}

  /// At each point of the branch in turn: whether it is next to a pole at which it is unbounded.
  bool is_next_to_pole(const hbm::HbmProblem& problem, const continuation::Vector& p,
                       const continuation::Vector& u);

  /// There; before, why the response is bounded, as far as it was asked.
  const UnboundedGrowth& growth() const { return growth_; }
  double pole() const { return pole_; }  // rad/s
  BeyondPole beyond() const;

 private:
  struct Place {
    double omega, size;  // rad/s, m
  };
  const Place* half_as_large(const Place& of) const;
  std::optional<double> pole_ahead() const;

  double lower_, upper_, pole_ = 0;
  std::vector<Place> course_;
  UnboundedGrowth growth_;
};

}  // namespace arcslip::observables
