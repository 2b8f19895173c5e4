#include <arcslip/optimize/evaluation/formulation.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/observables/quantities.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::optimize {

using continuation::text;
namespace {

constexpr int spare_peaks = 3;       // that may come up during a round, in each case
constexpr double least_level = -60;  // of ln V/V_0
constexpr double beyond_all = 60;    // ln V/V_0 where it is infinite

// Epigraph form: min over y of sum_g max_k f_gk(y) as min sum_g exp(t_g) subject to ln f_gk(y) <= t_g, with
// the levels t_g as additional variables at the end. One group: min t_1.
//
// Adds levels to the variables of a problem and to its start, and sets ln sum_g exp(t_g) as the objective.
// visit: called with every y at which the objective is evaluated. The caller adds the constraints
// ln f_gk(y) - t_g <= 0.
void add_levels(NonlinearProgram& problem, std::vector<double>& start, std::span<const double> levels,
                double lower, double upper, std::function<void(std::span<const double>)> visit) {
  const std::size_t n = start.size();
  start.insert(start.end(), levels.begin(), levels.end());
  problem.lower.insert(problem.lower.end(), levels.size(), lower);
  problem.upper.insert(problem.upper.end(), levels.size(), upper);
  problem.objective = [n, visit = std::move(visit)](std::span<const double> x, std::span<double> g) {
    visit(x.first(n));
    const auto t = x.subspan(n);
    const double most = *std::max_element(t.begin(), t.end());
    double sum = 0;
    for (const double each : t) sum += std::exp(each - most);
    if (!g.empty()) {
      std::fill(g.begin(), g.end(), 0.0);
      for (std::size_t k = 0; k < t.size(); ++k) g[n + k] = std::exp(t[k] - most) / sum;
    }
    return most + std::log(sum);
  };
}

}  // namespace

Formulation::Formulation(const OptimumProblem& problem, const DesignSpace& space, LoadCases& cases)
    : space_(space), cases_(cases) {
  for (const ObservableLimit& limit : problem.limits) {
    const auto add = [&](double sign, double bound) {
      if (std::isfinite(bound))
        limits_.push_back({space.observable(limit.observable), observables::needed_by({&limit.observable, 1}),
                           limit.observable, sign, bound});
    };
    add(1, limit.at_most);
    add(-1, limit.at_least);
  }
}

bool Formulation::wants_epigraph(const Algorithm& algorithm) const {
  if (!algorithm.takes_constraints || algorithm.name[1] != 'D') return false;
  std::vector<std::size_t> peaks(cases_.groups(), 0);
  for (std::size_t c = 0; c < cases_.size(); ++c) peaks[cases_.group(c)] += cases_.state(c).peaks.size();
  return *std::max_element(peaks.begin(), peaks.end()) > 1;
}

NonlinearProgram Formulation::problem(std::vector<double>& y, const Algorithm& algorithm, double reference,
                                      std::function<void(std::span<const double>)> move) {
  const std::size_t n = y.size();
  reference_ = reference;
  move_ = std::move(move);
  constraints_.clear();
  for (std::size_t c = 0; c < cases_.size(); ++c)
    constraints_.emplace_back(cases_.state(c).peaks.size() + spare_peaks);
  epigraph_ = wants_epigraph(algorithm);
  NonlinearProgram problem;
  problem.lower = space_.scaled(space_.lower());
  problem.upper = space_.scaled(space_.upper());
  if (epigraph_)
    add_epigraph(problem, y);
  else
    problem.objective = [this](auto x, auto g) {
      move_(x);
      const double value = cases_.value();
      std::fill(g.begin(), g.end(), 0.0);
      if (std::isinf(value)) return value;
      if (!g.empty()) {
        const Vector gradient = cases_.gradient();
        for (std::size_t k = 0; k < g.size(); ++k)
          g[k] = gradient[static_cast<Eigen::Index>(k)] / value * space_.slope(k, cases_.state(0).design[k]);
      }
      return std::log(value / reference_);
    };
  add_limits(problem, n);
  space_.add_linear(problem);
  return problem;
}

void Formulation::add_epigraph(NonlinearProgram& problem, std::vector<double>& y) {
  const std::size_t n = y.size();
  std::vector<double> levels;
  for (std::size_t g = 0; g < cases_.groups(); ++g)
    levels.push_back(std::max(least_level, std::log(cases_.height(cases_.highest_of(g)) / reference_)));
  add_levels(problem, y, levels, least_level, beyond_all, move_);
  for (std::size_t c = 0; c < cases_.size(); ++c)
    for (std::size_t k = 0; k < constraints_[c].size(); ++k)
      problem.constraints.push_back(
          {cases_.size() > 1 ? text("peak ", k + 1, " of case ", c + 1) : text("peak ", k + 1),
           [this, n, c, k](auto x, auto g) {
             move_(x.first(n));
             std::fill(g.begin(), g.end(), 0.0);
             const std::size_t t = n + cases_.group(c);
             if (cases_.state(c).unbounded) return beyond_all - x[t];
             const auto at = peak(c, k);
             if (!at || cases_.state(c).peaks[*at].amplitude == 0) return -1.0;  // e.g. without excitation
             const double value = level(c, *at, g.first(std::min(n, g.size())));
             if (!g.empty()) g[t] = -1;
             return value - x[t];
           }});
}

void Formulation::add_limits(NonlinearProgram& problem, std::size_t n) {
  for (const Limited& each : limits_)
    for (std::size_t c = 0; c < cases_.size(); ++c)
      for (std::size_t k = 0; k < constraints_[c].size(); ++k)
        problem.constraints.push_back({each.name, [this, n, c, k, &each](auto x, auto g) {
                                         move_(x.first(n));
                                         std::fill(g.begin(), g.end(), 0.0);
                                         if (cases_.state(c).unbounded) return 1.0;
                                         const auto at = peak(c, k);
                                         return at && is_limited(c, *at)
                                                    ? limit(each, c, *at, g.first(std::min(n, g.size())))
                                                    : -1.0;
                                       }});
}

double Formulation::margin() {
  double margin = space_.margin(cases_.state(0).design);
  if (limits_.empty()) return margin;
  for (std::size_t c = 0; c < cases_.size(); ++c) {
    const PeakState& state = cases_.state(c);
    if (state.unbounded || state.peaks.empty()) return std::max(margin, 1.0);
    for (const Limited& each : limits_)
      for (std::size_t i = 0; i < state.peaks.size(); ++i)
        if (is_limited(c, i)) margin = std::max(margin, limit(each, c, i, {}));
  }
  return margin;
}

double Formulation::excess() {
  const double worst = margin();
  return worst > limit_tolerance ? worst : 0;
}

std::vector<ActiveLimit> Formulation::active() {
  const std::vector<double>& design = cases_.state(0).design;
  std::vector<ActiveLimit> active = space_.active(design);
  for (const Limited& each : limits_)
    for (std::size_t c = 0; c < cases_.size(); ++c)
      for (std::size_t i = 0; i < cases_.state(c).peaks.size(); ++i) {
        if (!is_limited(c, i)) continue;
        const double value = limit(each, c, i, {});
        if (value < -as_active) continue;
        Vector gradient(static_cast<Eigen::Index>(design.size()));
        limit(each, c, i, {gradient.data(), design.size()});
        if (gradient.allFinite())
          active.push_back({each.name, c, gradient, -value, 0, value == height(c, i)});
      }
  return active;
}

// ln w A/V_0 of a peak, by y.
double Formulation::level(std::size_t c, std::size_t peak, std::span<double> gradient) const {
  const PeakState& state = cases_.state(c);
  const Peak& of = state.peaks[peak];
  for (std::size_t k = 0; k < gradient.size(); ++k)
    gradient[k] = of.gradient[static_cast<Eigen::Index>(k)] / of.amplitude * space_.slope(k, state.design[k]);
  return std::log(cases_.weight(c) * of.amplitude / reference_);
}

// Limits apply to peaks: not at an end of the window from which the response increases inwards. When that
// changes, a peak reaches the end, with the same observables.
bool Formulation::is_limited(std::size_t c, std::size_t peak) const {
  const Peak& of = cases_.state(c).peaks[peak];
  return !of.rises_inwards() && !of.is_further;
}

// ln of the amplitude over the threshold above which a limit applies to a peak; infinity if it
// always applies.
double Formulation::height(std::size_t c, std::size_t peak) const {
  const PeakState& state = cases_.state(c);
  const Peak& of = state.peaks[peak];
  if (peak == state.highest || of.kind == PeakKind::kink) return std::numeric_limits<double>::infinity();
  return std::log(of.amplitude / (watched_share * state.amplitude()));
}

// A limit applies to peaks above a share of the highest. For continuity at that threshold it is satisfied if
// the peak is below it: the smaller of both counts.
double Formulation::limit(const Limited& each, std::size_t c, std::size_t peak, std::span<double> gradient) {
  PeakAmplitude& peaks = cases_.peaks(c);
  const PeakState& state = peaks.state();
  const Peak &of = state.peaks[peak], &highest = state.peaks[state.highest];
  const double scale = each.sign / (each.bound != 0 ? std::abs(each.bound) : 1);
  const double value = scale * (each.observable(peaks.observe(of, each.read)) - each.bound);
  const double above = height(c, peak);
  const bool by_height = above < value;
  for (std::size_t k = 0; k < gradient.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    gradient[k] = (by_height ? of.gradient[i] / of.amplitude - highest.gradient[i] / highest.amplitude
                             : scale * peaks.change(peak, k, each.observable, each.read)) *
                  space_.slope(k, state.design[k]);
  }
  return by_height ? above : value;
}

std::optional<std::size_t> Formulation::peak(std::size_t c, std::size_t constraint) {
  return constraints_[c].peak(constraint, cases_.state(c), cases_.peaks(c).work().responses);
}

namespace {

constexpr double same_peak = 0.03;  // relative change of the frequency between responses

}  // namespace

std::optional<std::size_t> ConstraintPeaks::peak(std::size_t k, const PeakState& state, int responses) {
  if (responses_ != responses) {
    responses_ = responses;
    assign(state);
  }
  Constrained& here = all_[k];
  if (here.peak) here.omega = state.peaks[*here.peak].omega();
  return here.peak;
}

void ConstraintPeaks::assign(const PeakState& state) {
  std::vector<bool> taken(state.peaks.size(), false);
  for (Constrained& each : all_) {
    each.peak.reset();
    double nearest = same_peak * each.omega;
    for (std::size_t i = 0; i < state.peaks.size(); ++i)
      if (!taken[i] && std::abs(state.peaks[i].omega() - each.omega) < nearest) {
        nearest = std::abs(state.peaks[i].omega() - each.omega);
        each.peak = i;
      }
    if (each.peak) taken[*each.peak] = true;
  }
  for (std::size_t i = 0; i < state.peaks.size(); ++i) {
    const auto free =
        std::find_if(all_.begin(), all_.end(), [](const Constrained& each) { return !each.peak; });
    if (taken[i] || free == all_.end()) continue;
    free->peak = i;
    free->omega = state.peaks[i].omega();
  }
}

}  // namespace arcslip::optimize
