#include <arcslip/model/placed_matrices.hpp>

#include <arcslip/scene/patch.hpp>
#include <arcslip/scene/rotation.hpp>
#include <arcslip/scene/shape.hpp>
#include <arcslip/structure/wave.hpp>

#include <algorithm>
#include <complex>
#include <map>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>

namespace arcslip::model {
namespace {

using Eigen::Index, Eigen::MatrixXcd, Eigen::MatrixXd, Eigen::VectorXcd, Eigen::VectorXd;
using structure::Reduced, structure::Wave, structure::WaveStructure;

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

// A name of these numbers.
std::string bytes(const char* what, const double* from, Index count) {
  const std::string_view all(reinterpret_cast<const char*>(from),
                             sizeof(double) * static_cast<std::size_t>(count));
  return what + std::to_string(std::hash<std::string_view>()(all)) + ' ';
}

// Of a closed ring among what is known of the matrices of a sector.
std::string ring_key(const scene::Matrices& sector) {
  const auto& factors = sector.stiffness_factors;
  return bytes(("the ring of " + std::to_string(sector.copies) + " with ").c_str(), factors.data(),
               static_cast<Index>(factors.size()));
}

/// One copy of the structure: matrices and loads in its rows and coordinates.
struct Copy {
  std::shared_ptr<const Reduced> in;  // null: in waves
  Index size = 0;                     // rows and coordinates
  Index first = 0;                    // of its coordinates, behind the rows of all copies
};

class Placer {
 public:
  /// files: the matrices of the scene, or where their copies share rows those of the closed ring.
  Placer(const scene::Scene& scene, const scene::Matrices& files, const scene::StopRequest& stop)
      : scene_(scene),
        files_(files),
        reduces_(files_.highest_frequency > 0),
        copies_(files_.copies),
        stop_(stop) {}

  PlacedMatrices place() {
    choose_rows();
    add_shapes();
    if (in_waves())
      make_waves();
    else
      make_copies();
    name_dofs();
    add_parts();
    if (in_waves())
      place_shapes_in_waves();
    else
      place_shapes();
    return std::move(placed_);
  }

 private:
  // A column of a file as a load: itself, or M times it.
  struct Load {
    VectorXd on_rows, load;
  };

  // One sector whose matrices reach into the next one.
  bool in_waves() const { return !files_.faces.empty(); }
  // The copies are one structure.
  bool is_closed_ring() const { return &files_ != &*scene_.matrices; }

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
    for (const scene::FacePair& pair : files_.faces) named[static_cast<std::size_t>(pair.beyond)] = true;
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
    std::map<std::tuple<const scene::SparseMatrix*, int, bool, int>, std::size_t> known;
    for (std::size_t i = 0; i < scene_.excitation.size(); ++i) {
      const scene::Shape* shape = scene::shape_of(scene_.excitation[i]);
      if (shape == nullptr) continue;
      const bool moves_base = scene::is_base_motion(*scene_.excitation[i].type);
      for (const bool imaginary : {false, true}) {
        const scene::ShapeFile& file = imaginary ? shape->imaginary : shape->real;
        if (!file.is_given()) continue;
        const int copy = std::max(shape->copy, 1) - 1, ring_copy = is_closed_ring() ? copy : 0;
        const auto [found, is_new] =
            known.try_emplace({file.from.matrix.get(), file.column, moves_base, ring_copy}, loads_.size());
        if (is_new) {
          const std::vector<double> values = file.values();
          VectorXd on_rows = VectorXd::Map(values.data(), static_cast<Index>(values.size()));
          if (is_closed_ring())
            on_rows = moves_base ? structure::displacements_on_ring(*scene_.matrices, copy, on_rows)
                                 : structure::forces_on_ring(*scene_.matrices, copy, on_rows);
          VectorXd load = moves_base ? product(*files_.mass.matrix, on_rows) : on_rows;
          loads_.push_back({std::move(on_rows), std::move(load)});
        }
        load_of_.push_back(found->second);
        copy_of_.push_back(is_closed_ring() ? 0 : copy);
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
      all_.push_back({in, in->M.rows(), coordinates});
      coordinates += in->M.rows() - kept_;
    }
    check_size(kept_ * copies_ + coordinates);
    tell_places(coordinates);
    for (const auto& [factor, in] : made) tell_error(in->M.rows(), in->error, in->free_below);
  }

  // Of each nodal diameter that a harmonic may have.
  void make_waves() {
    const int count = scene_.cyclic->sectors;
    waves_.resize(static_cast<std::size_t>(count) / 2 + 1);
    Index size = kept_;
    for (int n = 0; n < count; ++n) {
      const int diameter = wave_of(n).diameter;
      auto& in = waves_[static_cast<std::size_t>(diameter)];
      if (in) continue;
      in = wave({diameter, count});
      size = std::max(size, in->size());
    }
    all_.push_back({nullptr, size, 0});
    tell_places(size - kept_);
    for (const auto& in : waves_)
      if (in) tell_error(in->size(), in->error, in->free_below);
  }

  // Of harmonic n, in the direction in which the waves are made; backwards: it travels the other way round.
  struct Harmonic {
    int diameter;
    bool backwards;
  };
  Harmonic wave_of(int n) const {
    const int count = scene_.cyclic->sectors;
    const auto order = static_cast<int>(static_cast<long long>(n) * scene_.cyclic->engine_order % count);
    const int diameter = order < 0 ? order + count : order;
    return 2 * diameter > count ? Harmonic{count - diameter, true} : Harmonic{diameter, false};
  }

  void tell_places(Index coordinates) {
    placed_.unnamed_from = static_cast<int>(kept_ * copies_);
    placed_.unnamed_to = static_cast<int>(kept_ * copies_ + coordinates);
    if (!reduces_) return;
    Reduction& told = placed_.reduction.emplace();
    told.rows = files_.size();
    told.kept = static_cast<int>(kept_);
    told.highest_frequency = highest_frequency();
    told.highest_speed = highest_speed();
  }

  void tell_error(Index size, double error, double free_below) {
    if (!placed_.reduction) return;
    Reduction& told = *placed_.reduction;
    told.coordinates = std::max(told.coordinates, static_cast<int>(size - kept_));
    told.error = std::max(told.error, error);
    told.free_below = std::max(told.free_below, free_below);
  }

  double highest_frequency() const {
    return files_.highest_frequency * scene::to_rad_per_s(scene_.frequency_unit);
  }

  double highest_speed() const {
    if (scene_.rotation.empty() || scene_.rotation.front().options.empty()) return 0;
    const auto& rotation = scene_.rotation.front().options.as<scene::Rotation>();
    return rotation.engine_order > 0 ? highest_frequency() / rotation.engine_order : rotation.highest_speed;
  }

  // Of these loads, and its name among what is known of the matrices.
  std::pair<structure::Purpose, std::string> purpose(const std::vector<std::size_t>& loads) const {
    structure::Purpose purpose{highest_frequency(), highest_speed(), {}};
    std::string key = "reduced for " + std::to_string(purpose.highest) + " rad/s, " +
                      std::to_string(purpose.highest_speed) + " rad/s to ";
    for (const int row : rows_) key += std::to_string(row) + ' ';
    purpose.loads.resize(files_.size(), static_cast<Index>(loads.size()));
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const VectorXd& load = loads_[loads[k]].load;
      purpose.loads.col(static_cast<Index>(k)) = load;
      key += bytes("with ", load.data(), load.size());
    }
    if (is_closed_ring()) key += ring_key(*scene_.matrices);
    return {std::move(purpose), std::move(key)};
  }

  std::shared_ptr<const Reduced> reduced(double factor) const {
    std::vector<std::size_t> all(loads_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    auto [purpose_of, key] = purpose(all);
    if (factor != 1) key += bytes("of stiffness ", &factor, 1);
    return files_.derived->get<Reduced>(
        key, [&] { return structure::reduce(with_stiffness(files_, factor), rows_, purpose_of, stop_); });
  }

  // The loads that have the diameter of a wave.
  std::vector<std::size_t> loads_in(int diameter) const {
    std::vector<std::size_t> all;
    for (std::size_t s = 0; s < placed_.shapes.size(); ++s)
      if (wave_of(scene_.excitation[placed_.shapes[s].excitation].harmonic).diameter == diameter &&
          std::find(all.begin(), all.end(), load_of_[s]) == all.end())
        all.push_back(load_of_[s]);
    return all;
  }

  std::shared_ptr<const WaveStructure> wave(const Wave& in) const {
    const auto [purpose_of, key] = purpose(loads_in(in.diameter));
    if (!reduces_)
      return std::make_shared<const WaveStructure>(
          structure::whole_wave(files_, in, rows_, purpose_of.loads));
    return files_.derived->get<WaveStructure>(
        key + "in the wave " + std::to_string(in.diameter) + "/" + std::to_string(in.count),
        [&] { return structure::reduce_wave(files_, in, rows_, purpose_of, stop_); });
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
      for (Index k = kept_; k < all_[static_cast<std::size_t>(copy)].size; ++k)
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
    add(LinearKind::mass, {&Reduced::M, &WaveStructure::M});
    add(LinearKind::spring, {&Reduced::K, &WaveStructure::K}, !files_.unsymmetric_stiffness);
    add(LinearKind::damper, {&Reduced::C, &WaveStructure::C}, !files_.unsymmetric_damping);
    add_by_speed(LinearKind::spring, {&Reduced::K2, &WaveStructure::K2}, true);
    add_by_speed(LinearKind::damper, {&Reduced::G, &WaveStructure::G}, false);
    add_by_speed(LinearKind::circulatory, {&Reduced::N, &WaveStructure::N}, false);
  }

  struct Which {
    MatrixXd Reduced::*of_copy;
    MatrixXcd WaveStructure::*in_wave;
  };

  bool add(LinearKind kind, const Which& which, bool symmetric = true) {
    const bool is_there = in_waves() ? add_waves(kind, which.in_wave) : add_blocks(kind, which.of_copy);
    if (is_there) placed_.parts.back().symmetric = symmetric;
    return is_there;
  }

  // Coordinates that a wave has not are beside it, with a stiffness of their own.
  bool add_waves(LinearKind kind, MatrixXcd WaveStructure::*part) {
    const auto dofs = static_cast<Index>(placed_.dof_names.size());
    std::vector<MatrixXcd> of_diameter(waves_.size());
    for (std::size_t d = 0; d < waves_.size(); ++d) {
      if (!waves_[d]) continue;
      const MatrixXcd& block = (*waves_[d]).*part;
      if (block.size() == 0) return false;
      MatrixXcd& A = of_diameter[d];
      A.setZero(dofs, dofs);
      A.topLeftCorner(block.rows(), block.cols()) = block;
      if (part == &WaveStructure::K)
        A.diagonal().segment(block.rows(), all_.front().size - block.rows()).setOnes();
    }
    placed_.parts.push_back({kind, -1, std::make_shared<const MatrixXd>(of_diameter.front().real())});
    placed_.parts.back().waves =
        std::make_shared<const WaveMatrices>(scene_.cyclic->sectors, std::move(of_diameter));
    return true;
  }

  // A block for each copy.
  bool add_blocks(LinearKind kind, MatrixXd Reduced::*part) {
    if (((*all_.front().in).*part).size() == 0) return false;
    const auto dofs = static_cast<Index>(placed_.dof_names.size());
    MatrixXd A = MatrixXd::Zero(dofs, dofs);
    for (int copy = 0; copy < copies_; ++copy) {
      const MatrixXd& block = (*all_[static_cast<std::size_t>(copy)].in).*part;
      for (Index j = 0; j < block.cols(); ++j)
        for (Index i = 0; i < block.rows(); ++i) A(place_of(copy, i), place_of(copy, j)) = block(i, j);
    }
    placed_.parts.push_back({kind, -1, std::make_shared<const MatrixXd>(std::move(A))});
    return true;
  }

  // Of a rotor, value: speed or its square.
  void add_by_speed(LinearKind kind, const Which& which, bool squared) {
    if (!add(kind, which, squared)) return;
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

  // T^H f in the wave of its harmonic: complex, and of each excitation once.
  void place_shapes_in_waves() {
    const auto dofs = static_cast<Index>(placed_.dof_names.size());
    std::vector<PlacedShape> all;
    for (std::size_t i = 0; i < scene_.excitation.size(); ++i) {
      VectorXcd sum = VectorXcd::Zero(dofs);
      bool any = false;
      const Harmonic harmonic = wave_of(scene_.excitation[i].harmonic);
      const std::vector<std::size_t> known = loads_in(harmonic.diameter);
      for (std::size_t s = 0; s < placed_.shapes.size(); ++s) {
        if (placed_.shapes[s].excitation != i) continue;
        const auto k = std::find(known.begin(), known.end(), load_of_[s]) - known.begin();
        const MatrixXcd& loads = waves_[static_cast<std::size_t>(harmonic.diameter)]->loads;
        VectorXcd load = loads.col(k);
        if (harmonic.backwards) load = load.conjugate().eval();
        sum.head(load.size()) += (placed_.shapes[s].imaginary ? std::complex<double>(0, 1) : 1.0) * load;
        any = true;
      }
      if (!any) continue;
      all.push_back({i, false, sum.real(), {}});
      if (!sum.imag().isZero(0)) all.push_back({i, true, sum.imag(), {}});
    }
    placed_.shapes = std::move(all);
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
  std::vector<std::shared_ptr<const WaveStructure>> waves_;  // by nodal diameter; null: no harmonic has it
  PlacedMatrices placed_;
};

}  // namespace

PlacedMatrices place_matrices(const scene::Scene& scene, const scene::StopRequest& stop) {
  const scene::Matrices& sector = *scene.matrices;
  if (sector.faces.empty() || sector.copies == 1) return Placer(scene, sector, stop).place();
  const auto ring =
      sector.derived->get<scene::Matrices>(ring_key(sector), [&] { return structure::closed_ring(sector); });
  return Placer(scene, *ring, stop).place();
}

}  // namespace arcslip::model
