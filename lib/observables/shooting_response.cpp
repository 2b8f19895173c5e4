#include <arcslip/observables/shooting_response.hpp>

#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/integrator.hpp>
#include <arcslip/observables/reasons.hpp>
#include <arcslip/observables/shooting_observer.hpp>
#include <arcslip/observables/study_branches.hpp>
#include <arcslip/observables/unbounded.hpp>
#include <arcslip/time/from_harmonics.hpp>
#include <arcslip/time/periodicity.hpp>
#include <arcslip/time/shooting.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::StopReason;

class Shooting {
 public:
  Shooting(const scene::Scene& scene, const FrequencyRange& range, const ProgressCallback& progress)
      : unit_(scene.frequency_unit),
        per_unit_(scene::to_rad_per_s(unit_)),
        window_{range.from * per_unit_, range.to * per_unit_},
        stability_(range.stability),
        progress_(progress),
        model_(std::make_shared<const model::Model>(model::build(scene))),
        result_(described(*model_)) {
    result_.harmonics.clear();
    result_.symmetry = Symmetry::none;
    told_.frequency = range.from;
  }

  ResponseBranch run() {
    const auto began = std::chrono::steady_clock::now();
    try {
      time::check_response(*model_);
      trace();
    } catch (const time::NotPiecewiseLinear& error) {
      refuse(reasons::not_piecewise_linear, error.what());
    } catch (const time::SingularMass& error) {
      refuse(reasons::massless, error.what());
    } catch (const time::NotInTime& error) {
      refuse(error.reason(), error.what());
    }
    result_.solver.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return std::move(result_);
  }

 private:
  void refuse(const results::Reason& reason, const std::string& why) {
    result_.status = Status::failed;
    result_.stop = {reason, 0, 0, why + "; use the method harmonic_balance"};
  }

  void trace() {
    const double from = window_.lower, width = window_.upper - window_.lower;
    const double omega = model_->harmonics.base_frequency(0.5 * (window_.lower + window_.upper));
    const time::EventLimits limits{affordable_events, affordable_pieces, [this] { return !go_on(); }};
    const time::ShootingProblem unscaled(model_, 1, omega, width, limits);
    result_.solver.unknowns = unscaled.size();
    if (const auto growth = unbounded_resonance(model_, from); growth.unbounded)
      return tell_end({StopReason::start_failed, from, 0, growth.message}, from, window_.upper, unit_,
                      result_);
    continuation::Vector p = continuation::parameter_values(unscaled);
    p[model::frequency] = from;
    const time::ShootingResult first = first_motion(p, limits);
    if (stopped_)
      return tell_end({StopReason::user, 1, 1, "stopped by the caller"}, from, window_.upper, unit_, result_);
    if (!first.converged())
      return tell_end({StopReason::start_failed, from, 0, first.message}, from, window_.upper, unit_,
                      result_);
    const double displacement = first.map.size > 0 ? first.map.size : 1;
    const auto problem =
        std::make_shared<const time::ShootingProblem>(model_, displacement, omega, width, limits);
    const auto observer = std::make_shared<ShootingObserver>(problem);
    double last = from;
    const auto record = [&](const continuation::Accepted& now, const continuation::Event* event) {
      ResponsePoint point = observer->observe(now);
      if (event) {
        result_.events.push_back(
            {event->monitor, event->nonsmooth, event->located, std::move(point), event->after});
        set_apart(result_.events.back().kind, result_.events.back().point);
        return true;
      }
      result_.points.push_back(std::move(point));
      ++told_.points;
      told_.frequency = now.parameter / per_unit_;
      told_.step = (now.parameter - last) / per_unit_;
      told_.share_done = std::clamp((now.parameter - window_.lower) / width, 0.0, 1.0);
      last = now.parameter;
      return go_on();
    };
    continuation::Branch branch =
        continuation::trace(problem, {time::stacked(first.start), p, model::frequency, 1},
                            frequency_options(window_, Steps::curve, [this] { return go_on(); }),
                            shooting_monitors(observer, stability_), record);
    add(branch.counts, result_.solver);
    tell_end(branch.stop, from, window_.upper, unit_, result_);
  }

  // From the response of harmonic balance, or from rest where there is none.
  time::ShootingResult first_motion(const continuation::Vector& p, const time::EventLimits& limits) {
    time::EventDriven integrator(time::equation_of_motion(*model_, p), limits);
    const time::EquationOfMotion& equation = integrator.equation();
    const time::Flow flow = [&](const time::MotionState& start) {
      return integrator.map(start, equation.period());
    };
    const FirstResponse found =
        first_response(model_, window_.lower, window_.upper - window_.lower, [this] { return go_on(); });
    if (found.u) {
      const auto at = hbm::parameters_at(*found.problem, window_.lower);
      const time::MotionState start = time::state_of(*found.problem, *found.u, at);
      auto motion = time::shoot(flow, start, equation.omega, {.transients = 0});
      if (motion.converged() || stopped_) return motion;
    }
    return time::shoot(flow, time::at_rest(equation), equation.omega);
  }

  bool go_on() {
    stopped_ = stopped_ || (progress_ && !progress_(told_));
    return !stopped_;
  }

  scene::FrequencyUnit unit_;
  double per_unit_;
  FrequencyWindow window_;
  StabilityRequest stability_;
  const ProgressCallback& progress_;
  std::shared_ptr<const model::Model> model_;
  ResponseBranch result_;
  Progress told_{};
  bool stopped_ = false;  // by the callback
};

}  // namespace

ResponseBranch shooting_response(const scene::Scene& scene, const FrequencyRange& range,
                                 const ProgressCallback& progress) {
  return Shooting(scene, range, progress).run();
}

}  // namespace arcslip::observables
