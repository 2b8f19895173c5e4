#pragma once
// A slider in a plane over a period of Newmark's method: whether it rests, and where.

#include <arcslip/time/equation/period_map.hpp>

#include <memory>
#include <vector>

namespace arcslip::time {

/// A resting slider is put where harmonic balance has it, from the harmonics of the motion up to order 16:
/// with the mean force f of the element and the mean displacement q, at TimeLaw::memory_at(q, f). Each place
/// at which it may rest is a periodic motion, so that the harmonics left out change the choice alone.
class PlaneSlider {
 public:
  /// Whether the sliders of a law have several directions.
  static bool among(const std::vector<elements::Slider>& sliders);

  /// steps: per period. start: number of variables of the start, 2 dofs + sliders.
  PlaneSlider(const TimeElement& element, long steps, Eigen::Index start);

  /// At the end of the next step. x_start: dofs x start, the derivative of x by the start.
  void step(const Vector& x, const Vector& memory_change, const Eigen::Ref<const Matrix>& x_start);

  /// Each of its coordinates stuck throughout, or slipped in one direction only.
  bool rests() const;
  void add_to(std::vector<RestingSlider>& resting) const;

 private:
  struct Coordinate {
    int memory;     // of the element
    bool up, down;  // slips that way
  };

  const TimeElement* element_;
  elements::Harmonics harmonics_;
  std::unique_ptr<elements::Element> balance_;
  long steps_, done_ = 0;
  Vector u_, phi_;  // coefficients of the displacements; the basis at one angle
  Matrix u_start_;  // of u by the start
  std::vector<Coordinate> coordinates_;
};

}  // namespace arcslip::time
