// The methods of Craig and Bampton and of Rubin (reduction.hpp): V from modes.
#include <arcslip/structure/products.hpp>
#include <arcslip/structure/static_condensation.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr Index vectors_of_a_block = 16;
constexpr double new_direction = 1e-13;     // next to the largest theta: what a vector of a block has to add
constexpr double random_direction = 1e-10;  // next to the longest: the same of a random vector
constexpr double converged_to = 1e-8;       // of a residual, next to its theta
constexpr double independent = 1e-6;  // of a vector from modes, next to those before it, in the norm of A
constexpr double floating = 1e-8;     // the square of a natural frequency, next to the shift of statics

// Modes A v theta = M v, V^T A V = 1, from the largest theta on.
struct LargestModes {
  VectorXd theta;
  MatrixXd V;
};

// The modes of a positive definite A and a positive semidefinite M: `count` of them, or without a count (-1)
// those above `least` > 0; fewer where there are no more with mass. By Lanczos' method for blocks, with full
// orthogonalisation, until A^-1 M v - theta v is below converged_to theta in the norm of A (G. H. Golub and
// R. Underwood, The block Lanczos method for computing eigenvalues, Mathematical Software III, 1977).
class Lanczos {
 public:
  Lanczos(const InteriorFactor& A, const Sparse& M, Index count, double least)
      : A_(A), M_(M), count_(count), least_(least), space_(A, M.rows()) {}

  LargestModes run() {
    append_random();
    if (space_.size() == 0) return {VectorXd(0), MatrixXd(M_.rows(), 0)};
    std::optional<LargestModes> before;
    for (;;) {
      const Index old = space_.size();
      if (old > from_) {
        MatrixXd X = M_ * space_.V().rightCols(old - from_);
        MatrixXd W = A_.solve(X);
        from_ = old;
        append(std::move(W), std::move(X), new_direction * H_.diagonal().maxCoeff());
      }
      std::optional<LargestModes> found = converged(old);
      if (!found) continue;
      if (before && agree(*before, *found)) return *found;
      before = std::move(found);
      append_random();
      if (space_.size() == old) return *before;
    }
  }

 private:
  void append(MatrixXd W, MatrixXd X, double cut) {
    const Index old = space_.size();
    if (std::isnan(space_.append(std::move(W), std::move(X), cut, M_.rows()))) refuse_overflow();
    const Index count = space_.size(), added = count - old;
    H_.conservativeResize(count, count);
    if (added == 0) return;
    const MatrixXd columns = transposed_product(space_.V(), MatrixXd(M_ * space_.V().rightCols(added)));
    H_.rightCols(added) = columns;
    H_.bottomRows(added) = columns.transpose();
    H_.bottomRightCorner(added, added) =
        0.5 * (columns.bottomRows(added) + columns.bottomRows(added).transpose());
  }

  // Of more equal modes than a block has vectors the space so far may lack some.
  void append_random() {
    MatrixXd X = M_ * normal_numbers(M_.rows(), std::min(vectors_of_a_block, M_.rows()), random_);
    MatrixXd W = A_.solve(X);
    const double largest = (W.array() * X.array()).colwise().sum().maxCoeff();
    if (!std::isfinite(largest)) refuse_overflow();
    if (largest > 0) append(std::move(W), std::move(X), random_direction * std::sqrt(largest));
  }

  static bool agree(const LargestModes& a, const LargestModes& b) {
    return a.theta.size() == b.theta.size() &&
           ((a.theta - b.theta).array().abs() <= converged_to * b.theta.array()).all();
  }

  // The modes in the first vectors, of whose sources the others are.
  std::optional<LargestModes> converged(Index first) const {
    const continuation::SymmetricModes of = large_symmetric_modes(H_.topLeftCorner(first, first));
    if (of.values.size() < first) refuse_overflow();
    const bool is_all = space_.size() == first;
    const double least = count_ < 0 ? least_ : new_direction * of.values[first - 1];
    Index wanted = (of.values.array() >= least).count();
    if (count_ >= 0) wanted = std::min(wanted, count_);
    // Without all of them one more has to be there, which has come to rest as well, before one may be the
    // last.
    const Index looked_at = std::min(is_all ? wanted : wanted + 1, first);
    if (!is_all && (first < wanted + 1 || (count_ > wanted && count_ >= 0))) return {};
    const MatrixXd coupling =
        product(H_.bottomLeftCorner(space_.size() - first, first), of.V.rightCols(looked_at));
    for (Index j = 0; j < looked_at; ++j) {
      const double theta = of.values[first - looked_at + j];
      const bool is_next = j < looked_at - wanted;
      if (coupling.col(j).norm() > (is_next ? std::sqrt(converged_to) : converged_to) * std::abs(theta))
        return {};
    }
    return LargestModes{of.values.tail(wanted).reverse(),
                        product(space_.V().leftCols(first), of.V.rightCols(wanted).rowwise().reverse())};
  }

  const InteriorFactor& A_;
  const Sparse& M_;
  const Index count_;
  const double least_;
  EnergyBasis space_;
  Index from_ = 0;  // vectors whose sources the space has
  MatrixXd H_;      // M in its vectors
  std::mt19937_64 random_;
};

// Of the vectors W, A_ii W = X.
void take(StaticCondensation& of, MatrixXd W, MatrixXd X) {
  if (W.cols() == 0) return of.project_from(0);
  const VectorXd inverse = (W.array() * X.array())
                               .colwise()
                               .sum()
                               .max(0.0)
                               .sqrt()
                               .matrix()
                               .transpose()
                               .unaryExpr([](double length) { return length > 0 ? 1 / length : 0; });
  W = W * inverse.asDiagonal();
  X = X * inverse.asDiagonal();
  of.space().append(std::move(W), std::move(X), independent, of.others());
  of.project_from(0);
}

LargestModes largest_modes(const InteriorFactor& A, const Sparse& M, Index count, double least) {
  if (count == 0) return {VectorXd(0), MatrixXd(M.rows(), 0)};
  return Lanczos(A, M, count, least).run();
}

}  // namespace

void take_modes(StaticCondensation& of, const Purpose& purpose, const control::Control& control) {
  const Sparse& M_ii = of.operators().front().of.ii;
  const double shift = of.projected().shift;
  std::mt19937_64 random;
  if (largest_theta_outside(of.space(), of.factor(), M_ii, random) * floating * shift > 1) refuse_floating();
  if (purpose.method == scene::ReductionMethod::craig_bampton) {
    LargestModes modes =
        largest_modes(of.factor(), M_ii, purpose.modes, 1 / (purpose.cutoff * purpose.cutoff));
    MatrixXd AV = M_ii * modes.V * modes.theta.cwiseInverse().asDiagonal();
    return take(of, std::move(modes.V), std::move(AV));
  }
  const Sparse M = of.whole_mass();
  InteriorFactor whole(control);
  if (!whole.factorize(of.whole_stiffness(shift))) refuse_floating();
  const LargestModes free =
      largest_modes(whole, M, purpose.modes, 1 / (purpose.cutoff * purpose.cutoff + shift));
  MatrixXd X = MatrixXd(M * free.V).bottomRows(of.others());
  MatrixXd W = of.factor().solve(X);
  take(of, std::move(W), std::move(X));
}

}  // namespace arcslip::structure
