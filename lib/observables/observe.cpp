#include <arcslip/observables/observe.hpp>

#include <arcslip/observables/energies.hpp>
#include <arcslip/observables/patch_totals.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>
#include <utility>

namespace arcslip::observables {
namespace {

// Of the motion of the elements: a response below is their rounding, as where symmetry holds it at 0.
constexpr double at_rest = 1e-13;

// Up to so many the truncation estimate is cheap.
constexpr int few_blocks = 16;

const hbm::HbmEvaluator& hbm_evaluator_of(const continuation::Accepted& now) {
  return static_cast<const hbm::HbmEvaluator&>(now.at);
}

}  // namespace

Observer::Observer(std::shared_ptr<const hbm::HbmProblem> problem, int free)
    : problem_(std::move(problem)),
      free_(free),
      amplitude_(problem_->harmonics()),
      stops_(problem_->model()),
      x_(problem_->harmonics().size()),
      dx_(x_.size()),
      by_parameter_(x_.size()) {
  const Eigen::MatrixXd& P = problem_->coordinates().P;
  std::size_t count = 0;
  for (const auto& response : problem_->model().named_responses) count += response.places.size();
  named_.resize(static_cast<Eigen::Index>(count), P.cols());
  Eigen::Index row = 0;
  for (const auto& response : problem_->model().named_responses)
    for (const auto& place : response.places) named_.row(row++) = place.transpose() * P;
}

Extreme Observer::extreme(const hbm::HbmEvaluator& at, continuation::In u) {
  return last_ = amplitude_.of(at, u, x_);
}

double Observer::amplitude_change(const hbm::HbmEvaluator& at, continuation::In u, continuation::In du,
                                  std::initializer_list<std::pair<int, double>> dp) {
  const Extreme at_most = extreme(at, u);
  at.stiffness().response(du, 0, dx_, at_most.place);
  for (const auto& [k, change] : dp) {
    at.stiffness().response_derivative(k, u, at.force_factor(), by_parameter_, at_most.place);
    dx_ += change * by_parameter_;
  }
  return observables::amplitude_change(problem_->harmonics(), at_most, dx_);
}

double Observer::amplitude_slope(const continuation::Accepted& now) {
  const Eigen::Index n = now.u.size();
  const double slope =
      amplitude_change(hbm_evaluator_of(now), now.u, now.tangent.head(n), {{free_, now.tangent[n]}});
  if (last_.amplitude > at_rest * now.u.norm()) return slope;
  last_ = {};
  return 0;
}

// Lag of the fundamental of x behind the first excitation of that harmonic, in (-pi, pi].
double Observer::phase(continuation::In p, continuation::In x) const {
  const auto& h = problem_->harmonics();
  const auto& model = problem_->model();
  const int n = h.excited(model.force_harmonic);
  if (!h.has(n) || n == 0) return 0;
  const std::complex<double> X(x[h.cosine_index(n)], -x[h.sine_index(n)]);
  for (const auto& excitation : model.excitation) {
    if (excitation.harmonic != model.force_harmonic) continue;
    const std::complex<double> F = excitation.amplitude(p);
    return X == 0.0 || F == 0.0 ? 0 : std::arg(F * std::conj(X));
  }
  return 0;
}

void Observer::add_named_responses(const hbm::HbmEvaluator& at, continuation::In u, continuation::In p,
                                   ResponsePoint& point) {
  if (named_.rows() == 0) return;
  Eigen::MatrixXd motions = at.stiffness().motion(named_, u, at.force_factor());
  const auto& responses = problem_->model().named_responses;
  named_motions_.resize(motions.rows(), static_cast<Eigen::Index>(responses.size()));
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    NamedResponse& named = point.responses.emplace_back();
    named.amplitude = -1;
    auto largest = named_motions_.col(static_cast<Eigen::Index>(i));
    for (const model::Direction& place : responses[i].places) {
      auto x = motions.col(column++);
      if (responses[i].absolute) at.stiffness().add_base(place, at.force_factor(), x);
      const double amplitude = amplitude_.of(x).amplitude;
      if (!(amplitude > named.amplitude)) continue;
      named.amplitude = amplitude;
      largest = x;
    }
    named.phase = phase(p, largest);
    named.rms = elements::root_mean_square(problem_->harmonics(), largest);
  }
}

const StabilityAnalysis* Observer::stability(const continuation::Accepted& now) {
  if (!stability_) return nullptr;
  if (stable_u_.size() != now.u.size() || stable_u_ != now.u || stable_p_ != now.p) {
    stable_u_ = now.u;
    stable_p_ = now.p;
    stability_known_ = stability_->move_to(*problem_, hbm_evaluator_of(now), stable_p_);
  }
  return stability_known_ ? &*stability_ : nullptr;
}

void Observer::add_stability(const continuation::Accepted& now, ResponsePoint& point) {
  const StabilityAnalysis* found = stability(now);
  if (!found) return;
  Stability& stability = point.stability.emplace();
  stability.multipliers = found->multipliers();
  stability.kept = kept_multipliers_;
  stability.unstable = count_unstable(stability.multipliers);
  const double modal_error = stability_->modal_error();
  if (truncation_->is_exact()) {
    stability.error = modal_error;
    return;
  }
  stable_u_.resize(0);
  const auto& elements = problem_->model().elements;
  const bool contacts =
      std::any_of(elements.begin(), elements.end(), [](const auto& e) { return e.law->reports_contact(); });
  const auto refined = [&](Truncation::Reach reach) -> const Multipliers* {
    const auto motion = truncation_->refined(now, reach, contacts);
    if (!motion) return nullptr;
    const bool known = motion->at ? stability_->move_to(motion->problem, *motion->at, motion->p)
                                  : stability_->move_to(motion->problem, motion->u, motion->p);
    return known ? &stability_->multipliers() : nullptr;
  };
  const Multipliers* all = refined(Truncation::Reach::all);
  if (!all) return;
  const Multipliers by_all = *all;
  stability.error = modal_error + distance(stability.multipliers, by_all);
  if (const Multipliers* by_half = refined(Truncation::Reach::half))
    stability.error += distance(by_all, *by_half);
}

// From the motion that the harmonics left out make of it. Where they move a peak along the branch, its share
// of stick is next to stationary.
void Observer::estimate_stick(const continuation::Accepted& now, ResponsePoint& point) {
  const auto refined =
      truncation_->is_exact() ? std::nullopt : truncation_->refined(now, Truncation::Reach::all, true);
  elements::FrictionState state;
  for (std::size_t e = 0; e < point.elements.size(); ++e) {
    ElementResponse& element = point.elements[e];
    if (!element.has_stick) continue;
    if (truncation_->is_exact())
      element.stick_estimate = 0;
    else if (refined && refined->at->element(e).friction(state))
      element.stick_estimate = std::abs(100 * state.stick_share - element.stick_percent);
  }
  const auto& patches = problem_->model().patches;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < patches[k].areas.size(); ++i) {
      sum += patches[k].areas[i] * point.elements[patches[k].first + i].stick_estimate;
      area += patches[k].areas[i];
    }
    point.patches[k].stick_estimate = sum / area;
  }
}

void Observer::estimate_truncation(const continuation::Accepted& now, PointCondition held,
                                   ResponsePoint& point) {
  if (!truncation_) truncation_ = std::make_unique<Truncation>(*problem_, free_, now.p);
  const TruncationEstimate truncation = truncation_->estimate(now, last_, held);
  point.truncation_estimate = truncation.amplitude;
  point.truncation_change = truncation.change;
  point.location_estimate = truncation.location;
  point.location_change = truncation.location_change;
  point.truncation_flagged = truncation.flagged || !point.stops.empty();
}

ResponsePoint Observer::observe(const continuation::Accepted& now, PointCondition held,
                                const Observed& asked) {
  spaced_.restart();
  return observe_as(now, held, asked);
}

void Observer::observe_next(const continuation::Accepted& now, const Observed& asked,
                            std::vector<ResponsePoint>& points) {
  const bool spaced =
      asked.estimates && problem_->blocks() > few_blocks && !stability_ && !problem_->model().settings.chosen;
  Observed next = asked;
  if (spaced) next.estimates = spaced_.is_due(now.arclength, now.parameter);
  ResponsePoint point = observe_as(now, PointCondition::parameter, next);
  if (spaced && !next.estimates)
    spaced_.pass(now.arclength, point);
  else if (spaced)
    spaced_.take(now.arclength, now.parameter, point, points);
  points.push_back(std::move(point));
}

ResponsePoint Observer::observe_as(const continuation::Accepted& now, PointCondition held,
                                   const Observed& asked) {
  const auto& at = hbm_evaluator_of(now);
  ResponsePoint point;
  add_solution(at, now.u, now.p, point);
  if (asked.motion) add_motion(at, now.u, now.p, point);
  const bool estimated = asked.estimates || stability_;
  if (estimated) estimate_truncation(now, held, point);
  if (stability_) add_stability(now, point);
  if (asked.motion) {
    point.phase = phase(now.p, x_);
    point.energy_input = input_energy(*problem_, at, now.u);
    point.forces = force_components(*problem_, at, x_);
  }
  if (asked.maxima) add_maxima(at, point);
  if (asked.maxima && estimated) estimate_stick(now, point);
  return point;
}

void Observer::add_maxima(const hbm::HbmEvaluator& at, ResponsePoint& point) {
  if (!maxima_) maxima_ = std::make_unique<Maxima>(*problem_);
  maxima_->add_to(point, at, x_);
  for (std::size_t i = 0; i < point.responses.size(); ++i) {
    NamedResponse& named = point.responses[i];
    std::tie(named.velocity, named.acceleration) =
        maxima_->of(named_motions_.col(static_cast<Eigen::Index>(i)), at.stiffness().base_frequency());
  }
}

ResponsePoint Observer::motion(const hbm::HbmEvaluator& at, continuation::In u,
                               const continuation::Vector& p) {
  ResponsePoint point;
  add_solution(at, u, p, point);
  add_motion(at, u, p, point);
  return point;
}

void Observer::add_solution(const hbm::HbmEvaluator& at, continuation::In u, const continuation::Vector& p,
                            Solution& solution) {
  solution.amplitude = extreme(at, u).amplitude;
  solution.omega = p[model::frequency];
  solution.unknowns.assign(u.data(), u.data() + u.size());
  const auto& h = problem_->harmonics();
  solution.order = h.order;
  solution.coefficients.reserve(static_cast<std::size_t>(2 * h.cosines()));
  for (int i = 0; i < h.cosines(); ++i) {
    const int n = h.cosine_order(i);
    solution.coefficients.push_back(x_[i]);
    solution.coefficients.push_back(n == 0 ? 0.0 : x_[h.sine_index(n)]);
  }
  for (std::size_t e = 0; e < at.element_count(); ++e)
    if (stops_.at_reversals(at.element(e), e, p)) solution.stops = problem_->model().elements[e].name;
}

void Observer::add_motion(const hbm::HbmEvaluator& at, continuation::In u, const continuation::Vector& p,
                          ResponsePoint& point) {
  point.rms = elements::root_mean_square(problem_->harmonics(), x_);
  add_named_responses(at, u, p, point);
  point.energy_viscous = at.stiffness().viscous_energy(u, at.force_factor());
  point.elements.reserve(at.element_count());
  for (std::size_t e = 0; e < at.element_count(); ++e) {
    point.elements.push_back(element(at, e));
    if (problem_->model().elements[e].law->dissipative()) point.energy_friction += point.elements[e].energy;
  }
  add_patches(*problem_, at, p, point);
}

ElementResponse Observer::element(const hbm::HbmEvaluator& at, std::size_t e) {
  const auto& h = problem_->harmonics();
  const model::NonlinearPart& part = problem_->model().elements[e];
  const elements::Law& law = *part.law;
  ElementResponse response;
  response.name = part.name;
  elements::FrictionState state;
  state.mean_min = state.mean_max = no_value;
  response.has_stick = at.element(e).friction(state);
  const bool sticks = response.has_stick && state.stick_share == 1;
  if (law.dissipative() && !sticks)
    response.energy =
        element_energy(h, at.element_motion(e), at.element(e).force().head(law.directions() * h.size()));
  if (part.wear_coefficient > 0)
    response.wear_rate =
        part.wear_coefficient * response.energy * at.stiffness().base_frequency() / (2 * std::numbers::pi);
  at.element(e).contact(response.contact);
  elements::put_in_order(response.contact);
  if (response.has_stick) {
    response.stick_percent = 100 * state.stick_share;
    response.has_normal_load = law.has_normal_load();
    response.open_percent = 100 * state.open_share;
    response.normal_load_max = state.load_max;
    response.normal_load_min = state.load_min;
    response.mean_force_min = state.mean_min;
    response.mean_force_max = state.mean_max;
    response.slip_angles = std::move(state.slip_onsets);
    response.reversal_angles = std::move(state.slip_ends);
    set_contact_angles(h, at.element_motion(e), response);
  }
  set_fundamental(*problem_, at, e, response);
  return response;
}

continuation::Monitor peak_monitor(std::shared_ptr<Observer> observer) {
  continuation::Monitor monitor{
      event_kinds::peak,
      [observer](const continuation::Accepted& now) { return observer->amplitude_slope(now); },
      continuation::Crossing::falling,
      [observer](const continuation::Accepted&) { return observer->last_amplitude(); }};
  // Sampled friction has a kink wherever a sample begins or ceases to slip.
  monitor.divides_at_kinks = observer->problem().model().settings.friction == scene::Friction::exact;
  if (monitor.divides_at_kinks)
    monitor.part = [observer](const continuation::Accepted&) { return observer->last_part(); };
  return monitor;
}

std::vector<continuation::Monitor> stability_monitors(const std::shared_ptr<Observer>& observer) {
  const auto multipliers = [&](auto of) -> MultipliersAt {
    return [=](const continuation::Accepted& now) {
      const StabilityAnalysis* found = observer->stability(now);
      return found ? &(found->*of)() : nullptr;
    };
  };
  if (!observer->problem().harmonics().odd)
    return stability_monitors(multipliers(&StabilityAnalysis::multipliers));
  return stability_monitors(multipliers(&StabilityAnalysis::multipliers),
                            multipliers(&StabilityAnalysis::half_multipliers));
}

}  // namespace arcslip::observables
