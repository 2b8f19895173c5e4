#include <arcslip/structure/krylov_space.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/structure/products.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double largest_drift = 1e-12;  // of A W from X, next to W
// Energies next to the largest one: above the first the principal directions are orthogonal to about 1e-10,
// below the second nothing is known of them.
constexpr double distinct = 1e-6, rounding_of_energies = 1e-13;

VectorXd energies(const MatrixXd& W, const MatrixXd& X) {
  return (W.array() * X.array()).colwise().sum().max(0.0).matrix().transpose();
}

}  // namespace

double EnergyBasis::take_out(MatrixXd& W, MatrixXd& X) const {
  if (W.cols() == 0) return 0;
  const double largest_before = std::sqrt(energies(W, X).maxCoeff());
  if (size() == 0) return eps * largest_before;
  double drift = eps * largest_before;
  const auto once = [&] {
    const MatrixXd shares = transposed_product(V_, X);
    subtract_product(W, V_, shares);
    subtract_product(X, AV_, shares);
    drift += (shares.cwiseAbs().transpose() * drift_).maxCoeff();
  };
  once();
  once();
  const double largest = std::sqrt(energies(W, X).maxCoeff());
  if (drift > largest_drift * largest) {
    W = A_.solve(X);
    drift = eps * largest;
    once();
    once();
  }
  return drift;
}

double EnergyBasis::append(MatrixXd W, MatrixXd X, double cut, Index most) {
  const double least = cut * cut;
  double left = 0;  // energy
  double drift = take_out(W, X);
  while (W.cols() > 0) {
    const MatrixXd G = transposed_product(W, X);
    const continuation::SymmetricModes modes = large_symmetric_modes(0.5 * (G + G.transpose()));
    if (modes.values.size() == 0) return std::numeric_limits<double>::quiet_NaN();
    const Index all = modes.values.size();
    const double largest = modes.values[all - 1], taken_above = std::max(least, distinct * largest);
    const auto above = [&](double energy) { return (modes.values.array() > energy).count(); };
    const Index room = std::max<Index>(most - size(), 0), taken = std::min(above(taken_above), room);
    const Index kept = least > rounding_of_energies * largest ? above(least) : all;
    const Index dropped = taken == 0 || taken < above(taken_above) ? all - taken : all - kept;
    if (dropped > 0) left += std::max(modes.values[dropped - 1], 0.0);
    if (taken == 0) break;
    const MatrixXd T =
        modes.V.rightCols(taken) * modes.values.tail(taken).cwiseSqrt().cwiseInverse().asDiagonal();
    const MatrixXd rest = modes.V.middleCols(dropped, all - taken - dropped);
    add(product(W, T), product(X, T), drift * T.colwise().norm().maxCoeff());
    X = product(X, rest);
    W = A_.solve(X);
    drift = take_out(W, X);
  }
  return std::sqrt(left);
}

// U^T A U is 1 but for rounding.
void EnergyBasis::add(MatrixXd U, MatrixXd AU, double drift) {
  drift = std::max(drift, take_out(U, AU));
  const MatrixXd G = transposed_product(U, AU);
  const continuation::SymmetricModes modes = large_symmetric_modes(0.5 * (G + G.transpose()));
  const MatrixXd T =
      modes.V * modes.values.cwiseSqrt().cwiseInverse().asDiagonal() * modes.V.transpose();  // G^-1/2
  const Index old = size(), count = U.cols();
  V_.conservativeResize(Eigen::NoChange, old + count);
  AV_.conservativeResize(Eigen::NoChange, old + count);
  drift_.conservativeResize(old + count);
  drift_.tail(count).setConstant(drift);
  V_.rightCols(count) = product(U, T);
  AV_.rightCols(count) = product(AU, T);
}

void EnergyBasis::keep(Index count) {
  V_.conservativeResize(Eigen::NoChange, count);
  AV_.conservativeResize(Eigen::NoChange, count);
  drift_.conservativeResize(count);
}

void EnergyBasis::replace(MatrixXd V) {
  V_ = std::move(V);
  AV_.resize(V_.rows(), 0);
}

}  // namespace arcslip::structure
