#pragma once
// The derivative of a vector by differences with ever shorter steps, row by row. Not installed.

#include <arcslip/continuation/problem/problem.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {

constexpr double step_ratio = 1.0 / 32;  // q, of one step to the next

/// Chooses among central differences D_0, D_1, ... with steps in the ratio q. The change from one to
/// the next is the error of truncation of the former, which falls like q^2, or that of rounding of the
/// latter, which grows like 1/q. So each row takes the first D that the next one confirms, or else those
/// between which it changed least. A row that no two steps agree on is noise, which grows from D_0 on, or a
/// zero as of p^3 at 0, of which D falls: it takes the smallest D.
class StepSearch {
 public:
  explicit StepSearch(Eigen::Index n)
      : smallest_(n), before_(n), last_(n), best_(n), change_(n), settled_(n) {}

  void begin(In D) {
    smallest_ = before_ = last_ = best_ = D;
    change_.setConstant(1);
    settled_.setConstant(false);
  }

  /// False: all rows are settled, a further D would change nothing.
  bool add(In D) {
    for (Eigen::Index i = 0; i < D.size(); ++i)
      if (!settled_[i]) judge(i, D[i]);
    before_ = last_;
    last_ = D;
    return !settled_.all();
  }

  const Vector& best() const { return best_; }

 private:
  static constexpr double confirmed = 1e-8;     // relative change
  static constexpr double resolved = 0.1;       // more: steps longer than what F shows there, or noise
  static constexpr double rounding_growth = 4;  // of the change: more is the growth of rounding alone
  static constexpr double truncation_decay = 1 / (step_ratio * step_ratio);

  void judge(Eigen::Index i, double now) {
    const double size = std::max(std::abs(now), std::abs(last_[i]));
    const double change = size > 0 ? std::abs(now - last_[i]) / size : 0;
    if (std::abs(now) < std::abs(smallest_[i])) smallest_[i] = now;
    const bool grows = change_[i] < resolved && !(change < change_[i]);
    settled_[i] = grows || change <= confirmed;
    const bool truncation = change_[i] < 1 && change * truncation_decay <= 2 * change_[i];
    if (change <= confirmed)
      best_[i] = truncation ? now : last_[i];
    else if (grows)
      best_[i] = change < rounding_growth * change_[i] ? last_[i] : before_[i];
    else
      best_[i] = change < resolved ? now : smallest_[i];
    change_[i] = change;
  }

  Vector smallest_, before_, last_, best_, change_;
  Eigen::Array<bool, Eigen::Dynamic, 1> settled_;
};

}  // namespace arcslip::continuation
