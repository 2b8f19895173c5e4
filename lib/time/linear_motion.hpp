#pragma once
// The motion of a linear structure under harmonic forces as a power series in time, exact to rounding:
//
//   M x'' + C x' + (K + sum_stuck k_d d d^T) x = f(t) + sum_e d_e g_e,   x(t + s h) = sum_k X_k s^k, 0 <= s
//   <= 1 X_(k+1) = h V_k/(k+1),   V_(k+1) = h M^-1 (f_k + [k = 0] sum d g - C V_k - K' X_k)/(k+1)
//
// h rho <= 1 with rho = max(Omega + gamma, n omega): Omega^2 and gamma are the largest eigenvalues of K' and
// C over M, n omega the fastest force. In the energy norm the terms fall at least like 1/k!, so that `order`
// of them leave less than 1e-18 of the motion, whether it is damped, undamped, free of springs or in
// resonance: there is neither a particular solution nor a matrix exponential.
//
// Several columns run together: the first is the motion, the others, without the force, its variations.

#include <arcslip/continuation/dense_algebra.hpp>
#include <arcslip/time/equation_of_motion.hpp>

#include <array>
#include <vector>

namespace arcslip::time {

class LinearMotion {
 public:
  static constexpr int order = 20;
  using Series = std::array<double, order + 1>;

  /// Throws SingularMass, with the degree of freedom.
  explicit LinearMotion(const EquationOfMotion& equation);

  /// Longest h, s; infinite where nothing changes.
  double longest() const { return longest_; }

  /// Whether element e is stuck, its spring k_d part of the structure.
  void set_stuck(std::size_t e, bool stuck);

  /// The series from t over h <= longest(). X, V: dofs x columns; g: elements x columns, N.
  void expand(double t, double h, const Matrix& X, const Matrix& V, const Matrix& g);

  /// X and V at s.
  void at(double s, Matrix& X, Matrix& V) const;
  /// d . x in all columns at s.
  Eigen::RowVectorXd along(const Vector& d, double s) const;

  /// Series of d . x, m, and of d . x', m/s, of the motion. Returns sum_k |d| . |X_k|, the measure of its
  /// rounding.
  double displacement(const Vector& d, Series& c) const;
  double velocity(const Vector& d, Series& c) const;

  /// Work of the force, integral of f . x' dt, and of the dampers, integral of x' . C x' dt, from 0 to s; J.
  struct Work {
    double input = 0, viscous = 0;
  };
  Work work(double s) const;

 private:
  void expand_force(double t, double h);

  const EquationOfMotion& equation_;
  continuation::Cholesky mass_;
  Matrix stiffness_, damping_;     // M^-1 K', M^-1 C
  std::vector<Vector> over_mass_;  // M^-1 d of each element
  std::vector<char> stuck_;
  double longest_ = 0, h_ = 0;
  std::vector<Matrix> X_, V_;    // order + 1
  Matrix force_, acceleration_;  // dofs x (order + 1): f_k, M^-1 f_k
  Matrix hilbert_;               // 1/(i + j + 1)
};

}  // namespace arcslip::time
