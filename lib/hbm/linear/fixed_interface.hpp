#pragma once
// Fixed-interface modes: the linear coordinates l of y = (q, l) (coordinates.hpp) as modes of the structure
// with the unknowns q held. At the values of the parameters for which they are made, the blocks ll of M, K
// and, where damping is proportional, C are diagonal:
//
//   Z_qq - Z_ql Z_ll^-1 Z_lq = Z_qq - sum_j z_j z_j^T/D_j,   D_j = g_m M_jj + g_c C_jj + g_k K_jj
//
// so that a harmonic costs O(l r^2) instead of a factorization. Parts with other values, and dampers that are
// not proportional, are changes of low rank, value * g(s) d d^T each.

#include <arcslip/hbm/linear/reduced_direction.hpp>
#include <arcslip/model/model.hpp>

#include <complex>
#include <memory>

namespace arcslip::hbm {

/// g of the masses, the dampers and the springs at one s.
struct Factors {
  Complex mass, damper, spring;
  double circulatory = 0;

  Complex of(model::LinearKind kind) const {
    if (kind == model::LinearKind::circulatory) return circulatory;
    if (kind == model::LinearKind::mass) return mass;
    return kind == model::LinearKind::damper ? damper : spring;
  }
  /// Of an entry of Z.
  Complex combine(double M, double C, double K) const {
    return {mass.real() * M + spring.real() * K, mass.imag() * M + damper.imag() * C + spring.imag() * K};
  }
};

/// A symmetric matrix in y whose block ll is diagonal.
struct ModalMatrix {
  Eigen::MatrixXd qq, lq;
  Eigen::VectorXd ll;

  /// y^H this y
  double form(const Eigen::VectorXcd& y) const;
};

struct FixedInterfaceModes {
  ModalMatrix M, C, K;
  continuation::Vector p;     // the parameters of the model for which these hold
  bool damped = false;        // C holds all dampers; else none
  Eigen::MatrixXd of_linear;  // l x l: the modes in the linear coordinates that were given
};

/// |D_j| relative to K_jj + s^2 M_jj: below, Z_ll is singular to rounding.
inline constexpr double modal_pole = 1e-14;

/// Parts that may differ from the modes' values, or dampers outside of C, before a factorization costs less.
inline constexpr int most_changes = 16;

/// The modes of the model's structure at its default values. P: x = P y; frequency: rad/s, about which they
/// are most accurate. Null where there are too few linear coordinates to gain from it, or too many, where
/// masses and springs are not both positive semidefinite, or where damping is not proportional and there are
/// more than a few dampers.
std::shared_ptr<const FixedInterfaceModes> fixed_interface_modes(const model::Model& model,
                                                                 const Eigen::MatrixXd& P, int unknowns,
                                                                 double frequency);

}  // namespace arcslip::hbm
