#include <arcslip/stability/stability.hpp>

#include <arcslip/results/event_kinds.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace arcslip::observables {
namespace {

using Complex = std::complex<double>;
using continuation::Accepted;

constexpr int most_dofs_in_full = 100;   // more are replaced by low modes
constexpr int modes_kept = 50;           // of more
constexpr double on_circle = 1e-4;       // at a zero; otherwise the multipliers jump
constexpr double beyond_estimate = 5;    // an error of a multiplier, over its estimate
constexpr double modulus_jump = 1e-5;    // of the largest modulus across 1
constexpr double steep_share = 0.5;      // of a change, not made by the slope next to it: more is a jump
constexpr std::size_t most_kept = 1000;  // places

// Whether the structure is the same with both parameters: the frequency moves it where a rotor turns with it.
bool same_structure(const model::Model& model, const continuation::Vector& a, const continuation::Vector& b) {
  if (a.size() != b.size()) return false;
  const bool turns = std::any_of(model.matrices.begin(), model.matrices.end(),
                                 [](const auto& part) { return part.number.depends_on(model::frequency); });
  for (Eigen::Index k = 0; k < a.size(); ++k)
    if ((k != model::frequency || turns) && a[k] != b[k]) return false;
  return true;
}

bool may_leave_modes_out(const model::Model& model, const time::EquationOfMotion& equation) {
  return model::is_symmetric(model) && std::all_of(equation.elements.begin(), equation.elements.end(),
                                                   [](const time::TimeElement& element) {
                                                     return element.law->automata(element.fields).has_value();
                                                   });
}

}  // namespace

bool StabilityAnalysis::move_to(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at,
                                const continuation::Vector& p) {
  if (!prepare(problem, p)) return false;
  time::courses_of(problem, at, courses_);
  return compute(problem, p);
}

bool StabilityAnalysis::move_to(const hbm::HbmProblem& problem, continuation::In u,
                                const continuation::Vector& p) {
  if (!prepare(problem, p)) return false;
  time::courses_of(problem, u, courses_);
  return compute(problem, p);
}

bool StabilityAnalysis::prepare(const hbm::HbmProblem& problem, const continuation::Vector& p) {
  const model::Model& model = problem.model();
  if (same_structure(model, p, p_)) return floquet_ || hill_;
  p_ = p;
  hill_.reset();
  try {
    const auto equation = time::equation_of_motion(model, p);
    if (equation.dofs() > most_dofs_in_full)
      go_to_large(model, equation);
    else if (by_hill_)
      hill_.emplace(equation);
    else if (floquet_)
      floquet_->move_to(equation);
    else
      floquet_.emplace(equation);
    return true;
  } catch (const time::NoVariation& without) {
    unknown_ = without.what();
  } catch (const time::SingularMass& without) {
    unknown_ = without.what();
  } catch (const time::NotInTime& without) {
    unknown_ = without.what();
  }
  floquet_.reset();
  coarse_.reset();
  return false;
}

// On its low modes, which both analyses share; their decompositions take long.
void StabilityAnalysis::go_to_large(const model::Model& model, const time::EquationOfMotion& equation) {
  if (by_hill_ || !may_leave_modes_out(model, equation))
    throw time::NoVariation("the structure has " + std::to_string(model.dofs) +
                            " degrees of freedom, and at most " + std::to_string(most_dofs_in_full) +
                            " are supported by Hill's method, with unsymmetric matrices or with laws that "
                            "are not piecewise linear");
  if (floquet_ && floquet_->has_matrices_of(equation)) {
    floquet_->move_to(equation);
    coarse_->move_to(equation);
  } else {
    const bool stopped = !model.control.keep_going();
    const auto modes = stopped ? nullptr : time::natural_modes(equation, model.control);
    if (!modes) throw time::NoVariation("their computation was stopped");
    floquet_.emplace(equation, time::ModesKept{.most = modes_kept}, modes);
    coarse_.emplace(equation, time::ModesKept{.most = modes_kept / 2}, modes);
  }
}

bool StabilityAnalysis::compute(const hbm::HbmProblem& problem, const continuation::Vector& p) {
  omega_ = problem.harmonics().base_frequency(p[model::frequency]);
  harmonics_ = problem.harmonics();
  const bool found = hill_ ? hill_->compute(omega_, *harmonics_, courses_)
                           : floquet_->compute(omega_, *harmonics_, courses_);
  if (!found)
    unknown_ =
        "at some of its points multipliers were not found, as where a law is very stiff along the motion";
  return found;
}

double StabilityAnalysis::modal_error() {
  if (!coarse_) return 0;
  if (!coarse_->compute(omega_, *harmonics_, courses_)) return no_value;
  return distance(coarse_->multipliers(), multipliers());
}

const Multipliers& of_map(const StabilityAnalysis& found, const hbm::HbmProblem& problem) {
  return problem.harmonics().odd ? found.half_multipliers() : found.multipliers();
}

namespace {

// Positive where it is rounding, as along an undamped structure.
double beyond_rounding(double value) {
  return std::abs(value) < multiplier_rounding ? multiplier_rounding : value;
}

double near_minus_one(const Multipliers& multipliers) {
  return beyond_rounding(at_minus_one(multipliers));
}

bool has_minus_one(const Multipliers& multipliers) {
  return std::any_of(multipliers.begin(), multipliers.end(),
                     [](const Complex& each) { return std::abs(1.0 + each) < on_circle; });
}

bool has_pair_on_circle(const Multipliers& multipliers) {
  return std::abs(1 - std::abs(pair_nearest_circle(multipliers))) < on_circle;
}

// Positive: stable, as where there are none.
double margin(const Multipliers& multipliers) {
  return multipliers.empty() ? 1 : beyond_rounding(1 - std::abs(multipliers.front()));
}

// The places of a trace that were looked at for a loss of stability.
class Places {
 public:
  void add(const Accepted& now, const Multipliers& multipliers) {
    if (all_.size() > most_kept) all_.erase(all_.begin());
    const double margin_here = margin(multipliers);
    all_[now.arclength] = {margin_here, now.tangent[now.u.size()] > 0, count_unstable(multipliers)};
  }

  // Whether the change from stable to unstable, or back, next to a place is one that a fold and the
  // multipliers on the circle there explain.
  bool is_explained(double arclength, const Multipliers& multipliers) const {
    const auto here = all_.find(arclength);
    if (here == all_.end()) return false;
    const auto at = other_side(here);
    if (at == all_.end()) return false;
    const Place& other = at->second;
    const int change = std::abs(here->second.unstable - other.unstable);
    const bool fold = here->second.forward != other.forward;
    return (change == 1 && (fold || has_minus_one(multipliers))) ||
           (change == 2 && has_pair_on_circle(multipliers));
  }

  // Whether the largest modulus goes across 1 there without a jump, however steeply: next to grazing it
  // grows like a root, and no place is so near that it is 1. The other side is then where the slope on this
  // side leads.
  bool is_steep(double arclength) const {
    const auto here = all_.find(arclength);
    if (here == all_.end()) return false;
    const auto other = other_side(here);
    if (other == all_.end()) return false;
    const double ahead = other->first - arclength;
    auto nearby = here;
    const auto is_near = [&] { return std::abs(nearby->first - arclength) < std::abs(ahead); };
    while (is_near()) {
      if (nearby == (ahead > 0 ? all_.begin() : std::prev(all_.end()))) return false;
      nearby = ahead > 0 ? std::prev(nearby) : std::next(nearby);
      if (nearby->second.stable() != here->second.stable()) return false;
    }
    const double slope = (here->second.margin - nearby->second.margin) / (arclength - nearby->first);
    const double change = other->second.margin - here->second.margin;
    return std::abs(change - slope * ahead) < steep_share * std::abs(change);
  }

 private:
  struct Place {
    double margin;
    bool forward;  // in the free parameter
    int unstable;
    bool stable() const { return margin > 0; }
  };
  using All = std::map<double, Place>;  // by arclength

  // The nearest place on the other side of the change; none: the end.
  All::const_iterator other_side(All::const_iterator here) const {
    const bool is = here->second.stable();
    auto before = here, beyond = std::next(here);
    while (before != all_.begin() && before->second.stable() == is) --before;
    while (beyond != all_.end() && beyond->second.stable() == is) ++beyond;
    const bool is_beyond =
        beyond != all_.end() &&
        (before->second.stable() == is || beyond->first - here->first < here->first - before->first);
    if (is_beyond) return beyond;
    return before->second.stable() == is ? all_.end() : before;
  }

  All all_;
};

}  // namespace

std::vector<continuation::Monitor> stability_monitors(const MultipliersAt& of_period,
                                                      const MultipliersAt& of_half_period) {
  const auto monitor = [](const results::EventKind& kind, const MultipliersAt& at, auto value,
                          auto is_event) {
    continuation::Monitor each;
    each.name = kind;
    // 1 where the multipliers are not known.
    each.value = [=](const Accepted& now) {
      const Multipliers* found = at(now);
      return found ? value(now, *found) : 1.0;
    };
    each.is_event = [=](const Accepted& now) {
      const Multipliers* found = at(now);
      return found && is_event(now, *found);
    };
    return each;
  };
  const MultipliersAt of_map = of_half_period ? of_half_period : of_period;
  const auto of_all = [&](const results::EventKind& kind, double (*value)(const Multipliers&),
                          bool (*is_event)(const Multipliers&)) {
    return monitor(
        kind, of_map, [=](const Accepted&, const Multipliers& all) { return value(all); },
        [=](const Accepted&, const Multipliers& all) { return is_event(all); });
  };
  return {of_all(event_kinds::neimark_sacker, at_unit_modulus, has_pair_on_circle),
          monitor(
              event_kinds::stability_lost, of_period,
              [](const Accepted& now, const Multipliers& all) {
                now.scratch.get<Places>().add(now, all);
                return margin(all);
              },
              [of_map](const Accepted& now, const Multipliers& all) {
                if (all.empty() || !(std::abs(1 - std::abs(all.front())) > modulus_jump)) return false;
                const Multipliers* map = of_map(now);
                const Places& places = now.scratch.get<Places>();
                const bool is_one =
                    all.front().imag() == 0 && all.front().real() > 0;  // reported by its fold
                return !(map && places.is_explained(now.arclength, *map)) &&
                       !(is_one && places.is_steep(now.arclength));
              }),
          of_all(of_half_period ? event_kinds::symmetry_breaking : event_kinds::period_doubling,
                 near_minus_one, has_minus_one)};
}

void set_apart(const std::string& kind, ResponsePoint& point) {
  if (!point.stability) return;
  Stability& stability = *point.stability;
  Multipliers own;
  if (kind == event_kinds::neimark_sacker) {
    const Complex pair = pair_nearest_circle(stability.multipliers);
    stability.rotation = rotation_number(stability.multipliers);
    own = {pair, std::conj(pair)};
  } else if (kind == event_kinds::period_doubling) {
    own = {-1.0};
  } else if (kind == event_kinds::fold || kind == event_kinds::branch_point ||
             kind == event_kinds::symmetry_breaking) {
    own = {1.0};
  }
  const double apart = std::fmax(on_circle, beyond_estimate * stability.error);
  const auto near = [&](const Complex& value) {
    return std::abs(nearest_two(stability.multipliers, value)[0] - value) < apart;
  };
  if (std::all_of(own.begin(), own.end(), near))
    stability.unstable = count_unstable(without(stability.multipliers, own));
}

void estimate_bifurcations(ResponseBranch& branch) {
  const auto place = [&](const ResponsePoint& point) {
    return branch.over.empty() ? point.omega : point.over;
  };
  // Its distance from the circle, along the real axis or in modulus.
  const auto distance_of = [](const std::string& kind, const Multipliers& multipliers) {
    if (kind == event_kinds::neimark_sacker) return std::abs(pair_nearest_circle(multipliers)) - 1;
    const double at = kind == event_kinds::period_doubling ? -1 : 1;
    return std::real(nearest_two(multipliers, at)[0]) - at;
  };
  for (ResponseEvent& event : branch.events) {
    if (event.after + 1 >= branch.points.size() || !event.point.stability) continue;
    if (!event_kinds::contains(event_kinds::of_curves, event.kind)) continue;
    const ResponsePoint &before = branch.points[event.after], &beyond = branch.points[event.after + 1];
    if (!before.stability || !beyond.stability) continue;
    const double change = distance_of(event.kind, beyond.stability->multipliers) -
                          distance_of(event.kind, before.stability->multipliers);
    const double estimate = event.point.stability->error * std::abs((place(beyond) - place(before)) / change);
    if (std::isfinite(estimate)) event.point.location_estimate = estimate;
  }
}

}  // namespace arcslip::observables
