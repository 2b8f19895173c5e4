#include <arcslip/continuation/linear_solver.hpp>

#include <stdexcept>

namespace arcslip::continuation {

std::unique_ptr<LinearSolver> suitable_solver(const Jacobian& J) {
  if (std::holds_alternative<Matrix>(J)) return dense_lu();
  if (std::holds_alternative<SparseMatrix>(J)) return klu();
  throw std::invalid_argument(
      "the Jacobian is an operator: name its linear solver (options.linear_solver), for example "
      "block_elimination() around a solver of J");
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

}  // namespace arcslip::continuation
