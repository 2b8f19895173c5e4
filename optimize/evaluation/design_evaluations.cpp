#include <arcslip/optimize/evaluation/design_evaluations.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/evaluation/interruption.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::optimize {

using continuation::text;
namespace {

constexpr double worse = 1e-8;         // relative: an amplitude in the scatter that is higher by more counts
constexpr double same_scatter = 1e-9;  // relative: values that were there before
constexpr double worth = 1e-7;         // relative: a lower amplitude that is worth going back for

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::abs(x - y) <= same_scatter * std::max(std::abs(x), std::abs(y));
  });
}

}  // namespace

DesignEvaluations::DesignEvaluations(const scene::Scene& scene, const OptimumProblem& problem,
                                     const control::Control& control, bool far_apart, int threads,
                                     std::function<void(const OptimumProgress&)> progress)
    : progress_(std::move(progress)),
      control_(control),
      within_(control.child({.grace = grace})),
      space_(scene, problem),
      scenarios_(scene, problem, space_),
      cases_(problem.criterion, threads, within_),
      formulation_(problem, space_, cases_),
      far_apart_(far_apart) {
  for (const Scenario& each : scenarios_.first()) add(each);
}

void DesignEvaluations::add(const Scenario& scenario) {
  all_.push_back(scenario);
  cases_.add(scenarios_.peaks(scenario, within_), scenarios_.weight(scenario));
  best_.excess = best_traced_.excess = std::numeric_limits<double>::infinity();
}

void DesignEvaluations::evaluate(std::span<const double> design, bool trace) {
  if (!trace && cases_.is_at(design)) return;
  trace = trace || trace_all_;
  const int responses = cases_.work().responses;
  if (!trace) cases_.at(design);
  if (trace || (far_apart_ && cases_.value() < best_.value && responses == cases_.work().responses))
    cases_.trace(design, trace_all_ ? observables::Steps::curve : observables::Steps::events);
  const double value = cases_.value();
  evaluations_.push_back({{design.begin(), design.end()}, value});
  excesses_.push_back(std::numeric_limits<double>::infinity());
  if (std::isnan(value)) return;
  const double excess = excesses_.back() = formulation_.excess();
  const auto is_better_than = [&](const Best& best) {
    return excess < best.excess || (excess == best.excess && value < best.value);
  };
  if (is_better_than(best_)) call_best();
  if (is_better_than(best_traced_) && cases_.are_traced()) best_traced_ = here();
  tell();
}

void DesignEvaluations::tell() {
  if (!progress_ || evaluations_.empty()) return;
  const Evaluation& last = evaluations_.back();
  const PeakState& state = cases_.state(cases_.highest());
  const double best = best_.excess == 0 ? best_.value : std::numeric_limits<double>::infinity();
  progress_({static_cast<int>(evaluations_.size() + elsewhere_.size()), last.design,
             state.peaks.empty() ? 0.0 : state.peaks[state.highest].omega(), last.amplitude, best, phase_});
}

void DesignEvaluations::begin(const char* phase) {
  if (control_.ending().reason == control::EndReason::none) phase_ = phase;  // else it is that of the end
  tell();
}

void DesignEvaluations::move_to(std::span<const double> y) {
  const std::vector<double> here = space_.scaled(cases_.state(0).design);
  if (!std::equal(here.begin(), here.end(), y.begin())) evaluate(space_.design(y));
  for (std::size_t c = 0; c < cases_.size(); ++c) {
    const PeakState& state = cases_.state(c);
    if (!state.unbounded && state.peaks.empty())
      throw Error(where(c) + "no response was found at " + space_.text(state.design) + ": " + state.message);
  }
}

std::vector<Scenario> DesignEvaluations::worse_scatter() {
  std::vector<Scenario> found;
  const std::vector<double> design = cases_.state(0).design;
  for (std::size_t of = 0; of < scenarios_.size(); ++of) {
    std::vector<std::vector<double>> known;
    std::size_t any = 0;  // of this case
    for (std::size_t c = 0; c < all_.size(); ++c)
      if (all_[c].of == of) {
        known.push_back(all_[c].scatter);
        any = c;
      }
    const double level = (1 + worse) * cases_.value() / cases_.weight(any);
    const auto worst = scenarios_.worst(
        cases_.peaks(any).model_at(design), known, level, [this] { tell(); }, control_, within_);
    const bool seen = std::any_of(known.begin(), known.end(),
                                  [&](const auto& scatter) { return same(scatter, worst.scatter); });
    if (!seen && worst.amplitude > level) found.push_back({of, worst.scatter});
  }
  return found;
}

Best DesignEvaluations::here() {
  Best here{cases_.state(0).design, cases_.value(), formulation_.excess()};
  for (std::size_t c = 0; c < cases_.size(); ++c)
    here.cases.push_back({cases_.state(c), cases_.peaks(c).problem()});
  return here;
}

void DesignEvaluations::call_best() {
  best_ = here();
  if (best_traced_.design == best_.design) best_traced_ = best_;
}

void DesignEvaluations::recall_best() {
  const auto is_better = [&](const Best& other) {
    return other.excess < best_.excess ||
           (other.excess == best_.excess && other.value < (1 - worth) * best_.value);
  };
  if (best_traced_.design.empty() || !is_better(best_traced_)) return;
  cases_.trace(best_traced_.design, observables::Steps::curve);
  Best now = here();
  if (is_better(now)) best_ = std::move(now);
  best_traced_ = best_;
}

}  // namespace arcslip::optimize
