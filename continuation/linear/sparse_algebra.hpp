#pragma once
// The decomposition of a sparse complex matrix, by KLU: compiled once, in one file, and not wherever it is
// used.

#include <Eigen/Sparse>

#include <complex>
#include <memory>

namespace arcslip::continuation {

/// LU with partial pivoting of complex matrices of one pattern, P A Q = L U, where Q keeps U sparse.
class ComplexSparseLU {
 public:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  /// Chooses Q for matrices n x n that are not zero in these places, in compressed form.
  explicit ComplexSparseLU(const Matrix& pattern);
  ~ComplexSparseLU();
  ComplexSparseLU(ComplexSparseLU&&) noexcept;
  ComplexSparseLU& operator=(ComplexSparseLU&&) noexcept;

  /// Multiplications of factorize(), as expected: a dense matrix takes n^3 / 3.
  double multiplications() const;

  /// A has the pattern. False: some pivot is no larger than `least` times the largest entry of its column of
  /// A.
  bool factorize(const Matrix& A, double least);

  /// B := A^-1 B, after a factorize() that was true.
  void solve_in_place(Eigen::MatrixXcd& B) const;

 private:
  struct Decomposition;
  std::unique_ptr<Decomposition> lu_;
};

}  // namespace arcslip::continuation
