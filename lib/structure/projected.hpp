#pragma once
// M, C, K2 and A = K + sigma M in the coordinates (b, z), where V^T A_ii V = 1 and A_bz = 0, loads f, and
// skew-symmetric matrices.

#include <Eigen/Core>

#include <vector>

namespace arcslip::structure {

/// A skew-symmetric matrix next to them: times s or not, times the speed or not.
struct ProjectedSkew {
  bool of_velocity, by_speed;
  Eigen::MatrixXd c, zz, zb;  // as of C
};

struct Projected {
  Eigen::MatrixXd M_c, A_c, C_c, K2_c, f_c;  // condensed statically onto b; C_c, K2_c without C and K2 empty
  Eigen::MatrixXd M_zz, C_zz, K2_zz, M_zb, C_zb, K2_zb, f_z;
  Eigen::VectorXd load_size;  // of each load: sqrt(f^T A^-1 f)
  std::vector<ProjectedSkew> skew;
  std::vector<double> stiffening{0.0};  // A is A + each of them times K2
  double square = 1;                    // of the speed, where the stiffening is 0; 1 without a speed
};

/// The largest change of an entry of Z, or of the loads condensed with it, by the coordinates z after the
/// first ones, at frequencies up to the highest, rad/s, and without damping at the poles between them, with a
/// loss factor of 1 %: relative to the terms of its row and column on the diagonal, of a load to load_size.
/// NaN where it is not known.
double change(const Projected& P, double sigma, double highest, Eigen::Index first);

}  // namespace arcslip::structure
