#pragma once
// Extremes of a displacement on a piece of linear motion. Private.

#include <arcslip/time/event_driven/polynomial_roots.hpp>
#include <arcslip/time/event_driven/taylor_propagator.hpp>

#include <cmath>
#include <vector>

namespace arcslip::time {

/// Visits the extremes of d . x on the piece, its ends included, unless none of them can leave [lower,
/// upper].
class Extremes {
 public:
  template <class Visit>
  void visit(const LinearMotion& piece, const Vector& d, double s_end, double lower, double upper,
             Visit&& visit_extreme) {
    piece.displacement(d, series_);
    visit_series(s_end, lower, upper, visit_extreme);
  }
  // Those of the observed displacement.
  template <class Visit>
  void visit_observed(const LinearMotion& piece, double s_end, double lower, double upper,
                      Visit&& visit_extreme) {
    piece.observed(series_, velocity_);
    visit_series(s_end, lower, upper, visit_extreme);
  }

 private:
  template <class Visit>
  void visit_series(double s_end, double lower, double upper, Visit&& visit) {
    double swing = 0;
    for (std::size_t k = 1; k < series_.size(); ++k) swing += std::abs(series_[k]);
    if (series_[0] - swing > lower && series_[0] + swing < upper) return;
    visit(0.0, series_[0]);
    slope_.resize(series_.size() - 1);
    for (std::size_t k = 1; k < series_.size(); ++k) slope_[k - 1] = static_cast<double>(k) * series_[k];
    sign_changes(slope_, roots_);
    for (double s : roots_)
      if (s < s_end) visit(s, value(series_, s));
    visit(s_end, value(series_, s_end));
  }

  LinearMotion::Series series_{}, velocity_{};
  std::vector<double> slope_, roots_;
};

}  // namespace arcslip::time
