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
//   at a corner      r = h, the slip limit of an element (hbm/corner.hpp), on which the peak sits. F_x
//                    and F_p jump along h_x and h_p: g takes up the jump, and both sides give the same.
//
// The second derivative needs no other solution. Along D_k = (dx/dp_k, e_k) F and r stay zero to first order.
// Differentiated twice, both have F_x x_jk = -D_j.F'' D_k, so that with A_x from above x_jk drops out:
//
//   d2A/dp_j dp_k = D_j . L'' D_k = d/dh (L_x . dx/dp_k + L_pk)(x + h dx/dp_j, p + h e_j),   L = A - w.F - g
//   r
//
// at fixed w and g. At these the gradient of L is that of A wherever it is asked for, solution or not, so
// that a central difference of it is good to h^2. r has to say what moves the place: at a resonance g = 0,
// and only dx/dp_k knows of it. At a corner L is taken on the side that sticks, where F is smooth: beside
// slip that has just begun F'' grows without bound.
//
// Units: those of A, m, over those of p_k. A parameter that ties several fields has the sum of their
// derivatives.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/hbm/corner.hpp>
#include <arcslip/observables/amplitude.hpp>

#include <cstdint>
#include <memory>
#include <optional>
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
  bool at_corner(const hbm::Corner& corner, continuation::In x, continuation::In p,
                 std::span<const int> parameters, continuation::Out gradient);

  /// d2A/dp_j dp_k where the last gradient was, symmetric. tangents: dx/dp_k of what is followed there, n +
  /// 1, a column for each parameter of that gradient. False: no room for a difference within one smooth
  /// piece.
  bool second_derivatives(const continuation::Matrix& tangents, Eigen::Ref<continuation::Matrix> second);

  /// Of which extreme of the motion A is from here on: that nearest to an angle, or the largest. At a
  /// frequency two may be as high: A has a kink there, but each of the two has none.
  void hold(std::optional<double> instant) { *instant_ = instant; }

  /// At the last solution: A, m, and g, the multiplier of the condition.
  double amplitude() const { return extreme_.amplitude; }
  const Extreme& extreme() const { return extreme_; }
  /// All extremes of the motion there.
  std::vector<Extreme> extremes() { return extremes_.all(x_); }
  double multiplier() const { return z_[z_.size() - 1]; }
  /// The smooth piece of F that it is in.
  std::uint64_t piece() const { return evaluator_->piece(); }

 private:
  bool move_to(continuation::In x, continuation::In p);
  bool factorize();
  bool differentiate(std::span<const int> parameters, continuation::Out gradient);
  bool condition_derivatives(continuation::Out gradient);
  bool side_below();
  void slopes_of_lagrangian(const continuation::Matrix& tangents, continuation::Out slopes);

  std::shared_ptr<const hbm::HbmProblem> problem_;
  std::shared_ptr<std::optional<double>> instant_;
  continuation::Quantity quantity_;
  Amplitude extremes_;
  std::unique_ptr<hbm::HbmEvaluator> evaluator_;
  std::unique_ptr<continuation::LinearSolver> solver_;
  continuation::Borders border_;
  continuation::Vector u_, p_, scales_, tangent_, z_, x_, F_p_;
  std::vector<int> parameters_;          // of the last gradient
  std::optional<hbm::Corner> corner_{};  // at which the place of the last gradient is held
  continuation::Vector u0_, p0_, L_x_;
  Extreme extreme_{};
};

}  // namespace arcslip::observables
