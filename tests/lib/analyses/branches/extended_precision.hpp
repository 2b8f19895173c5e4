#pragma once
// The equations of harmonic balance once more, in extended precision and by another way than in the library:
// forces are marched through a period, event by event, and their coefficients come from Gauss quadrature
// between the events. For scenes of masses, springs, dampers, forces, and elements of type jenkins,
// gap_spring (one-sided) and contact_2d.
//
// All three elements are one law of a tangential motion x_t and a normal one x_n,
//
//   N = max(N_0 + k_n x_n, 0) - max(N_0, 0),   T = k_t (x_t - w),   |T| <= mu max(N_0 + k_n x_n, 0)
//
// with k_n = 0 for jenkins, and N_0 = -k g without T for gap_spring. Where it sticks throughout, w is in the
// middle between its bounds.

#include "lib/analyses/branches/extended_forces.hpp"

#include <arcslip/hbm/problem.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <vector>

namespace extended {

using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

struct Evaluation {
  Eigen::VectorXd residual;  // N, in the layout of the unknowns
  Eigen::VectorXd rounding;  // N, of each row the sum of the magnitudes of its terms
  // N, of each row the magnitudes that cancel in the mean force of contacts that stick or touch throughout:
  // the preload, and what a mean position adds to it.
  Eigen::VectorXd preload;
  Real friction = 0, viscous = 0, input = 0,
       energy_rounding = 0;                    // J per period; the magnitudes of the terms
  Real amplitude = 0, amplitude_rounding = 0;  // m, of the response
  std::vector<State> states;                   // of the elements
};

/// The response where each element does one thing throughout, a closed form.
struct Linear {
  Real amplitude = 0;  // m
  Real rounding = 0;   // m, how much it changes where each term of the equations changes by its own size
  Real preload = 0;    // m, the same of Evaluation::preload
};

class Equations {
 public:
  Equations(const arcslip::scene::Scene& scene, const arcslip::hbm::HbmProblem& problem);

  /// At unknowns of the problem and an excitation frequency, rad/s.
  Evaluation at(const Eigen::VectorXd& u, double omega) const;

  /// In the states of an evaluation, for forces in one harmonic and a constant one.
  Linear linear(const Evaluation& at, double omega) const;

 private:
  struct Part {
    Real value;
    Vector direction;
  };
  struct Force {
    int order;
    Complex amplitude;
    Vector direction;
  };
  struct Element {
    Real k_t = 0, mu = 0, k_n = 0, N_0 = 0;
    Vector tangential, normal;  // empty: none
  };

  Series along(const Vector& direction, const ComplexMatrix& y) const;

  arcslip::elements::Harmonics h_;
  Eigen::Index unknowns_;
  std::vector<Part> masses_, dampers_, springs_;  // directions in coordinates y, the unknowns first
  std::vector<Force> forces_;
  std::vector<Element> elements_;
  Vector response_;
};

}  // namespace extended
