#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <stdexcept>

namespace arcslip::continuation {

std::unique_ptr<LinearSolver> suitable_solver(const Jacobian& J) {
  if (std::holds_alternative<Matrix>(J)) return dense_lu();
  if (std::holds_alternative<SparseMatrix>(J)) return klu();
  throw std::invalid_argument(
      "the Jacobian is an operator: set its linear solver (options.linear_solver), for example "
      "block_elimination() around a solver of J");
}

void refuse_kind(const std::string& solver, const std::string& kind) {
  throw std::invalid_argument(solver + " takes " + kind + " Jacobians, and that of this problem is not " +
                              kind + ": set no linear solver for the default");
}

}  // namespace arcslip::continuation
