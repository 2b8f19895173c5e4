#include <arcslip/time/equation_of_motion.hpp>

#include <cmath>
#include <numbers>
#include <utility>

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

void EquationOfMotion::add(std::string name, std::shared_ptr<const elements::Law> law,
                           std::vector<double> fields, Matrix directions) {
  elements.push_back({std::move(name), std::move(law), std::move(fields), std::move(directions), memory});
  memory += elements.back().law->memory();
}

EquationOfMotion equation_of_motion(const model::Model& model, const continuation::Vector& p) {
  EquationOfMotion equation;
  equation.omega = model.harmonics.base_frequency(p[model::frequency]);
  equation.M = model::assemble(model.masses, p, model.dofs);
  equation.C = model::assemble(model.dampers, p, model.dofs);
  equation.K = model::assemble(model.springs, p, model.dofs);
  for (const model::NonlinearPart& part : model.elements) {
    if (part.law->set_valued())
      throw SetValued("the friction of \"" + part.name +
                      "\" has no stiffness: while it holds, its force is any within its limit, which "
                      "integration in time does not determine; give the contact a stiffness");
    Matrix directions(model.dofs, static_cast<Eigen::Index>(part.directions.size()));
    for (std::size_t i = 0; i < part.directions.size(); ++i)
      directions.col(static_cast<Eigen::Index>(i)) = part.directions[i];
    equation.add(part.name, part.law, part.fields(p), std::move(directions));
  }
  for (const model::Force& part : model.forces)
    equation.forces.push_back(
        {part.direction, model.harmonics.excited(part.harmonic), p[part.cosine], p[part.sine]});
  equation.response = model.response;
  equation.dof_names = model.dof_names;
  return equation;
}

MotionState at_rest(const EquationOfMotion& equation) {
  return {Vector::Zero(equation.dofs()), Vector::Zero(equation.dofs()), Vector::Zero(equation.memory)};
}

}  // namespace arcslip::time
