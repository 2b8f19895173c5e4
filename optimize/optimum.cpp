#include <arcslip/optimize/optimum.hpp>

#include <arcslip/optimize/constraint_peaks.hpp>
#include <arcslip/optimize/design_space.hpp>
#include <arcslip/optimize/epigraph.hpp>
#include <arcslip/optimize/text.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace arcslip::optimize {
namespace {

using observables::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_influence = 1e-12;  // d ln A / d ln p of less is none
constexpr double seen_before = 1e-8;    // relative: a response that is higher by more has a peak not watched
constexpr int most_rounds = 12;
constexpr double gain = 1e-7;            // relative, of a round that is worth another one
constexpr int spare_peaks = 3;           // that may come up during a round
constexpr double least_level = -60;      // of ln A/A_start, in the epigraph
constexpr double beyond_all = 60;        // ln A/A_start where it is infinite
constexpr double small_gradient = 1e-8;  // of d ln A / d ln p: what is left is rounding
constexpr double as_good = 1e-13;        // relative: amplitudes that differ by rounding
constexpr double limit_tolerance = 1e-8;

class Search {
 public:
  Search(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options)
      : problem_(problem),
        options_(options),
        space_(scene, problem),
        algorithm_(algorithm(options.algorithm.empty() ? "LD_SLSQP" : options.algorithm)),
        unit_(scene::to_rad_per_s(scene.frequency_unit)),
        peaks_(space_.model(), space_.parameters(),
               {problem.frequency_from * unit_, problem.frequency_to * unit_}) {
    result_.algorithm = algorithm_.name;
  }

  Optimum run() {
    try {
      begin();
      for (int round = 0; !ended_; ++round) {
        minimize_once();
        if (!verify() || round + 1 == most_rounds) break;
      }
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
  struct Limited {
    const ObservableLimit* limit;
    double sign, bound;  // sign * (observable - bound)/scale <= 0
  };

  std::string design_text(std::span<const double> design) const { return space_.text(design); }

  // A design with a finite amplitude that the parameters can change, the scene's own if it is one.
  void begin() {
    std::vector<double> start = space_.start(result_.notes);
    std::string why;
    for (int attempt = -1; attempt < space_.attempts(); ++attempt) {
      const std::vector<double> design = attempt < 0 ? start : space_.attempt(attempt);
      const PeakState& state = evaluate(design, true);
      std::string fault;
      if (state.unbounded)
        fault = state.message;
      else if (state.peaks.empty())
        fault = "no response was found there: " + state.message;
      else if (is_flat())
        fault = "no friction element slips there, so that the amplitude stays as it is";
      if (attempt < 0) {
        why = fault;
        first_fault_ = state.unbounded ? "unbounded" : state.peaks.empty() ? "no_response" : "flat";
      }
      if (fault.empty()) {
        if (attempt >= 0)
          result_.notes.push_back("the start " + design_text(start) + " was moved to " + design_text(design) +
                                  ": " + why);
        start_ = design;
        reference_ = state.amplitude();
        return;
      }
      if (stopped()) break;
    }
    ended_ = true;
    if (!result_.stop.reason.empty()) return;
    result_.stop.reason = first_fault_;
    result_.status = first_fault_ == "flat" ? Status::complete : Status::failed;
    result_.stop.message =
        first_fault_ == "flat"
            ? "the amplitude does not depend on " + space_.names() +
                  " within the bounds: no friction element slips at the peak"
            : "no start was found within the bounds; at " + design_text(start) + ": " + why;
  }

  bool is_flat() {
    const PeakState& state = peaks_.state();
    const Peak& highest = state.peaks[state.highest];
    for (std::size_t k = 0; k < state.design.size(); ++k)
      if (std::abs(highest.gradient[static_cast<Eigen::Index>(k)] * state.design[k]) >
          no_influence * highest.amplitude)
        return false;
    const auto point = peaks_.observe(highest);
    return std::all_of(point.elements.begin(), point.elements.end(),
                       [](const auto& element) { return !element.has_stick || element.slip_angles.empty(); });
  }

  const PeakState& evaluate(std::span<const double> design, bool trace = false) {
    const bool known =
        std::equal(design.begin(), design.end(), peaks_.state().design.begin(), peaks_.state().design.end());
    if (known && !trace) return peaks_.state();
    const PeakState& state = trace ? peaks_.trace(design) : peaks_.at(design);
    const double amplitude = state.amplitude();
    result_.evaluations.push_back({{design.begin(), design.end()}, amplitude});
    if (std::isnan(amplitude)) return state;
    const double excess = std::max(limit_excess(), space_.excess(design));
    if (excess < best_excess_ || (excess == best_excess_ && amplitude < result_.amplitude)) {
      best_excess_ = excess;
      result_.design.assign(design.begin(), design.end());
      result_.amplitude = amplitude;
    }
    if (options_.progress &&
        !options_.progress({static_cast<int>(result_.evaluations.size()), design,
                            state.peaks.empty() ? 0.0 : state.peaks[state.highest].omega(), amplitude,
                            best_excess_ == 0 ? result_.amplitude : infinity}))
      user_stopped_ = true;
    return state;
  }

  double limit_excess() {
    double excess = 0;
    const PeakState& state = peaks_.state();
    for (const Limited& each : one_sided_limits()) {
      if (state.unbounded || state.peaks.empty()) return 1;
      for (std::size_t i = 0; i < state.peaks.size(); ++i)
        if (const double value = limit_value(each, i, {}); value > limit_tolerance)
          excess = std::max(excess, value);
    }
    return excess;
  }

  std::vector<Limited> one_sided_limits() const {
    std::vector<Limited> all;
    for (const ObservableLimit& limit : problem_.limits) {
      if (std::isfinite(limit.at_most)) all.push_back({&limit, 1, limit.at_most});
      if (std::isfinite(limit.at_least)) all.push_back({&limit, -1, limit.at_least});
    }
    return all;
  }

  double limit_value(const Limited& each, std::size_t peak, std::span<double> gradient) {
    const PeakState& state = peaks_.state();
    const auto observable = space_.observable(each.limit->observable);
    const double scale = each.sign / (each.bound != 0 ? std::abs(each.bound) : 1);
    for (std::size_t k = 0; k < std::min(gradient.size(), state.design.size()); ++k)
      gradient[k] = scale * peaks_.change(peak, k, observable) * space_.slope(k, state.design[k]);
    return scale * (observable(peaks_.observe(state.peaks[peak])) - each.bound);
  }

  // ln A/A_start of a peak, by y.
  double level(const PeakState& state, std::size_t peak, std::span<double> gradient) const {
    const Peak& of = state.peaks[peak];
    for (std::size_t k = 0; k < std::min(gradient.size(), state.design.size()); ++k)
      gradient[k] =
          of.gradient[static_cast<Eigen::Index>(k)] / of.amplitude * space_.slope(k, state.design[k]);
    return std::log(of.amplitude / reference_);
  }

  std::optional<std::size_t> peak_of_constraint(std::size_t k) {
    return constraints_.peak(k, peaks_.state(), peaks_.work().responses);
  }

  const PeakState& at(std::span<const double> y) {
    const PeakState& state = evaluate(space_.design(y));
    if (!state.unbounded && state.peaks.empty())
      throw std::runtime_error("no response was found at " + design_text(state.design) + ": " +
                               state.message);
    return state;
  }

  void minimize_once() {
    const std::size_t n = start_.size();
    const PeakState& state = peaks_.state();
    const bool by_gradient = algorithm_.name.size() > 1 && algorithm_.name[1] == 'D';
    const bool epigraph = state.peaks.size() > 1 && by_gradient && algorithm_.takes_constraints;
    result_.epigraph = result_.epigraph || epigraph;
    round_responses_ = peaks_.work().responses;
    round_amplitude_ = state.amplitude();
    Problem problem;
    std::vector<double> y = space_.scaled(start_);
    problem.lower = space_.scaled(space_.lower());
    problem.upper = space_.scaled(space_.upper());
    constraints_ = ConstraintPeaks(state.peaks.size() + spare_peaks);
    if (epigraph) {
      add_level(problem, y, std::log(state.amplitude() / reference_), least_level, beyond_all,
                [this](auto x) { at(x); });
      for (std::size_t k = 0; k < constraints_.size(); ++k)
        problem.constraints.push_back({text("peak ", k + 1), [this, n, k](auto x, auto g) {
                                         const PeakState& here = at(x.first(n));
                                         std::fill(g.begin(), g.end(), 0.0);
                                         if (here.unbounded) return beyond_all - x[n];
                                         const auto peak = peak_of_constraint(k);
                                         if (!peak) return -1.0;
                                         const double value =
                                             level(here, *peak, g.first(std::min(n, g.size())));
                                         if (!g.empty()) g[n] = -1;
                                         return value - x[n];
                                       }});
    } else {
      problem.objective = [this](auto x, auto g) {
        const PeakState& here = at(x);
        if (here.unbounded) {
          std::fill(g.begin(), g.end(), 0.0);
          return infinity;
        }
        return level(here, here.highest, g);
      };
    }
    for (const Limited& each : one_sided_limits())
      for (std::size_t c = 0; c < constraints_.size(); ++c)
        problem.constraints.push_back({each.limit->observable, [this, n, each, c](auto x, auto g) {
                                         const PeakState& here = at(x.first(n));
                                         std::fill(g.begin(), g.end(), 0.0);
                                         if (here.unbounded) return 1.0;
                                         const auto peak = peak_of_constraint(c);
                                         return peak ? limit_value(each, *peak, g) : -1.0;
                                       }});
    space_.add_linear(problem);

    Options options;
    options.algorithm = algorithm_.name;
    options.tolerances = options_.tolerances;
    options.local = options_.local;
    options.population = options_.population;
    options.seed = options_.seed;
    options.evaluations = std::max(1, options_.evaluations - static_cast<int>(result_.evaluations.size()));
    if (options_.seconds > 0) options.seconds = std::max(options_.seconds - seconds(), 1e-9);
    const bool smooth = by_gradient && !epigraph && problem.constraints.empty();
    bool stationary = false;
    options.progress = [&, smooth](const Progress&) {
      stationary = smooth && is_stationary();
      if (stationary) {  // rounding may have made another one look better
        result_.design = peaks_.state().design;
        result_.amplitude = peaks_.state().amplitude();
      }
      return !user_stopped_ && !stationary;
    };
    Result found = minimize(problem, y, options);
    if (found.reason == Reason::user && !user_stopped_ && stationary) {
      found.reason = Reason::converged;
      found.message = text("no entry of d ln A / d ln p is above ", small_gradient, " after ");
    }
    reason_ = found.reason;
    result_.stop.reason = name(found.reason);
    result_.stop.message = sentence(found);
    result_.status =
        is_converged(reason_) || reason_ == Reason::rounding ? Status::complete
        : reason_ == Reason::evaluation_limit || reason_ == Reason::time_limit || reason_ == Reason::user
            ? Status::stopped
            : Status::failed;
    ended_ = result_.status != Status::complete;
  }

  // At the best design so far: a flat place that is worse is none.
  bool is_stationary() const {
    const PeakState& state = peaks_.state();
    if (state.peaks.empty() || state.peaks.size() > 1 ||
        state.amplitude() > (1 + as_good) * result_.amplitude)
      return false;
    for (std::size_t k = 0; k < state.design.size(); ++k) {
      const double slope = state.peaks[0].gradient[static_cast<Eigen::Index>(k)] / state.amplitude() *
                           space_.slope(k, state.design[k]);
      const bool held = (state.design[k] == space_.lower()[k] && slope > 0) ||
                        (state.design[k] == space_.upper()[k] && slope < 0);
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

  // The response at the best design. True where the search is to go on: with a higher peak than was seen, or
  // because others came up and went during a round that was not in vain.
  bool verify() {
    if (result_.design.empty() || !std::isfinite(result_.amplitude)) return false;
    const bool changed = result_.epigraph && peaks_.work().responses > round_responses_;
    const bool gained = result_.amplitude < (1 - gain) * round_amplitude_;
    const double seen = result_.amplitude;
    const std::vector<double> best = result_.design;
    const PeakState& state = peaks_.trace(best);
    if (!state.complete)
      result_.notes.push_back("the response at " + design_text(best) +
                              " ends within the window: " + state.message);
    const double now = state.amplitude();
    start_ = best;
    if (!(std::abs(now / seen - 1) > seen_before)) return changed && gained && !ended_;
    result_.notes.push_back(text("at ", design_text(best), " a peak of ", now,
                                 " m came up beside those that were followed, the highest of which has ",
                                 seen, " m"));
    result_.amplitude = now;
    return !ended_;
  }

  void finish() {
    if (!result_.design.empty() && std::isfinite(result_.amplitude)) {
      if (peaks_.state().design != result_.design) peaks_.trace(result_.design);
      const PeakState& state = peaks_.state();
      if (!state.peaks.empty()) result_.point = peaks_.observe(state.peaks[state.highest]);
      result_.feasible = best_excess_ == 0;
      result_.stop.message +=
          text("; the least amplitude is ", result_.amplitude, " m at ", design_text(result_.design));
      if (!result_.feasible) result_.stop.message += text(", where a limit is exceeded by ", best_excess_);
      if (options_.certificate && result_.status == Status::complete && result_.stop.reason != "flat")
        result_.certificate = certify(peaks_, space_.lower(), space_.upper(), [this] {
          return options_.seconds == 0 || seconds() < options_.seconds;
        });
    }
    result_.work = peaks_.work();
    result_.seconds = seconds();
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

  const OptimumProblem& problem_;
  const OptimumOptions& options_;
  DesignSpace space_;
  Algorithm algorithm_;
  double unit_;
  PeakAmplitude peaks_;
  Optimum result_;
  ConstraintPeaks constraints_;  // of the epigraph
  std::vector<double> start_;
  double reference_ = 1;  // A at the start
  double best_excess_ = infinity;
  int round_responses_ = 0;  // traced before the round
  double round_amplitude_ = infinity;
  std::string first_fault_;
  bool ended_ = false, user_stopped_ = false;
  Reason reason_ = Reason::failed;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace

Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options) {
  return Search(scene, problem, options).run();
}

}  // namespace arcslip::optimize
