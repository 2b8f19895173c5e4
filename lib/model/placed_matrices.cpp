#include <arcslip/model/placed_matrices.hpp>

#include <arcslip/scene/patch.hpp>
#include <arcslip/scene/rotation.hpp>
#include <arcslip/scene/shape.hpp>
#include <arcslip/structure/reduction.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>

namespace arcslip::model {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using structure::Reduced;

constexpr Index most_of_copies = 2500;  // degrees of freedom together: matrices are dense

enum class Form { symmetric, skew, general };

VectorXd product(const scene::SparseMatrix& A, const VectorXd& x) {
  VectorXd y = VectorXd::Zero(A.rows);
  for (int j = 0; j < A.columns; ++j)
    for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k)
      y[A.row_of[k]] += A.values[k] * x[j];
  return y;
}

scene::Matrices with_stiffness(scene::Matrices matrices, double factor) {
  if (factor == 1) return matrices;
  scene::SparseMatrix K = *matrices.stiffness.matrix;
  for (double& value : K.values) value *= factor;
  matrices.stiffness.matrix = std::make_shared<const scene::SparseMatrix>(std::move(K));
  return matrices;
}

/// One copy of the structure: matrices and loads in its rows and coordinates.
struct Copy {
  std::shared_ptr<const Reduced> in;
  Index first = 0;  // of its coordinates, behind the rows of all copies
};

class Placer {
 public:
  Placer(const scene::Scene& scene, const scene::StopRequest& stop)
      : scene_(scene),
        files_(*scene.matrices),
        reduces_(files_.highest_frequency > 0),
        copies_(files_.copies),
        stop_(stop) {}

  PlacedMatrices place() {
    choose_rows();
    add_shapes();
    make_copies();
    name_dofs();
    add_parts();
    place_shapes();
    return std::move(placed_);
  }

 private:
  // A column of a file as a load: itself, or M times it.
  struct Load {
    VectorXd on_rows, load;
  };

  bool is_used(std::size_t name, const std::vector<bool>& used) const {
    const auto first = used.begin() + static_cast<std::ptrdiff_t>(name) * copies_;
    return std::find(first, first + copies_, true) != first + copies_;
  }

  void choose_rows() {
    const std::vector<bool> used = used_dofs();
    kept_of_.assign(files_.rows.size(), -1);
    for (std::size_t name = 0; name < files_.rows.size(); ++name) {
      if (reduces_ && !is_used(name, used)) continue;
      kept_of_[name] = static_cast<int>(names_.size());
      names_.push_back(name);
      rows_.push_back(files_.rows[name]);
    }
    kept_ = static_cast<Index>(rows_.size());
    check_size(kept_ * copies_);
    if (reduces_) return;
    std::vector<bool> named(static_cast<std::size_t>(files_.size()), false);
    for (const int row : rows_) named[static_cast<std::size_t>(row)] = true;
    for (int row = 0; row < files_.size(); ++row)
      if (!named[static_cast<std::size_t>(row)]) rows_.push_back(row);
  }

  void check_size(Index dofs) const {
    if (copies_ == 1 || dofs <= most_of_copies) return;
    throw structure::ReductionError(
        std::to_string(copies_) + " copies have " + std::to_string(dofs) +
        " degrees of freedom together, must have at most " + std::to_string(most_of_copies) +
        ", since the matrices of the model are dense; lower \"highest_frequency\", let the scene use fewer "
        "rows, or give \"cyclic\" without \"full\" where all sectors are equal");
  }

  void add_shapes() {
    std::map<std::tuple<const scene::SparseMatrix*, int, bool>, std::size_t> known;
    for (std::size_t i = 0; i < scene_.excitation.size(); ++i) {
      const scene::Shape* shape = scene::shape_of(scene_.excitation[i]);
      if (shape == nullptr) continue;
      const bool moves_base = scene::is_base_motion(*scene_.excitation[i].type);
      for (const bool imaginary : {false, true}) {
        const scene::ShapeFile& file = imaginary ? shape->imaginary : shape->real;
        if (!file.is_given()) continue;
        const auto [found, is_new] =
            known.try_emplace({file.from.matrix.get(), file.column, moves_base}, loads_.size());
        if (is_new) {
          const std::vector<double> values = file.values();
          VectorXd on_rows = VectorXd::Map(values.data(), static_cast<Index>(values.size()));
          VectorXd load = moves_base ? product(*files_.mass.matrix, on_rows) : on_rows;
          loads_.push_back({std::move(on_rows), std::move(load)});
        }
        load_of_.push_back(found->second);
        copy_of_.push_back(std::max(shape->copy, 1) - 1);
        placed_.shapes.push_back({i, imaginary, {}, {}});
      }
    }
  }

  void make_copies() {
    std::map<double, std::shared_ptr<const Reduced>> made;
    Index coordinates = 0;
    for (int copy = 0; copy < copies_; ++copy) {
      std::shared_ptr<const Reduced>& in = made[files_.stiffness_factor(copy)];
      if (!in) in = reduces_ ? reduced(files_.stiffness_factor(copy)) : whole(files_.stiffness_factor(copy));
      all_.push_back({in, coordinates});
      coordinates += in->M.rows() - kept_;
    }
    check_size(kept_ * copies_ + coordinates);
    placed_.unnamed_from = static_cast<int>(kept_ * copies_);
    placed_.unnamed_to = static_cast<int>(kept_ * copies_ + coordinates);
    if (!reduces_) return;
    Reduction& told = placed_.reduction.emplace();
    told.rows = files_.size();
    told.kept = static_cast<int>(kept_);
    told.highest_frequency = highest_frequency();
    told.highest_speed = highest_speed();
    for (const auto& [factor, in] : made) {
      told.coordinates = std::max(told.coordinates, static_cast<int>(in->M.rows() - kept_));
      told.error = std::max(told.error, in->error);
      told.free_below = std::max(told.free_below, in->free_below);
    }
  }

  double highest_frequency() const {
    return files_.highest_frequency * scene::to_rad_per_s(scene_.frequency_unit);
  }

  double highest_speed() const {
    if (scene_.rotation.empty() || scene_.rotation.front().options.empty()) return 0;
    const auto& rotation = scene_.rotation.front().options.as<scene::Rotation>();
    return rotation.engine_order > 0 ? highest_frequency() / rotation.engine_order : rotation.highest_speed;
  }

  std::shared_ptr<const Reduced> reduced(double factor) const {
    structure::Purpose purpose{highest_frequency(), highest_speed(), {}};
    std::string key = "reduced for " + std::to_string(purpose.highest) + " rad/s, " +
                      std::to_string(purpose.highest_speed) + " rad/s to ";
    for (const int row : rows_) key += std::to_string(row) + ' ';
    const auto add_bytes = [&](const char* what, const double* from, Index count) {
      const std::string_view bytes(reinterpret_cast<const char*>(from),
                                   sizeof(double) * static_cast<std::size_t>(count));
      key += what + std::to_string(std::hash<std::string_view>()(bytes)) + ' ';
    };
    purpose.loads.resize(files_.size(), static_cast<Index>(loads_.size()));
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      purpose.loads.col(static_cast<Index>(k)) = loads_[k].load;
      add_bytes("with ", loads_[k].load.data(), loads_[k].load.size());
    }
    if (factor != 1) add_bytes("of stiffness ", &factor, 1);
    return files_.derived->get<Reduced>(
        key, [&] { return structure::reduce(with_stiffness(files_, factor), rows_, purpose, stop_); });
  }

  std::shared_ptr<const Reduced> whole(double factor) const {
    std::vector<Index> at(rows_.size());
    for (std::size_t k = 0; k < rows_.size(); ++k)
      at[static_cast<std::size_t>(rows_[k])] = static_cast<Index>(k);
    const auto dense = [&](const scene::MatrixFile& file, Form form) {
      if (!file.matrix) return MatrixXd();
      const scene::SparseMatrix& of = *file.matrix;
      MatrixXd A = MatrixXd::Zero(of.rows, of.columns);
      for (std::size_t j = 0; j < at.size(); ++j)
        for (auto k = static_cast<std::size_t>(of.starts[j]); k < static_cast<std::size_t>(of.starts[j + 1]);
             ++k)
          A(at[static_cast<std::size_t>(of.row_of[k])], at[j]) = of.values[k];
      if (form == Form::symmetric) A = 0.5 * (A + A.transpose()).eval();
      if (form == Form::skew) A = 0.5 * (A - A.transpose()).eval();
      return A;
    };
    const auto form = [](bool unsymmetric) { return unsymmetric ? Form::general : Form::symmetric; };
    Reduced in;
    in.M = dense(files_.mass, Form::symmetric);
    in.K = factor * dense(files_.stiffness, form(files_.unsymmetric_stiffness));
    in.C = dense(files_.damping, form(files_.unsymmetric_damping));
    in.K2 = dense(files_.stiffness_speed_squared, Form::symmetric);
    in.G = dense(files_.gyroscopic, Form::skew);
    in.N = dense(files_.circulatory, Form::skew);
    in.loads.resize(files_.size(), static_cast<Index>(loads_.size()));
    for (std::size_t k = 0; k < loads_.size(); ++k)
      in.loads.col(static_cast<Index>(k)) = loads_[k].load(rows_);
    return std::make_shared<const Reduced>(std::move(in));
  }

  // In the model, of row or coordinate k of a copy.
  Index place_of(int copy, Index k) const {
    return k < kept_ ? copy * kept_ + k
                     : copies_ * kept_ + all_[static_cast<std::size_t>(copy)].first + k - kept_;
  }

  void name_dofs() {
    const auto named = static_cast<std::ptrdiff_t>(files_.named());
    std::vector<std::string>& names = placed_.dof_names;
    for (int copy = 0; copy < copies_; ++copy)
      for (const std::size_t name : names_)
        names.push_back(
            scene_.dofs[name * static_cast<std::size_t>(copies_) + static_cast<std::size_t>(copy)]);
    for (int copy = 0; copy < copies_; ++copy)
      for (Index k = kept_; k < all_[static_cast<std::size_t>(copy)].in->M.rows(); ++k)
        names.push_back((reduces_ ? "coordinate " + std::to_string(k - kept_ + 1)
                                  : "row " + std::to_string(rows_[static_cast<std::size_t>(k)] + 1)) +
                        (copies_ > 1 ? " of copy " + std::to_string(copy + 1) : ""));
    for (const int kept : kept_of_)
      for (int copy = 0; copy < copies_; ++copy)
        placed_.dof_of.push_back(kept < 0 ? -1 : static_cast<int>(place_of(copy, kept)));
    for (auto dof = scene_.dofs.begin() + named; dof != scene_.dofs.end(); ++dof) {
      placed_.dof_of.push_back(static_cast<int>(names.size()));
      names.push_back(*dof);
    }
  }

  void add_parts() {
    add(LinearKind::mass, &Reduced::M);
    add(LinearKind::spring, &Reduced::K, !files_.unsymmetric_stiffness);
    add(LinearKind::damper, &Reduced::C, !files_.unsymmetric_damping);
    add_by_speed(LinearKind::spring, &Reduced::K2, true);
    add_by_speed(LinearKind::damper, &Reduced::G, false);
    add_by_speed(LinearKind::circulatory, &Reduced::N, false);
  }

  // A block for each copy.
  bool add(LinearKind kind, MatrixXd Reduced::*part, bool symmetric = true) {
    if (((*all_.front().in).*part).size() == 0) return false;
    const auto dofs = static_cast<Index>(placed_.dof_names.size());
    MatrixXd A = MatrixXd::Zero(dofs, dofs);
    for (int copy = 0; copy < copies_; ++copy) {
      const MatrixXd& block = (*all_[static_cast<std::size_t>(copy)].in).*part;
      for (Index j = 0; j < block.cols(); ++j)
        for (Index i = 0; i < block.rows(); ++i) A(place_of(copy, i), place_of(copy, j)) = block(i, j);
    }
    placed_.parts.push_back({kind, -1, std::make_shared<const MatrixXd>(std::move(A))});
    placed_.parts.back().symmetric = symmetric;
    return true;
  }

  // Of a rotor, value: speed or its square.
  void add_by_speed(LinearKind kind, MatrixXd Reduced::*part, bool squared) {
    if (!add(kind, part, squared)) return;
    placed_.parts.back().squared = squared;
    placed_.by_speed.push_back(placed_.parts.size() - 1);
  }

  void place_shapes() {
    const auto dofs = static_cast<Index>(placed_.dof_names.size());
    for (std::size_t s = 0; s < placed_.shapes.size(); ++s) {
      PlacedShape& shape = placed_.shapes[s];
      const int copy = copy_of_[s];
      const Load& of = loads_[load_of_[s]];
      const MatrixXd& loads = all_[static_cast<std::size_t>(copy)].in->loads;
      shape.load.setZero(dofs);
      for (Index k = 0; k < loads.rows(); ++k)
        shape.load[place_of(copy, k)] = loads(k, static_cast<Index>(load_of_[s]));
      if (!scene::is_base_motion(*scene_.excitation[shape.excitation].type)) continue;
      shape.ground.setZero(dofs);
      for (std::size_t k = 0; k < rows_.size(); ++k)
        shape.ground[place_of(copy, static_cast<Index>(k))] = of.on_rows[rows_[k]];
    }
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

  const scene::Scene& scene_;
  const scene::Matrices& files_;
  const bool reduces_;
  const int copies_;
  const scene::StopRequest& stop_;
  Index kept_ = 0;
  std::vector<std::size_t> names_;    // that are kept, of the rows with names
  std::vector<int> kept_of_;          // the place of each row with a name among them; -1: none
  std::vector<int> rows_;             // of the matrices: those kept, and of whole matrices all others
  std::vector<Load> loads_;           // different ones
  std::vector<std::size_t> load_of_;  // of each shape
  std::vector<int> copy_of_;          // the same
  std::vector<Copy> all_;
  PlacedMatrices placed_;
};

}  // namespace

PlacedMatrices place_matrices(const scene::Scene& scene, const scene::StopRequest& stop) {
  return Placer(scene, stop).place();
}

}  // namespace arcslip::model
