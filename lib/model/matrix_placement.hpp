#pragma once
// The rows, loads and names of the matrices of a scene in its model, whatever they are reduced to: private to
// placed_matrices.hpp.

#include <arcslip/control/run_control.hpp>
#include <arcslip/model/placed_matrices.hpp>
#include <arcslip/structure/wave.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::model {

using structure::Reduced, structure::WaveStructure;

class Placer {
 public:
  /// files: the matrices of the scene, or where their copies share rows those of the closed ring.
  Placer(const scene::Scene& scene, const scene::Matrices& files, const control::Control& control);
  virtual ~Placer() = default;
  PlacedMatrices place();

 protected:
  using Index = Eigen::Index;

  /// A matrix of the structure, of a copy and in a wave.
  struct Which {
    Eigen::MatrixXd Reduced::*of_copy;
    Eigen::MatrixXcd WaveStructure::*in_wave;
  };
  /// Reduces the structure, with set_copies().
  virtual void make() = 0;
  /// Adds one of its matrices to placed_.parts; false if it has none.
  virtual bool add(LinearKind kind, const Which& which) = 0;
  /// The loads of placed_.shapes.
  virtual void place_shapes() = 0;

  /// How many rows and coordinates each copy has.
  void set_copies(const std::vector<Index>& sizes);
  void tell_error(Index size, double error, double free_below);
  /// To reduce the structure for these loads, and its name among what is known of the matrices.
  std::pair<structure::Purpose, std::string> purpose(const std::vector<std::size_t>& loads) const;
  /// In the model, of row or coordinate k of a copy.
  Index place_of(int copy, Index k) const;

  /// A column of a file as a load: itself, or M times it.
  struct Load {
    Eigen::VectorXd on_rows, load;
  };

  const scene::Scene& scene_;
  const scene::Matrices& files_;
  const bool reduces_;
  const int copies_;
  const control::Control& control_;
  Index kept_ = 0;
  std::vector<int> rows_;             // of the matrices: those kept, and of whole matrices all others
  std::vector<Load> loads_;           // different ones
  std::vector<std::size_t> load_of_;  // of each shape
  std::vector<int> copy_of_;          // the same
  PlacedMatrices placed_;

 private:
  struct Copy {
    Index size;   // rows and coordinates
    Index first;  // of its coordinates, behind the rows of all copies
  };

  bool is_closed_ring() const { return &files_ != &*scene_.matrices; }
  std::vector<bool> used_dofs() const;
  bool is_used(std::size_t name, const std::vector<bool>& used) const;
  void choose_rows();
  void check_size(Index dofs) const;
  void add_shapes();
  void name_dofs();
  void add_parts();
  void add_by_speed(LinearKind kind, const Which& which, bool squared);
  double highest_frequency() const;
  double highest_speed() const;

  std::vector<std::size_t> names_;  // that are kept, of the rows with names
  std::vector<int> kept_of_;        // the place of each row with a name among them; -1: none
  std::vector<Copy> all_;
};

/// A name of these numbers, among what is known of matrices.
std::string fingerprint(const char* what, const double* from, Eigen::Index count);
/// Of a closed ring among what is known of the matrices of its sector.
std::string ring_key(const scene::Matrices& sector);

/// Copies of one structure, reduced once for each factor of the stiffness, with a block for each copy.
class CopiesOfStructure final : public Placer {
 public:
  using Placer::Placer;

 private:
  void make() override;
  bool add(LinearKind kind, const Which& which) override;
  void place_shapes() override;
  std::shared_ptr<const Reduced> reduced(double factor) const;
  std::shared_ptr<const Reduced> whole(double factor) const;

  std::vector<std::shared_ptr<const Reduced>> in_;  // of each copy
};

/// One sector whose matrices reach into the next one, reduced for each nodal diameter of its harmonics.
class SectorInWaves final : public Placer {
 public:
  using Placer::Placer;

 private:
  void make() override;
  bool add(LinearKind kind, const Which& which) override;
  void place_shapes() override;

  /// The wave of a harmonic in the direction in which the waves are made; backwards: it travels the other way
  /// round.
  struct Harmonic {
    int diameter;
    bool backwards;
  };
  Harmonic wave_of(int n) const;
  std::vector<std::size_t> loads_in(int diameter) const;
  std::shared_ptr<const WaveStructure> wave(const structure::Wave& in) const;

  std::vector<std::shared_ptr<const WaveStructure>> waves_;  // by nodal diameter; null: no harmonic has it
};

}  // namespace arcslip::model
