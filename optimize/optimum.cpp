#include <arcslip/optimize/optimum.hpp>

#include <arcslip/optimize/design_space.hpp>
#include <arcslip/optimize/formulation.hpp>
#include <arcslip/optimize/multipliers.hpp>
#include <arcslip/optimize/release.hpp>
#include <arcslip/optimize/scenarios.hpp>
#include <arcslip/optimize/text.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace arcslip::optimize {
namespace {

using observables::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_influence = 1e-12;  // d ln A / d ln p of less is none
constexpr double seen_before = 1e-8;    // relative: a response that is higher by more has a peak not watched
constexpr int most_rounds = 12;
constexpr double gain = 1e-7;            // relative, of a round that is worth another one
constexpr double small_gradient = 1e-8;  // of d ln V / d ln p: what is left is rounding
constexpr double as_good = 1e-13;        // relative: values that differ by rounding
constexpr double worse = 1e-8;  // relative: an amplitude in the scatter that is higher by more is added
constexpr double same_scatter = 1e-9;  // relative: values that were there before

class Search {
 public:
  Search(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options)
      : options_(options),
        space_(scene, problem),
        algorithm_(algorithm(options.algorithm.empty() ? "LD_SLSQP" : options.algorithm)),
        scenarios_(scene, problem, space_),
        cases_(problem.criterion),
        formulation_(problem, space_, cases_) {
    result_.algorithm = algorithm_.name;
    for (const Scenario& each : scenarios_.first()) add(each);
  }

  Optimum run() {
    try {
      start_ = space_.start(result_.notes);
      do {
        begin();
        for (int round = 0; !ended_; ++round) {
          const auto before = std::pair(result_.status, result_.stop);
          minimize_once();
          if (result_.status == Status::failed && result_.amplitude == stuck_value_)
            std::tie(result_.status, result_.stop) = before;  // the optimum is still that of the round before
          if ((!verify() && !release()) || round + 1 == most_rounds) break;
        }
      } while (add_worst_scatter());
    } catch (const std::exception& thrown) {
      result_.status = Status::failed;
      result_.stop.reason = name(Reason::objective_failed);
      result_.stop.message =
          text("it threw \"", thrown.what(), "\" after ", result_.evaluations.size(), " evaluations");
    }
    finish();
    return std::move(result_);
  }

 private:
  void add(const Scenario& scenario) {
    all_.push_back(scenario);
    cases_.add(scenarios_.peaks(scenario), scenarios_.weight(scenario));
  }

  // What is wrong with a start where the cases stand, and its name. Nothing: it is a design with finite
  // amplitudes that the parameters can change.
  std::pair<const char*, std::string> fault() {
    for (std::size_t c = 0; c < cases_.size(); ++c) {
      const PeakState& state = cases_.state(c);
      if (state.unbounded) return {"unbounded", scenarios_.text(all_[c]) + state.message};
      if (state.peaks.empty())
        return {"no_response", scenarios_.text(all_[c]) + "no response was found there: " + state.message};
    }
    for (std::size_t g = 0; g < cases_.groups(); ++g)
      if (!is_flat(cases_.highest_of(g))) return {"", ""};
    return {"flat", "no friction element slips there, so that the amplitude stays as it is"};
  }

  bool is_flat(std::size_t c) {
    const PeakState& state = cases_.state(c);
    const Peak& highest = state.peaks[state.highest];
    for (std::size_t k = 0; k < state.design.size(); ++k)
      if (std::abs(highest.gradient[static_cast<Eigen::Index>(k)] * state.design[k]) >
          no_influence * highest.amplitude)
        return false;
    const auto point = cases_.peaks(c).observe(highest);
    return std::all_of(point.elements.begin(), point.elements.end(),
                       [](const auto& element) { return !element.has_stick || element.slip_angles.empty(); });
  }

  // From the start, or from another place where it is no good.
  void begin() {
    const std::vector<double> start = start_;
    std::string why;
    ended_ = false;
    for (int attempt = -1; attempt < space_.attempts(); ++attempt) {
      const std::vector<double> design = attempt < 0 ? start : space_.attempt(attempt);
      evaluate(design, attempt >= 0);
      const auto [reason, message] = fault();
      if (attempt < 0) {
        why = message;
        result_.stop.reason = reason;
      }
      if (message.empty()) {
        if (attempt >= 0)
          result_.notes.push_back("the start " + space_.text(start) + " was moved to " + space_.text(design) +
                                  ": " + why);
        start_ = design;
        reference_ = cases_.value();
        return;
      }
      if (stopped()) break;
    }
    ended_ = true;
    if (result_.status == Status::stopped) return;
    const bool flat = result_.stop.reason == "flat";
    result_.status = flat ? Status::complete : Status::failed;
    result_.stop.message =
        flat ? "the amplitude does not depend on " + space_.names() +
                   " within the bounds: no friction element slips at the peak"
             : "no start was found within the bounds; at " + space_.text(start) + ": " + why;
  }

  void evaluate(std::span<const double> design, bool trace = false) {
    if (!trace && cases_.stand_at(design)) return;
    if (trace)
      cases_.trace(design);
    else
      cases_.at(design);
    const double value = cases_.value();
    result_.evaluations.push_back({{design.begin(), design.end()}, value});
    if (std::isnan(value)) return;
    const double excess = std::max(formulation_.excess(), space_.excess(design));
    if (excess < best_excess_ || (excess == best_excess_ && value < result_.amplitude)) {
      best_excess_ = excess;
      result_.design.assign(design.begin(), design.end());
      result_.amplitude = value;
    }
    tell();
  }

  void tell() {
    if (!options_.progress) return;
    const Evaluation& last = result_.evaluations.back();
    const PeakState& state = cases_.state(cases_.highest());
    if (!options_.progress({static_cast<int>(result_.evaluations.size()), last.design,
                            state.peaks.empty() ? 0.0 : state.peaks[state.highest].omega(), last.amplitude,
                            best_excess_ == 0 ? result_.amplitude : infinity}))
      user_stopped_ = true;
  }

  void move_to(std::span<const double> y) {
    const std::vector<double> design = space_.design(y);
    evaluate(design);
    for (std::size_t c = 0; c < cases_.size(); ++c) {
      const PeakState& state = cases_.state(c);
      if (!state.unbounded && state.peaks.empty())
        throw std::runtime_error(scenarios_.text(all_[c]) + "no response was found at " +
                                 space_.text(design) + ": " + state.message);
    }
  }

  void minimize_once() {
    round_responses_ = cases_.work().responses;
    round_value_ = std::min(cases_.value(), result_.amplitude);
    std::vector<double> y = space_.scaled(start_);
    const Problem problem = formulation_.problem(y, algorithm_, reference_, [this](auto at) { move_to(at); });
    result_.epigraph = result_.epigraph || formulation_.epigraph();

    Options options;
    options.algorithm = algorithm_.name;
    options.tolerances = options_.tolerances;
    options.local = options_.local;
    options.population = options_.population;
    options.seed = options_.seed;
    options.evaluations = std::max(1, options_.evaluations - static_cast<int>(result_.evaluations.size()));
    if (options_.seconds > 0) options.seconds = std::max(options_.seconds - seconds(), 1e-9);
    const bool smooth = algorithm_.name[1] == 'D' && !formulation_.epigraph() && problem.constraints.empty();
    bool stationary = false;
    options.progress = [&, smooth](const Progress&) {
      stationary = smooth && is_stationary();
      if (stationary) {  // rounding may have made another one look better
        result_.design = cases_.state(0).design;
        result_.amplitude = cases_.value();
      }
      return !user_stopped_ && !stationary;
    };
    Result found = minimize(problem, y, options);
    if (found.reason == Reason::user && !user_stopped_ && stationary) {
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
  bool is_stationary() const {
    const double value = cases_.value();
    if (!std::isfinite(value) || value > (1 + as_good) * result_.amplitude) return false;
    for (std::size_t c = 0; c < cases_.size(); ++c)
      if (cases_.state(c).peaks.size() > 1) return false;
    const std::vector<double>& design = cases_.state(0).design;
    const Vector gradient = cases_.gradient();
    for (std::size_t k = 0; k < design.size(); ++k) {
      const double slope = gradient[static_cast<Eigen::Index>(k)] / value * space_.slope(k, design[k]);
      const bool held =
          (design[k] == space_.lower()[k] && slope > 0) || (design[k] == space_.upper()[k] && slope < 0);
      if (!held && std::abs(slope) > small_gradient) return false;
    }
    return true;
  }

  // Of one round, with the numbers of all of them.
  std::string sentence(const Result& found) const {
    const std::size_t count = result_.evaluations.size();
    const std::string after = text(" after ", count, count == 1 ? " evaluation" : " evaluations");
    switch (found.reason) {
      case Reason::evaluation_limit:
        return text("the limit of ", options_.evaluations, " evaluations was reached");
      case Reason::time_limit:
        return text("the limit of ", options_.seconds, " s was reached at ", seconds(), " s") + after;
      default:
        return found.message.substr(0, found.message.rfind(" after ")) + after;
    }
  }

  // The responses at the best design. True where the search is to go on: with a higher peak than was seen, or
  // because others came up and went during a round that was not in vain.
  bool verify() {
    if (result_.design.empty() || !std::isfinite(result_.amplitude)) return false;
    const int responses = cases_.work().responses;
    const bool gained = result_.amplitude < (1 - gain) * round_value_;
    const double seen = result_.amplitude;
    start_ = result_.design;
    cases_.trace(start_);
    for (std::size_t c = 0; c < cases_.size(); ++c)
      if (const PeakState& state = cases_.state(c); !state.complete)
        result_.notes.push_back(scenarios_.text(all_[c]) + "the response at " + space_.text(start_) +
                                " ends within the window: " + state.message);
    const double now = cases_.value();
    const bool changed =
        formulation_.epigraph() ? responses > round_responses_ : formulation_.wants_epigraph(algorithm_);
    if (!(std::abs(now / seen - 1) > seen_before)) return changed && gained && !ended_;
    result_.notes.push_back(text("at ", space_.text(start_), " a peak of ", now,
                                 " m came up beside those that were followed, the highest of which has ",
                                 seen, " m"));
    result_.amplitude = now;
    return !ended_;
  }

  // Goes on with the dampers slipping that stick at the optimum; after that, once for each gain. A global
  // search looks for such designs itself.
  bool release() {
    if (ended_ || algorithm_.global || !cases_.stand_at(result_.design)) return false;
    if (!(result_.amplitude < (1 - gain) * stuck_value_)) return false;
    stuck_value_ = result_.amplitude;
    const auto design = released(cases_, space_.parameters(), space_.lower());
    if (!design) return false;
    const std::string stuck = space_.text(result_.design);
    evaluate(*design, true);
    if (!std::isfinite(cases_.value())) return false;
    result_.notes.push_back("at " + stuck +
                            " a friction element sticks; the search went on with it slipping, from " +
                            space_.text(*design));
    start_ = *design;
    return true;
  }

  // True where the search is to go on with it, from the design found.
  bool add_worst_scatter() {
    if (!scenarios_.scatter() || result_.status != Status::complete || result_.design.empty()) return false;
    if (!cases_.stand_at(result_.design)) cases_.trace(result_.design);
    start_ = result_.design;
    ++result_.scatter_rounds;
    std::vector<Scenario> found;
    for (std::size_t of = 0; of < scenarios_.size(); ++of) {
      std::vector<std::vector<double>> known;
      std::size_t any = 0;  // of this case
      for (std::size_t c = 0; c < all_.size(); ++c)
        if (all_[c].of == of) {
          known.push_back(all_[c].scatter);
          any = c;
        }
      const auto worst = scenarios_.worst(cases_.peaks(any).model_at(start_), known, [this] {
        tell();
        return !stopped();
      });
      const bool seen = std::any_of(known.begin(), known.end(),
                                    [&](const auto& scatter) { return same(scatter, worst.scatter); });
      if (!seen && cases_.weight(any) * worst.amplitude > (1 + worse) * cases_.value())
        found.push_back({of, worst.scatter});
    }
    if (found.empty() || result_.status == Status::stopped) return false;
    for (const Scenario& each : found) add(each);
    best_excess_ = stuck_value_ = infinity;
    if (result_.scatter_rounds < options_.scatter_rounds) return true;
    evaluate(start_);
    result_.status = Status::stopped;
    result_.stop.reason = "scatter_limit";
    result_.stop.message = text("the worst of what scatters was higher still after ", result_.scatter_rounds,
                                " rounds and ", result_.evaluations.size(), " evaluations");
    return false;
  }

  static bool same(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
      return std::abs(x - y) <= same_scatter * std::max(std::abs(x), std::abs(y));
    });
  }

  void finish() {
    if (!result_.design.empty() && std::isfinite(result_.amplitude)) {
      if (!cases_.stand_at(result_.design)) cases_.trace(result_.design);
      result_.feasible = best_excess_ == 0;
      result_.stop.message +=
          text("; the least amplitude is ", result_.amplitude, " m at ", space_.text(result_.design));
      if (!result_.feasible) result_.stop.message += text(", where a limit is exceeded by ", best_excess_);
      if (std::isfinite(cases_.value())) {
        describe_cases();
        if (options_.certificate && result_.status == Status::complete && result_.stop.reason != "flat")
          result_.certificate = certify(cases_, space_.lower(), space_.upper(), [this] {
            return options_.seconds == 0 || seconds() < options_.seconds;
          });
      }
    }
    result_.work = cases_.work();
    result_.seconds = seconds();
  }

  void describe_cases() {
    for (std::size_t c = 0; c < cases_.size(); ++c) {
      const PeakState& state = cases_.state(c);
      CaseResult each = scenarios_.result(all_[c]);
      each.amplitude = state.amplitude();
      each.point = cases_.peaks(c).observe(state.peaks[state.highest]);
      result_.cases.push_back(std::move(each));
    }
    for (const ActivePeak& peak : balance(cases_, space_.lower(), space_.upper()).active) {
      result_.cases[peak.in_case].active = true;
      result_.cases[peak.in_case].multiplier += peak.multiplier;
    }
    result_.point = result_.cases[cases_.highest()].point;
  }

  bool stopped() {
    if (user_stopped_) {
      result_.stop.reason = name(Reason::user);
      result_.stop.message = "the progress callback stopped the run";
    } else if (options_.seconds > 0 && seconds() >= options_.seconds) {
      result_.stop.reason = name(Reason::time_limit);
      result_.stop.message = text("the limit of ", options_.seconds, " s was reached at ", seconds(), " s");
    } else {
      return false;
    }
    result_.status = Status::stopped;
    return true;
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  const OptimumOptions& options_;
  DesignSpace space_;
  Algorithm algorithm_;
  Scenarios scenarios_;
  Cases cases_;
  std::vector<Scenario> all_;  // of the cases
  Formulation formulation_;
  Optimum result_;
  std::vector<double> start_;
  double reference_ = 1;  // V at the start
  double best_excess_ = infinity;
  int round_responses_ = 0;        // traced before the round
  double round_value_ = infinity;  // least before it
  double stuck_value_ = infinity;  // least one from which stuck dampers were released
  bool ended_ = false, user_stopped_ = false;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace

Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options) {
  return Search(scene, problem, options).run();
}

}  // namespace arcslip::optimize
