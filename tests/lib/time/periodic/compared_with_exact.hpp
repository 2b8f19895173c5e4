#pragma once
// A response by harmonic balance and the exact periodic motion next to it.

#include "catch.hpp"

#include <arcslip/hbm/problem.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <cmath>

namespace compared_with_exact {

using namespace arcslip;

struct Pair {
  std::shared_ptr<const hbm::HbmProblem> problem;
  continuation::Vector p, u;
  time::EquationOfMotion equation;
};

inline Pair balanced(const scene::Scene& scene, double frequency) {
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  Pair pair{std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1e-4, 25), {}, {}, {}};
  pair.p = hbm::parameters_at(*pair.problem, frequency * scene::to_rad_per_s(scene.frequency_unit));
  const auto u = hbm::steady_state(pair.problem, pair.p).u;
  REQUIRE(u);
  pair.u = *u;
  pair.equation = time::equation_of_motion(*model, pair.p);
  return pair;
}

inline std::vector<double> over_period(const time::EquationOfMotion& equation, int count) {
  std::vector<double> t;
  for (int i = 0; i < count; ++i) t.push_back(equation.period() * i / count);
  return t;
}

struct Difference {
  double displacement;  // largest over the period, relative to the exact amplitude
  time::PeriodicMotion exact;
};

inline Difference difference(const Pair& pair, int instants) {
  time::EventDriven integrator(pair.equation);
  const auto t = over_period(pair.equation, instants);
  Difference result{0,
                    time::periodic_motion(integrator, time::state_of(*pair.problem, pair.u, pair.p), {}, t)};
  REQUIRE(result.exact.converged());
  const time::Matrix coefficients = time::dof_coefficients(*pair.problem, pair.u, pair.p);
  const time::Vector response = coefficients * pair.equation.response;
  const auto& history = result.exact.period.history;
  REQUIRE(history.time.size() == t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double x =
        elements::series_values(pair.problem->harmonics(), response, pair.equation.omega * t[i]).x;
    result.displacement = std::max(result.displacement, std::abs(x - history.displacement[i]));
  }
  result.displacement /= result.exact.period.amplitude;
  return result;
}

}  // namespace compared_with_exact
