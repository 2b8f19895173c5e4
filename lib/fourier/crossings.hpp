#pragma once
// Where a motion passes a level: all roots of x(theta) = level over one period of a motion with a mean, found
// rigorously, without its reversals, of which there may be many more.
//
// x is sampled, and each interval is decided by a bound of its curvature, |x''| <= M = sum n^2 |X_n|, as in
// reversals.hpp. Where that does not tell soon, as where the motion just touches the level, the reversals
// within the interval do: x is monotone between them.

#include <arcslip/fourier/reversals.hpp>

#include <vector>

namespace arcslip::elements {

struct Crossing {
  double theta;
  bool rises;  // x goes above the level
};

class Crossings {
 public:
  /// harmonics: with a mean.
  explicit Crossings(const Harmonics& harmonics);

  /// In the order of theta, over one period. reversals: of the same harmonics. The reference holds until the
  /// next call.
  const std::vector<Crossing>& find(In u, double level, Reversals& reversals);

  /// Of the last search, where it has no crossing: whether x is above the level throughout.
  bool is_above() const { return above_; }

 private:
  struct Sample {
    double theta, excess;  // x - level
    bool above;
  };

  void search(In u, const Sample& from, const Sample& to, int depth, Reversals& reversals);
  void pass(In u, const Sample& from, const Sample& to);

  Harmonics harmonics_;
  int intervals_;
  double start_, step_;
  Eigen::MatrixXd values_;  // intervals x size: x at the grid
  Eigen::VectorXd samples_;
  std::vector<Crossing> found_;
  double level_ = 0, M_ = 0;
  bool above_ = false;
};

}  // namespace arcslip::elements
