#pragma once
// (J - s M)^-1 for the eigenvalues mu of J v = mu M v next to the imaginary axis. Not installed.

#include <arcslip/continuation/linear/sparse_algebra.hpp>
#include <arcslip/continuation/problem/stability.hpp>

#include <Eigen/Core>

#include <complex>
#include <optional>

namespace arcslip::continuation {

class ShiftedInverse {
 public:
  using Scalar = double;  // as Spectra asks for it

  /// J, M: n x n; M null: 1.
  ShiftedInverse(const SparseMatrix& J, const SparseMatrix* M);

  Eigen::Index rows() const { return J_.rows(); }
  Eigen::Index cols() const { return J_.rows(); }

  /// Throws std::runtime_error where J - s M is singular.
  void set_shift(double real, double imaginary);
  /// x := (J - s M)^-1 M x.
  void apply(Eigen::MatrixXcd& x) const;
  /// Re((J - s M)^-1 M x).
  void perform_op(const double* in, double* out) const;

  /// |J v - mu M v|, relative to its terms.
  double residual(std::complex<double> mu, const Eigen::VectorXcd& v) const;
  /// mu or the Rayleigh quotient of v, whichever has the smaller residual; real to rounding: real.
  std::complex<double> better(std::complex<double> mu, const Eigen::VectorXcd& v) const;

 private:
  ComplexSparseLU::Matrix J_, M_, matrix_;
  std::optional<ComplexSparseLU> lu_;
};

/// An eigenvalue with Im >= 0 and its vector.
struct AxisEigenvalue {
  std::complex<double> value;
  Eigen::VectorXcd vector;
};

/// The eigenvalue next to the imaginary axis, on either side and at whatever frequency, by Lyapunov inverse
/// iteration. start: n, an approximate vector, or empty. Nothing where it does not converge, or J is
/// singular.
std::optional<AxisEigenvalue> nearest_to_axis(const SparseMatrix& J, const SparseMatrix* M,
                                              const StabilityOptions& options, const Eigen::VectorXcd& start);

}  // namespace arcslip::continuation
