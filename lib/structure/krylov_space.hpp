#pragma once
// The space of a reduction and what it grows by.
//
// What a space of the reduction grows by: A^-1 times the residuals R and f of x_b and of the loads, and A^-1
// times M, C, K2 and skew-symmetric matrices times its own vectors, each with a weight: its largest size for
// one x_b or load in the scale of the error. What the space lacks of them is then in the measure of the
// error.
//
// Of many columns X at once, the space takes A^-1 X Omega with random Omega, and is enough for all of them,
// but for `limit`, when it is for a few more of such combinations: N. Halko, P. G. Martinsson and J. A.
// Tropp, Finding structure with randomness, SIAM Rev. 53 (2011) 217, Lemma 4.1 and algorithm 4.2, in the norm
// of A.

#include <arcslip/structure/blocks.hpp>
#include <arcslip/structure/interior_factor.hpp>

#include <Eigen/Core>

#include <random>
#include <utility>
#include <vector>

namespace arcslip::structure {

/// Vectors V of the others, V^T A V = 1, and A V, A = K + sigma M. A V is kept: A times what is solved for is
/// the right-hand side itself, so that nothing cancels. Where the two drift apart, V is solved for anew.
class EnergyBasis {
 public:
  /// Without vectors, of so many rows. A stays with the caller.
  EnergyBasis(const InteriorFactor& A, Eigen::Index rows) : A_(A), V_(rows, 0), AV_(rows, 0) {}

  const Eigen::MatrixXd& V() const { return V_; }
  Eigen::Index size() const { return V_.cols(); }

  /// Takes out of W, A W = X, what V holds, in the norm of A. How far A W may then be from X, about.
  double take_out(Eigen::MatrixXd& W, Eigen::MatrixXd& X) const;
  /// Appends what W, A W = X, has next to V: its principal directions in the norm of A down to the singular
  /// value `cut`, at most as many as there is room for up to `most`. The norm of W without them.
  double append(Eigen::MatrixXd W, Eigen::MatrixXd X, double cut, Eigen::Index most);
  /// The first vectors alone.
  void keep(Eigen::Index count);
  /// Other vectors in their place, whose A V is not needed.
  void replace(Eigen::MatrixXd V);

 private:
  void add(Eigen::MatrixXd U, Eigen::MatrixXd AU, double drift);

  const InteriorFactor& A_;
  Eigen::MatrixXd V_, AV_;
  Eigen::VectorXd drift_;  // of A V from what is kept of it, which grows from vector to vector
};

/// One of the matrices: its columns for x_b, R, its block ii, and the largest size of its factor.
struct MatrixOfSources {
  const Eigen::MatrixXd* R;
  const Sparse* ii;
  double factor;
};

/// Columns X: of all x_b and loads, if first, and of vectors of the space.
class KrylovSources {
 public:
  KrylovSources(std::vector<MatrixOfSources> matrices, const Eigen::MatrixXd& loads)
      : matrices_(std::move(matrices)), loads_(loads) {}

  /// weights: of x_b and the loads. Of vectors there are none yet.
  void take_first(const Eigen::VectorXd& weights) { first_ = weights; }
  /// Vectors of the space times their weights.
  void take_vectors(Eigen::MatrixXd vectors) { vectors_ = std::move(vectors); }

  Eigen::Index count() const;
  /// X Omega
  Eigen::MatrixXd combined(const Eigen::MatrixXd& omega) const;
  Eigen::MatrixXd all() const;

 private:
  std::vector<MatrixOfSources> matrices_;
  const Eigen::MatrixXd& loads_;
  Eigen::VectorXd first_;
  Eigen::MatrixXd vectors_;
};

/// Appends to the basis what A^-1 X has next to it, down to `limit`. The norm of what it then lacks of them,
/// above limit where there are `most` vectors.
double append_sources(EnergyBasis& basis, const InteriorFactor& A, const KrylovSources& X, double limit,
                      Eigen::Index most, std::mt19937_64& random);

/// Normally distributed numbers, the same everywhere.
Eigen::MatrixXd normal_numbers(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& random);

/// The largest theta, A^-1 M x = theta x, of the vectors orthogonal to the basis, from a few steps of
/// subspace iteration.
double largest_theta_outside(const EnergyBasis& basis, const InteriorFactor& A, const Sparse& M,
                             std::mt19937_64& random);

}  // namespace arcslip::structure
