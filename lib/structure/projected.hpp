#pragma once
// M, C, K2 and A = K + sigma M in the coordinates (b, z), where V^T A_ii V = 1 and A_bz = 0, and loads f.

#include <Eigen/Core>

#include <vector>

namespace arcslip::structure {

struct Projected {
  Eigen::MatrixXd M_c, A_c, C_c, K2_c, f_c;  // condensed statically onto b; C_c, K2_c without C and K2 empty
  Eigen::MatrixXd M_zz, C_zz, K2_zz, M_zb, C_zb, K2_zb, f_z;
  Eigen::VectorXd load_size;            // of each load: sqrt(f^T A^-1 f)
  std::vector<double> stiffening{0.0};  // A is A + each of them times K2
};

/// The largest change of an entry of Z, or of the loads condensed with it, by the coordinates z after the
/// first ones, at frequencies up to the highest, rad/s, and without damping at the poles between them, with a
/// loss factor of 1 %: relative to the terms of its row and column on the diagonal, of a load to load_size.
/// NaN where it is not known.
double change(const Projected& P, double sigma, double highest, Eigen::Index first);

}  // namespace arcslip::structure
