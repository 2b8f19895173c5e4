#include <arcslip/analyses/responses/shooting_response.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/parameter_trace.hpp>
#include <arcslip/analyses/branches/resonances.hpp>
#include <arcslip/analyses/branches/unbounded_resonance.hpp>
#include <arcslip/analyses/responses/shooting_observer.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/period_integrator.hpp>
#include <arcslip/time/periodic/periodicity_conditions.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {
namespace {

using continuation::StopReason;
using continuation::Vector;

/// What a branch goes over, from `from` to `to`: the frequency, rad/s, or another parameter at `omega`.
struct Path {
  std::shared_ptr<const model::Model> model;
  std::string over;  // empty: the frequency
  int free;
  double from, to, omega;
  double typical, scale;  // of the frequency, rad/s
  continuation::Options options;
  std::function<double(double)> share;  // of the way, at a value
  std::function<void(const continuation::BranchStop&, ResponseBranch&)> set_end;
};

class Shooting {
 public:
  Shooting(Path path, double frequency_unit, const StabilityRequest& stability,
           const control::Control& control)
      : path_(std::move(path)),
        unit_(frequency_unit),
        stability_(stability),
        control_(control),
        result_(described(*path_.model, path_.over)) {
    result_.harmonics.clear();
    result_.symmetry = Symmetry::none;
    reported_.frequency = path_.omega / unit_;
    path_.options.control = control_;
  }

  ResponseBranch run() {
    control_.report(reported_);
    const auto began = std::chrono::steady_clock::now();
    try {
      time::check_response(*path_.model);
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
    const time::EventLimits limits{affordable_events, affordable_pieces, control_};
    const time::ShootingProblem unscaled(path_.model, 1, path_.typical, path_.scale, limits);
    result_.solver.unknowns = unscaled.size();
    if (const auto growth = unbounded_resonance(path_.model, path_.omega); growth.unbounded)
      return path_.set_end({StopReason::start_failed, path_.from, 0, growth.message}, result_);
    Vector p = continuation::parameter_values(unscaled);
    p[model::frequency] = path_.omega;
    const time::ShootingResult first = first_motion(p, limits);
    if (!control_.keep_going())
      return path_.set_end({StopReason::user, 1, 1, "stopped by the caller"}, result_);
    if (!first.converged())
      return path_.set_end({StopReason::start_failed, path_.from, 0, first.message}, result_);
    const double displacement = first.map.size > 0 ? first.map.size : 1;
    const auto problem = std::make_shared<const time::ShootingProblem>(path_.model, displacement,
                                                                       path_.typical, path_.scale, limits);
    const auto observer = std::make_shared<ShootingObserver>(problem, path_.free);
    std::vector<std::pair<double, double>> course;  // arclength, amplitude
    std::vector<double> at;                         // arclength of the events
    const auto record = [&](const continuation::Accepted& now, const continuation::Event* event) {
      ResponsePoint point = observer->observe(now);
      if (event) {
        at.push_back(now.arclength);
        result_.events.push_back(event_of(*event, std::move(point)));
        return true;
      }
      course.emplace_back(now.arclength, point.amplitude);
      result_.points.push_back(std::move(point));
      ++reported_.points;
      const double omega = now.p[model::frequency];
      reported_.step = omega / unit_ - reported_.frequency;
      reported_.frequency = omega / unit_;
      reported_.share_done = path_.share(now.parameter);
      control_.report(reported_);
      return control_.keep_going();
    };
    const int direction = path_.from < path_.to ? 1 : -1;
    const continuation::Branch branch =
        continuation::trace(problem, {time::stacked(first.start), p, path_.free, direction}, path_.options,
                            shooting_monitors(observer, stability_), record);
    if (!path_.over.empty()) drop_extrema_of_rounding(course, at, result_);
    add(branch, result_.solver);
    path_.set_end(branch.stop, result_);
  }

  // From the response of harmonic balance, or from rest where there is none.
  time::ShootingResult first_motion(const Vector& p, const time::EventLimits& limits) {
    time::EventDriven integrator(time::equation_of_motion(*path_.model, p), limits);
    const time::EquationOfMotion& equation = integrator.equation();
    const time::Flow flow = [&](const time::MotionState& start) {
      return integrator.map(start, equation.period());
    };
    const FirstResponse found = first_response(path_.model, path_.omega, path_.scale, control_);
    if (found.u) {
      const auto at = hbm::parameters_at(*found.problem, path_.omega);
      const time::MotionState start = time::state_of(*found.problem, *found.u, at);
      auto motion = time::shoot(flow, start, equation.omega, {.transients = 0});
      if (motion.converged() || !control_.keep_going()) return motion;
    }
    return time::shoot(flow, time::at_rest(equation), equation.omega);
  }

  Path path_;
  double unit_;
  StabilityRequest stability_;
  const control::Control control_;
  ResponseBranch result_;
  control::Progress reported_{};
};

}  // namespace

ResponseBranch shooting_response(const scene::Scene& scene, const FrequencyRange& range,
                                 const control::Control& control) {
  const scene::FrequencyUnit unit = scene.frequency_unit;
  const double per_unit = scene::to_rad_per_s(unit);
  const FrequencyWindow window{range.from * per_unit, range.to * per_unit};
  const double width = window.upper - window.lower;
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  const double typical = model->harmonics.base_frequency(0.5 * (window.lower + window.upper));
  Path path{.model = model,
            .over = {},
            .free = model::frequency,
            .from = window.lower,
            .to = window.upper,
            .omega = window.lower,
            .typical = typical,
            .scale = width,
            .options = frequency_options(window, Steps::curve, {}),
            .share = [=](double omega) { return std::clamp((omega - window.lower) / width, 0.0, 1.0); },
            .set_end =
                [=](const continuation::BranchStop& stop, ResponseBranch& result) {
                  observables::set_end(stop, window.lower, window.upper, unit, result);
                }};
  std::vector<ResponseBranch> branches{Shooting(std::move(path), per_unit, range.stability, control).run()};
  tell_missing_peak(*model, window, unit, branches);
  return std::move(branches.front());
}

ResponseBranch shooting_response(const scene::Scene& scene, const ParameterRange& range,
                                 const control::Control& control) {
  const double per_unit = scene::to_rad_per_s(scene.frequency_unit);
  const double omega = range.frequency * per_unit;
  const OverParameter way = over_parameter(scene, range.over, range.from, range.to);
  Path path{.model = way.model,
            .over = way.name,
            .free = way.index,
            .from = way.from,
            .to = way.to,
            .omega = omega,
            .typical = way.model->harmonics.base_frequency(omega),
            .scale = omega,
            .options = way.options(),
            .share = [way](double value) { return way.share(value); },
            .set_end = [way](const continuation::BranchStop& stop,
                             ResponseBranch& result) { observables::set_end(way, stop, "", result); }};
  return Shooting(std::move(path), per_unit, range.stability, control).run();
}

}  // namespace arcslip::observables
