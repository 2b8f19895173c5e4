#pragma once
// The motion of a linear structure under harmonic forces as a power series in time, exact to rounding:
//
//   M x'' + C x' + (K + sum_e D_e T_e D_e^T) x = f(t) + sum_e D_e g_e,   x(t + s h) = sum_k X_k s^k
//   X_(k+1) = h V_k/(k+1),   V_(k+1) = h M^-1 (f_k + [k = 0] sum D g - C V_k - K' X_k)/(k+1),   0 <= s <= 1
//
// T_e: the stiffness of the modes that the elements are in. h rho <= 1 with rho = max(Omega + gamma, n
// omega): Omega^2 and gamma are the largest |eigenvalues| of K' and C over M in any modes, or bounds of their
// norms where these are not symmetric, n omega the fastest force; the norms of the skew parts of T_e add to
// Omega^2. In the energy norm the terms fall at least like 1/k!, so that `order` of them leave less than
// 1e-18 of the motion, whether it is damped, undamped, free of springs or in resonance: there is neither a
// particular solution nor a matrix exponential.
//
// Several columns run together: the first is the motion, the others, without the force, its variations. The
// last one may be that with a parameter, at a fixed t, which the motion itself drives
// (time/equation/parameter_derivatives.hpp).

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/time/equation/parameter_derivatives.hpp>

#include <array>
#include <optional>
#include <vector>

namespace arcslip::time {

class LinearMotion {
 public:
  static constexpr int order = 20;
  using Series = std::array<double, order + 1>;

  /// One automaton: where it acts, and the stiffnesses that its modes have.
  struct Part {
    Matrix directions;  // dofs x directions
    std::vector<Matrix> stiffnesses;
  };

  /// Throws SingularMass, with the degree of freedom. control: asked before each decomposition that takes
  /// long; if it has ended, stopped() is true, and there is no motion.
  LinearMotion(const EquationOfMotion& equation, std::vector<Part> parts,
               const control::Control& control = {});

  bool stopped() const { return stopped_; }

  /// Longest h, s; infinite where nothing changes.
  double longest() const { return longest_; }

  /// From now on the last column is the variation with a parameter; null: it is as the others. The rates must
  /// outlive its use.
  void vary(const EquationRates* rates);

  /// The stiffness of automaton a in its mode, part of the structure, and its derivative by that parameter;
  /// null: 0.
  void set_stiffness(std::size_t a, const Matrix& stiffness, const Matrix* rate = nullptr);

  /// The series from t over h <= longest(). X, V: dofs x columns; g: a row for each direction of each
  /// automaton, N. control: asked before each term where one takes long; if it has ended, the result is
  /// false, and there is no series.
  bool expand(double t, double h, const Matrix& X, const Matrix& V, const Matrix& g,
              const control::Control& control = {});

  /// X and V at s.
  void at(double s, Matrix& X, Matrix& V) const;
  /// x'' of the motion at s.
  Vector acceleration(double s) const;
  /// d . x in all columns at s.
  Eigen::RowVectorXd along(const Vector& d, double s) const;

  /// Series of d . x, m, and of d . x', m/s, of the motion. Returns sum_k |d| . |X_k|, the measure of its
  /// rounding.
  double displacement(const Vector& d, Series& c) const;
  double velocity(const Vector& d, Series& c) const;

  /// Series of the observed displacement and velocity, with those of the ground (EquationOfMotion::base).
  void observed(Series& x, Series& v) const;

  /// Work of the force, integral of f . x' dt, and of the dampers and of circulatory forces, integral of
  /// x' . (C x' + N x) dt with the skew part N of K, from 0 to s; J.
  struct Work {
    double input = 0, viscous = 0;
  };
  Work work(double s) const;

 private:
  void expand_force(double t, double h);
  void expand_force_rate(double t, double h);
  void add_rate(std::size_t k, Matrix& next) const;

  const EquationOfMotion& equation_;
  continuation::Cholesky mass_;
  std::vector<Part> parts_;
  Matrix stiffness_, damping_;     // M^-1 K', M^-1 C
  Matrix circulatory_;             // N; empty: none
  std::vector<Matrix> over_mass_;  // M^-1 D of each part
  std::vector<Matrix> in_modes_;   // their stiffness now
  bool stopped_ = false;
  double longest_ = 0, t_ = 0, h_ = 0;
  std::vector<Matrix> X_, V_;    // order + 1
  Matrix force_, acceleration_;  // dofs x (order + 1): f_k, M^-1 f_k
  const EquationRates* rates_ = nullptr;
  Matrix mass_rate_, damping_rate_, stiffness_rate_;  // over M, of the structure; empty: 0
  std::vector<Matrix> mode_rates_;                    // of the stiffness in its mode; empty: 0
  Matrix force_rate_;                                 // dofs x (order + 1): of f_k, over M
  Matrix hilbert_;                                    // 1/(i + j + 1)
};

/// An upper bound of the angular frequencies of the free structure, rad/s, damping included, whatever the
/// modes of the automata. Throws SingularMass, with the degree of freedom. control: as for LinearMotion;
/// none: stopped.
std::optional<double> fastest(const EquationOfMotion& equation, const std::vector<LinearMotion::Part>& parts,
                              const control::Control& control = {});

}  // namespace arcslip::time
