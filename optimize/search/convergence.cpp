#include <arcslip/optimize/search/convergence.hpp>

#include <arcslip/optimize/certificate/certificate.hpp>

#include <cmath>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double as_good = 1e-13;               // relative: values that differ by rounding
constexpr double as_good_within_limits = 1e-7;  // the same, and by what the tolerance of a limit gains
constexpr double settled_share = 0.1;           // of the tolerances of a minimum: where a refinement ends
constexpr int most_idle_calls = 100;            // calls at known designs, one after the other
constexpr std::size_t patience = 25;            // evaluations without a gain, for each parameter and one more

}  // namespace

Balance balance_here(DesignEvaluations& designs) {
  const DesignSpace& space = designs.space();
  return balance(designs.cases(), space.lower(), space.upper(), designs.formulation().active());
}

Convergence::Convergence(DesignEvaluations& designs, const Settings& settings)
    : designs_(designs),
      settings_(settings),
      known_(count()),
      gained_(count()),
      gained_value_(designs.best().value),
      gained_excess_(designs.best().excess) {}

Convergence::Ends Convergence::test() {
  const Best& best = designs_.best();
  idle_ = count() > known_ ? 0 : idle_ + 1;
  known_ = count();
  if (settings_.smooth && gradient_vanishes()) {
    designs_.call_best();
    return Ends::vanishes;
  }
  const bool within = best.excess == 0;
  if (best.excess < (1 - gain_outside) * gained_excess_ ||
      (within && best.value < (1 - gain) * gained_value_)) {
    gained_excess_ = best.excess;
    gained_value_ = best.value;
    gained_ = count();
  }
  const bool settled = (settings_.limited || settings_.refinement) && !settings_.smooth && is_settled();
  if (settled && settings_.refinement) return Ends::settles;
  const bool in_vain =
      settings_.limited && !settings_.global && count() - gained_ > patience * (1 + settings_.parameters);
  return idle_ == most_idle_calls || in_vain ? Ends::idles : Ends::no;
}

bool Convergence::is_settled() {
  const Best& best = designs_.best();
  const double value = designs_.cases().value();
  if (!std::isfinite(value) || value > (1 + as_good_within_limits) * best.value || best.excess > 0 ||
      designs_.formulation().excess() > 0)
    return false;
  Balance left = balance_here(designs_);
  if (candidate_.design.empty() || left.stationarity < candidate_.left.stationarity)
    candidate_ = {designs_.cases().state(0).design, std::move(left)};
  return candidate_.left.stationarity <= settled_share * most_stationarity &&
         candidate_.left.complementarity <= settled_share * most_complementarity;
}

void Convergence::take_candidate() {
  if (candidate_.design.empty() || !is_stationary(candidate_.left)) return;
  LoadCases& cases = designs_.cases();
  cases.at(candidate_.design);
  if (cases.value() <= (1 + as_good_within_limits) * designs_.best().value &&
      designs_.formulation().excess() == 0)
    designs_.call_best();
}

// Only at a design as good as the best so far: a worse stationary point does not end the run.
bool Convergence::gradient_vanishes() {
  LoadCases& cases = designs_.cases();
  const DesignSpace& space = designs_.space();
  const double value = cases.value();
  if (!std::isfinite(value) || value > (1 + as_good) * designs_.best().value) return false;
  for (std::size_t c = 0; c < cases.size(); ++c)
    if (cases.state(c).peaks.size() > 1) return false;
  const std::vector<double>& design = cases.state(0).design;
  const Vector gradient = cases.gradient();
  for (std::size_t k = 0; k < design.size(); ++k) {
    const double slope = gradient[static_cast<Eigen::Index>(k)] / value * space.slope(k, design[k]);
    const bool held =
        (design[k] == space.lower()[k] && slope > 0) || (design[k] == space.upper()[k] && slope < 0);
    if (!held && std::abs(slope) > small_gradient) return false;
  }
  return true;
}

}  // namespace arcslip::optimize
