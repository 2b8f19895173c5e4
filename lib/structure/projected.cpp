#include <arcslip/structure/projected.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

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

// Eigenvalues of M_zz, and M_zb in its eigenvectors.
struct Modes {
  VectorXd theta;
  MatrixXd mu;

  // Z_bz Z_zz^-1 Z_zb, p = s^2 + sigma
  MatrixXcd interior(Complex p) const {
    const Eigen::VectorXcd factors = p * p / (1.0 - p * theta.array().cast<Complex>());
    return mu.transpose() * factors.asDiagonal() * mu;
  }
};

Modes modes(const Projected& P, Index count) {
  if (count == 0) return {VectorXd(0), MatrixXd(0, P.M_zb.cols())};
  const auto found = continuation::symmetric_modes(P.M_zz.topLeftCorner(count, count));
  if (found.values.size() != count)
    return {VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN()), P.M_zb.topRows(count)};
  return {found.values, found.V.transpose() * P.M_zb.topRows(count)};
}

// The same with C.
MatrixXcd interior(const Projected& P, Index count, Complex p, Complex s) {
  if (count == 0) return MatrixXcd::Zero(P.M_zb.cols(), P.M_zb.cols());
  const MatrixXcd Z_zz = MatrixXd::Identity(count, count).cast<Complex>() -
                         p * P.M_zz.topLeftCorner(count, count) + s * P.C_zz.topLeftCorner(count, count),
                  Z_zb = -p * P.M_zb.topRows(count) + s * P.C_zb.topRows(count);
  return Z_zb.transpose() * continuation::solve_complex(Z_zz, Z_zb);
}

}  // namespace

double change(const Projected& P, double sigma, double highest, Index first) {
  const bool damped = P.C_c.size() > 0;
  const Index all = P.M_zz.rows();
  const Modes before = modes(P, damped ? 0 : first), now = modes(P, damped ? 0 : all);
  std::vector<double> squares;  // omega^2
  const int steps = damped ? samples_with_damping : samples;
  for (int k = 0; k <= steps; ++k) squares.push_back(std::pow(highest * k / steps, 2));
  for (const double theta : now.theta)
    if (const double square = 1 / theta - sigma; theta > 0 && square > 0 && square < highest * highest)
      squares.push_back(square);
  double largest = 0;
  for (const double square : squares) {
    const Complex p = square * Complex(1, loss_factor) + sigma, s(0, std::sqrt(square));
    const VectorXd scale =
        (P.A_c.diagonal().cwiseAbs() + std::abs(p) * P.M_c.diagonal().cwiseAbs()).cwiseSqrt();
    const MatrixXcd added = damped ? MatrixXcd(interior(P, all, p, s) - interior(P, first, p, s))
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

}  // namespace arcslip::structure
