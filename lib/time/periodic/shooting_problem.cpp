#include <arcslip/time/periodic/shooting_problem.hpp>

#include <arcslip/control/error.hpp>
#include <arcslip/time/periodic/periodicity_conditions.hpp>

#include <optional>
#include <sstream>
#include <utility>

namespace arcslip::time {

using continuation::Evaluated;
using continuation::In;
using continuation::Needs;
using continuation::Out;

namespace {

constexpr double just_nearby = 1e-9;  // of the size of a parameter

}  // namespace

ShootingProblem::ShootingProblem(std::shared_ptr<const model::Model> model, double displacement, double omega,
                                 double frequency, const EventLimits& limits)
    : model_(std::move(model)),
      displacement_(displacement),
      omega_(omega),
      limits_(limits),
      parameters_(model_->parameters) {
  parameters_[model::frequency].scale = frequency;
  const EquationOfMotion equation = equation_of_motion(*model_, continuation::parameter_values(*this));
  memory_ = equation.memory;
  EventDriven{equation};  // throws where it cannot be integrated
}

Vector ShootingProblem::scales() const {
  Vector scales = Vector::Constant(size(), displacement_);
  scales.segment(model_->dofs, model_->dofs) *= omega_;
  return scales;
}

std::unique_ptr<continuation::Evaluator> ShootingProblem::evaluator() const {
  return std::make_unique<ShootingEvaluator>(*this);
}

ShootingEvaluator::ShootingEvaluator(const ShootingProblem& problem)
    : problem_(problem), J_(Matrix::Zero(problem.size(), problem.size())) {}

void ShootingEvaluator::set_parameters(In p) {
  if (integrator_ && p == p_) return;
  p_ = p;
  integrator_ = std::make_unique<EventDriven>(equation_of_motion(problem_.model(), p_), problem_.limits());
}

MotionState ShootingEvaluator::unstacked_start() const {
  return unstacked(X_, problem_.model().dofs);
}

Evaluated ShootingEvaluator::move_to(In X, In p, Needs needs) {
  if (!X.allFinite() || !(p[model::frequency] > 0) || !model::within_bounds(problem_.model(), p))
    return Evaluated::outside_domain;
  set_parameters(p);
  X_ = X;
  std::optional<EquationRates> rates;
  int k = by_.parameter;
  if (needs == Needs::jacobian) {
    rates = equation_rates(problem_.model(), p_, k);
    if (!rates) {
      k = model::frequency;  // which no mode depends on
      rates = equation_rates(problem_.model(), p_, k);
    }
  }
  orbit_ = integrator_->orbit(unstacked_start(), rates ? &*rates : nullptr);
  if (!orbit_.map.done) throw Error(orbit_.map.message);
  defect_of(orbit_.map, X, F_);
  if (!rates) return Evaluated::ok;
  defect_by_start(orbit_.map, std::get<Matrix>(J_));
  X_of_J_ = X_;
  p_of_J_ = p_;
  set_by(k, orbit_);
  return Evaluated::ok;
}

void ShootingEvaluator::set_by(int k, const Orbit& orbit) const {
  by_ = {k, orbit.by_parameter, orbit.amplitude_by.tail<1>()[0]};
}

const Orbit& ShootingEvaluator::orbit() {
  if (orbit_.by_parameter.size() == 0) move_to(Vector(X_), Vector(p_), Needs::jacobian);
  return orbit_;
}

void ShootingEvaluator::parameter_derivative(int k, Out dF) const {
  dF = by(k).F;
}

double ShootingEvaluator::amplitude_derivative(int k) const {
  return by(k).amplitude;
}

const ShootingEvaluator::ByParameter& ShootingEvaluator::by(int k) const {
  if (by_.parameter == k) return by_;
  Vector p = p_of_J_;
  const continuation::Parameter& parameter = problem_.parameters()[static_cast<std::size_t>(k)];
  auto rates = equation_rates(problem_.model(), p, k);
  if (!rates) {
    // Where an element has other modes next to p than at p, as at a normal load of 0, those next to it.
    p[k] += just_nearby * size_of_parameter(problem_.model(), p, k);
    rates = equation_rates(problem_.model(), p, k);
  }
  if (!rates) {
    std::ostringstream text;
    text << "there is no derivative by \"" << parameter.name << "\" at " << p_of_J_[k];
    throw Error(text.str());
  }
  EventDriven integrator(equation_of_motion(problem_.model(), p), problem_.limits());
  const Orbit orbit = integrator.orbit(unstacked(X_of_J_, problem_.model().dofs), &*rates);
  if (!orbit.map.done) throw Error(orbit.map.message);
  set_by(k, orbit);
  return by_;
}

}  // namespace arcslip::time
