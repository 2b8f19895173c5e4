#include <arcslip/continuation/problem.hpp>

#include <arcslip/continuation/linear_solver.hpp>

#include <stdexcept>

namespace arcslip::continuation {

std::unique_ptr<LinearSolver> Problem::linear_solver() const {
  return nullptr;
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
