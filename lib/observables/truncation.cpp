#include <arcslip/observables/truncation.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr int least_tail = 9;            // orders above N looked at: N + 9 at least, 2 N + 9 in all
constexpr double linear_motion = 1e-13;  // forces left out, relative: below, nothing is neglected
constexpr double at_a_fold = 1e-9;       // of domega/ds: below, the frequency cannot be held fixed

std::shared_ptr<const model::Model> with_exact_friction(model::Model model) {
  model.settings.friction = scene::Friction::exact;
  return std::make_shared<const model::Model>(std::move(model));
}

elements::Harmonics widened(const elements::Harmonics& h) {
  return {2 * h.order + least_tail, h.odd};
}

}  // namespace

double highest_natural_frequency(const model::Model& model, const Vector& p) {
  const Eigen::MatrixXd M = model::assemble(model.masses, p, model.dofs);
  Eigen::MatrixXd K = model::assemble(model.springs, p, model.dofs);
  for (const auto& element : model.elements)
    if (element.law == model::Law::jenkins)
      K += p[element.parameters[0]] * element.direction * element.direction.transpose();
  // M v = mu (K + shift M) v: mu = 1/(omega^2 + shift), zero for massless motions; definite with any shift >
  // 0.
  const double shift = std::max(K.cwiseAbs().maxCoeff() / std::max(M.cwiseAbs().maxCoeff(), 1e-300), 1e-300);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, K + shift * M,
                                                                         Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) return 0;
  const double largest = solver.eigenvalues().maxCoeff();
  double highest = 0;
  for (double mu : solver.eigenvalues())
    if (mu > 1e-12 * largest) highest = std::max(highest, 1 / mu - shift);
  return std::sqrt(highest);
}

Truncation::Truncation(const hbm::HbmProblem& problem, const Vector& p)
    : problem_(problem),
      kept_(problem.harmonics()),
      wide_(widened(kept_)),
      wide_problem_(with_exact_friction(problem.model()), wide_, 1, 1),
      evaluator_(wide_problem_.hbm_evaluator()),
      highest_(highest_natural_frequency(problem.model(), p)),
      u_(wide_problem_.size()),
      tail_(u_.size()),
      effect_(u_.size()),
      change_(problem.size() + 1),
      residual_(problem.size()),
      response_(wide_.size()) {}

void Truncation::embed(continuation::In u, Vector& wide) const {
  wide.setZero();
  const int unknowns = problem_.coordinates().unknowns;
  for (int i = 0; i < unknowns; ++i) {
    const auto from = u.segment(i * kept_.size(), kept_.size());
    auto to = wide.segment(i * wide_.size(), wide_.size());
    to.head(kept_.cosines()) = from.head(kept_.cosines());
    to.segment(wide_.cosines(), kept_.sines()) = from.tail(kept_.sines());
  }
}

void Truncation::restrict_to_kept(Vector& wide, continuation::Out kept) const {
  const int unknowns = problem_.coordinates().unknowns;
  for (int i = 0; i < unknowns; ++i) {
    auto from = wide.segment(i * wide_.size(), wide_.size());
    auto to = kept.segment(i * kept_.size(), kept_.size());
    to.head(kept_.cosines()) = from.head(kept_.cosines());
    to.tail(kept_.sines()) = from.segment(wide_.cosines(), kept_.sines());
    from.head(kept_.cosines()).setZero();
    from.segment(wide_.cosines(), kept_.sines()).setZero();
  }
}

TruncationEstimate Truncation::estimate(const continuation::Accepted& now, const Extreme& extreme) {
  const int n = problem_.size();
  embed(now.u, u_);
  if (evaluator_->move_to(u_, now.p, continuation::Needs::jacobian) != continuation::Evaluated::ok)
    return {0, true};
  double force = 0;
  for (std::size_t e = 0; e < evaluator_->element_count(); ++e)
    force = std::max(force, evaluator_->element(e).force().cwiseAbs().maxCoeff());
  tail_ = evaluator_->residual();
  restrict_to_kept(tail_, residual_);  // what remains in tail_ are the f_n with n > N
  if (tail_.cwiseAbs().maxCoeff() <= linear_motion * force &&
      residual_.cwiseAbs().maxCoeff() <= linear_motion * force)
    return {};

  evaluator_->stiffness().solve(tail_);
  tail_ = -tail_;
  continuation::apply(evaluator_->jacobian(), tail_, effect_);
  restrict_to_kept(effect_, change_.head(n));
  change_.head(n) = -change_.head(n) - residual_;
  change_[n] = 0;
  now.bordered.solve(change_);
  const double along = now.tangent[n];
  if (std::abs(along) > at_a_fold * std::abs(change_[n])) change_ -= change_[n] / along * now.tangent;
  embed(change_.head(n), u_);
  u_ += tail_;
  evaluator_->stiffness().response(u_, 0, response_);
  return {std::abs(amplitude_change(wide_, extreme, response_)),
          kept_.order * now.p[model::frequency] < highest_};
}

}  // namespace arcslip::observables
