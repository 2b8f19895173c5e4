#pragma once
// What the automata of a law do along a given periodic motion: which mode they are in at each angle.

#include <arcslip/fourier/series.hpp>
#include <arcslip/laws/automaton.hpp>
#include <arcslip/results/contact_interval.hpp>

#include <array>
#include <vector>

namespace arcslip::time {

/// A change of the mode at an angle. by: the guard of the mode `from` that fell.
struct ModeChange {
  double theta = 0;  // rad, in [0, 2 pi)
  int from = 0, to = 0;
  const elements::Guard* by = nullptr;
};

/// first: the mode before the first change and after the last one; changes: by ascending angles, those of one
/// instant in their order. Holds addresses of the automaton's guards.
struct Course {
  int first = 0;
  std::vector<ModeChange> changes;
};

/// From the intervals that an element reports (Element::contact()), put in order. Where neighbours have no
/// guard between them, the modes on the shortest way are passed at that instant. False: a state that is no
/// mode.
bool course_of(const elements::Automaton& automaton, const std::vector<elements::ContactInterval>& intervals,
               Course& course);

/// A motion along several directions as power series over pieces of the period, for all automata of an
/// element.
class MotionSeries {
 public:
  static constexpr std::size_t terms = 21;
  static constexpr int in_group = 8;  // pieces
  using Series = std::array<double, terms>;
  struct Range {
    double low, high;
  };

  /// q: columns of coefficients, one for each direction.
  void expand(const elements::Harmonics& harmonics, const Eigen::MatrixXd& q);

  int pieces() const { return pieces_; }
  std::size_t directions() const { return directions_; }
  double length() const { return length_; }  // of a piece, rad
  int order() const { return order_; }
  double size() const { return size_; }  // of all coefficients

  /// The series of a direction over a piece, in s = 0 to 1.
  const Series& series(int piece, std::size_t direction) const {
    return series_[static_cast<std::size_t>(piece) * directions_ + direction];
  }
  /// Bounds of it, and of its derivative by the angle, over the group of pieces.
  const Range& displacement(int group, std::size_t direction) const {
    return displacements_[static_cast<std::size_t>(group) * directions_ + direction];
  }
  const Range& velocity(int group, std::size_t direction) const {
    return velocities_[static_cast<std::size_t>(group) * directions_ + direction];
  }

 private:
  int pieces_ = 0, order_ = 0;
  std::size_t directions_ = 0;
  double length_ = 0, size_ = 0;
  std::vector<Series> series_;
  std::vector<Range> displacements_, velocities_;
};

/// By the guards along a motion. A few periods are followed until the mode and the memory repeat; false: they
/// do not.
bool course_along(const elements::Automaton& automaton, const MotionSeries& motion, Course& course);

}  // namespace arcslip::time
