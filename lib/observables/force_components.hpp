#pragma once
// Forces of the fundamental, in phase with the displacement and a quarter period ahead of it.
//
// Fundamental: the lowest harmonic excited, n >= 1, with complex amplitudes X = a - i b (elements/
// fourier/harmonics.hpp). For an element with displacement Q and force F:
//
//   (in_phase + i out_of_phase) = F conj(Q)/|Q|,   k_eq = in_phase/|Q|,   c_eq = out_of_phase/(n omega |Q|)
//
// so that the fundamental dissipates out_of_phase |Q| pi n per period.
//
// For the whole structure, with the motion x of all degrees of freedom and X that of the response, the
// equation of motion is multiplied by x^H/|X|^2: generalized forces along the shape x/X of the motion, per
// unit displacement of the response, N/m,
//
//   (x^H K x - (n omega)^2 x^H M x + i n omega x^H C x + sum_e conj(Q_e) F_e)/|X|^2 = x^H f/|X|^2 .
//
// One mass: k - m omega^2 + F_p/X + i (c omega + F_o/X) = f_0/X exp(i phase), the F_p/x and F_o/x of Al Sayed
// et al. (2011, Eqs. 18 to 24) for the fundamental, for which their Eqs. 26 and 27 hold. For their own
// definition by maxima over the period see MotionMaxima.

#include <arcslip/fourier/series_maximum.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <utility>

namespace arcslip::observables {

/// x: the response's coefficients, at the last place of `at`.
ForceComponents force_components(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In x);

/// Sets fundamental, equivalent_stiffness and equivalent_damping of element e, at the last place of `at`.
void set_fundamental(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, std::size_t e,
                     ElementResponse& element);

/// Sets theta_0 and theta_star from the angles of slip. motion: of the element, harmonics.size().
void set_contact_angles(const elements::Harmonics& harmonics, elements::In motion, ElementResponse& element);

/// The maxima of motion and forces, the most expensive observables: computed only on request. Owns
/// its buffers.
class Maxima {
 public:
  explicit Maxima(const hbm::HbmProblem& problem);

  /// Sets point.maxima and those of its friction elements; x: the response's coefficients, at the last place
  /// of `at`. point.forces are there already.
  void add_to(ResponsePoint& point, const hbm::HbmEvaluator& at, elements::In x);

  /// Largest absolute values over the period of the first and the second derivative of x by the time.
  std::pair<double, double> of(elements::In x, double base_frequency);

 private:
  const hbm::HbmProblem& problem_;
  elements::LargestValue largest_;
  continuation::Vector v_;
};

}  // namespace arcslip::observables
