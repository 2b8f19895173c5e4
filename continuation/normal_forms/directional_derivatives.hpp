#pragma once
// Derivatives of F of second and third order along directions of (u, p), for coefficients of normal forms.
// Not installed.
//
//   D^k F d^k = d^k / ds^k F(x + s d) at s = 0,   x = (u, p_free)
//
// is what the problem provides (Evaluator::directional_derivative), or else the derivative of order k - 1 of
// J d + F_p d_p, or else that of order k of F, from central quotients of second order
//
//   k = 1   (g(h) - g(-h)) / 2h
//   k = 2   (g(h) - 2 g(0) + g(-h)) / h^2
//   k = 3   (g(2h) - 2 g(h) + 2 g(-h) - g(-2h)) / 2h^3
//
// extrapolated to h = 0 (problem/extrapolation.hpp), which makes them of fourth order at least. A direction
// is scaled so that no unknown changes by more than its size, |u_i| or its scale; the first h is a 32nd of
// it. All places lie in the smooth piece of x. Forms of several directions follow by polarization,
//
//    4 D^2 a b   = D^2 (a + b)^2 - D^2 (a - b)^2
//   24 D^3 a b c = D^3 (a + b + c)^3 - D^3 (a + b - c)^3 - D^3 (a - b + c)^3 + D^3 (a - b - c)^3.

#include <arcslip/continuation/problem/extrapolation.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <complex>
#include <cstdint>
#include <optional>

namespace arcslip::continuation {

/// A place of a problem, at which its free parameter is free.
struct PlaceOfForms {
  Vector u, p;    // n, all parameters
  int free = 0;   // index of the free one
  Vector scales;  // of (u, p_free), n + 1
};

/// A form and its estimated error, row by row; not finite where it is not known.
struct RealForm {
  Vector value, error;
};
struct ComplexForm {
  Eigen::VectorXcd value;
  Vector error;
};

class DirectionalDerivatives {
 public:
  /// The evaluator is moved, and belongs to the caller again after each call, at no particular place.
  DirectionalDerivatives(Evaluator& at, PlaceOfForms place);

  /// False: F or J cannot be evaluated at the place.
  bool usable() const { return usable_; }

  /// Directions: n + 1, of (u, p_free). Those of C^(n+1) are multiplied out.
  RealForm along(int order, const Vector& d);
  RealForm second(const Vector& a, const Vector& b);
  RealForm third(const Vector& a, const Vector& b, const Vector& c);
  ComplexForm second(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b);
  ComplexForm third(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b, const Eigen::VectorXcd& c);

  /// J at the place: the problem's, or, where that consists of differences, extrapolated ones. Nothing for an
  /// operator.
  std::optional<Jacobian> jacobian();
  /// Of the entries of the last one, beyond rounding: what the extrapolation estimates; empty: none.
  const Matrix& errors_of_jacobian() const { return errors_of_jacobian_; }
  /// F_p of the free parameter, the same way.
  RealForm parameter_derivative();

 private:
  ComplexForm cube_of_size(const Vector& x, const Vector& y);
  double size_of(const Vector& d) const;
  bool given(int order, const Vector& d, RealForm& form);
  bool value_at(double distance, const Vector& d, bool of_jacobian, Vector& g);
  std::optional<ExtrapolatedDifference> difference(int order, const Vector& d, bool of_jacobian);

  Evaluator& at_;
  PlaceOfForms place_;
  Eigen::Index n_;
  std::uint64_t piece_ = 0;
  bool usable_ = false;
  Matrix errors_of_jacobian_;
  Vector sizes_, u_, p_, dF_;
};

}  // namespace arcslip::continuation
