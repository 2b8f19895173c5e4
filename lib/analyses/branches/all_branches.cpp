#include <arcslip/analyses/branches/all_branches.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/branch_recording.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/analyses/branches/wider_harmonics.hpp>
#include <arcslip/continuation/diagrams/agenda.hpp>
#include <arcslip/observables/observe.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Agenda;
using continuation::BranchPoint;
using continuation::Junction;
using continuation::NotWidened;
using continuation::StopReason;
using continuation::Vector;
using continuation::WiderBranchPoints;
using elements::Harmonics;

constexpr double near_end = 1e-3;  // distance to a branch point, relative to 1 + |u|, in scales
constexpr const char* several_cross = "several branches cross there at once, as in symmetric structures";

Vector with_frequency(const Solution& point) {
  Vector v(point.unknowns.size() + 1);
  v << Eigen::Map<const Vector>(point.unknowns.data(), static_cast<Eigen::Index>(point.unknowns.size())),
      point.omega;
  return v;
}

bool have_same_harmonics(const continuation::Problem& a, const continuation::Problem& b) {
  return static_cast<const hbm::HbmProblem&>(a).harmonics() ==
         static_cast<const hbm::HbmProblem&>(b).harmonics();
}

const char* words(NotWidened why) {
  if (why == NotWidened::several_cross) return several_cross;
  if (why == NotWidened::jumps)
    return "the stiffness of the contacts jumps there, so that the branch that leaves has no tangent of its "
           "own";
  if (why == NotWidened::not_evaluated) return "the response could not be computed where it crosses";
  return "no branch of these harmonics crosses there; more harmonics may resolve it";
}

class AllBranches {
 public:
  explicit AllBranches(const BranchOptions& following) : f_(following) {}

  std::vector<TracedBranch> run(std::vector<TracedBranch> given) {
    for (TracedBranch& each : given) {
      Known known;
      known.response = std::move(each.response);
      known.problem = std::move(each.problem);
      known_.push_back(std::move(known));
      find_half_branches(each.events);
    }
    follow_half_branches();
    if (may_have_several()) {
      search(f_.window.lower);
      search(f_.window.upper);
    }
    for (int i = 0; i < f_.limits.searches && f_.control.keep_going(); ++i) {
      const double share = (i + 0.5) / f_.limits.searches;
      const double omega = f_.window.lower + (f_.window.upper - f_.window.lower) * share;
      search(omega);
      deflate(omega);
    }
    if (f_.limits.searches > 0 && is_full())
      known_.front().response.untraced.push_back("branches that no other reaches: " + limit_reported());
    while (const auto way = agenda_.next()) untraced(agenda_.points[way->point], "stopped by the caller");
    std::vector<TracedBranch> all;
    for (Known& each : known_) all.push_back({std::move(each.response), each.problem, {}});
    return all;
  }

 private:
  struct Known {
    ResponseBranch response;
    std::shared_ptr<const hbm::HbmProblem> problem;
    int doublings = 0;
  };

  // How a trace ends.
  struct End {
    double arclength = 0;
    Vector x;
    std::string message{};
    std::optional<std::size_t> point{};  // of the agenda, where a known branch is left
  };

  std::string frequency(double omega) const { return frequency_text(omega, f_.unit); }

  void untraced(std::size_t branch, const std::string& kind, double omega, const std::string& why) {
    known_[branch].response.untraced.push_back("the branch that leaves at the " +
                                               event_kinds::words_of(kind) + " at " + frequency(omega) +
                                               ": " + why);
  }

  void untraced(const Junction& where, const std::string& why) {
    untraced(branch_of(where), left_at(where).kind, where.parameter, why);
  }

  // The known branch that is left there, and at which event.
  static std::size_t branch_of(const Junction& where) { return static_cast<std::size_t>(where.branch); }
  const ResponseEvent& left_at(const Junction& where) const {
    return known_[branch_of(where)].response.events[static_cast<std::size_t>(where.event)];
  }

  void add_to_agenda(Junction&& found, std::size_t branch, std::size_t event) {
    found.branch = static_cast<int>(branch);
    found.event = static_cast<int>(event);
    agenda_.points.push_back(std::move(found));
  }

  bool is_full() const { return static_cast<int>(known_.size()) >= f_.limits.most_branches; }

  std::string limit_reported() const {
    return "as many branches as asked for were traced already (most_branches: " +
           std::to_string(f_.limits.most_branches) + ")";
  }

  // Of the last known branch: all half-branches that leave it. events: those of its trace.
  void find_half_branches(const std::vector<continuation::Event>& events) {
    const Known& last = known_.back();
    std::map<std::string, WiderBranchPoints> wider;
    std::vector<Vector> solutions;
    for (const Solution& point : last.response.points) solutions.push_back(with_frequency(point));
    for (std::size_t e = 0; e < last.response.events.size(); ++e)
      if (const std::string& kind = last.response.events[e].kind;
          kind == event_kinds::period_doubling || kind == event_kinds::symmetry_breaking)
        widen(e, solutions, wider);
    for (const continuation::Event& event : events)
      if (std::holds_alternative<BranchPoint>(event.data)) meet(event);
  }

  // The branch of more harmonics that leaves the last known one at an event.
  void widen(std::size_t e, const std::vector<Vector>& solutions,
             std::map<std::string, WiderBranchPoints>& wider) {
    const std::size_t k = known_.size() - 1;
    const ResponseEvent& event = known_[k].response.events[e];
    const double omega = event.point.omega;
    const auto leave_out = [&](const std::string& why) { untraced(k, event.kind, omega, why); };
    const bool doubles = event.kind == event_kinds::period_doubling;
    const Harmonics harmonics = without(known_[k].problem->harmonics(),
                                        doubles ? BrokenSymmetry::period : BrokenSymmetry::mirror_image);
    if (doubles && known_[k].doublings >= f_.limits.doublings)
      return leave_out("the period was doubled " + std::to_string(known_[k].doublings) +
                       (known_[k].doublings == 1 ? " time" : " times") + " already (doublings)");
    if (harmonics.order > scene::largest_order)
      return leave_out("it would have harmonics above " + std::to_string(scene::largest_order));
    auto at = wider.find(event.kind);
    if (at == wider.end()) {
      const auto wide = in_harmonics(*known_[k].problem, harmonics, f_.window.lower);
      if (const auto dof = model::drifting_dof(wide->model(), hbm::parameters_at(*wide, omega)))
        return leave_out("no spring holds the mean position of " +
                         model::coordinate_name(wide->model(), *dof));
      at = wider.emplace(event.kind, WiderBranchPoints(widening(known_[k].problem, wide))).first;
    }
    auto found = at->second.locate(solutions, event.after);
    if (const auto* why = std::get_if<NotWidened>(&found)) return leave_out(words(*why));
    add_to_agenda(std::get<Junction>(std::move(found)), k, e);
  }

  // A branch point of the trace of the last known branch, at which others of the same harmonics leave.
  void meet(const continuation::Event& event) {
    const std::size_t k = known_.size() - 1;
    const double omega = event.point.parameter;
    const auto& all = known_[k].response.events;
    const auto at = std::find_if(all.begin(), all.end(), [&](const ResponseEvent& other) {
      return other.kind == event_kinds::branch_point && other.point.omega == omega;
    });
    if (at == all.end()) return;  // beyond the end of the branch
    if (event.nonsmooth) return untraced(k, at->kind, omega, "pieces of the laws of contact meet there");
    if (!event.located || std::get<BranchPoint>(event.data).type == BranchPoint::Type::multiple)
      return untraced(k, at->kind, omega, several_cross);
    const auto& problem = known_[k].problem;
    continuation::Counts counts;
    const continuation::Corrector in(*problem, hbm::parameters_at(*problem, omega), model::frequency, {},
                                     counts);
    if (const std::size_t known = agenda_.index_of(problem, event, in); known < agenda_.points.size())
      return pass(known, std::get<BranchPoint>(event.data).tangents.front(), in);
    Junction met = Agenda::met(problem, event);
    for (std::size_t along = 0; along < 2; ++along) met.half_branches[along].branch = static_cast<int>(k);
    add_to_agenda(std::move(met), k, static_cast<std::size_t>(at - all.begin()));
  }

  // The last known branch passes a known point along a direction: its half-branches there need no other one.
  void pass(std::size_t point, const Vector& along, const continuation::Corrector& in) {
    Junction& passed = agenda_.points[point];
    for (const Vector& way : {Vector(along), Vector(-along)})
      if (const auto half = agenda_.nearest(passed, way, in); half && passed.half_branches[*half].branch < 0)
        passed.half_branches[*half].branch = static_cast<int>(known_.size()) - 1;
  }

  void follow_half_branches() {
    while (f_.control.keep_going()) {
      const auto way = agenda_.next();
      if (!way) return;
      follow(*way);
    }
  }

  void follow(const Agenda::Place& way) {
    const Junction leaves = agenda_.points[way.point];
    const std::size_t from = branch_of(leaves);
    const std::string kind = left_at(leaves).kind;
    const double omega = leaves.parameter;
    if (is_full()) return untraced(leaves, limit_reported());
    const auto problem = std::static_pointer_cast<const hbm::HbmProblem>(leaves.problem);
    const Vector p = hbm::parameters_at(*problem, omega);
    continuation::Counts counts;
    continuation::Corrector with(*problem, p, model::frequency, {}, counts);
    const auto entry = agenda_.enter(way, with, f_.window.lower, f_.window.upper);
    if (!entry) return untraced(leaves, agenda_.at(way).untraced);
    agenda_.at(way).branch = static_cast<int>(known_.size());
    Run run = begin(problem);
    Vector x(leaves.u.size() + 1);
    x << leaves.u, omega;
    with.move_to(x, continuation::Needs::jacobian);
    run.course.points.emplace_back(
        -entry->step, run.observer->observe({leaves.u, p, leaves.half_branches[way.half].direction, 0,
                                             with.evaluator(), with.factors(), omega, with.scratch()},
                                            PointCondition::branch_point, f_.points | f_.events));
    set_apart(event_kinds::branch_point, run.course.points.front().second);
    estimate_as_at(leaves, run.course.points.front().second);
    trace(continuation::start_at(*entry, p, model::frequency), entry->step, run);
    ResponseBranch& response = run.known.response;
    add(counts, response.solver);
    run.known.doublings = known_[from].doublings + (kind == event_kinds::period_doubling ? 1 : 0);
    response.parent = static_cast<int>(known_.size() - from);
    response.leaves = {kind, static_cast<std::size_t>(leaves.event), omega};
    if (kind == event_kinds::symmetry_breaking || known_[from].response.symmetry == Symmetry::mirror_pair)
      response.symmetry = Symmetry::mirror_pair;
    add_known(std::move(run), omega);
  }

  // The equations are singular at a branch point. For fewer harmonics, those of the branch that is left
  // there, they are not.
  void estimate_as_at(const Junction& where, Solution& point) const {
    const Solution& event = left_at(where).point;
    point.truncation_estimate = event.truncation_estimate;
    point.truncation_change = event.truncation_change;
    point.truncation_flagged = event.truncation_flagged;
  }

  // A trace, and the branch that it becomes.
  struct Run {
    Known known;
    std::shared_ptr<Observer> observer;
    std::vector<continuation::Monitor> monitors;
    Course course;
    std::vector<continuation::Event> events;
    continuation::BranchStop stop;
    std::optional<End> end;
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
  };

  Run begin(const std::shared_ptr<const hbm::HbmProblem>& problem) const {
    Run run;
    run.known.problem = problem;
    run.known.response = described(problem->model());
    run.known.response.solver.unknowns = problem->size();
    run.observer = std::make_shared<Observer>(problem);
    run.monitors = frequency_monitors(run.observer, f_.steps, {.stability = true, .branch_points = true});
    return run;
  }

  // step: the first one; 0: that of the tracer.
  void trace(const continuation::Start& start, double step, Run& run) {
    const auto record = [&](const continuation::Accepted& now, const continuation::Event* event) {
      if (event) {
        run.course.events.emplace_back(
            event->point.arclength, event_of(*event, run.observer->observe(now, held_by(*event), f_.events)));
        return true;
      }
      run.course.points.emplace_back(now.arclength,
                                     run.observer->observe(now, PointCondition::parameter, f_.points));
      f_.at(now.parameter);
      return f_.control.keep_going();
    };
    const hbm::HbmProblem& problem = *run.known.problem;
    continuation::Options options = frequency_options(f_.window, f_.steps, f_.control);
    options.step.initial = step;
    continuation::Counts counts;
    const continuation::Corrector in(problem, start.p, model::frequency, {}, counts);
    const auto possible = fewer(problem, start.u);
    continuation::Branch traced = continuation::trace_until(
        run.known.problem, start, options, run.monitors, record, [&](const continuation::Event& event) {
          run.end = end_at(run.known.problem, event, in, possible);
          return run.end.has_value();
        });
    add(traced, run.known.response.solver);
    run.events = std::move(traced.events);
    run.stop = std::move(traced.stop);
    if (!run.end) return;
    run.course.end_at(run.end->arclength, near_end * (1 + in.norm_u(run.end->x)));
    ResponsePoint& last = run.course.points.back().second;
    if (run.end->point && last.omega == run.end->x[run.end->x.size() - 1])
      estimate_as_at(agenda_.points[*run.end->point], last);
  }

  // from: where it begins.
  void add_known(Run&& run, double from) {
    ResponseBranch& response = run.known.response;
    run.course.move_to(response);
    finish(run, from, response);
    estimate_bifurcations(response);
    estimate_flat_peaks(response);
    response.unknown_stability = run.observer->unknown_stability();
    const auto& points = response.points;
    if (!points.empty()) {
      response.events.insert(response.events.begin(),
                             ResponseEvent{event_kinds::start, false, true, points.front(), 0});
      response.events.push_back({event_kinds::end, false, true, points.back(), points.size() - 1});
    }
    response.solver.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - run.began).count();
    known_.push_back(std::move(run.known));
    find_half_branches(run.events);
  }

  bool may_have_several() const {
    return known_.front().problem && may_have_several_responses(known_.front().problem->model());
  }

  // What branches of the first harmonics have at one frequency.
  std::vector<Vector> known_at(double omega) const {
    const auto problem = known_.front().problem;
    std::vector<Vector> all;
    for (const Known& each : known_)
      if (each.problem && each.problem->harmonics() == problem->harmonics())
        for (Vector& u : solutions_at(*problem, each.response.points, omega)) all.push_back(std::move(u));
    return all;
  }

  // Branches of the first harmonics that no other reaches, by what they have at one frequency.
  void search(double omega) {
    const auto problem = known_.front().problem;
    if (!problem || !f_.control.keep_going()) return;
    const Vector p = hbm::parameters_at(*problem, omega);
    for (const Vector& found : further_responses(problem, p, known_at(omega), f_.control)) {
      const std::vector<Vector> known = known_at(omega);
      if (f_.control.keep_going() && !is_full() && index_of(*problem, found, known) == known.size())
        add_isolated(found, omega);
    }
  }

  // The same by deflation with all harmonics.
  void deflate(double omega) {
    const auto problem = known_.front().problem;
    if (!problem) return;
    const Vector p = hbm::parameters_at(*problem, omega);
    std::vector<Vector> tried;
    while (f_.control.keep_going() && !is_full()) {
      std::vector<Vector> known = known_at(omega);
      known.insert(known.end(), tried.begin(), tried.end());
      const auto found = solution_nearby(*problem, p, known, f_.control);
      if (!found) return;
      tried.push_back(*found);
      add_isolated(*found, omega);
    }
  }

  // The branch through a response, and those that leave it.
  void add_isolated(const Vector& u, double omega) {
    const auto problem = known_.front().problem;
    Run run = begin(problem);
    continuation::Start start{u, hbm::parameters_at(*problem, omega), model::frequency, 1, {}};
    if (omega == f_.window.upper) start.direction = -1;
    trace(start, 0, run);
    if (run.stop.reason == StopReason::start_failed || run.course.points.empty()) return;
    const bool is_inside = omega > f_.window.lower && omega < f_.window.upper;
    if (is_inside && run.stop.reason != StopReason::closed && f_.control.keep_going()) {
      Run back = begin(problem);
      start.direction = -1;
      trace(start, 0, back);
      run.course.prepend(std::move(back.course));
      run.events.insert(run.events.end(), back.events.begin(), back.events.end());
      if (status_of(back.stop.reason) == Status::failed) run.stop = back.stop;
    }
    run.known.response.isolated = true;
    add_known(std::move(run), omega);
    follow_half_branches();
  }

  // Whether the branch point that a trace has met is its end.
  std::optional<End> end_at(const std::shared_ptr<const hbm::HbmProblem>& problem,
                            const continuation::Event& event, const continuation::Corrector& in,
                            const std::vector<Harmonics>& possible) {
    if (!event.located || event.nonsmooth) return {};
    Vector x(event.point.u.size() + 1);
    x << event.point.u, event.point.parameter;
    End end{event.point.arclength, std::move(x)};
    if (const auto way = agenda_.arrival(problem, event, in)) {
      agenda_.at(*way).branch = static_cast<int>(known_.size());
      end.point = way->point;
      end.message = "reached the " + event_kinds::words_of(left_at(agenda_.points[way->point]).kind) +
                    " at " + frequency(event.point.parameter) + " of a branch that is known";
      return end;
    }
    for (const Harmonics& fewer : possible)
      if (within(*problem, event.point.u, fewer)) {
        end.message = "reached, at " + frequency(event.point.parameter) + ", a branch of " +
                      (fewer.odd ? "antisymmetric motions" : "motions of half the period") +
                      " that is not among those traced";
        return end;
      }
    return {};
  }

  // Sets of fewer harmonics, to which motions of the branch may come where it ends at another one.
  static std::vector<Harmonics> fewer(const hbm::HbmProblem& problem, const Vector& u) {
    std::vector<Harmonics> all;
    Harmonics odd = problem.harmonics(), half = odd;
    odd.odd = true;
    half.order /= 2;
    half.period /= 2;
    if (problem.model().antisymmetric && !problem.harmonics().odd && !within(problem, u, odd))
      all.push_back(odd);
    if (problem.harmonics().period % 2 == 0 && !within(problem, u, half)) all.push_back(half);
    return all;
  }

  void finish(const Run& run, double from, ResponseBranch& result) {
    const auto& stop = run.stop;
    const auto& end = run.end;
    if (end) {
      result.status = Status::complete;
      const double omega = end->x[end->x.size() - 1];
      result.stop = {reasons::branch_point, omega / scene::to_rad_per_s(f_.unit),
                     from / scene::to_rad_per_s(f_.unit), end->message};
      return;
    }
    result.status = status_of(stop.reason);
    result.stop = {reason_of(stop.reason), stop.value, stop.limit, stop.message};
    if (stop.reason == StopReason::closed) result.status = Status::complete;
    if (stop.reason != StopReason::boundary) return;
    const double unit = scene::to_rad_per_s(f_.unit);
    result.stop.value = stop.value / unit;
    result.stop.limit = (stop.value == f_.window.lower ? f_.window.lower : f_.window.upper) / unit;
    result.stop.message = "reached the end of the window at " + frequency(stop.value);
  }

  const BranchOptions& f_;
  std::vector<Known> known_;
  Agenda agenda_{{}, have_same_harmonics};
};

}  // namespace

std::vector<TracedBranch> all_branches(std::vector<TracedBranch> given, const BranchOptions& following) {
  return AllBranches(following).run(std::move(given));
}

}  // namespace arcslip::observables
