#include <arcslip/observables/sensitivity.hpp>

#include <arcslip/observables/curve_section.hpp>

#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

constexpr double like = 0.9;  // cosine of two tangents of which one serves as border row for the other

}  // namespace

using continuation::Evaluated;
using continuation::In;
using continuation::Needs;
using continuation::Out;
using continuation::Vector;

Sensitivity::Sensitivity(std::shared_ptr<const hbm::HbmProblem> problem)
    : problem_(std::move(problem)),
      quantity_(amplitude_quantity(problem_)),
      extremes_(problem_->harmonics()),
      evaluator_(problem_->hbm_evaluator()),
      border_(problem_->size(), 1),
      u_(problem_->size()),
      scales_(problem_->size() + 1),
      tangent_(scales_.size()),
      z_(scales_.size()),
      x_(problem_->harmonics().size()),
      F_p_(problem_->size()) {
  scales_ << problem_->scales(), problem_->parameters()[model::frequency].scale;
  // Until there is a tangent, a border row that no symmetry makes orthogonal to it.
  for (Eigen::Index i = 0; i < scales_.size(); ++i)
    tangent_[i] = (1 + 0.3 * std::sin(7.0 * static_cast<double>(i))) * scales_[i];
}

bool Sensitivity::move_to(In x, In p) {
  const Eigen::Index n = u_.size();
  u_ = x.head(n);
  p_ = p;
  p_[model::frequency] = x[n];
  if (evaluator_->move_to(u_, p_, Needs::jacobian) != Evaluated::ok) return false;
  evaluator_->parameter_derivative(model::frequency, border_.columns.col(0));
  evaluator_->stiffness().response(u_, evaluator_->force_factor(), x_);
  amplitude_ = extremes_.of(x_).amplitude;
  return true;
}

bool Sensitivity::factorize() {
  if (!solver_) solver_ = continuation::suitable_solver(evaluator_->jacobian());
  return solver_->factorize(evaluator_->jacobian(), border_);
}

bool Sensitivity::at_frequency(In x, In p, std::span<const int> parameters, Out gradient) {
  if (!move_to(x, p)) return false;
  border_.rows.setZero();
  border_.corner(0, 0) = 1;
  return factorize() && differentiate(parameters, gradient);
}

bool Sensitivity::at_resonance(In x, In p, std::span<const int> parameters, Out gradient) {
  if (!move_to(x, p)) return false;
  const Eigen::Index n = u_.size();
  for (int pass = 0; pass < 2; ++pass) {  // with the last tangent, then with that of this place
    const Vector row = tangent_.cwiseQuotient(scales_).cwiseQuotient(scales_);
    const double length = tangent_.cwiseQuotient(scales_).norm();
    border_.rows.col(0) = row.head(n) / length;
    border_.corner(0, 0) = row[n] / length;
    if (!factorize()) return false;
    z_ = Vector::Unit(n + 1, n);
    solver_->solve(z_);
    if (!z_.allFinite() || z_.isZero(0)) return false;
    z_ /= z_.cwiseQuotient(scales_).norm();
    const bool fits =
        std::abs(tangent_.cwiseQuotient(scales_).dot(z_.cwiseQuotient(scales_))) > like * length;
    tangent_ = z_;
    if (fits) break;
  }
  return differentiate(parameters, gradient);
}

bool Sensitivity::at_corner(const hbm::SlipCorner& corner, In x, In p, std::span<const int> parameters,
                            Out gradient) {
  if (!move_to(x, p)) return false;
  hbm::slip_excess_gradient(*problem_, corner, p_, border_.rows.col(0));
  border_.corner(0, 0) = 0;
  if (!factorize() || !differentiate(parameters, gradient)) return false;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    gradient[static_cast<Eigen::Index>(i)] -=
        multiplier() * hbm::slip_excess_derivative(*problem_, corner, u_, p_, parameters[i]);
  return gradient.allFinite();
}

// Without what the condition itself depends on.
bool Sensitivity::differentiate(std::span<const int> parameters, Out gradient) {
  const Eigen::Index n = u_.size();
  quantity_.gradient(*evaluator_, u_, p_, z_.head(n));
  z_[n] = quantity_.parameter_derivative(*evaluator_, u_, p_, model::frequency);
  if (!solver_->solve_transposed(z_)) return false;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    evaluator_->parameter_derivative(parameters[i], F_p_);
    gradient[static_cast<Eigen::Index>(i)] =
        quantity_.parameter_derivative(*evaluator_, u_, p_, parameters[i]) - z_.head(n).dot(F_p_);
  }
  return gradient.allFinite();
}

}  // namespace arcslip::observables
