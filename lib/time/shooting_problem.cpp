#include <arcslip/time/shooting_problem.hpp>

#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/time/periodicity.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::time {

using continuation::Evaluated;
using continuation::In;
using continuation::Needs;
using continuation::Out;

namespace {

constexpr double step_at_birth = 1e-2;  // of the step of central differences

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
  if (!X.allFinite() || !(p[model::frequency] > 0)) return Evaluated::outside_domain;
  set_parameters(p);
  X_ = X;
  orbit_ = integrator_->orbit(unstacked_start(), needs == Needs::jacobian);
  if (!orbit_.map.done) throw std::runtime_error(orbit_.map.message);
  defect_of(orbit_.map, X, F_);
  if (needs == Needs::residual) return Evaluated::ok;
  defect_by_start(orbit_.map, std::get<Matrix>(J_));
  by_frequency_ = problem_.model().harmonics.base_frequency(1) * orbit_.by_omega;
  X_of_J_ = X_;
  p_of_J_ = p_;
  piece_of_J_ = orbit_.phases;
  amplitude_by_frequency_ = orbit_.amplitude_by[orbit_.amplitude_by.size() - 1];
  instant_of_J_ = orbit_.amplitude_time;
  extreme_of_J_ = orbit_.extreme;
  differentiated_by_ = -1;
  return Evaluated::ok;
}

const Orbit& ShootingEvaluator::orbit() {
  if (orbit_.by_omega.size() == 0) move_to(Vector(X_), Vector(p_), Needs::jacobian);
  return orbit_;
}

void ShootingEvaluator::parameter_derivative(int k, Out dF) const {
  dF = k == model::frequency ? by_frequency_ : by_difference(k).head(F_.size());
}

double ShootingEvaluator::amplitude_derivative(int k) const {
  if (k == model::frequency) return problem_.model().harmonics.base_frequency(1) * amplitude_by_frequency_;
  return by_difference(k)[F_.size()];
}

const Vector& ShootingEvaluator::by_difference(int k) const {
  if (differentiated_by_ == k) return by_difference_;
  ShootingEvaluator beside(problem_);
  std::array<Vector, 2> values;
  Vector p = p_of_J_;
  const double sign = extreme_of_J_ < 0 ? -1 : 1;
  const auto values_at = [&](double distance, Vector& of) {
    p[k] = p_of_J_[k] + distance;
    if (beside.move_to(X_of_J_, p, Needs::residual) != Evaluated::ok) return false;
    of.resize(beside.F_.size() + 1);
    of << beside.F_, sign * beside.integrator_->response(beside.unstacked_start(), instant_of_J_);
    return of.allFinite();
  };
  const double step = continuation::difference_step * (p[k] != 0 ? std::abs(p[k]) : 1);
  const auto quotient = continuation::difference_within_piece(step, [&](std::size_t i, double distance) {
    return values_at(distance, values[i]) && beside.piece() == piece_of_J_;
  });
  if (quotient) {
    by_difference_ = quotient->weight[0] * values[0] + quotient->weight[1] * values[1];
    if (quotient->here != 0 && values_at(0, values[0])) by_difference_ += quotient->here * values[0];
  } else {
    // Where a phase of contact is just born, as at the onset of slip, the derivative is almost that beside
    // it.
    const double h = step_at_birth * step;
    if (!values_at(h, values[0]) || !values_at(-h, values[1]))
      throw std::runtime_error("there is no motion beside \"" +
                               problem_.parameters()[static_cast<std::size_t>(k)].name +
                               "\" = " + std::to_string(p_of_J_[k]));
    by_difference_ = (values[0] - values[1]) / (2 * h);
  }
  differentiated_by_ = k;
  return by_difference_;
}

}  // namespace arcslip::time
