#pragma once
// Nonlinear modes by the extended periodic motion concept (Krack 2015): periodic motions of the structure
// without its periodic excitation,
//
//   M x'' + (C - 2 zeta omega M) x' + K x + f(x, x') = static loads
//
// where negative damping in proportion to the masses, of the ratio zeta, balances what the structure
// dissipates. In conservative structures zeta = 0. In harmonic balance, at an amplitude A of the response:
//
//   R(x_s + a v; omega, zeta) / a = 0,   a = A e^l
//   e^l h(x_r) = 1     x_r: the response of v; h: half the way between its extremes over the period
//   b_1(x_r) = 0       the phase: no sine in the fundamental of the response
//   |v| = 1            the whole motion
//
// x_s: the static displacement. Unknowns (v, ln(omega/omega_0), zeta, l), in this order; the parameter is ln
// A, A in m. In these all are of order 1 over any number of decades of A, and v, omega and zeta change
// smoothly where the response is small next to the motion, or another of its reversals becomes the extreme.

#include <arcslip/fourier/reversals.hpp>
#include <arcslip/hbm/problem.hpp>

#include <memory>
#include <vector>

namespace arcslip::hbm {

/// A model for modes: without periodic excitation, and with a parameter of its own for the damping in
/// proportion to the masses, the last one.
model::Model without_excitation(const model::Model& model);

/// Half the way of a motion between its extremes over the period.
class HalfRange {
 public:
  explicit HalfRange(const elements::Harmonics& harmonics);

  /// x: harmonics.size() coefficients. No allocation.
  double of(elements::In x);
  /// Of the last motion: by its coefficients, and the numbers of the reversals that are its extremes.
  const Vector& gradient() const { return gradient_; }
  std::uint64_t reversals() const { return which_; }

 private:
  elements::Harmonics harmonics_;
  elements::Reversals reversals_;
  Vector gradient_, phi_;
  std::uint64_t which_ = 0;
};

class ModeProblem final : public continuation::Problem {
 public:
  /// motions: of a model without_excitation(). rest: x_s, unknowns of that problem. omega_0: rad/s, a
  /// frequency to measure others by.
  ModeProblem(std::shared_ptr<const HbmProblem> motions, Vector rest, double omega_0);

  int size() const override { return motions_->size() + 3; }
  std::span<const continuation::Parameter> parameters() const override { return parameters_; }
  Vector scales() const override { return Vector::Ones(size()); }
  std::unique_ptr<continuation::Evaluator> evaluator() const override;

  const HbmProblem& motions() const { return *motions_; }
  const std::shared_ptr<const HbmProblem>& shared_motions() const { return motions_; }
  const Vector& rest() const { return rest_; }
  double omega_0() const { return omega_0_; }
  /// The positions of ln(omega/omega_0), zeta and l.
  int log_frequency() const { return motions_->size(); }
  int damping_ratio() const { return motions_->size() + 1; }
  int log_ratio() const { return motions_->size() + 2; }
  /// x_s + a v, unknowns of motions().
  Vector motion(continuation::In unknowns, double log_amplitude) const;
  /// Of the damping in proportion to the masses: its index among the parameters, and its value at zeta = 0.
  int alpha() const { return motions_->model().damping->alpha.parameter(); }
  double own_alpha() const;

 private:
  std::shared_ptr<const HbmProblem> motions_;
  Vector rest_;
  double omega_0_;
  std::vector<continuation::Parameter> parameters_;
};

class ModeEvaluator final : public continuation::Evaluator {
 public:
  explicit ModeEvaluator(const ModeProblem& problem);

  continuation::Evaluated move_to(continuation::In u, continuation::In p, continuation::Needs needs) override;
  const Vector& residual() const override { return R_; }
  const continuation::Jacobian& jacobian() const override { return jacobian_; }
  void parameter_derivative(int k, continuation::Out dR) const override;  // after a move with the Jacobian
  std::uint64_t piece() const override;

  // The motion at the last point.
  const HbmEvaluator& motion() const { return *inner_; }
  const Vector& unknowns() const { return u_; }    // of motions()
  const Vector& parameters() const { return p_; }  // of motions()
  double amplitude() const { return A_; }          // A
  double omega() const { return omega_; }          // rad/s
  double damping_ratio() const { return zeta_; }

 private:
  void differentiate(continuation::In v);

  const int n_, alpha_, phase_;  // phase_: of b_1 among the coefficients of the response
  const double omega_0_, own_alpha_;
  const Vector rest_;
  std::unique_ptr<HbmEvaluator> inner_;
  HalfRange range_;
  Vector u_, p_, R_, x_, unit_, by_omega_, by_alpha_, x_omega_, x_alpha_, row_, by_amplitude_;
  continuation::Jacobian jacobian_;
  double A_ = 1, omega_ = 1, zeta_ = 0;
  double ratio_ = 1;  // e^l
};

}  // namespace arcslip::hbm
