#include <arcslip/observables/histories.hpp>

#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/amplitude.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Vector;

scene::Scene scene_at(scene::Scene scene, const ResponseBranch& branch, const ResponsePoint& point) {
  for (const auto& [name, value] : branch.set) scene::set(scene, name, value);
  if (!branch.over.empty()) scene::set(scene, branch.over, point.over);
  return scene;
}

Vector as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

ElementHistory element_history(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, const Vector& p,
                               std::size_t e, std::span<const double> angles) {
  const auto& h = problem.harmonics();
  const model::NonlinearPart& part = problem.model().elements[e];
  const Vector& u = at.element_motion(e);
  Vector cosines = at.element(e).force().head(h.size()), sines = cosines;  // of the first direction
  cosines.tail(h.sines()).setZero();
  sines.head(h.cosines()).setZero();
  ElementHistory result;
  result.name = part.name;
  for (double theta : angles) {
    const elements::Values x = elements::series_values(h, u, theta);
    result.displacement.push_back(x.x);
    result.velocity.push_back(at.stiffness().base_frequency() * x.d1);
    result.cosine.push_back(elements::series_values(h, cosines, theta).x);
    result.sine.push_back(elements::series_values(h, sines, theta).x);
    result.series.push_back(result.cosine.back() + result.sine.back());
  }
  const Eigen::MatrixXd force =
      part.law->moving_force_at(h, u, at.stiffness().base_frequency(), part.fields(p), angles);
  result.force.assign(force.data(), force.data() + force.rows());
  for (Eigen::Index i = 1; i < force.cols(); ++i) {
    DirectionHistory& along = result.further.emplace_back();
    for (double theta : angles)
      along.displacement.push_back(elements::series_values(h, u.segment(i * h.size(), h.size()), theta).x);
    along.force.assign(force.col(i).begin(), force.col(i).end());
  }
  return result;
}

}  // namespace

History history(const scene::Scene& scene, const ResponseBranch& branch, const ResponsePoint& point,
                std::span<const double> angles) {
  if (point.unbounded) throw std::invalid_argument("an unbounded response has no history");
  model::Model built = model::build(scene_at(scene, branch, point));
  if (!branch.harmonics.empty() && harmonics_of(branch) != built.harmonics)  // of another period, or order
    built = model::in_harmonics(std::move(built), harmonics_of(branch));
  const auto model = std::make_shared<const model::Model>(std::move(built));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  if (static_cast<int>(point.unknowns.size()) != problem.size())
    throw std::invalid_argument("a point with " + std::to_string(point.unknowns.size()) +
                                " unknowns does not belong to this scene, which has " +
                                std::to_string(problem.size()));
  const Vector p = hbm::parameters_at(problem, point.omega), u = as_vector(point.unknowns);
  const auto at = problem.hbm_evaluator();
  if (at->move_to(u, p, continuation::Needs::residual) != continuation::Evaluated::ok)
    throw std::invalid_argument("the response cannot be evaluated at this point");
  History result;
  result.base_frequency = at->stiffness().base_frequency();
  result.angle.assign(angles.begin(), angles.end());
  Vector x(problem.harmonics().size());
  Amplitude(problem.harmonics()).of(*at, u, x);
  for (double theta : angles) {
    const elements::Values values = elements::series_values(problem.harmonics(), x, theta);
    result.displacement.push_back(values.x);
    result.velocity.push_back(result.base_frequency * values.d1);
  }
  for (std::size_t e = 0; e < at->element_count(); ++e)
    result.elements.push_back(element_history(problem, *at, p, e, angles));
  return result;
}

elements::Harmonics harmonics_of(const ResponseBranch& branch) {
  return {branch.harmonics.back(), branch.harmonics.front() > 0, branch.period};
}

std::vector<double> even_angles(int count) {
  std::vector<double> angles(static_cast<std::size_t>(std::max(count, 0)));
  for (std::size_t k = 0; k < angles.size(); ++k) angles[k] = turn_angle * static_cast<double>(k) / count;
  return angles;
}

std::vector<double> loop_angles(const ResponsePoint& point, int count) {
  std::vector<double> angles = even_angles(count);
  angles.push_back(turn_angle);
  for (const ElementResponse& element : point.elements) {
    angles.insert(angles.end(), element.slip_angles.begin(), element.slip_angles.end());
    angles.insert(angles.end(), element.reversal_angles.begin(), element.reversal_angles.end());
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

const ResponsePoint* point_at_frequency(const ResponseBranch& branch, double omega) {
  const auto nearest = std::min_element(branch.points.begin(), branch.points.end(),
                                        [omega](const ResponsePoint& a, const ResponsePoint& b) {
                                          return std::abs(a.omega - omega) < std::abs(b.omega - omega);
                                        });
  return nearest == branch.points.end() ? nullptr : &*nearest;
}

ForceDifference force_difference(std::span<const double> force, std::span<const double> reference) {
  if (force.size() != reference.size() || force.empty())
    throw std::invalid_argument("the forces to compare have " + std::to_string(force.size()) + " and " +
                                std::to_string(reference.size()) + " values");
  double largest = 0, largest_reference = 0, apart = 0, square = 0, square_reference = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double f = force[i], g = reference[i];
    largest = std::max(largest, std::abs(f));
    largest_reference = std::max(largest_reference, std::abs(g));
    apart = std::max(apart, std::abs(f - g));
    square += (f - g) * (f - g);
    square_reference += g * g;
  }
  return {std::abs(largest - largest_reference) / largest_reference, apart / largest_reference,
          std::sqrt(square / square_reference)};
}

}  // namespace arcslip::observables
