#include <arcslip/observables/stability.hpp>

#include <arcslip/observables/event_kinds.hpp>
#include <arcslip/observables/observe.hpp>
#include <arcslip/time/event_driven.hpp>
#include <arcslip/time/from_harmonics.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::observables {
namespace {

using Complex = std::complex<double>;
using Multipliers = StabilityAnalysis::Multipliers;
using continuation::Accepted;

constexpr int most_dofs = 100;
constexpr double neutral = 1e-10;   // |mu| above 1 by less is rounding
constexpr double rounding = 1e-11;  // of the products, where the structure is undamped
constexpr double on_circle = 1e-4;  // at a zero; otherwise the product jumps
constexpr double real = 1e-9;       // |imaginary part| of a real multiplier
constexpr double jump = 1e-5;       // of the largest modulus across 1
constexpr double same = 1e-7;       // place of two events, relative

bool same_but_frequency(const continuation::Vector& a, const continuation::Vector& b) {
  if (a.size() != b.size()) return false;
  for (Eigen::Index k = 0; k < a.size(); ++k)
    if (k != model::frequency && a[k] != b[k]) return false;
  return true;
}

}  // namespace

bool StabilityAnalysis::move_to(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at,
                                const continuation::Vector& p) {
  if (!same_but_frequency(p, p_)) {
    p_ = p;
    floquet_.reset();
    hill_.reset();
    const int dofs = problem.model().dofs;
    if (dofs > most_dofs) {
      unknown_ = "the structure has " + std::to_string(dofs) + " degrees of freedom, and at most " +
                 std::to_string(most_dofs) + " are supported";
      return false;
    }
    try {
      const auto equation = time::equation_of_motion(problem.model(), p);
      if (by_hill_)
        hill_.emplace(equation);
      else
        floquet_.emplace(equation);
    } catch (const time::NoVariation& without) {
      unknown_ = without.what();
    } catch (const time::SingularMass& without) {
      unknown_ = without.what();
    } catch (const time::NotInTime& without) {
      unknown_ = without.what();
    }
  }
  if (!floquet_ && !hill_) return false;
  time::courses_of(problem, at, courses_);
  const double omega = problem.harmonics().base_frequency(p[model::frequency]);
  const bool found = hill_ ? hill_->compute(omega, problem.harmonics(), courses_)
                           : floquet_->compute(omega, problem.harmonics(), courses_);
  if (!found)
    unknown_ =
        "at some of its points multipliers were not found, as where a law is very stiff along the motion";
  return found;
}

int count_unstable(const Multipliers& multipliers) {
  return static_cast<int>(std::count_if(multipliers.begin(), multipliers.end(),
                                        [](const Complex& each) { return std::abs(each) > 1 + neutral; }));
}

double distance(const Multipliers& multipliers, const Multipliers& others) {
  double largest = 0;
  for (const Complex& each : multipliers) {
    double nearest = std::abs(each);  // of those that the others lack, 0
    for (const Complex& other : others) nearest = std::min(nearest, std::abs(each - other));
    largest = std::max(largest, nearest);
  }
  return largest;
}

namespace {

// Positive where it is rounding, as along an undamped structure.
double beyond_rounding(double value) {
  return std::abs(value) < rounding ? rounding : value;
}

double one_plus(const Multipliers& multipliers) {
  Complex product = 1;
  for (const Complex& each : multipliers) product *= 1.0 + each;
  return beyond_rounding(product.real());
}

double one_minus_pairs(const Multipliers& multipliers) {
  Complex product = 1;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) product *= 1.0 - multipliers[i] * multipliers[j];
  return beyond_rounding(product.real());
}

bool has_minus_one(const Multipliers& multipliers) {
  return std::any_of(multipliers.begin(), multipliers.end(),
                     [](const Complex& each) { return std::abs(1.0 + each) < on_circle; });
}

bool is_complex(const Complex& multiplier) {
  return std::abs(multiplier.imag()) > real * std::abs(multiplier);
}

bool has_pair_on_circle(const Multipliers& multipliers) {
  return std::any_of(multipliers.begin(), multipliers.end(), [](const Complex& each) {
    return is_complex(each) && std::abs(1 - std::abs(each)) < on_circle;
  });
}

}  // namespace

std::vector<continuation::Monitor> stability_monitors(const MultipliersAt& of_period,
                                                      const MultipliersAt& of_half_period) {
  const auto monitor = [](const char* kind, const MultipliersAt& at, auto value, auto is_event) {
    continuation::Monitor each;
    each.name = kind;
    // 1 where the multipliers are not known.
    each.value = [=](const Accepted& now) {
      const Multipliers* found = at(now);
      return found ? value(*found) : 1.0;
    };
    each.is_event = [=](const Accepted& now) {
      const Multipliers* found = at(now);
      return found && is_event(*found);
    };
    return each;
  };
  std::vector<continuation::Monitor> monitors{
      monitor(event_kinds::neimark_sacker, of_period, one_minus_pairs, has_pair_on_circle),
      monitor(
          event_kinds::stability_lost, of_period,
          [](const Multipliers& all) { return all.empty() ? 1 : beyond_rounding(1 - std::abs(all.front())); },
          [](const Multipliers& all) { return !all.empty() && std::abs(1 - std::abs(all.front())) > jump; })};
  if (of_half_period)
    monitors.push_back(monitor(event_kinds::symmetry_breaking, of_half_period, one_plus, has_minus_one));
  else
    monitors.push_back(monitor(event_kinds::period_doubling, of_period, one_plus, has_minus_one));
  return monitors;
}

std::vector<continuation::Monitor> stability_monitors(const std::shared_ptr<Observer>& observer) {
  const auto multipliers = [&](auto of) -> MultipliersAt {
    return [=](const Accepted& now) {
      const StabilityAnalysis* found = observer->stability(now);
      return found ? &(found->*of)() : nullptr;
    };
  };
  if (!observer->problem().harmonics().odd)
    return stability_monitors(multipliers(&StabilityAnalysis::multipliers));
  return stability_monitors(multipliers(&StabilityAnalysis::multipliers),
                            multipliers(&StabilityAnalysis::half_multipliers));
}

double rotation_number(const Multipliers& multipliers) {
  const Complex* nearest = nullptr;
  for (const Complex& each : multipliers)
    if (is_complex(each) && (!nearest || std::abs(1 - std::abs(each)) < std::abs(1 - std::abs(*nearest))))
      nearest = &each;
  return nearest ? std::abs(std::arg(*nearest)) / (2 * std::numbers::pi) : no_value;
}

void set_rotation(ResponseEvent& event) {
  if (event.kind == event_kinds::neimark_sacker && event.point.stability)
    event.point.stability->rotation = rotation_number(event.point.stability->multipliers);
}

void drop_told_losses(std::vector<ResponseEvent>& events) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= same * std::abs(a); };
  std::erase_if(events, [&](const ResponseEvent& lost) {
    return lost.kind == event_kinds::stability_lost &&
           std::any_of(events.begin(), events.end(), [&](const ResponseEvent& other) {
             return other.kind != event_kinds::stability_lost && other.kind != event_kinds::peak &&
                    near(lost.point.omega, other.point.omega) && near(lost.point.over, other.point.over) &&
                    near(lost.point.amplitude, other.point.amplitude);
           });
  });
}

}  // namespace arcslip::observables
