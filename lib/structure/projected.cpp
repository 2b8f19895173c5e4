#include <arcslip/structure/projected.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::MatrixXcd, Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr int samples = 24;  // of the frequency
constexpr int samples_with_damping = 8;
constexpr double loss_factor = 0.01;

// Of the first coordinates z: in the eigenvectors of M_zz for Z_zz = 1 at p = 0, what b and the loads have
// there.
struct Modes {
  VectorXd theta;
  MatrixXd mu, kappa, f;

  // Z_xz Z_zz^-1 Z_zx with x = (b, loads), p = s^2 + sigma
  MatrixXcd interior(Complex p) const {
    MatrixXcd B(theta.size(), mu.cols() + f.cols());
    B << kappa.cast<Complex>() - p * mu, f.cast<Complex>();
    return B.transpose() * (1.0 - p * theta.array().cast<Complex>()).inverse().matrix().asDiagonal() * B;
  }
};

// K2 times the stiffening, or 0.
MatrixXd stiffened(const MatrixXd& K2, double by, Index rows, Index columns) {
  return K2.size() > 0 ? MatrixXd(by * K2.topLeftCorner(rows, columns)) : MatrixXd::Zero(rows, columns);
}

Modes modes(const Projected& P, double stiffening, Index count) {
  const Index b = P.M_zb.cols();
  const MatrixXd M = P.M_zz.topLeftCorner(count, count), kappa = stiffened(P.K2_zb, stiffening, count, b);
  Modes in{VectorXd(count), P.M_zb.topRows(count), kappa, P.f_z.topRows(count)};
  if (count == 0) return in;
  const auto found = P.K2_zz.size() == 0
                         ? continuation::symmetric_modes(M)
                         : continuation::symmetric_modes(M, MatrixXd::Identity(count, count) +
                                                                stiffened(P.K2_zz, stiffening, count, count));
  if (found.values.size() != count) {
    in.theta.setConstant(std::numeric_limits<double>::quiet_NaN());
    return in;
  }
  return {found.values, found.V.transpose() * in.mu, found.V.transpose() * kappa, found.V.transpose() * in.f};
}

// The same with C and skew-symmetric matrices.
MatrixXcd interior(const Projected& P, double stiffening, Index count, Complex p, Complex s) {
  const Index b = P.M_zb.cols(), all = b + P.f_z.cols();
  if (count == 0) return MatrixXcd::Zero(all, all);
  MatrixXcd Z_zz =
      (MatrixXd::Identity(count, count) + stiffened(P.K2_zz, stiffening, count, count)).cast<Complex>() -
      p * P.M_zz.topLeftCorner(count, count);
  MatrixXcd B(count, all);
  B << stiffened(P.K2_zb, stiffening, count, b) - p * P.M_zb.topRows(count),
      P.f_z.topRows(count).cast<Complex>();
  if (P.C_c.size() > 0) {
    Z_zz += s * P.C_zz.topLeftCorner(count, count);
    B.leftCols(b) += s * P.C_zb.topRows(count);
  }
  MatrixXcd B_left = B;
  const double speed = std::sqrt(std::max(P.square + stiffening, 0.0));
  for (const ProjectedSkew& skew : P.skew) {
    const Complex factor = (skew.of_velocity ? s : 1.0) * (skew.by_speed ? speed : 1.0);
    Z_zz += factor * skew.zz.topLeftCorner(count, count);
    B.leftCols(b) += factor * skew.zb.topRows(count);
    B_left.leftCols(b) -= factor * skew.zb.topRows(count);
  }
  return B_left.transpose() * continuation::solve_complex(Z_zz, B);
}

// With one stiffening.
double change_of_stiffened(const Projected& P, double stiffening, double sigma, double highest, Index first) {
  const bool damped = P.C_c.size() > 0 || !P.skew.empty();
  const Index all = P.M_zz.rows(), b = P.A_c.rows();
  const Modes before = modes(P, stiffening, damped ? 0 : first), now = modes(P, stiffening, damped ? 0 : all);
  std::vector<double> squares;  // omega^2
  const int steps = damped ? samples_with_damping : samples;
  for (int k = 0; k <= steps; ++k) squares.push_back(std::pow(highest * k / steps, 2));
  for (const double theta : now.theta)
    if (const double square = 1 / theta - sigma; theta > 0 && square > 0 && square < highest * highest)
      squares.push_back(square);
  VectorXd A = P.A_c.diagonal();
  if (P.K2_c.size() > 0) A += stiffening * P.K2_c.diagonal();
  double largest = 0;
  for (const double square : squares) {
    const Complex p = square * Complex(1, loss_factor) + sigma, s(0, std::sqrt(square));
    VectorXd scale(b + P.load_size.size());
    scale << (A.cwiseAbs() + std::abs(p) * P.M_c.diagonal().cwiseAbs()).cwiseSqrt(), P.load_size;
    const MatrixXcd added =
        damped ? MatrixXcd(interior(P, stiffening, all, p, s) - interior(P, stiffening, first, p, s))
               : MatrixXcd(now.interior(p) - before.interior(p));
    for (Index j = 0; j < added.cols(); ++j)
      for (Index i = 0; i < added.rows(); ++i) {
        const double size = std::abs(added(i, j));
        if (size == 0 || size <= largest * scale[i] * scale[j]) continue;
        largest = size / (scale[i] * scale[j]);
        if (std::isnan(largest)) return largest;
      }
  }
  return largest;
}

}  // namespace

double change(const Projected& P, double sigma, double highest, Index first) {
  double largest = 0;
  for (const double stiffening : P.stiffening) {
    const double found = change_of_stiffened(P, stiffening, sigma, highest, first);
    if (!(found <= largest)) largest = found;
    if (std::isnan(largest)) break;
  }
  return largest;
}

}  // namespace arcslip::structure
