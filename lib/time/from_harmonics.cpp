#include <arcslip/time/from_harmonics.hpp>

namespace arcslip::time {

Matrix dof_coefficients(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p) {
  model::Model model = problem.model();
  const double factor = p[problem.excitation_factor()];
  Matrix coefficients(problem.harmonics().size(), model.dofs);
  for (Eigen::Index i = 0; i < model.dofs; ++i) {
    model.response = Vector::Unit(model.dofs, i);
    hbm::DynamicStiffness stiffness(model, problem.coordinates(), problem.harmonics());
    stiffness.move_to(p.head(p.size() - 1));
    Vector x(coefficients.rows());
    stiffness.response(u, factor, x);
    coefficients.col(i) = x;
  }
  return coefficients;
}

State state_of(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p) {
  const Matrix coefficients = dof_coefficients(problem, u, p);
  const EquationOfMotion equation = equation_of_motion(problem.model(), p);
  State state = at_rest(equation);
  for (Eigen::Index i = 0; i < coefficients.cols(); ++i) {
    const auto values = elements::series_values(problem.harmonics(), coefficients.col(i), 0);
    state.x[i] = values.x;
    state.v[i] = equation.omega * values.d1;
  }
  const auto evaluator = problem.hbm_evaluator();
  evaluator->move_to(u, p, continuation::Needs::residual);
  for (std::size_t e = 0; e < equation.elements.size(); ++e) {
    const Element& element = equation.elements[e];
    if (element.slider < 0) continue;
    const double force = elements::series_values(problem.harmonics(), evaluator->element(e).force(), 0).x;
    state.z[element.slider] = element.direction.dot(state.x) - force / element.stiffness;
  }
  return state;
}

}  // namespace arcslip::time
