#include <arcslip/analyses/modes_and_time/frequency_sweep.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/time/periodic/period_integrator.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace arcslip::observables {
namespace {

constexpr double least_jump = 0.02;  // of the amplitude, relative: what is looked at
constexpr double least_growth = 2;   // of the change from one step to the next: likewise
constexpr double left_over = 0.25;   // of the change, in a part of the step: a jump
constexpr int step_halvings = 10;    // of the step
constexpr int most_motions = 60;     // motions sought within a step

using time::MotionState;
using time::Settled;

// One that was reached, and how.
struct Reached {
  double omega;
  Settled motion;
};

class Sweeping {
 public:
  Sweeping(const scene::Scene& scene, const SweepSettings& settings, const control::Control& control)
      : settings_(settings), to_rad_per_s_(scene::to_rad_per_s(scene.frequency_unit)), control_(control) {
    scene::Scene with = scene;
    with.harmonics.period = 1;
    unit_ = scene.frequency_unit;
    model_ = std::make_shared<const model::Model>(model::build(with));
    p_ = model::defaults(*model_);
    const double range = settings.to - settings.from;
    intervals_ = settings.spacing > 0 ? static_cast<long>(std::ceil(range / settings.spacing * (1 - 1e-12)))
                                      : settings.points - 1L;
    intervals_ = std::max(intervals_, 1L);
    progress_.item = "sweep";
    progress_.counted = "frequencies";
  }

  std::vector<FrequencySweep> run() {
    std::vector<FrequencySweep> all;
    if (settings_.direction != SweepDirection::down) all.push_back(sweep(SweepDirection::up));
    if (settings_.direction == SweepDirection::up || (!all.empty() && all[0].status != Status::complete))
      return all;
    all.push_back(sweep(SweepDirection::down));
    if (all.size() == 2) all[1].parent = 1;
    return all;
  }

 private:
  FrequencySweep sweep(SweepDirection direction) {
    const auto began = std::chrono::steady_clock::now();
    now_ = FrequencySweep();
    now_.direction = direction;
    now_.parameters = described(*model_).parameters;
    now_.steps = settings_.steps;
    try {
      time::check_response(*model_);
      if (go()) end(Status::complete, reasons::swept, "the sweep reached its last frequency");
    } catch (const time::NotInTime& error) {
      end(Status::failed, error.reason(), error.what());
    }
    now_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return std::move(now_);
  }

  bool end(Status status, const results::Reason& reason, const std::string& message) {
    now_.status = status;
    now_.stop = {reason, progress_.frequency, progress_.frequency, message};
    return false;
  }

  // False: end() was called.
  bool go() {
    last_change_ = 0;
    const bool up = now_.direction == SweepDirection::up;
    std::optional<Reached> last;
    for (long k = 0; k <= intervals_; ++k) {
      const long place = up ? k : intervals_ - k;
      const double share = static_cast<double>(place) / static_cast<double>(intervals_);
      const double frequency = settings_.from + share * (settings_.to - settings_.from);
      std::optional<Reached> reached = reach(frequency * to_rad_per_s_, state_);
      if (!reached) return false;
      add(*reached);
      if (last && !look_for_jump(*last, *reached)) return false;
      state_ = reached->motion.state;
      last = std::move(reached);
    }
    return true;
  }

  void add(const Reached& reached) {
    const Settled& motion = reached.motion;
    SweepPoint point;
    point.omega = reached.omega;
    point.amplitude = motion.amplitude;
    point.settled = motion.reason == time::SettleEnd::settled;
    point.period = motion.period;
    point.periods = motion.periods;
    point.change = motion.change;
    if (!motion.multipliers.empty()) point.largest_multiplier = std::abs(motion.multipliers.front());
    now_.points.push_back(point);
    progress_.points = static_cast<long>(now_.points.size());
  }

  // From a state at another frequency; none: from rest. Empty: end() was called.
  std::optional<Reached> reach(double omega, const std::optional<MotionState>& from) {
    p_[model::frequency] = omega;
    const time::EquationOfMotion equation = time::equation_of_motion(*model_, p_);
    const MotionState start = from ? *from : time::at_rest(equation);
    progress_.frequency = omega / to_rad_per_s_;
    const time::SettleOptions options{settings_.periods, longest_period, settings_.tolerance};
    while (true) {
      const bool between = !only_steps_;
      const Integrator integrator = choose(equation, start);
      if (!integrator.failure.code.empty()) {
        end(Status::failed, integrator.failure, integrator.message);
        return std::nullopt;
      }
      const time::Flow flow = [&](const MotionState& state) {
        return control_.keep_going() ? integrator.flow(state) : time::PeriodMap();
      };
      Settled motion = time::settle(integrator.periods, flow, integrator.start, equation.omega, options,
                                    [&](long periods, double) { return report(periods); });
      now_.periods += motion.periods;
      if (!control_.keep_going()) {
        end(Status::stopped, reasons::user, "stopped by the caller");
        return std::nullopt;
      }
      if (motion.reason != time::SettleEnd::failed) return Reached{omega, std::move(motion)};
      if (!between || motion.failure != reasons::event_limit) {
        end(Status::failed, motion.failure, motion.message);
        return std::nullopt;
      }
      only_steps_ = true;  // for the rest of the sweep
      now_.doubt = "from " + frequency_text(omega, unit_) +
                   " on in Newmark's steps, since a motion has too many events to be integrated exactly";
    }
  }

  Integrator choose(const time::EquationOfMotion& equation, const MotionState& start) {
    if (!only_steps_) {
      try {
        const time::EventLimits limits{affordable_events, affordable_pieces, control_};
        return note(between_events(equation, start, settings_.steps, limits));
      } catch (const time::NotPiecewiseLinear&) {
        only_steps_ = true;
      } catch (const time::SingularMass&) {
        only_steps_ = true;
      }
    }
    return note(in_steps(equation, start, settings_.steps, control_));
  }

  Integrator note(Integrator integrator) {
    if (now_.integrator.find(integrator.name) == std::string::npos)
      now_.integrator += (now_.integrator.empty() ? "" : ", ") + integrator.name;
    return integrator;
  }

  // False where the user stops.
  bool report(long periods) {
    const double within = static_cast<double>(periods) / settings_.periods;
    const double passed = static_cast<double>(now_.points.size()) + std::min(within, 0.99);
    const double half = settings_.direction == SweepDirection::up_down ? 0.5 : 1;
    const double before = half < 1 && now_.direction == SweepDirection::down ? 0.5 : 0;
    progress_.share_done = std::min(1.0, before + half * passed / static_cast<double>(intervals_ + 1));
    control_.report(progress_);
    return control_.keep_going();
  }

  static bool is_settled(const Reached& reached) { return reached.motion.reason == time::SettleEnd::settled; }

  // False: end() was called.
  bool look_for_jump(const Reached& from, const Reached& to) {
    const auto change = [](const Reached& a, const Reached& b) {
      return std::abs(a.motion.amplitude - b.motion.amplitude);
    };
    const double whole = change(from, to);
    const double last = std::exchange(last_change_, whole);
    const double size = std::max(from.motion.amplitude, to.motion.amplitude);
    const bool is_first = now_.points.size() == 2;  // there is nothing to compare with
    if (is_first || !(whole > least_jump * size && whole > least_growth * last) ||
        !(is_settled(from) || is_settled(to)))
      return true;
    const double jump = left_over * whole;
    const double least = 1.5 * std::ldexp(std::abs(to.omega - from.omega), -step_halvings);
    Reached a = from, b = to;
    for (int parts = 0; parts < most_motions; ++parts) {
      if (change(a, b) < jump) return true;
      const bool divide = std::abs(b.omega - a.omega) > least;
      std::optional<Reached> next = reach(divide ? 0.5 * (a.omega + b.omega) : b.omega, a.motion.state);
      if (!next) return false;
      if (divide) {
        const bool first = change(a, *next) >= change(*next, b);
        (first ? b : a) = std::move(*next);
        continue;
      }
      // b may have been reached in a larger step, which jumps where this one does not.
      if (change(a, *next) >= jump) return add_jump(a, *next, false);
      if (b.omega == to.omega) break;
      a = std::move(*next);
      b = to;
    }
    return add_jump(from, to, true);
  }

  bool add_jump(const Reached& a, const Reached& b, bool by_step) {
    now_.jumps.push_back(
        {a.omega, b.omega, a.motion.amplitude, b.motion.amplitude, now_.points.size() - 2, by_step});
    return true;
  }

  static constexpr int longest_period = 8;

  SweepSettings settings_;
  double to_rad_per_s_;
  scene::FrequencyUnit unit_{};
  const control::Control control_;
  control::Progress progress_;
  std::shared_ptr<const model::Model> model_;
  continuation::Vector p_;
  long intervals_ = 1;
  std::optional<MotionState> state_;  // of the last motion; at first none
  FrequencySweep now_;
  double last_change_ = 0;
  bool only_steps_ = false;
};

}  // namespace

std::string_view name(SweepDirection direction) {
  switch (direction) {
    case SweepDirection::up:
      return "up";
    case SweepDirection::down:
      return "down";
    case SweepDirection::up_down:
      break;
  }
  return "up-down";
}

std::vector<FrequencySweep> frequency_sweep(const scene::Scene& scene, const SweepSettings& settings,
                                            const control::Control& control) {
  return Sweeping(scene, settings, control).run();
}

}  // namespace arcslip::observables
