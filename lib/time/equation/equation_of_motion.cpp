#include <arcslip/time/equation/equation_of_motion.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace arcslip::time {

double EquationOfMotion::period() const {
  return 2 * std::numbers::pi / omega;
}

double EquationOfMotion::phase(double share) const {
  return periods * share * 2 * std::numbers::pi;
}

Matrix EquationOfMotion::circulatory() const {
  if (K == K.transpose()) return {};
  return 0.5 * (K - K.transpose());
}

void EquationOfMotion::force(double t, Vector& f) const {
  f.setZero(dofs());
  for (const HarmonicForce& part : forces) {
    const double angle = part.harmonic * omega * t;
    f += (part.cosine * std::cos(angle) + part.sine * std::sin(angle)) * part.direction;
  }
}

EquationOfMotion::Observed EquationOfMotion::observed(double t, const Vector& x, const Vector& v) const {
  Observed at{response.dot(x), response.dot(v)};
  for (const BaseMotion& part : base) {
    const double rate = part.harmonic * omega, c = std::cos(rate * t), s = std::sin(rate * t);
    at.x += part.cosine * c + part.sine * s;
    at.v += rate * (part.sine * c - part.cosine * s);
  }
  return at;
}

void EquationOfMotion::add(std::string name, std::shared_ptr<const elements::Law> law,
                           std::vector<double> fields, Matrix directions) {
  elements.push_back({std::move(name), std::move(law), std::move(fields), std::move(directions), memory});
  memory += elements.back().law->memory();
}

void check_response(const model::Model& model) {
  if (model.others.empty()) return;
  throw NotInTime(reasons::several_places,
                  "the response is the largest of " + std::to_string(1 + model.others.size()) +
                      " places, and a motion in time is followed at one: name one of them");
}

EquationOfMotion equation_of_motion(const model::Model& model, const continuation::Vector& p) {
  EquationOfMotion equation;
  equation.omega = model.harmonics.base_frequency(p[model::frequency]);
  equation.periods = model.harmonics.period;
  if (model.damping && model.damping->loss_factor_at(p) != 0)
    throw NotInTime(reasons::loss_factor,
                    "damping by a loss factor has no equation of motion in time; give \"beta\" in its place, "
                    "loss_factor/(angular frequency), which has the same damping at that frequency");
  if (model.sector)
    throw NotInTime(
        reasons::sector,
        "one sector of a ring has no equation of motion in time by itself; give \"cyclic\" the key "
        "\"full\": true, for the whole ring");
  equation.M = model::mass_matrix(model, p);
  equation.C = model::damping_matrix(model, p);
  equation.K = model::stiffness_matrix(model, p);
  if (model::is_symmetric(model))  // to the last bit
    for (Matrix* A : {&equation.M, &equation.C, &equation.K}) *A = 0.5 * (*A + A->transpose()).eval();
  for (const model::NonlinearPart& part : model.elements) {
    if (part.law->set_valued())
      throw NotInTime(reasons::set_valued,
                      "the friction of \"" + part.name +
                          "\" has no stiffness: while it holds, its force is any within its limit, which "
                          "integration in time does not determine; give the contact a stiffness");
    Matrix directions(model.dofs, static_cast<Eigen::Index>(part.directions.size()));
    for (std::size_t i = 0; i < part.directions.size(); ++i)
      directions.col(static_cast<Eigen::Index>(i)) = part.directions[i];
    equation.add(part.name, part.law, part.fields(p), std::move(directions));
  }
  for (const model::Excitation& part : model.excitation) {
    const int n = model.harmonics.excited(part.harmonic);
    const double w = p[model::frequency];
    const Vector g = model::shape(model, part, p);
    const std::complex<double> given = part.amplitude(p);
    equation.forces.push_back({g, n, given.real(), -given.imag()});
    const double along = model.absolute ? part.direction.dot(model.response) : 0;
    const double moved = along * part.displacement(w);
    if (moved != 0) equation.base.push_back({n, moved * given.real(), -moved * given.imag()});
  }
  equation.response = model.response;
  equation.dof_names = model.dof_names;
  return equation;
}

MotionState at_rest(const EquationOfMotion& equation) {
  return {Vector::Zero(equation.dofs()), Vector::Zero(equation.dofs()), Vector::Zero(equation.memory)};
}

}  // namespace arcslip::time
