#pragma once
// Periodic motions by shooting as a continuation problem, for structures with piecewise linear laws:
//
//   F(X, p) = Phi(X, p) - X = 0
//
// X = (x, x', z): the state at the start of the period T = 2 pi/omega; Phi: that after it, by event-driven
// integration, exact; rows of sliders that rest throughout as in periodicity_conditions.hpp. p: the model's
// parameters, "frequency" first. Derivatives by each are those of a variation of the motion, y = dx/dp at a
// fixed t (time/equation/parameter_derivatives.hpp), and with the frequency of the period, T' = -T/omega:
//
//   dPhi/dp = (y, y', dz/dp) + T' (x', x'', z')
//
// Pieces: the phases that each contact goes through. F is smooth as long as these remain, also where phases
// of two contacts change their order, since forces are continuous. Where the onset of a slip passes the start
// of the period, z there has a kink, and x has none. Source: docs/theory/09-event-driven.md.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

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
  /// Its derivatives by a parameter are those by the one that the last Jacobian carried along.
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

  /// Derivatives by a parameter, at the last place with J.
  struct ByParameter {
    int parameter = model::frequency;
    Vector F;
    double amplitude = 0;
  };
  const ByParameter& by(int k) const;
  void set_by(int k, const Orbit& orbit) const;

  const ShootingProblem& problem_;
  Vector X_, p_;
  std::unique_ptr<EventDriven> integrator_;  // at p_
  Orbit orbit_;
  Vector F_;
  continuation::Jacobian J_;
  Vector X_of_J_, p_of_J_;
  mutable ByParameter by_;  // of the parameter last asked for, which the next orbit carries along
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
