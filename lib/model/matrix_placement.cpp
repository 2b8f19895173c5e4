#include <arcslip/model/matrix_placement.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/patch.hpp>
#include <arcslip/scene/rotation.hpp>
#include <arcslip/scene/shape.hpp>

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

namespace arcslip::model {

using Eigen::VectorXd;
namespace {

constexpr Eigen::Index most_of_copies = 2500;  // degrees of freedom together: matrices are dense

VectorXd product(const scene::SparseMatrix& A, const VectorXd& x) {
  VectorXd y = VectorXd::Zero(A.rows);
  for (int j = 0; j < A.columns; ++j)
    for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k)
      y[A.row_of[k]] += A.values[k] * x[j];
  return y;
}

}  // namespace

std::string fingerprint(const char* what, const double* from, Eigen::Index count) {
  const std::string_view all(reinterpret_cast<const char*>(from),
                             sizeof(double) * static_cast<std::size_t>(count));
  return what + std::to_string(std::hash<std::string_view>()(all)) + ' ';
}

namespace {

std::string key_of_reduction(const scene::Matrices& of, double cutoff) {
  const scene::Reduction& how = of.reduction;
  const double numbers[] = {of.highest_frequency, static_cast<double>(how.method), how.accuracy,
                            static_cast<double>(how.modes), cutoff};
  return fingerprint("by ", numbers, std::size(numbers));
}

}  // namespace

std::string ring_key(const scene::Matrices& sector) {
  const auto& factors = sector.stiffness_factors;
  return fingerprint(("the ring of " + std::to_string(sector.copies) + " with ").c_str(), factors.data(),
                     static_cast<Eigen::Index>(factors.size())) +
         key_of_reduction(sector, sector.reduction.cutoff);
}

Placer::Placer(const scene::Scene& scene, const scene::Matrices& files, const control::Control& control)
    : scene_(scene),
      files_(files),
      reduces_(files_.highest_frequency > 0),
      copies_(files_.copies),
      control_(control) {}

PlacedMatrices Placer::place() {
  choose_rows();
  add_shapes();
  make();
  name_dofs();
  add_parts();
  place_shapes();
  return std::move(placed_);
}

std::vector<bool> Placer::used_dofs() const {
  std::vector<bool> used(scene_.dofs.size(), false);
  const auto use = [&](const scene::Direction& direction) {
    for (const scene::Term& term : direction) used[static_cast<std::size_t>(term.dof)] = true;
  };
  const auto elements = scene::all_elements(scene_);
  for (const auto* parts : {&scene_.masses, &scene_.springs, &scene_.dampers, &scene_.excitation, &elements})
    for (const scene::Part& part : *parts)
      for (const scene::Direction& direction : part.directions) use(direction);
  for (const scene::Response& response : scene_.responses) {
    use(response.direction);
    for (const scene::Direction& other : response.others) use(other);
  }
  return used;
}

bool Placer::is_used(std::size_t name, const std::vector<bool>& used) const {
  const auto first = used.begin() + static_cast<std::ptrdiff_t>(name) * copies_;
  return std::find(first, first + copies_, true) != first + copies_;
}

void Placer::choose_rows() {
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

void Placer::check_size(Index dofs) const {
  if (copies_ == 1 || dofs <= most_of_copies) return;
  throw structure::ReductionError(
      std::to_string(copies_) + " copies have " + std::to_string(dofs) +
      " degrees of freedom together, must have at most " + std::to_string(most_of_copies) +
      ", since the matrices of the model are dense; lower \"highest_frequency\", let the scene use fewer "
      "rows, or give \"cyclic\" without \"full\" where all sectors are equal");
}

void Placer::add_shapes() {
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

void Placer::set_copies(const std::vector<Index>& sizes) {
  Index coordinates = 0;
  for (const Index size : sizes) {
    all_.push_back({size, coordinates});
    coordinates += size - kept_;
  }
  check_size(kept_ * copies_ + coordinates);
  placed_.unnamed_from = static_cast<int>(kept_ * copies_);
  placed_.unnamed_to = static_cast<int>(kept_ * copies_ + coordinates);
  if (!reduces_) return;
  Reduction& reported = placed_.reduction.emplace();
  reported.rows = files_.size();
  reported.kept = static_cast<int>(kept_);
  reported.highest_frequency = highest_frequency();
  reported.highest_speed = highest_speed();
}

void Placer::tell_error(Index size, double error, double free_below) {
  if (!placed_.reduction) return;
  Reduction& reported = *placed_.reduction;
  reported.coordinates = std::max(reported.coordinates, static_cast<int>(size - kept_));
  reported.error = std::max(reported.error, error);
  reported.free_below = std::max(reported.free_below, free_below);
}

double Placer::highest_frequency() const {
  return files_.highest_frequency * scene::to_rad_per_s(scene_.frequency_unit);
}

double Placer::highest_speed() const {
  if (scene_.rotation.empty() || scene_.rotation.front().options.empty()) return 0;
  const auto& rotation = scene_.rotation.front().options.as<scene::Rotation>();
  return rotation.engine_order > 0 ? highest_frequency() / rotation.engine_order : rotation.highest_speed;
}

std::pair<structure::Purpose, std::string> Placer::purpose(const std::vector<std::size_t>& loads) const {
  structure::Purpose purpose{highest_frequency(), highest_speed(), {}};
  const scene::Reduction& how = files_.reduction;
  purpose.accuracy = how.accuracy;
  purpose.method = how.method;
  purpose.modes = how.modes;
  purpose.cutoff = how.cutoff > 0 ? how.cutoff * scene::to_rad_per_s(scene_.frequency_unit)
                                  : scene::cutoff_of_highest * purpose.highest;
  std::string key = "reduced for " + std::to_string(purpose.highest) + " rad/s, " +
                    std::to_string(purpose.highest_speed) + " rad/s to ";
  key += key_of_reduction(files_, purpose.cutoff);
  for (const int row : rows_) key += std::to_string(row) + ' ';
  purpose.loads.resize(files_.size(), static_cast<Index>(loads.size()));
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const VectorXd& load = loads_[loads[k]].load;
    purpose.loads.col(static_cast<Index>(k)) = load;
    key += fingerprint("with ", load.data(), load.size());
  }
  if (is_closed_ring()) key += ring_key(*scene_.matrices);
  return {std::move(purpose), std::move(key)};
}

Placer::Index Placer::place_of(int copy, Index k) const {
  return k < kept_ ? copy * kept_ + k
                   : copies_ * kept_ + all_[static_cast<std::size_t>(copy)].first + k - kept_;
}

void Placer::name_dofs() {
  const auto named = static_cast<std::ptrdiff_t>(files_.named());
  std::vector<std::string>& names = placed_.dof_names;
  for (int copy = 0; copy < copies_; ++copy)
    for (const std::size_t name : names_)
      names.push_back(scene_.dofs[name * static_cast<std::size_t>(copies_) + static_cast<std::size_t>(copy)]);
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

void Placer::add_parts() {
  const auto add_as = [this](LinearKind kind, const Which& which, bool symmetric) {
    if (add(kind, which)) placed_.parts.back().symmetric = symmetric;
  };
  add_as(LinearKind::mass, {&Reduced::M, &WaveStructure::M}, true);
  add_as(LinearKind::spring, {&Reduced::K, &WaveStructure::K}, !files_.unsymmetric_stiffness);
  add_as(LinearKind::damper, {&Reduced::C, &WaveStructure::C}, !files_.unsymmetric_damping);
  add_by_speed(LinearKind::spring, {&Reduced::K2, &WaveStructure::K2}, true);
  add_by_speed(LinearKind::damper, {&Reduced::G, &WaveStructure::G}, false);
  add_by_speed(LinearKind::circulatory, {&Reduced::N, &WaveStructure::N}, false);
}

// Of a rotor, value: speed, of skew matrices, or its square.
void Placer::add_by_speed(LinearKind kind, const Which& which, bool squared) {
  if (!add(kind, which)) return;
  placed_.parts.back().symmetric = squared;
  placed_.parts.back().squared = squared;
  placed_.by_speed.push_back(placed_.parts.size() - 1);
}

}  // namespace arcslip::model
