#include <arcslip/analyses/responses/frequency_response.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/harmonic_refinement.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/branches/resonances.hpp>
#include <arcslip/analyses/branches/unbounded_resonance.hpp>
#include <arcslip/analyses/responses/shooting_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::StopReason;
using continuation::Vector;

// Branches that leave others are found by it.
StabilityRequest stability_of(const FrequencyRange& range) {
  StabilityRequest request = range.stability;
  request.wanted = request.wanted || range.branches == Branches::all;
  return request;
}

double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

// One branch over the window [from, to], with the data to continue beyond an unbounded peak.
class Sweep {
 public:
  Sweep(const scene::Scene& scene, const FrequencyRange& range, const control::Control& control)
      : Sweep(model_of(scene, control), scene.frequency_unit, range, range.steps, control) {}

  Sweep(std::shared_ptr<const model::Model> model, scene::FrequencyUnit unit, const FrequencyRange& range,
        Steps steps, const control::Control& control)
      : unit_(scene::to_rad_per_s(unit)),
        frequency_unit_(unit),
        lower_(range.from * unit_),
        upper_(range.to * unit_),
        all_(range.branches == Branches::all),
        watched_{.stability = stability_of(range), .branch_points = all_},
        limits_(range.limits),
        steps_(steps),
        points_(range.points),
        events_(range.events),
        control_(control),
        model_(std::move(model)) {
    points_.estimates = points_.estimates && steps != Steps::events;
  }

  std::vector<ResponseBranch> run() {
    std::vector<ResponseBranch> branches;
    if (all_) {
      for (TracedBranch& branch : run_all()) branches.push_back(std::move(branch.response));
    } else {
      branches = with_others_at_ends(trace_pieces());
      for (ResponseBranch& branch : branches) drop_peaks_of_rounding(branch);
    }
    tell_missing_peak(*model_, {lower_, upper_}, frequency_unit_, branches);
    return branches;
  }

  std::vector<TracedBranch> run_all() {
    std::vector<TracedBranch> all = all_branches(trace_pieces(), following());
    for (TracedBranch& branch : all) drop_peaks_of_rounding(branch.response);
    return all;
  }

  std::optional<RefinedResponse> refined(std::span<const ResponseBranch> coarse, double accuracy) {
    if (all_ || coarse.size() != 1) return {};
    const ResponseBranch& branch = coarse.front();
    std::shared_ptr<const hbm::HbmProblem> problem;
    auto all = refined_branch(branch, accuracy, [&](const Part& part) -> std::optional<ResponseBranch> {
      if (!problem) problem = problem_of(branch, model_, lower_, upper_ - lower_, control_);
      return problem ? trace_part(problem, branch, part) : std::nullopt;
    });
    if (!all) return {};
    RefinedResponse found{{std::move(all->branch)}, all->change};
    drop_peaks_of_rounding(found.branches.front());
    tell_missing_peak(*model_, {lower_, upper_}, frequency_unit_, found.branches);
    return found;
  }

 private:
  // The branch from the lower end on, and where an unbounded resonance divides it, those beyond.
  std::vector<TracedBranch> trace_pieces() {
    std::vector<TracedBranch> pieces;
    far_side_ = {{lower_}};
    for (int piece = 0; piece <= 2 * model_->dofs; ++piece) {
      pieces.push_back(trace_from_first_of(far_side_));
      ResponseBranch& last = pieces.back().response;
      if (piece > 0) last.parent = 1;
      if (last.stop.reason != reasons::unbounded || !far_side_.ahead || !(far_side_.starts.front() < upper_))
        break;
    }
    return pieces;
  }

  // From the first of these starts at which a response is found.
  TracedBranch trace_from_first_of(const BeyondPole place) {
    std::optional<TracedBranch> found;
    for (const double from : place.starts) {
      if (found && !(from < upper_)) break;
      found = trace_from(from, place.displacement);
      if (found->response.stop.reason != reasons::start_failed) break;
    }
    return std::move(*found);
  }

  BranchOptions following() {
    return {.window = {lower_, upper_},
            .unit = frequency_unit_,
            .limits = limits_,
            .steps = steps_,
            .points = points_,
            .events = events_,
            .control = control_,
            .at = [this](double omega) {
              ++reported_.points;
              reported_.step = (omega - reported_.frequency * unit_) / unit_;
              reported_.frequency = omega / unit_;
              control_.report(reported_);
            }};
  }

  // displacement: the scale, m; 0: that of the first response.
  TracedBranch trace_from(double from, double displacement) {
    const auto began = std::chrono::steady_clock::now();
    Course course = course_from(from);
    ResponseBranch& result = course.result;
    reported_ = {.frequency = from / unit_};
    control_.report(reported_);
    if (const auto on_it = unbounded_resonance(model_, from); on_it.unbounded) {
      end_unbounded(result, on_it, from);
      far_side_ = beyond_pole_at_start(from, upper_ - lower_);
      return {std::move(result), nullptr, {}};
    }
    auto traced = frequency_branch(model_, {lower_, upper_}, from, recording(course), 1, steps_, control_,
                                   watched_, displacement);
    result.unknown_stability = traced.unknown_stability;
    result.solver.unknowns = traced.problem->size();
    finish(traced, from, course);
    estimate_bifurcations(result);
    estimate_flat_peaks(result);
    result.solver.seconds = seconds_since(began);
    return {std::move(result), traced.problem, std::move(traced.branch.events)};
  }

  // A window may begin or end within a hysteresis: with the branches of responses that its ends have besides.
  std::vector<ResponseBranch> with_others_at_ends(std::vector<TracedBranch> pieces) {
    std::vector<ResponseBranch> branches;
    const auto problem = pieces.back().problem;
    for (TracedBranch& piece : pieces) branches.push_back(std::move(piece.response));
    if (!problem || branches.back().status == Status::failed) return branches;
    if (end_search(*model_) != EndSearch::made) {
      branches.back().stop.message += without_search(*model_);
      return branches;
    }
    for (const double end : {lower_, upper_})
      for (const Vector& u : further_responses(problem, hbm::parameters_at(*problem, end),
                                               responses_at_end(branches, end), control_)) {
        const std::vector<Vector> known = responses_at_end(branches, end);
        if (index_of(*problem, u, known) == known.size() && control_.keep_going())
          branches.push_back(trace_inwards(problem, u, end));
      }
    if (!control_.keep_going() && branches.back().stop.reason != reasons::user) {
      branches.back().status = Status::stopped;
      branches.back().stop = {reasons::user, 1, 1, stopped_in_search};
    }
    complete(branches);
    return branches;
  }

  // Of the branches: they begin and end there.
  static std::vector<Vector> responses_at_end(const std::vector<ResponseBranch>& branches, double omega) {
    std::vector<Vector> all;
    for (const ResponseBranch& branch : branches) {
      if (branch.points.empty()) continue;
      for (const ResponsePoint* point : {&branch.points.front(), &branch.points.back()})
        if (point->omega == omega)
          all.push_back(Eigen::Map<const Vector>(point->unknowns.data(),
                                                 static_cast<Eigen::Index>(point->unknowns.size())));
    }
    return all;
  }

  // From an end of the window.
  ResponseBranch trace_inwards(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& u,
                               double end) {
    const auto began = std::chrono::steady_clock::now();
    Course course = course_from(end);
    const bool is_up = end == lower_;
    const auto traced = frequency_branch_part(problem, {lower_, upper_}, end, is_up ? upper_ : lower_, u,
                                              recording(course), is_up ? 1 : -1, steps_, control_, watched_);
    ResponseBranch& result = course.result;
    result.unknown_stability = traced.unknown_stability;
    result.solver.unknowns = problem->size();
    finish(traced, end, course);
    if (!is_up && traced.branch.stop.reason == StopReason::boundary && traced.branch.stop.value == lower_) {
      result.status = Status::complete;
      result.stop.message = "reached the end of the window at " + with_unit(lower_);
    }
    result.stop.message = "from another response at " + with_unit(end) + ": " + result.stop.message;
    estimate_bifurcations(result);
    estimate_flat_peaks(result);
    result.solver.seconds = seconds_since(began);
    return std::move(result);
  }

  // A branch that turned back and left the window is complete where another one has its upper end.
  void complete(std::vector<ResponseBranch>& branches) const {
    const auto has_upper_end = [&](const ResponseBranch& branch) {
      return !branch.points.empty() &&
             (branch.points.front().omega == upper_ || branch.points.back().omega == upper_);
    };
    if (std::none_of(branches.begin(), branches.end(), has_upper_end)) return;
    for (ResponseBranch& branch : branches)
      if (branch.status == Status::stopped && branch.stop.reason == reasons::boundary) {
        branch.status = Status::complete;
        std::string& message = branch.stop.message;
        if (message.ends_with(nothing_above)) message.erase(message.rfind(nothing_above));
        message += "; another branch reaches the upper end";
      }
  }

  // What is recorded along a branch.
  struct Course {
    ResponseBranch result;
    double last;  // frequency
    PoleWatch watch;
  };

  Course course_from(double omega) const { return {described(*model_), omega, {lower_, upper_}}; }

  Record recording(Course& course) {
    return [&](Observer& observer, const continuation::Accepted& now, const continuation::Event* event) {
      ResponseBranch& result = course.result;
      if (event) {
        result.events.push_back(event_of(*event, observer.observe(now, held_by(*event), events_)));
        return true;
      }
      const double omega = now.p[model::frequency];
      if (course.watch.is_next_to_pole(observer.problem(), now.p, now.u)) return false;
      observer.observe_next(now, points_, result.points);
      reported_.points = static_cast<long>(result.points.size());
      reported_.frequency = omega / unit_;
      reported_.step = (omega - course.last) / unit_;
      reported_.share_done = std::clamp((omega - lower_) / (upper_ - lower_), 0.0, 1.0);
      course.last = omega;
      control_.report(reported_);
      return control_.keep_going();
    };
  }

  // A part of a branch of fewer harmonics; nothing if it does not reach the end of that part.
  std::optional<ResponseBranch> trace_part(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                           const ResponseBranch& branch, const Part& part) {
    const auto began = std::chrono::steady_clock::now();
    const ResponsePoint& first = branch.points[part.first];
    const double to = branch.points[part.last].omega;
    const int direction = branch.points[part.first + 1].omega > first.omega ? 1 : -1;
    Course course = course_from(first.omega);
    const ResponsePoint start = in_harmonics(first, branch, course.result);
    const Eigen::Map<const Vector> u(start.unknowns.data(), static_cast<Eigen::Index>(start.unknowns.size()));
    const auto traced = frequency_branch_part(problem, {lower_, upper_}, first.omega, to, u,
                                              recording(course), direction, Steps::curve, control_, watched_);
    const auto& stop = traced.branch.stop;
    if (stop.reason != StopReason::boundary || stop.value != to) return {};
    estimate_bifurcations(course.result);
    estimate_flat_peaks(course.result);
    course.result.unknown_stability = traced.unknown_stability;
    course.result.solver.unknowns = problem->size();
    add(traced.branch, course.result.solver);
    course.result.solver.seconds = seconds_since(began);
    return std::move(course.result);
  }

  void finish(const FrequencyBranch& traced, double from, Course& course) {
    ResponseBranch& result = course.result;
    const continuation::Branch& branch = traced.branch;
    add(branch, result.solver);
    const UnboundedGrowth& growth = course.watch.growth();
    if (growth.unbounded) {
      end_unbounded(result, growth, course.watch.pole());
      far_side_ = course.watch.beyond();
      return;
    }
    const bool is_through = branch.stop.reason == StopReason::boundary && branch.stop.value == upper_;
    if (is_through)
      result.doubt = doubt_of_rounding(*model_, hbm::parameters_at(*traced.problem, from), result.solver);
    set_end(branch.stop, from, upper_, frequency_unit_, result);
    if (is_through && !result.doubt.empty()) result.stop.message += "; " + result.doubt;
    if (result.stop.reason != reasons::boundary && branch.stop.reason != StopReason::start_failed &&
        !growth.message.empty())
      result.stop.message += "; " + growth.message;
  }

  // The peak at infinity, at the frequency omega of the pole.
  void end_unbounded(ResponseBranch& result, const UnboundedGrowth& growth, double omega) const {
    result.status = Status::complete;
    result.stop = {reasons::unbounded, growth.dissipation, growth.input,
                   growth.message + ", near " + with_unit(omega)};
    ResponseEvent peak;
    peak.kind = event_kinds::peak;
    peak.point.omega = omega;
    peak.point.unbounded = true;
    peak.after = result.points.empty() ? 0 : result.points.size() - 1;
    result.events.push_back(std::move(peak));
  }

  std::string with_unit(double omega) const { return frequency_text(omega, frequency_unit_); }

  double unit_;
  scene::FrequencyUnit frequency_unit_;
  double lower_, upper_;
  bool all_;
  MonitoredEvents watched_;
  BranchLimits limits_;
  Steps steps_;
  Observed points_, events_;
  const control::Control control_;
  std::shared_ptr<const model::Model> model_;
  BeyondPole far_side_{};
  control::Progress reported_{};
};

}  // namespace

std::vector<ResponseBranch> frequency_response(const scene::Scene& scene, const FrequencyRange& range,
                                               const control::Control& control) {
  if (range.method == ResponseMethod::shooting) return {shooting_response(scene, range, control)};
  return Sweep(scene, range, control).run();
}

std::vector<TracedBranch> traced_branches(std::shared_ptr<const model::Model> model,
                                          scene::FrequencyUnit unit, const FrequencyRange& range, Steps steps,
                                          const control::Control& control) {
  return Sweep(std::move(model), unit, range, steps, control).run_all();
}

std::optional<RefinedResponse> refined_response(const scene::Scene& scene, const FrequencyRange& range,
                                                std::span<const ResponseBranch> coarse, double accuracy,
                                                const control::Control& control) {
  if (range.method == ResponseMethod::shooting) return {};
  return Sweep(scene, range, control).refined(coarse, accuracy);
}

}  // namespace arcslip::observables
