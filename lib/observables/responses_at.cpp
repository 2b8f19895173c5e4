#include <arcslip/observables/responses_at.hpp>

#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/reasons.hpp>
#include <arcslip/observables/study_branches.hpp>
#include <arcslip/observables/unbounded.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr double search_ratio = 4;  // of frequencies: the window in which other responses are looked for

bool may_have_several(const model::Model& model) {
  const Vector p = model::defaults(model);
  return std::any_of(model.elements.begin(), model.elements.end(), [&](const auto& element) {
    const std::vector<double> fields = element.fields(p);
    for (int i = 0; i < element.law->directions(); ++i)
      if (element.law->traits(fields, i).several_responses) return true;
    return false;
  });
}

// Adds those at which a frequency branch through a wide window passes omega.
void add_others(const std::shared_ptr<const model::Model>& model, double omega, const GoOn& go_on,
                ResponsesAt& found) {
  if (!may_have_several(*model)) return;
  const FrequencyWindow window{omega / search_ratio, omega * search_ratio};
  const auto swept = frequency_branch(model, window, window.lower, {}, 1, Steps::passage, go_on);
  const Vector p = hbm::parameters_at(*swept.problem, omega);
  const auto& points = swept.branch.points;
  const auto& stop = swept.branch.stop;
  if (stop.reason != continuation::StopReason::boundary || stop.value != window.upper)
    found.doubt =
        "other responses may be missing, since the branch from a quarter to four times the frequency "
        "could not be continued: " +
        stop.message;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto &a = points[i - 1], &b = points[i];
    if ((a.parameter < omega) == (b.parameter < omega)) continue;
    const double share = (omega - a.parameter) / (b.parameter - a.parameter);
    const auto u = hbm::response_near(*swept.problem, p, a.u + share * (b.u - a.u));
    const auto is_same = [&](const Vector& other) {
      return (*u - other).norm() <= same_solution * other.norm();
    };
    if (!u)
      found.doubt = "another response, where a branch crosses the frequency, could not be corrected";
    else if (std::none_of(found.u.begin(), found.u.end(), is_same))
      found.u.push_back(*u);
  }
}

// The first point of a branch that begins there, which is corrected and observed as every other one.
continuation::Branch observe_one(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& u,
                                 double omega, Observer& observer, std::optional<ResponsePoint>& point) {
  continuation::Options options;
  options.lower = omega;
  options.upper = omega * search_ratio;
  options.check_jacobian = false;
  return continuation::trace(problem, {u, hbm::parameters_at(*problem, omega), model::frequency, 1}, options,
                             {}, [&](const continuation::Accepted& now, const continuation::Event*) {
                               point = observer.observe(now, HeldBy::parameter, true);
                               return false;
                             });
}

class Points {
 public:
  Points(const scene::Scene& scene, const PointSettings& settings, const ProgressCallback& report)
      : scene_(scene),
        settings_(settings),
        omega_(settings.frequency * scene::to_rad_per_s(scene.frequency_unit)),
        model_(model_of(scene, [this] { return !go_on(); })),
        report_(report) {
    progress_.frequency = settings.frequency;
    progress_.item = "response";
  }

  std::vector<PointResponse> run() {
    const ResponsesAt found = responses_at(model_, omega_, [this] { return go_on(); });
    if (stopped_) return {ended(Status::stopped, reasons::user, "stopped by the caller")};
    if (!found.unbounded.empty())
      return {ended(Status::failed, reasons::unbounded,
                    "no response is bounded " + place() + ": " + found.unbounded)};
    if (found.u.empty())
      return {ended(Status::failed, reasons::start_failed,
                    "no periodic response was found " + place() + ": " + found.failure)};
    std::vector<PointResponse> all;
    for (const Vector& u : found.u) {
      all.push_back(at(found.problem, u));
      if (!found.doubt.empty()) all.back().doubt = found.doubt;
    }
    return all;
  }

 private:
  bool go_on() {
    if (!stopped_ && report_ && !report_(progress_)) stopped_ = true;
    return !stopped_;
  }

  std::string place() const { return "at " + frequency_text(omega_, scene_.frequency_unit); }

  PointResponse ended(Status status, const results::Reason& reason, const std::string& message) const {
    const ResponseBranch description = described(*model_);
    PointResponse result;
    result.status = status;
    result.stop = {reason, settings_.frequency, 0, message};
    result.parameters = description.parameters;
    result.harmonics = description.harmonics;
    result.solver = description.solver;
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
    add(branch.counts, result.solver);
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
  const ProgressCallback& report_;
  Progress progress_;
  bool stopped_ = false;
};

}  // namespace

ResponsesAt responses_at(const std::shared_ptr<const model::Model>& model, double omega, const GoOn& go_on) {
  ResponsesAt found;
  const auto stopped = [&] { return go_on && !go_on(); };
  if (const auto growth = unbounded_resonance(model, omega); growth.unbounded) {
    found.unbounded = growth.message;
    return found;
  }
  const FirstResponse first = first_response(model, omega, omega, go_on);
  found.problem = first.problem;
  found.failure = first.failure;
  if (stopped() || !first.u) return found;
  found.u.push_back(*first.u);
  add_others(model, omega, go_on, found);
  return found;
}

ResponseOfAmplitude response_of_amplitude(const std::shared_ptr<const model::Model>& model, double omega,
                                          double amplitude, const GoOn& go_on) {
  const ResponsesAt all = responses_at(model, omega, go_on);
  ResponseOfAmplitude found;
  found.problem = all.problem;
  found.failure = all.unbounded.empty() ? all.failure : all.unbounded;
  for (const Vector& u : all.u) {
    if (go_on && !go_on()) break;
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
                                           const ProgressCallback& progress) {
  return Points(scene, settings, progress).run();
}

}  // namespace arcslip::observables
