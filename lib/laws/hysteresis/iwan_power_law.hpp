#pragma once
// The distribution of slip limits of Segalman's four-parameter Iwan model (J. Appl. Mech. 72, 2005, 752-760):
//
//   rho(phi) = R [H(phi) - H(phi - phi_max)] phi^chi + S delta(phi - phi_max)
//
// reported by the stiffness K_T of small motions, the force F_S of macroslip, chi and beta = S/(R
// phi_max^(chi+1)/(chi+1)). With t = s/phi_max the force of a first loading and its slope are
//
//   F = K_T phi_max (t - t^(chi+2)/((1 + beta)(chi + 2))),   F' = K_T (1 - t^(chi+1)/(1 + beta)),   t <= 1
//   phi_max = F_S (1 + beta)/(K_T (beta + (chi + 1)/(chi + 2)))
//
// chi = beta = 0: Iwan's uniform distribution (J. Appl. Mech. 33, 1966), F = K_T s (1 - s/(2 phi_max)),
// phi_max = 2 F_S/K_T.

namespace arcslip::elements {

/// The shape of the backbone, F(s) = F_S g(y) with y = K_T s/F_S.
class PowerLaw {
 public:
  /// chi in (-1, 0], beta >= 0.
  PowerLaw(double chi, double beta);

  /// K_T phi_max/F_S: the y of macroslip.
  double largest() const { return largest_; }
  double largest_by_chi() const;
  double largest_by_beta() const;

  struct Values {
    double slope, rest;      // g', and g - y g', of the sliders that slip
    double by_chi, by_beta;  // dg
  };
  Values at(double y) const;

  /// Of the sliders with slip limits between those at t_0 and t_1, 0 <= t_0 < t_1 <= 1: their stiffness over
  /// K_T and their slip force over F_S. Those at t = 1 come apart.
  struct Share {
    double stiffness, slip_force;
  };
  Share between(double t_0, double t_1) const;
  Share at_most() const;

 private:
  double chi_, beta_;
  double largest_;
};

}  // namespace arcslip::elements
