#include <arcslip/structure/krylov_space.hpp>

#include <arcslip/structure/products.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr Index few = 48;          // columns, which are all solved for
constexpr Index first_many = 32;   // combinations of more
constexpr Index batch_growth = 3;  // of the combinations, next to those before
constexpr Index probes = 10;       // wrong with a probability of 1e-10
const double of_probes = 10 * std::sqrt(2 / std::numbers::pi);
constexpr Index iterated = 4;  // vectors
constexpr int iterations = 3;
constexpr double of_direction = 0.5;  // next to the limit: what a combination has to add

}  // namespace

// By Box and Muller.
MatrixXd normal_numbers(Index rows, Index columns, std::mt19937_64& random) {
  const auto uniform = [&] { return std::ldexp(static_cast<double>(random() >> 11) + 0.5, -53); };
  return MatrixXd::NullaryExpr(rows, columns, [&] {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  });
}

Index KrylovSources::count() const {
  const auto matrices = static_cast<Index>(matrices_.size());
  const Index of_first = first_.size() == 0 ? 0 : matrices_.front().R->cols() * matrices + loads_.cols();
  return of_first + matrices * vectors_.cols();
}

MatrixXd KrylovSources::combined(const MatrixXd& omega) const {
  MatrixXd X = MatrixXd::Zero(loads_.rows(), omega.cols());
  Index row = 0;
  const auto next = [&](Index count) { return omega.middleRows(std::exchange(row, row + count), count); };
  if (first_.size() > 0) {
    for (const MatrixOfSources& of : matrices_) {
      const Index b = of.R->cols();
      X += product(*of.R, MatrixXd((of.factor * first_.head(b)).asDiagonal() * next(b)));
    }
    if (loads_.cols() > 0)
      X += product(loads_, MatrixXd(first_.tail(loads_.cols()).asDiagonal() * next(loads_.cols())));
  }
  if (vectors_.cols() > 0)
    for (const MatrixOfSources& of : matrices_)
      X += *of.ii * MatrixXd(of.factor * product(vectors_, next(vectors_.cols())));
  return X;
}

MatrixXd KrylovSources::all() const {
  MatrixXd X(loads_.rows(), count());
  Index column = 0;
  const auto next = [&](const MatrixXd& columns) {
    X.middleCols(column, columns.cols()) = columns;
    column += columns.cols();
  };
  if (first_.size() > 0) {
    for (const MatrixOfSources& of : matrices_)
      next(*of.R * (of.factor * first_.head(of.R->cols())).asDiagonal());
    next(loads_ * first_.tail(loads_.cols()).asDiagonal());
  }
  if (vectors_.cols() > 0)
    for (const MatrixOfSources& of : matrices_) next(of.factor * (*of.ii * vectors_));
  return X;
}

double append_sources(EnergyBasis& basis, const InteriorFactor& A, const KrylovSources& X, double limit,
                      Index most, std::mt19937_64& random) {
  const Index count = X.count();
  for (Index sampled = 0, batch = first_many; count > few && sampled + batch < count / 2;
       sampled += std::exchange(batch, batch_growth * (sampled + batch))) {
    MatrixXd right = X.combined(normal_numbers(count, batch, random));
    MatrixXd W = A.solve(right);
    basis.append(std::move(W), std::move(right), of_direction * limit, most);
    right = X.combined(normal_numbers(count, probes, random));
    W = A.solve(right);
    basis.take_out(W, right);
    const double left =
        of_probes * std::sqrt((W.array() * right.array()).colwise().sum().max(0.0).maxCoeff());
    if (left <= limit || basis.size() >= most) return left;
  }
  MatrixXd right = X.all();
  MatrixXd W = A.solve(right);
  return basis.append(std::move(W), std::move(right), of_direction * limit, most);
}

double largest_theta_outside(const EnergyBasis& basis, const InteriorFactor& A, const Sparse& M,
                             std::mt19937_64& random) {
  MatrixXd X = M * normal_numbers(M.rows(), iterated, random);
  double theta = 0;
  for (int step = 0; step <= iterations; ++step) {
    MatrixXd W = A.solve(X);
    basis.take_out(W, X);
    const MatrixXd energy = W.transpose() * X, MW = M * W, mass = W.transpose() * MW;
    const VectorXd lengths = energy.diagonal().cwiseMax(0.0).cwiseSqrt();
    if (!lengths.allFinite()) return HUGE_VAL;
    if (lengths.minCoeff() == 0) return 0;
    theta = (mass.diagonal().array() / energy.diagonal().array()).maxCoeff();
    X = MW * lengths.cwiseInverse().asDiagonal();
  }
  return theta;
}

}  // namespace arcslip::structure
