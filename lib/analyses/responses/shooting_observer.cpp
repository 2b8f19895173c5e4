#include <arcslip/analyses/responses/shooting_observer.hpp>

#include <arcslip/observables/patch_totals.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/stability/stability.hpp>
#include <arcslip/time/periodic/periodicity_conditions.hpp>

#include <cmath>
#include <numbers>
#include <span>
#include <string_view>

namespace arcslip::observables {
namespace {

using continuation::Accepted;

time::ShootingEvaluator& shooting_evaluator_of(const Accepted& now) {
  return static_cast<time::ShootingEvaluator&>(now.at);
}

ForceComponents without_forces() {
  constexpr PhaseParts none{no_value, no_value};
  return {no_value, no_value, no_value, none, none, none};
}

// Onsets and ends of slip of one element, rad.
void set_slip_angles(const time::EventDrivenMotion& motion, int element, double omega,
                     ElementResponse& response) {
  const auto is_slip = [](std::string_view mode) { return mode.starts_with("slip"); };
  for (const time::ContactEvent& event : motion.events) {
    if (event.element != element || is_slip(event.from) == is_slip(event.to)) continue;
    auto& angles = is_slip(event.to) ? response.slip_angles : response.reversal_angles;
    angles.push_back(std::fmod(omega * event.time, 2 * std::numbers::pi));
  }
}

}  // namespace

void ShootingObserver::add_elements(const time::EventDrivenMotion& motion,
                                    const time::EquationOfMotion& equation, ResponsePoint& point) const {
  const model::Model& model = problem_->model();
  std::size_t k = 0;
  for (std::size_t e = 0; e < equation.elements.size(); ++e) {
    const time::TimeElement& element = equation.elements[e];
    ElementResponse& response = point.elements.emplace_back();
    response.name = element.name;
    if (element.law->has_contact()) {
      const time::FrictionRecord& friction = motion.friction[k++];
      response.has_stick = true;
      response.stick_percent = 100 * friction.stick_time / motion.time;
      response.energy = friction.energy;
      response.has_normal_load = element.law->has_normal_load();
      response.open_percent = 100 * friction.open_time / motion.time;
      response.normal_load_max = friction.load_max;
      response.normal_load_min = friction.load_min;
      set_slip_angles(motion, static_cast<int>(e), equation.omega, response);
    }
    if (const double wear = model.elements[e].wear_coefficient; wear > 0)
      response.wear_rate = wear * response.energy / motion.time;
  }
  for (const model::Patch& patch : model.patches) {
    for (std::size_t i = 0; i < patch.areas.size(); ++i) point.elements[patch.first + i].of_patch = true;
    point.patches.push_back(total<ElementResponse>(
        patch, std::span<const ElementResponse>(point.elements).subspan(patch.first, patch.areas.size())));
    ElementResponse& sum = point.patches.back();
    sum.has_stick = point.elements[patch.first].has_stick;
    sum.normal_load_min = sum.normal_load_max = no_value;
  }
}

ResponsePoint ShootingObserver::observe(const Accepted& now) {
  time::ShootingEvaluator& at = shooting_evaluator_of(now);
  const time::EventDrivenMotion motion = at.motion();
  ResponsePoint point;
  point.omega = now.p[model::frequency];
  if (!is_over_frequency()) point.over = now.parameter;
  point.amplitude = motion.amplitude;
  point.phase = no_value;
  point.forces = without_forces();
  point.energy_friction = motion.energy.friction;
  point.energy_viscous = motion.energy.viscous;
  point.energy_input = motion.energy.input;
  add_elements(motion, at.equation(), point);
  if (stability_) {
    Stability& stability = point.stability.emplace();
    stability.multipliers = multipliers(now);
    stability.kept = stability_.multipliers;
    stability.unstable = count_unstable(stability.multipliers);
    stability.error = 0;
  }
  return point;
}

double ShootingObserver::amplitude_slope(const Accepted& now) {
  const time::Orbit& orbit = shooting_evaluator_of(now).orbit();
  amplitude_ = orbit.amplitude;
  const Eigen::Index n = now.u.size();
  return orbit.amplitude_by.head(n).dot(now.tangent.head(n)) +
         shooting_evaluator_of(now).amplitude_derivative(free_) * now.tangent[n];
}

const std::vector<std::complex<double>>& ShootingObserver::multipliers(const Accepted& now) {
  const time::PeriodMap& map = shooting_evaluator_of(now).orbit().map;
  if (monodromy_.size() == 0 || map.monodromy != monodromy_) {
    monodromy_ = map.monodromy;
    multipliers_ = time::multipliers_of(map);
  }
  return multipliers_;
}

std::vector<continuation::Monitor> shooting_monitors(const std::shared_ptr<ShootingObserver>& observer,
                                                     const StabilityRequest& watched) {
  using continuation::Crossing;
  const auto extreme = [&](const results::EventKind& kind, Crossing crossing) {
    return continuation::Monitor{
        kind, [observer](const Accepted& now) { return observer->amplitude_slope(now); }, crossing,
        [observer](const Accepted&) { return observer->last_amplitude(); }};
  };
  std::vector<continuation::Monitor> monitors;
  if (observer->is_over_frequency())
    monitors = {extreme(event_kinds::peak, Crossing::falling)};
  else
    monitors = {extreme(event_kinds::maximum, Crossing::falling),
                extreme(event_kinds::minimum, Crossing::rising)};
  monitors.push_back(continuation::fold_monitor());
  if (!watched) return monitors;
  observer->watch_stability(watched);
  for (auto& monitor :
       stability_monitors([observer](const Accepted& now) { return &observer->multipliers(now); }))
    monitors.push_back(std::move(monitor));
  monitors.push_back(continuation::branch_point_monitor());
  return monitors;
}

}  // namespace arcslip::observables
