#pragma once
// The variations of a motion while the contacts of a structure change between linear modes. Private.
//
//   M w'' + C w' + (K + D T_S D^T) w + D f_z dz = 0          in the set S of modes, dz constant; time in s
//
// A set S is a phase. In the coordinates of its oscillators,
//
//   a_j'' + 2 gamma_j a_j' + Omega_j^2 a_j = b_j . dz,
//
// a time of any length takes a few operations for each oscillator, and the change to another phase one
// product of matrices. Phases are decomposed at the first motion that has them and kept: motions next to each
// other have the same ones. With symmetric stiffness and damping that is diagonal in its modes these are
// modes of displacement; otherwise invariant planes of (w, w'), of two real eigenvalues or a complex pair:
//
//   w, w' = sum_j P_1j a_j + P_2j a_j',     A P_2 = P_1 - 2 gamma P_2,  A P_1 = -Omega^2 P_2
//
// Where eigenvectors are nearly parallel, as at critical damping, the phase moves by power series instead
// (variational_integrator.hpp).
//
// C and K may be unsymmetric: the modes V are then those of M and of the symmetric part of K, and all are
// kept.
//
// Motions without inertia follow at once: those of degrees of freedom without mass, and natural modes above a
// limit. They leave a flexibility R between the contacts, so that the contacts move by
//
//   q = D^T w + R (-f),   f = T q + f_z dz:     q = (1 + R T)^-1 (Phi eta - R f_z dz)
//
// with the modes eta that are kept and Phi = D^T V.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/stability/variational_integrator.hpp>
#include <arcslip/time/equation/equation_of_motion.hpp>
#include <arcslip/time/equation/natural_modes.hpp>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace arcslip::time {

/// rad: of the fastest motion in a period. Beyond, nothing is left of its phase.
inline constexpr double fastest_turns = 1e12;

/// An automaton: where it acts, and its modes. memory: number of its dz; -1: none.
struct PhasePart {
  Matrix directions;  // dofs x directions
  std::vector<Matrix> stiffness;
  std::vector<Vector> by_memory;
  int memory;
  friend bool operator==(const PhasePart&, const PhasePart&) = default;
};

class LinearPhases {
 public:
  /// modes: of the equation; null: computed, which throws SingularMass.
  LinearPhases(const EquationOfMotion& equation, std::vector<PhasePart> parts, const ModesKept& kept,
               std::shared_ptr<const NaturalModes> modes = nullptr);

  std::shared_ptr<const NaturalModes> natural_modes() const { return free_; }

  const std::vector<PhasePart>& parts() const { return parts_; }
  /// The modes kept, n.
  Eigen::Index modes() const { return squares_.size(); }
  /// Starts in the modes `of` the parts: the columns of the identity in (a, a') of the phase, and one for
  /// each memory in `kept`.
  void begin(const std::vector<int>& of, const std::vector<int>& kept);
  /// A part changes its mode.
  void change(std::size_t part, int mode);
  /// False: the phase is too fast for a time of this length.
  bool move(double time);

  /// The variation along the directions of a part: a row for each start.
  Matrix along(std::size_t part) const;
  /// dz: a row for each start, a column for each memory. Changes count from the next move().
  Matrix& memory() { return Z_; }

  /// The map of the starts, back in the phase in which it began; scaled so that its rows and columns are
  /// energies.
  const Matrix& map();

 private:
  struct Oscillator {
    double gamma, square;
  };
  struct Phase;
  struct Way {
    std::vector<std::pair<int, int>> changes;
    const Phase* to;
    Matrix turn;  // of the coordinates, from the right; empty: none
  };
  struct Phase {
    std::vector<int> kinds;       // of the parts' modes, as kind_
    bool series = false;          // else oscillators
    bool planes = false;          // of (w, w'); else modes of w
    Matrix to_modes, from_modes;  // n x n, or 2 n x 2 n
    std::vector<Oscillator> oscillators;
    double fastest = 0;
    Matrix K;       // of the modes eta
    Matrix along;   // directions x n or 2 n, of the coordinates
    Matrix behind;  // directions x memories: what dz adds to it
    Matrix inputs;  // n or 2 n x memories
    mutable std::vector<Way> ways;
  };

  const Phase& phase_of(const std::vector<int>& kinds);
  Matrix turn(const Phase& from, const Phase& to) const;
  void turn_by(const Matrix& turn);
  void decompose(Phase& phase) const;
  bool find_planes(Phase& phase, const Matrix& U, const Vector& squares, const Matrix& damping) const;
  void enter();

  std::vector<PhasePart> parts_;
  std::vector<int> first_row_;          // of the parts' directions
  std::vector<std::vector<int>> kind_;  // of each mode: the first with the same stiffness
  Eigen::Index rows_ = 0, memories_ = 0;
  std::shared_ptr<const NaturalModes> free_;
  Vector squares_, natural_;             // of the modes kept; natural frequencies of all, rising
  Matrix damping_, contact_, residual_;  // of the modes kept; Phi; R, empty: 0
  Matrix circulatory_;                   // V^T N V of the skew part N of K; empty: none

  std::map<std::vector<int>, Phase> phases_;
  std::size_t numbers_ = 0;  // kept in them

  const Phase* now_ = nullptr;
  const Phase* first_ = nullptr;
  std::vector<int> kinds_, kept_;
  std::vector<std::pair<int, int>> pending_;
  Matrix X_, next_, Z_, driven_, map_;  // X_: starts x 2 n
  Matrix position_, velocity_;
  Variation variation_;
};

}  // namespace arcslip::time
