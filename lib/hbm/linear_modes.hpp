#pragma once
// Modes of the structure linearized about a small motion, in which contacts that stick are springs, and gaps
// rest as they are.

#include <arcslip/hbm/problem.hpp>

#include <string>
#include <vector>

namespace arcslip::hbm {

struct LinearMode {
  enum class Kind { oscillation, rigid_body, unstable };  // omega^2 above, equal to or below 0
  Kind kind = Kind::oscillation;
  double omega = 0;          // rad/s
  double damping_ratio = 0;  // of its own motion: v^T C v/(2 omega v^T M v)
  Vector shape;              // v, in the coordinates y (coordinates.hpp)
  double mass = 0;           // v^T M v
};

/// In the order of omega^2, those of massless motions left out, of
///
///   M x'' + (C + C_e) x' + (K + K_e) x = 0
///
/// with the stiffness K_e and the damping C_e of the elements in the fundamental of the motion where `at` is:
/// after a move with the Jacobian. Without `at`: with the largest stiffness of the elements at rest. omega:
/// at which C_e and a loss factor are taken. Empty: no such modes, as where M and K are singular together.
std::vector<LinearMode> linear_modes(const HbmProblem& problem, const Vector& p, const HbmEvaluator* at,
                                     double omega);

/// The unknowns of the motion y = Re shape exp(i omega t).
Vector unknowns_of(const HbmProblem& problem, const ComplexVector& shape);

}  // namespace arcslip::hbm
