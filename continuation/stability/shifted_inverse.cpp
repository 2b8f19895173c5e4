#include <arcslip/continuation/stability/shifted_inverse.hpp>

#include <cmath>
#include <stdexcept>

namespace arcslip::continuation {
namespace {

constexpr double real_to_rounding = 1e-9;  // imaginary part of a real eigenvalue, relative

}  // namespace

ShiftedInverse::ShiftedInverse(const SparseMatrix& J, const SparseMatrix* M)
    : J_(J.cast<std::complex<double>>()), M_(J.rows(), J.rows()) {
  if (M)
    M_ = M->cast<std::complex<double>>();
  else
    M_.setIdentity();
  matrix_ = J_ - std::complex<double>(1, 1) * M_;  // of the pattern of both
  matrix_.makeCompressed();
  lu_.emplace(matrix_);
}

void ShiftedInverse::set_shift(double real, double imaginary) {
  matrix_ = J_ - std::complex<double>(real, imaginary) * M_;
  matrix_.makeCompressed();
  if (!lu_->factorize(matrix_, 0)) throw std::runtime_error("the shift is an eigenvalue");
}

void ShiftedInverse::apply(Eigen::MatrixXcd& x) const {
  x = (M_ * x).eval();
  lu_->solve_in_place(x);
}

void ShiftedInverse::perform_op(const double* in, double* out) const {
  Eigen::MatrixXcd x = Eigen::Map<const Vector>(in, rows()).cast<std::complex<double>>();
  apply(x);
  Eigen::Map<Vector>(out, rows()) = x.col(0).real();
}

double ShiftedInverse::residual(std::complex<double> mu, const Eigen::VectorXcd& v) const {
  const Eigen::VectorXcd Jv = J_ * v, Mv = M_ * v;
  return (Jv - mu * Mv).norm() / (Jv.norm() + std::abs(mu) * Mv.norm());
}

std::complex<double> ShiftedInverse::better(std::complex<double> mu, const Eigen::VectorXcd& v) const {
  const std::complex<double> quotient = v.dot(J_ * v) / v.dot(M_ * v);
  const std::complex<double> found = residual(quotient, v) < residual(mu, v) ? quotient : mu;
  return std::abs(found.imag()) < real_to_rounding * std::abs(found) ? found.real() : found;
}

}  // namespace arcslip::continuation
