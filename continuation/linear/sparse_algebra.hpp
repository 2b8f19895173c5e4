#pragma once
// LU decomposition of a sparse complex matrix by KLU, compiled once, in one file.

#include <Eigen/Sparse>

#include <complex>
#include <memory>

namespace arcslip::continuation {

/// LU with partial pivoting of complex matrices of one pattern, P A Q = L U, where Q keeps U sparse.
class ComplexSparseLU {
 public:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  /// Chooses Q for n x n matrices of this sparsity pattern, in compressed form.
  explicit ComplexSparseLU(const Matrix& pattern);
  ~ComplexSparseLU();
  ComplexSparseLU(ComplexSparseLU&&) noexcept;
  ComplexSparseLU& operator=(ComplexSparseLU&&) noexcept;

  /// Expected number of multiplications of factorize(); n^3 / 3 for a dense matrix.
  double multiplications() const;

  /// A has the pattern. False if a pivot is at most `least` times the largest entry of its column of A, or if
  /// A^-1 shows what the pivots hide: where one is suspicious, and, with rows and columns scaled to a largest
  /// entry of 1, A^-1 b of a generic b with entries of size 1 has one of 1 / least.
  bool factorize(const Matrix& A, double least);

  /// B := A^-1 B and B := A^-T B, after a successful factorize().
  void solve_in_place(Eigen::MatrixXcd& B) const;
  void solve_transposed_in_place(Eigen::MatrixXcd& B) const;

 private:
  bool grows(double most) const;

  struct Decomposition;
  std::unique_ptr<Decomposition> lu_;
};

}  // namespace arcslip::continuation
