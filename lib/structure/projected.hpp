#pragma once
// The matrices of a structure in the coordinates (b, z), where V^T A_ii V = 1 and A_bz = 0, A = K + sigma M,
// loads f, and what residuals say of the coordinates z.
//
// With the first coordinates z, x_i = Psi x_b + V z + e, the interior is left with Z_ii e = r. Of the next
// ones, U, r has the part r_U = U^T r; of r no more remains than l in the norm of A_ii^-1. The condensed
// stiffness is then wrong by r^T Z_ii^-1 r, which is at most
//
//   a (|r_U| + l)^2,   a = 1/min |1 - p m|,  0 <= m <= the largest theta,
//
// for any pair of rows, by Cauchy and Schwarz: the parts of several modes do not cancel in it. With a loss
// factor the minimum is that of the field of values of Z_ii, which damping does not make smaller. Where V
// holds all modes of low frequency and their residuals are small, a is estimated: the minimum is that over
// the theta of the vectors orthogonal to V, with a margin, or |S^-1| if that is more, S the Schur complement
// of Z_ii in U on the first coordinates.

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace arcslip::structure {

/// M, C, K2 or a skew-symmetric matrix, times a factor of the frequency and the speed.
struct PartOfZ {
  enum class Kind { mass, damping, stiffening, skew };
  Kind kind = Kind::mass;
  bool of_velocity = false, by_speed = false;  // of a skew-symmetric one: times s or not, the speed or not
  Eigen::MatrixXd c, zz, zb;                   // c: condensed statically onto b

  double sign() const { return kind == Kind::skew ? -1 : 1; }  // of its transpose
};

struct Projected {
  std::vector<PartOfZ> parts;  // the first is M
  Eigen::MatrixXd A_c, f_c, f_z;
  Eigen::VectorXd load_size;            // of each load: sqrt(f^T A^-1 f)
  std::vector<double> stiffening{0.0};  // A is A + each of them times K2
  double square = 1;                    // of the speed, where the stiffening is 0; 1 without a speed
  double sigma = 0, highest = 0;        // rad/s
  double shift = 0;  // A + shift M is positive definite where A alone need not be: the scale has twice this

  Eigen::Index coordinates() const { return parts.front().zz.rows(); }
  bool is_finite() const;
  /// The first coordinates alone.
  void keep(Eigen::Index count);
  /// Coordinates T^T z in their place.
  void turn(const Eigen::MatrixXd& T);
};

/// The largest size of the factor of a part up to the highest frequency and speed.
double largest_factor(const Projected& P, const PartOfZ& part);

/// Where the coordinates z get to: for one x_b or load in its scale they are y = E^(1/2) u, |u| at most
/// `length`, at some frequencies, and without damping at the poles between them. Empty where it is not known.
struct Envelope {
  Eigen::MatrixXd E;
  double length = 1;
};
Envelope envelope(const Projected& P);

/// The scale of x_b and of the loads, at its lowest: a row of Z over sqrt(A + p M) on the diagonal, a load
/// over load_size, or 0 for one that is nought.
Eigen::VectorXd inverse_scale(const Projected& P);

struct Remainder {
  double norm = 0;  // l
  /// The largest theta of the vectors orthogonal to the first ones, about; infinite where it is not known.
  double theta = 0;
};

struct ResidualBound {
  double error = 0;          // NaN where it is not known
  double amplification = 1;  // the largest a for what remains
};

/// The largest error of an entry of Z, or of the loads condensed with it, of the coordinates z before `first`
/// at frequencies up to the highest, and without damping at the poles between them, with a loss factor of 1
/// %: relative to the terms of its row and column on the diagonal, of a load to load_size. Errors above
/// `enough` are bounded with a in place of |S^-1|.
ResidualBound bound(const Projected& P, Eigen::Index first, const Remainder& left, double enough);

/// Without damping and K2: the modes Q of the coordinates z that matter. The others, which add no more than
/// `most` in the measure of bound() together, are left out.
struct StrongModes {
  Eigen::MatrixXd Q;
  double left_out = 0;
};
StrongModes strong_modes(const Projected& P, double most);

}  // namespace arcslip::structure
