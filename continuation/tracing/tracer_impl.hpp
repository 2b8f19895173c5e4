#pragma once
// The parts of a tracer, and the loop around them: section 8 of the theory. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/correction/first_point.hpp>
#include <arcslip/continuation/correction/mode_crossings.hpp>
#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/event_locator.hpp>
#include <arcslip/continuation/tracing/interpolation_control.hpp>
#include <arcslip/continuation/tracing/jacobian_watch.hpp>
#include <arcslip/continuation/tracing/recorder.hpp>
#include <arcslip/continuation/tracing/state.hpp>
#include <arcslip/continuation/tracing/step_control.hpp>
#include <arcslip/continuation/tracing/termination.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/continuation/tracing/transverse_space.hpp>
#include <arcslip/continuation/tracing/trial_step.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::continuation {

class Tracer::Impl {
 public:
  /// state: that of a trace before its start, or of one that was saved. The problem has the scale of its free
  /// parameter.
  Impl(std::shared_ptr<const Problem> problem, State state, const Options& options,
       std::vector<Monitor> monitors, Observer observer);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool step();
  State save() const;
  Branch& branch() { return s_.branch; }

 private:
  /// What becomes of a step that is tried. rejected: a shorter one is tried, by the tangent and with new
  /// factors; unresolved: the corrector converged, but a shorter step is needed; again: the same one is
  /// tried, by Accept::last_correction; ended: the branch has ended.
  enum class Outcome { accepted, rejected, unresolved, again, ended };

  bool begin();  // tracer_start.cpp
  bool end_at_start(const FirstPoint& first, const Vector& guess, bool has_tangent);
  std::string singular_start(bool has_tangent) const;

  bool may_try();
  std::string why_too_small();
  Outcome attempt();
  std::optional<Outcome> correct();
  std::optional<Outcome> keep_to_branch();
  void locate_corners();
  Outcome refuse(Rejected why, double value, double limit, Outcome as = Outcome::rejected);
  void count_rejection();
  bool passes_corner_instead();
  std::optional<Outcome> look_for_crossing();
  bool locate_crossing(int modes);
  std::optional<Outcome> pass_unlocated_crossing(double smallest);
  std::optional<ModeCrossings> count_modes();
  bool changes_determinant(const std::optional<ModeCrossings>& crossed);
  bool is_kink();
  bool measure();
  bool settle_signs();
  void divide();
  bool is_as_expected();
  Outcome take(double next_step);
  Outcome end_at_bound(const Exit& exit);
  std::optional<Outcome> close_loop();
  bool accept();
  bool accept_state();
  bool leaves_the_state_of_the_start();

  bool corner();  // tracer_corners.cpp
  bool step_beyond_corner();

  void end_in_tail(double bound);
  bool end_at(const LocatedEvent& found);
  bool within_limits();
  bool end(StopReason reason, double value, double limit, std::string message);

  std::shared_ptr<const Problem> problem_;
  Options options_;
  control::Control timed_;  // with the limit of seconds
  std::vector<Monitor> monitors_;
  State s_;
  int n_;
  Corrector main_;
  EventLocator events_;
  bool counts_modes_;                   // in each step: branch points are monitored
  std::unique_ptr<ModeCounter> modes_;  // made at its first use
  TransverseSpace transverse_;
  StepControl control_;
  InterpolationControl interpolation_;
  JacobianWatch jacobian_;
  Recorder record_;
  TrialStep trial_;
  Vector row_, v_;            // n + 1
  Vector next_state_;         // of the problem
  long rejected_before_ = 0;  // steps, before the last point
};

}  // namespace arcslip::continuation
