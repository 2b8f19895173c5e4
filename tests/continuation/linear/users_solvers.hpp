#pragma once
// Linear solvers as users write them: around a sparse LU of J alone, by Eigen, which knows no determinant.

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/problem_from_functions.hpp>

#include <Eigen/SparseLU>
#include <Eigen/SparseQR>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace users {

using namespace arcslip::continuation;

/// What a solver does at a J that is singular to the last bit, or next to it.
enum class Manner { refuses, throws, refuses_nearly_singular, says_nothing };

/// Sparse LU of J.
class SparseLu final : public PlainSolver {
 public:
  explicit SparseLu(Manner manner = Manner::refuses, bool transposed = true)
      : manner_(manner), transposed_(transposed) {}
  const char* name() const override { return "Eigen::SparseLU"; }

  bool prepare(const Jacobian& J) override {
    const SparseMatrix& matrix = std::get<SparseMatrix>(J);
    if (!analyzed_) lu_.analyzePattern(matrix);
    analyzed_ = true;
    lu_.factorize(matrix);
    good_ = lu_.info() == Eigen::Success;
    if (good_ && manner_ == Manner::refuses_nearly_singular) good_ = condition(matrix) < 1e7;
    if (!good_) ++refused();
    if (!good_ && manner_ == Manner::throws) throw std::runtime_error("zero pivot");
    return good_ || manner_ == Manner::says_nothing;
  }
  bool solve(In b, Out x) const override {
    if (good_) x = lu_.solve(Vector(b));
    if (!good_) x.setConstant(std::nan(""));
    return manner_ == Manner::says_nothing || x.allFinite();
  }
  bool solve_transposed(In b, Out x) const override {
    if (!transposed_) return false;
    x = lu_.transpose().solve(Vector(b));
    return x.allFinite();
  }

  /// How often a J was refused.
  static int& refused() {
    static thread_local int count = 0;
    return count;
  }

 private:
  // At least |J| |J^-1 b| / |b| for a generic b.
  double condition(const SparseMatrix& J) const {
    Vector b(J.rows());
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = std::sin(1.0 + static_cast<double>(i * i));
    return J.norm() * Vector(lu_.solve(b)).norm() / b.norm();
  }

  Manner manner_;
  bool transposed_, analyzed_ = false, good_ = false;
  mutable Eigen::SparseLU<SparseMatrix> lu_;
};

/// Solves a singular system as well as it can, and says that it did.
class LeastSquares final : public PlainSolver {
 public:
  const char* name() const override { return "Eigen::SparseQR"; }
  bool prepare(const Jacobian& J) override {
    qr_.compute(std::get<SparseMatrix>(J));
    return qr_.info() == Eigen::Success;
  }
  bool solve(In b, Out x) const override {
    x = qr_.solve(Vector(b));
    return true;
  }

 private:
  Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>> qr_;
};

inline MakeLinearSolver sparse_lu(Manner manner = Manner::refuses, bool transposed = true) {
  return [=] { return block_elimination(std::make_unique<SparseLu>(manner, transposed)); };
}

inline MakeLinearSolver least_squares() {
  return [] { return block_elimination(std::make_unique<LeastSquares>()); };
}

/// The default solvers, without the sign of the determinant.
class WithoutSign final : public LinearSolver {
 public:
  const char* name() const override { return "without the sign"; }
  bool factorize(const Jacobian& J, const Borders& borders) override {
    if (!solver_) solver_ = suitable_solver(J);
    return solver_->factorize(J, borders);
  }
  void solve(Out x) const override { solver_->solve(x); }
  bool solve_transposed(Out x) const override { return solver_->solve_transposed(x); }
  bool keeps_pivots() const override { return solver_ && solver_->keeps_pivots(); }
  void forget_pivots() override {
    if (solver_) solver_->forget_pivots();
  }

 private:
  std::unique_ptr<LinearSolver> solver_;
};

inline MakeLinearSolver without_sign() {
  return [] { return std::make_unique<WithoutSign>(); };
}

/// The same problem with a sparse Jacobian, whose pattern is full.
inline std::shared_ptr<const Problem> sparse(const std::shared_ptr<const Problem>& problem) {
  const std::shared_ptr<Evaluator> at = problem->evaluator();
  const auto all = problem->parameters();
  Functions f;
  f.size = problem->size();
  f.parameters = {all.begin(), all.end()};
  f.scales = problem->scales();
  f.residual = [=](In u, In p, Out F) {
    if (at->move_to(u, p, Needs::residual) == Evaluated::ok)
      F = at->residual();
    else
      F.setConstant(std::nan(""));
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    at->move_to(u, p, Needs::jacobian);
    const Matrix& dense = std::get<Matrix>(at->jacobian());
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < dense.cols(); ++j)
      for (int i = 0; i < dense.rows(); ++i) entries.emplace_back(i, j, dense(i, j));
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In p, int k, Out dF) {
    at->move_to(u, p, Needs::jacobian);
    at->parameter_derivative(k, dF);
  };
  return from_functions(std::move(f));
}

}  // namespace users
