#pragma once
// What one automaton does at samples of a period: at each a slider rests where it was at the sample before,
// or is moved to a bound.
//
// The march begins where the slider surely is at a bound, where its lower one is highest, or in separation,
// so that one period of it is periodic. Where no bound moves it the slider sticks at all samples.

#include <arcslip/fourier/series.hpp>
#include <arcslip/laws/automaton.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace arcslip::elements {

class AutomatonSamples {
 public:
  /// The motion is seen from the first sample on; where it is antisymmetric, its second half as the first one
  /// with the other sign.
  struct Sample {
    int mode = 0;
    double sign = 1;
    double z = 0;  // as seen
    // Where the slider was at a bound last, in which mode, and with which sign that is seen.
    int anchor = 0, anchor_mode = 0;
    double anchor_sign = 1;
  };

  /// count: samples in one span of the harmonics.
  AutomatonSamples(Automaton automaton, const Harmonics& harmonics, int count);

  /// With other numbers.
  void renew(Automaton automaton);

  /// q: a row for each sample.
  void follow(const Eigen::MatrixXd& q);

  const Automaton& automaton() const { return automaton_; }
  const Mode& mode(int m) const { return automaton_.modes[static_cast<std::size_t>(m)]; }
  const Sample& at(int s) const { return samples_[static_cast<std::size_t>(s)]; }
  int first() const { return first_; }
  bool slides() const { return automaton_.memory >= 0; }
  bool holds(const Mode& mode) const { return slides() && mode.rests; }
  std::uint64_t piece() const { return piece_; }

  /// Whether the slider sticks at all samples: z = stuck().lower * (its lower bound where that is highest) +
  /// stuck().upper * (its upper bound where that is lowest).
  bool sticks() const { return sticks_; }
  const StuckSlider& stuck() const { return stuck_; }
  int lower_mode() const { return lower_; }
  int upper_mode() const { return upper_; }
  int highest() const { return highest_; }
  int lowest() const { return lowest_; }

  /// The force where the displacements are those of a row of q, after a sample, N.
  Eigen::VectorXd force_after(int sample, const Eigen::MatrixXd& q, int row) const;

  /// z_q q + z_0 of a mode, at a sample as seen.
  static double bound(const Mode& mode, const Eigen::MatrixXd& q, int s, double sign = 1);
  static double moving_bound(const Mode& mode, const Eigen::MatrixXd& q, int s);  // z_q q

 private:
  void locate(const Eigen::MatrixXd& q, int s, Sample& at) const;
  bool opens(const Eigen::MatrixXd& q);
  bool find_bounds(const Eigen::MatrixXd& q);
  void stick(double high, double low);
  void march(const Eigen::MatrixXd& q, bool at_bound);

  Automaton automaton_;
  bool odd_, has_open_ = false, sticks_ = false;
  int lower_ = 0, upper_ = 0;  // the modes in which the slider is at these bounds
  int first_ = 0, highest_ = 0, lowest_ = 0;
  double first_sign_ = 1;
  StuckSlider stuck_;
  std::vector<Sample> samples_;
  std::uint64_t piece_ = 0;
};

/// The force of automata at some angles (rad) of the motion u, as in Element::move_to, with the sliders where
/// they were at the last of `samples` in a period: angles x directions, N.
Eigen::MatrixXd sampled_force(const std::vector<Automaton>& automata, const Harmonics& harmonics, In u,
                              int samples, std::span<const double> angles);

}  // namespace arcslip::elements
