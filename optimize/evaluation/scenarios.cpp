#include <arcslip/optimize/evaluation/scenarios.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace arcslip::optimize {

using continuation::text;
namespace {

constexpr std::size_t most_with_corners = 3;  // parameters whose corners are all cases to begin with
constexpr std::size_t most_corners = 64;      // that are looked at

bool contains(const std::vector<DesignVariable>& variables, const std::string& name) {
  return std::any_of(variables.begin(), variables.end(),
                     [&](const DesignVariable& variable) { return variable.name == name; });
}

scene::Scene with_case(scene::Scene scene, const LoadCase& each) {
  for (const auto& [name, value] : each.set) scene::set(scene, name, value);
  if (each.response)
    scene.responses = {{.direction = *each.response, .frame = scene.responses.front().frame}};
  return scene;
}

void check_case(const LoadCase& each, const scene::Scene& scene, const OptimumProblem& problem) {
  if (!(each.weight > 0 && std::isfinite(each.weight)))
    throw OptionsError(text("the weight of a case is ", each.weight, ", must be above 0"));
  for (const auto& [name, value] : each.set) {
    if (contains(problem.over, name))
      throw OptionsError("a case sets \"" + name + "\", which is a design parameter");
    if (contains(problem.scatter, name))
      throw OptionsError("a case sets \"" + name + "\", which is in the scatter");
  }
  if (!each.response) return;
  bool some = false;
  for (const scene::Term& term : *each.response) {
    if (term.dof < 0 || term.dof >= static_cast<int>(scene.dofs.size()))
      throw OptionsError(
          text("the response of a case is at degree of freedom ", term.dof, " of ", scene.dofs.size()));
    if (!std::isfinite(term.weight))
      throw OptionsError(text("a weight in the response of a case is ", term.weight));
    some = some || term.weight != 0;
  }
  if (!some) throw OptionsError("the response of a case is at no degree of freedom");
}

}  // namespace

Scenarios::Scenarios(const scene::Scene& scene, const OptimumProblem& problem, const DesignSpace& space)
    : scene_(scene), problem_(problem), space_(space), cases_(problem.cases) {
  for (const LoadCase& each : cases_) check_case(each, scene, problem);
  if (cases_.empty()) cases_.emplace_back();
  const double unit = scene::to_rad_per_s(scene.frequency_unit);
  window_ = {problem.frequency_from * unit, problem.frequency_to * unit};
  if (problem.scatter.empty()) return;
  for (const DesignVariable& variable : problem.scatter)
    if (contains(problem.over, variable.name))
      throw OptionsError("\"" + variable.name + "\" is both a design parameter and in the scatter");
  if (problem.criterion == Criterion::mean) throw OptionsError("scatter requires the criterion worst");
  box_.emplace(scene, OptimumProblem{problem.scatter, problem.frequency_from, problem.frequency_to});
}

std::vector<double> Scenarios::centre() const {
  std::vector<double> y = box_->scaled(box_->lower());
  const std::vector<double> upper = box_->scaled(box_->upper());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 0.5 * (y[i] + upper[i]);
  return box_->design(y);
}

// All corners, or, if there are too many, a reproducible random sample.
std::vector<std::vector<double>> Scenarios::corners() const {
  const std::size_t n = problem_.scatter.size();
  const bool all = n < 64 && std::size_t{1} << n <= most_corners;
  std::mt19937_64 random(1);
  std::vector<std::vector<double>> corners;
  for (std::size_t corner = 0; corner < (all ? std::size_t{1} << n : most_corners); ++corner) {
    corners.emplace_back();
    for (std::size_t k = 0; k < n; ++k) {
      const bool upper = all ? (corner >> k & 1) != 0 : (random() & 1) != 0;
      corners.back().push_back(upper ? box_->upper()[k] : box_->lower()[k]);
    }
  }
  return corners;
}

std::vector<Scenario> Scenarios::first() const {
  std::vector<std::vector<double>> values;
  const std::size_t n = problem_.scatter.size();
  if (!box_) {
    values.emplace_back();
  } else if (n <= most_with_corners) {
    values = corners();
  } else {
    values.push_back(centre());
    for (std::size_t k = 0; k < n; ++k)
      for (const double end : {box_->lower()[k], box_->upper()[k]}) {
        values.push_back(values.front());
        values.back()[k] = end;
      }
  }
  std::vector<Scenario> all;
  for (std::size_t of = 0; of < cases_.size(); ++of)
    for (const std::vector<double>& each : values) all.push_back({of, each});
  return all;
}

std::unique_ptr<PeakAmplitude> Scenarios::peaks(const Scenario& scenario, control::Control control) const {
  const LoadCase& of = cases_[scenario.of];
  auto model = space_.model();
  if (!of.set.empty() || of.response || box_) {
    scene::Scene scene = with_case(scene_, of);
    for (std::size_t k = 0; k < scenario.scatter.size(); ++k)
      scene::set(scene, problem_.scatter[k].name, scenario.scatter[k]);
    model = std::make_shared<const model::Model>(model::build(scene));
  }
  return std::make_unique<PeakAmplitude>(model, space_.parameters(), window_, std::move(control),
                                         problem_.limits.empty() ? MonitoredEvents{} : watched_for_limits);
}

LoadCaseResult Scenarios::result(const Scenario& scenario) const {
  LoadCaseResult result;
  result.of = scenario.of;
  result.set = cases_[scenario.of].set;
  for (std::size_t k = 0; k < scenario.scatter.size(); ++k)
    result.scatter.emplace_back(problem_.scatter[k].name, scenario.scatter[k]);
  result.weight = weight(scenario);
  return result;
}

std::string Scenarios::text(const Scenario& scenario) const {
  if (cases_.size() == 1 && !box_) return "";
  return (cases_.size() > 1 ? continuation::text("in case ", scenario.of + 1) : "") +
         (cases_.size() > 1 && box_ ? " " : "") + (box_ ? "with " + box_->text(scenario.scatter) : "") + ": ";
}

Scenarios::Worst Scenarios::worst(std::shared_ptr<const model::Model> model,
                                  const std::vector<std::vector<double>>& known, double level,
                                  const std::function<void()>& report, const control::Control& control,
                                  const control::Control& within) const {
  Worst worst;
  PeakAmplitude peaks(std::move(model), box_->parameters(), window_, within);
  const auto look = [&](const PeakState& state) {
    const double amplitude = state.amplitude();
    if (std::isnan(amplitude))
      throw Error("no response was found at " + box_->text(state.design) + ": " + state.message);
    if (amplitude > worst.amplitude) worst = {state.design, amplitude};
    return amplitude;
  };
  const auto goes_on = [&] {
    report();
    return control.keep_going() && std::isfinite(worst.amplitude);
  };
  NonlinearProgram problem;
  problem.lower = box_->scaled(box_->lower());
  problem.upper = box_->scaled(box_->upper());
  problem.objective = [&](auto y, auto g) {
    const PeakState& state = peaks.at(box_->design(y));
    const double amplitude = look(state);
    std::fill(g.begin(), g.end(), 0.0);
    if (state.unbounded) return 0.0;  // nothing is worse: the callback ends it
    for (std::size_t k = 0; k < g.size(); ++k)
      g[k] = -state.peaks[state.highest].gradient[static_cast<Eigen::Index>(k)] / amplitude *
             box_->slope(k, state.design[k]);
    return -std::log(amplitude);
  };
  MinimizeOptions options;
  options.tolerances = {.x_relative = 0, .x_absolute = 1e-7, .f_relative = 0, .f_absolute = 1e-13};
  options.progress = [&](const MinimizeProgress&) { return goes_on(); };
  const auto search = [&](const std::vector<double>& start) {
    if (!control.keep_going() || !std::isfinite(worst.amplitude)) return;
    if (look(peaks.at(start)) == 0) return;  // without excitation there is no way up from here
    const MinimizeResult found = minimize(problem, box_->scaled(start), options);
    if (found.reason != MinimizeReason::user && found.reason != MinimizeReason::rounding &&
        !is_converged(found.reason))
      throw Error("the worst case of the uncertain parameters was not found: " + found.message);
  };
  for (const std::vector<double>& start : known) search(start);
  search(centre());
  if (worst.amplitude > level || problem_.scatter.size() <= most_with_corners) return worst;
  std::vector<double> highest;
  double most = 0;
  for (const std::vector<double>& corner : corners()) {
    if (!goes_on()) return worst;
    if (const double amplitude = look(peaks.trace(corner)); amplitude > most) {
      most = amplitude;
      highest = corner;
    }
  }
  search(highest);
  return worst;
}

}  // namespace arcslip::optimize
