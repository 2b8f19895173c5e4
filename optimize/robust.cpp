#include <arcslip/optimize/robust.hpp>

#include <arcslip/optimize/design_space.hpp>
#include <arcslip/optimize/epigraph.hpp>
#include <arcslip/optimize/text.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace arcslip::optimize {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double far_above = 60;  // in ln A, where it is infinite
constexpr int most_rounds = 6;
constexpr double seen_before = 1e-8;  // relative

class RobustSearch {
 public:
  RobustSearch(const scene::Scene& scene, const OptimumProblem& problem, const std::vector<RobustCase>& cases,
               Robust criterion, const OptimumOptions& options)
      : space_(scene, problem), criterion_(criterion), options_(options) {
    if (cases.empty()) throw OptionsError("there is no case");
    if (!problem.limits.empty()) throw OptionsError("a robust search takes no limits on observables");
    const double unit = scene::to_rad_per_s(scene.frequency_unit);
    double sum = 0;
    for (const RobustCase& each : cases) {
      if (!(each.weight > 0 && std::isfinite(each.weight)))
        throw OptionsError(text("the weight of a case is ", each.weight, ", must be above 0"));
      scene::Scene with = scene;
      for (const auto& [name, value] : each.set) {
        for (const DesignVariable& v : problem.over)
          if (v.name == name) throw OptionsError("a case sets \"" + name + "\", which the search is over");
        scene::set(with, name, value);
      }
      peaks_.push_back(std::make_unique<PeakAmplitude>(
          std::make_shared<const model::Model>(model::build(with)), space_.parameters(),
          observables::FrequencyWindow{problem.frequency_from * unit, problem.frequency_to * unit}));
      weights_.push_back(each.weight);
      sum += each.weight;
    }
    if (criterion == Robust::mean)
      for (double& weight : weights_) weight /= sum;
  }

  RobustOptimum run() {
    start_ = space_.start(result_.notes);
    reference_ = value(start_, true);
    if (!std::isfinite(reference_)) {
      result_.stop.reason = "unbounded";
      result_.stop.message = "at the start " + space_.text(start_) + " the amplitude of a case is not finite";
      return std::move(result_);
    }
    keep(start_, reference_);
    for (int round = 0; round < most_rounds; ++round) {
      search();
      const double seen = result_.value, now = value(result_.design, true);
      result_.value = now;
      start_ = result_.design;
      if (std::abs(now / seen - 1) <= seen_before || result_.status != observables::Status::complete) break;
    }
    for (const auto& peaks : peaks_) {
      result_.amplitudes.push_back(peaks->state().amplitude());
      result_.work.responses += peaks->work().responses;
      result_.work.followed += peaks->work().followed;
      result_.work.factorizations += peaks->work().factorizations;
    }
    result_.stop.message += text("; the least is ", result_.value, " m at ", space_.text(result_.design));
    return std::move(result_);
  }

 private:
  void keep(std::span<const double> design, double value) {
    if (!result_.design.empty() && value >= result_.value) return;
    result_.design.assign(design.begin(), design.end());
    result_.value = value;
  }

  // The criterion at a design, where all cases stand then.
  double value(std::span<const double> design, bool trace = false) {
    double sum = 0, most = 0;
    for (std::size_t c = 0; c < peaks_.size(); ++c) {
      const PeakState& state = trace ? peaks_[c]->trace(design) : peaks_[c]->at(design);
      if (!state.unbounded && state.peaks.empty())
        throw std::runtime_error("no response was found at " + space_.text(design) + ": " + state.message);
      sum += weights_[c] * state.amplitude();
      most = std::max(most, weights_[c] * state.amplitude());
    }
    return criterion_ == Robust::mean ? sum : most;
  }

  void at(std::span<const double> y) {
    const std::vector<double> design = space_.design(y);
    if (design == last_) return;
    last_ = design;
    ++result_.evaluations;
    const double now = value(design);
    if (std::isfinite(now) && space_.excess(design) == 0) keep(design, now);
  }

  // d A_max / dy_k of a case.
  double slope(std::size_t c, std::size_t k) const {
    const PeakState& state = peaks_[c]->state();
    return state.peaks[state.highest].gradient[static_cast<Eigen::Index>(k)] *
           space_.slope(k, state.design[k]);
  }

  void search() {
    const std::size_t n = start_.size();
    const Algorithm chosen = algorithm(options_.algorithm.empty() ? "LD_SLSQP" : options_.algorithm);
    const bool epigraph = criterion_ == Robust::worst && chosen.takes_constraints &&
                          chosen.name.find("D_") != std::string::npos;
    Problem problem;
    problem.lower = space_.scaled(space_.lower());
    problem.upper = space_.scaled(space_.upper());
    std::vector<double> y = space_.scaled(start_);
    if (epigraph) {
      add_level(problem, y, std::log(result_.value / reference_), -far_above, far_above,
                [this](auto x) { at(x); });
      for (std::size_t c = 0; c < peaks_.size(); ++c)
        problem.constraints.push_back({text("case ", c + 1), [this, n, c](auto x, auto g) {
                                         at(x.first(n));
                                         std::fill(g.begin(), g.end(), 0.0);
                                         const double amplitude = peaks_[c]->state().amplitude();
                                         if (!std::isfinite(amplitude)) return far_above - x[n];
                                         for (std::size_t k = 0; k < std::min(n, g.size()); ++k)
                                           g[k] = slope(c, k) / amplitude;
                                         if (!g.empty()) g[n] = -1;
                                         return std::log(weights_[c] * amplitude / reference_) - x[n];
                                       }});
    } else {
      problem.objective = [this, n](auto x, auto g) {
        at(x);
        std::fill(g.begin(), g.end(), 0.0);
        const double now = value(last_);
        if (!std::isfinite(now)) return infinity;
        for (std::size_t c = 0; c < peaks_.size() && !g.empty(); ++c) {
          const double part = weights_[c] * peaks_[c]->state().amplitude();
          if (criterion_ == Robust::worst && part < now) continue;
          for (std::size_t k = 0; k < n; ++k) g[k] += weights_[c] * slope(c, k) / now;
        }
        return std::log(now / reference_);
      };
    }
    space_.add_linear(problem);
    Options options;
    options.algorithm = chosen.name;
    options.tolerances = options_.tolerances;
    options.evaluations = std::max(1, options_.evaluations - result_.evaluations);
    options.seconds = options_.seconds;
    options.local = options_.local;
    options.population = options_.population;
    options.seed = options_.seed;
    options.progress = [this](const Progress&) {
      const double now = value(last_);
      return !options_.progress || options_.progress({result_.evaluations, last_, 0, now, result_.value});
    };
    const Result found = minimize(problem, y, options);
    const bool stopped = found.reason == Reason::evaluation_limit || found.reason == Reason::time_limit ||
                         found.reason == Reason::user;
    result_.status = is_converged(found.reason) || found.reason == Reason::rounding
                         ? observables::Status::complete
                     : stopped ? observables::Status::stopped
                               : observables::Status::failed;
    result_.stop.reason = name(found.reason);
    result_.stop.message = found.message.substr(
        0, std::min(found.message.find("; the best value is "), found.message.find("; no evaluation")));
  }

  DesignSpace space_;
  Robust criterion_;
  const OptimumOptions& options_;
  std::vector<std::unique_ptr<PeakAmplitude>> peaks_;  // of each case
  std::vector<double> weights_;
  std::vector<double> start_, last_;
  double reference_ = 1;
  RobustOptimum result_;
};

}  // namespace

RobustOptimum robust_optimum(const scene::Scene& scene, const OptimumProblem& problem,
                             const std::vector<RobustCase>& cases, Robust criterion,
                             const OptimumOptions& options) {
  return RobustSearch(scene, problem, cases, criterion, options).run();
}

}  // namespace arcslip::optimize
