#include <arcslip/model/model.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/scene/patch.hpp>
#include <arcslip/scene/rotation.hpp>
#include <arcslip/scene/shape.hpp>
#include <arcslip/structure/reduction.hpp>

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

enum class Form { symmetric, skew, general };

Excitation::Kind kind_of(const scene::Part& part) {
  if (part.type == &scene::base_displacement_type()) return Excitation::Kind::base_displacement;
  if (part.type == &scene::base_acceleration_type()) return Excitation::Kind::base_acceleration;
  return Excitation::Kind::force;
}

class Builder {
 public:
  Builder(const scene::Scene& scene, const scene::StopRequest& stop) : scene_(scene) {
    set_dofs(stop);
    if (scene.cyclic) {
      const int count = scene.cyclic->sectors, order = scene.cyclic->engine_order % count;
      model_.sector = Sector{count, order < 0 ? order + count : order};
    }
    for (const scene::Tie& tie : scene.ties)
      for (const std::string& member : tie.members) tie_of_[member] = tie.name;
    parameter_of_["frequency"] = 0;
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
        shares.push_back({static_cast<int>(k), parameter(part, k)});
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
    model_.threads = scene_.threads.count;
    return std::move(model_);
  }

 private:
  // The degrees of freedom of the scene; in large structures those that it uses; then what describes the
  // rest of the matrices: their other rows or, where they are reduced, a few coordinates.
  void set_dofs(const scene::StopRequest& stop) {
    if (!scene_.matrices) {
      model_.dof_names = scene_.dofs;
    } else if (scene_.matrices->highest_frequency > 0) {
      add_reduced(*scene_.matrices, stop);
    } else {
      add_whole(*scene_.matrices);
    }
    model_.dofs = static_cast<int>(model_.dof_names.size());
    for (MatrixPart& part : model_.matrices) {
      if (part.A->rows() == model_.dofs) continue;
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(model_.dofs, model_.dofs);
      A.topLeftCorner(part.A->rows(), part.A->cols()) = *part.A;
      part.A = std::make_shared<const Eigen::MatrixXd>(std::move(A));
    }
  }

  // A shape of an excitation of the scene.
  struct ShapeValues {
    std::size_t excitation;
    bool imaginary;
    Eigen::VectorXd on_rows;  // of the matrices
    Eigen::VectorXd load{};   // on the degrees of freedom of the model
  };

  std::vector<ShapeValues> shape_values() const {
    std::vector<ShapeValues> all;
    for (std::size_t i = 0; i < scene_.excitation.size(); ++i) {
      const scene::Shape* shape = scene::shape_of(scene_.excitation[i]);
      if (shape == nullptr) continue;
      for (const bool imaginary : {false, true}) {
        const scene::ShapeFile& file = imaginary ? shape->imaginary : shape->real;
        if (!file.is_given()) continue;
        const std::vector<double> values = file.values();
        const auto size = static_cast<Eigen::Index>(values.size());
        all.push_back({i, imaginary, Eigen::Map<const Eigen::VectorXd>(values.data(), size)});
      }
    }
    return all;
  }

  // On all rows of the matrices: a force, or M r.
  Eigen::VectorXd load_of(const ShapeValues& shape, const scene::SparseMatrix& M) const {
    if (!scene::is_base_motion(*scene_.excitation[shape.excitation].type)) return shape.on_rows;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(M.rows);
    for (int j = 0; j < M.columns; ++j)
      for (auto k = static_cast<std::size_t>(M.starts[static_cast<std::size_t>(j)]);
           k < static_cast<std::size_t>(M.starts[static_cast<std::size_t>(j) + 1]); ++k)
        load[M.row_of[k]] += M.values[k] * shape.on_rows[j];
    return load;
  }

  void add_excitation(const scene::Part& part, std::size_t i) {
    const Excitation base{kind_of(part), part.harmonic, parameter(part, 0), parameter(part, 1),
                          sparse(part.directions.front())};
    if (scene::shape_of(part) == nullptr) model_.excitation.push_back(base);
    for (const ShapeValues& shape : shapes_) {
      if (shape.excitation != i) continue;
      Excitation one = base;
      one.imaginary = shape.imaginary;
      if (one.imaginary) one.direction = Direction(model_.dofs);  // what stands beside the shape is real
      one.load.setZero(model_.dofs);
      one.load.head(shape.load.size()) = shape.load;
      if (one.moves_base()) add_rows(shape.on_rows, one.direction);
      model_.excitation.push_back(std::move(one));
    }
  }

  // Of r on the rows of the matrices what the degrees of freedom of the model have.
  void add_rows(const Eigen::VectorXd& on_rows, Direction& r) const {
    for (std::size_t row = 0; row < place_.size(); ++row)
      if (const double value = on_rows[static_cast<Eigen::Index>(row)]; place_[row] >= 0 && value != 0)
        r.coeffRef(place_[row]) += value;
  }

  // The parameter of the matrices that follow the speed.
  void set_speed() {
    const scene::Part& part = scene_.rotation.front();
    const double order = part.options.empty() ? 0 : part.options.as<scene::Rotation>().engine_order;
    for (const std::size_t i : by_speed_) {
      MatrixPart& matrix = model_.matrices[i];
      matrix.parameter = order > 0 ? frequency : parameter(part, 0);
      matrix.scale = order > 0 ? order : 1;
    }
  }

  double highest_speed(double highest_frequency) const {
    if (scene_.rotation.empty() || scene_.rotation.front().options.empty()) return 0;
    const auto& rotation = scene_.rotation.front().options.as<scene::Rotation>();
    return rotation.engine_order > 0 ? highest_frequency / rotation.engine_order : rotation.highest_speed;
  }

  void add_matrix(LinearKind kind, int parameter, Eigen::MatrixXd A, bool symmetric = true) {
    model_.matrices.push_back({kind, parameter, std::make_shared<const Eigen::MatrixXd>(std::move(A))});
    model_.matrices.back().symmetric = symmetric;
  }

  // Of a rotor, value: speed or its square.
  void add_by_speed(LinearKind kind, Eigen::MatrixXd A, bool squared) {
    add_matrix(kind, -1, std::move(A), squared);
    model_.matrices.back().squared = squared;
    by_speed_.push_back(model_.matrices.size() - 1);
  }

  void add_whole(const scene::Matrices& files) {
    const auto named = files.rows.size();
    std::vector<int> place(static_cast<std::size_t>(files.size()), -1);
    for (std::size_t i = 0; i < named; ++i)
      place[static_cast<std::size_t>(files.rows[i])] = static_cast<int>(i);
    model_.dof_names.assign(scene_.dofs.begin(), scene_.dofs.begin() + static_cast<std::ptrdiff_t>(named));
    model_.unnamed_from = static_cast<int>(named);
    model_.unnamed_to = files.size();
    for (std::size_t row = 0; row < place.size(); ++row) {
      if (place[row] >= 0) continue;
      place[row] = static_cast<int>(model_.dof_names.size());
      model_.dof_names.push_back("row " + std::to_string(row + 1));
    }
    for (std::size_t i = 0; i < scene_.dofs.size(); ++i)
      dof_of_.push_back(static_cast<int>(i < named ? i : place.size() + i - named));
    model_.dof_names.insert(model_.dof_names.end(), scene_.dofs.begin() + static_cast<std::ptrdiff_t>(named),
                            scene_.dofs.end());
    place_ = place;
    shapes_ = shape_values();
    for (ShapeValues& shape : shapes_) {
      const Eigen::VectorXd load = load_of(shape, *files.mass.matrix);
      shape.load.setZero(load.size());
      for (std::size_t row = 0; row < place.size(); ++row)
        shape.load[place[row]] = load[static_cast<Eigen::Index>(row)];
    }
    const auto whole = [&](const scene::MatrixFile& file, Form form) {
      const scene::SparseMatrix& of = *file.matrix;
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(of.rows, of.columns);
      for (std::size_t j = 0; j < place.size(); ++j)
        for (auto k = static_cast<std::size_t>(of.starts[j]); k < static_cast<std::size_t>(of.starts[j + 1]);
             ++k)
          A(place[static_cast<std::size_t>(of.row_of[k])], place[j]) = of.values[k];
      if (form == Form::symmetric) A = 0.5 * (A + A.transpose()).eval();
      if (form == Form::skew) A = 0.5 * (A - A.transpose()).eval();
      return A;
    };
    const auto add = [&](LinearKind kind, const scene::MatrixFile& file, bool unsymmetric = false) {
      if (file.matrix)
        add_matrix(kind, -1, whole(file, unsymmetric ? Form::general : Form::symmetric), !unsymmetric);
    };
    add(LinearKind::mass, files.mass);
    add(LinearKind::spring, files.stiffness, files.unsymmetric_stiffness);
    add(LinearKind::damper, files.damping, files.unsymmetric_damping);
    if (files.stiffness_speed_squared.matrix)
      add_by_speed(LinearKind::spring, whole(files.stiffness_speed_squared, Form::symmetric), true);
    if (files.gyroscopic.matrix) add_by_speed(LinearKind::damper, whole(files.gyroscopic, Form::skew), false);
    if (files.circulatory.matrix)
      add_by_speed(LinearKind::circulatory, whole(files.circulatory, Form::skew), false);
  }

  void add_reduced(const scene::Matrices& files, const scene::StopRequest& stop) {
    const std::vector<bool> used = used_dofs();
    const auto named = files.rows.size();
    std::vector<int> kept;
    std::string key;
    dof_of_.assign(scene_.dofs.size(), -1);
    for (std::size_t i = 0; i < named; ++i) {
      if (!used[i]) continue;
      dof_of_[i] = static_cast<int>(kept.size());
      kept.push_back(files.rows[i]);
      key += std::to_string(files.rows[i]) + ' ';
      model_.dof_names.push_back(scene_.dofs[i]);
    }
    const double highest = files.highest_frequency * scene::to_rad_per_s(scene_.frequency_unit);
    structure::Purpose purpose{highest, highest_speed(highest), {}};
    key = "reduced for " + std::to_string(highest) + " rad/s, " + std::to_string(purpose.highest_speed) +
          " rad/s to " + key;
    shapes_ = shape_values();
    purpose.loads.resize(files.size(), static_cast<Eigen::Index>(shapes_.size()));
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const Eigen::VectorXd load = load_of(shapes_[k], *files.mass.matrix);
      purpose.loads.col(static_cast<Eigen::Index>(k)) = load;
      const std::string_view bytes(reinterpret_cast<const char*>(load.data()),
                                   sizeof(double) * static_cast<std::size_t>(load.size()));
      key += "with " + std::to_string(std::hash<std::string_view>()(bytes)) + ' ';
    }
    const auto reduced = files.derived->get<structure::Reduced>(
        key, [&] { return structure::reduce(files, kept, purpose, stop); });
    place_.assign(static_cast<std::size_t>(files.size()), -1);
    for (std::size_t k = 0; k < kept.size(); ++k)
      place_[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
    for (std::size_t k = 0; k < shapes_.size(); ++k)
      shapes_[k].load = reduced->loads.col(static_cast<Eigen::Index>(k));
    const auto coordinates = static_cast<int>(reduced->M.rows()) - static_cast<int>(kept.size());
    model_.unnamed_from = static_cast<int>(kept.size());
    model_.unnamed_to = model_.unnamed_from + coordinates;
    for (int k = 1; k <= coordinates; ++k) model_.dof_names.push_back("coordinate " + std::to_string(k));
    for (std::size_t i = named; i < scene_.dofs.size(); ++i) {
      dof_of_[i] = static_cast<int>(model_.dof_names.size());
      model_.dof_names.push_back(scene_.dofs[i]);
    }
    add_matrix(LinearKind::mass, -1, reduced->M);
    add_matrix(LinearKind::spring, -1, reduced->K, !files.unsymmetric_stiffness);
    if (reduced->C.size() > 0) add_matrix(LinearKind::damper, -1, reduced->C, !files.unsymmetric_damping);
    if (reduced->K2.size() > 0) add_by_speed(LinearKind::spring, reduced->K2, true);
    if (reduced->G.size() > 0) add_by_speed(LinearKind::damper, reduced->G, false);
    if (reduced->N.size() > 0) add_by_speed(LinearKind::circulatory, reduced->N, false);
    model_.reduction = {files.size(),   static_cast<int>(kept.size()), coordinates,          highest,
                        reduced->error, reduced->free_below,           purpose.highest_speed};
  }

  std::vector<bool> used_dofs() const {
    std::vector<bool> used(scene_.dofs.size(), false);
    const auto use = [&](const scene::Direction& direction) {
      for (const scene::Term& term : direction) used[static_cast<std::size_t>(term.dof)] = true;
    };
    const auto elements = scene::all_elements(scene_);
    for (const auto* parts :
         {&scene_.masses, &scene_.springs, &scene_.dampers, &scene_.excitation, &elements})
      for (const scene::Part& part : *parts)
        for (const scene::Direction& direction : part.directions) use(direction);
    for (const scene::Response& response : scene_.responses) {
      use(response.direction);
      for (const scene::Direction& other : response.others) use(other);
    }
    return used;
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
      add_matrix(LinearKind::damper, parameter(part, 0), modal_damping());
      return;
    }
    if (!model_.damping) model_.damping.emplace();
    if (part.type == &scene::rayleigh_type()) {
      model_.damping->alpha = parameter(part, 0);
      model_.damping->beta = parameter(part, 1);
    } else {
      model_.damping->loss_factor = parameter(part, 0);
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
    LinearPart linear{parameter(part, 0), sparse(part.directions.front()),
                      sparse_next(part.directions.front())};
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
    std::string name = part.name + "." + std::string(f.name);
    if (const auto tie = tie_of_.find(name); tie != tie_of_.end()) name = tie->second;
    auto& all = model_.parameters;
    const auto [known, is_new] = parameter_of_.emplace(name, static_cast<int>(all.size()));
    if (is_new) {
      const double value = part.values[field];
      all.push_back({name, std::string(f.unit), value, std::max(std::abs(value), 1e-300), f.lower, f.upper});
    } else {
      continuation::Parameter& tied = all[static_cast<std::size_t>(known->second)];
      tied.lower = std::max(tied.lower, f.lower);
      tied.upper = std::min(tied.upper, f.upper);
    }
    return known->second;
  }

  const scene::Scene& scene_;
  std::vector<int> place_;                               // in the model, of the rows of matrices; -1: none
  std::vector<ShapeValues> shapes_;                      // of the excitations
  std::vector<std::size_t> by_speed_;                    // matrices that follow the speed of rotation
  std::vector<int> dof_of_;                              // in the model, of those of a scene with matrices
  std::unordered_map<std::string, std::string> tie_of_;  // names of ties, by their members
  std::unordered_map<std::string, int> parameter_of_;    // indices, by their names
  Model model_;
};

}  // namespace

Model build(const scene::Scene& scene, const scene::StopRequest& stop) {
  return Builder(scene, stop).build();
}

}  // namespace arcslip::model
