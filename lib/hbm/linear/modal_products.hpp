#pragma once
// Products with Z = g_m M + g_c C + g_k K in fixed-interface modes (fixed_interface.hpp), by the blocks of M,
// C and K: (r + l) r operations, without Z.

#include <arcslip/hbm/linear/fixed_interface.hpp>
#include <arcslip/hbm/linear/reduced_direction.hpp>

#include <memory>

namespace arcslip::hbm {

/// a b, without the tests for infinity of operator*.
inline Complex product(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Mutable, with its buffers. y = (q, l), v likewise.
class ModalProducts {
 public:
  explicit ModalProducts(std::shared_ptr<const FixedInterfaceModes> modes);

  const FixedInterfaceModes& modes() const { return *modes_; }

  /// v += Z y
  void add(const Factors& g, const ComplexVector& y, ComplexVector& v);
  /// v_q += Z_qq q
  void add_qq(const Factors& g, const ComplexVector& y, ComplexVector& v);
  /// v_q += Z_ql l
  void add_ql(const Factors& g, const ComplexVector& y, ComplexVector& v);
  /// v_l += Z_lq q
  void add_lq(const Factors& g, const ComplexVector& y, ComplexVector& v);

 private:
  // Columns of the same block of M, C and K.
  struct Blocks {
    const Eigen::MatrixXd &M, &C, &K;
  };
  void add(const Factors& g, Blocks of, const Complex* x, Complex* v);

  std::shared_ptr<const FixedInterfaceModes> modes_;
  Eigen::MatrixXd M_ql_, C_ql_, K_ql_;  // r x l
  bool damped_;                         // C is not 0
  Eigen::VectorXd re_, im_;
};

}  // namespace arcslip::hbm
