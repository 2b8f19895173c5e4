#pragma once
// The linear part of harmonic balance, condensed onto the unknowns:
//
//   R_n = Z_n(omega) X_n - f_n,   Z_n = K - (n omega)^2 M + i n omega C,   X_n = a_n - i b_n
//
// With y = (q, l), l linear:  Z = Z_qq - Z_ql Z_ll^-1 Z_lq,  f = f_q - Z_ql Z_ll^-1 f_l,  y_l = Z_ll^-1 (f_l
// - Z_lq q). Every parameter derivative is that of the full equation at the full motion, v, projected: v_q -
// Z_ql Z_ll^-1 v_l.

#include <arcslip/continuation/dense_algebra.hpp>
#include <arcslip/continuation/sparse_algebra.hpp>
#include <arcslip/hbm/coordinates.hpp>

#include <complex>
#include <optional>
#include <utility>
#include <vector>

namespace arcslip::hbm {

using continuation::Vector;
using elements::Harmonics;
using elements::In;
using elements::Out;

/// What the linear parts and the forces do in one harmonic of the motion of all degrees of freedom, x.
struct QuadraticForms {
  double mass = 0, damping = 0, stiffness = 0;  // x^H M x, x^H C x, x^H K x
  std::complex<double> force;                   // x^H f
};

/// Mutable, one for each evaluator. Layout of u and R: r coordinates one after another, each as in
/// harmonics.hpp.
class DynamicStiffness {
 public:
  DynamicStiffness(const model::Model& model, const Coordinates& coordinates, const Harmonics& harmonics);

  /// False where the linear coordinates resonate by themselves, undamped: the condensed stiffness has a pole.
  bool move_to(In p);
  double omega() const { return omega_; }  // rad/s, at the last place

  void residual(In u, double force_factor, Out R) const;                      // R = Z u - force_factor f
  void add_to(Eigen::MatrixXd& J) const;                                      // J += Z
  void force(Out f) const;                                                    // f
  void parameter_derivative(int k, In u, double force_factor, Out dR) const;  // zero for element parameters
  void solve(Out x) const;  // Z_n^-1 of each harmonic, in place

  /// The observed coordinate: its coefficients x = L u + x_0, the product L^T a, and dx/dp_k at fixed u.
  void response(In u, double force_factor, Out x) const;
  void response_transposed(In a, Out g) const;
  void response_derivative(int k, In u, double force_factor, Out dx) const;

  /// Energy dissipated by the dampers in a period: pi omega sum n^2 (a^T C a + b^T C b), J.
  double viscous_energy(In u, double force_factor) const;
  /// Of order n, one of the harmonics, at the last place.
  QuadraticForms quadratic_forms(int n, In u, double force_factor) const;

 private:
  using Complex = std::complex<double>;
  using Vectorc = Eigen::VectorXcd;
  using Matrixc = Eigen::MatrixXcd;

  struct PartInY {
    int parameter;
    std::vector<std::pair<Eigen::Index, double>> direction;  // what is not zero of P^T d
  };
  std::vector<PartInY> in_y(const std::vector<model::LinearPart>& parts) const;
  void choose_sparse();
  void assemble(In p);
  bool depends_on(int k) const;
  void differentiate(int k, In u, int h, double force_factor, Vectorc& v) const;
  void gather(In u, int h, Vectorc& q) const;
  void expand(const Vectorc& q, int h, double force_factor, Vectorc& y) const;
  void scatter_add(const Vectorc& v, int h, Out R) const;
  void project(const Vectorc& v, int h, Vectorc& q) const;
  Complex coefficient(In x, int h) const;

  const model::Model& model_;
  const Harmonics harmonics_;
  const int r_, l_;
  Eigen::MatrixXd P_;          // dofs x (r + l)
  Eigen::MatrixXd M_, C_, K_;  // in y
  Vector response_;            // in y
  std::vector<PartInY> masses_, dampers_, springs_;
  std::vector<Vector> force_directions_;  // in y
  std::vector<double> structural_;        // values of the last assemble()
  std::vector<int> structural_parameters_;
  double omega_ = -1;
  Vector last_p_;
  std::vector<Matrixc> Z_;  // per harmonic, r x r
  std::vector<Vectorc> f_;  // r
  std::vector<Matrixc> W_;  // l x (r + 2): Z_ll^-1 [Z_lq, f_l, response_l]
  continuation::LU<Complex> lu_;
  Matrixc Zll_, rhs_;
  std::optional<continuation::ComplexSparseLU> sparse_lu_;  // where it costs less; then in place of these:
  continuation::ComplexSparseLU::Matrix sparse_Zll_;
  mutable Vectorc q_, y_, v_, full_f_;
};

}  // namespace arcslip::hbm
