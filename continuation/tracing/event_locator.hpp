#pragma once
// Events between two neighbouring points of a branch: where a monitor changes its sign.
//
// The zero is bracketed on the cubic between the points, each trial corrected onto the branch. A step across
// kinks is several smooth sections, which end and begin there: an event lies within a section, or at a kink,
// where the values of the monitor on its two sides differ in sign.
//
// A monitor that is the slope of a quantity q has zeros from rounding where q is flat. Zeros alternate
// between maxima and minima of q, and two neighbours q_1, q_2 with |q_1 - q_2| <= r are no events: they
// cancel. So an extreme is certain once q has departed from it by more than r, which is in the same step
// unless q changes so little in it that r matters; till then it waits. r is measured: the spread of q beside
// the extreme, over a part of the step in which the change of q itself is negligible. Where q goes on beyond
// a waiting extreme by more than r, while its slope has not changed its sign again, q is right: the extreme
// moves along, from point to point.
//
// A monitor may have zeros that are no events (Monitor::is_event). What is located in a step does not depend
// on the steps before it: the probe forgets.

#include <arcslip/continuation/tracing/place.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::continuation {

void append(std::vector<LocatedEvent>& found, std::vector<LocatedEvent>&& next);

class EventLocator {
 public:
  /// p: all parameters; free: index of the free one. courses: as many as monitors, or none yet. counts: where
  /// the work is added up. Both outlive this.
  EventLocator(std::shared_ptr<const Problem> problem, Vector p, int free, const Options& options,
               const std::vector<Monitor>& monitors, std::vector<Course>& courses, Counts& counts);

  /// So that the events of a step do not depend on the steps before it, to the last bit.
  void forget() {
    if (probe_) probe_->forget();
  }

  /// Whether any monitor changes its sign, in whichever direction.
  bool changes_sign(const Place& from, const Place& to) const;

  /// The kink at which the piece of `from` ends, within `length` along its tangent. towards: which side is
  /// beyond, where the signs of determinants are not known. Nothing where none is found.
  std::optional<Corner> corner(const Place& from, double length, const Vector& towards);

  /// Whether a monitor is one of kinks, or the slope of a quantity that is divided there.
  bool looks_for_kinks() const;

  /// The kinks of a step, in order, where they are looked for; otherwise a step is taken as it is. From
  /// `from` on, as many as are found.
  std::vector<Corner> corners(const Place& from, const Place& to);

  /// Where within a smooth section a quantity goes over from one of several to another, in order.
  std::vector<Corner> divisions(const Place& from, const Place& to);

  /// The events that have become certain with this section, in the order of arclength. `after` is left to the
  /// caller.
  std::vector<LocatedEvent> between(const Place& from, const Place& to);

  /// The same where the branch passes a branch point on the way: matrices are singular there, and a zero
  /// beside it would be sought on either branch. So its two sides are searched by themselves, and a monitor
  /// that vanishes at the branch point has its zero there.
  std::vector<LocatedEvent> past(const Place& from, const Place& crossing, const Place& to);

  /// The same for a kink.
  std::vector<LocatedEvent> across(const Corner& corner);

  /// The branch point between two places whose orientations differ: where two branches cross. Nothing where
  /// none do: then `to` is on another branch. The event is the first branch_point monitor's, or has no name.
  std::optional<LocatedEvent> branch_point(const Place& from, const Place& to);

  /// The same where [J F_p] loses `rank_loss` ranks at once, 2 or more.
  std::optional<LocatedEvent> multiple_point(const Place& from, const Place& to, int rank_loss);

  /// An event as monitors and observers see it: evaluator and factors are those there, until the next call.
  /// Nothing where it cannot be linearized.
  std::optional<Accepted> look_at(const Place& event);

 private:
  bool changes(std::size_t monitor, const Place& from, const Place& to, Crossing wanted) const;
  bool turns(const Place& from, const Place& to);
  std::optional<LocatedEvent> find(std::size_t monitor, const Place& from, const Place& to);
  std::optional<LocatedEvent> beyond_crossing(std::size_t monitor, const Place& crossing, const Place& to);
  std::optional<LocatedEvent> at_kink(std::size_t monitor, const Place& kink, const Place& beyond);
  std::optional<LocatedEvent> locate(std::size_t monitor, const Place& from, const Place& to);
  std::optional<LocatedEvent> locate_beside_kink(std::size_t monitor, const Place& from, const Place& to);
  std::optional<LocatedEvent> crossing_event(const Place& from, const Place& to, const Vector& x,
                                             BranchPoint&& branches);
  LocatedEvent nearer_end(std::size_t monitor, const Place& from, const Place& to) const;
  LocatedEvent kink_event(const Monitor& monitor, const Corner& corner) const;
  std::optional<Corner> division(const Place& from, double length);
  bool look_beyond(const Place& kink, double way, bool is_next_to_it, const Vector& towards, Place& beyond);
  bool is_event(std::size_t monitor, const LocatedEvent& found);
  void describe(std::size_t monitor, LocatedEvent& found);
  Event event(std::size_t monitor, const Place& place, double value, const Correction& correction) const;
  Corrector& probe();

  using Find = std::optional<LocatedEvent> (EventLocator::*)(std::size_t, const Place&, const Place&);
  std::vector<LocatedEvent> gather(Find by, const Place& from, const Place& to);
  void follow(std::size_t monitor, Find by, const Place& from, const Place& to,
              std::vector<LocatedEvent>& certain);
  void judge(Course& course, double q, std::vector<LocatedEvent>& certain);

  std::shared_ptr<const Problem> problem_;
  Vector p_;
  int free_;
  const Options& options_;
  const std::vector<Monitor>& monitors_;
  std::vector<Course>& courses_;
  Counts& counts_;
  std::unique_ptr<Corrector> probe_;    // made when the first event is met
  bool from_crossing_ = false;          // the section that is searched begins at a branch point
  std::vector<bool> zero_at_crossing_;  // which monitors vanish there
};

}  // namespace arcslip::continuation
