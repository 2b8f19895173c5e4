#include <arcslip/model/model.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/scene/patch.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace arcslip::model {
namespace {

constexpr double held = 1e-12;  // a mean position: its stiffness relative to that of its springs

Direction sparse(const scene::Direction& direction, int dofs) {
  Direction d(dofs);
  for (const scene::Term& term : direction) d.coeffRef(term.dof) += term.weight;
  return d;
}

Excitation::Kind kind_of(const scene::Part& part) {
  if (part.type == &scene::base_displacement_type()) return Excitation::Kind::base_displacement;
  if (part.type == &scene::base_acceleration_type()) return Excitation::Kind::base_acceleration;
  return Excitation::Kind::force;
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
      std::vector<Share> shares;
      for (std::size_t k = 0; k < part.values.size(); ++k)
        shares.push_back({static_cast<int>(k), parameter(part, k)});
      add_element(part, std::move(shares));
    }
    for (const auto& patch : scene_.patches) add_patch(patch);
    bool even = false;
    model_.force_harmonic = scene_.harmonics.order;
    for (const auto& part : scene_.excitation) {
      model_.excitation.push_back({kind_of(part), part.harmonic, parameter(part, 0), parameter(part, 1),
                                   sparse(part.directions.front(), model_.dofs)});
      even = even || part.harmonic * scene_.harmonics.period % 2 == 0;
      if (part.harmonic > 0) model_.force_harmonic = std::min(model_.force_harmonic, part.harmonic);
    }
    model_.response = sparse(scene_.response(), model_.dofs);
    model_.absolute = scene_.responses.front().frame == scene::Frame::absolute;
    for (const scene::Response& response : scene_.responses) {
      if (response.name.empty()) continue;
      model_.named_responses.push_back(sparse(response.direction, model_.dofs));
      model_.named_absolute.push_back(response.frame == scene::Frame::absolute);
    }
    model_.harmonics = {scene_.harmonics.order, !even && model_.antisymmetric, scene_.harmonics.period};
    model_.settings = scene_.harmonics;
    return std::move(model_);
  }

 private:
  LinearPart linear(const scene::Part& part) {
    return {parameter(part, 0), sparse(part.directions.front(), model_.dofs)};
  }

  void add_element(const scene::Part& part, std::vector<Share> shares) {
    NonlinearPart element{part.name, elements::law_of(part), std::move(shares),
                          {},        part.values.size(),     part.wear_coefficient};
    for (const auto& direction : part.directions)
      element.directions.push_back(sparse(direction, model_.dofs));
    if (element.directions.size() != static_cast<std::size_t>(element.law->directions()))
      throw std::invalid_argument("the element \"" + part.name + "\" has " +
                                  std::to_string(element.directions.size()) + " directions, its law " +
                                  std::to_string(element.law->directions()));
    model_.antisymmetric = model_.antisymmetric && element.law->antisymmetric();
    model_.elements.push_back(std::move(element));
  }

  void add_patch(const scene::Part& part) {
    std::vector<int> parameters;
    for (std::size_t k = 0; k < part.values.size(); ++k) parameters.push_back(parameter(part, k));
    Patch patch{part.name, model_.elements.size(), {}};
    const auto& options = part.options.as<scene::PatchOptions>();
    for (const scene::PatchRow& row : options.rows) {
      std::vector<Share> shares;
      for (const scene::PatchShare& share : options.shares(row))
        shares.push_back({static_cast<int>(share.field), parameters[share.from], share.factor});
      add_element(scene::patch_element(part, row), std::move(shares));
      patch.areas.push_back(row.area);
    }
    model_.patches.push_back(std::move(patch));
  }

  // The parameter of one field: a new one, or that of the tie which the field belongs to.
  int parameter(const scene::Part& part, std::size_t field) {
    const scene::Field& f = part.fields()[field];
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

continuation::Vector defaults(const Model& model) {
  continuation::Vector p(static_cast<Eigen::Index>(model.parameters.size()));
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
  return p;
}

std::vector<double> NonlinearPart::fields(const continuation::Vector& p) const {
  std::vector<double> values(field_count);
  set_fields(p, values);
  return values;
}

void NonlinearPart::set_fields(continuation::In p, std::span<double> fields) const {
  std::fill(fields.begin(), fields.end(), 0.0);
  for (const Share& share : shares)
    fields[static_cast<std::size_t>(share.field)] += share.factor * p[share.parameter];
}

double Excitation::factor(double w) const {
  if (kind == Kind::base_displacement) return harmonic * w * (harmonic * w);
  return kind == Kind::force ? 1 : -1;
}

double Excitation::factor_rate(double w) const {
  return kind == Kind::base_displacement ? 2.0 * harmonic * harmonic * w : 0;
}

double Excitation::displacement(double w) const {
  if (kind == Kind::base_acceleration) return harmonic == 0 ? 0 : -1 / (harmonic * w * (harmonic * w));
  return kind == Kind::force ? 0 : 1;
}

double Excitation::displacement_rate(double w) const {
  return kind == Kind::base_acceleration ? -2 / w * displacement(w) : 0;
}

Eigen::VectorXd shape(const Model& model, const Excitation& excitation, const continuation::Vector& p) {
  Eigen::VectorXd g = Eigen::VectorXd::Zero(model.dofs);
  if (!excitation.moves_base()) {
    g = excitation.direction;
  } else {
    for (const LinearPart& mass : model.masses)
      g += p[mass.parameter] * mass.direction.dot(excitation.direction) * mass.direction;
  }
  return excitation.factor(p[frequency]) * g;
}

void add_outer(double factor, const Direction& d, Eigen::MatrixXd& sum) {
  for (Direction::InnerIterator j(d); j; ++j)
    for (Direction::InnerIterator i(d); i; ++i) sum(i.index(), j.index()) += factor * i.value() * j.value();
}

Eigen::MatrixXd assemble(const std::vector<LinearPart>& parts, const continuation::Vector& p, int dofs) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dofs, dofs);
  for (const LinearPart& part : parts) add_outer(p[part.parameter], part.direction, sum);
  return sum;
}

std::optional<int> drifting_dof(const Model& model, const continuation::Vector& p, bool in_stick) {
  if (model.harmonics.odd) return {};
  // Springs of any stiffness hold what they are between: a stiff link takes nothing from the softer ones.
  // Only where some are negative it takes their values to tell.
  const bool negative = std::any_of(model.springs.begin(), model.springs.end(),
                                    [&](const LinearPart& spring) { return p[spring.parameter] < 0; });
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(model.dofs, model.dofs);
  for (const LinearPart& spring : model.springs)
    if (const double k = p[spring.parameter]; k != 0)
      add_outer(negative ? k : 1 / spring.direction.squaredNorm(), spring.direction, K);
  const double largest = K.cwiseAbs().maxCoeff(), typical = largest > 0 ? largest : 1;
  for (const NonlinearPart& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i)
      if (const auto traits = element.law->traits(element.fields(p), static_cast<int>(i));
          traits.holds_mean || (in_stick && traits.holds_in_stick))
        add_outer(typical, element.directions[i], K);
  if (!K.allFinite()) return {};  // overflow: nothing is known
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
