#pragma once
// Floquet multipliers of a periodic motion that is given by its Fourier series, as a solution of harmonic
// balance: eigenvalues of the monodromy matrix of the variational equation along it, over theta = omega t,
//
//   M w'' + C w'/omega + (K + sum D T D^T) w/omega^2 + sum D f_z dz/omega^2 = 0,     w' = dw/dtheta
//
// A law that is piecewise linear (laws/automaton.hpp) has a constant T between the changes of its modes,
// whose angles the element reports (contact_states_along.hpp). A slider that rests keeps its variation dz;
// one that follows has dz = z_q D^T w, and at the instant theta_e where it comes to rest by a guard g of
// displacements the variation of this instant, -dg/g', moves it too. Other laws without memory have T = df/dq
// and B = df/dv along the motion, and hysteretic ones a forcing by the disturbance of their memory, too
// (memory_along.hpp).
//
// Propagation: where all laws are piecewise linear, in the oscillators of the structure in each set of modes,
// kept from motion to motion (piecewise_linear_monodromy.hpp). Otherwise by power series of w over pieces of
// the period: T and B of other laws are replaced by polynomials through their values at four Gauss nodes of
// each piece, which leaves an error of order 8 (varying_coefficients.hpp). Long pieces of constant
// coefficients are halved and squared. An antisymmetric motion is followed over half a period: its
// multipliers are the squares of those of the map w(theta) -> -w(theta + pi).
//
// Where all laws are piecewise linear, degrees of freedom may have no mass, and high natural modes may be
// left out, whose flexibility remains: they have no multipliers.
//
// A slider that sticks throughout has a neutral multiplier 1, which is left out. As many multipliers are 0 as
// sliders follow at once at some instant. Errors: those of the motion, and of the roundings of the period;
// exact for piecewise linear structures else. Source: docs/theory/09-event-driven.md.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/stability/contact_states_along.hpp>
#include <arcslip/time/equation/equation_of_motion.hpp>
#include <arcslip/time/equation/natural_modes.hpp>

#include <complex>
#include <memory>
#include <vector>

namespace arcslip::time {

/// A law with a memory that is neither piecewise linear nor hysteretic (laws/hysteresis.hpp).
class NoVariation : public Error {
  using Error::Error;
};

/// The motion along the directions of one element, and what its contact does (empty: found by its guards).
struct ElementCourse {
  Matrix q;  // a column of coefficients for each direction
  std::vector<elements::ContactInterval> contact;
};

/// For one equation of motion, at any frequency; keeps its buffers. One for each thread.
class Floquet {
 public:
  /// Throws NoVariation, SingularMass (time/equation/equation_of_motion.hpp). The frequency, the forces and
  /// the harmonics of the equation do not matter. kept: only where all laws are piecewise linear and K and C
  /// symmetric. modes: of the equation; null: computed, where all laws are piecewise linear.
  explicit Floquet(const EquationOfMotion& equation, const ModesKept& kept = {},
                   std::shared_ptr<const NaturalModes> modes = nullptr);
  ~Floquet();
  Floquet(Floquet&&) noexcept;
  Floquet& operator=(Floquet&&) noexcept;

  /// Goes to another equation of the same elements, with the modes kept as before. Throws as the constructor,
  /// and is then as before. What was found of the structure in sets of modes is kept where its matrices and
  /// the stiffnesses of its elements are the same, as where only forces or normal loads are others.
  void move_to(const EquationOfMotion& equation);

  /// Whether an equation has the same M, C and K.
  bool has_matrices_of(const EquationOfMotion& equation) const;

  /// omega: base frequency, rad/s; elements: as in the equation. False: there are none, as where the motion
  /// is not finite or a contact chatters, or `control` has ended.
  bool compute(double omega, const elements::Harmonics& harmonics, const std::vector<ElementCourse>& elements,
               const control::Control& control = {});

  /// The modes that move with inertia.
  int modes() const;

  /// Of the motion's period, by falling modulus.
  const std::vector<std::complex<double>>& multipliers() const;
  /// Of the map over half a period, where the motion is antisymmetric: -1 where the symmetry breaks.
  const std::vector<std::complex<double>>& half_multipliers() const;
  /// The map of the variation and its velocity, in coordinates of its own, of dz of the sliders that rest at
  /// the first instant and slip later, and of y of hysteretic laws at their last reversal before, over
  /// harmonics.span(), from an instant between two changes.
  const Matrix& map() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arcslip::time
