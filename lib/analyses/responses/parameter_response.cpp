#include <arcslip/analyses/responses/parameter_response.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/harmonic_refinement.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/branches/parameter_trace.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/analyses/responses/shooting_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <chrono>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::Crossing;
using continuation::StopReason;
using continuation::Vector;

continuation::Monitor extreme_monitor(const results::EventKind& kind, Crossing crossing,
                                      const std::shared_ptr<Observer>& observer) {
  continuation::Monitor monitor{kind,
                                [observer](const Accepted& now) { return observer->amplitude_slope(now); },
                                crossing, [observer](const Accepted&) { return observer->last_amplitude(); }};
  monitor.divides_at_kinks = observer->problem().model().settings.friction == scene::Friction::exact;
  return monitor;
}

// The branches over one parameter at one frequency, each from a different response at the start of the range.
class Traces {
 public:
  Traces(const scene::Scene& scene, const ParameterRange& range, const control::Control& control)
      : way_(over_parameter(scene, range.over, range.from, range.to, control)),
        unit_(scene.frequency_unit),
        omega_(range.frequency * scene::to_rad_per_s(unit_)),
        stability_(range.stability),
        points_(range.points),
        events_(range.events),
        control_(control) {
    progress_.frequency = range.frequency;
  }

  std::vector<ResponseBranch> run() {
    control_.report(progress_);
    const ResponsesAt starts = responses_at(way_.model, omega_, end_search(*way_.model), control_);
    if (!control_.keep_going()) return {stopped()};
    if (!starts.unbounded.empty()) return {failed("no response is bounded", starts.unbounded)};
    if (starts.u.empty()) return {failed("no periodic response was found", starts.failure)};
    std::vector<Vector> ends, far_ends;  // of branches, at `from` and at `to`
    std::vector<ResponseBranch> branches;
    for (const Vector& start : starts.u) {
      if (std::any_of(ends.begin(), ends.end(),
                      [&](const Vector& end) { return (start - end).norm() <= same_solution * end.norm(); }))
        continue;
      const auto traced = trace(starts.problem, start, branches.emplace_back());
      ends.push_back(start);
      if (traced.stop.reason == StopReason::boundary) {
        (traced.stop.value == way_.from ? ends : far_ends).push_back(traced.points.back().u);
      }
      if (traced.stop.reason == StopReason::user) return branches;
    }
    if (starts.several) add_from_far_end(starts.problem, far_ends, branches);
    if (!control_.keep_going() && branches.back().stop.reason != reasons::user) {
      branches.back().status = Status::stopped;
      branches.back().stop = {reasons::user, way_.from, way_.to, stopped_in_search};
      return branches;
    }
    branches.back().stop.message += without_search(*way_.model);
    // A branch that turned back is complete if others cover the range beyond.
    for (ResponseBranch& branch : branches)
      if (!far_ends.empty() && branch.stop.reason == reasons::boundary) branch.status = Status::complete;
    if (std::string& doubt = branches.front().doubt; !starts.doubt.empty())
      doubt += (doubt.empty() ? "" : "; ") + starts.doubt;
    return branches;
  }

  // The branches of responses at the end of the range that no other reaches. ends: those that are reached.
  void add_from_far_end(const std::shared_ptr<const hbm::HbmProblem>& problem, std::vector<Vector>& ends,
                        std::vector<ResponseBranch>& branches) {
    Vector p = hbm::parameters_at(*problem, omega_);
    p[way_.index] = way_.to;
    for (const Vector& u : further_responses(problem, p, ends, control_)) {
      if (!control_.keep_going()) return;
      if (index_of(*problem, u, ends) < ends.size()) continue;
      ends.push_back(u);
      ResponseBranch& result = branches.emplace_back();
      auto branch = trace_from(problem, u, way_.to, -way_.direction(), way_.options(), result);
      add_scene_hint(*way_.model, p, branch);
      const auto& stop = branch.stop;
      result.status = stop.reason == StopReason::boundary ? Status::complete : status_of(stop.reason);
      const std::string end = stop.reason == StopReason::boundary
                                  ? "reached " + way_.name + " = " + to_digits(stop.value, 8)
                                  : stop.message;
      result.stop = {reason_of(stop.reason), stop.value, stop.limit,
                     "from another response at " + way_.name + " = " + to_digits(way_.to, 8) + ": " + end};
      if (stop.reason == StopReason::boundary && stop.value == way_.to)
        ends.push_back(branch.points.back().u);
    }
  }

  std::optional<RefinedResponse> refined(std::span<const ResponseBranch> coarse, double accuracy) {
    if (coarse.size() != 1) return {};
    const ResponseBranch& branch = coarse.front();
    std::shared_ptr<const hbm::HbmProblem> problem;
    auto all = refined_branch(branch, accuracy, [&](const Part& part) -> std::optional<ResponseBranch> {
      if (!problem) problem = problem_of(branch, way_.model, omega_, omega_, control_);
      return problem ? trace_part(problem, branch, part) : std::nullopt;
    });
    if (!all) return {};
    return RefinedResponse{{std::move(all->branch)}, all->change};
  }

 private:
  // Before the first point.
  ResponseBranch stopped() const {
    ResponseBranch result = described(*way_.model, way_.name);
    result.status = Status::stopped;
    result.stop = {reasons::user, way_.from, way_.to, "stopped by the caller"};
    return result;
  }

  ResponseBranch failed(const std::string& what, const std::string& why) const {
    ResponseBranch result = described(*way_.model, way_.name);
    result.status = Status::failed;
    result.stop = {reasons::start_failed, way_.from, 0,
                   what + " at " + way_.name + " = " + results::shortest(way_.from) + " and " +
                       frequency_text(omega_, unit_) + ": " + why};
    return result;
  }

  // A part of a branch of fewer harmonics; nothing if it does not reach the end of that part.
  std::optional<ResponseBranch> trace_part(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                           const ResponseBranch& branch, const Part& part) {
    const ResponsePoint& first = branch.points[part.first];
    const double to = branch.points[part.last].over;
    ResponseBranch result = described(*way_.model, way_.name);
    const ResponsePoint start = in_harmonics(first, branch, result);
    auto options = way_.options();
    (to > first.over ? options.upper : options.lower) = to;
    const int direction = branch.points[part.first + 1].over > first.over ? 1 : -1;
    const auto traced = trace_from(
        problem,
        Eigen::Map<const Vector>(start.unknowns.data(), static_cast<Eigen::Index>(start.unknowns.size())),
        first.over, direction, std::move(options), result);
    if (traced.stop.reason != StopReason::boundary || traced.stop.value != to) return {};
    return result;
  }

  continuation::Branch trace(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& u,
                             ResponseBranch& result) {
    auto branch = trace_from(problem, u, way_.from, way_.direction(), way_.options(), result);
    const Vector p = hbm::parameters_at(*problem, omega_);
    add_scene_hint(*way_.model, p, branch);
    set_end(way_, branch.stop, doubt_of_rounding(*way_.model, p, result.solver), result);
    return branch;
  }

  // But for its status and stop.
  continuation::Branch trace_from(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& u,
                                  double from, int direction, continuation::Options options,
                                  ResponseBranch& result) {
    const auto began = std::chrono::steady_clock::now();
    result = described(*way_.model, way_.name);
    const auto observer = std::make_shared<Observer>(problem, way_.index);
    std::vector<continuation::Monitor> monitors{
        extreme_monitor(event_kinds::maximum, Crossing::falling, observer),
        extreme_monitor(event_kinds::minimum, Crossing::rising, observer), continuation::fold_monitor()};
    if (stability_) {
      observer->watch_stability(stability_);
      for (auto& monitor : stability_monitors(observer)) monitors.push_back(std::move(monitor));
    }
    std::vector<std::pair<double, double>> course;  // arclength, amplitude
    std::vector<double> at;                         // arclength of the events
    const auto record = [&](const Accepted& now, const continuation::Event* event) {
      if (event) {
        ResponsePoint point = observer->observe(now, held_by(*event), events_);
        point.over = now.parameter;
        at.push_back(now.arclength);
        result.events.push_back(event_of(*event, std::move(point)));
        return true;
      }
      observer->observe_next(now, points_, result.points);
      result.points.back().over = now.parameter;
      course.emplace_back(now.arclength, result.points.back().amplitude);
      progress_.points = static_cast<long>(result.points.size());
      progress_.share_done = way_.share(now.parameter);
      control_.report(progress_);
      return control_.keep_going();
    };
    Vector p = hbm::parameters_at(*problem, omega_);
    p[way_.index] = from;
    options.control = control_;
    auto branch =
        continuation::trace(problem, {u, p, way_.index, direction}, options, std::move(monitors), record);
    result.unknown_stability = observer->unknown_stability();
    drop_extrema_of_rounding(course, at, result);
    estimate_bifurcations(result);
    result.solver.unknowns = problem->size();
    add(branch, result.solver);
    result.solver.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return branch;
  }

  OverParameter way_;
  scene::FrequencyUnit unit_;
  double omega_;
  StabilityRequest stability_;
  Observed points_, events_;
  const control::Control control_;
  control::Progress progress_;
};

}  // namespace

std::vector<ResponseBranch> parameter_response(const scene::Scene& scene, const ParameterRange& range,
                                               const control::Control& control) {
  if (range.method == ResponseMethod::shooting) return {shooting_response(scene, range, control)};
  return Traces(scene, range, control).run();
}

std::optional<RefinedResponse> refined_response(const scene::Scene& scene, const ParameterRange& range,
                                                std::span<const ResponseBranch> coarse, double accuracy,
                                                const control::Control& control) {
  if (range.method == ResponseMethod::shooting) return {};
  return Traces(scene, range, control).refined(coarse, accuracy);
}

}  // namespace arcslip::observables
