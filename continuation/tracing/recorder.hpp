#pragma once
// Records an accepted step: its points and events, in the branch and for the observer. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/stability/spectrum_finder.hpp>
#include <arcslip/continuation/tracing/event_locator.hpp>
#include <arcslip/continuation/tracing/state.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/continuation/tracing/trial_step.hpp>

#include <optional>
#include <string>
#include <vector>

namespace arcslip::continuation {

class Recorder {
 public:
  /// All but the observer outlive this.
  Recorder(const Options& options, const std::vector<Monitor>& monitors, Observer observer, State& state,
           Corrector& corrector, EventLocator& events)
      : options_(options),
        monitors_(monitors),
        observer_(std::move(observer)),
        s_(state),
        main_(corrector),
        events_(events) {
    if (options.stability) spectra_.emplace(*options.stability);
  }

  /// A point of the branch.
  void keep(const CurvePoint& place, const Correction& correction);

  /// The spectrum of the last point, for which the corrector has J, where it is to have one, as at an event.
  void add_spectrum(bool is_event = false);

  /// Where a monitor is NaN, its zeros are missed: a warning of the branch, once for each monitor.
  void warn_of_undefined(const CurvePoint& place);

  /// The events of a step from the last point, section by section, with those of its corners, and the branch
  /// point on the way. False: the observer said stop.
  bool events_of(TrialStep& trial);

  /// The first terminal event, if one was met: the branch ends there.
  const std::optional<LocatedEvent>& terminal() const { return terminal_; }

  bool has_observer() const { return static_cast<bool>(observer_); }

  /// The last point to the observer. is_there: the evaluator is there already. False: it said stop.
  bool show_last_point(bool is_there);

 private:
  bool wants_spectrum() const;  // the last point
  void take_spectrum(const Evaluator& at);
  bool pass(const CurvePoint& from, const PassedKink& corner);
  bool report(std::vector<LocatedEvent>&& found);
  void warn_of_unlocated(const Event& event);
  void warn_once(const std::string& start, const std::string& rest);
  const Event* add(Event&& event);

  const Options& options_;
  const std::vector<Monitor>& monitors_;
  Observer observer_;
  State& s_;
  Corrector& main_;
  EventLocator& events_;
  std::optional<LocatedEvent> terminal_;
  std::optional<SpectrumFinder> spectra_;
  std::size_t events_before_ = 0;  // of the branch, at the last spectrum
};

}  // namespace arcslip::continuation
