// What holds the mean positions of a structure: springs, laws, and contacts that constant forces close.
#include <arcslip/model/model.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace arcslip::model {

namespace {

constexpr double unnamed = 1e-6;   // of what a row or coordinate without a name counts as drifting
constexpr double held = 1e-12;     // a mean position: its stiffness relative to that of its springs
constexpr double soft = 1e-9;      // of the stiffness of a row: springs that hold all of it meanwhile
constexpr double carries = 1e-6;   // of the constant force: less does not close a contact
constexpr double balanced = 1e-6;  // of the constant force: what may be left of it in the static equilibrium
constexpr int static_steps = 50;

// A contact that opens, along its normal, or a stop. Of a ring: where all sectors move alike.
struct OpeningContact {
  const NonlinearPart& element;
  Direction normal;
  std::vector<double> fields;
  double stiffness;  // N/m: the largest

  // N, where it is held at x.
  double force(const elements::Harmonics& h, const Eigen::VectorXd& x) const {
    const double displacement = normal.dot(x);
    if (element.law->has_normal_load()) return element.law->normal_load_at(fields, displacement);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[h.cosine_index(0)] = displacement;
    return element.law->force_at(h, u, fields, std::array{0.0})(0, 0);
  }
};

Direction in_phase_along(const NonlinearPart& element, std::size_t i) {
  return in_phase(element.directions[i], element.next.empty() ? Direction() : element.next[i]);
}

std::size_t normal_of(const NonlinearPart& element) {
  return element.directions.size() - 1;
}

std::vector<OpeningContact> contacts_open_at_rest(const Model& model, const continuation::Vector& p) {
  std::vector<OpeningContact> found;
  for (const NonlinearPart& element : model.elements)
    if (is_open_at_rest(element, p)) {
      const std::vector<double> fields = element.fields(p);
      const auto traits = element.law->traits(fields, static_cast<int>(normal_of(element)));
      found.push_back({element, in_phase_along(element, normal_of(element)), fields, traits.stiffness});
    }
  return found;
}

Eigen::VectorXd constant_force(const Model& model, const continuation::Vector& p) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(model.dofs);
  for (const Excitation& excitation : model.excitation)
    if (excitation.harmonic == 0) f += excitation.amplitude(p).real() * shape(model, excitation, p);
  return f;
}

// The stiffness of the springs and of the laws that hold a mean position.
Eigen::MatrixXd stiffness_at_rest(const Model& model, const continuation::Vector& p) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(model.dofs, model.dofs);
  for (const LinearPart& spring : model.springs)
    add_outer(spring.number.value(p), in_phase(spring.direction, spring.next), K);
  for (const MatrixPart& part : model.matrices)
    if (part.kind == LinearKind::spring || part.kind == LinearKind::circulatory) K += part.value(p) * *part.A;
  for (const NonlinearPart& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const auto traits = element.law->traits(element.fields(p), static_cast<int>(i));
      if (traits.holds_mean && std::isfinite(traits.stiffness))
        add_outer(traits.stiffness, in_phase_along(element, i), K);
    }
  return K;
}

// Of contacts that are open at rest, those that the constant forces close: in the static equilibrium of the
// structure on them and on very soft springs, by Newton's method.
std::vector<Direction> closed_by_constant_force(const Model& model, const continuation::Vector& p) {
  const auto contacts = contacts_open_at_rest(model, p);
  const Eigen::VectorXd f = constant_force(model, p);
  if (contacts.empty() || f.isZero(0)) return {};
  Eigen::MatrixXd K = stiffness_at_rest(model, p), resting = K;
  for (const OpeningContact& contact : contacts) add_outer(contact.stiffness, contact.normal, resting);
  K.diagonal() += soft * resting.cwiseAbs().rowwise().maxCoeff();
  if (!K.allFinite() || K.diagonal().cwiseAbs().minCoeff() == 0) return {};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(model.dofs), residual = -f;
  Eigen::MatrixXd tangent = K;
  continuation::LU<double> lu(model.dofs);
  Eigen::VectorXd correction(model.dofs);
  for (int step = 0; !(residual.stableNorm() <= balanced * f.stableNorm()); ++step) {
    if (step == static_steps || !residual.allFinite()) return {};
    lu.factorize(tangent);
    lu.solve(residual, correction);
    x -= correction;
    tangent = K;
    residual = K * x - f;
    for (const OpeningContact& contact : contacts) {
      const double force = contact.force(model.harmonics, x);
      residual += force * contact.normal;
      if (force != 0) add_outer(contact.stiffness, contact.normal, tangent);
    }
  }
  std::vector<Direction> found;
  for (const OpeningContact& contact : contacts)
    if (std::abs(contact.force(model.harmonics, x)) * contact.normal.norm() > carries * f.stableNorm())
      found.push_back(contact.normal);
  return found;
}

// The row that moves most where a stiffness holds a motion not at all.
std::optional<int> softest_dof(const Model& model, const Eigen::MatrixXd& K) {
  if (!K.allFinite()) return {};  // overflow: nothing is known
  const Eigen::VectorXd size = K.cwiseAbs().rowwise().maxCoeff();
  for (int i = 0; i < model.dofs; ++i)
    if (size[i] == 0) return i;
  const Eigen::VectorXd scale = size.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * K * scale.asDiagonal();
  const auto modes = [&]() -> continuation::SymmetricModes {
    if (is_symmetric(model)) return continuation::symmetric_modes(scaled);
    auto [values, V] = continuation::singular_values(scaled);
    return {std::move(values), std::move(V)};
  }();
  Eigen::Index softest = 0, dof = 0;
  if (modes.values.cwiseAbs().minCoeff(&softest) > held) return {};
  Eigen::VectorXd share = (scale.asDiagonal() * modes.V.col(softest)).cwiseAbs();
  share.segment(model.unnamed_from, model.unnamed_to - model.unnamed_from) *= unnamed;
  share.maxCoeff(&dof);
  return static_cast<int>(dof);
}

}  // namespace

bool is_open_at_rest(const NonlinearPart& element, const continuation::Vector& p) {
  const bool is_stop = element.directions.size() == 1 && !element.law->dissipative();
  if (!element.law->has_normal_load() && !is_stop) return false;
  const auto traits = element.law->traits(element.fields(p), static_cast<int>(normal_of(element)));
  return !traits.holds_mean && traits.stiffness > 0 && std::isfinite(traits.stiffness);
}

std::optional<int> drifting_dof(const Model& model, const continuation::Vector& p, bool in_stick) {
  if (model.harmonics.odd) return {};
  // Springs of any stiffness hold what they are between: a stiff link takes nothing from the softer ones.
  // Only where some are negative, or next to matrices, it takes their values to tell.
  const bool by_value = !model.matrices.empty() ||
                        std::any_of(model.springs.begin(), model.springs.end(),
                                    [&](const LinearPart& spring) { return spring.number.value(p) < 0; });
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(model.dofs, model.dofs);
  for (const LinearPart& spring : model.springs)
    if (const double k = spring.number.value(p); k != 0)
      if (const Direction d = in_phase(spring.direction, spring.next); d.squaredNorm() > 0)
        add_outer(by_value ? k : 1 / d.squaredNorm(), d, K);
  for (const MatrixPart& part : model.matrices)
    if (part.kind == LinearKind::spring || part.kind == LinearKind::circulatory) K += part.value(p) * *part.A;
  const double largest = K.cwiseAbs().maxCoeff(), typical = largest > 0 ? largest : 1;
  for (const NonlinearPart& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i)
      if (const auto traits = element.law->traits(element.fields(p), static_cast<int>(i));
          traits.holds_mean || (in_stick && traits.holds_in_stick))
        add_outer(typical, in_phase_along(element, i), K);
  const auto drifting = softest_dof(model, K);
  if (!drifting) return {};
  const std::vector<Direction> closed = closed_by_constant_force(model, p);
  if (closed.empty()) return drifting;
  for (const Direction& normal : closed) add_outer(typical, normal, K);
  return softest_dof(model, K);
}

}  // namespace arcslip::model
