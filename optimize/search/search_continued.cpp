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
  return_to_minimum();
  if (s_.result.status == Status::complete && interrupted()) return false;
  designs_.recall_best();
  if (s_.result.status != Status::complete || best().design.empty() || !std::isfinite(best().value))
    return false;
  if (best().excess > 0) return leave_infeasible();
  if (s_.result.stop.reason == reasons::flat || !move_to_best()) return false;
  if (const Balance left = balance_here(designs_); !is_stationary(left)) return refine(left);
  return look_elsewhere(true) || certify_best();
}

// If further searches from a minimum led to nothing, it is the result.
void Search::return_to_minimum() {
  if (s_.minimum_left && s_.result.status == Status::failed && best().value == s_.minimum_left->value &&
      s_.result.stop.reason != reasons::objective_failed) {
    s_.result.status = s_.minimum_left->status;
    s_.result.stop = s_.minimum_left->stop;
  }
  s_.minimum_left.reset();
}

// True if the search is to continue, from a feasible design or elsewhere.
bool Search::leave_infeasible() {
  if (find_feasible() || look_elsewhere(false)) return true;
  if (interrupted()) return false;
  s_.result.status = Status::stopped;
  s_.result.stop.reason = reasons::infeasible;
  s_.result.stop.message = "no feasible design was found: " + s_.result.stop.message;
  return false;
}

// True if the search is to continue, from a lower design that was seen.
bool Search::certify_best() {
  if (interrupted() || !options_.certificate || !move_to_best()) return false;
  designs_.begin("the certificate");
  describe();
  s_.result.certificate = certify(
      cases(), space().lower(), space().upper(), designs_.formulation().active(),
      [this] { return designs_.formulation().margin(); }, control_);
  return !interrupted() && passed_lower();
}

bool Search::move_to_best() {
  if (!cases().is_at(best().design)) cases().trace(best().design, observables::Steps::curve);
  return std::isfinite(cases().value());
}

void Search::go_from(const std::vector<double>& design) {
  s_.start = design;
  s_.stuck_value = HUGE_VAL;
  s_.refinements = 0;
  s_.algorithm = asked_;
}

bool Search::refine(const Balance& left) {
  if (s_.refinements < ladder.size() && best().value != s_.refined) {
    const std::size_t next = s_.refinements;
    note(text(s_.algorithm.name, " ended at ", space().text(best().design), " with residual gradient ",
              left.stationarity, "; ", ladder[next], " continued from there"));
    go_from(best().design);
    s_.refinements = next + 1;
    s_.algorithm = algorithm(ladder[next]);
    return true;
  }
  s_.refined = best().value;
  if (look_elsewhere(false)) return true;
  if (interrupted()) return false;
  s_.result.status = Status::stopped;
  s_.result.stop.reason = reasons::not_stationary;
  s_.result.stop.message = text("no algorithm reached a minimum: residual gradient ", left.stationarity,
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
  if (std::exchange(s_.sought_feasible, true)) return false;
  designs_.begin("the search for a feasible design");
  const std::string exceeds = space().text(best().design);
  for (int k = 0; k < space().attempts() + space().samples() && best().excess > 0; ++k) {
    if (!control_.keep_going()) return false;
    designs_.evaluate(k < space().attempts() ? space().attempt(k) : space().sample(k - space().attempts()),
                      true);
  }
  if (best().excess > 0) return false;
  go_from(best().design);
  note("the search reached " + exceeds + ", where a limit is exceeded, and continued from " +
       space().text(s_.start) + ", where none is");
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
  s_.ended_near.reset();
  std::exception_ptr thrown;
  const control::Control of_part = control_.child();
  options.progress = [&](OptimumProgress now) {
    now.evaluations += static_cast<int>(count() + designs_.elsewhere().size());
    now.best = std::min(now.best, best().value);
    now.phase = designs_.phase();
    try {
      if (options_.progress) options_.progress(now);
    } catch (...) {
      thrown = std::current_exception();
      of_part.stop();
    }
    if (!limited_ && !s_.ended_near) s_.ended_near = known_minimum(now.design, now.amplitude);
    if (s_.ended_near) of_part.stop();
  };
  options.control = of_part;
  Search part(there, problem_, options);
  part.is_part_ = true;
  Optimum found = part.run();
  if (thrown) std::rethrow_exception(thrown);
  designs_.elsewhere().insert(designs_.elsewhere().end(), found.evaluations.begin(), found.evaluations.end());
  add(found.work, s_.work_elsewhere);
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
  const auto found = std::find_if(s_.minima.begin(), s_.minima.end(), leads_to);
  if (found == s_.minima.end()) return {};
  return *found;
}

void Search::count_start(const Optimum& found) {
  if (s_.ended_near)
    s_.minima.push_back(*s_.ended_near);
  else if (found.status == Status::complete && found.feasible && !found.design.empty())
    s_.minima.push_back({found.design, found.amplitude});
  else
    ++s_.to_no_minimum;
}

void Search::count_starts() {
  if (s_.minima.empty() || !s_.result.feasible) return;
  Starts starts{.count = static_cast<int>(s_.minima.size()) + s_.to_no_minimum,
                .to_optimum = 0,
                .to_none = s_.to_no_minimum,
                .highest = s_.result.amplitude};
  for (const Evaluation& each : s_.minima) {
    starts.to_optimum += each.amplitude <= (1 + same_minimum) * s_.result.amplitude;
    starts.highest = std::max(starts.highest, each.amplitude);
  }
  if (starts.to_optimum == 0) {  // the search went on lower from where one of them ended
    starts.to_optimum = 1;
    if (s_.led_on_from_none) --starts.to_none;
  }
  s_.result.starts = starts;
}

bool Search::look_elsewhere(bool at_minimum) {
  if (!has_several_starts() || std::exchange(s_.sought_elsewhere, true)) return false;
  designs_.begin("the search elsewhere");
  const std::vector<double> here = best().design;
  const bool within = best().excess == 0;
  double least = within ? (1 - gain) * best().value : HUGE_VAL;
  if (at_minimum)
    s_.minima.push_back({here, best().value});
  else
    ++s_.to_no_minimum;
  const std::vector<Beginning> all = beginnings(within);
  std::vector<double> lower;
  if (within && best().value < least) {
    least = best().value;
    lower = best().design;
  }
  for (const Beginning& each : all) {
    if (interrupted()) break;
    const Optimum found = search_from(each);
    if (control_.keep_going()) count_start(found);
    if (!found.feasible || found.design.empty() || !(found.amplitude < least)) continue;
    least = found.amplitude;
    lower = found.design;
    s_.led_on_from_none = found.status != Status::complete && !s_.ended_near;
  }
  if (lower.empty() || !control_.keep_going()) return false;
  designs_.evaluate(lower, true);
  if (!std::isfinite(cases().value())) return false;
  note("the search reached " + space().text(here) +
       (within ? ", and continued from the lower " : ", where a limit is exceeded, and continued from ") +
       space().text(lower) + " found elsewhere");
  s_.minimum_left = {best().value, s_.result.status, s_.result.stop};
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
    if (!control_.keep_going()) return {};
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
  const std::vector<double> lower = std::exchange(s_.result.certificate->lower_design, {});
  if (lower.empty()) return false;
  const double value = best().value;
  const std::string left = space().text(best().design);
  designs_.evaluate(lower, true);
  if (best().excess > 0 || !(best().value < (1 - gain) * value)) return false;
  if (s_.restarts++ == most_restarts) {
    s_.result.status = Status::stopped;
    s_.result.stop.reason = reasons::lower_beside;
    s_.result.stop.message = text("next to each of ", most_restarts, " minima there was a lower design");
    return false;
  }
  go_from(lower);
  note("the search reached a minimum at " + left + ", and continued from the lower " + space().text(lower));
  return true;
}

void Search::describe() {
  if (s_.result.design == best().design && !s_.result.cases.empty()) return;
  s_.result.design = best().design;
  s_.result.amplitude = best().value;
  s_.result.feasible = best().excess == 0;
  s_.result.cases.clear();
  s_.result.certificate.reset();
  if (best().design.empty() || !std::isfinite(best().value)) return;
  double most = 0;
  for (std::size_t c = 0; c < best().cases.size(); ++c) {
    const auto& [state, problem] = best().cases[c];
    LoadCaseResult each = designs_.scenarios().result(designs_.scenario(c));
    each.amplitude = state.amplitude();
    each.point = cases().peaks(c).observe(state, problem);
    if (cases().weight(c) * each.amplitude > most) {
      most = cases().weight(c) * each.amplitude;
      s_.result.point = each.point;
    }
    s_.result.cases.push_back(std::move(each));
  }
  if (!cases().is_at(best().design)) {  // interrupted elsewhere
    for (std::size_t c = 0; c < s_.result.cases.size(); ++c)
      s_.result.cases[c].active = cases().groups() > 1 || cases().weight(c) * s_.result.cases[c].amplitude >=
                                                              (1 - active_case) * most;
    return;
  }
  for (const ActivePeak& peak : balance_here(designs_).active) {
    s_.result.cases[peak.in_case].active = true;
    s_.result.cases[peak.in_case].multiplier += peak.multiplier;
  }
}

}  // namespace arcslip::optimize
