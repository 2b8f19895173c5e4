#pragma once
// Periodic motions by shooting as a continuation problem, for structures with piecewise linear laws:
//
//   F(X, p) = Phi(X, p) - X = 0
//
// X = (x, x', z): the state at the start of the period T = 2 pi/omega; Phi: that after it, by event-driven
// integration, exact; rows of sliders that rest throughout as in periodicity.hpp. p: the model's parameters,
// "frequency" first. The derivative with it is exact: with y = dx/domega at a fixed t and the velocity and
// acceleration at T,
//
//   dPhi/domega = (y, y', dz/domega) - T/omega (x', x'', z')
//
// Those with other parameters are differences within one piece.
//
// Pieces: the phases that each contact goes through. F is smooth as long as these remain, also where phases
// of two contacts change their order, since forces are continuous. Where the onset of a slip passes the start
// of the period, z there has a kink, and x has none. Source: docs/theory/09-event-driven.md.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/time/event_driven.hpp>

#include <complex>
#include <memory>
#include <vector>

namespace arcslip::time {

class ShootingProblem;

class ShootingEvaluator final : public continuation::Evaluator {
 public:
  explicit ShootingEvaluator(const ShootingProblem& problem);

  /// Throws std::runtime_error where the period is not integrated to its end, with the reason, which the
  /// engine quotes.
  continuation::Evaluated move_to(continuation::In X, continuation::In p, continuation::Needs needs) override;
  const Vector& residual() const override { return F_; }
  const continuation::Jacobian& jacobian() const override { return J_; }
  void parameter_derivative(int k, continuation::Out dF) const override;
  std::uint64_t piece() const override { return orbit_.phases; }

  /// At the last place, with derivatives.
  const Orbit& orbit();
  /// Largest |response| there, m.
  double amplitude() const { return orbit_.amplitude; }
  /// Its derivative by parameter k at a fixed start, at the last place with derivatives.
  double amplitude_derivative(int k) const;
  /// From there over the period, with events, energies and shares of stick.
  EventDrivenMotion motion() { return integrator_->integrate(unstacked_start(), 0, equation().period()); }
  const EquationOfMotion& equation() const { return integrator_->equation(); }

 private:
  void set_parameters(continuation::In p);
  MotionState unstacked_start() const;
  /// (F, A) differentiated by a parameter other than the frequency, A as |response| at a fixed instant.
  const Vector& by_difference(int k) const;

  const ShootingProblem& problem_;
  Vector X_, p_;
  std::unique_ptr<EventDriven> integrator_;  // at p_
  Orbit orbit_;
  Vector F_;
  continuation::Jacobian J_;
  Vector by_frequency_;  // at the last place with J
  double amplitude_by_frequency_ = 0;
  Vector X_of_J_, p_of_J_;
  std::uint64_t piece_of_J_ = 0;
  double instant_of_J_ = 0, extreme_of_J_ = 0;  // of the largest |response|: s, m
  mutable int differentiated_by_ = -1;          // at that place; -1: by none
  mutable Vector by_difference_;
};

class ShootingProblem final : public continuation::Problem {
 public:
  /// displacement: typical amplitude, m; omega: makes velocities comparable with it, rad/s; frequency: the
  /// scale of the excitation frequency, rad/s. Throws NotPiecewiseLinear, SingularMass, NotInTime.
  ShootingProblem(std::shared_ptr<const model::Model> model, double displacement, double omega,
                  double frequency, const EventLimits& limits = {});

  int size() const override { return 2 * model_->dofs + memory_; }
  std::span<const continuation::Parameter> parameters() const override { return parameters_; }
  Vector scales() const override;
  std::unique_ptr<continuation::Evaluator> evaluator() const override;
  bool cheap_residual() const override { return false; }

  const model::Model& model() const { return *model_; }
  const EventLimits& limits() const { return limits_; }
  double displacement() const { return displacement_; }

 private:
  std::shared_ptr<const model::Model> model_;
  int memory_;
  double displacement_, omega_;
  EventLimits limits_;
  std::vector<continuation::Parameter> parameters_;
};

}  // namespace arcslip::time
