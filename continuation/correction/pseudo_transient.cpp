#include <arcslip/continuation/correction/pseudo_transient.hpp>

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double first_change = 0.1;  // of the first step, relative to 1 + |u|, in scales
constexpr double largest_change = 1;  // of a step, likewise
constexpr double shorter = 0.25;      // after a step that is too long
constexpr int shortenings = 30;
constexpr double fastest_growth = 10;      // of the length of the steps
constexpr double rounding = 1e-9;          // of F, relative to the terms of J u
constexpr double smallest_unknown = 1e-6;  // in scales: below, these terms are those of it

// I / h - direction J. The sum of sparse matrices has the pattern of both, also where entries cancel.
Jacobian shifted(const Jacobian& J, double length, int direction) {
  if (const auto* dense = std::get_if<Matrix>(&J)) {
    Matrix sum = -direction * *dense;
    sum.diagonal().array() += 1 / length;
    return sum;
  }
  const auto& sparse = std::get<SparseMatrix>(J);
  SparseMatrix identity(sparse.rows(), sparse.cols());
  identity.setIdentity();
  return SparseMatrix(identity / length - direction * sparse);
}

}  // namespace

PseudoTransient::PseudoTransient(const Problem& problem, Corrector& with,
                                 std::unique_ptr<LinearSolver> solver, const Vector& guess, int direction)
    : with_(with),
      direction_(direction),
      solver_(std::move(solver)),
      none_(problem.size(), 0),
      v_(guess),
      trial_(guess),
      change_(Vector::Zero(guess.size())),
      F_(Vector::Zero(guess.size())) {
  if (!look() || is_solution(problem.scales())) return;
  length_ = first_change * (1 + with_.norm_u(v_)) / residual_;
}

// F and J at the trial point.
bool PseudoTransient::look() {
  if (!with_.move_to(trial_, Needs::jacobian)) return false;
  const Jacobian& J = with_.evaluator().jacobian();
  if (std::holds_alternative<const Operator*>(J)) return false;
  const Eigen::Index n = F_.size() - 1;
  F_.head(n) = with_.evaluator().residual();
  J_ = J;
  residual_ = with_.norm_u(F_);
  return true;
}

// To rounding: with a singular J steps would lead from there to any other solution.
bool PseudoTransient::is_solution(const Vector& scales) const {
  const Eigen::Index n = F_.size() - 1;
  const Vector size = v_.head(n).cwiseAbs().cwiseMax(smallest_unknown * scales);
  const auto* dense = std::get_if<Matrix>(&J_);
  const Vector terms =
      dense ? Vector(dense->cwiseAbs() * size) : Vector(std::get<SparseMatrix>(J_).cwiseAbs() * size);
  return (F_.head(n).array().abs() <= rounding * terms.array()).all();
}

bool PseudoTransient::solve() try {
  const Eigen::Index n = F_.size() - 1;
  const Jacobian matrix = shifted(J_, length_, direction_);
  if (!solver_) solver_ = suitable_solver(matrix);
  if (!solver_->factorize(matrix, none_)) return false;
  change_.head(n) = direction_ * F_.head(n);
  solver_->solve(change_.head(n));
  return change_.allFinite();
} catch (const std::exception&) {  // of the linear solver
  return false;
}

bool PseudoTransient::step() {
  const double before = residual_;
  for (int k = 0; k < shortenings; ++k, length_ *= shorter) {
    if (!std::isfinite(length_) || length_ == 0) return false;
    if (!solve() || with_.norm_u(change_) > largest_change * (1 + with_.norm_u(v_))) continue;
    trial_ = v_ + change_;
    if (!look()) continue;
    v_ = trial_;
    length_ *= std::clamp(before / residual_, 1 / fastest_growth, fastest_growth);
    return true;
  }
  return false;
}

}  // namespace arcslip::continuation
