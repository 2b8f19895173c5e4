#pragma once
// Multipliers along x = amplitude cos theta, for the methods that give them: time::Floquet, time::Hill.

#include "catch.hpp"

#include <arcslip/stability/floquet.hpp>

#include <vector>

namespace cosine {

using namespace arcslip;

// With the elements of `equation`, each on the first coordinate.
inline std::vector<time::ElementCourse> along(const time::EquationOfMotion& equation,
                                              const elements::Harmonics& harmonics, double amplitude) {
  time::Matrix q = time::Matrix::Zero(harmonics.size(), 1);
  q(harmonics.cosine_index(1), 0) = amplitude;
  return std::vector<time::ElementCourse>(equation.elements.size(), {q, {}});
}

template <class Method = time::Floquet>
double trace(const time::EquationOfMotion& equation, const elements::Harmonics& harmonics, double amplitude,
             double omega = 1) {
  Method method(equation);
  REQUIRE(method.compute(omega, harmonics, along(equation, harmonics, amplitude)));
  return method.map().trace();
}

}  // namespace cosine
