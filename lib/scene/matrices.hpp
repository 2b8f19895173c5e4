#pragma once
// A structure from matrices in files: M x'' + C x' + K x of a finite-element model. Some rows have names, by
// which parts of the scene act on them. It is reduced to those that the scene uses and to modes of the
// others.
//
// Of a rotor, with the speed of a rotation (rotation.hpp): M x'' + (C + speed G) x' + (K + speed N + speed^2
// K2) x, G and N skew-symmetric; without a rotation G and N as they stand.
//
// The structure may stand several times side by side: M, C and K are then block-diagonal, one block for each
// copy, and each name stands for the same row of all copies, with the number of the copy at its end.
//
// A sector of a ring may have rows on both of its faces (FacePair): it is then linked to the next one by rows
// that both have, and its copies are the closed ring.

#include <arcslip/scene/bar.hpp>
#include <arcslip/scene/named_file.hpp>
#include <arcslip/scene/reduction.hpp>
#include <arcslip/scene/sparse_matrix.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::scene {

/// A file, or none, and the matrix in it: in Matrix Market format (scene/files/matrix_market.hpp), or of
/// MATLAB (scene/files/mat_file.hpp), where `variable` names it if the file holds several.
struct MatrixFile {
  NamedFile file{};
  std::shared_ptr<const SparseMatrix> matrix{};
  std::string variable{};
  friend bool operator==(const MatrixFile& a, const MatrixFile& b);
};

/// What has been computed from the matrices of a scene, kept for all copies of it: a reduction may take far
/// longer than a study with one set of values.
class Derived {
 public:
  static std::shared_ptr<Derived> none();

  template <class T, class Make>
  std::shared_ptr<const T> get(const std::string& key, const Make& make) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const void>& kept = all_[key];
    if (!kept) kept = std::make_shared<const T>(make());
    return std::static_pointer_cast<const T>(kept);
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const void>> all_;
};

/// Rows of a sector, from 0: what is the row `own` of the next sector is the row `beyond` of this one.
struct FacePair {
  int own, beyond;
  friend bool operator==(const FacePair&, const FacePair&) = default;
};

/// Of a reduction: the error of its dynamic stiffness up to a frequency, in the scene's unit.
struct ErrorOfReduction {
  double frequency, error;
  friend bool operator==(const ErrorOfReduction&, const ErrorOfReduction&) = default;
};

struct Matrices {
  MatrixFile mass{}, stiffness{}, damping{};  // kg, N/m, N s/m; damping without a path: none
  MatrixFile stiffness_speed_squared{};       // N/m s^2/rad^2: K2 of K + speed^2 K2; without a path: none
  MatrixFile gyroscopic{}, circulatory{};     // G and N; with a rotation per rad/s; without a path: none
  bool unsymmetric_stiffness = false, unsymmetric_damping = false;  // as the scene says
  NamedFile names{};
  std::vector<int> rows{};  // with names, from 0; in Scene::dofs each has all its copies
  NamedFile faces_file{};   // without a path: none
  std::vector<FacePair> faces{};
  int copies = 1;                           // of the structure, side by side: the sectors of a full ring
  std::vector<double> stiffness_factors{};  // of the stiffness matrix in each copy; empty: 1
  double highest_frequency = 0;  // of a harmonic, in the scene's unit: they are reduced; 0: they are not
  Reduction reduction{};
  std::vector<ErrorOfReduction> errors{};  // of matrices that a reduction made, up to rising frequencies
  std::optional<Bar> bar{};                // of which they are, in place of files
  std::shared_ptr<Derived> derived = Derived::none();

  /// Rows of one copy.
  int size() const { return stiffness.matrix ? stiffness.matrix->rows : 0; }
  /// How many of Scene::dofs, its first, are rows of the matrices.
  std::size_t named() const { return rows.size() * static_cast<std::size_t>(copies); }
  double stiffness_factor(int copy) const {
    return stiffness_factors.empty() ? 1 : stiffness_factors[static_cast<std::size_t>(copy)];
  }
  bool has_damping() const { return !damping.file.path.empty(); }
  /// Whether a speed changes it.
  bool turns() const { return stiffness_speed_squared.matrix || gyroscopic.matrix || circulatory.matrix; }
  friend bool operator==(const Matrices& a, const Matrices& b);
};

}  // namespace arcslip::scene
