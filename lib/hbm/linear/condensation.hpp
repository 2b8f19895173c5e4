#pragma once
// Dynamic condensation: linear coordinates l of y = (q, l) are eliminated from Z y = f, harmonic by harmonic,
// and from observations x = c . y. Where Z is symmetric, Z_ql Z_ll^-1 is the transpose of Z_ll^-1 Z_lq.
//
//   (Z_qq - Z_ql Z_ll^-1 Z_lq) q = f_q - Z_ql Z_ll^-1 f_l,   l = Z_ll^-1 (f_l - Z_lq q)
//
// A change of the full equation at the full motion, v = dZ y - df, changes the condensed one by
// v_q - Z_ql Z_ll^-1 v_l, and x at fixed q by -c_l . Z_ll^-1 v_l.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/sparse_algebra.hpp>
#include <arcslip/hbm/linear/elimination.hpp>

#include <optional>

namespace arcslip::hbm {

/// The equation of one harmonic, Z q = f, and what leads from it to y and back.
struct Condensed {
  ComplexMatrix Z;     // r x r, the Schur complement of Z_ll
  ComplexVector f;     // r
  bool forced = true;  // false: f and Z_ll^-1 f_l are known to be 0
  SplitMatrix W;       // l x (r + 1 + observations): Z_ll^-1 [Z_lq, f_l] and Z_ll^-T c_l for each observation
  ComplexMatrix V;     // l x r: Z_ll^-T Z_ql^T; empty where Z is symmetric, and W has it
  /// By the excitation frequency, where it has been computed: of Z and -f, a row for each, and of the
  /// observations x = c . y below; the last column is that of f and of the force factor.
  ComplexMatrix rates;
  bool has_rates = false;
  ComplexMatrix observed;  // of_observations(), where it has been computed
  bool has_observed = false;

  /// y = (q, l) from its q, with f times force_factor.
  void expand(double force_factor, ComplexVector& y) const;
  /// v_q := v_q - Z_ql Z_ll^-1 v_l.
  void project(ComplexVector& v) const;
  /// -c_l . Z_ll^-1 v_l of an observation.
  Complex observed_change(const ComplexVector& v, int observation = 0) const;
  /// x = c . y of each column c by q, and in the last column by the force factor.
  const ComplexMatrix& of_observations(const Eigen::MatrixXd& c);
  /// The transpose of expand() without f: c_q := c_q - (Z_ll^-1 Z_lq)^T c_l.
  void observe(ComplexVector& c) const;
};

/// The same with fixed-interface modes as linear coordinates (fixed_interface.hpp). Mutable, one for each
/// evaluator.
class ModalCondensation {
 public:
  /// observed: c, a column for each observation.
  ModalCondensation(const FixedInterfaceModes& modes, const Eigen::MatrixXd& observed);

  /// At the place of parts, which has modes. False where Z_ll is singular to rounding.
  bool condense(const LinearParts& parts, double s, const ComplexVector& f, Condensed& into);
  /// The rates of harmonic n, which is condensed at the place of parts.
  void differentiate(const LinearParts& parts, int n, Condensed& at);

 private:
  bool add_changes(const LinearParts& parts, const Factors& g, const ComplexVector& f, Condensed& into);

  const Eigen::Index r_, l_;
  Eigen::MatrixXd c_;    // l x observations
  SplitMatrix inverse_;  // D^-1, a column
  SplitMatrix right_;    // Z_lq, f_l
  SplitMatrix along_;    // of a motion y: y_l and (dZ y - df)_l
  ComplexVector f_rate_;
  // Of the changes: d_l, D^-1 d_l, the forces in them.
  Eigen::MatrixXd U_;
  ComplexMatrix inverse_U_, H_, equations_, forces_;
};

/// Mutable, one for each evaluator. Z_ll^-1 is by what costs least for its size and for how few coordinates
/// each part links: elimination in place, elimination (elimination.hpp), or LU of a sparse matrix.
class Condensation {
 public:
  /// The first `unknowns` coordinates remain. observed: c, a column for each observation.
  Condensation(const LinearParts& parts, int unknowns, const Eigen::MatrixXd& observed);

  /// False where Z_ll is singular to rounding.
  bool condense(const StructuralMatrices& of, const Factors& g, const ComplexVector& f, Condensed& into);

 private:
  void choose_sparse(const LinearParts& parts);
  // W_ = Z_ll^-1 rhs_
  bool solve_linear(const StructuralMatrices& of, const Factors& g);

  const Eigen::Index r_, l_;
  Eigen::MatrixXd c_;      // l x observations
  ComplexMatrix rhs_, W_;  // [Z_lq, f_l, c_l]
  ComplexMatrix Zll_;      // of few
  std::optional<Elimination> elimination_;
  std::optional<continuation::ComplexSparseLU> sparse_lu_;
  ComplexSparse sparse_Zll_;
};

/// The same without symmetry, by LU of a dense or of a sparse matrix. Mutable, one for each evaluator.
class UnsymmetricCondensation {
 public:
  /// pattern: of Z. observed: as of Condensation.
  UnsymmetricCondensation(const ComplexSparse& pattern, int unknowns, const Eigen::MatrixXd& observed);

  /// False where Z_ll is singular to rounding.
  bool condense(const ComplexSparse& Z, const ComplexVector& f, Condensed& into);

 private:
  void set_blocks(const ComplexSparse& Z, const ComplexVector& f, Condensed& into);
  // W_ := Z_ll^-1 W_, V_ := Z_ll^-T V_
  bool solve();

  const Eigen::Index r_, l_;
  ComplexMatrix c_;
  ComplexMatrix W_, V_;  // [Z_lq, f_l] and [Z_ql^T, c_l]
  ComplexMatrix Zll_;    // where that is dense
  ComplexVector solution_;
  continuation::LU<Complex> lu_;
  std::optional<continuation::ComplexSparseLU> sparse_lu_;
  ComplexSparse sparse_Zll_;
};

}  // namespace arcslip::hbm
