#include <arcslip/analyses/curves/special_points.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/branches/unbounded_resonance.hpp>
#include <arcslip/analyses/curves/special_curve_results.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/observables/observe.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::StopReason;
using continuation::Vector;

void add(const Solution& point, LookedAt& to) {
  if (point.unbounded) return;
  to.amplitude = std::max(to.amplitude, point.amplitude);
  to.estimate = std::fmax(to.estimate, std::abs(point.truncation_estimate));
  to.flagged = to.flagged || point.truncation_flagged;
}

bool others_leave_at(const std::string& kind) {
  return kind == event_kinds::symmetry_breaking || kind == event_kinds::period_doubling ||
         kind == event_kinds::branch_point;
}

// Special points of one response after the other, at one value of a parameter.
class SpecialPointSearch {
 public:
  SpecialPointSearch(std::shared_ptr<const model::Model> model, double over, const FrequencyWindow& window,
                     const std::vector<std::string>& kinds, const control::Control& control)
      : model_(std::move(model)),
        over_(over),
        window_(window),
        kinds_(kinds),
        control_(control),
        stability_(std::any_of(kinds.begin(), kinds.end(), is_bifurcation)),
        watched_{.stability = {stability_},
                 .phase = std::find(kinds.begin(), kinds.end(), event_kinds::phase_resonance) != kinds.end(),
                 .branch_points = stability_} {}

  SpecialPoints run(OtherBranches others) {
    BeyondPole from{{window_.lower}};
    bool turned_back = false;
    for (int piece = 0; piece <= 2 * model_->dofs && from.starts.front() < window_.upper && !turned_back;
         ++piece) {
      BeyondPole reached = add_from(from, 1);
      turned_back = !reached.ahead || reached.starts.front() <= from.starts.front();
      from = std::move(reached);
    }
    // Responses above the fold at which it turned back are on another branch, or reached from above.
    if (turned_back) add_from({{window_.upper}}, -1);
    if (others == OtherBranches::from_ends && found_.failure.empty() && problem_ &&
        end_search(*model_) == EndSearch::made)
      add_others_from_ends();
    return std::move(found_);
  }

 private:
  Record recording(PoleWatch& watch) {
    return [this, &watch](Observer& observer, const Accepted& now, const continuation::Event* event) {
      if (!event) {
        if (stability_)
          add(observer.observe(now, PointCondition::parameter, solution_alone), found_.looked_at);
        return !watch.is_next_to_pole(observer.problem(), now.p, now.u);
      }
      if (stability_ && others_leave_at(event->monitor))
        found_.leaving.push_back({event->monitor, event->point.parameter});
      if (std::find(kinds_.begin(), kinds_.end(), event->monitor) == kinds_.end()) return true;
      const Solution point = observer.observe(now, PointCondition::parameter, solution_alone);
      if (event->monitor == event_kinds::peak && is_rounding(point)) return true;
      Vector x(now.u.size() + 1);
      x << now.u, now.parameter;
      found_.points.push_back({{}, over_, std::move(x), event->nonsmooth, event->monitor, point.amplitude});
      return true;
    };
  }

  // What a traced branch reports besides its special points, those from `first` on.
  void take(const FrequencyBranch& traced, std::size_t first) {
    problem_ = traced.problem;
    if (found_.unknown_stability.empty()) found_.unknown_stability = traced.unknown_stability;
    for (std::size_t i = first; i < found_.points.size(); ++i) found_.points[i].problem = traced.problem;
    if (traced.branch.points.empty()) return;
    for (const auto* end : {&traced.branch.points.front(), &traced.branch.points.back()})
      if (end->parameter == window_.lower || end->parameter == window_.upper)
        ends_.push_back({end->parameter, end->u});
  }

  // From a place to the next pole, or to the end of the window. Returns where the branch goes on beyond that
  // pole, or the end of the window that it reached.
  BeyondPole add_from(const BeyondPole& place, int direction) {
    const double from = place.starts.front();
    if (const auto growth = unbounded_resonance(model_, from); growth.unbounded) {
      found_.unbounded = growth.message;
      return beyond_pole_at_start(from, window_.upper - window_.lower);
    }
    const std::size_t before = found_.points.size();
    PoleWatch watch(window_.lower, window_.upper);
    const auto swept = frequency_branch(model_, window_, from, recording(watch), direction, Steps::curve,
                                        control_, watched_, place.displacement);
    const auto& stop = swept.branch.stop;
    if (stop.reason == StopReason::start_failed && place.starts.size() > 1) {
      BeyondPole farther = place;
      farther.starts.erase(farther.starts.begin());
      return add_from(farther, direction);
    }
    take(swept, before);
    if (watch.growth().unbounded) {
      found_.unbounded = watch.growth().message;
      return watch.beyond();
    }
    if (stop.reason == StopReason::boundary) return {{stop.value}};
    found_.failure = stop.message;
    return {{window_.upper}};
  }

  // A window may begin or end within a hysteresis: the responses that its ends have besides.
  void add_others_from_ends() {
    for (const double end : {window_.lower, window_.upper})
      for (const Vector& u :
           further_responses(problem_, hbm::parameters_at(*problem_, end), responses_at(end), control_)) {
        const std::vector<Vector> known = responses_at(end);
        if (index_of(*problem_, u, known) == known.size() && control_.keep_going()) add_inwards(end, u);
      }
  }

  std::vector<Vector> responses_at(double omega) const {
    std::vector<Vector> all;
    for (const auto& [at, u] : ends_)
      if (at == omega) all.push_back(u);
    return all;
  }

  void add_inwards(double end, const Vector& u) {
    const bool is_up = end == window_.lower;
    const std::size_t before = found_.points.size();
    PoleWatch watch(window_.lower, window_.upper);
    const auto traced =
        frequency_branch_part(problem_, window_, end, is_up ? window_.upper : window_.lower, u,
                              recording(watch), is_up ? 1 : -1, Steps::curve, control_, watched_);
    take(traced, before);
    if (watch.growth().unbounded)
      found_.unbounded = watch.growth().message;
    else if (traced.branch.stop.reason != StopReason::boundary && found_.failure.empty())
      found_.failure = "from another response at its end: " + traced.branch.stop.message;
  }

  std::shared_ptr<const model::Model> model_;
  double over_;
  const FrequencyWindow& window_;
  const std::vector<std::string>& kinds_;
  const control::Control& control_;
  bool stability_;
  MonitoredEvents watched_;
  SpecialPoints found_;
  std::shared_ptr<const hbm::HbmProblem> problem_;  // of the branch that was traced last
  std::vector<std::pair<double, Vector>> ends_;     // of all branches, at the ends of the window
};

}  // namespace

SpecialPoints special_points(const OverParameter& way, double over, const FrequencyWindow& window,
                             const std::vector<std::string>& kinds, OtherBranches others,
                             const control::Control& control) {
  return SpecialPointSearch(way.at(over), over, window, kinds, control).run(others);
}

SpecialPoints special_points_of_all(const OverParameter& way, double over, const FrequencyWindow& window,
                                    const std::vector<std::string>& kinds, const BranchLimits& limits,
                                    scene::FrequencyUnit unit, const control::Control& control) {
  const double per_unit = scene::to_rad_per_s(unit);
  FrequencyRange range{window.lower / per_unit, window.upper / per_unit};
  range.branches = Branches::all;
  range.limits = limits;
  range.points = range.events = {.motion = false};
  const auto all = traced_branches(way.at(over), unit, range, Steps::events, control);
  SpecialPoints found;
  found.branches = static_cast<int>(all.size());
  for (const TracedBranch& branch : all) {
    const ResponseBranch& response = branch.response;
    for (const Solution& point : response.points) add(point, found.looked_at);
    for (const ResponseEvent& event : response.events) add(event.point, found.looked_at);
    for (const ResponseEvent& event : response.events) {
      if (std::find(kinds.begin(), kinds.end(), event.kind) == kinds.end()) continue;
      const auto n = static_cast<Eigen::Index>(event.point.unknowns.size());
      Vector x(n + 1);
      x << Eigen::Map<const Vector>(event.point.unknowns.data(), n), event.point.omega;
      found.points.push_back(
          {branch.problem, over, std::move(x), event.nonsmooth, event.kind, event.point.amplitude});
    }
    if (found.unknown_stability.empty()) found.unknown_stability = response.unknown_stability;
    if (found.failure.empty() && response.status == Status::failed) found.failure = response.stop.message;
    if (response.stop.reason == reasons::unbounded) found.unbounded = response.stop.message;
    found.untraced.insert(found.untraced.end(), response.untraced.begin(), response.untraced.end());
  }
  return found;
}

}  // namespace arcslip::observables
