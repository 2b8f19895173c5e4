#pragma once
// Exact motion of structures with piecewise linear laws: between two events, at which an element goes from
// one of its modes to another, the structure is linear, and its motion is a power series
// (taylor_propagator.hpp). The modes and their guards are those of the laws' automata (laws/automaton.hpp).
// For a slider with a spring:
//
//   stick:  f = k_d (q - z), z rests    until  |f| passes mu F_n
//   slip:   f = sigma mu F_n, z = q - sigma mu F_n/k_d    until  sigma q' falls below zero
//
// In each piece the guards are polynomials; their first roots are found with bounds of their curvature
// (polynomial_roots.hpp), so that no event is missed but those whose slip or return is below rounding, and
// are exact to the last digit. A guard that begins within rounding of zero is judged by where it goes; so
// several events in one instant, events at the start, grazing and slip again at once need no care of their
// own. x, x' and the forces are continuous at every event.
//
// At the start each element is in the first mode of its automata, after its memory was drawn to where it must
// be (TimeLaw::begin); guards decide the rest.
//
// Derivatives with respect to the start run along as columns of the same series. A memory that follows has
// those of what it follows from there on; the forces are continuous, so that nothing jumps. Source:
// docs/theory/09-event-driven.md.

#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/time/equation/parameter_derivatives.hpp>
#include <arcslip/time/equation/period_map.hpp>
#include <arcslip/time/equation/time_history.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::time {

/// A structure with a law that is not piecewise linear.
class NotPiecewiseLinear : public Error {
  using Error::Error;
};

struct ContactEvent {
  double time = 0;            // s
  int element = 0;            // index in EquationOfMotion::elements
  std::string_view from, to;  // modes of its law: "stick", "slip+"
};

enum class EndReason {
  reached,     // the end of the interval
  events,      // number of events >= EventLimits::events
  pieces,      // number of pieces >= EventLimits::pieces
  not_finite,  // the motion overflowed
  stopped,     // by EventLimits::control
};

/// Limits of one integration.
struct EventLimits {
  long events = 1'000'000;
  long pieces =
      20'000'000;  // power series: about one for each radian of the fastest mode, and one for each event
  control::Control control{};  // asked at intervals
};

/// One element with a contact over the interval.
struct FrictionRecord {
  std::string name;
  double stick_time = 0;              // s
  double open_time = 0;               // s, in separation
  double energy = 0;                  // dissipated, J
  double load_max = 0, load_min = 0;  // of the normal load, N, where Law::has_normal_load()
};

struct EventDrivenMotion {
  EndReason reason = EndReason::reached;
  std::string message;
  double time = 0;  // s, where it ended
  MotionState end;
  std::vector<ContactEvent> events;      // in the order of time
  std::vector<FrictionRecord> friction;  // of each element with a contact
  EnergyBalance energy;
  double amplitude = 0;       // max |response|, m
  double amplitude_time = 0;  // s
  TimeHistory history;        // at the requested instants
};

/// One period of the motion from a state at t = 0, for branches over a parameter.
struct Orbit {
  PeriodMap map;
  Vector by_parameter;              // d end/dp, of resting sliders that of the offset; empty if not requested
  std::uint64_t phases = 0;         // of contact: equal numbers where each contact goes through the same ones
  double amplitude = 0;             // max |response|, m
  Eigen::RowVectorXd amplitude_by;  // its derivative by (x, x', z) of the start and by p, if requested
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
  EventDrivenMotion integrate(const MotionState& start, double from, double to,
                              std::span<const double> instants = {});

  /// From 0 to `to`, with derivatives, for shooting.
  PeriodMap map(const MotionState& start, double to);

  /// Over equation().period(), which moves with omega. by: with the derivatives by the start and by the
  /// parameter of these rates; null: without derivatives.
  Orbit orbit(const MotionState& start, const EquationRates* by = nullptr);

 private:
  const EquationOfMotion equation_;
  std::unique_ptr<March> march_;
};

}  // namespace arcslip::time
