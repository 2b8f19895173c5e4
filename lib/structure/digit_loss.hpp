#pragma once
// What the last digits of the entries of M and K leave of the lowest natural frequency.
//
// Each entry is rounded, so that x^T K x of a mode is known to eps |x|^T (|K| + sigma |M|) |x| only, four
// times which is taken. Where large entries cancel, as in fine meshes and next to very stiff links, that is a
// considerable share of x^T K x = omega^2 x^T M x.

#include <arcslip/structure/blocks.hpp>

#include <functional>

namespace arcslip::structure {

struct Rounding {
  /// Of the square of the lowest natural frequency above free_below, relative to it; or more: of those below,
  /// relative to sigma. NaN where it is not known.
  double change = 0;
  /// The same next to x^T (K + sigma M) x, as errors of a reduction are measured.
  double of_stiffness = 0;
  /// Natural frequencies below this, rad/s, are not distinguished from 0: rigid-body motions. 0: there are
  /// none.
  double free_below = 0;
};

/// mode(0), mode(1), ...: the modes in (b, i) from the lowest natural frequency, x^T (K + sigma M) x = 1.
/// accuracy: to which x^T K x of them is known.
Rounding rounding(const scene::Matrices& matrices, const Partition& parts, double sigma, double accuracy,
                  Eigen::Index modes, const std::function<Eigen::VectorXd(Eigen::Index)>& mode);

}  // namespace arcslip::structure
