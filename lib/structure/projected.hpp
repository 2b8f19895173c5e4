#pragma once
// M, C and A = K + sigma M in the coordinates (b, z), where V^T A_ii V = 1 and A_bz = 0.

#include <Eigen/Core>

namespace arcslip::structure {

struct Projected {
  Eigen::MatrixXd M_c, A_c, C_c;  // condensed statically onto b; without damping C_c is empty
  Eigen::MatrixXd M_zz, C_zz, M_zb, C_zb;
};

/// The largest change of an entry of Z by the coordinates z after the first ones, at frequencies up to the
/// highest, rad/s, and without damping at the poles between them, with a loss factor of 1 %: relative to the
/// terms of its row and column on the diagonal. NaN where it is not known.
double change(const Projected& P, double sigma, double highest, Eigen::Index first);

}  // namespace arcslip::structure
