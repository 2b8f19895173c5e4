#include <arcslip/optimize/search/search.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/optimize/evaluation/interruption.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/nlopt/interrupted.hpp>
#include <arcslip/optimize/search/start.hpp>
#include <arcslip/optimize/search/window_check.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace arcslip::optimize {

using continuation::text;
namespace {

using observables::Status;
using Ends = Convergence::Ends;

constexpr double seen_before = 1e-8;  // relative: a response higher by more than this has an unwatched peak
constexpr int most_rounds = 12;
constexpr std::size_t most_retreats = 12;                  // designs evaluated again, for each distance
constexpr std::array apart_by = {1e-2, 1e-3, 1e-4, 1e-5};  // of the range of a variable
constexpr std::array slipping = {most_dissipation, 0.75, 0.9, 0.97};  // of k_d X: slip limits after a release
constexpr int most_in_refinement = 200;                               // evaluations of one algorithm

}  // namespace

Search::Search(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options)
    : scene_(scene),
      problem_(problem),
      options_(options),
      limited_(!problem.limits.empty() || !problem.linear_limits.empty()),
      asked_(algorithm(options.algorithm.empty() ? std::string(default_algorithm) : options.algorithm)),
      control_(options.control.until(options.seconds)),
      designs_(scene, problem, control_, asked_.global, options.threads, options.progress),
      s_{.algorithm = asked_} {
  s_.result.algorithm = asked_.name;
}

Optimum Search::run() {
  s_.start = space().start(s_.result.notes);
  for (Phase phase = Phase::start; phase != Phase::end;) {
    try {
      phase = carry_out(phase);
    } catch (const Interrupted&) {
      phase = Phase::end;
      interrupted();
    } catch (const OptionsError&) {
      throw;  // an algorithm that does not support the problem
    } catch (const std::exception& thrown) {
      phase = Phase::end;
      s_.result.status = Status::failed;
      s_.result.stop.reason = reasons::objective_failed;
      s_.result.stop.message = text("the objective threw \"", thrown.what(), "\"", after());
    }
  }
  return finish();
}

Search::Phase Search::carry_out(Phase phase) {
  switch (phase) {
    case Phase::start:
      begin();
      return s_.ended ? Phase::scatter : Phase::round;
    case Phase::round:
      minimize_round();
      return !control_.keep_going() ? Phase::judgement : Phase::verification;
    case Phase::verification:
      if (!verify() && !release()) return Phase::scatter;
      if (++s_.round.number < most_rounds) return Phase::round;
      if (s_.round.new_peak) stop_at_higher_peak();
      return Phase::scatter;
    case Phase::scatter:
      return add_worst_scatter() ? Phase::start : Phase::judgement;
    case Phase::judgement:
      return goes_on() ? Phase::start : Phase::end;
    case Phase::end:
      break;
  }
  return Phase::end;
}

Optimum Search::finish() {
  describe();
  count_starts();
  if (s_.result.status == Status::complete && !is_part_) check_window();
  if (s_.result.status != Status::complete && !s_.result.design.empty() &&
      std::isfinite(s_.result.amplitude)) {
    s_.result.stop.message +=
        text("; the lowest amplitude is ", s_.result.amplitude, " m at ", space().text(s_.result.design));
    if (!s_.result.feasible) s_.result.stop.message += text(", where a limit is exceeded by ", best().excess);
  }
  s_.result.evaluations = std::move(designs_.evaluations());
  s_.result.evaluations.insert(s_.result.evaluations.end(), designs_.elsewhere().begin(),
                               designs_.elsewhere().end());
  s_.result.work = cases().work();
  add(s_.work_elsewhere, s_.result.work);
  s_.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  return std::move(s_.result);
}

std::string Search::after() {
  return text(" after ", count(), count() == 1 ? " evaluation" : " evaluations");
}

// Adds a note only once, even if several rounds find it.
void Search::note(std::string sentence) {
  std::vector<std::string>& notes = s_.result.notes;
  if (std::find(notes.begin(), notes.end(), sentence) == notes.end()) notes.push_back(std::move(sentence));
}

void Search::begin() {
  s_.round.number = 0;
  designs_.begin("the initial design");
  const SearchStart start = find_start(designs_, s_.start, s_.result.notes);
  s_.ended = !start.found;
  if (start.found) {
    s_.start = start.design;
    s_.reference = cases().value();
  } else if (!interrupted()) {
    const bool flat = start.fault.reason == reasons::flat;
    s_.result.status = flat ? Status::complete : Status::failed;
    s_.result.stop.reason = start.fault.reason;
    s_.result.stop.message = flat ? "the amplitude does not depend on " + space().names() +
                                        " within the bounds: no friction element slips at the peak"
                                  : "no start was found within the bounds; at " + space().text(s_.start) +
                                        ": " + start.fault.message;
  }
}

bool Search::interrupted() {
  if (control_.keep_going()) return false;
  s_.result.stop = interruption(control_, designs_.phase());
  s_.result.stop.message += after();
  s_.result.status = Status::stopped;
  s_.ended = true;
  return true;
}

void Search::minimize_round() {
  const auto before = std::pair(s_.result.status, s_.result.stop);
  designs_.begin("the search");
  minimize_once();
  if (!control_.keep_going()) return;
  if (s_.result.status == Status::failed && best().value == s_.stuck_value &&
      s_.result.stop.reason != reasons::objective_failed)
    std::tie(s_.result.status, s_.result.stop) = before;  // the optimum is still that of the round before
  s_.round.new_peak = false;
}

void Search::minimize_once() {
  Formulation& formulation = designs_.formulation();
  s_.round.responses = cases().work().responses;
  s_.round.value = std::min(cases().value(), best().value);
  s_.round.excess = best().excess;
  std::vector<double> y = space().scaled(s_.start);
  const NonlinearProgram problem =
      formulation.problem(y, s_.algorithm, s_.reference, [this](auto at) { designs_.move_to(at); });
  s_.result.epigraph = s_.result.epigraph || (formulation.epigraph() && s_.algorithm.name == asked_.name);
  MinimizeOptions options = options_of_round();
  const bool smooth = s_.algorithm.name[1] == 'D' && !formulation.epigraph() && problem.constraints.empty();
  Convergence convergence(designs_,
                          {smooth, limited_, s_.refinements > 0, s_.algorithm.global, s_.start.size()});
  Ends by = Ends::no;
  options.progress = [&](const MinimizeProgress&) {
    by = convergence.test();
    return control_.keep_going() && by == Ends::no;
  };
  MinimizeResult found = minimize(problem, y, options);
  if (found.reason != MinimizeReason::objective_failed && interrupted()) return;
  convergence.take_candidate();
  take(std::move(found), by, convergence.stationarity());
}

MinimizeOptions Search::options_of_round() {
  MinimizeOptions options;
  options.algorithm = s_.algorithm.name;
  options.tolerances = options_.tolerances;
  if (s_.algorithm.global)  // equal values are no convergence: sticking dampers cause them
    options.tolerances.f_relative = options.tolerances.f_absolute = 0;
  if (s_.algorithm.name == asked_.name) {  // others go on without
    options.local = options_.local;
    options.population = options_.population;
  }
  options.seed = options_.seed;
  const int known = s_.algorithm.global ? 0 : 1;  // a local search starts from the current design
  options.evaluations = std::max(1, options_.evaluations - static_cast<int>(count()) + known);
  if (s_.refinements > 0) options.evaluations = std::min(options.evaluations, most_in_refinement);
  return options;
}

// How a round ended becomes how the search did: by the algorithm, by a test of convergence, or in a
// refinement whose evaluations were used up.
void Search::take(MinimizeResult found, Ends by, double stationarity) {
  const bool short_run =
      found.reason == MinimizeReason::evaluation_limit && static_cast<int>(count()) < options_.evaluations;
  if (by == Ends::vanishes || by == Ends::settles) {
    found.reason = MinimizeReason::converged;
    found.cause = by == Ends::vanishes ? text("converged, residual gradient below ", small_gradient)
                                       : text("converged, residual gradient ", stationarity);
  } else if (by == Ends::idles || short_run) {
    found.reason = MinimizeReason::rounding;
    found.cause = text(s_.algorithm.name, " made no further progress");
  }
  s_.result.stop = {};
  s_.result.stop.reason = reason_of(found.reason);
  s_.result.stop.message = sentence(found);
  s_.result.status = is_converged(found.reason) || found.reason == MinimizeReason::rounding ? Status::complete
                     : found.reason == MinimizeReason::evaluation_limit                     ? Status::stopped
                                                                                            : Status::failed;
  s_.ended = s_.result.status != Status::complete;
}

// The message of one round, with the numbers of all rounds.
std::string Search::sentence(const MinimizeResult& found) {
  if (found.reason == MinimizeReason::evaluation_limit)
    return text("the limit of ", options_.evaluations, " evaluations was reached");
  return found.cause + after();
}

bool Search::verify() {
  if (best().design.empty() || !std::isfinite(best().value)) return false;
  const int responses = cases().work().responses;
  const bool gained =
      best().excess > 0  // there a lower amplitude is none
          ? std::isfinite(s_.round.excess) && best().excess < (1 - gain_outside) * s_.round.excess
          : s_.round.excess > 0 || best().value < (1 - gain) * s_.round.value;
  const double seen = best().value;
  s_.start = best().design;
  designs_.begin("the verification");
  cases().trace(s_.start, observables::Steps::curve);
  for (std::size_t c = 0; c < cases().size(); ++c)
    if (const PeakState& state = cases().state(c); !state.complete)
      note(designs_.where(c) + "the response at " + space().text(s_.start) +
           " ends within the window: " + state.message);
  const double now = cases().value();
  Formulation& formulation = designs_.formulation();
  const double exceeded = formulation.excess();
  const bool higher = !(std::abs(now / seen - 1) <= seen_before);
  const bool beyond = exceeded > best().excess + limit_tolerance;
  const bool changed =
      formulation.epigraph() ? responses > s_.round.responses : formulation.wants_epigraph(s_.algorithm);
  if (!higher && !beyond) return changed && gained && !s_.ended;
  s_.round.new_peak = true;
  note(text("at ", space().text(s_.start), " a new peak ",
            higher ? text("of ", now, " m appeared, higher than the highest tracked peak of ", seen, " m")
                   : text("appeared at which a limit is exceeded by ", exceeded)));
  designs_.call_best();
  if (++s_.new_peaks > 1) retreat();
  return !s_.ended;
}

// If tracking loses a peak repeatedly, the response changes too much from one design to the next, and the
// amplitude may jump: from now on each design is evaluated by a new response. Some earlier designs were
// better; these are evaluated again with new responses: first designs that are far apart, and without
// progress those in between, since the jump may be close.
void Search::retreat() {
  designs_.trace_all();
  std::vector<std::tuple<double, double, std::vector<double>>> tried;  // excess, V, design
  for (std::size_t i = 0; i < count(); ++i)
    tried.emplace_back(designs_.excesses()[i], designs_.evaluations()[i].amplitude,
                       designs_.evaluations()[i].design);
  std::erase_if(tried, [](const auto& each) { return std::isnan(std::get<1>(each)); });
  std::sort(tried.begin(), tried.end());
  std::vector<std::vector<double>> looked_at{best().design};
  for (const double far_enough : apart_by) {
    if (best().excess == 0 && best().value < (1 - gain) * s_.round.value) break;
    std::size_t retreats = 0;
    for (const auto& [excess, value, design] : tried) {
      if (!(std::tie(excess, value) < std::tie(best().excess, best().value)) || retreats == most_retreats)
        break;
      const bool known = std::any_of(
          looked_at.begin(), looked_at.end(),
          [&](const std::vector<double>& other) { return space().distance(design, other) < far_enough; });
      if (known) continue;
      looked_at.push_back(design);
      ++retreats;
      designs_.evaluate(design, true);
    }
  }
  s_.start = best().design;
}

void Search::check_window() {
  const auto value = value_at_end(designs_);
  if (!value) return;
  const std::string where = designs_.where(value->in_case) + "the amplitude is largest at the " +
                            (value->upper ? "upper" : "lower") + " end of the window, " +
                            observables::frequency_text(value->omega, scene_.frequency_unit);
  try {
    const BeyondEnd beyond = look_beyond(designs_, *value, scene_.frequency_unit);
    if (!beyond.resonance) return note(where + beyond.text);
    if (s_.result.stop.reason == reasons::flat) note(s_.result.stop.message);
    s_.result.status = Status::stopped;
    s_.result.stop.reason = reasons::end_of_window;
    s_.result.stop.message = where + ", where it is no resonance peak" + beyond.text;
  } catch (const Interrupted&) {
    interrupted();
  } catch (const std::exception& thrown) {
    s_.result.status = Status::stopped;
    s_.result.stop.reason = reasons::end_of_window;
    s_.result.stop.message = where + "; a response beyond it failed: " + thrown.what();
  }
}

void Search::stop_at_higher_peak() {
  s_.result.status = Status::stopped;
  s_.result.stop.reason = reasons::other_peak;
  s_.result.stop.message = text(
      "the response at the best design had a peak higher than the tracked ones, or one at which a limit is "
      "exceeded, in ",
      most_rounds, " rounds and ", count(), " evaluations");
  s_.ended = true;
}

bool Search::release() {
  if (s_.ended || s_.algorithm.global || !cases().is_at(best().design)) return false;
  if (!(best().value < (1 - gain) * s_.stuck_value)) return false;
  s_.stuck_value = best().value;
  std::vector<std::vector<double>> designs;
  for (const double share : slipping) {
    const auto design = released(cases(), space().parameters(), space().lower(), share);
    if (!design) return false;
    if (designs.empty() || *design != designs.back()) designs.push_back(*design);
  }
  const std::string stuck = space().text(best().design);
  const bool within = best().excess == 0;
  // At the onset of slip the limits that hold without slip still hold, but perhaps not a limit on the energy
  // at its maximum. From far outside, a search may return to where everything sticks.
  std::optional<std::vector<double>> from;
  double least = HUGE_VAL;
  for (const std::vector<double>& design : designs) {
    designs_.evaluate(design, true);
    const double excess = designs_.formulation().excess();
    if (!std::isfinite(cases().value()) || !(excess < least)) continue;
    from = design;
    least = excess;
    if (!within || excess == 0) break;
  }
  if (!from) return false;
  if (!cases().is_at(*from)) cases().trace(*from);
  note("at " + stuck + " a friction element sticks; the search continued with it slipping, from " +
       space().text(*from));
  s_.start = *from;
  return true;
}

bool Search::add_worst_scatter() {
  if (!designs_.scenarios().scatter() || s_.result.status != Status::complete || best().design.empty())
    return false;
  s_.start = best().design;
  if (!cases().is_at(s_.start)) cases().trace(s_.start);
  ++s_.result.scatter_rounds;
  designs_.begin("the worst-case search");
  const std::vector<Scenario> worse = designs_.worse_scatter();
  if (interrupted() || worse.empty()) return false;
  for (const Scenario& each : worse) designs_.add(each);
  s_.stuck_value = HUGE_VAL;
  if (s_.result.scatter_rounds < options_.scatter_rounds) return true;
  designs_.evaluate(s_.start);
  s_.result.status = Status::stopped;
  s_.result.stop.reason = reasons::scatter_limit;
  s_.result.stop.message = text("the worst case of the uncertain parameters still increased after ",
                                s_.result.scatter_rounds, " rounds and ", count(), " evaluations");
  return false;
}

Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options) {
  return Search(scene, problem, options).run();
}

}  // namespace arcslip::optimize
