#include <arcslip/analyses/curves/bifurcations.hpp>

#include <arcslip/analyses/branches/phase_resonance.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace arcslip::observables {
namespace {

using Complex = std::complex<double>;
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
  const Complex pair = pair_nearest_circle(multipliers);
  if (pair == 0.0) return {};
  return std::cos(std::arg(pair));
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
  Multipliers own;
  if (is_neimark_sacker(kind)) {
    const auto [first, second] = roots(kappa);
    own = {half ? first * first : first, half ? second * second : second};
    const double turns = std::acos(std::clamp(kappa, -1.0, 1.0)) / (2 * std::numbers::pi);
    stability.rotation = half ? std::min(2 * turns, 1 - 2 * turns) : turns;
  } else {
    own.emplace_back(half ? 1.0 : -1.0);
  }
  stability.unstable = count_unstable(without(stability.multipliers, own));
}

}  // namespace arcslip::observables
