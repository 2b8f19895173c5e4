#pragma once
// Where branches leave a branch of periodic responses, and their first solutions.
//
// At a break of symmetry the even harmonics come in, at a period doubling the odd orders of half the base
// frequency: harmonics X that the motions of the branch lack. A solution u of the fewer harmonics is one of
// the more, with X = 0: the equations keep the symmetry of the motion, a shift in time, so that F_X(u, 0) = 0
// and
//
//   J = [ J_uu  0    ]
//       [ 0     J_XX ]
//
// along the branch. The branches cross where det J_XX = 0, a simple zero over the arclength where J_uu is
// regular, and phi, J_XX phi = 0, is the tangent of the branch that leaves. Its two halves are one motion and
// its image by that shift.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/hbm/problem.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

/// What the symmetry is that a motion loses: to be its own mirror image after half a period, or to repeat
/// after a period.
enum class BrokenSymmetry { mirror_image, period };

/// The harmonics of the motions that have lost it, up to the same frequency.
elements::Harmonics without(const elements::Harmonics& harmonics, BrokenSymmetry symmetry);

/// The same problem in other harmonics of the same excitation. about: as of HbmProblem.
std::shared_ptr<const hbm::HbmProblem> in_harmonics(const hbm::HbmProblem& problem,
                                                    const elements::Harmonics& harmonics, double about);

/// Whether a motion of a wider set has none of the harmonics that a narrower one lacks, to a part of 1e-6.
bool within(const hbm::HbmProblem& problem, const continuation::Vector& u, const elements::Harmonics& narrow);

/// A half-branch that leaves a branch point: x + h direction, to first order.
struct HalfBranch {
  std::shared_ptr<const hbm::HbmProblem> problem;
  continuation::Vector x;          // (u, omega)
  continuation::Vector direction;  // of 1 in scales
  double angle = 0;                // to the nearest other half-branch
};

/// A first solution on it.
struct Entry {
  continuation::Vector v, tangent;  // (u, omega), and its derivative by the arclength
  double step = 0;                  // from the branch point
};

/// The branch points of a branch at which it meets one of more harmonics.
class WiderBranchPoints {
 public:
  /// wide: in_harmonics() of `narrow`.
  WiderBranchPoints(std::shared_ptr<const hbm::HbmProblem> narrow,
                    std::shared_ptr<const hbm::HbmProblem> wide);

  /// The zero of det J_XX nearest to the step that follows point `after` of the branch, whose points (u,
  /// omega) these are; not one of those found before. Nothing: `why` is the end of a sentence.
  std::optional<HalfBranch> locate(const std::vector<continuation::Vector>& branch, std::size_t after,
                                   std::string& why);

 private:
  using Matrix = continuation::Matrix;
  using Vector = continuation::Vector;

  bool move_to(const Vector& v);
  int sign_at(const Vector& v);
  HalfBranch half_branch_along(const Vector& added) const;
  std::optional<HalfBranch> refine(const Vector& from, const Vector& to, std::string& why);

  std::shared_ptr<const hbm::HbmProblem> narrow_, wide_;
  std::unique_ptr<hbm::HbmEvaluator> at_;
  std::vector<int> added_;       // unknowns of the harmonics X
  Matrix J_;                     // J_XX
  continuation::LU<double> lu_;  // of it
  Vector p_, u_;
  std::vector<Vector> found_;
};

/// Of a half-branch, so close to the branch point that no other is meant. Nothing where there is none. with:
/// of its problem; its factors are those of the entry.
std::optional<Entry> enter(const HalfBranch& way, continuation::Corrector& with);

}  // namespace arcslip::observables
