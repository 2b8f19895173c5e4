#pragma once
// Exact motion of structures with friction: between two events, slip onset or slip end, the structure is
// linear, and its motion is a power series (linear_motion.hpp). Jenkins elements only.
//
//   stick:  f = k_d (q - z), z rests    until  |f| passes mu F_n
//   slip:   f = sigma mu F_n, z = q - sigma mu F_n/k_d    until  sigma q' falls below zero
//
// In each piece both conditions are polynomials; their first roots are found with bounds of their curvature
// (polynomial.hpp), so that no event is missed but those whose slip or return is below rounding, and are
// exact to the last digit. A condition that begins within rounding of zero is judged by where it goes; so
// several events in one instant, events at the start, grazing and slip again at once need no care of their
// own. x, x' and x'' are continuous at every event. An element without normal load follows without force.
//
// Contact at the start follows from the state: |f| < mu F_n sticks; at the limit the motion decides. A slider
// that is beyond its limit is drawn after, |f| = mu F_n.
//
// Derivatives with respect to the start run along as columns of the same series. At a slip onset dz := dq
// from there on; at a slip end q' = 0, so that nothing jumps. Source: docs/theory.md, section 9.

#include <arcslip/time/motion.hpp>
#include <arcslip/time/period_map.hpp>

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>

namespace arcslip::time {

/// A scene with a law that is not piecewise linear.
class NotPiecewiseLinear : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A degree of freedom without mass: its motion has no state of its own.
class SingularMass : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class EventKind { slip_onset, slip_end };

struct ContactEvent {
  double time = 0;  // s
  int element = 0;  // index in EquationOfMotion::elements
  EventKind kind = EventKind::slip_onset;
  int direction = 0;  // sign of the slip velocity
};

enum class EndReason {
  reached,     // the end of the interval
  events,      // number of events >= EventLimits::events
  pieces,      // number of pieces >= EventLimits::pieces
  not_finite,  // the motion grew beyond all numbers
  stopped,     // EventLimits::stop was asked for
};

/// What one integration may cost.
struct EventLimits {
  long events = 1'000'000;
  long pieces =
      20'000'000;  // power series: about one for each radian of the fastest mode, and one for each event
  std::function<bool()> stop{};  // asked now and then; true ends it
};

/// One friction element over the interval.
struct FrictionRecord {
  std::string name;
  double stick_time = 0;  // s
  double energy = 0;      // dissipated, J
};

struct EventDrivenMotion {
  EndReason reason = EndReason::reached;
  std::string message;
  double time = 0;  // s, where it ended
  State end;
  std::vector<ContactEvent> events;      // in the order of time
  std::vector<FrictionRecord> friction;  // of each Jenkins element
  EnergyBalance energy;
  double amplitude = 0;       // max |response|, m
  double amplitude_time = 0;  // s
  History history;            // at the instants asked for
};

class March;

/// For one equation of motion; keeps its factors and buffers.
class EventDriven {
 public:
  /// Throws NotPiecewiseLinear, SingularMass.
  explicit EventDriven(const EquationOfMotion& equation, const EventLimits& limits = {});
  ~EventDriven();
  EventDriven(const EventDriven&) = delete;

  const EquationOfMotion& equation() const { return equation_; }

  /// instants: ascending, in [from, to].
  EventDrivenMotion integrate(const State& start, double from, double to,
                              std::span<const double> instants = {});

  /// From 0 to `to`, with derivatives, for shooting.
  PeriodMap map(const State& start, double to);

 private:
  const EquationOfMotion equation_;
  std::unique_ptr<March> march_;
};

}  // namespace arcslip::time
