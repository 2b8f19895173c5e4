#pragma once
// Whether a resonance is unbounded: a balance of energies in the limit of large amplitudes.
//
// Along the motion shape phi of the growing response, almost wholly in one harmonic n, per period and unit
// amplitude, the excitation puts in at most pi n |f . phi|, sliders take out 4 n sum mu F_n |d . phi| (they
// slip through almost the whole period), and dampers take out pi n^2 omega phi^T C phi times the amplitude.
// Without damping of that shape and without hardening or softening springs in it, the response is bounded
// only where the sliders take out more than the excitation puts in. For one mass and one slider: unbounded
// for F_n <= pi f_0/(4 mu).

#include <arcslip/hbm/problem.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

struct Unboundedness {
  bool unbounded = false;
  double input = 0, dissipation = 0;  // N: per period and unit amplitude, divided by pi
  std::string message;
};

/// At a response u of very large amplitude.
Unboundedness unboundedness(const hbm::HbmProblem& problem, const continuation::Vector& p,
                            const continuation::Vector& u);

/// At an excitation frequency omega (rad/s) with the model's own parameters, where the response without
/// elements has a pole within about 1e-7 omega. Nothing is unbounded where there is no such pole.
Unboundedness unbounded_resonance(const std::shared_ptr<const model::Model>& model, double omega);

/// Where a branch that an unbounded peak has ended is to be taken up on the other side of the pole, rad/s: as
/// far beyond it as it was before. course: frequency and |u| in scales of its points, the last at the pole.
/// width: of the window of frequencies, rad/s.
double beyond_pole(const std::vector<std::pair<double, double>>& course, double width);

}  // namespace arcslip::observables
