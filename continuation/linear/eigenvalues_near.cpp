#include <arcslip/continuation/linear/eigenvalues_near.hpp>

#include <arcslip/continuation/linear/sparse_algebra.hpp>

#include <Spectra/GenEigsComplexShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace arcslip::continuation {
namespace {

constexpr double real_to_rounding = 1e-9;  // imaginary part of a real eigenvalue, relative

// x -> Re((J - s M)^-1 M x), as Spectra asks for it.
class ShiftedInverse {
 public:
  using Scalar = double;

  ShiftedInverse(const SparseMatrix& J, const SparseMatrix* M)
      : J_(J.cast<std::complex<double>>()), M_(J.rows(), J.rows()) {
    if (M)
      M_ = M->cast<std::complex<double>>();
    else
      M_.setIdentity();
    matrix_ = J_ - std::complex<double>(1, 1) * M_;  // of the pattern of both
    matrix_.makeCompressed();
    lu_.emplace(matrix_);
  }

  Eigen::Index rows() const { return J_.rows(); }
  Eigen::Index cols() const { return J_.rows(); }

  void set_shift(double real, double imaginary) {
    matrix_ = J_ - std::complex<double>(real, imaginary) * M_;
    matrix_.makeCompressed();
    if (!lu_->factorize(matrix_, 0)) throw std::runtime_error("the shift is an eigenvalue");
  }

  void perform_op(const double* in, double* out) const {
    Eigen::MatrixXcd x = M_ * Eigen::Map<const Vector>(in, rows()).cast<std::complex<double>>();
    lu_->solve_in_place(x);
    Eigen::Map<Vector>(out, rows()) = x.col(0).real();
  }

  // |J v - mu M v|, relative to its terms.
  double residual(std::complex<double> mu, const Eigen::VectorXcd& v) const {
    const Eigen::VectorXcd Jv = J_ * v, Mv = M_ * v;
    return (Jv - mu * Mv).norm() / (Jv.norm() + std::abs(mu) * Mv.norm());
  }

  // nu is stationary at mu = -w, so that mu has half of its digits there: the Rayleigh quotient may have
  // more.
  std::complex<double> better(std::complex<double> mu, const Eigen::VectorXcd& v) const {
    const std::complex<double> quotient = v.dot(J_ * v) / v.dot(M_ * v);
    const std::complex<double> found = residual(quotient, v) < residual(mu, v) ? quotient : mu;
    return std::abs(found.imag()) < real_to_rounding * std::abs(found) ? found.real() : found;
  }

 private:
  ComplexSparseLU::Matrix J_, M_, matrix_;
  std::optional<ComplexSparseLU> lu_;
};

AxisRange range_of(double w, double least) {
  const double reach = 1 / least, middle = std::sqrt(reach * reach + 4 * w * w);
  return {std::max(0.0, (middle - reach) / 2), (middle + reach) / 2};
}

}  // namespace

NearEigenvalues eigenvalues_near(const SparseMatrix& J, const SparseMatrix* M, double w,
                                 const StabilityOptions& options, const Eigen::VectorXd& start) try {
  NearEigenvalues found;
  const Eigen::Index n = J.rows(), wanted = std::min<Eigen::Index>(options.near_shift, n - 2),
                     krylov = std::min<Eigen::Index>(options.krylov, n);
  ShiftedInverse inverse(J, M);
  Spectra::GenEigsComplexShiftSolver<ShiftedInverse> solver(inverse, wanted, krylov, 0, w);
  if (start.size() == n && start.norm() > 0)
    solver.init(start.data());
  else
    solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, options.restarts, options.tolerance);
  const Eigen::VectorXcd values = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  double least = std::numeric_limits<double>::infinity();
  found.start = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const std::complex<double> mu = inverse.better(values[i], vectors.col(i));
    if (!(inverse.residual(mu, vectors.col(i)) <= std::sqrt(options.tolerance))) continue;
    found.values.push_back(mu);
    found.start += vectors.col(i).real();
    least = std::min(least, std::abs(mu / (mu * mu + w * w)));
  }
  if (least > 0 && std::isfinite(least)) found.range = range_of(w, least);
  return found;
} catch (const std::exception&) {  // as it says
  return {};
}

}  // namespace arcslip::continuation
