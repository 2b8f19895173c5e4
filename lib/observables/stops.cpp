#include <arcslip/observables/stops.hpp>

namespace arcslip::observables {
namespace {

constexpr double within_range = 1e-8;  // of d: the residual of M y = d, where M has a part without mass

}  // namespace

bool Stops::at_reversals(const elements::Element& at, std::size_t e, const continuation::Vector& p) {
  const double ratio = at.jump_over_bend();
  if (!(ratio > 0)) return false;
  const double omega = model_.harmonics.base_frequency(p[model::frequency]);
  const model::NonlinearPart& element = model_.elements[e];
  double mass = inertia(element.directions.front(), p);
  if (!element.next.empty() && element.next.front().size() > 0) {  // of both sectors, which give way together
    const double next = inertia(element.next.front(), p);
    const bool alone = element.directions.front().nonZeros() == 0;
    mass = alone ? next : mass > 0 && next > 0 ? 1 / (1 / mass + 1 / next) : 0;
  }
  return !(mass * omega * omega > ratio);
}

// 1/(d^T M^-1 d), and 0 where a part of d has no mass.
double Stops::inertia(const model::Direction& d, const continuation::Vector& p) {
  continuation::Vector values(static_cast<Eigen::Index>(model_.masses.size()));
  for (std::size_t k = 0; k < model_.masses.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = p[model_.masses[k].parameter];
  if (M_.rows() == 0 || values != masses_) {
    masses_ = values;
    M_ = model::mass_matrix(model_, p);
    factors_.compute(M_);
  }
  const continuation::Vector full = d, y = factors_.solve(full);
  const bool moves_mass = (M_ * y - full).norm() <= within_range * full.norm();
  return moves_mass ? 1 / full.dot(y) : 0;
}

}  // namespace arcslip::observables
