#pragma once
// How the amplitude of a response changes with any parameter, while one condition holds it in place.
//
// With x = (u, omega), F(x, p) = 0 and one more equation r(x, p) = 0, dA/dp = A_p + A_x . dx/dp, where the
// linearized equations give dx/dp. One transposed solve serves all parameters:
//
//   [ F_x ]^T [ w ]
//   [ r_x ]   [ g ]  =  A_x,        dA/dp_k = A_pk - w . F_pk - g r_pk.
//
//   at a frequency   r = omega - const: g = dA/domega along the branch.
//   at a resonance   A is stationary along the branch, so that g = 0 whatever row r_x is there (envelope
//                    theorem): the tangent is, and the system is regular at folds too.
//   at a corner      r = h, the slip limit of an element (hbm/slip_corner.hpp), on which the peak sits. F_x
//                    and F_p jump along h_x and h_p: g takes up the jump, and both sides give the same.
//
// Units: those of A, m, over those of p_k. A parameter that ties several fields has the sum of their
// derivatives.

#include <arcslip/continuation/linear_solver.hpp>
#include <arcslip/continuation/stationary.hpp>
#include <arcslip/hbm/slip_corner.hpp>
#include <arcslip/observables/amplitude.hpp>

#include <memory>
#include <span>
#include <vector>

namespace arcslip::observables {

class Sensitivity {
 public:
  explicit Sensitivity(std::shared_ptr<const hbm::HbmProblem> problem);

  /// x: a solution (u, omega), n + 1, at all parameters p; p[frequency] is not looked at. parameters: indices
  /// k; gradient: dA/dp_k, one for each. False where the linearized equations are singular.
  bool at_frequency(continuation::In x, continuation::In p, std::span<const int> parameters,
                    continuation::Out gradient);
  bool at_resonance(continuation::In x, continuation::In p, std::span<const int> parameters,
                    continuation::Out gradient);
  bool at_corner(const hbm::SlipCorner& corner, continuation::In x, continuation::In p,
                 std::span<const int> parameters, continuation::Out gradient);

  /// At the last solution: A, m, and g, the multiplier of the condition.
  double amplitude() const { return amplitude_; }
  double multiplier() const { return z_[z_.size() - 1]; }

 private:
  bool move_to(continuation::In x, continuation::In p);
  bool factorize();
  bool differentiate(std::span<const int> parameters, continuation::Out gradient);

  std::shared_ptr<const hbm::HbmProblem> problem_;
  continuation::Quantity quantity_;
  Amplitude extremes_;
  std::unique_ptr<hbm::HbmEvaluator> evaluator_;
  std::unique_ptr<continuation::LinearSolver> solver_;
  continuation::Borders border_;
  continuation::Vector u_, p_, scales_, tangent_, z_, x_, F_p_;
  double amplitude_ = 0;
};

}  // namespace arcslip::observables
