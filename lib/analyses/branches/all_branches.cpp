#include <arcslip/analyses/branches/all_branches.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/branch_recording.hpp>
#include <arcslip/analyses/branches/half_branch_entry.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
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

using continuation::BranchPoint;
using continuation::StopReason;
using continuation::Vector;
using elements::Harmonics;

constexpr double same_place = 1e-6;      // distance of two branch points, relative to 1 + |u|, in scales
constexpr double near_end = 1e-3;        // the same
constexpr double same_direction = 0.95;  // cosine

Vector with_frequency(const ResponsePoint& point) {
  Vector v(point.unknowns.size() + 1);
  v << Eigen::Map<const Vector>(point.unknowns.data(), static_cast<Eigen::Index>(point.unknowns.size())),
      point.omega;
  return v;
}

Vector with_frequency(continuation::In u, double omega) {
  Vector v(u.size() + 1);
  v << u, omega;
  return v;
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
    follow_ways();
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
    for (; next_ < ways_.size(); ++next_)
      if (const Way& way = ways_[next_]; !way.followed)
        untraced(way.from, way.kind, way.half_branch.x[way.half_branch.x.size() - 1],
                 "stopped by the caller");
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

  // A half-branch that leaves a known branch.
  struct Way {
    std::size_t from = 0;  // of known_
    std::size_t event = 0;
    std::string kind;
    HalfBranch half_branch;
    bool wider = false;  // of more harmonics: both halves are one
    bool followed = false;
  };

  // How a trace ends.
  struct End {
    double arclength = 0;
    Vector x, tangent;
    std::string message{};
    std::optional<std::size_t> way{};  // that leaves the known branch there
  };

  std::string frequency(double omega) const { return frequency_text(omega, f_.unit); }

  void untraced(std::size_t branch, const std::string& kind, double omega, const std::string& why) {
    known_[branch].response.untraced.push_back("the branch that leaves at the " +
                                               event_kinds::words_of(kind) + " at " + frequency(omega) +
                                               ": " + why);
  }

  bool is_full() const { return static_cast<int>(known_.size()) >= f_.limits.most_branches; }

  std::string limit_reported() const {
    return "as many branches as asked for were traced already (most_branches: " +
           std::to_string(f_.limits.most_branches) + ")";
  }

  // Of the last known branch: all branches that leave it. events: those of its trace.
  void find_half_branches(const std::vector<continuation::Event>& events) {
    const std::size_t k = known_.size() - 1;
    std::map<std::string, WiderBranchPoints> wider;
    const auto& all = known_[k].response.events;
    std::vector<Vector> solutions;
    for (const ResponsePoint& point : known_[k].response.points) solutions.push_back(with_frequency(point));
    for (std::size_t e = 0; e < all.size(); ++e) {
      const std::string& kind = all[e].kind;
      const bool doubles = kind == event_kinds::period_doubling;
      if (!doubles && kind != event_kinds::symmetry_breaking) continue;
      const double omega = all[e].point.omega;
      const hbm::HbmProblem& narrow = *known_[k].problem;
      const Harmonics harmonics =
          without(narrow.harmonics(), doubles ? BrokenSymmetry::period : BrokenSymmetry::mirror_image);
      if (doubles && known_[k].doublings >= f_.limits.doublings) {
        untraced(k, kind, omega,
                 "the period was doubled " + std::to_string(known_[k].doublings) +
                     (known_[k].doublings == 1 ? " time" : " times") + " already (doublings)");
        continue;
      }
      if (harmonics.order > scene::largest_order) {
        untraced(k, kind, omega, "it would have harmonics above " + std::to_string(scene::largest_order));
        continue;
      }
      auto at = wider.find(kind);
      if (at == wider.end()) {
        const auto wide = in_harmonics(narrow, harmonics, f_.window.lower);
        if (const auto dof = model::drifting_dof(wide->model(), hbm::parameters_at(*wide, omega))) {
          untraced(k, kind, omega,
                   "no spring holds the mean position of " + model::coordinate_name(wide->model(), *dof));
          continue;
        }
        at = wider.emplace(kind, WiderBranchPoints(known_[k].problem, wide)).first;
      }
      std::string why;
      auto found = at->second.locate(solutions, all[e].after, why);
      if (!found)
        untraced(k, kind, omega, why);
      else
        ways_.push_back({k, e, kind, std::move(*found), true, false});
    }
    for (const continuation::Event& event : events) {
      const auto* crossing = std::get_if<BranchPoint>(&event.data);
      if (!crossing) continue;
      const double omega = event.point.parameter;
      const auto is_it = [&](const ResponseEvent& other) {
        return other.kind == event_kinds::branch_point && other.point.omega == omega;
      };
      const auto at = std::find_if(all.begin(), all.end(), is_it);
      if (at == all.end()) continue;  // beyond the end of the branch
      if (!event.located || event.nonsmooth || crossing->type == BranchPoint::Type::multiple) {
        untraced(k, at->kind, omega,
                 event.nonsmooth ? "pieces of the laws of contact meet there"
                                 : "several branches cross there at once, as in symmetric structures");
        continue;
      }
      HalfBranch way{known_[k].problem, with_frequency(event.point.u, omega), crossing->tangents[1], 0};
      continuation::Counts counts;
      const continuation::Corrector with(*way.problem, hbm::parameters_at(*way.problem, omega),
                                         model::frequency, {}, counts);
      way.angle = std::acos(std::min(1.0, std::abs(with.dot(crossing->tangents[0], crossing->tangents[1]))));
      const auto index = static_cast<std::size_t>(at - all.begin());
      for (int half = 0; half < 2; ++half) {
        if (!is_known(way, with)) ways_.push_back({k, index, at->kind, way, false, false});
        way.direction = -way.direction;
      }
    }
  }

  // Whether the half-branch leaves a branch point of which the ways are known.
  bool is_known(const HalfBranch& way, const continuation::Corrector& in) const {
    return std::any_of(ways_.begin(), ways_.end(), [&](const Way& other) {
      return meets(other, *way.problem, way.x, in) && !other.wider &&
             in.dot(other.half_branch.direction, way.direction) > same_direction;
    });
  }

  static bool meets(const Way& way, const hbm::HbmProblem& problem, const Vector& x,
                    const continuation::Corrector& in) {
    if (!(way.half_branch.problem->harmonics() == problem.harmonics())) return false;
    const Vector apart = way.half_branch.x - x;
    return std::sqrt(in.dot(apart, apart)) <= same_place * (1 + in.norm_u(x));
  }

  void follow_ways() {
    for (; next_ < ways_.size() && f_.control.keep_going(); ++next_) follow(next_);
  }

  void follow(std::size_t k) {
    if (ways_[k].followed) return;
    const std::size_t from = ways_[k].from;
    const std::string kind = ways_[k].kind;
    const double omega = ways_[k].half_branch.x[ways_[k].half_branch.x.size() - 1];
    if (is_full()) {
      untraced(from, kind, omega, limit_reported());
      return;
    }
    ways_[k].followed = true;
    const auto problem = ways_[k].half_branch.problem;
    continuation::Counts counts;
    continuation::Corrector with(*problem, hbm::parameters_at(*problem, omega), model::frequency, {}, counts);
    const auto entry = enter(ways_[k].half_branch, with);
    if (!entry) {
      untraced(from, kind, omega, "no solution was found on it next to the branch point");
      return;
    }
    const Eigen::Index n = entry->v.size() - 1;
    if (!(entry->v[n] >= f_.window.lower && entry->v[n] <= f_.window.upper)) {
      untraced(from, kind, omega, "it leaves the window at once");
      return;
    }
    Run run = begin(problem);
    const Vector& x = ways_[k].half_branch.x;
    with.move_to(x, continuation::Needs::jacobian);
    const Vector u = x.head(n), p = hbm::parameters_at(*problem, omega);
    run.course.points.emplace_back(
        -entry->step, run.observer->observe({u, p, ways_[k].half_branch.direction, 0, with.evaluator(),
                                             with.factors(), omega, with.scratch()},
                                            PointCondition::branch_point));
    set_apart(event_kinds::branch_point, run.course.points.front().second);
    estimate_as_at(ways_[k], run.course.points.front().second);
    continuation::Start start{entry->v.head(n), hbm::parameters_at(*problem, entry->v[n]), model::frequency,
                              1, entry->tangent};
    trace(start, entry->step, run);
    ResponseBranch& response = run.known.response;
    add(counts, response.solver);
    run.known.doublings = known_[from].doublings + (kind == event_kinds::period_doubling ? 1 : 0);
    response.parent = static_cast<int>(known_.size() - from);
    response.leaves = {kind, ways_[k].event, omega};
    if (kind == event_kinds::symmetry_breaking || known_[from].response.symmetry == Symmetry::mirror_pair)
      response.symmetry = Symmetry::mirror_pair;
    add_known(std::move(run), omega);
  }

  // The equations are singular at a branch point. For fewer harmonics, those of the branch that is left
  // there, they are not.
  void estimate_as_at(const Way& way, ResponsePoint& point) const {
    const ResponsePoint& event = known_[way.from].response.events[way.event].point;
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
        run.course.events.emplace_back(event->point.arclength,
                                       ResponseEvent{event->monitor, event->nonsmooth, event->located,
                                                     run.observer->observe(now, held_by(*event), true), 0});
        set_apart(event->monitor, run.course.events.back().second.point);
        return true;
      }
      run.course.points.emplace_back(now.arclength, run.observer->observe(now));
      f_.at(now.parameter);
      return f_.control.keep_going();
    };
    const hbm::HbmProblem& problem = *run.known.problem;
    continuation::Options options = frequency_options(f_.window, f_.steps, f_.control);
    options.step.initial = step;
    continuation::Tracer tracer(run.known.problem, start, options, run.monitors, record);
    continuation::Counts counts;
    const continuation::Corrector in(problem, start.p, model::frequency, {}, counts);
    const auto possible = fewer(problem, start.u);
    std::size_t seen = 0;
    const auto look = [&] {
      const auto& events = tracer.branch().events;
      for (; seen < events.size() && !run.end; ++seen) run.end = end_at(problem, events[seen], in, possible);
    };
    while (!run.end && tracer.step()) look();
    look();
    continuation::Branch traced = tracer.take();
    add(traced, run.known.response.solver);
    run.events = std::move(traced.events);
    run.stop = std::move(traced.stop);
    if (!run.end) return;
    run.course.end_at(run.end->arclength, near_end * (1 + in.norm_u(run.end->x)));
    ResponsePoint& last = run.course.points.back().second;
    if (run.end->way && last.omega == run.end->x[run.end->x.size() - 1])
      estimate_as_at(ways_[*run.end->way], last);
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
    follow_ways();
  }

  // Whether the branch point that a trace has met is its end.
  std::optional<End> end_at(const hbm::HbmProblem& problem, const continuation::Event& event,
                            const continuation::Corrector& in, const std::vector<Harmonics>& possible) {
    const auto* crossing = std::get_if<BranchPoint>(&event.data);
    if (!crossing || !event.located || event.nonsmooth) return {};
    const Vector x = with_frequency(event.point.u, event.point.parameter);
    End end{event.point.arclength, x, crossing->tangents.front()};
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      Way& other = ways_[i];
      if (!meets(other, problem, x, in)) continue;
      if (!other.wider && in.dot(other.half_branch.direction, -end.tangent) < same_direction) continue;
      other.followed = true;
      end.way = i;
      end.message = "reached the " + event_kinds::words_of(other.kind) + " at " +
                    frequency(event.point.parameter) + " of a branch that is known";
      return end;
    }
    for (const Harmonics& fewer : possible)
      if (within(problem, event.point.u, fewer)) {
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
  std::vector<Way> ways_;
  std::size_t next_ = 0;  // of ways_
};

}  // namespace

std::vector<TracedBranch> all_branches(std::vector<TracedBranch> given, const BranchOptions& following) {
  return AllBranches(following).run(std::move(given));
}

}  // namespace arcslip::observables
