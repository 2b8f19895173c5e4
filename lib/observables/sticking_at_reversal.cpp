#include <arcslip/observables/sticking_at_reversal.hpp>

#include <arcslip/model/cyclic_waves.hpp>

namespace arcslip::observables {
namespace {

constexpr double within_range = 1e-8;  // of d: the residual of M y = d, where M has a part without mass

}  // namespace

bool Stops::at_reversals(const elements::Element& at, std::size_t e, const continuation::Vector& p) {
  const double ratio = at.jump_over_bend();
  if (!(ratio > 0)) return false;
  const double omega = model_.harmonics.base_frequency(p[model::frequency]);
  const model::NonlinearPart& element = model_.elements[e];
  move_to(p);
  const model::Direction& d = element.directions.front();
  const model::Direction next = element.next.empty() ? model::Direction() : element.next.front();
  double mass = 0;
  if (model_.linked || next.size() == 0) {
    mass = inertia(d, next);
  } else {  // of both sectors, which give way together
    const double own = inertia(d, {}), of_next = inertia(next, {});
    const bool alone = d.nonZeros() == 0;
    mass = alone ? of_next : own > 0 && of_next > 0 ? 1 / (1 / own + 1 / of_next) : 0;
  }
  return !(mass * omega * omega > ratio);
}

void Stops::move_to(const continuation::Vector& p) {
  std::vector<double> now;
  for (const model::LinearPart& part : model_.masses) now.push_back(part.number.value(p));
  for (const model::MatrixPart& part : model_.matrices)
    if (part.kind == model::LinearKind::mass) now.push_back(part.value(p));
  const Eigen::Map<const continuation::Vector> values(now.data(), static_cast<Eigen::Index>(now.size()));
  if (!masses_.empty() && values == values_) return;
  values_ = values;
  masses_.clear();
  double all = 0;
  const auto add = [&](std::complex<double> turn, double share, const Eigen::MatrixXd& M) {
    masses_.push_back({turn, share, M, Eigen::LDLT<Eigen::MatrixXd>(M)});
    all += share;
  };
  if (!model_.linked) {
    add(1, 1, model::mass_matrix(model_, p));
  } else {
    const model::Sector& sector = *model_.sector;
    for (const int diameter : diameters(sector)) {
      const bool both_ways = diameter > 0 && 2 * diameter < sector.count;
      add(turn(sector, diameter), both_ways ? 2 : 1,
          sum_in_wave(model_, model::LinearKind::mass, p, diameter));
    }
  }
  for (Mass& mass : masses_) mass.share /= all;
}

// 1/(d^T M^-1 d), and 0 where a part of d has no mass.
double Stops::inertia(const model::Direction& d, const model::Direction& next) {
  double sum = 0;
  for (const Mass& mass : masses_) {
    continuation::Vector force = continuation::Vector::Zero(mass.M.rows());
    force.head(model_.dofs) = continuation::Vector(d);
    if (next.size() > 0) {
      force.head(model_.dofs) += mass.turn.real() * continuation::Vector(next);
      force.tail(model_.dofs) = -mass.turn.imag() * continuation::Vector(next);
    }
    const continuation::Vector y = mass.factors.solve(force);
    if ((mass.M * y - force).norm() > within_range * force.norm()) return 0;
    sum += mass.share * force.dot(y);
  }
  return 1 / sum;
}

}  // namespace arcslip::observables
