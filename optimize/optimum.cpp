#include <arcslip/optimize/optimum.hpp>

#include <arcslip/optimize/multipliers.hpp>
#include <arcslip/optimize/release.hpp>
#include <arcslip/optimize/start.hpp>
#include <arcslip/optimize/text.hpp>
#include <arcslip/optimize/trials.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace arcslip::optimize {
namespace {

using observables::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double seen_before = 1e-8;  // relative: a response that is higher by more has a peak not watched
constexpr int most_rounds = 12;
constexpr int most_restarts = 5;
constexpr double gain = 1e-7;            // relative, of a round that is worth another one
constexpr double small_gradient = 1e-8;  // of d ln V / d ln p: what is left is rounding
constexpr double as_good = 1e-13;        // relative: values that differ by rounding

class Search {
 public:
  Search(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options)
      : options_(options),
        algorithm_(algorithm(options.algorithm.empty() ? "LD_SLSQP" : options.algorithm)),
        trials_(scene, problem, options, algorithm_.global) {
    result_.algorithm = algorithm_.name;
  }

  Optimum run() {
    start_ = space().start(result_.notes);
    for (bool goes_on = true; goes_on;) {
      try {
        search();
        goes_on = has_better_start();
      } catch (const OptionsError&) {
        throw;  // an algorithm that does not take what was given
      } catch (const std::exception& thrown) {
        goes_on = false;
        result_.status = Status::failed;
        result_.stop.reason = name(Reason::objective_failed);
        result_.stop.message = text("it threw \"", thrown.what(), "\" after ", count(), " evaluations");
      }
    }
    describe();
    if (!result_.design.empty() && std::isfinite(result_.amplitude)) {
      result_.stop.message +=
          text("; the least amplitude is ", result_.amplitude, " m at ", space().text(result_.design));
      if (!result_.feasible) result_.stop.message += text(", where a limit is exceeded by ", best().excess);
    }
    result_.evaluations = std::move(trials_.evaluations());
    result_.work = cases().work();
    result_.seconds = trials_.seconds();
    return std::move(result_);
  }

 private:
  Cases& cases() { return trials_.cases(); }
  const DesignSpace& space() const { return trials_.space(); }
  const Best& best() const { return trials_.best(); }
  std::size_t count() { return trials_.evaluations().size(); }

  void search() {
    do {
      begin();
      for (int round = 0; !ended_; ++round) {
        const auto before = std::pair(result_.status, result_.stop);
        minimize_once();
        if (result_.status == Status::failed && best().value == stuck_value_ &&
            result_.stop.reason != name(Reason::objective_failed))
          std::tie(result_.status, result_.stop) = before;  // the optimum is still that of the round before
        came_up_ = false;
        if (!verify() && !release()) break;
        if (round + 1 < most_rounds) continue;
        if (came_up_) stop_at_higher_peak();
        break;
      }
    } while (add_worst_scatter());
  }

  void begin() {
    const Start start = find_start(trials_, start_, result_.notes);
    ended_ = !start.found;
    if (start.found) {
      start_ = start.design;
      reference_ = cases().value();
    } else if (!interrupted()) {
      const bool flat = start.fault.reason == "flat";
      result_.status = flat ? Status::complete : Status::failed;
      result_.stop.reason = start.fault.reason;
      result_.stop.message = flat ? "the amplitude does not depend on " + space().names() +
                                        " within the bounds: no friction element slips at the peak"
                                  : "no start was found within the bounds; at " + space().text(start_) +
                                        ": " + start.fault.message;
    }
  }

  bool interrupted() {
    observables::Stop stop = trials_.interruption();
    if (stop.reason.empty()) return false;
    result_.stop = std::move(stop);
    result_.status = Status::stopped;
    return true;
  }

  void minimize_once() {
    Formulation& formulation = trials_.formulation();
    round_responses_ = cases().work().responses;
    round_value_ = std::min(cases().value(), best().value);
    round_excess_ = best().excess;
    std::vector<double> y = space().scaled(start_);
    const Problem problem =
        formulation.problem(y, algorithm_, reference_, [this](auto at) { trials_.move_to(at); });
    result_.epigraph = result_.epigraph || formulation.epigraph();

    Options options;
    options.algorithm = algorithm_.name;
    options.tolerances = options_.tolerances;
    if (algorithm_.global)  // equal values are not the end: dampers that stick leave them
      options.tolerances.f_relative = options.tolerances.f_absolute = 0;
    options.local = options_.local;
    options.population = options_.population;
    options.seed = options_.seed;
    const int known = algorithm_.global ? 0 : 1;  // a local search begins where the cases stand
    options.evaluations = std::max(1, options_.evaluations - static_cast<int>(count()) + known);
    if (options_.seconds > 0) options.seconds = std::max(options_.seconds - trials_.seconds(), 1e-9);
    const bool smooth = algorithm_.name[1] == 'D' && !formulation.epigraph() && problem.constraints.empty();
    bool stationary = false;
    options.progress = [&, smooth](const Progress&) {
      stationary = smooth && is_stationary();
      if (stationary) trials_.call_best();
      return !trials_.user_stopped() && !stationary;
    };
    Result found = minimize(problem, y, options);
    if (found.reason == Reason::user && !trials_.user_stopped() && stationary) {
      found.reason = Reason::converged;
      found.message = text("no entry of d ln A / d ln p is above ", small_gradient, " after ");
    }
    result_.stop.reason = name(found.reason);
    result_.stop.message = sentence(found);
    result_.status = is_converged(found.reason) || found.reason == Reason::rounding ? Status::complete
                     : found.reason == Reason::evaluation_limit || found.reason == Reason::time_limit ||
                             found.reason == Reason::user
                         ? Status::stopped
                         : Status::failed;
    ended_ = result_.status != Status::complete;
  }

  // At the best design so far: a flat place that is worse is none.
  bool is_stationary() {
    const double value = cases().value();
    if (!std::isfinite(value) || value > (1 + as_good) * best().value) return false;
    for (std::size_t c = 0; c < cases().size(); ++c)
      if (cases().state(c).peaks.size() > 1) return false;
    const std::vector<double>& design = cases().state(0).design;
    const Vector gradient = cases().gradient();
    for (std::size_t k = 0; k < design.size(); ++k) {
      const double slope = gradient[static_cast<Eigen::Index>(k)] / value * space().slope(k, design[k]);
      const bool held =
          (design[k] == space().lower()[k] && slope > 0) || (design[k] == space().upper()[k] && slope < 0);
      if (!held && std::abs(slope) > small_gradient) return false;
    }
    return true;
  }

  // Of one round, with the numbers of all of them.
  std::string sentence(const Result& found) {
    const std::string after = text(" after ", count(), count() == 1 ? " evaluation" : " evaluations");
    switch (found.reason) {
      case Reason::evaluation_limit:
        return text("the limit of ", options_.evaluations, " evaluations was reached");
      case Reason::time_limit:
        return text("the limit of ", options_.seconds, " s was reached at ", trials_.seconds(), " s") + after;
      default:
        return found.message.substr(0, found.message.rfind(" after ")) + after;
    }
  }

  // Once, however many rounds find it.
  void note(std::string sentence) {
    std::vector<std::string>& notes = result_.notes;
    if (std::find(notes.begin(), notes.end(), sentence) == notes.end()) notes.push_back(std::move(sentence));
  }

  // The responses at the best design. True where the search is to go on: with a higher peak than was seen, or
  // because others came up and went during a round that was not in vain.
  bool verify() {
    if (best().design.empty() || !std::isfinite(best().value)) return false;
    const int responses = cases().work().responses;
    const bool gained = best().value < (1 - gain) * round_value_ ||
                        (std::isfinite(round_excess_) && best().excess < round_excess_);
    const double seen = best().value;
    start_ = best().design;
    cases().trace(start_);
    for (std::size_t c = 0; c < cases().size(); ++c)
      if (const PeakState& state = cases().state(c); !state.complete)
        note(trials_.where(c) + "the response at " + space().text(start_) +
             " ends within the window: " + state.message);
    const double now = cases().value();
    const Formulation& formulation = trials_.formulation();
    const bool changed =
        formulation.epigraph() ? responses > round_responses_ : formulation.wants_epigraph(algorithm_);
    if (!(std::abs(now / seen - 1) > seen_before)) return changed && gained && !ended_;
    came_up_ = true;
    note(text("at ", space().text(start_), " a peak of ", now,
              " m came up beside those that were followed, the highest of which has ", seen, " m"));
    trials_.correct_best(now);
    return !ended_;
  }

  // Round after round a response at the best design has a peak that is lost on the way to it.
  void stop_at_higher_peak() {
    result_.status = Status::stopped;
    result_.stop.reason = "other_peak";
    result_.stop.message = text("the response at the best design had a higher peak than was followed, in ",
                                most_rounds, " rounds and ", count(), " evaluations");
    ended_ = true;
  }

  // Goes on with the dampers slipping that stick at the optimum; after that, once for each gain. A global
  // search looks for such designs itself.
  bool release() {
    if (ended_ || algorithm_.global || !cases().stand_at(best().design)) return false;
    if (!(best().value < (1 - gain) * stuck_value_)) return false;
    stuck_value_ = best().value;
    const auto design = released(cases(), space().parameters(), space().lower());
    if (!design) return false;
    const std::string stuck = space().text(best().design);
    trials_.evaluate(*design, true);
    if (!std::isfinite(cases().value())) return false;
    result_.notes.push_back("at " + stuck +
                            " a friction element sticks; the search went on with it slipping, from " +
                            space().text(*design));
    start_ = *design;
    return true;
  }

  // True where the search is to go on with it, from the design found.
  bool add_worst_scatter() {
    if (!trials_.scenarios().scatter() || result_.status != Status::complete || best().design.empty())
      return false;
    start_ = best().design;
    if (!cases().stand_at(start_)) cases().trace(start_);
    ++result_.scatter_rounds;
    const std::vector<Scenario> worse = trials_.worse_scatter();
    if (interrupted() || worse.empty()) return false;
    for (const Scenario& each : worse) trials_.add(each);
    stuck_value_ = infinity;
    if (result_.scatter_rounds < options_.scatter_rounds) return true;
    trials_.evaluate(start_);
    result_.status = Status::stopped;
    result_.stop.reason = "scatter_limit";
    result_.stop.message = text("the worst of what scatters was higher still after ", result_.scatter_rounds,
                                " rounds and ", count(), " evaluations");
    return false;
  }

  // True where the search is to go on, from another start. Certifies the optimum where it is not.
  bool has_better_start() {
    if (result_.status != Status::complete || best().design.empty() || !std::isfinite(best().value))
      return false;
    if (best().excess > 0) {
      if (find_feasible()) return true;
      if (interrupted()) return false;
      result_.status = Status::stopped;
      result_.stop.reason = "infeasible";
      result_.stop.message = "no design that keeps within the limits was found: " + result_.stop.message;
      return false;
    }
    if (!options_.certificate || result_.stop.reason == "flat") return false;
    describe();
    if (result_.cases.empty()) return false;
    result_.certificate =
        certify(cases(), space().lower(), space().upper(), trials_.formulation().active(),
                [this] { return options_.seconds == 0 || trials_.seconds() < options_.seconds; });
    return passed_lower();
  }

  // Other starts, once, where the search came to no design that keeps the limits.
  bool find_feasible() {
    if (std::exchange(looked_elsewhere_, true)) return false;
    const std::string exceeds = space().text(best().design);
    for (int k = 0; k < space().attempts() && best().excess > 0; ++k) {
      if (!trials_.interruption().reason.empty()) return false;
      trials_.evaluate(space().attempt(k), true);
    }
    if (best().excess > 0) return false;
    start_ = best().design;
    stuck_value_ = infinity;
    note("the search came to " + exceeds + ", where a limit is exceeded, and went on from " +
         space().text(start_) + ", where none is");
    return true;
  }

  // A lower design on the way to the end of a tolerance range.
  bool passed_lower() {
    const std::vector<double> lower = std::exchange(result_.certificate->lower_design, {});
    if (lower.empty()) return false;
    const double value = best().value;
    const std::string left = space().text(best().design);
    trials_.evaluate(lower, true);
    if (best().excess > 0 || !(best().value < (1 - gain) * value)) return false;
    if (restarts_++ == most_restarts) {
      result_.status = Status::stopped;
      result_.stop.reason = "lower_beside";
      result_.stop.message = text("there was a lower design beside each of ", most_restarts, " minima");
      return false;
    }
    start_ = lower;
    note("the search came to a minimum at " + left + ", and went on from the lower " + space().text(lower));
    return true;
  }

  // What is known of the best design. A certificate of another one is dropped.
  void describe() {
    if (result_.design == best().design && !result_.cases.empty()) return;
    result_.design = best().design;
    result_.amplitude = best().value;
    result_.feasible = best().excess == 0;
    result_.cases.clear();
    result_.certificate.reset();
    if (best().design.empty() || !std::isfinite(best().value)) return;
    if (!cases().stand_at(best().design)) cases().trace(best().design);
    if (!std::isfinite(cases().value())) return;
    const std::vector<ActiveLimit> limits = trials_.formulation().active();
    for (std::size_t c = 0; c < cases().size(); ++c) {
      const PeakState& state = cases().state(c);
      CaseResult each = trials_.scenarios().result(trials_.scenario(c));
      each.amplitude = state.amplitude();
      each.point = cases().peaks(c).observe(state.peaks[state.highest]);
      result_.cases.push_back(std::move(each));
    }
    for (const ActivePeak& peak : balance(cases(), space().lower(), space().upper(), limits).active) {
      result_.cases[peak.in_case].active = true;
      result_.cases[peak.in_case].multiplier += peak.multiplier;
    }
    result_.point = result_.cases[cases().highest()].point;
  }

  const OptimumOptions& options_;
  Algorithm algorithm_;
  Trials trials_;
  Optimum result_;
  std::vector<double> start_;
  double reference_ = 1;           // V at the start
  int round_responses_ = 0;        // traced before the round
  double round_value_ = infinity;  // least before it
  double round_excess_ = infinity;
  double stuck_value_ = infinity;  // least one from which stuck dampers were released
  bool came_up_ = false;           // a higher peak, in the last response
  bool looked_elsewhere_ = false;  // for a design that keeps the limits
  int restarts_ = 0;               // from lower designs beside a minimum
  bool ended_ = false;
};

}  // namespace

Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options) {
  return Search(scene, problem, options).run();
}

}  // namespace arcslip::optimize
