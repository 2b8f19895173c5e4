#pragma once
// Sparsity patterns, and whether factors of them cost less than those of dense matrices.

#include <arcslip/continuation/linear/sparse_algebra.hpp>

#include <vector>

namespace arcslip::hbm {

/// Which entries of an n x n matrix are not zero.
class SparsityPattern {
 public:
  using Matrix = continuation::ComplexSparseLU::Matrix;

  explicit SparsityPattern(Eigen::Index n) : n_(n), is_linked_(static_cast<std::size_t>(n * n), false) {}

  void link(Eigen::Index i, Eigen::Index j) { is_linked_[static_cast<std::size_t>(i + j * n_)] = true; }
  /// What a part does to its coordinates.
  void link_all(const std::vector<Eigen::Index>& coordinates) {
    for (const Eigen::Index j : coordinates)
      for (const Eigen::Index i : coordinates) link(i, j);
  }
  void link_diagonal() {
    for (Eigen::Index i = 0; i < n_; ++i) link(i, i);
  }
  /// In compressed form, with zeros.
  Matrix matrix() const;

 private:
  const Eigen::Index n_;
  std::vector<bool> is_linked_;
};

/// Where an entry stands in a compressed matrix that has it.
int position(const SparsityPattern::Matrix& in, Eigen::Index i, Eigen::Index j);

/// Whether factors by ComplexSparseLU cost less than those by Elimination (elimination.hpp).
bool sparse_is_cheaper(const SparsityPattern::Matrix& pattern);
/// The same next to LU of a dense matrix, which costs more.
bool sparse_is_cheaper_than_lu(const SparsityPattern::Matrix& pattern);

}  // namespace arcslip::hbm
