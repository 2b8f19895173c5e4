#include <arcslip/continuation/problem/problem.hpp>

#include <arcslip/continuation/problem/linear_solver.hpp>

#include <stdexcept>

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

}  // namespace arcslip::continuation
