#include <arcslip/hbm/steady_state.hpp>

#include <arcslip/continuation/tracer.hpp>

#include <cmath>

namespace arcslip::hbm {
namespace {

constexpr long longest_ramp = 3000;  // points; some 300 are usual, a branch that closes on itself never ends

// The branch from rest through the excitation factors from -1 to 1. All laws are antisymmetric: u at -1 is
// -u at 1. So it may leave rest on either side, or come back through 0, where u need not be zero.
std::optional<Vector> ramp(const std::shared_ptr<const HbmProblem>& problem, Vector p,
                           const std::function<bool()>& go_on) {
  const int factor = problem->excitation_factor();
  p[factor] = 0;
  continuation::Options options;
  options.lower = -1;
  options.upper = 1;
  options.check_jacobian = false;
  options.step.largest_parameter = 0.01;
  options.points = longest_ramp;
  options.go_on = go_on;
  const auto branch = continuation::trace(problem, {Vector::Zero(problem->size()), p, factor, 1}, options);
  if (branch.stop.reason != continuation::StopReason::boundary) return {};
  return branch.points.back().parameter * branch.points.back().u;
}

}  // namespace

Vector linear_response(const HbmProblem& problem, const Vector& p) {
  DynamicStiffness stiffness(problem.model(), problem.coordinates(), problem.harmonics());
  Vector u = Vector::Zero(problem.size());
  if (!stiffness.move_to(p.head(p.size() - 1))) return Vector::Constant(u.size(), std::nan(""));
  stiffness.force(u);
  stiffness.solve(u);
  return u;
}

std::optional<Vector> response_near(const HbmProblem& problem, const Vector& p, const Vector& guess) {
  if (!guess.allFinite()) return {};
  const int n = problem.size();
  continuation::Counts counts;
  continuation::NewtonOptions newton;
  newton.iterations = 30;
  continuation::Corrector corrector(problem, p, model::frequency, newton, counts);
  Vector v(n + 1);
  v << guess, p[model::frequency];
  if (!corrector.correct(v, Vector::Unit(n + 1, n), false).converged) return {};
  return v.head(n);
}

std::optional<Vector> steady_state(const std::shared_ptr<const HbmProblem>& problem, const Vector& p,
                                   const std::function<bool()>& go_on) {
  for (const Vector& guess : {Vector(Vector::Zero(problem->size())), linear_response(*problem, p)})
    if (const auto found = response_near(*problem, p, guess)) return found;
  return ramp(problem, p, go_on);
}

}  // namespace arcslip::hbm
