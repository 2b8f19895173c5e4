#include <arcslip/model/model.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/laws/law_type.hpp>
#include <arcslip/model/placed_matrices.hpp>
#include <arcslip/scene/patch.hpp>
#include <arcslip/scene/rotation.hpp>
#include <arcslip/scene/shape.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace arcslip::model {
namespace {

constexpr double massless = 1e-14;  // a mode: its mu relative to the largest

Excitation::Kind kind_of(const scene::Part& part) {
  if (part.type == &scene::base_displacement_type()) return Excitation::Kind::base_displacement;
  if (part.type == &scene::base_acceleration_type()) return Excitation::Kind::base_acceleration;
  return Excitation::Kind::force;
}

class Builder {
 public:
  Builder(const scene::Scene& scene, const control::Control& control) : scene_(scene) {
    set_dofs(control);
    if (scene.cyclic) {
      const int count = scene.cyclic->sectors, order = scene.cyclic->engine_order % count;
      model_.sector = Sector{count, order < 0 ? order + count : order};
    }
    numbers_["frequency"] = frequency;
    model_.parameters.push_back({"frequency", "rad/s", 0, 1, 0, 1e300});
  }

  Model build() {
    for (const auto& part : scene_.masses) model_.masses.push_back(linear(part));
    for (const auto& part : scene_.dampers) model_.dampers.push_back(linear(part));
    for (const auto& part : scene_.springs) model_.springs.push_back(linear(part));
    for (const auto& part : scene_.damping) add_damping(part);
    for (const auto& part : scene_.elements) {
      std::vector<Share> shares;
      for (std::size_t k = 0; k < part.values.size(); ++k)
        shares.push_back({static_cast<int>(k), number(part, k)});
      add_element(part, std::move(shares));
    }
    for (const auto& patch : scene_.patches) add_patch(patch);
    bool even = false;
    model_.force_harmonic = scene_.harmonics.order;
    if (!scene_.rotation.empty()) set_speed();
    for (std::size_t i = 0; i < scene_.excitation.size(); ++i) {
      const auto& part = scene_.excitation[i];
      add_excitation(part, i);
      even = even || part.harmonic * scene_.harmonics.period % 2 == 0;
      if (part.harmonic > 0) model_.force_harmonic = std::min(model_.force_harmonic, part.harmonic);
    }
    model_.response = sparse(scene_.response());
    model_.absolute = scene_.responses.front().frame == scene::Frame::absolute;
    for (const scene::Direction& other : scene_.responses.front().others)
      model_.others.push_back(sparse(other));
    for (const scene::Response& response : scene_.responses) {
      if (response.name.empty()) continue;
      NamedResponse& named = model_.named_responses.emplace_back();
      named.absolute = response.frame == scene::Frame::absolute;
      named.places.push_back(sparse(response.direction));
      for (const scene::Direction& other : response.others) named.places.push_back(sparse(other));
    }
    model_.harmonics = {scene_.harmonics.order, !even && model_.antisymmetric, scene_.harmonics.period};
    model_.settings = scene_.harmonics;
    for (const scene::Constant& constant : scene_.constants) number(constant.name);
    model_.threads = scene_.threads.count;
    model_.catalogue = scene_.catalogue.all;
    return std::move(model_);
  }

 private:
  // Those of the scene, or of its matrices and what stands next to them.
  void set_dofs(const control::Control& control) {
    if (scene_.matrices) {
      PlacedMatrices placed = place_matrices(scene_, control);
      model_.dof_names = std::move(placed.dof_names);
      model_.unnamed_from = placed.unnamed_from;
      model_.unnamed_to = placed.unnamed_to;
      model_.matrices = std::move(placed.parts);
      model_.linked = !model_.matrices.empty() && model_.matrices.front().waves;
      model_.reduction = placed.reduction;
      dof_of_ = std::move(placed.dof_of);
      by_speed_ = std::move(placed.by_speed);
      shapes_ = std::move(placed.shapes);
    } else {
      model_.dof_names = scene_.dofs;
    }
    model_.dofs = static_cast<int>(model_.dof_names.size());
  }

  void add_excitation(const scene::Part& part, std::size_t i) {
    const Excitation base{kind_of(part), part.harmonic, number(part, 0), number(part, 1),
                          sparse(part.directions.front())};
    if (scene::shape_of(part) == nullptr) model_.excitation.push_back(base);
    for (const PlacedShape& shape : shapes_) {
      if (shape.excitation != i) continue;
      Excitation one = base;
      one.imaginary = shape.imaginary;
      if (one.imaginary) one.direction = Direction(model_.dofs);  // what stands next to the shape is real
      one.load = shape.load;
      for (int dof = 0; dof < static_cast<int>(shape.ground.size()); ++dof)
        if (shape.ground[dof] != 0) one.direction.coeffRef(dof) += shape.ground[dof];
      model_.excitation.push_back(std::move(one));
    }
  }

  // The parameter of the matrices that follow the speed.
  void set_speed() {
    const scene::Part& part = scene_.rotation.front();
    const double order = part.options.empty() ? 0 : part.options.as<scene::Rotation>().engine_order;
    for (const std::size_t i : by_speed_) {
      MatrixPart& matrix = model_.matrices[i];
      matrix.number = order > 0 ? Number(frequency) : number(part, 0);
      matrix.scale = order > 0 ? order : 1;
    }
  }

  Direction sparse(const scene::Direction& direction, bool next = false) const {
    Direction d(model_.dofs);
    for (const scene::Term& term : direction)
      if (term.next == next)
        d.coeffRef(dof_of_.empty() ? term.dof : dof_of_[static_cast<std::size_t>(term.dof)]) += term.weight;
    return d;
  }

  void add_damping(const scene::Part& part) {
    if (part.type == &scene::modal_damping_type()) {
      const Number ratio = number(part, 0);
      model_.matrices.push_back(
          {LinearKind::damper, ratio, std::make_shared<const Eigen::MatrixXd>(modal_damping())});
      return;
    }
    if (!model_.damping) model_.damping.emplace();
    if (part.type == &scene::rayleigh_type()) {
      model_.damping->alpha = number(part, 0);
      model_.damping->beta = number(part, 1);
    } else {
      model_.damping->loss_factor = number(part, 0);
    }
  }

  // Of the modes V of M and K at rest, of its symmetric part, with natural frequencies w_j, V^T M V = 1, C =
  // M V diag(2 w_j) V^T M over the damping ratio. With B = K + s^2 M, definite, M V = B V mu, w_j^2 = 1/mu -
  // s^2; massless modes have none.
  Eigen::MatrixXd modal_damping() {
    const continuation::Vector p = defaults(model_);
    const Eigen::MatrixXd M = mass_matrix(model_, p);
    Eigen::MatrixXd K = sum_of(model_, LinearKind::spring, p);
    for (const std::size_t i : by_speed_)  // without a parameter yet: with the value 1
      if (model_.matrices[i].kind == LinearKind::spring) K -= *model_.matrices[i].A;
    K = 0.5 * (K + K.transpose()).eval();
    const double shift = K.trace() / M.trace();
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(model_.dofs, model_.dofs);
    const auto modes = continuation::symmetric_modes(M, K + shift * M);
    if (modes.values.size() == 0) return C;
    const double least = massless * modes.values.maxCoeff();
    for (Eigen::Index j = 0; j < modes.values.size(); ++j) {
      const double mu = modes.values[j];
      if (!(mu > least)) continue;
      const Eigen::VectorXd Mv = M * modes.V.col(j) / std::sqrt(mu);
      C += 2 * std::sqrt(std::max(1 / mu - shift, 0.0)) * Mv * Mv.transpose();
    }
    return C;
  }

  // Into the next sector; empty where no term is there.
  Direction sparse_next(const scene::Direction& direction) const {
    const bool any =
        std::any_of(direction.begin(), direction.end(), [](const auto& term) { return term.next; });
    return any ? sparse(direction, true) : Direction();
  }

  LinearPart linear(const scene::Part& part) {
    LinearPart linear{number(part, 0), sparse(part.directions.front()), sparse_next(part.directions.front())};
    model_.linked = model_.linked || linear.next.size() > 0;
    return linear;
  }

  void add_element(const scene::Part& part, std::vector<Share> shares) {
    NonlinearPart element{part.name, elements::law_of(part), std::move(shares),
                          {},        part.values.size(),     part.wear_coefficient};
    for (const auto& direction : part.directions) {
      element.directions.push_back(sparse(direction));
      element.next.push_back(sparse_next(direction));
    }
    if (std::all_of(element.next.begin(), element.next.end(), [](const auto& d) { return d.size() == 0; }))
      element.next.clear();
    if (element.directions.size() != static_cast<std::size_t>(element.law->directions()))
      throw std::invalid_argument("the element \"" + part.name + "\" has " +
                                  std::to_string(element.directions.size()) + " directions, its law " +
                                  std::to_string(element.law->directions()));
    model_.antisymmetric = model_.antisymmetric && element.law->antisymmetric();
    model_.elements.push_back(std::move(element));
  }

  void add_patch(const scene::Part& part) {
    std::vector<Number> numbers;
    for (std::size_t k = 0; k < part.values.size(); ++k) numbers.push_back(number(part, k));
    Patch patch{part.name, model_.elements.size(), {}};
    const auto& options = part.options.as<scene::PatchOptions>();
    for (const scene::PatchRow& row : options.rows) {
      std::vector<Share> shares;
      for (const scene::PatchShare& share : options.shares(row))
        shares.push_back({static_cast<int>(share.field), numbers[share.from], share.factor});
      add_element(scene::patch_element(part, row), std::move(shares));
      patch.areas.push_back(row.area);
    }
    model_.patches.push_back(std::move(patch));
  }

  // Those of a part are not looked for by their names.
  Number number(const scene::Part& part, std::size_t field) {
    const scene::Field& own = part.fields()[field];
    return number(part.name + "." + std::string(own.name), own, part.values[field], part.formula(field));
  }
  Number number(const std::string& name) {
    if (const auto known = numbers_.find(name); known != numbers_.end()) return known->second;
    return number(name, scene::parameter_field(scene_, name), scene::value(scene_, name),
                  scene::parameter_formula(scene_, name));
  }

  // A parameter, or the formula of a number that follows others: a new one, or the one that is there.
  Number number(const std::string& name, const scene::Field& field, double value,
                const scene::NumberText* text) {
    if (const auto known = numbers_.find(name); known != numbers_.end()) return known->second;
    Number number;
    if (text != nullptr) {
      number = followed(name, field, *text);
    } else {
      number = static_cast<int>(model_.parameters.size());
      model_.parameters.push_back({name, std::string(field.unit), value, std::max(std::abs(value), 1e-300),
                                   field.lower, field.upper});
    }
    numbers_.emplace(name, number);
    return number;
  }

  // A number that is another parameter is that itself.
  Number followed(const std::string& name, const scene::Field& field, const scene::NumberText& text) {
    std::vector<formula::Formula> inputs;
    for (const std::string& parameter : text.parameters) {
      const Number input = number(parameter);
      if (text.is_parameter()) return input;
      inputs.push_back(input.formula() != nullptr ? input.formula()->formula
                                                  : formula::input(input.parameter()));
    }
    const scene::Field bounds{
        .name = {}, .unit = {}, .lower = field.lower, .upper = field.upper, .lower_open = field.lower_open};
    model_.formulas.push_back(std::make_shared<const NumberFormula>(
        NumberFormula{name, formula::composed(*text.formula, inputs), bounds}));
    return Number(model_.formulas.back());
  }

  const scene::Scene& scene_;
  std::vector<PlacedShape> shapes_;                  // of the excitations
  std::vector<std::size_t> by_speed_;                // matrices that follow the speed of rotation
  std::vector<int> dof_of_;                          // in the model, of those of a scene with matrices
  std::unordered_map<std::string, Number> numbers_;  // by their names
  Model model_;
};

}  // namespace

Model build(const scene::Scene& scene, const control::Control& control) {
  return Builder(scene, control).build();
}

Model in_harmonics(Model model, const elements::Harmonics& harmonics) {
  model.settings.samples = model.settings.samples / model.harmonics.period * harmonics.period;
  model.settings.order = harmonics.order;
  model.settings.period = harmonics.period;
  model.harmonics = harmonics;
  return model;
}

}  // namespace arcslip::model
