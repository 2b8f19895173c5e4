#pragma once
// The linear part of harmonic balance, condensed onto the unknowns (condensation.hpp):
//
//   R_n = Z_n X_n - f_n,   Z_n = K - (n omega_b)^2 M + i n omega_b C,   X_n = a_n - i b_n
//
// Z_n need not be symmetric, as with gyroscopic forces, nor of the same K for every n, as in a sector of a
// ring.

#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/linear/condensation.hpp>
#include <arcslip/hbm/linear/coordinates.hpp>
#include <arcslip/hbm/linear/modal_products.hpp>

#include <vector>

namespace arcslip::hbm {

using continuation::Vector;
using elements::Harmonics;
using elements::Out;

/// Mutable, one for each evaluator. Layout of u and R: r coordinates one after another, each as in
/// fourier/harmonics.hpp.
class DynamicStiffness {
 public:
  DynamicStiffness(const model::Model& model, const Coordinates& coordinates, const Harmonics& harmonics);

  /// False at an undamped resonance of the linear coordinates, a pole of the condensed stiffness, and after a
  /// end of Model::control.
  bool move_to(In p);
  bool is_at(In p) const { return p.head(last_p_.size()) == last_p_; }
  double base_frequency() const { return parts_.base_frequency(); }  // rad/s, at the last place

  void residual(In u, double force_factor, Out R) const;                      // R = Z u - force_factor f
  void add_to(Eigen::MatrixXd& J) const;                                      // J += Z
  void add_order(int n, Eigen::MatrixXd& J_n) const;                          // of one order, as ElementMap
  void force(Out f) const;                                                    // f
  void parameter_derivative(int k, In u, double force_factor, Out dR) const;  // zero for element parameters
  void solve(Out x) const;  // Z_n^-1 of each harmonic, in place

  /// The motion of all degrees of freedom x = P y, a column of coefficients for each.
  Eigen::MatrixXd motion(const Eigen::MatrixXd& P, In u, double force_factor) const;

  /// Adds the displacement of the ground along d to these coefficients.
  void add_base(const model::Direction& d, double force_factor, Out x) const;

  /// How many coordinates are observed: the response and, where it has several places, its others.
  int places() const { return static_cast<int>(responses_.cols()); }
  /// One of them: its coefficients x = L u + x_0, the product L^T a, and dx/dp_k at fixed u.
  void response(In u, double force_factor, Out x, int place = 0) const;
  void response_transposed(In a, Out g, int place = 0) const;
  void response_derivative(int k, In u, double force_factor, Out dx, int place = 0) const;

  /// Energy lost by dampers and by proportional damping in a period: pi sum n Im x_n^H Z_n x_n, J; of
  /// dampers pi omega_b sum n^2 (a^T C a + b^T C b).
  double viscous_energy(In u, double force_factor) const;
  /// Of order n, one of the harmonics, at the last place.
  QuadraticForms quadratic_forms(int n, In u, double force_factor) const;

 private:
  // One of the harmonics: where its coefficients stand among those of a coordinate, and its equation.
  struct Harmonic {
    int order, cosine, sine;  // the mean has no sine
    bool driven;              // by a force of the scene, whatever its value
    Condensed condensed;
    ComplexVector force{};  // before condensation
    ModalEquation modal{};  // with many unknowns in modes; then `condensed` has Z alone, where it is formed
    bool is_formed = false;

    // X_n of the coordinate whose coefficients begin at `first`; X_0 is real.
    Complex amplitude(const In& x, int first) const {
      return {x[first + cosine], order == 0 ? 0.0 : -x[first + sine]};
    }
    void put(Complex amplitude, int first, Out& x) const {
      x[first + cosine] = amplitude.real();
      if (order > 0) x[first + sine] = -amplitude.imag();
    }
  };
  // They write y_, and the last one also v_.
  void gather(const In& u, const Harmonic& at) const;
  bool is_at_rest(const In& u, const Harmonic& at) const;  // u is 0 there, and so is f for any parameters
  void expand(const In& u, const Harmonic& at, double force_factor) const;
  void differentiate(int k, const In& u, const Harmonic& at, double force_factor) const;
  // By the frequency, of coordinates in modes and few unknowns: Condensed::rates. Null: not by these.
  const ComplexMatrix* rates(int k, Harmonic& at) const;
  bool prepare(Harmonic& at);
  bool condense(Harmonic& at);
  const ComplexMatrix& formed(Harmonic& at) const;  // Z
  const ComplexMatrix& observations(Harmonic& at) const;
  Complex observed_change(const Harmonic& at, int place) const;  // of v_
  void project(const Harmonic& at) const;                        // v_
  void scatter(const ComplexVector& q, const Harmonic& at, Out& x) const;

  const int r_, l_;
  const Harmonics layout_;
  const int size_;                        // coefficients of a coordinate
  Eigen::MatrixXd responses_;             // directions in y, a column for each place
  std::vector<model::Direction> ground_;  // along which the displacement of the ground belongs to each
  bool takes_long_;                       // each harmonic: then control_ is asked in between
  control::Control control_;
  LinearParts parts_;
  mutable std::optional<ModalCondensation> modal_;
  mutable std::optional<ModalOperator> operator_;  // with many unknowns
  bool uses_operator_ = false;                     // at the last place
  long values_ = -1;                               // LinearParts::changes_of_values() there
  std::optional<Condensation> direct_;             // without modes, or where too many parts differ from them
  std::optional<UnsymmetricCondensation> unsymmetric_;  // of a rotor, or linked to the next sector
  ComplexSparse Z_;                                     // before that
  mutable std::vector<Harmonic> harmonics_;             // their rates
  Vector last_p_;
  mutable ComplexVector y_, v_;  // a full motion, a residual of the full equation; q comes first in both
};

}  // namespace arcslip::hbm
