#pragma once
// Events between two neighbouring points of a branch: where a monitor changes its sign.
//
// The zero is bracketed on the cubic between the points, each trial corrected onto the branch. A step that
// turns at a kink is two smooth sections, which end and begin there: an event lies before the kink, at it, or
// beyond it.

#include <arcslip/continuation/place.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::continuation {

/// An event, and the place where it is.
struct LocatedEvent {
  Event event;
  Place place;
};

class EventLocator {
 public:
  /// p: all parameters; free: index of the free one. counts: where the work is added up; outlives this.
  EventLocator(std::shared_ptr<const Problem> problem, Vector p, int free, const Options& options,
               std::vector<Monitor> monitors, Counts& counts);

  const std::vector<Monitor>& monitors() const { return monitors_; }

  /// Whether any monitor changes its sign, in whichever direction.
  bool changes_sign(const Place& from, const Place& to) const;

  /// All events of the step, in the order of arclength. `after` is left to the caller.
  std::vector<LocatedEvent> between(const Place& from, const Place& to);

  /// An event as monitors and observers see it: evaluator and factors are those there, until the next call.
  /// Nothing where it cannot be linearized.
  std::optional<Accepted> look_at(const Place& event);

 private:
  bool changes(std::size_t monitor, const Place& from, const Place& to, Crossing wanted) const;
  bool turns(const Place& from, const Place& to);
  std::optional<LocatedEvent> locate(std::size_t monitor, const Place& from, const Place& to);
  std::optional<LocatedEvent> locate_beside_kink(std::size_t monitor, const Place& from, const Place& to);
  LocatedEvent nearer_end(std::size_t monitor, const Place& from, const Place& to) const;
  Event event(std::size_t monitor, const Place& place, double value, const Correction& correction) const;
  Corrector& probe();

  std::shared_ptr<const Problem> problem_;
  Vector p_;
  int free_;
  Options options_;
  std::vector<Monitor> monitors_;
  Counts& counts_;
  std::unique_ptr<Corrector> probe_;  // made when the first event is met
};

}  // namespace arcslip::continuation
