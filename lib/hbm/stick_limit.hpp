#pragma once
// The corners of frequency branches where a Jenkins element passes from full stick to slip: there
//
//   h = k_d (max w - min w)/2 - mu F_n = 0,
//
// w the motion along the element. J jumps by rank one across h = 0, along grad h, so that a branch has two
// tangents there, and a peak or a fold may sit at the corner while another parameter changes.

#include <arcslip/continuation/stationary.hpp>
#include <arcslip/elements/reversals.hpp>
#include <arcslip/hbm/problem.hpp>

#include <memory>
#include <optional>

namespace arcslip::hbm {

/// h (N) and its gradients at one place. Owns its buffers.
class StickLimit {
 public:
  /// element: index of a Jenkins element of the model.
  StickLimit(const HbmProblem& problem, int element);

  /// dh: dh/du, n. nullopt: the element does not move.
  std::optional<double> at(In u, In p, Out dh);

  /// dh/dp_k at the last place.
  double parameter_derivative(int k) const;

  /// mu F_n at the last place.
  double limit() const { return friction_ * load_; }

 private:
  Harmonics harmonics_;
  std::vector<int> parameters_;  // k_d, mu, F_n
  std::vector<std::pair<int, double>> direction_;
  elements::Reversals reversals_;
  Vector motion_, phi_;
  double stiffness_ = 0, friction_ = 0, load_ = 0, range_ = 0;
};

/// F = 0, h = 0 as a problem in the unknowns (u, omega) and the same parameters; p[frequency] is not looked
/// at.
std::shared_ptr<const continuation::Problem> stick_limit_points(std::shared_ptr<const HbmProblem> problem,
                                                                int element);

/// Slopes dq/ds of a quantity on both sides of such a corner, along the branch over the frequency in the
/// orientation det [J F_omega; t^T] > 0, which is the same on both sides. direction: +1 where that leads from
/// stick to slip, -1 from slip to stick. NaN where a side has no tangent.
struct CornerSlopes {
  double stick = 0, slip = 0;
  int direction = 0;
  bool is_maximum() const { return direction * stick > 0 && direction * slip < 0; }
  bool is_extreme() const { return stick * slip < 0; }
};

class Corner {
 public:
  Corner(std::shared_ptr<const HbmProblem> problem, int element, continuation::Quantity quantity);

  /// x: (u, omega); p[frequency] is not looked at.
  CornerSlopes slopes(In x, In p);

 private:
  double slope(double side, int& direction);

  std::shared_ptr<const HbmProblem> problem_;
  StickLimit limit_;
  continuation::Quantity quantity_;
  std::unique_ptr<HbmEvaluator> evaluator_;
  std::unique_ptr<continuation::LinearSolver> solver_;
  continuation::Borders border_;
  Vector u_, beside_, p_, dh_, dq_, t_, scales_;
};

}  // namespace arcslip::hbm
