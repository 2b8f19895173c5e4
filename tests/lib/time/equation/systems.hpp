#pragma once
// Structures for tests in the time domain.

#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/time/equation/equation_of_motion.hpp>

#include <cmath>

namespace systems {

using namespace arcslip;
using time::EquationOfMotion;
using time::Matrix;
using time::MotionState;
using time::Vector;

/// Masses without anything else, observed at the first.
inline EquationOfMotion masses(const Vector& m) {
  const auto n = m.size();
  EquationOfMotion equation;
  equation.omega = 1;
  equation.M = m.asDiagonal();
  equation.C = equation.K = Matrix::Zero(n, n);
  equation.response = Vector::Unit(n, 0);
  return equation;
}

/// m x'' + c x' + k x = f0 cos(omega t).
inline EquationOfMotion oscillator(double m, double c, double k, double f0 = 0, double omega = 1) {
  EquationOfMotion equation = masses(Vector::Constant(1, m));
  equation.C(0, 0) = c;
  equation.K(0, 0) = k;
  equation.omega = omega;
  equation.forces.push_back({Vector::Ones(1), 1, f0, 0});
  return equation;
}

inline void add_damper(EquationOfMotion& equation, const Vector& direction, double stiffness, double limit) {
  equation.add("d" + std::to_string(equation.memory), elements::jenkins().law({}), {stiffness, 1, limit},
               direction);
}

/// Of such an element.
inline double limit_of(const time::TimeElement& damper) {
  return damper.fields[1] * damper.fields[2];
}

/// The oscillator of Al Sayed et al. (2011).
inline EquationOfMotion paper(double hertz, double load, double c = 0.134) {
  EquationOfMotion equation = oscillator(1.24, c, 17890, 1, 2 * std::acos(-1.0) * hertz);
  add_damper(equation, Vector::Ones(1), 3500, 0.5 * load);
  return equation;
}

/// Two masses in a chain to the ground, a damper to the ground and one between, two harmonics of force.
inline EquationOfMotion two_masses() {
  EquationOfMotion equation = masses(Vector{{1.0, 0.6}});
  equation.K << 1.8, -0.8, -0.8, 0.9;
  equation.C << 0.05, -0.02, -0.02, 0.02;
  equation.omega = 0.9;
  equation.forces.push_back({Vector{{1.0, 0.0}}, 1, 1.0, 0.3});
  equation.forces.push_back({Vector{{0.0, 1.0}}, 2, 0.4, -0.2});
  add_damper(equation, Vector{{1.0, 0.0}}, 0.7, 0.3);
  add_damper(equation, Vector{{1.0, -1.0}}, 0.4, 0.15);
  return equation;
}

}  // namespace systems
