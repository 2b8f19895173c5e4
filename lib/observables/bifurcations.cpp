#include <arcslip/observables/bifurcations.hpp>

#include <arcslip/observables/event_kinds.hpp>
#include <arcslip/observables/phase_resonance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace arcslip::observables {
namespace {

using Complex = std::complex<double>;
using Multipliers = StabilityAnalysis::Multipliers;
using continuation::In;
using continuation::Out;

bool is_neimark_sacker(const std::string& kind) {
  return kind == event_kinds::neimark_sacker;
}

// A pair of conjugates, or of two real ones.
bool is_pair(const Complex& a, const Complex& b) {
  return a.imag() == -b.imag() && (a.imag() == 0 || a.real() == b.real());
}

template <class Each>
void for_pairs(const Multipliers& all, const Each& each) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      if (is_pair(all[i], all[j])) each(all[i], all[j]);
}

// The roots of z^2 - 2 kappa z + 1.
std::pair<Complex, Complex> roots(double kappa) {
  const Complex root = std::sqrt(Complex(kappa * kappa - 1));
  return {kappa + root, kappa - root};
}

double miss(const Complex& a, const Complex& b, const std::pair<Complex, Complex>& of) {
  return std::min(std::abs(a - of.first) + std::abs(b - of.second),
                  std::abs(a - of.second) + std::abs(b - of.first));
}

}  // namespace

const Multipliers& of_map(const StabilityAnalysis& found, const hbm::HbmProblem& problem) {
  return problem.harmonics().odd ? found.half_multipliers() : found.multipliers();
}

std::array<Complex, 2> nearest_two(const Multipliers& multipliers, double value) {
  std::array<Complex, 2> nearest{value + 1, value + 1};
  std::array<double, 2> distances{HUGE_VAL, HUGE_VAL};
  for (const Complex& each : multipliers) {
    const double distance = std::abs(each - value);
    if (!(distance < distances[1])) continue;
    const std::size_t i = distance < distances[0] ? 0 : 1;
    if (i == 0) {
      nearest[1] = nearest[0];
      distances[1] = distances[0];
    }
    nearest[i] = each;
    distances[i] = distance;
  }
  return nearest;
}

double at_minus_one(const Multipliers& multipliers) {
  const auto nearest = nearest_two(multipliers, -1);
  const auto beyond = std::count_if(multipliers.begin(), multipliers.end(),
                                    [](const Complex& each) { return each.imag() == 0 && each.real() < -1; });
  const double size = std::abs(1.0 + nearest[0]) * std::abs(1.0 + nearest[1]);
  return beyond % 2 == 0 ? size : -size;
}

std::optional<PairOfMultipliers> pair_near(const Multipliers& multipliers, double kappa) {
  const auto sought = roots(kappa);
  std::optional<PairOfMultipliers> found;
  double nearest = HUGE_VAL;
  for_pairs(multipliers, [&](const Complex& a, const Complex& b) {
    const double distance = miss(a, b, sought);
    if (!(distance < nearest)) return;
    nearest = distance;
    found = {(a + b).real(), (a * b).real()};
  });
  return found;
}

std::optional<double> kappa_of(const Multipliers& multipliers) {
  std::optional<double> kappa;
  double nearest = HUGE_VAL;
  for (const Complex& each : multipliers) {
    const double distance = std::abs(1 - std::abs(each));
    if (each.imag() == 0 || !(distance < nearest)) continue;
    nearest = distance;
    kappa = std::cos(std::arg(each));
  }
  return kappa;
}

continuation::TestFunctions test_functions(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                           const std::string& kind) {
  if (kind == event_kinds::phase_resonance)
    return {[problem]() -> continuation::TestFunction {
      return [problem](continuation::Evaluator& at, In u, In, In, Out g) {
        g[0] = cosine_of_phase(*problem, static_cast<const hbm::HbmEvaluator&>(at), u);
        return true;
      };
    }};
  const bool pair = is_neimark_sacker(kind);
  continuation::TestFunctions functions;
  if (pair) functions.scales = continuation::Vector::Ones(1);
  functions.make = [problem, pair]() -> continuation::TestFunction {
    const auto stability = std::make_shared<StabilityAnalysis>();
    const auto parameters = std::make_shared<continuation::Vector>();
    return [=](continuation::Evaluator& at, In, In p, In k, Out g) {
      *parameters = p;
      if (!stability->move_to(*problem, static_cast<const hbm::HbmEvaluator&>(at), *parameters)) return false;
      const Multipliers& found = of_map(*stability, *problem);
      if (!pair) {
        g[0] = at_minus_one(found);
        return !found.empty();
      }
      const auto nearest = pair_near(found, k[0]);
      if (nearest) g << nearest->sum - 2 * k[0], nearest->product - 1;
      return nearest.has_value();
    };
  };
  return functions;
}

void set_apart(const std::string& kind, bool half, double kappa, Stability& stability) {
  std::vector<Complex> own;
  if (is_neimark_sacker(kind)) {
    const auto [first, second] = roots(kappa);
    own = {half ? first * first : first, half ? second * second : second};
    const double turns = std::acos(std::clamp(kappa, -1.0, 1.0)) / (2 * std::numbers::pi);
    stability.rotation = half ? std::min(2 * turns, 1 - 2 * turns) : turns;
  } else {
    own.emplace_back(half ? 1.0 : -1.0);
  }
  Multipliers others = stability.multipliers;
  for (const Complex& value : own) {
    if (others.empty()) break;
    others.erase(std::min_element(others.begin(), others.end(), [&](const Complex& a, const Complex& b) {
      return std::abs(a - value) < std::abs(b - value);
    }));
  }
  stability.unstable = count_unstable(others);
}

}  // namespace arcslip::observables
