#include <arcslip/analyses/responses/responses_at.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/harmonic_refinement.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/branches/passages.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/analyses/branches/unbounded_resonance.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/unresolved_resonances.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace arcslip::observables {
namespace {

using continuation::StopReason, continuation::Vector;

constexpr double search_ratio = 4;  // of frequencies: the window in which other responses are looked for
constexpr double lowest_ratio =
    10;  // the same down to below natural frequencies, from which resonances may bend up
constexpr double below_natural = 0.5;
constexpr int most_deflations = 16;
constexpr double next_to = 1e-2;  // relative

FrequencyWindow search_window(const model::Model& model, double omega) {
  FrequencyWindow window{omega / search_ratio, omega * search_ratio};
  const auto modes = modes_at_rest(model, model::defaults(model), Contacts::free);
  for (const ModeAtRest& mode : modes.value_or(std::vector<ModeAtRest>()))
    if (const double at = mode.omega / model.force_harmonic; at > omega / lowest_ratio) {
      window.lower = std::min(window.lower, below_natural * at);
      break;
    }
  return window;
}

// The responses at omega on branches through a wide window.
class ResponseSearch {
 public:
  ResponseSearch(std::shared_ptr<const model::Model> model, double omega, const control::Control& control,
                 ResponsesAt& found)
      : model_(std::move(model)),
        omega_(omega),
        window_(search_window(*model_, omega)),
        control_(control),
        found_(found),
        p_(hbm::parameters_at(*found.problem, omega)),
        all_(*found.problem, p_, model::frequency) {}

  void run(const std::vector<Vector>& guesses) {
    found_.several = true;
    found_.window = window_;
    const Vector first = found_.u.front();
    const auto swept =
        frequency_branch(model_, window_, window_.lower, {}, 1, Steps::passage, control_, watched_);
    take(swept);
    if (const auto& stop = swept.branch.stop;
        stop.reason == StopReason::boundary && stop.value != window_.upper)
      doubt_of_branch(stop.message);
    add_from_rest(first);
    for (const Vector& guess : guesses)
      if (const auto u = hbm::response_near(*found_.problem, p_, guess); u && !stopped() && all_.add(*u))
        follow(*u);
    for (const Vector& other : further_responses(found_.problem, p_, all_.u, control_))
      if (!stopped() && all_.add(other)) follow(other);
    for (int k = 0; k < most_deflations && !stopped(); ++k) {
      const auto other = solution_nearby(*found_.problem, p_, all_.u, control_);
      if (!other || !all_.add(*other)) break;
      follow(*other);
    }
    found_.u = std::move(all_.u);
    if (found_.doubt.empty()) found_.doubt = all_.doubt;
  }

 private:
  bool stopped() const { return !control_.keep_going(); }

  // Newton's method from rest may have ended next to a response that it does not come to.
  void add_from_rest(const Vector& first) {
    const auto corrected = hbm::response_near(*found_.problem, p_, first);
    const bool is_next = std::any_of(all_.u.begin(), all_.u.end(), [&](const Vector& other) {
      return (first - other).norm() <= next_to * other.norm();
    });
    const bool is_off = corrected && (first - *corrected).norm() > same_solution * corrected->norm();
    const Vector start = is_off ? *corrected : first;
    const bool is_one = corrected || all_.u.empty();
    if (corrected ? !all_.has(start) : is_one) {
      all_.u.push_back(start);
      follow(start);
    }
    if (is_one)
      put_first(start);
    else if (!is_next)
      doubt("one that was found from rest could not be corrected");
  }

  // The response that is found from rest comes first, as where no others are looked for.
  void put_first(const Vector& u) {
    const auto nearest =
        std::min_element(all_.u.begin(), all_.u.end(),
                         [&](const Vector& a, const Vector& b) { return (a - u).norm() < (b - u).norm(); });
    *nearest = u;
    std::rotate(all_.u.begin(), nearest, nearest + 1);
  }

  // The branch through a response, both ways.
  void follow(const Vector& u) {
    for (const int direction : {1, -1}) {
      const double to = direction > 0 ? window_.upper : window_.lower;
      const auto traced = frequency_branch_part(found_.problem, window_, omega_, to, u, {}, direction,
                                                Steps::passage, control_, watched_);
      take(traced);
      if (traced.branch.stop.reason == StopReason::closed) return;
    }
  }

  void take(const FrequencyBranch& traced) {
    const continuation::Branch& branch = traced.branch;
    all_.take(branch);
    const bool ends = branch.stop.reason == StopReason::boundary || branch.stop.reason == StopReason::closed;
    if (!ends) doubt_of_branch(branch.stop.message);
  }

  void doubt_of_branch(const std::string& why) { doubt("the branch could not be continued: " + why); }

  void doubt(const std::string& why) {
    if (found_.doubt.empty()) found_.doubt = "other responses may be missing, since " + why;
  }

  std::shared_ptr<const model::Model> model_;
  double omega_;
  FrequencyWindow window_;
  const control::Control& control_;
  ResponsesAt& found_;
  const Vector p_;
  Passages all_;
  const MonitoredEvents watched_{.passage = omega_};
};

// The first point of a branch that begins there, which is corrected and observed as every other one.
continuation::Branch observe_one(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& u,
                                 double omega, Observer& observer, std::optional<ResponsePoint>& point) {
  continuation::Options options;
  options.lower = omega;
  options.upper = omega * search_ratio;
  options.check_jacobian = false;
  const Vector p = hbm::parameters_at(*problem, omega);
  auto branch = continuation::trace(problem, {u, p, model::frequency, 1}, options, {},
                                    [&](const continuation::Accepted& now, const continuation::Event*) {
                                      point = observer.observe(now, PointCondition::parameter, everything);
                                      return false;
                                    });
  add_scene_hint(problem->model(), p, branch);
  return branch;
}

class Points {
 public:
  Points(const scene::Scene& scene, const PointSettings& settings, const control::Control& control)
      : scene_(scene),
        settings_(settings),
        omega_(settings.frequency * scene::to_rad_per_s(scene.frequency_unit)),
        model_(model_of(scene, control)),
        control_(control) {
    progress_.frequency = settings.frequency;
    progress_.item = "response";
  }

  std::vector<PointResponse> run(std::span<const PointResponse> known) {
    control_.report(progress_);
    const ResponsesAt found = responses_at(model_, omega_, end_search(*model_), control_, guesses(known));
    if (!control_.keep_going()) return {ended(Status::stopped, reasons::user, "stopped by the caller")};
    if (!found.unbounded.empty())
      return {ended(Status::failed, reasons::unbounded,
                    "no response is bounded " + place() + ": " + found.unbounded)};
    if (found.u.empty())
      return {ended(Status::failed, reasons::start_failed,
                    "no periodic response was found " + place() + ": " + found.failure)};
    std::vector<PointResponse> all;
    for (const Vector& u : found.u) {
      all.push_back(at(found.problem, u));
      if (all.size() == 1) add(found.work, all.back().solver);
      if (found.several) all.back().found = static_cast<int>(found.u.size());
      if (found.several && all.back().status == Status::complete)
        all.back().stop.message += (found.u.size() == 1 ? ", the only one found on the branch from "
                                                        : ", one of " + std::to_string(found.u.size()) +
                                                              " found on the branch from ") +
                                   frequency_text(found.window.lower, scene_.frequency_unit) + " to " +
                                   frequency_text(found.window.upper, scene_.frequency_unit) +
                                   ", by deflation, and on the branches through those";
      if (all.back().status == Status::complete) all.back().stop.message += without_search(*model_);
      if (!found.doubt.empty()) all.back().doubt = found.doubt;
    }
    return all;
  }

 private:
  // In the harmonics of the scene.
  std::vector<Vector> guesses(std::span<const PointResponse> known) const {
    ResponseBranch from;
    const ResponseBranch to = described(*model_);
    std::vector<Vector> all;
    for (const PointResponse& each : known) {
      if (each.point.unknowns.empty()) continue;
      from.harmonics = each.harmonics;
      const std::vector<double> unknowns = in_harmonics(each.point, from, to).unknowns;
      all.push_back(Eigen::Map<const Vector>(unknowns.data(), static_cast<Eigen::Index>(unknowns.size())));
    }
    return all;
  }

  std::string place() const { return "at " + frequency_text(omega_, scene_.frequency_unit); }

  PointResponse ended(Status status, const results::Reason& reason, const std::string& message) const {
    const ResponseBranch description = described(*model_);
    PointResponse result;
    result.status = status;
    result.stop = {reason, settings_.frequency, 0, message};
    result.parameters = description.parameters;
    result.harmonics = description.harmonics;
    return result;
  }

  PointResponse at(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& u) {
    const auto began = std::chrono::steady_clock::now();
    Observer observer(problem);
    if (settings_.stability) observer.watch_stability(settings_.stability);
    std::optional<ResponsePoint> point;
    const auto branch = observe_one(problem, u, omega_, observer, point);
    PointResponse result = ended(Status::complete, reasons::solved, "the response was found " + place());
    result.solver.unknowns = problem->size();
    add(branch, result.solver);
    if (!point) {
      result.status = Status::failed;
      result.stop.reason = reason_of(branch.stop.reason);
      result.stop.message = branch.stop.message;
      return result;
    }
    result.point = std::move(*point);
    if (const std::string unknown = observer.unknown_stability(); !unknown.empty())
      result.doubt = "without its stability: " + unknown;
    if (settings_.offsets == Offsets::range)
      result.offset_range =
          offset_range(*problem, Eigen::Map<const Vector>(result.point.unknowns.data(), problem->size()),
                       hbm::parameters_at(*problem, omega_));
    result.history = history(scene_, {}, result.point, loop_angles(result.point, settings_.steps));
    result.solver.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return result;
  }

  const scene::Scene& scene_;
  PointSettings settings_;
  double omega_;
  std::shared_ptr<const model::Model> model_;
  const control::Control control_;
  control::Progress progress_;
};

}  // namespace

ResponsesAt responses_at(const std::shared_ptr<const model::Model>& model, double omega, EndSearch search,
                         const control::Control& control, const std::vector<Vector>& guesses) {
  ResponsesAt found;
  const auto stopped = [&] { return !control.keep_going(); };
  if (const auto growth = unbounded_resonance(model, omega); growth.unbounded) {
    found.unbounded = growth.message;
    return found;
  }
  const FirstResponse first = first_response(model, omega, omega, control);
  found.problem = first.problem;
  found.failure = first.failure;
  found.work = first.work;
  if (stopped() || !first.u) return found;
  found.u.push_back(*first.u);
  if (search == EndSearch::made) ResponseSearch(model, omega, control, found).run(guesses);
  return found;
}

ResponseOfAmplitude response_of_amplitude(const std::shared_ptr<const model::Model>& model, double omega,
                                          double amplitude, const control::Control& control) {
  const auto search = may_have_several_responses(*model) ? EndSearch::made : EndSearch::needless;
  const ResponsesAt all = responses_at(model, omega, search, control);
  ResponseOfAmplitude found;
  found.problem = all.problem;
  found.failure = all.unbounded.empty() ? all.failure : all.unbounded;
  for (const Vector& u : all.u) {
    if (!control.keep_going()) break;
    Observer observer(all.problem);
    observer.watch_stability();
    std::optional<ResponsePoint> point;
    const auto branch = observe_one(all.problem, u, omega, observer, point);
    if (!point) {
      found.failure = branch.stop.message;
      continue;
    }
    const auto difference = [&](const ResponsePoint& at) { return std::abs(at.amplitude - amplitude); };
    if (found.point && difference(*found.point) <= difference(*point)) continue;
    found.u = Eigen::Map<const Vector>(point->unknowns.data(), all.problem->size());
    found.point = std::move(point);
  }
  return found;
}

std::vector<PointResponse> point_responses(const scene::Scene& scene, const PointSettings& settings,
                                           const control::Control& control,
                                           std::span<const PointResponse> known) {
  return Points(scene, settings, control).run(known);
}

}  // namespace arcslip::observables
