#pragma once
// The derivatives of an equation of motion by one parameter p of its model, for variations of its motion:
//
//   M y'' + C y' + K' y = df/dp - dM/dp x'' - dC/dp x' - dK'/dp x + D dg/dp,   y = dx/dp at a fixed t
//
// within a mode of each law (laws/automaton.hpp); by the excitation frequency with df/dp at a fixed t,
//
//   d/domega (c cos n omega t + s sin n omega t) = n t (s cos n omega t - c sin n omega t)
//
// The numbers of an equation are polynomials of degree 2 at most in each parameter but the frequency, so that
// their central differences are exact in any distance, to rounding. Those of the laws' modes are
// differentiated by their fields, to some 11 digits of each number.

#include <arcslip/time/equation/equation_of_motion.hpp>

#include <optional>
#include <vector>

namespace arcslip::time {

/// Of one element. The numbers of its modes and guards are those of Law::automata(), differentiated.
struct ElementRates {
  std::vector<elements::Automaton> automata;  // empty: nothing changes
  struct Slider {
    Vector lower, upper;  // of its bounds, along the degrees of freedom
    double room = 0;      // elements::Slider::room
    double centre = 0;    // elements::Slider::centre
  };
  std::vector<Slider> sliders;  // of each automaton
};

struct EquationRates {
  double omega = 0;                   // d omega/dp of the base frequency
  Matrix M, C, K;                     // empty: 0
  std::vector<HarmonicForce> forces;  // of the amplitudes; their sum
  std::vector<BaseMotion> base;       // likewise
  std::vector<ElementRates> elements;

  /// Of the ground's part of the observed displacement of `equation`, at a fixed t.
  double base_at(const EquationOfMotion& equation, double t) const;
};

/// That of p[k] or of its parameter, if it is larger; 1 where both are 0.
double size_of_parameter(const model::Model& model, const continuation::Vector& p, int k);

/// By parameter k at p. Nothing where an element has other modes next to p than at p, as at a normal load of
/// 0. Throws NotInTime.
std::optional<EquationRates> equation_rates(const model::Model& model, const continuation::Vector& p, int k);

}  // namespace arcslip::time
