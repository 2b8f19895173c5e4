#include <arcslip/stability/state_from_harmonics.hpp>

namespace arcslip::time {

Matrix dof_coefficients(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p) {
  hbm::DynamicStiffness stiffness(problem.model(), problem.coordinates(), problem.harmonics());
  stiffness.move_to(p.head(p.size() - 1));
  return stiffness.motion(problem.coordinates().P, u, p[problem.excitation_factor()]);
}

MotionState state_of(const hbm::HbmProblem& problem, elements::In u, const continuation::Vector& p) {
  const Matrix coefficients = dof_coefficients(problem, u, p);
  const EquationOfMotion equation = equation_of_motion(problem.model(), p);
  MotionState state = at_rest(equation);
  for (Eigen::Index i = 0; i < coefficients.cols(); ++i) {
    const auto values = elements::series_values(problem.harmonics(), coefficients.col(i), 0);
    state.x[i] = values.x;
    state.v[i] = problem.harmonics().base_frequency(p[model::frequency]) * values.d1;
  }
  const auto evaluator = problem.hbm_evaluator();
  evaluator->move_to(u, p, continuation::Needs::residual);
  for (std::size_t e = 0; e < equation.elements.size(); ++e) {
    const TimeElement& element = equation.elements[e];
    const auto& h = problem.harmonics();
    const Vector q = element.directions.transpose() * state.x;
    Vector f(q.size());
    for (Eigen::Index i = 0; i < f.size(); ++i)
      f[i] = elements::series_values(h, evaluator->element(e).force().segment(i * h.size(), h.size()), 0).x;
    element.law->in_time(element.fields)
        ->memory_at(q, f, state.z.segment(element.memory, element.law->memory()));
  }
  return state;
}

void courses_of(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at,
                std::vector<ElementCourse>& courses) {
  const Eigen::Index size = problem.harmonics().size();
  courses.resize(at.element_count());
  for (std::size_t e = 0; e < courses.size(); ++e) {
    const int directions = problem.model().elements[e].law->directions();
    courses[e].q = at.element_motion(e).head(directions * size).reshaped(size, directions);
    at.element(e).contact(courses[e].contact);
    elements::put_in_order(courses[e].contact);
  }
}

void courses_of(const hbm::HbmProblem& problem, elements::In u, std::vector<ElementCourse>& courses) {
  const Eigen::Index size = problem.harmonics().size();
  courses.resize(problem.model().elements.size());
  Vector motion;
  for (std::size_t e = 0; e < courses.size(); ++e) {
    const int directions = problem.model().elements[e].law->directions();
    const hbm::ElementMap map = problem.map_of(e);
    motion.resize(map.size());
    map.gather(u, motion);
    courses[e].q = motion.head(directions * size).reshaped(size, directions);
    courses[e].contact.clear();
  }
}

}  // namespace arcslip::time
