#pragma once
// Sensitivity of the amplitude of a response to parameters, subject to one condition that defines the point.
//
// With x = (u, omega), F(x, p) = 0 and one more equation r(x, p) = 0, dA/dp = A_p + A_x . dx/dp, where the
// linearized equations give dx/dp. One adjoint solve suffices for all parameters:
//
//   [ F_x ]^T [ w ]
//   [ r_x ]   [ g ]  =  A_x,        dA/dp_k = A_pk - w . F_pk - g r_pk.
//
//   at a frequency   r = omega - const: g = dA/domega along the branch.
//   at a resonance   A is stationary along the branch, so that g = 0 for any row r_x (envelope theorem):
//                    the tangent, so that the system is regular at folds, too.
//   at a corner      r = h, the slip limit of an element (hbm/grazing_problem.hpp) that defines the peak. F_x
//   and F_p
//                    jump along h_x and h_p: g absorbs the jump, and both sides give the same result.
//
// The second derivative requires no further solution. Along D_k = (dx/dp_k, e_k) F and r stay zero to
// first order. The second derivatives of both give F_x x_jk = -D_j.F'' D_k, so that x_jk drops out with
// A_x from above:
//
//   d2A/dp_j dp_k = D_j . L'' D_k = d/dh (L_x . dx/dp_k + L_pk)(x + h dx/dp_j, p + h e_j),   L = A - w.F - g
//   r
//
// at fixed w and g. With these, L has the gradient of A off the solution, too, so that a central difference
// of it has an error of order h^2. At a resonance g = 0, and the condition enters only by dx/dp_k. At a
// corner L is taken on the sticking side, where F is smooth: next to the onset of slip F'' is unbounded.
//
// Units: those of A, m, over those of p_k. A parameter that ties several fields has the sum of their
// derivatives.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/hbm/grazing_problem.hpp>
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

  /// x: a solution (u, omega), n + 1, at all parameters p; p[frequency] is ignored. parameters: indices k;
  /// gradient: dA/dp_k, one for each. False if the linearized equations are singular.
  bool at_frequency(continuation::In x, continuation::In p, std::span<const int> parameters,
                    continuation::Out gradient);
  bool at_resonance(continuation::In x, continuation::In p, std::span<const int> parameters,
                    continuation::Out gradient);
  bool at_corner(const hbm::Corner& corner, continuation::In x, continuation::In p,
                 std::span<const int> parameters, continuation::Out gradient);

  /// d2A/dp_j dp_k at the last gradient, symmetric. tangents: dx/dp_k of the tracked point, n + 1, one column
  /// for each parameter of that gradient. False: the smooth piece is too narrow for a difference.
  bool second_derivatives(const continuation::Matrix& tangents, Eigen::Ref<continuation::Matrix> second);

  /// Selects the extremum of the motion for A from now on: the one nearest to an angle, or the largest. If
  /// two are equally high A has a kink, but each of the two does not.
  void hold(std::optional<double> instant) { *instant_ = instant; }

  /// At the last solution: A, m, and g, the multiplier of the condition.
  double amplitude() const { return extreme_.amplitude; }
  const Extreme& extreme() const { return extreme_; }
  /// All extrema of the motion there.
  std::vector<Extreme> extremes() { return extremes_.all(x_); }
  double multiplier() const { return z_[z_.size() - 1]; }
  /// Its smooth piece of F.
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
  continuation::StationaryQuantity quantity_;
  Amplitude extremes_;
  std::unique_ptr<hbm::HbmEvaluator> evaluator_;
  std::unique_ptr<continuation::LinearSolver> solver_;
  continuation::Borders border_;
  continuation::Vector u_, p_, scales_, tangent_, z_, x_, F_p_;
  std::vector<int> parameters_;          // of the last gradient
  std::optional<hbm::Corner> corner_{};  // of the last gradient
  continuation::Vector u0_, p0_, L_x_;
  Extreme extreme_{};
};

}  // namespace arcslip::observables
