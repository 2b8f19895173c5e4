#include <arcslip/time/equation_of_motion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::time {

double EquationOfMotion::period() const {
  return 2 * std::numbers::pi / omega;
}

void EquationOfMotion::force(double t, Vector& f) const {
  f.setZero(dofs());
  for (const HarmonicForce& part : forces) {
    const double angle = part.harmonic * omega * t;
    f += (part.cosine * std::cos(angle) + part.sine * std::sin(angle)) * part.direction;
  }
}

bool EquationOfMotion::is_piecewise_linear() const {
  return std::none_of(elements.begin(), elements.end(), [](const Element& element) {
    return element.law == model::Law::cubic_spring && element.stiffness != 0;
  });
}

EquationOfMotion equation_of_motion(const model::Model& model, const continuation::Vector& p) {
  EquationOfMotion equation;
  equation.omega = p[model::frequency];
  equation.M = model::assemble(model.masses, p, model.dofs);
  equation.C = model::assemble(model.dampers, p, model.dofs);
  equation.K = model::assemble(model.springs, p, model.dofs);
  for (const model::NonlinearPart& part : model.elements) {
    Element element{part.name, part.law, part.direction, p[part.parameters[0]]};
    if (part.law == model::Law::jenkins) {
      element.slip_limit = p[part.parameters[1]] * p[part.parameters[2]];
      element.slider = equation.sliders++;
    }
    equation.elements.push_back(std::move(element));
  }
  for (const model::Force& part : model.forces)
    equation.forces.push_back({part.direction, part.harmonic, p[part.cosine], p[part.sine]});
  equation.response = model.response;
  equation.dof_names = model.dof_names;
  return equation;
}

State at_rest(const EquationOfMotion& equation) {
  return {Vector::Zero(equation.dofs()), Vector::Zero(equation.dofs()), Vector::Zero(equation.sliders)};
}

}  // namespace arcslip::time
