#include <arcslip/hbm/steady_state.hpp>

#include <arcslip/continuation/tracer.hpp>

#include <cmath>

namespace arcslip::hbm {

Vector linear_response(const HbmProblem& problem, const Vector& p) {
  DynamicStiffness stiffness(problem.model(), problem.coordinates(), problem.harmonics());
  Vector u = Vector::Zero(problem.size());
  if (!stiffness.move_to(p.head(p.size() - 1))) return Vector::Constant(u.size(), std::nan(""));
  stiffness.force(u);
  stiffness.solve(u);
  return u;
}

std::optional<Vector> steady_state(const std::shared_ptr<const HbmProblem>& problem, const Vector& p) {
  const int n = problem->size();
  continuation::Counts counts;
  continuation::NewtonOptions newton;
  newton.iterations = 30;
  continuation::Corrector corrector(*problem, p, model::frequency, newton, counts);
  Vector row = Vector::Zero(n + 1);
  row[n] = 1;
  for (const Vector& guess : {Vector(Vector::Zero(n)), linear_response(*problem, p)}) {
    if (!guess.allFinite()) continue;
    Vector v(n + 1);
    v << guess, p[model::frequency];
    if (corrector.correct(v, row, false).converged) return v.head(n);
  }

  Vector from_rest = p;
  from_rest[problem->excitation_factor()] = 0;
  continuation::Options options;
  options.lower = 0;
  options.upper = 1;
  const auto ramp =
      continuation::trace(problem, {Vector::Zero(n), from_rest, problem->excitation_factor(), 1}, options);
  if (ramp.stop.reason != continuation::StopReason::boundary || ramp.points.back().parameter != 1) return {};
  return ramp.points.back().u;
}

}  // namespace arcslip::hbm
