#include "continuation/suite/problems.hpp"

#include <limits>

namespace suite {

using arcslip::continuation::Evaluated;
using arcslip::continuation::Evaluator;
using arcslip::continuation::from_functions;
using arcslip::continuation::Needs;

namespace {

std::vector<Parameter> parameters_of(const Problem& problem) {
  const auto all = problem.parameters();
  return {all.begin(), all.end()};
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

namespace {

using Piece = std::function<std::uint64_t(In u, In p)>;

class PiecesEvaluator final : public Evaluator {
 public:
  PiecesEvaluator(std::unique_ptr<Evaluator> smooth, Piece piece)
      : smooth_(std::move(smooth)), piece_(std::move(piece)) {}
  Evaluated move_to(In u, In p, Needs needs) override {
    at_ = piece_(u, p);
    return smooth_->move_to(u, p, needs);
  }
  const Vector& residual() const override { return smooth_->residual(); }
  const arcslip::continuation::Jacobian& jacobian() const override { return smooth_->jacobian(); }
  void parameter_derivative(int k, Out dF) const override { smooth_->parameter_derivative(k, dF); }
  std::uint64_t piece() const override { return at_; }

 private:
  std::unique_ptr<Evaluator> smooth_;
  Piece piece_;
  std::uint64_t at_ = 0;
};

class PiecesProblem final : public Problem {
 public:
  PiecesProblem(ProblemPtr smooth, Piece piece) : smooth_(std::move(smooth)), piece_(std::move(piece)) {}
  int size() const override { return smooth_->size(); }
  std::span<const Parameter> parameters() const override { return smooth_->parameters(); }
  Vector scales() const override { return smooth_->scales(); }
  std::unique_ptr<Evaluator> evaluator() const override {
    return std::make_unique<PiecesEvaluator>(smooth_->evaluator(), piece_);
  }

 private:
  ProblemPtr smooth_;
  Piece piece_;
};

}  // namespace

ProblemPtr exchanged(ProblemPtr problem, int unknown, int k) {
  std::vector<Parameter> parameters = parameters_of(*problem);
  Vector scales = problem->scales();
  Parameter& released = parameters[static_cast<std::size_t>(k)];
  std::swap(released.scale, scales[unknown]);
  released.name = "u" + std::to_string(unknown);
  const std::shared_ptr<Evaluator> at = problem->evaluator();
  const auto move_to = [=](In u, In p, Needs needs) {
    Vector v = u, q = p;
    std::swap(v[unknown], q[k]);
    return at->move_to(v, q, needs) == Evaluated::ok;
  };
  const ProblemPtr smooth = from_functions(
      problem->size(), parameters,
      [=](In u, In p, Out F) {
        if (move_to(u, p, Needs::residual))
          F = at->residual();
        else
          F.setConstant(nan);
      },
      [=](In u, In p, MatrixOut J) {
        move_to(u, p, Needs::jacobian);
        J = std::get<Eigen::MatrixXd>(at->jacobian());
        at->parameter_derivative(k, J.col(unknown));
      },
      [=](In u, In p, int j, Out dF) {
        move_to(u, p, Needs::jacobian);
        if (j == k)
          dF = std::get<Eigen::MatrixXd>(at->jacobian()).col(unknown);
        else
          at->parameter_derivative(j, dF);
      },
      scales);
  return in_pieces(smooth, [=](In u, In p) {
    move_to(u, p, Needs::residual);
    return at->piece();
  });
}

ProblemPtr rescaled(ProblemPtr problem, double in_u, int k, double in_p) {
  std::vector<Parameter> parameters = parameters_of(*problem);
  parameters[static_cast<std::size_t>(k)].value *= in_p;
  parameters[static_cast<std::size_t>(k)].scale *= in_p;
  const std::shared_ptr<Evaluator> at = problem->evaluator();
  const auto move_to = [=](In u, In p, Needs needs) {
    Vector q = p;
    q[k] /= in_p;
    return at->move_to(u / in_u, q, needs) == Evaluated::ok;
  };
  const ProblemPtr smooth = from_functions(
      problem->size(), parameters,
      [=](In u, In p, Out F) {
        if (move_to(u, p, Needs::residual))
          F = at->residual();
        else
          F.setConstant(nan);
      },
      [=](In u, In p, MatrixOut J) {
        move_to(u, p, Needs::jacobian);
        J = std::get<Eigen::MatrixXd>(at->jacobian()) / in_u;
      },
      [=](In u, In p, int j, Out dF) {
        move_to(u, p, Needs::residual);
        at->parameter_derivative(j, dF);
        if (j == k) dF /= in_p;
      },
      problem->scales() * in_u);
  return in_pieces(smooth, [=](In u, In p) {
    move_to(u, p, Needs::residual);
    return at->piece();
  });
}

ProblemPtr in_pieces(ProblemPtr problem, Piece piece) {
  return std::make_shared<PiecesProblem>(std::move(problem), std::move(piece));
}

}  // namespace suite
