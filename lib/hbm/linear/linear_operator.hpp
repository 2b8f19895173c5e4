#pragma once
// Masses, dampers, springs and forces in the coordinates y, x = P y (coordinates.hpp), before condensation.
// For harmonic n of the motion, with s = n times the base frequency:
//
//   Z y = f,   Z = g_m M + g_c C + g_k K
//   g_m = -s^2 + i s alpha,   g_c = i s,   g_k = 1 + i s beta + i loss_factor (s > 0)
//
// A mass, a damper or a spring adds value * g d d^T to Z, a matrix of the structure value * g A, and a force
// adds (cosine - i sine) d to the f of its harmonic. Most of d is zero. So do the forces of a moving ground
// (model::Excitation), one for each mass. alpha, beta, loss_factor: model::ProportionalDamping.
//
// A circulatory matrix has the factor 1, without proportional damping. Matrices of the structure may be
// unsymmetric; gyroscopic ones are among C.
//
// In a sector of a ring d = d_own + t d_next, with the turn t of that harmonic (model::Sector), adds
// value * g conj(d) d^T, and a matrix value * g A_d of its wave (model::WaveMatrices): Z is linked, not
// symmetric, with M, C and K Hermitian but for unsymmetric matrices.

#include <arcslip/hbm/linear/modal_products.hpp>
#include <arcslip/hbm/linear/reduced_direction.hpp>

#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace arcslip::hbm {

using elements::In;

struct PartInY {
  model::LinearKind kind;
  model::Number number;
  DirectionInY direction;
  double value;  // at the last place
};

/// M, C, K in y, where Z is symmetric.
struct StructuralMatrices {
  Eigen::MatrixXd M, C, K;

  const Eigen::MatrixXd& of(model::LinearKind kind) const {
    if (kind == model::LinearKind::mass) return M;
    return kind == model::LinearKind::damper ? C : K;
  }
  Eigen::MatrixXd& of(model::LinearKind kind) {
    if (kind == model::LinearKind::mass) return M;
    return kind == model::LinearKind::damper ? C : K;
  }
  /// An entry of Z.
  Complex at(const Factors& g, Eigen::Index i, Eigen::Index j) const {
    return g.combine(M(i, j), C(i, j), K(i, j));
  }
};

/// Products of the linear parts and the forces with one harmonic of the motion x of all degrees of freedom.
struct QuadraticForms {
  double mass = 0, stiffness = 0;  // x^H M x, x^H K x
  double damping = 0;              // Im x^H Z x
  double gyroscopic = 0;           // what skew-symmetric and skew-Hermitian matrices add to Re x^H Z x
  Complex force;                   // x^H f
};

/// A part next to the modes: its value less the one that they have.
struct ChangedPart {
  const PartInY* part;
  double by;
};

/// Mutable, one for each evaluator. Values, frequency and forces are those of the last place.
class LinearParts {
 public:
  /// modes: those in the linear coordinates of P, if they are that.
  LinearParts(const model::Model& model, const Eigen::MatrixXd& P, const elements::Harmonics& harmonics,
              std::shared_ptr<const FixedInterfaceModes> modes = {});

  void move_to(In p);
  double base_frequency() const { return base_frequency_; }  // rad/s
  Factors factors(double s) const;
  /// Null where too many parts have other values than the modes; then matrices() are those of the place.
  const FixedInterfaceModes* modes() const { return modal_ ? modes_.get() : nullptr; }
  const std::vector<ChangedPart>& changes() const { return changes_; }
  /// Whether Z is that of the modes, with no other parts.
  bool purely_modal() const { return modal_ && symmetric() && changes_.empty(); }
  /// Products with the modes, where there are any.
  ModalProducts& products() const { return *products_; }
  /// Counts the places at which values other than the frequency changed.
  long changes_of_values() const { return changes_of_values_; }
  const StructuralMatrices& matrices() const { return matrices_; }
  /// False where masses, dampers, springs or matrices reach into the next sector, or a matrix of the
  /// structure is unsymmetric. Z is then by dynamic_stiffness() alone.
  bool symmetric() const { return !linked_ && symmetric_; }
  /// A matrix with the entries that Z has for some harmonic and some parameters, and all of its diagonal.
  ComplexSparse pattern() const;
  /// Z of one of the harmonics, in a matrix with that pattern.
  void dynamic_stiffness(int n, ComplexSparse& Z) const;
  /// f of harmonic n.
  void force(int n, ComplexVector& f) const;
  /// Whether one of them is not that of the place before.
  bool force_changed() const { return force_changed_; }
  /// By the excitation frequency: of the factors, and of f; false where f does not have it.
  Factors factor_rates(int n) const;
  bool force_rate(int n, ComplexVector& f) const;

  /// The displacement of the ground in harmonic n along a direction of the degrees of freedom, and its
  /// derivative by p_k.
  Complex base_displacement(int n, const model::Direction& direction) const;
  Complex base_derivative(int k, int n, const model::Direction& direction) const;

  /// Whether Z or f has the parameter p_k.
  bool depend_on(int k) const;
  /// dZ/dp_k y - force_factor df/dp_k of harmonic n.
  void differentiate(int k, int n, const ComplexVector& y, double force_factor, ComplexVector& v) const;

  /// y^H M y, y^H C y or y^H K y of harmonic n: of the symmetric or Hermitian part.
  double quadratic_form(model::LinearKind kind, int n, const ComplexVector& y) const;
  /// Im y^H Z y: over pi times the order, the energy that harmonic n of the motion loses in a period.
  double damping_form(int n, const ComplexVector& y) const;
  /// f is that of harmonic n, times force_factor.
  QuadraticForms quadratic_forms(int n, const ComplexVector& y, double force_factor) const;

 private:
  // amplitude * sum_k value_k along_k direction_k; value_k: the mass, or 1 where there is none.
  struct ForceInY {
    struct Term {
      model::Number mass;
      DirectionInY direction;
      Complex along = 1;
    };
    model::Excitation of;
    int harmonic;  // of the base frequency
    std::vector<Term> terms;
    Complex given;      // the amplitude as the scene gives it
    Complex amplitude;  // of f: with the factor of the frequency
  };
  double value(const ForceInY::Term& term) const { return term.mass.value_or(p_, 1); }
  // P^T A P: where Z is symmetric in `A`, made when it is first needed, which with modes it seldom is; else
  // in `waves`, one for each diameter of the harmonics or one for all, with entries in the same places.
  struct MatrixInY {
    model::MatrixPart of;
    mutable Eigen::MatrixXd A{};
    std::vector<ComplexSparse> waves{};
    std::vector<int> positions{};  // of their entries in Z
    double value = std::nan("");   // at the last place
  };
  // Where the m x m entries of a part stand in Z, column by column, and d_own, d_next of its m coordinates.
  struct PartInZ {
    std::vector<std::pair<double, double>> direction;
    std::vector<int> positions;
  };
  const Eigen::MatrixXd& in_y(const MatrixInY& part) const;
  const ComplexSparse& in_wave(const MatrixInY& part, int n) const;
  Complex turn(int n) const { return linked_ ? sector_.turn(n) : 1; }
  void set_waves(const elements::Harmonics& harmonics);
  ComplexSparse links() const;
  void set_positions();
  void add_product(const Factors& g, int n, const ComplexVector& y, ComplexVector& v) const;
  void add_matrix_product(const MatrixInY& part, int n, Complex factor, const ComplexVector& y,
                          ComplexVector& v) const;
  Complex matrix_form(const MatrixInY& part, int n, const ComplexVector& y) const;
  void set_values();
  Complex skew_form(int n, const ComplexVector& y) const;
  double modal_value(const PartInY& part) const;
  void add(const ForceInY& force, Complex amplitude, ComplexVector& f) const;

  model::Sector sector_{1, 0};
  bool linked_, symmetric_;
  int period_;
  Eigen::Index size_;
  std::shared_ptr<const FixedInterfaceModes> modes_;
  mutable std::optional<ModalProducts> products_;
  long changes_of_values_ = 0;
  bool has_place_ = false, modal_ = false, force_changed_ = true;
  std::vector<ChangedPart> changes_;
  std::vector<PartInY> parts_;
  std::vector<MatrixInY> matrix_parts_;
  Eigen::MatrixXd P_;  // where there are any
  // Where Z is not symmetric.
  std::vector<PartInZ> parts_in_Z_;
  ComplexSparse pattern_;
  std::vector<int> wave_of_diameter_;
  mutable ComplexVector direction_;  // of a part
  std::optional<model::ProportionalDamping> damping_;
  std::vector<ForceInY> forces_;
  StructuralMatrices matrices_;
  Eigen::VectorXd p_;
  double base_frequency_ = -1;
};

}  // namespace arcslip::hbm
