#pragma once
// The inner problem at a point of a curve of special points, with an evaluator of its own that may be moved.
// Not installed.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>
#include <arcslip/continuation/special_points/augmented_evaluator.hpp>

#include <memory>
#include <stdexcept>

namespace arcslip::continuation {

/// Throws std::invalid_argument on other branches.
inline const AugmentedEvaluator& curve_of_points(const Accepted& now) {
  const auto* curve = dynamic_cast<const AugmentedEvaluator*>(&now.at);
  if (!curve) throw std::invalid_argument("this monitor is for curves of folds and of Hopf points");
  return *curve;
}

class PlaceOnCurve {
 public:
  explicit PlaceOnCurve(const Accepted& now) {
    const AugmentedEvaluator& curve = curve_of_points(now);
    evaluator_ = curve.inner().problem->evaluator();
    place_ = {curve.here().u(), curve.here().p(), curve.inner().along, curve.inner().scales()};
  }

  Evaluator& at() const { return *evaluator_; }
  const PlaceOfForms& place() const { return place_; }

 private:
  std::unique_ptr<Evaluator> evaluator_;
  PlaceOfForms place_;
};

}  // namespace arcslip::continuation
