#pragma once
// The courses of the elements along a response by harmonic balance, and its Floquet multipliers.

#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/stability/floquet.hpp>

#include <complex>
#include <vector>

namespace along_harmonics {

using namespace arcslip;

inline std::vector<time::ElementCourse> courses(const compared_with_exact::Pair& pair) {
  const auto evaluator = pair.problem->hbm_evaluator();
  evaluator->move_to(pair.u, pair.p, continuation::Needs::residual);
  std::vector<time::ElementCourse> found;
  time::courses_of(*pair.problem, *evaluator, found);
  return found;
}

inline std::vector<std::complex<double>> multipliers(const compared_with_exact::Pair& pair,
                                                     time::Floquet& floquet) {
  REQUIRE(floquet.compute(pair.equation.omega, pair.problem->harmonics(), courses(pair)));
  return floquet.multipliers();
}

inline std::vector<std::complex<double>> multipliers(const compared_with_exact::Pair& pair) {
  time::Floquet floquet(pair.equation);
  return multipliers(pair, floquet);
}

}  // namespace along_harmonics
