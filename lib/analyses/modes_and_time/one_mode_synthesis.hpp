#pragma once
// Forced responses next to a nonlinear mode, after Krack (2015). The motion x at a point of the mode, with
// the frequency omega, takes part in the frequency response under the fundamental f of the excitation times a
// level L as far as the balance of its own fundamental allows:
//
//   (omega^2 - W^2)^2 + 4 omega^2 (zeta_v W + zeta_i omega)^2 = (L P/m)^2,      P = |x^H f|,  m = x^H M x
//
// in the excitation frequency W. zeta_v and zeta_i are the parts of the damping ratio by what is in
// proportion to the velocity, and by what does not depend on the frequency: friction, hysteresis, a loss
// factor. The largest amplitude at a level is reached where W makes the left side least. Without zeta_i
//
//   W^2 = omega^2 (1 - 2 zeta^2),      L = 2 zeta sqrt(1 - zeta^2) omega^2 m/P
//
// Exact for a mode of a linear structure with damping in proportion to its masses or stiffnesses, if no other
// mode is driven, and for one mass with friction and one harmonic; otherwise the other modes and the
// harmonics that the excitation would add are left out. f of a moving base is taken at omega.

#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <complex>
#include <memory>
#include <optional>
#include <vector>

namespace arcslip::observables {

class OneModeSynthesis {
 public:
  /// motions: of the model without its excitation. excited: with it.
  OneModeSynthesis(const hbm::HbmProblem& motions, std::shared_ptr<const model::Model> excited);

  /// At a motion, unknowns u, of the damping ratio zeta_v + zeta_i: but for the true peak. Without values
  /// where the excitation does not drive it.
  Synthesis of(const hbm::HbmEvaluator& motion, continuation::In u, double omega, double zeta_v,
               double zeta_i) const;

  /// The peak of the frequency response under the level of a motion, by harmonic balance: started from the
  /// motion, it is the first one of the branch through it, upwards or downwards, the higher of the two.
  /// Nothing: none was found near.
  struct Peak {
    double omega, amplitude;  // half the way between the extremes of the response, m
  };
  std::optional<Peak> true_peak(const hbm::HbmEvaluator& motion, continuation::In u, double zeta,
                                const Synthesis& nearby, const control::Control& control) const;

 private:
  std::complex<double> work(const hbm::HbmEvaluator& motion, continuation::In u, double omega) const;

  elements::Harmonics harmonics_;
  std::shared_ptr<const model::Model> excited_;
  struct Force {
    model::Excitation of;
    std::complex<double> given;  // a - i b
    Eigen::VectorXd shape;       // over the degrees of freedom with forces
  };
  std::vector<Force> forces_;  // of the fundamental
  Eigen::MatrixXd P_;          // the rows of those degrees of freedom
};

}  // namespace arcslip::observables
