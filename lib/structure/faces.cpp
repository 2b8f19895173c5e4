#include <arcslip/structure/faces.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>

namespace arcslip::structure {
namespace {

class Ring {
 public:
  explicit Ring(const scene::Matrices& sector) : sector_(sector), rows_(shared_rows(sector)) {}

  int size() const { return rows_.count * sector_.copies; }
  int place(int copy, int row) const {
    const auto at = static_cast<std::size_t>(row);
    return (rows_.beyond[at] ? copy + 1 : copy) % sector_.copies * rows_.count + rows_.place[at];
  }
  bool is_beyond(int row) const { return rows_.beyond[static_cast<std::size_t>(row)]; }

  template <class Factor>
  void close(scene::MatrixFile& file, const Factor& factor) const {
    if (!file.matrix) return;
    const scene::SparseMatrix& A = *file.matrix;
    std::vector<scene::MatrixEntry> entries;
    entries.reserve(A.entries() * static_cast<std::size_t>(sector_.copies));
    for (int copy = 0; copy < sector_.copies; ++copy)
      for (int j = 0; j < A.columns; ++j)
        for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
             k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k)
          entries.push_back({place(copy, A.row_of[k]), place(copy, j), factor(copy) * A.values[k]});
    file.matrix = std::make_shared<const scene::SparseMatrix>(scene::sparse_matrix(size(), size(), entries));
  }

 private:
  const scene::Matrices& sector_;
  const SharedRows rows_;
};

}  // namespace

SharedRows shared_rows(const scene::Matrices& sector) {
  SharedRows rows;
  const auto size = static_cast<std::size_t>(sector.size());
  rows.place.assign(size, 0);
  rows.beyond.assign(size, false);
  for (const scene::FacePair& pair : sector.faces) rows.beyond[static_cast<std::size_t>(pair.beyond)] = true;
  for (std::size_t row = 0; row < size; ++row)
    if (!rows.beyond[row]) rows.place[row] = rows.count++;
  for (const scene::FacePair& pair : sector.faces)
    rows.place[static_cast<std::size_t>(pair.beyond)] = rows.place[static_cast<std::size_t>(pair.own)];
  return rows;
}

scene::Matrices closed_ring(const scene::Matrices& sector) {
  const Ring ring(sector);
  scene::Matrices whole = sector;
  const auto equal = [](int) { return 1.0; };
  ring.close(whole.stiffness, [&](int copy) { return sector.stiffness_factor(copy); });
  for (scene::MatrixFile* file :
       {&whole.mass, &whole.damping, &whole.stiffness_speed_squared, &whole.gyroscopic, &whole.circulatory})
    ring.close(*file, equal);
  whole.rows.clear();
  for (const int row : sector.rows)
    for (int copy = 0; copy < sector.copies; ++copy) whole.rows.push_back(ring.place(copy, row));
  whole.copies = 1;
  whole.stiffness_factors.clear();
  whole.faces.clear();
  whole.derived = scene::Derived::none();  // what is derived from the sector may hold the ring itself
  return whole;
}

Eigen::VectorXd forces_on_ring(const scene::Matrices& sector, int copy, const Eigen::VectorXd& on_rows) {
  const Ring ring(sector);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(ring.size());
  for (int row = 0; row < sector.size(); ++row) forces[ring.place(copy, row)] += on_rows[row];
  return forces;
}

Eigen::VectorXd displacements_on_ring(const scene::Matrices& sector, int copy,
                                      const Eigen::VectorXd& on_rows) {
  const Ring ring(sector);
  Eigen::VectorXd displacements = Eigen::VectorXd::Zero(ring.size());
  for (int row = 0; row < sector.size(); ++row)
    if (!ring.is_beyond(row)) displacements[ring.place(copy, row)] = on_rows[row];
  return displacements;
}

std::complex<double> Wave::turn() const {
  if (4 * diameter == count) return {0, -1};
  if (2 * diameter == count) return -1;
  return std::polar(1.0, -2 * std::numbers::pi * diameter / count);
}

}  // namespace arcslip::structure
