#include <arcslip/model/model.hpp>

#include <arcslip/continuation/dense_algebra.hpp>
#include <arcslip/elements/cubic_spring.hpp>
#include <arcslip/elements/jenkins.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::model {
namespace {

constexpr double held = 1e-12;  // a mean position: its stiffness relative to that of its springs

Eigen::VectorXd vector_of(const scene::Direction& direction, int dofs) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(dofs);
  for (const scene::Term& term : direction) d[term.dof] += term.weight;
  return d;
}

class Builder {
 public:
  explicit Builder(const scene::Scene& scene) : scene_(scene) {
    model_.dofs = static_cast<int>(scene.dofs.size());
    model_.dof_names = scene.dofs;
    model_.parameters.push_back({"frequency", "rad/s", 0, 1, 0, 1e300});
  }

  Model build() {
    for (const auto& part : scene_.masses) model_.masses.push_back(linear(part));
    for (const auto& part : scene_.dampers) model_.dampers.push_back(linear(part));
    for (const auto& part : scene_.springs) model_.springs.push_back(linear(part));
    for (const auto& part : scene_.elements) {
      const Law law = part.type == &scene::jenkins_type ? Law::jenkins : Law::cubic_spring;
      std::vector<int> fields;
      for (std::size_t k = 0; k < part.values.size(); ++k) fields.push_back(parameter(part, k));
      model_.elements.push_back({part.name, law, std::move(fields), vector_of(part.direction, model_.dofs)});
    }
    bool even = false;
    model_.force_harmonic = scene_.harmonics.order;
    for (const auto& part : scene_.excitation) {
      model_.forces.push_back(
          {part.harmonic, parameter(part, 0), parameter(part, 1), vector_of(part.direction, model_.dofs)});
      even = even || part.harmonic % 2 == 0;
      if (part.harmonic > 0) model_.force_harmonic = std::min(model_.force_harmonic, part.harmonic);
    }
    model_.response = vector_of(scene_.response, model_.dofs);
    model_.harmonics = {scene_.harmonics.order, !even};
    model_.settings = scene_.harmonics;
    return std::move(model_);
  }

 private:
  LinearPart linear(const scene::Part& part) {
    return {parameter(part, 0), vector_of(part.direction, model_.dofs)};
  }

  // The parameter of one field: a new one, or that of the tie which the field belongs to.
  int parameter(const scene::Part& part, std::size_t field) {
    const scene::Field& f = part.type->fields[field];
    const std::string own = part.name + "." + std::string(f.name);
    std::string name = own;
    for (const auto& tie : scene_.ties)
      if (std::find(tie.members.begin(), tie.members.end(), own) != tie.members.end()) name = tie.name;
    auto& all = model_.parameters;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].name != name) continue;
      all[k].lower = std::max(all[k].lower, f.lower);
      all[k].upper = std::min(all[k].upper, f.upper);
      return static_cast<int>(k);
    }
    const double value = part.values[field];
    all.push_back({name, std::string(f.unit), value, std::max(std::abs(value), 1e-300), f.lower, f.upper});
    return static_cast<int>(all.size()) - 1;
  }

  const scene::Scene& scene_;
  Model model_;
};

}  // namespace

Model build(const scene::Scene& scene) {
  return Builder(scene).build();
}

int parameter_index(const Model& model, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < model.parameters.size(); ++k) {
    if (model.parameters[k].name == name) return static_cast<int>(k);
    known.push_back(model.parameters[k].name);
  }
  const std::string close = scene::nearest(name, known);
  throw scene::ParameterError("no parameter \"" + name + "\"" + (close.empty() ? "" : "; nearest: " + close));
}

std::unique_ptr<elements::Element> make_element(const Model& model, const NonlinearPart& part,
                                                const elements::Harmonics& harmonics) {
  if (part.law == Law::cubic_spring) return elements::make_cubic_spring(harmonics);
  if (model.settings.friction == scene::Friction::sampled)
    return elements::make_sampled_jenkins(harmonics, model.settings.samples);
  return elements::make_jenkins(harmonics);
}

Eigen::MatrixXd assemble(const std::vector<LinearPart>& parts, const continuation::Vector& p, int dofs) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dofs, dofs);
  std::vector<Eigen::Index> acted_on;  // few: whole outer products would cost dofs^2 for each part
  for (const LinearPart& part : parts) {
    const Eigen::VectorXd& d = part.direction;
    acted_on.clear();
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (d[i] != 0) acted_on.push_back(i);
    for (const Eigen::Index j : acted_on)
      for (const Eigen::Index i : acted_on) sum(i, j) += p[part.parameter] * d[i] * d[j];
  }
  return sum;
}

std::optional<int> drifting_dof(const Model& model, const continuation::Vector& p) {
  if (model.harmonics.odd) return {};
  // Springs of any stiffness hold what they are between: a stiff link takes nothing from the softer ones.
  // Only where some are negative it takes their values to tell.
  const bool negative = std::any_of(model.springs.begin(), model.springs.end(),
                                    [&](const LinearPart& spring) { return p[spring.parameter] < 0; });
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(model.dofs, model.dofs);
  for (const LinearPart& spring : model.springs)
    if (const double k = p[spring.parameter]; k != 0)
      K += (negative ? k : 1 / spring.direction.squaredNorm()) * spring.direction *
           spring.direction.transpose();
  const double typical = K.cwiseAbs().maxCoeff();
  for (const NonlinearPart& element : model.elements)
    if (element.law == Law::cubic_spring && p[element.parameters[0]] != 0)
      K += (typical > 0 ? typical : 1) * element.direction * element.direction.transpose();
  const Eigen::VectorXd size = K.cwiseAbs().rowwise().maxCoeff();
  for (int i = 0; i < model.dofs; ++i)
    if (size[i] == 0) return i;
  const Eigen::VectorXd scale = size.cwiseSqrt().cwiseInverse();
  const auto modes = continuation::symmetric_modes(scale.asDiagonal() * K * scale.asDiagonal());
  Eigen::Index softest = 0, dof = 0;
  if (modes.values.cwiseAbs().minCoeff(&softest) > held) return {};
  (scale.asDiagonal() * modes.V.col(softest)).cwiseAbs().maxCoeff(&dof);
  return static_cast<int>(dof);
}

}  // namespace arcslip::model
