#include <arcslip/optimize/search/optimum.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/nlopt/interrupted.hpp>
#include <arcslip/optimize/search/convergence.hpp>
#include <arcslip/optimize/search/search.hpp>
#include <arcslip/optimize/search/start.hpp>
#include <arcslip/optimize/search/window_check.hpp>

#include <algorithm>
#include <array>
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
      algorithm_(asked_),
      watch_(options.seconds, options.go_on),
      designs_(scene, problem, watch_, asked_.global, options.threads, options.progress) {
  result_.algorithm = asked_.name;
}

Optimum Search::run() {
  start_ = space().start(result_.notes);
  for (bool more = true; more;) {
    try {
      search();
      more = goes_on();
    } catch (const Interrupted&) {
      more = false;
      interrupted();
    } catch (const OptionsError&) {
      throw;  // an algorithm that does not support the problem
    } catch (const std::exception& thrown) {
      more = false;
      result_.status = Status::failed;
      result_.stop.reason = reasons::objective_failed;
      result_.stop.message = text("the objective threw \"", thrown.what(), "\"", after());
    }
  }
  describe();
  count_starts();
  if (result_.status == Status::complete && !is_part_) check_window();
  if (result_.status != Status::complete && !result_.design.empty() && std::isfinite(result_.amplitude)) {
    result_.stop.message +=
        text("; the lowest amplitude is ", result_.amplitude, " m at ", space().text(result_.design));
    if (!result_.feasible) result_.stop.message += text(", where a limit is exceeded by ", best().excess);
  }
  result_.evaluations = std::move(designs_.evaluations());
  result_.evaluations.insert(result_.evaluations.end(), designs_.elsewhere().begin(),
                             designs_.elsewhere().end());
  result_.work = cases().work();
  add(work_elsewhere_, result_.work);
  result_.seconds = watch_.seconds();
  return std::move(result_);
}

std::string Search::after() {
  return text(" after ", count(), count() == 1 ? " evaluation" : " evaluations");
}

// Adds a note only once, even if several rounds find it.
void Search::note(std::string sentence) {
  std::vector<std::string>& notes = result_.notes;
  if (std::find(notes.begin(), notes.end(), sentence) == notes.end()) notes.push_back(std::move(sentence));
}

void Search::search() {
  do {
    begin();
    for (int round = 0; !ended_; ++round) {
      const auto before = std::pair(result_.status, result_.stop);
      designs_.begin("the search");
      minimize_once();
      if (watch_.stopped()) return;
      if (result_.status == Status::failed && best().value == stuck_value_ &&
          result_.stop.reason != reasons::objective_failed)
        std::tie(result_.status, result_.stop) = before;  // the optimum is still that of the round before
      round_.new_peak = false;
      if (!verify() && !release()) break;
      if (round + 1 < most_rounds) continue;
      if (round_.new_peak) stop_at_higher_peak();
      break;
    }
  } while (add_worst_scatter());
}

void Search::begin() {
  designs_.begin("the initial design");
  const SearchStart start = find_start(designs_, start_, result_.notes);
  ended_ = !start.found;
  if (start.found) {
    start_ = start.design;
    reference_ = cases().value();
  } else if (!interrupted()) {
    const bool flat = start.fault.reason == reasons::flat;
    result_.status = flat ? Status::complete : Status::failed;
    result_.stop.reason = start.fault.reason;
    result_.stop.message = flat ? "the amplitude does not depend on " + space().names() +
                                      " within the bounds: no friction element slips at the peak"
                                : "no start was found within the bounds; at " + space().text(start_) + ": " +
                                      start.fault.message;
  }
}

bool Search::interrupted() {
  if (watch_.go_on()) return false;
  result_.stop = watch_.why();
  result_.stop.message += after();
  result_.status = Status::stopped;
  ended_ = true;
  return true;
}

void Search::minimize_once() {
  Formulation& formulation = designs_.formulation();
  round_.responses = cases().work().responses;
  round_.value = std::min(cases().value(), best().value);
  round_.excess = best().excess;
  std::vector<double> y = space().scaled(start_);
  const NonlinearProgram problem =
      formulation.problem(y, algorithm_, reference_, [this](auto at) { designs_.move_to(at); });
  result_.epigraph = result_.epigraph || (formulation.epigraph() && algorithm_.name == asked_.name);

  MinimizeOptions options;
  options.algorithm = algorithm_.name;
  options.tolerances = options_.tolerances;
  if (algorithm_.global)  // equal values are no convergence: sticking dampers cause them
    options.tolerances.f_relative = options.tolerances.f_absolute = 0;
  if (algorithm_.name == asked_.name) {  // others go on without
    options.local = options_.local;
    options.population = options_.population;
  }
  options.seed = options_.seed;
  const int known = algorithm_.global ? 0 : 1;  // a local search starts from the current design
  options.evaluations = std::max(1, options_.evaluations - static_cast<int>(count()) + known);
  if (refinements_ > 0) options.evaluations = std::min(options.evaluations, most_in_refinement);
  const bool smooth = algorithm_.name[1] == 'D' && !formulation.epigraph() && problem.constraints.empty();
  Convergence convergence(designs_, {smooth, limited_, refinements_ > 0, algorithm_.global, start_.size()});
  Ends by = Ends::no;
  options.progress = [&](const MinimizeProgress&) {
    by = convergence.test();
    return watch_.go_on() && by == Ends::no;
  };
  MinimizeResult found = minimize(problem, y, options);
  if (found.reason != MinimizeReason::objective_failed && interrupted()) return;
  convergence.take_candidate();
  const bool short_run =
      found.reason == MinimizeReason::evaluation_limit && static_cast<int>(count()) < options_.evaluations;
  if (by != Ends::no || short_run) {
    found.reason =
        by == Ends::vanishes || by == Ends::settles ? MinimizeReason::converged : MinimizeReason::rounding;
    found.cause = by == Ends::vanishes  ? text("converged, residual gradient below ", small_gradient)
                  : by == Ends::settles ? text("converged, residual gradient ", convergence.stationarity())
                                        : text(algorithm_.name, " made no further progress");
  }
  result_.stop = {};
  result_.stop.reason = reason_of(found.reason);
  result_.stop.message = sentence(found);
  result_.status = is_converged(found.reason) || found.reason == MinimizeReason::rounding ? Status::complete
                   : found.reason == MinimizeReason::evaluation_limit                     ? Status::stopped
                                                                                          : Status::failed;
  ended_ = result_.status != Status::complete;
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
  const bool gained = best().excess > 0  // there a lower amplitude is none
                          ? std::isfinite(round_.excess) && best().excess < (1 - gain_outside) * round_.excess
                          : round_.excess > 0 || best().value < (1 - gain) * round_.value;
  const double seen = best().value;
  start_ = best().design;
  designs_.begin("the verification");
  cases().trace(start_, observables::Steps::curve);
  for (std::size_t c = 0; c < cases().size(); ++c)
    if (const PeakState& state = cases().state(c); !state.complete)
      note(designs_.where(c) + "the response at " + space().text(start_) +
           " ends within the window: " + state.message);
  const double now = cases().value();
  Formulation& formulation = designs_.formulation();
  const double exceeded = formulation.excess();
  const bool higher = !(std::abs(now / seen - 1) <= seen_before);
  const bool beyond = exceeded > best().excess + limit_tolerance;
  const bool changed =
      formulation.epigraph() ? responses > round_.responses : formulation.wants_epigraph(algorithm_);
  if (!higher && !beyond) return changed && gained && !ended_;
  round_.new_peak = true;
  note(text("at ", space().text(start_), " a new peak ",
            higher ? text("of ", now, " m appeared, higher than the highest tracked peak of ", seen, " m")
                   : text("appeared at which a limit is exceeded by ", exceeded)));
  designs_.call_best();
  if (++new_peaks_ > 1) retreat();
  return !ended_;
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
    if (best().excess == 0 && best().value < (1 - gain) * round_.value) break;
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
  start_ = best().design;
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
    if (result_.stop.reason == reasons::flat) note(result_.stop.message);
    result_.status = Status::stopped;
    result_.stop.reason = reasons::end_of_window;
    result_.stop.message = where + ", where it is no resonance peak" + beyond.text;
  } catch (const Interrupted&) {
    interrupted();
  } catch (const std::exception& thrown) {
    result_.status = Status::stopped;
    result_.stop.reason = reasons::end_of_window;
    result_.stop.message = where + "; a response beyond it failed: " + thrown.what();
  }
}

void Search::stop_at_higher_peak() {
  result_.status = Status::stopped;
  result_.stop.reason = reasons::other_peak;
  result_.stop.message = text(
      "the response at the best design had a peak higher than the tracked ones, or one at which a limit is "
      "exceeded, in ",
      most_rounds, " rounds and ", count(), " evaluations");
  ended_ = true;
}

bool Search::release() {
  if (ended_ || algorithm_.global || !cases().is_at(best().design)) return false;
  if (!(best().value < (1 - gain) * stuck_value_)) return false;
  stuck_value_ = best().value;
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
  start_ = *from;
  return true;
}

bool Search::add_worst_scatter() {
  if (!designs_.scenarios().scatter() || result_.status != Status::complete || best().design.empty())
    return false;
  start_ = best().design;
  if (!cases().is_at(start_)) cases().trace(start_);
  ++result_.scatter_rounds;
  designs_.begin("the worst-case search");
  const std::vector<Scenario> worse = designs_.worse_scatter();
  if (interrupted() || worse.empty()) return false;
  for (const Scenario& each : worse) designs_.add(each);
  stuck_value_ = HUGE_VAL;
  if (result_.scatter_rounds < options_.scatter_rounds) return true;
  designs_.evaluate(start_);
  result_.status = Status::stopped;
  result_.stop.reason = reasons::scatter_limit;
  result_.stop.message = text("the worst case of the uncertain parameters still increased after ",
                              result_.scatter_rounds, " rounds and ", count(), " evaluations");
  return false;
}

Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options) {
  return Search(scene, problem, options).run();
}

}  // namespace arcslip::optimize
