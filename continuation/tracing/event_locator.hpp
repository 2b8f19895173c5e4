#pragma once
// Location of events between two neighbouring points of a branch: sign changes of monitors.
//
// The zero is bracketed on the cubic between the points, with each trial corrected onto the branch; one that
// leads elsewhere, as next to a kink, starts between the places that are known. A step across kinks is
// divided there into smooth sections: an event lies within a section, or at a kink, if the values of the
// monitor on its two sides differ in sign.
//
// A monitor that is the slope of a quantity q has spurious zeros from rounding where q is flat. Zeros
// alternate between maxima and minima of q, and two neighbours q_1, q_2 with |q_1 - q_2| <= r cancel and are
// no events. So an extremum is certain once q has changed from it by more than r, usually in the same step;
// until then it is pending. r is measured: the spread of q near the extremum, over a part of the step in
// which the change of q itself is negligible. If q passes beyond a pending extremum by more than r without
// another sign change of its slope, q decides: the extremum moves along, from point to point.
//
// A monitor may have zeros that are not events (Monitor::is_event). The events located in a step do not
// depend on the steps before it: the probe is reset.

#include <arcslip/continuation/correction/curve_point.hpp>
#include <arcslip/continuation/correction/kink_location.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::continuation {

void append(std::vector<LocatedEvent>& found, std::vector<LocatedEvent>&& next);

class EventLocator {
 public:
  /// p: all parameters; free: index of the free one. courses: one for each monitor, or none yet. counts: work
  /// counters. Both must outlive this.
  EventLocator(std::shared_ptr<const Problem> problem, Vector p, int free, const Options& options,
               const std::vector<Monitor>& monitors, std::vector<Course>& courses, Counts& counts);

  /// Resets the probe, so that the events of a step do not depend on earlier steps, to the last bit.
  void forget() {
    if (probe_) probe_->forget();
    located_.clear();
  }

  /// The problem's state, for the steps that follow.
  void set_state(const Vector& state) {
    state_ = state;
    if (probe_) probe_->set_state(state);
  }

  /// Whether any monitor changes sign, in either direction.
  bool changes_sign(const CurvePoint& from, const CurvePoint& to) const;

  /// The kink at which the piece of `from` ends, within `length` along its tangent. towards: the direction
  /// beyond, if the signs of determinants are not known. Nothing if none is found.
  std::optional<PassedKink> corner(const CurvePoint& from, double length, const Vector& towards,
                                   double accuracy = finest_kink);

  /// Whether any monitor needs the kinks of a step.
  bool looks_for_kinks() const;

  /// The kinks of a step that were found, in order from `from`; empty if no monitor needs them. accuracy:
  /// where no monitor changes its sign on the way; else they are found as exactly as they can be.
  std::vector<PassedKink> corners(const CurvePoint& from, const CurvePoint& to,
                                  double accuracy = finest_kink);

  /// The points of a smooth section at which the part of a quantity changes (Monitor::part), in order.
  std::vector<PassedKink> divisions(const CurvePoint& from, const CurvePoint& to);

  /// The events that became certain with this section, in order of arclength. The caller sets `after`.
  std::vector<LocatedEvent> between(const CurvePoint& from, const CurvePoint& to);

  /// The same for a section with a branch point: matrices are singular there, and a zero next to it would be
  /// sought on either branch. So its two sides are searched separately, and a monitor that vanishes at the
  /// branch point has its zero there.
  std::vector<LocatedEvent> past(const CurvePoint& from, const CurvePoint& crossing, const CurvePoint& to);

  /// The events at a kink.
  std::vector<LocatedEvent> across(const PassedKink& corner);

  /// The branch point between two points of different orientation. Nothing if no branches cross: then `to` is
  /// on another branch. The event belongs to the first branch_point monitor, or has no name.
  std::optional<LocatedEvent> branch_point(const CurvePoint& from, const CurvePoint& to);

  /// The same for a rank loss of [J F_p] of 2 or more.
  std::optional<LocatedEvent> multiple_point(const CurvePoint& from, const CurvePoint& to, int rank_loss);

  /// An event as passed to monitors and observers: evaluator and factors are those at the event, until the
  /// next call. Nothing if it cannot be linearized.
  std::optional<Accepted> look_at(const CurvePoint& event);

 private:
  bool changes(std::size_t monitor, const CurvePoint& from, const CurvePoint& to, Crossing wanted) const;
  bool turns(const CurvePoint& from, const CurvePoint& to);
  std::optional<LocatedEvent> find(std::size_t monitor, const CurvePoint& from, const CurvePoint& to);
  std::optional<LocatedEvent> beyond_crossing(std::size_t monitor, const CurvePoint& crossing,
                                              const CurvePoint& to);
  std::optional<LocatedEvent> at_kink(std::size_t monitor, const CurvePoint& kink, const CurvePoint& beyond);
  std::optional<LocatedEvent> locate(std::size_t monitor, const CurvePoint& from, const CurvePoint& to);
  std::optional<LocatedEvent> locate_near_kink(std::size_t monitor, const CurvePoint& from,
                                               const CurvePoint& to);
  std::optional<LocatedEvent> crossing_event(const CurvePoint& from, const CurvePoint& to, const Vector& x,
                                             BranchPoint&& branches);
  LocatedEvent nearer_end(std::size_t monitor, const CurvePoint& from, const CurvePoint& to) const;
  LocatedEvent kink_event(const Monitor& monitor, const PassedKink& corner) const;
  std::optional<PassedKink> division(const CurvePoint& from, double length);
  std::vector<PassedKink> corners_within(const CurvePoint& from, const CurvePoint& to, double accuracy);
  bool locate_corner(const CurvePoint& from, double length, double accuracy, CurvePoint& kink);
  void take_limits(const CurvePoint& from, double length, CurvePoint& kink);
  bool pass(PassedKink& corner, double length, const Vector& towards, double accuracy);
  bool look_beyond(const CurvePoint& kink, double way, bool is_next_to_it, const Vector& towards,
                   CurvePoint& beyond);
  std::optional<Accepted> look_near(const CurvePoint& event);
  bool is_event(std::size_t monitor, const LocatedEvent& found);
  void describe(std::size_t monitor, LocatedEvent& found);
  bool refine(const Monitor& by, LocatedEvent& found);
  Event event(std::size_t monitor, const CurvePoint& place, double value, const Correction& correction) const;
  Corrector& probe();

  struct LocatedCorner {
    Vector from;
    double accuracy;
    PassedKink corner;
    bool has_beyond;  // the branch was found beyond it
  };

  using Find = std::optional<LocatedEvent> (EventLocator::*)(std::size_t, const CurvePoint&,
                                                             const CurvePoint&);
  std::vector<LocatedEvent> gather(Find by, const CurvePoint& from, const CurvePoint& to);
  void follow(std::size_t monitor, Find by, const CurvePoint& from, const CurvePoint& to,
              std::vector<LocatedEvent>& certain);
  void judge(Course& course, double q, std::vector<LocatedEvent>& certain);

  std::shared_ptr<const Problem> problem_;
  Vector p_;
  int free_;
  const Options& options_;
  const std::vector<Monitor>& monitors_;
  std::vector<Course>& courses_;
  Counts& counts_;
  Vector state_;                        // of the problem
  std::unique_ptr<Corrector> probe_;    // created at the first event
  std::vector<LocatedCorner> located_;  // since forget(): shorter attempts at a step meet them again
  bool from_crossing_ = false;          // the current section starts at a branch point
  std::vector<bool> zero_at_crossing_;  // which monitors vanish there
};

}  // namespace arcslip::continuation
