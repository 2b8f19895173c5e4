#include <arcslip/continuation/problem/problem.hpp>

#include <arcslip/continuation/problem/linear_solver.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {

Evaluated Evaluator::test_piece(In u, In p, std::uint64_t piece, PieceTest, bool& inside) {
  const Evaluated result = move_to(u, p, Needs::residual);
  inside = result == Evaluated::ok && residual().allFinite() && this->piece() == piece;
  return result;
}

std::shared_ptr<const Problem> Problem::with_scale(int, double) const {
  return nullptr;
}

std::unique_ptr<LinearSolver> Problem::linear_solver() const {
  return nullptr;
}

void apply(const Jacobian& jacobian, In x, Out y) {
  if (const auto* J = std::get_if<Matrix>(&jacobian))
    y.noalias() = *J * x;
  else if (const auto* sparse = std::get_if<SparseMatrix>(&jacobian))
    y.noalias() = *sparse * x;
  else
    std::get<const Operator*>(jacobian)->apply(x, y);
}

bool apply_transposed(const Jacobian& jacobian, In x, Out y) {
  if (const auto* J = std::get_if<Matrix>(&jacobian))
    y.noalias() = J->transpose() * x;
  else if (const auto* sparse = std::get_if<SparseMatrix>(&jacobian))
    y.noalias() = sparse->transpose() * x;
  else
    return std::get<const Operator*>(jacobian)->apply_transposed(x, y);
  return true;
}

void check_parameters(std::span<const Parameter> parameters) {
  if (parameters.empty()) throw std::invalid_argument("the problem has no parameters: one has to be free");
  for (std::size_t k = 1; k < parameters.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (parameters[j].name == parameters[k].name)
        throw std::invalid_argument("the parameters " + std::to_string(j) + " and " + std::to_string(k) +
                                    " are both called \"" + parameters[k].name + "\"");
}

int parameter_index(const Problem& problem, const std::string& name) {
  const auto all = problem.parameters();
  std::string known;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].name == name) return static_cast<int>(k);
    known += (k ? ", " : "") + all[k].name;
  }
  throw std::out_of_range("no parameter \"" + name + "\"; there are: " + known);
}

Vector parameter_values(const Problem& problem) {
  const auto all = problem.parameters();
  Vector values(static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) values[static_cast<Eigen::Index>(k)] = all[k].value;
  return values;
}

Vector proposed_scales(std::span<const Vector> solutions, double negligible) {
  if (solutions.empty()) throw std::invalid_argument("scales follow from one solution at least");
  Vector scales = Vector::Zero(solutions.front().size());
  for (const Vector& u : solutions) {
    if (u.size() != scales.size())
      throw std::invalid_argument("solutions of " + std::to_string(scales.size()) + " and of " +
                                  std::to_string(u.size()) + " unknowns have no scales in common");
    if (!u.allFinite())
      throw std::invalid_argument("a solution that scales are to follow from is not finite");
    scales = scales.cwiseMax(u.cwiseAbs());
  }
  scales = (scales.array() > negligible).select(scales, 0);
  double logarithms = 0;
  int others = 0;
  for (const double scale : scales)
    if (scale > 0) logarithms += std::log(scale), ++others;
  const double mean = others > 0 ? std::exp(logarithms / others) : 1;
  for (double& scale : scales)
    if (!(scale > 0)) scale = mean;
  return scales;
}

}  // namespace arcslip::continuation
