#include <arcslip/hbm/mode.hpp>

#include <arcslip/continuation/linear/finite.hpp>
#include <arcslip/laws/piece_hash.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::hbm {

using continuation::Evaluated;
using continuation::Needs;

namespace {

constexpr double same_height = 1e-13;  // relative: extremes that differ by rounding

}  // namespace

model::Model without_excitation(const model::Model& of) {
  model::Model model = of;
  std::erase_if(model.excitation, [](const model::Excitation& each) { return each.harmonic != 0; });
  const double alpha = model.damping ? model.damping->alpha_at(model::defaults(model)) : 0;
  if (!model.damping) model.damping.emplace();
  model.damping->alpha = static_cast<int>(model.parameters.size());
  model.parameters.push_back({"damping of the mode", "1/s", alpha, 1});
  return model;
}

HalfRange::HalfRange(const elements::Harmonics& harmonics)
    : harmonics_(harmonics),
      reversals_(harmonics),
      gradient_(Vector::Zero(harmonics.size())),
      phi_(harmonics.size()) {}

double HalfRange::of(elements::In x) {
  gradient_.setZero();
  which_ = 0;
  const auto& turns = reversals_.find(x);
  if (turns.empty()) return 0;
  const auto height = [&](const elements::Reversal& turn) {  // antisymmetric: one of two, half a period apart
    return harmonics_.odd ? std::abs(turn.x) : turn.x;
  };
  double highest = height(turns[0]), lowest = highest;
  for (const auto& turn : turns) {
    highest = std::max(highest, height(turn));
    lowest = std::min(lowest, turn.x);
  }
  if (harmonics_.odd) lowest = -highest;
  const double near = same_height * (highest - lowest);
  std::size_t top = 0, bottom = 0;
  while (height(turns[top]) < highest - near) ++top;
  const auto add = [&](std::size_t turn, double weight) {
    elements::series_basis(harmonics_, turns[turn].theta, phi_);
    gradient_ += weight * phi_;
    which_ = which_ * 1000003u + turn;
  };
  if (harmonics_.odd) {
    add(top, turns[top].x < 0 ? -1 : 1);
  } else {
    while (turns[bottom].x > lowest + near) ++bottom;
    add(top, 0.5);
    add(bottom, -0.5);
  }
  return 0.5 * (highest - lowest);
}

ModeProblem::ModeProblem(std::shared_ptr<const HbmProblem> motions, Vector rest, double omega_0)
    : motions_(std::move(motions)), rest_(std::move(rest)), omega_0_(omega_0) {
  parameters_.push_back({"log_amplitude", "-", 0, 0});
}

double ModeProblem::own_alpha() const {
  return motions_->model().parameters[static_cast<std::size_t>(alpha())].value;
}

Vector ModeProblem::motion(continuation::In unknowns, double log_amplitude) const {
  const double a = std::exp(log_amplitude + unknowns[log_ratio()]);
  return rest_ + a * unknowns.head(motions_->size());
}

std::unique_ptr<continuation::Evaluator> ModeProblem::evaluator() const {
  return std::make_unique<ModeEvaluator>(*this);
}

ModeEvaluator::ModeEvaluator(const ModeProblem& problem)
    : n_(problem.motions().size()),
      alpha_(problem.alpha()),
      phase_(problem.motions().harmonics().sine_index(problem.motions().harmonics().excited(1))),
      omega_0_(problem.omega_0()),
      own_alpha_(problem.own_alpha()),
      rest_(problem.rest()),
      inner_(problem.motions().hbm_evaluator()),
      range_(problem.motions().harmonics()),
      u_(n_),
      p_(continuation::parameter_values(problem.motions())),
      R_(n_ + 3),
      x_(problem.motions().harmonics().size()),
      unit_(Vector::Unit(x_.size(), phase_)),
      by_omega_(n_),
      by_alpha_(n_),
      x_omega_(x_.size()),
      x_alpha_(x_.size()),
      row_(Vector::Zero(n_)),
      by_amplitude_(n_),
      jacobian_(Eigen::MatrixXd(Eigen::MatrixXd::Zero(n_ + 3, n_ + 3))) {}

Evaluated ModeEvaluator::move_to(continuation::In u, continuation::In p, Needs needs) {
  A_ = std::exp(p[0]);
  omega_ = omega_0_ * std::exp(u[n_]);
  zeta_ = u[n_ + 1];
  ratio_ = std::exp(u[n_ + 2]);
  const double a = A_ * ratio_;
  if (!std::isfinite(a) || a == 0 || A_ == 0 || !std::isfinite(omega_)) return Evaluated::failed;
  u_ = rest_ + a * u.head(n_);
  p_[model::frequency] = omega_;
  p_[alpha_] = own_alpha_ - 2 * zeta_ * omega_;
  if (const Evaluated result = inner_->move_to(u_, p_, needs); result != Evaluated::ok) return result;
  R_.head(n_) = inner_->residual() / a;
  inner_->stiffness().response(u.head(n_), 0, x_);
  R_[n_] = ratio_ * range_.of(x_) - 1;
  R_[n_ + 1] = x_[phase_];
  R_[n_ + 2] = 0.5 * (u.head(n_).squaredNorm() - 1);
  if (!continuation::all_finite(R_)) return Evaluated::failed;
  if (needs == Needs::jacobian) differentiate(u.head(n_));
  return Evaluated::ok;
}

void ModeEvaluator::differentiate(continuation::In v) {
  auto& J = std::get<Eigen::MatrixXd>(jacobian_);
  const auto& of_motion = std::get<Eigen::MatrixXd>(inner_->jacobian());
  J.topLeftCorner(n_, n_) = of_motion;
  by_amplitude_.noalias() = of_motion * v;
  by_amplitude_ -= R_.head(n_);

  // omega and zeta enter by the frequency and by alpha = alpha_0 - 2 zeta omega.
  const DynamicStiffness& Z = inner_->stiffness();
  inner_->parameter_derivative(model::frequency, by_omega_);
  inner_->parameter_derivative(alpha_, by_alpha_);
  const double a = A_ * ratio_;
  J.col(n_).head(n_) = (omega_ / a) * (by_omega_ - 2 * zeta_ * by_alpha_);
  J.col(n_ + 1).head(n_) = (-2 * omega_ / a) * by_alpha_;
  J.col(n_ + 2).head(n_) = by_amplitude_;
  Z.response_derivative(model::frequency, v, 0, x_omega_);
  Z.response_derivative(alpha_, v, 0, x_alpha_);
  x_omega_ = omega_ * (x_omega_ - 2 * zeta_ * x_alpha_);
  x_alpha_ *= -2 * omega_;

  for (const int row : {n_, n_ + 1}) {
    const Vector& of_response = row == n_ ? range_.gradient() : unit_;
    const double factor = row == n_ ? ratio_ : 1;
    Z.response_transposed(of_response, row_);
    J.row(row).head(n_) = factor * row_.transpose();
    J(row, n_) = factor * of_response.dot(x_omega_);
    J(row, n_ + 1) = factor * of_response.dot(x_alpha_);
  }
  J(n_, n_ + 2) = R_[n_] + 1;
  J.row(n_ + 2).head(n_) = v.transpose();
}

void ModeEvaluator::parameter_derivative(int /*k*/, continuation::Out dR) const {
  dR.head(n_) = by_amplitude_;
  dR.tail(3).setZero();
}

std::uint64_t ModeEvaluator::piece() const {
  return elements::hashed(inner_->piece(), range_.reversals());
}

}  // namespace arcslip::hbm
