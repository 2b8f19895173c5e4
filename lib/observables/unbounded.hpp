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

#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

inline constexpr double beyond_display = 1e6;  // |u| in scales: larger responses may be unbounded

struct Unboundedness {
  bool unbounded = false;
  double input = 0, dissipation = 0;  // N: per period and unit amplitude, divided by pi
  std::string message;
};

/// At a response u of very large amplitude.
Unboundedness unboundedness(const hbm::HbmProblem& problem, const continuation::Vector& p,
                            const continuation::Vector& u);

/// At an excitation frequency omega (rad/s) with the model's own parameters, if the linear response has a
/// pole within about 1e-7 omega; otherwise nothing is unbounded.
Unboundedness unbounded_resonance(const std::shared_ptr<const model::Model>& model, double omega);

/// The frequency, rad/s, at which a branch is resumed beyond an unbounded peak: as far beyond the pole as
/// before it. course: frequency and |u| in scales of its points, the last at the pole. width: of the
/// frequency window, rad/s.
double beyond_pole(const std::vector<std::pair<double, double>>& course, double width);

}  // namespace arcslip::observables
