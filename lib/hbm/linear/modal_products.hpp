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

/// The equation of one harmonic in modes, Z q = f, of which nothing is formed but D^-1 = Z_ll^-1.
struct ModalEquation {
  Factors g;
  ComplexVector inverse;       // of D
  ComplexMatrix observations;  // of ModalOperator::observations(), where it has been computed
  bool has_observations = false;
};

/// Mutable, one for each evaluator.
class ModalOperator {
 public:
  /// observed: c, a column for each observation.
  ModalOperator(ModalProducts& products, const Eigen::MatrixXd& observed);

  /// At these factors of n times the base frequency, s. False where D is singular to rounding.
  bool move_to(const Factors& g, double s, ModalEquation& at) const;

  /// y = (q, l) from its q, with l = D^-1 (force_factor f_l - Z_lq q).
  void expand(const ModalEquation& at, const ComplexVector& f, double force_factor, ComplexVector& y);
  /// v_q := Z_qq q + Z_ql l - force_factor f_q, the residual, of such a y.
  void residual(const ModalEquation& at, const ComplexVector& f, double force_factor, const ComplexVector& y,
                ComplexVector& v);
  /// v_q := v_q - Z_ql D^-1 v_l; v_l is lost.
  void project(const ModalEquation& at, ComplexVector& v);
  /// x = c . y of each observation by q, and in the last column by the force factor.
  const ComplexMatrix& observations(ModalEquation& at, const ComplexVector& f);
  /// -c_l . D^-1 v_l of an observation.
  Complex observed_change(const ModalEquation& at, const ComplexVector& v, int observation) const;
  /// Z, formed.
  void form(const ModalEquation& at, ComplexMatrix& Z);

 private:
  ModalProducts& products_;
  const Eigen::Index r_, l_;
  const Eigen::MatrixXd& c_;
  ComplexVector v_;
  Eigen::MatrixXd right_, turned_, solved_;  // 2 l x r: (re, -im) and (im, re) of Z_lq, (re, im) of D^-1 Z_lq
  Eigen::MatrixXd re_, im_;                  // of Z_ql D^-1 Z_lq
};

}  // namespace arcslip::hbm
