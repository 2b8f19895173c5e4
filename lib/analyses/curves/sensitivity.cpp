#include <arcslip/analyses/curves/sensitivity.hpp>

#include <arcslip/analyses/curves/special_point_observer.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/difference.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

constexpr double like = 0.9;  // cosine of two tangents of which one serves as border row for the other
constexpr double room = 10;   // steps of a difference that have to lie in its smooth piece
constexpr double below_corner = 1e-8;  // of its size: from a corner

}  // namespace

using continuation::Evaluated;
using continuation::In;
using continuation::Needs;
using continuation::Out;
using continuation::Vector;

Sensitivity::Sensitivity(std::shared_ptr<const hbm::HbmProblem> problem)
    : problem_(std::move(problem)),
      instant_(std::make_shared<std::optional<double>>()),
      quantity_(amplitude_quantity(problem_, instant_)),
      extremes_(problem_->harmonics()),
      evaluator_(problem_->hbm_evaluator()),
      border_(problem_->size(), 1),
      u_(problem_->size()),
      scales_(problem_->size() + 1),
      tangent_(scales_.size()),
      z_(scales_.size()),
      x_(problem_->harmonics().size()),
      F_p_(problem_->size()),
      L_x_(scales_.size()) {
  scales_ << problem_->scales(), problem_->parameters()[model::frequency].scale;
  // A generic border row until there is a tangent, orthogonal to it by no symmetry.
  for (Eigen::Index i = 0; i < scales_.size(); ++i)
    tangent_[i] = (1 + 0.3 * std::sin(7.0 * static_cast<double>(i))) * scales_[i];
}

bool Sensitivity::move_to(In x, In p) {
  const Eigen::Index n = u_.size();
  u_ = x.head(n);
  p_ = p;
  p_[model::frequency] = x[n];
  corner_.reset();
  if (evaluator_->move_to(u_, p_, Needs::jacobian) != Evaluated::ok) return false;
  evaluator_->parameter_derivative(model::frequency, border_.columns.col(0));
  evaluator_->stiffness().response(u_, evaluator_->force_factor(), x_);
  extreme_ = *instant_ ? extremes_.near(x_, **instant_) : extremes_.of(x_);
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

bool Sensitivity::at_corner(const hbm::Corner& corner, In x, In p, std::span<const int> parameters,
                            Out gradient) {
  if (!move_to(x, p)) return false;
  corner_ = corner;
  hbm::corner_gradient(*problem_, corner, u_, p_, border_.rows.col(0));
  border_.corner(0, 0) = 0;
  return factorize() && differentiate(parameters, gradient) && condition_derivatives(gradient);
}

bool Sensitivity::condition_derivatives(Out gradient) {
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    gradient[static_cast<Eigen::Index>(k)] -=
        multiplier() * hbm::corner_derivative(*problem_, *corner_, u_, p_, parameters_[k]);
  return gradient.allFinite();
}

// Without the unknowns of the condition itself.
bool Sensitivity::differentiate(std::span<const int> parameters, Out gradient) {
  const Eigen::Index n = u_.size();
  parameters_.assign(parameters.begin(), parameters.end());
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

bool Sensitivity::second_derivatives(const continuation::Matrix& tangents,
                                     Eigen::Ref<continuation::Matrix> second) {
  const auto m = static_cast<Eigen::Index>(parameters_.size());
  if (corner_ && !side_below()) return false;
  u0_ = u_;
  p0_ = p_;
  const std::uint64_t piece = evaluator_->piece();
  Vector here(m);
  continuation::Matrix slopes(m, 2);
  slopes_of_lagrangian(tangents, here);
  const double size = std::hypot(u0_.norm() / scales_[0], p0_[model::frequency] / scales_[u0_.size()]);
  for (Eigen::Index j = 0; j < m; ++j) {
    const int of = parameters_[static_cast<std::size_t>(j)];
    const double p_scale =
        std::max(std::abs(p0_[of]), problem_->parameters()[static_cast<std::size_t>(of)].scale);
    const double length = std::hypot(tangents.col(j).cwiseQuotient(scales_).norm(), 1 / p_scale);
    const double h = continuation::difference_step * std::max(1.0, size) / length;
    const auto quotient = continuation::difference_within_piece(h, [&](std::size_t i, double distance) {
      const auto moved = [&](double by, Needs needs) {
        u_ = u0_ + by * tangents.col(j).head(u_.size());
        p_ = p0_;
        p_[model::frequency] += by * tangents(u_.size(), j);
        p_[of] += by;
        return evaluator_->move_to(u_, p_, needs) == Evaluated::ok && evaluator_->piece() == piece;
      };
      if (!moved(room * distance, Needs::residual) || !moved(distance, Needs::jacobian)) return false;
      slopes_of_lagrangian(tangents, slopes.col(static_cast<Eigen::Index>(i)));
      return true;
    });
    if (!quotient) return false;
    second.col(j) =
        quotient->here * here + quotient->weight[0] * slopes.col(0) + quotient->weight[1] * slopes.col(1);
  }
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index k = 0; k < j; ++k) second(j, k) = second(k, j) = 0.5 * (second(j, k) + second(k, j));
  return second.allFinite();
}

// Moves from a corner to a nearby point with h < 0; w and g are those of that side.
bool Sensitivity::side_below() {
  const auto& dh = border_.rows.col(0);
  u_ -= below_corner * hbm::corner_size(*problem_, *corner_, u_, p_) / dh.squaredNorm() * dh;
  if (evaluator_->move_to(u_, p_, Needs::jacobian) != Evaluated::ok) return false;
  evaluator_->parameter_derivative(model::frequency, border_.columns.col(0));
  Vector unused(static_cast<Eigen::Index>(parameters_.size()));
  const std::vector<int> parameters = parameters_;
  return factorize() && differentiate(parameters, unused);
}

// L_x . dx/dp_k + L_pk at the point of the evaluator, for all k.
void Sensitivity::slopes_of_lagrangian(const continuation::Matrix& tangents, Out slopes) {
  const Eigen::Index n = u_.size();
  const auto w = z_.head(n);
  quantity_.gradient(*evaluator_, u_, p_, L_x_.head(n));
  L_x_.head(n).noalias() -= std::get<continuation::Matrix>(evaluator_->jacobian()).transpose() * w;
  evaluator_->parameter_derivative(model::frequency, F_p_);
  L_x_[n] = quantity_.parameter_derivative(*evaluator_, u_, p_, model::frequency) - w.dot(F_p_);
  std::optional<hbm::Corner> corner = corner_;
  if (corner) {
    hbm::corner_excess(*problem_, *corner, u_, p_);
    hbm::corner_gradient(*problem_, *corner, u_, p_, F_p_);
    L_x_.head(n) -= multiplier() * F_p_;
  }
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    evaluator_->parameter_derivative(parameters_[k], F_p_);
    slopes[column] = L_x_.dot(tangents.col(column)) - w.dot(F_p_) +
                     quantity_.parameter_derivative(*evaluator_, u_, p_, parameters_[k]);
    if (corner)
      slopes[column] -= multiplier() * hbm::corner_derivative(*problem_, *corner, u_, p_, parameters_[k]);
  }
}

}  // namespace arcslip::observables
