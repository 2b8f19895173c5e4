#pragma once
// What evaluators and linear solvers of problems of special points share. Not installed.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>
#include <arcslip/continuation/special_points/neighbours.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace arcslip::continuation {

/// The equations F = 0 and further ones at x.
class AugmentedEvaluator : public Evaluator {
 public:
  const Vector& residual() const final { return R_; }
  const Jacobian& jacobian() const final { return jacobian_; }
  void parameter_derivative(int k, Out dR) const final {
    if (k == inner_->along) {
      dR.setZero();
      return;
    }
    here_.at().parameter_derivative(k, dR.head(n_));
    further_derivative(k, dR.tail(R_.size() - n_));
  }
  std::uint64_t piece() const final { return here_.at().piece(); }

  /// The inner problem, and its evaluator at the last point.
  const InnerProblem& inner() const { return *inner_; }
  const Site& here() const { return here_; }

 protected:
  AugmentedEvaluator(std::shared_ptr<const InnerProblem> inner, Eigen::Index further)
      : inner_(std::move(inner)), n_(inner_->size()), here_(*inner_), nearby_(*inner_), R_(n_ + further) {}

  /// The derivative of the further equations.
  virtual void further_derivative(int k, Out dG) const = 0;

  std::shared_ptr<const InnerProblem> inner_;
  Eigen::Index n_;
  Site here_;
  mutable Neighbours nearby_;
  Vector R_;
  Jacobian jacobian_;
};

/// Block elimination in the factors of an Evaluator E, which leaves a small system S.
template <class E>
class AugmentedSolver : public LinearSolver {
 public:
  const char* name() const final { return "block elimination in the branch's factors"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) final {
    const auto* const* op = std::get_if<const Operator*>(&jacobian);
    at_ = op ? dynamic_cast<const E*>(*op) : nullptr;
    if (!at_) return false;
    B_ = at_->factors();
    rows_ = borders.rows;
    eliminate(borders);
    if (!S_.allFinite()) return false;
    small_.factorize(S_);
    determinant_ = small_.determinant();
    return determinant_ != 0 && std::isfinite(determinant_);
  }

  std::optional<int> determinant_sign() const override {
    const auto sign = B_->determinant_sign();
    if (!sign) return sign;
    return determinant_ > 0 ? *sign : -*sign;
  }

 protected:
  /// Makes S.
  virtual void eliminate(const Borders& borders) = 0;

  const E* at_ = nullptr;
  std::shared_ptr<LinearSolver> B_;
  Matrix rows_, S_;
  LU<double> small_;
  mutable Vector y_, rhs_, small_x_;

 private:
  double determinant_ = 1;
};

}  // namespace arcslip::continuation
