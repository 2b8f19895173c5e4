#pragma once
// Modes of the structure linearized about a small motion, in which contacts that stick are springs, and gaps
// rest as they are.

#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace arcslip::hbm {

struct LinearMode {
  enum class Kind { oscillation, rigid_body, unstable };  // omega^2 above, equal to or below 0
  Kind kind = Kind::oscillation;
  double omega = 0;          // rad/s
  double damping_ratio = 0;  // of its own motion: v^T C v/(2 omega v^T M v)
  Vector shape;              // v, in the coordinates y (hbm/linear/coordinates.hpp)
  double mass = 0;           // v^T M v
};

/// In the order of omega^2, those of massless motions left out, of
///
///   M x'' + (C + C_e) x' + (K + K_e) x = 0
///
/// with the stiffness K_e and the damping C_e of the elements in the fundamental of the motion where `at` is:
/// after a move with the Jacobian. Without `at`: with the stiffness of the elements at rest. omega:
/// at which C_e and a loss factor are taken. Empty: no such modes, as where M and K are singular together.
std::vector<LinearMode> linear_modes(const HbmProblem& problem, const Vector& p, const HbmEvaluator* at,
                                     double omega);

/// A mode with its damping, omega and zeta real and v complex:
///
///   (K + K_e + i omega (C + C_e)) v = omega^2 (1 + 2 i zeta) M v
///
/// the limit at small amplitudes of the motion that hbm/mode.hpp defines. Followed from an undamped mode
/// while the damping grows from nothing; empty where that does not come to its end, as where the mode ceases
/// to oscillate, for more than 300 coordinates, and if `control` ends. `at` as above.
struct DampedMode {
  double omega = 0, damping_ratio = 0;
  ComplexVector shape;
};
std::optional<DampedMode> damped_mode(const HbmProblem& problem, const Vector& p, const HbmEvaluator& at,
                                      const LinearMode& undamped, const control::Control& control = {});

/// The unknowns of the motion y = Re shape exp(i omega t).
Vector unknowns_of(const HbmProblem& problem, const ComplexVector& shape);

}  // namespace arcslip::hbm
