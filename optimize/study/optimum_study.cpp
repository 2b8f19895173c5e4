#include <arcslip/optimize/study/optimum_study.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/control/ordered_parallel_for.hpp>
#include <arcslip/optimize/evaluation/design_space.hpp>
#include <arcslip/optimize/evaluation/interruption.hpp>
#include <arcslip/optimize/evaluation/scaled_parameter.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double around[] = {0.5, 1, 2};  // times the optimum: where responses are shown, to four digits
constexpr std::size_t most_shown = 12;    // cases in one figure

// To four digits, as a label of a figure shows it.
double rounded(double value) {
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  return value == 0 ? 0
         : unit < 1 ? std::round(value * std::round(1 / unit)) / std::round(1 / unit)
                    : std::round(value / unit) * unit;
}

// The frequency responses at a multiple of the optimum, if the parameters may have it.
std::vector<observables::ResponseBranch> responses_at_multiple(scene::Scene scene,
                                                               const OptimumProblem& problem,
                                                               const std::vector<double>& design,
                                                               double factor,
                                                               const control::Control& control) {
  std::vector<std::pair<std::string, double>> set;
  try {
    for (std::size_t k = 0; k < design.size(); ++k) {
      const double value = rounded(factor * design[k]);
      scene::set(scene, problem.over[k].name, value);
      set.emplace_back(problem.over[k].name, value);
    }
  } catch (const scene::ParameterError&) {
    return {};
  }
  auto branches =
      observables::frequency_response(scene, {problem.frequency_from, problem.frequency_to}, control);
  for (auto& branch : branches) branch.set = set;
  return branches;
}

scene::Scene with_values(scene::Scene scene, const LoadCaseResult& of) {
  for (const auto* values : {&of.set, &of.scatter})
    for (const auto& [name, value] : *values) scene::set(scene, name, value);
  return scene;
}

// Whether two cases differ in their response alone.
bool differ_in_place(const LoadCaseResult& a, const LoadCaseResult& b) {
  return a.set == b.set && a.scatter == b.scatter && a.weight == b.weight;
}

// Whether a case is one of those for all places of which the scene's response is the largest, with the same
// values: their largest is then the envelope.
bool is_one_of_all_places(const scene::Scene& scene, const OptimumProblem& problem,
                          const std::vector<LoadCaseResult>& cases, const LoadCaseResult& of) {
  std::vector<scene::Direction> places = scene.responses.front().others;
  if (places.empty()) return false;
  places.push_back(scene.responses.front().direction);
  const auto is_at = [&](const LoadCaseResult& each, const scene::Direction& place) {
    return each.of < problem.cases.size() && problem.cases[each.of].response == place;
  };
  return std::any_of(places.begin(), places.end(), [&](auto& place) { return is_at(of, place); }) &&
         std::all_of(places.begin(), places.end(), [&](auto& place) {
           return std::any_of(cases.begin(), cases.end(),
                              [&](auto& each) { return is_at(each, place) && differ_in_place(each, of); });
         });
}

// The cases with curves of their own: the highest, and of those that differ in the place alone the highest.
std::vector<CaseCurves> cases_shown(const scene::Scene& scene, const OptimumProblem& problem,
                                    const std::vector<LoadCaseResult>& cases) {
  std::vector<std::size_t> order(cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t c) { return cases[c].weight * cases[c].amplitude; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
  std::vector<CaseCurves> shown;
  for (const std::size_t c : order) {
    const bool place = is_one_of_all_places(scene, problem, cases, cases[c]);
    const bool again = place && std::any_of(shown.begin(), shown.end(), [&](const CaseCurves& before) {
                         return before.all_places && differ_in_place(cases[before.of], cases[c]);
                       });
    if (!again && shown.size() < most_shown) shown.push_back({.of = c, .all_places = place});
  }
  std::sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.of < b.of; });
  return shown;
}

std::vector<CaseCurves> curves_of_cases(const scene::Scene& scene, const OptimumProblem& problem,
                                        const Optimum& optimum, const control::Control& control) {
  std::vector<CaseCurves> all;
  for (CaseCurves curves : cases_shown(scene, problem, optimum.cases)) {
    if (!control.keep_going()) break;
    const LoadCaseResult& each = optimum.cases[curves.of];
    const scene::Scene in_case =
        curves.all_places ? with_values(scene, each) : scene_of(scene, problem, each);
    if (problem.over.size() == 1) curves.peaks = curves_of_peaks(in_case, problem, control);
    curves.responses = responses_at_multiple(in_case, problem, optimum.design, 1, control);
    all.push_back(std::move(curves));
  }
  return all;
}

// Reports progress and the current phase.
class Teller {
 public:
  Teller(const control::Control& control, const scene::Scene& scene, const char* item)
      : control_(control), unit_(scene::to_rad_per_s(scene.frequency_unit)) {
    reported_.item = item;
    reported_.share_done = std::numeric_limits<double>::quiet_NaN();
    reported_.counted = "evaluations";
    begin("the initial design");
  }

  void begin(const char* phase) {
    reported_.phase = phase;
    control_.report(reported_);
  }
  const char* phase() const { return reported_.phase; }

  void tell(const OptimumProgress& now) {
    reported_.points = now.evaluations;
    reported_.counted = now.evaluations == 1 ? "evaluation" : "evaluations";
    reported_.frequency = now.omega / unit_;
    reported_.best = std::isfinite(now.best) ? now.best : observables::no_value;
    reported_.phase = now.phase;
    control_.report(reported_);
  }
  // Of a curve of optima. share: of its way.
  void tell(long points, const OptimumPoint& now, double share) {
    reported_.points = points;
    reported_.counted = "points";
    reported_.frequency = now.response.omega / unit_;
    reported_.best = now.amplitude;
    reported_.phase = "the curve";
    reported_.share_done = share;
    control_.report(reported_);
  }

 private:
  const control::Control control_;
  double unit_;
  control::Progress reported_;
};

// Adds the curves of figures and the direct method, until the control ends; the result is then not complete.
void add_curves(OptimumResult& result, const scene::Scene& with, const OptimumExtent& extent,
                const control::Control& control, Teller& teller) {
  const control::Control quiet = control.quiet();
  const auto begin = [&](const char* phase) {
    if (control.keep_going()) teller.begin(phase);
  };
  const bool bounded = std::isfinite(result.optimum.amplitude);
  const bool limited = !result.problem.limits.empty() || !result.problem.linear_limits.empty();
  if (extent.curves && result.has_cases() && bounded) {
    begin("the curves of the cases");
    result.curves = curves_of_cases(with, result.problem, result.optimum, quiet);
  }
  if (!result.has_cases() && result.problem.over.size() == 1 && !limited) {
    begin("the direct method");
    result.direct = direct_optimum(with, result.problem, quiet);
  }
  begin("the responses at the optimum");
  for (const double factor : around)
    if (!result.has_cases() && bounded && (factor == 1 || extent.alone) && control.keep_going()) {
      auto more = responses_at_multiple(with, result.problem, result.optimum.design, factor, quiet);
      std::move(more.begin(), more.end(), std::back_inserter(result.responses));
    }
}

// A study that was ended early is not complete, whatever the result of its search.
void end_early(OptimumResult& result, const observables::Stop& why) {
  const std::string before = result.stop.message;
  result.stop = why;
  result.stop.message += "; of the search: " + before;
  result.status = observables::Status::stopped;
}

OptimumOptions options_of(const SearchSettings& search) {
  OptimumOptions options;
  options.algorithm = search.algorithm;
  options.evaluations = search.evaluations;
  options.seconds = search.seconds;
  if (!search.local.empty()) options.local = LocalOptions{search.local, options.tolerances};
  options.population = search.population;
  options.starts = search.starts;
  options.seed = static_cast<unsigned long>(search.seed);
  return options;
}

}  // namespace

double OptimumResult::difference_of_design() const {
  if (!direct.found || optimum.design.size() != 1) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(optimum.design[0] / direct.point.over - 1);
}

double OptimumResult::difference_of_amplitude() const {
  if (!direct.found || optimum.design.size() != 1) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(optimum.amplitude / direct.point.amplitude - 1);
}

scene::Scene scene_of(scene::Scene scene, const OptimumProblem& problem, const LoadCaseResult& of) {
  scene = with_values(std::move(scene), of);
  if (of.of < problem.cases.size())
    if (const auto& response = problem.cases[of.of].response)
      scene.responses = {{.direction = *response, .frame = scene.responses.front().frame}};
  return scene;
}

OptimumProblem with_distinct_cases(OptimumProblem problem) {
  std::vector<LoadCase> cases;
  for (LoadCase& each : problem.cases) {
    const auto same = std::find_if(cases.begin(), cases.end(), [&](const LoadCase& other) {
      return other.set == each.set && other.response == each.response;
    });
    if (same == cases.end())
      cases.push_back(std::move(each));
    else
      same->weight = problem.criterion == Criterion::mean ? same->weight + each.weight
                                                          : std::max(same->weight, each.weight);
  }
  problem.cases = std::move(cases);
  return problem;
}

OptimumSettings with_places(const scene::Scene& scene, OptimumSettings settings) {
  const scene::Response& response = scene.responses.front();
  if (response.others.empty()) return settings;
  const std::string several = continuation::text("where the response is the largest of ",
                                                 1 + response.others.size(), " places (\"max_of\")");
  if (settings.along)
    throw OptionsError("the optimum cannot be continued over \"" + settings.along->name + "\" " + several +
                       "; optimize at single values of it");
  if (settings.problem.criterion == Criterion::mean)
    throw OptionsError("the criterion must be worst " + several);
  std::vector<LoadCase> cases = std::move(settings.problem.cases);
  if (cases.empty()) cases.emplace_back();
  settings.problem.cases.clear();
  for (LoadCase& each : cases) {
    if (each.response) {
      settings.problem.cases.push_back(std::move(each));
      continue;
    }
    each.response = response.direction;
    settings.problem.cases.push_back(each);
    for (const scene::Direction& other : response.others) {
      each.response = other;
      settings.problem.cases.push_back(each);
    }
  }
  return settings;
}

void check_limits(const scene::Scene& scene, const OptimumProblem& problem) {
  if (problem.limits.empty()) return;
  const DesignSpace space(scene, problem);
  for (const auto& limit : problem.limits) space.observable(limit.observable);
}

OptimumResult optimum_study(const scene::Scene& given, const OptimumSettings& settings,
                            const control::Control& control, const OptimumExtent& extent) {
  scene::Scene scene = given;
  const std::size_t load_cases =
      std::max<std::size_t>(1, settings.problem.cases.size()) * (1 + 2 * settings.problem.scatter.size());
  scene.threads.count = control::threads_for_each(extent.threads, load_cases);
  Teller teller(control, scene, "search");
  OptimumOptions options = options_of(settings.search);
  options.threads = extent.threads;
  options.progress = [&](const OptimumProgress& now) { teller.tell(now); };
  options.control = control;
  OptimumResult result;
  result.problem = with_distinct_cases(settings.problem);
  const control::Control of_study = control.until(options.seconds);
  result.optimum = optimum(scene, result.problem, options);
  result.status = result.optimum.status;
  result.stop = result.optimum.stop;
  if (of_study.keep_going() && !result.optimum.design.empty())
    add_curves(result, scene, extent, of_study, teller);
  if (of_study.ending().reason != control::EndReason::none && result.status == observables::Status::complete)
    end_early(result, interruption(of_study, teller.phase()));
  return result;
}

OptimumCurveResult optimum_curve_study(const scene::Scene& scene, const OptimumSettings& settings,
                                       const control::Control& control) {
  Teller teller(control, scene, "curve");
  const ScaledParameter along(settings.along->lower, settings.along->upper);
  const double from = along.scaled(along.lower), to = along.scaled(along.upper);
  long count = 0;
  OptimumCurveOptions options{.search = options_of(settings.search), .seconds = settings.search.seconds};
  options.search.progress = [&](const OptimumProgress& now) { teller.tell(now); };
  options.search.control = control;
  options.progress = [&](const OptimumPoint& now) {
    teller.tell(++count, now, (along.scaled(now.along) - from) / (to - from));
  };
  OptimumCurveResult result;
  result.problem = settings.problem;
  result.curve = optimum_curve(scene, result.problem, *settings.along, options);
  return result;
}

}  // namespace arcslip::optimize
