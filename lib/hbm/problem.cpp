#include <arcslip/hbm/problem.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::hbm {

using continuation::Evaluated;
using continuation::Needs;

HbmEvaluator::HbmEvaluator(std::shared_ptr<const model::Model> model, const Coordinates& coordinates,
                           const Harmonics& harmonics)
    : model_(std::move(model)),
      harmonics_(harmonics),
      r_(coordinates.unknowns),
      stiffness_(*model_, coordinates, harmonics),
      u_(r_ * harmonics.size()),
      R_(u_.size()),
      derivative_(harmonics.size()),
      jacobian_(Eigen::MatrixXd(u_.size(), u_.size())) {
  for (const auto& element : model_->elements) {
    Part part;
    part.element = model::make_element(*model_, element, harmonics);
    part.parameters = element.parameters;
    const Vector d = coordinates.P.leftCols(r_).transpose() * element.direction;
    for (int i = 0; i < r_; ++i)
      if (std::abs(d[i]) > 1e-12 * d.norm()) part.direction.emplace_back(i, d[i]);
    part.fields.resize(element.parameters.size());
    part.motion.resize(harmonics.size());
    parts_.push_back(std::move(part));
  }
}

Evaluated HbmEvaluator::move_to(continuation::In u, continuation::In p, Needs needs) {
  if (!(p[model::frequency] > 0)) return Evaluated::outside_domain;
  if (!u.allFinite() || !p.allFinite()) return Evaluated::failed;
  u_ = u;
  force_factor_ = p[p.size() - 1];
  if (!stiffness_.move_to(p)) return Evaluated::outside_domain;
  const bool jacobian = needs == Needs::jacobian;
  auto& J = std::get<Eigen::MatrixXd>(jacobian_);
  const int c = harmonics_.size();
  stiffness_.residual(u_, force_factor_, R_);
  if (jacobian) J.setZero();
  for (Part& part : parts_) {
    for (std::size_t k = 0; k < part.fields.size(); ++k) part.fields[k] = p[part.parameters[k]];
    part.motion.setZero();
    for (const auto& [i, weight] : part.direction) part.motion += weight * u_.segment(i * c, c);
    part.element->move_to(part.motion, part.fields, jacobian);
    for (const auto& [i, weight] : part.direction) R_.segment(i * c, c) += weight * part.element->force();
    if (!jacobian) continue;
    for (const auto& [j, wj] : part.direction)
      for (const auto& [i, wi] : part.direction)
        J.block(i * c, j * c, c, c) += (wi * wj) * part.element->jacobian();
  }
  if (jacobian) stiffness_.add_to(J);
  return R_.allFinite() ? Evaluated::ok : Evaluated::failed;
}

void HbmEvaluator::parameter_derivative(int k, continuation::Out dR) const {
  if (k == static_cast<int>(model_->parameters.size())) {  // the excitation factor
    stiffness_.force(dR);
    dR = -dR;
    return;
  }
  stiffness_.parameter_derivative(k, u_, force_factor_, dR);
  const int c = harmonics_.size();
  for (const Part& part : parts_)
    for (std::size_t field = 0; field < part.parameters.size(); ++field) {
      if (part.parameters[field] != k) continue;
      part.element->field_derivative(static_cast<int>(field), derivative_);
      for (const auto& [i, weight] : part.direction) dR.segment(i * c, c) += weight * derivative_;
    }
}

std::uint64_t HbmEvaluator::piece() const {
  std::uint64_t hash = 1469598103934665603ull;
  for (const Part& part : parts_) hash = (hash ^ part.element->piece()) * 1099511628211ull;
  return hash;
}

HbmProblem::HbmProblem(std::shared_ptr<const model::Model> model, const Harmonics& harmonics,
                       double displacement, double frequency)
    : model_(std::move(model)),
      harmonics_(harmonics),
      coordinates_(hbm::coordinates(*model_)),
      parameters_(model_->parameters),
      displacement_(displacement) {
  parameters_[model::frequency].scale = frequency;
  parameters_.push_back({"excitation_factor", "-", 1, 1, 0, 1e300});
}

Vector parameters_at(const HbmProblem& problem, double omega) {
  Vector p = continuation::parameter_values(problem);
  p[model::frequency] = omega;
  return p;
}

}  // namespace arcslip::hbm
