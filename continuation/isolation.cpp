#include <arcslip/continuation/isolation.hpp>

#include <arcslip/continuation/reduction.hpp>

#include <cmath>
#include <exception>
#include <numbers>

namespace arcslip::continuation {
namespace {

constexpr double radius = 1e-3;     // relative to 1 + |u|: of the circle on which solutions are looked for
constexpr double rounding = 1e-13;  // of beta there, in the size of its terms
constexpr int places = 7;           // on the circle

}  // namespace

std::string doubt_of_isolation(const Problem& problem, const Vector& v, const Vector& p, int along,
                               const MakeLinearSolver& make_solver) try {
  Reduction reduction(problem, p, along, 1, make_solver);
  if (!reduction.move_to(v) || !reduction.settle().allFinite() || !reduction.move_to(reduction.x()))
    return {};
  const double r = radius * (1 + reduction.size());
  Vector place;
  for (int k = 0; k < places; ++k) {
    const double angle = 0.3 + 2 * std::numbers::pi * k / places;
    const Vector beta = reduction.beta(r * Vector{{std::cos(angle), std::sin(angle)}}, place);
    if (!(std::abs(beta[0]) <= rounding * reduction.magnitude() * r)) return {};
  }
  return "; the solutions here are not isolated: [J F_p] has a null space of two dimensions along the "
         "branch, as where "
         "a symmetry (rotations, shifts in time) turns each solution into a family: add a phase condition";
} catch (const std::exception&) {
  return {};
}

}  // namespace arcslip::continuation
