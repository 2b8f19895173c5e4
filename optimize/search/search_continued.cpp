// Whether a search has reached a minimum, and how it continues otherwise.

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/optimize/certificate/certify.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/search/convergence.hpp>
#include <arcslip/optimize/search/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <tuple>
#include <utility>

namespace arcslip::optimize {

using continuation::text;
namespace {

using observables::Status;

constexpr int most_restarts = 5;
constexpr double step_beyond = 1e-4, jumps = 1e-2;  // of y; of V, relative
constexpr double limit_jumps = 2e-3;                // of a limit, relative
constexpr double limit_bends = 1e-6;                // the same: far above what curvature makes of it so near
constexpr double active_case = 1e-6;                // relative: as high as the highest case
constexpr std::size_t most_by_cobyla = 5;           // starts elsewhere, the lowest
constexpr double next_to = 1e-2;     // of the range of each variable: a search so near a known minimum ...
constexpr double next_above = 1e-3;  // ... and so little above it, relative, leads to it
constexpr double apart = 0.1;        // of the range of a variable: designs that are worth two searches
constexpr double same_idle_level = 1e-9;  // of amplitudes, relative: both are where nothing slips at the peak

// Algorithms that continue where another one ended at no minimum. CCSAQ descends from the feasible side by
// conservative approximations (Svanberg 2002), slowly at the end; SLSQP is fast nearby.
constexpr std::array ladder = {"LD_CCSAQ", "LD_SLSQP", "LN_COBYLA", "LD_SLSQP"};

}  // namespace

bool Search::goes_on() {
  if (minimum_left_ && result_.status == Status::failed && best().value == minimum_left_->value &&
      result_.stop.reason != reasons::objective_failed) {  // it led to nothing
    result_.status = minimum_left_->status;
    result_.stop = minimum_left_->stop;
  }
  minimum_left_.reset();
  if (result_.status == Status::complete && interrupted()) return false;
  designs_.recall_best();
  if (result_.status != Status::complete || best().design.empty() || !std::isfinite(best().value))
    return false;
  if (best().excess > 0) {
    if (find_feasible() || look_elsewhere(false)) return true;
    if (interrupted()) return false;
    result_.status = Status::stopped;
    result_.stop.reason = reasons::infeasible;
    result_.stop.message = "no feasible design was found: " + result_.stop.message;
    return false;
  }
  if (result_.stop.reason == reasons::flat) return false;
  if (!move_to_best()) return false;
  if (const Balance left = balance_here(designs_); !is_stationary(left)) return refine(left);
  if (look_elsewhere(true)) return true;
  if (interrupted() || !options_.certificate || !move_to_best()) return false;
  designs_.begin("the certificate");
  describe();
  result_.certificate = certify(
      cases(), space().lower(), space().upper(), designs_.formulation().active(),
      [this] { return designs_.formulation().margin(); }, [this] { return watch_.go_on(); });
  return !interrupted() && passed_lower();
}

bool Search::move_to_best() {
  if (!cases().is_at(best().design)) cases().trace(best().design, observables::Steps::curve);
  return std::isfinite(cases().value());
}

void Search::go_from(const std::vector<double>& design) {
  start_ = design;
  stuck_value_ = HUGE_VAL;
  refinements_ = 0;
  algorithm_ = asked_;
}

bool Search::refine(const Balance& left) {
  if (refinements_ < ladder.size() && best().value != refined_) {
    const std::size_t next = refinements_;
    note(text(algorithm_.name, " ended at ", space().text(best().design), " with residual gradient ",
              left.stationarity, "; ", ladder[next], " continued from there"));
    go_from(best().design);
    refinements_ = next + 1;
    algorithm_ = algorithm(ladder[next]);
    return true;
  }
  refined_ = best().value;
  if (look_elsewhere(false)) return true;
  if (interrupted()) return false;
  result_.status = Status::stopped;
  result_.stop.reason = reasons::not_stationary;
  result_.stop.message = text("no algorithm reached a minimum: residual gradient ", left.stationarity,
                              " (at most ", most_stationarity, "), complementarity ", left.complementarity,
                              " (at most ", most_complementarity, ")", after()) +
                         jump(left);
  return false;
}

std::string Search::jump(const Balance& left) {
  std::vector<double> y = space().scaled(best().design);
  for (std::size_t k = 0; k < y.size(); ++k)
    y[k] -= step_beyond * left.left[static_cast<Eigen::Index>(k)] / left.stationarity;
  const std::vector<double> design = space().design(y);
  cases().trace(design, observables::Steps::curve);
  const std::string there = "; a little beyond, at " + space().text(design) + ", ";
  if (cases().value() > (1 + jumps) * best().value)
    return there + text("the amplitude jumps to ", cases().value(), " m");
  if (const double exceeded = designs_.formulation().excess(); exceeded > limit_jumps)
    return there + text("a peak appears at which a limit is exceeded by ", exceeded);
  else if (exceeded > limit_bends)
    return there +
           text("a limit is exceeded by ", exceeded, " against its gradient, which is a different one there");
  if (cases().value() > best().value)
    return there + "the amplitude rises against its gradient, which is a different one there";
  return "";
}

bool Search::find_feasible() {
  if (std::exchange(sought_feasible_, true)) return false;
  designs_.begin("the search for a feasible design");
  const std::string exceeds = space().text(best().design);
  for (int k = 0; k < space().attempts() + space().samples() && best().excess > 0; ++k) {
    if (!watch_.go_on()) return false;
    designs_.evaluate(k < space().attempts() ? space().attempt(k) : space().sample(k - space().attempts()),
                      true);
  }
  if (best().excess > 0) return false;
  go_from(best().design);
  note("the search reached " + exceeds + ", where a limit is exceeded, and continued from " +
       space().text(start_) + ", where none is");
  return true;
}

// Where further searches start, and by which algorithms. from_minimum: otherwise designs over the bounds were
// sampled in vain, though not by these algorithms.
std::vector<Search::Beginning> Search::beginnings(bool from_minimum) {
  std::vector<Beginning> all;
  if (from_minimum) {
    const auto designs = lowest_elsewhere();
    for (const auto& design : designs) all.push_back({design, asked_.name});
    // Its first steps are long: it leaves a basin, and the plateau where a damper sticks, for a lower one.
    if (limited_ && asked_.name != "LN_COBYLA")
      for (std::size_t i = 0; i < std::min(most_by_cobyla, designs.size()); ++i)
        all.push_back({designs[i], "LN_COBYLA"});
  }
  if (!limited_) return all;
  std::vector<std::string> ignored;
  for (const char* other : {"LN_COBYLA", "LD_MMA"}) all.push_back({space().start(ignored), other});
  return all;
}

// A search of its own within the limits of this one, which reports as part of it.
Optimum Search::search_from(const Beginning& beginning) {
  scene::Scene there = scene_;
  for (std::size_t k = 0; k < beginning.design.size(); ++k)
    scene::set(there, problem_.over[k].name, beginning.design[k]);
  OptimumOptions options = options_;
  options.algorithm = beginning.algorithm;
  options.seconds = 0;
  options.certificate = false;
  options.starts = 1;
  ended_near_.reset();
  std::exception_ptr thrown;
  options.progress = [&](OptimumProgress now) {
    now.evaluations += static_cast<int>(count() + designs_.elsewhere().size());
    now.best = std::min(now.best, best().value);
    now.phase = watch_.phase();
    try {
      if (options_.progress && !options_.progress(now)) watch_.stop();
    } catch (...) {
      thrown = std::current_exception();
      watch_.stop();
    }
    if (!limited_ && !ended_near_) ended_near_ = known_minimum(now.design, now.amplitude);
    return !watch_.stopped() && !ended_near_;
  };
  options.go_on = [this] { return watch_.go_on(); };
  Search part(there, problem_, options);
  part.is_part_ = true;
  Optimum found = part.run();
  if (thrown) std::rethrow_exception(thrown);
  designs_.elsewhere().insert(designs_.elsewhere().end(), found.evaluations.begin(), found.evaluations.end());
  add(found.work, work_elsewhere_);
  return found;
}

bool Search::has_several_starts() const {
  return (limited_ || problem_.over.size() > 1) && options_.starts > 1 && !asked_.global;
}

std::optional<Evaluation> Search::known_minimum(std::span<const double> design, double value) const {
  const auto leads_to = [&](const Evaluation& minimum) {
    const double above = value / minimum.amplitude - 1;
    return above > -same_minimum && above < next_above && space().distance(design, minimum.design) < next_to;
  };
  const auto found = std::find_if(minima_.begin(), minima_.end(), leads_to);
  if (found == minima_.end()) return {};
  return *found;
}

void Search::count_start(const Optimum& found) {
  if (ended_near_)
    minima_.push_back(*ended_near_);
  else if (found.status == Status::complete && found.feasible && !found.design.empty())
    minima_.push_back({found.design, found.amplitude});
  else
    ++to_no_minimum_;
}

void Search::count_starts() {
  if (minima_.empty() || !result_.feasible) return;
  Starts starts{.count = static_cast<int>(minima_.size()) + to_no_minimum_,
                .to_optimum = 0,
                .to_none = to_no_minimum_,
                .highest = result_.amplitude};
  for (const Evaluation& each : minima_) {
    starts.to_optimum += each.amplitude <= (1 + same_minimum) * result_.amplitude;
    starts.highest = std::max(starts.highest, each.amplitude);
  }
  if (starts.to_optimum == 0) {  // the search went on lower from where one of them ended
    starts.to_optimum = 1;
    if (led_on_from_none_) --starts.to_none;
  }
  result_.starts = starts;
}

bool Search::look_elsewhere(bool at_minimum) {
  if (!has_several_starts() || std::exchange(sought_elsewhere_, true)) return false;
  designs_.begin("the search elsewhere");
  const std::vector<double> here = best().design;
  const bool within = best().excess == 0;
  double least = within ? (1 - gain) * best().value : HUGE_VAL;
  if (at_minimum)
    minima_.push_back({here, best().value});
  else
    ++to_no_minimum_;
  const std::vector<Beginning> all = beginnings(within);
  std::vector<double> lower;
  if (within && best().value < least) {
    least = best().value;
    lower = best().design;
  }
  for (const Beginning& each : all) {
    if (interrupted()) break;
    const Optimum found = search_from(each);
    if (!watch_.stopped()) count_start(found);
    if (!found.feasible || found.design.empty() || !(found.amplitude < least)) continue;
    least = found.amplitude;
    lower = found.design;
    led_on_from_none_ = found.status != Status::complete && !ended_near_;
  }
  if (lower.empty() || watch_.stopped()) return false;
  designs_.evaluate(lower, true);
  if (!std::isfinite(cases().value())) return false;
  note("the search reached " + space().text(here) +
       (within ? ", and continued from the lower " : ", where a limit is exceeded, and continued from ") +
       space().text(lower) + " found elsewhere");
  minimum_left_ = {best().value, result_.status, result_.stop};
  go_from(lower);  // a limit that is active may be exceeded there, by rounding
  return true;
}

std::vector<std::vector<double>> Search::lowest_elsewhere() {
  std::vector<Evaluation> found;
  std::vector<Evaluation> chosen{{best().design, best().value}};  // before one of them is that
  // Where all dampers slip easily or none does, too: no sample may be so near the bounds.
  std::vector<std::vector<double>> samples;
  for (const auto& bounds : {space().lower(), space().upper()})
    samples.emplace_back(bounds.begin(), bounds.end());
  for (int k = 0; k < space().samples(); ++k) samples.push_back(space().sample(k));
  for (const std::vector<double>& design : samples) {
    if (static_cast<int>(count()) >= options_.evaluations) break;
    if (!watch_.go_on()) return {};
    designs_.evaluate(design, true);
    if (std::isfinite(cases().value()) && designs_.formulation().excess() == 0)
      found.push_back({design, cases().value()});
  }
  std::sort(found.begin(), found.end(),
            [](const Evaluation& a, const Evaluation& b) { return a.amplitude < b.amplitude; });
  for (const Evaluation& each : found) {
    const bool near = std::any_of(chosen.begin(), chosen.end(), [&](const Evaluation& other) {
      return space().distance(each.design, other.design) < apart ||
             std::abs(each.amplitude / other.amplitude - 1) < same_idle_level;
    });
    if (!near && static_cast<int>(chosen.size()) < options_.starts) chosen.push_back(each);
  }
  std::vector<std::vector<double>> designs;
  for (std::size_t i = 1; i < chosen.size(); ++i) designs.push_back(chosen[i].design);
  return designs;
}

bool Search::passed_lower() {
  const std::vector<double> lower = std::exchange(result_.certificate->lower_design, {});
  if (lower.empty()) return false;
  const double value = best().value;
  const std::string left = space().text(best().design);
  designs_.evaluate(lower, true);
  if (best().excess > 0 || !(best().value < (1 - gain) * value)) return false;
  if (restarts_++ == most_restarts) {
    result_.status = Status::stopped;
    result_.stop.reason = reasons::lower_beside;
    result_.stop.message = text("next to each of ", most_restarts, " minima there was a lower design");
    return false;
  }
  go_from(lower);
  note("the search reached a minimum at " + left + ", and continued from the lower " + space().text(lower));
  return true;
}

void Search::describe() {
  if (result_.design == best().design && !result_.cases.empty()) return;
  result_.design = best().design;
  result_.amplitude = best().value;
  result_.feasible = best().excess == 0;
  result_.cases.clear();
  result_.certificate.reset();
  if (best().design.empty() || !std::isfinite(best().value)) return;
  double most = 0;
  for (std::size_t c = 0; c < best().cases.size(); ++c) {
    const auto& [state, problem] = best().cases[c];
    LoadCaseResult each = designs_.scenarios().result(designs_.scenario(c));
    each.amplitude = state.amplitude();
    each.point = cases().peaks(c).observe(state, problem);
    if (cases().weight(c) * each.amplitude > most) {
      most = cases().weight(c) * each.amplitude;
      result_.point = each.point;
    }
    result_.cases.push_back(std::move(each));
  }
  if (!cases().is_at(best().design)) {  // interrupted elsewhere
    for (std::size_t c = 0; c < result_.cases.size(); ++c)
      result_.cases[c].active =
          cases().groups() > 1 || cases().weight(c) * result_.cases[c].amplitude >= (1 - active_case) * most;
    return;
  }
  for (const ActivePeak& peak : balance_here(designs_).active) {
    result_.cases[peak.in_case].active = true;
    result_.cases[peak.in_case].multiplier += peak.multiplier;
  }
}

}  // namespace arcslip::optimize
