#include <arcslip/observables/extended_harmonics.hpp>

#include <cmath>
#include <utility>

namespace arcslip::observables {

using continuation::In;
using continuation::Out;
using continuation::Vector;

WideEquations::WideEquations(const hbm::HbmProblem& problem, const elements::Harmonics& wide)
    : narrow_(problem),
      kept_(problem.harmonics()),
      wide_(wide),
      problem_(problem, wide_, {.exact = true}),
      evaluator_(problem_.hbm_evaluator()),
      u_(problem_.size()),
      F_q_(u_.size()),
      rest_(u_.size()),
      sweep_(u_.size()),
      part_(u_.size()),
      kept_part_(problem.size() + 1) {
  for (int j = kept_.sines(); j < wide_.sines(); ++j) orders_.push_back(wide_.sine_order(j));
  const int side = 2 * problem.blocks();
  block_.resize(side, side);
  harmonic_.resize(side);
  harmonic_residual_.resize(side);
  for (std::size_t k = 0; k < orders_.size(); ++k) lus_.emplace_back(side);
}

bool WideEquations::move_to(In u, In p) {
  embed(u, u_);
  return evaluator_->move_to(u_, p, continuation::Needs::jacobian) == continuation::Evaluated::ok;
}

void WideEquations::factorize(int q) {
  for (std::size_t k = 0; k < orders_.size(); ++k) {
    evaluator_->jacobian_of_order(orders_[k], block_);
    lus_[k].factorize(block_);
  }
  evaluator_->parameter_derivative(q, F_q_);
}

bool WideEquations::factorize_kept(const Border& border, int q, continuation::LinearSolver& solver) const {
  const auto& J = std::get<Eigen::MatrixXd>(evaluator_->jacobian());
  const int n = narrow_.size(), r = narrow_.blocks(), c = wide_.size();
  std::vector<int> place;
  for (int i = 0; i < r; ++i) {
    for (int k = 0; k < kept_.cosines(); ++k) place.push_back(i * c + k);
    for (int k = 0; k < kept_.sines(); ++k) place.push_back(i * c + wide_.cosines() + k);
  }
  Eigen::MatrixXd kept(n, n);
  continuation::Borders borders(n, 1);
  Vector F_q(c * r);
  evaluator_->parameter_derivative(q, F_q);
  for (int j = 0; j < n; ++j) {
    const int from = place[static_cast<std::size_t>(j)];
    for (int i = 0; i < n; ++i) kept(i, j) = J(place[static_cast<std::size_t>(i)], from);
    borders.rows(j, 0) = border.row[from];
    borders.columns(j, 0) = F_q[from];
  }
  borders.corner(0, 0) = border.parameter;
  return solver.factorize(kept, borders);
}

double WideEquations::solve(const continuation::LinearSolver& kept, const Vector& r, const Border& border,
                            Change& change, double enough) {
  const int unknowns = narrow_.blocks(), c = wide_.size(), n = narrow_.size();
  change.u.setZero(u_.size());
  change.parameter = 0;
  rest_ = r;  // the equations' residual at the change so far
  double first = 0;
  for (int sweep = 0; sweep < 2; ++sweep) {
    sweep_.setZero();
    for (std::size_t k = 0; k < orders_.size(); ++k) {
      const int place[2] = {wide_.cosine_index(orders_[k]), wide_.sine_index(orders_[k])};
      for (int i = 0; i < 2 * unknowns; ++i) harmonic_residual_[i] = -rest_[i / 2 * c + place[i % 2]];
      lus_[k].solve(harmonic_residual_, harmonic_);
      for (int i = 0; i < 2 * unknowns; ++i) sweep_[i / 2 * c + place[i % 2]] = harmonic_[i];
    }
    const double neglected = sweep_.norm();
    evaluator_->apply_jacobian(sweep_, part_);
    rest_ += part_;
    change.u += sweep_;
    part_ = rest_;
    take_kept(part_, kept_part_.head(n));
    kept_part_ = -kept_part_;
    kept_part_[n] = 0;
    if (border.row.size() > 0)
      kept_part_[n] = -border.value - border.row.dot(change.u) - border.parameter * change.parameter;
    kept.solve(kept_part_);
    embed(kept_part_.head(n), sweep_);
    const double size = std::hypot(neglected, sweep_.norm());
    change.u += sweep_;
    change.parameter += kept_part_[n];
    if (sweep == 0) {
      if (size <= enough) return 0;
      first = size;
      evaluator_->apply_jacobian(sweep_, part_);
      rest_ += part_ + kept_part_[n] * F_q_;
    } else if (first > 0) {
      return size / first;
    }
  }
  return 0;
}

bool WideEquations::look_nearby(In wide, In p) {
  if (!nearby_) nearby_ = problem_.hbm_evaluator();
  return nearby_->move_to(wide, p, continuation::Needs::jacobian) == continuation::Evaluated::ok &&
         nearby_->piece() == evaluator_->piece();
}

const hbm::HbmEvaluator* WideEquations::look_at(In wide, In p) {
  if (!nearby_) nearby_ = problem_.hbm_evaluator();
  const auto done = nearby_->move_next_to(*evaluator_, wide, p, continuation::Needs::residual);
  return done == continuation::Evaluated::ok ? nearby_.get() : nullptr;
}

void WideEquations::apply(const hbm::HbmEvaluator& at, const Change& change, int q, Vector& y) {
  y.resize(change.u.size());
  at.apply_jacobian(change.u, y);
  Vector F_q(y.size());
  at.parameter_derivative(q, F_q);
  y += change.parameter * F_q;
}

void WideEquations::embed(In u, Vector& wide) const {
  wide.resize(problem_.size());
  elements::transfer(kept_, u, wide_, wide);
}

void WideEquations::take_kept(Vector& wide, Out kept) const {
  const int unknowns = narrow_.blocks();
  for (int i = 0; i < unknowns; ++i) {
    auto from = wide.segment(i * wide_.size(), wide_.size());
    auto to = kept.segment(i * kept_.size(), kept_.size());
    to.head(kept_.cosines()) = from.head(kept_.cosines());
    to.tail(kept_.sines()) = from.segment(wide_.cosines(), kept_.sines());
    from.head(kept_.cosines()).setZero();
    from.segment(wide_.cosines(), kept_.sines()).setZero();
  }
}

}  // namespace arcslip::observables
