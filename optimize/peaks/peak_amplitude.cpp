#include <arcslip/optimize/peaks/peak_amplitude.hpp>

#include <arcslip/analyses/branches/unbounded_resonance.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/optimize/peaks/peak_follower.hpp>
#include <arcslip/optimize/peaks/peak_unknowns.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

namespace arcslip::optimize {
namespace {

using continuation::StopReason;

constexpr double at_limit = 1e-6;          // of mu F_n: a peak nearer to a stick limit sits at its corner
constexpr double small_difference = 1e-6;  // relative, of finite differences in the design
constexpr double same_instant = 0.3;       // rad: of one extreme at two designs, one after the other
constexpr double same_extreme = 1e-8;      // relative, of amplitude and gradient

}  // namespace

const char* name(PeakKind kind) {
  switch (kind) {
    case PeakKind::resonance:
      return "resonance";
    case PeakKind::corner:
      return "corner";
    case PeakKind::lower_end:
      return "lower_end";
    case PeakKind::upper_end:
      return "upper_end";
    case PeakKind::kink:
      return "kink";
  }
  return "";
}

observables::PointCondition held_by(PeakKind kind) {
  if (kind == PeakKind::resonance) return observables::PointCondition::extremum;
  return is_end(kind) ? observables::PointCondition::parameter : observables::PointCondition::corner;
}

double PeakState::amplitude() const {
  if (unbounded) return std::numeric_limits<double>::infinity();
  return peaks.empty() ? std::numeric_limits<double>::quiet_NaN() : peaks[highest].amplitude;
}

PeakAmplitude::PeakAmplitude(std::shared_ptr<const model::Model> model, std::vector<int> over,
                             const observables::FrequencyWindow& window, control::Control control,
                             MonitoredEvents watched)
    : model_(std::move(model)),
      over_(std::move(over)),
      window_(window),
      control_(std::move(control)),
      watched_(watched) {
  if (!model_->others.empty())
    throw OptionsError(
        continuation::text("the response is the largest of ", 1 + model_->others.size(),
                           " places, each of which needs a load case of its own (with_places())"));
  if (!control_.can_end()) return;
  auto with = std::make_shared<model::Model>(*model_);
  with->control = control_.child({.only_while = stoppable_});
  model_ = std::move(with);
}

PeakAmplitude::~PeakAmplitude() = default;

std::shared_ptr<const model::Model> PeakAmplitude::model_at(std::span<const double> design) const {
  auto with = std::make_shared<model::Model>(*model_);
  for (std::size_t k = 0; k < over_.size(); ++k)
    with->parameters[static_cast<std::size_t>(over_[k])].value = design[k];
  return with;
}

Vector PeakAmplitude::parameters(std::span<const double> design) const {
  Vector p = continuation::parameter_values(*problem_);
  for (std::size_t k = 0; k < over_.size(); ++k) p[over_[k]] = design[k];
  return p;
}

// Traces a response and locates all peaks, smooth ones as resonances and others as kinks.
PeakState PeakAmplitude::response(std::span<const double> design, observables::Steps steps) {
  const Stoppable stoppable(*this);
  PeakState found;
  found.design.assign(design.begin(), design.end());
  ++work_.responses;
  const auto model = model_at(design);
  if (const auto growth = observables::unbounded_resonance(model, window_.lower); growth.unbounded) {
    found.unbounded = true;
    found.message = growth.message;
    return found;
  }
  // Without an observer, which would require an evaluation at each point.
  const auto traced = observables::frequency_branch(model, window_, window_.lower, {}, 1, steps, control_);
  if (!control_.keep_going()) throw Interrupted();
  work_.factorizations += traced.branch.counts.factorizations;
  const auto& points = traced.branch.points;
  observables::PoleWatch watch(window_.lower, window_.upper);
  for (const continuation::Point& point : points)
    if (watch.is_next_to_pole(*traced.problem, hbm::parameters_at(*traced.problem, point.parameter),
                              point.u)) {
      found.unbounded = true;
      found.message = watch.growth().message;
      return found;
    }
  problem_ = traced.problem;
  const auto& stop = traced.branch.stop;
  found.complete = stop.reason == StopReason::boundary && stop.value == window_.upper;
  if (!found.complete) found.message = stop.message;
  if (points.empty()) return found;
  const auto place = [](const continuation::Point& point) {
    Vector x(point.u.size() + 1);
    x << point.u, point.parameter;
    return x;
  };
  found.peaks.push_back({PeakKind::lower_end, place(points.front())});
  for (const continuation::Event& event : traced.branch.events)
    if (event.monitor == observables::event_kinds::peak)
      found.peaks.push_back({event.nonsmooth ? PeakKind::kink : PeakKind::resonance, place(event.point)});
  if (found.complete) {
    found.upper_end = points.back().u;
    found.peaks.push_back({PeakKind::upper_end, place(points.back())});
  }
  return found;
}

// Identifies the corner of a nonsmooth peak, if it is an onset of slip.
void PeakAmplitude::classify(Peak& peak) {
  const Vector p = parameters(state_.design);
  for (const hbm::Corner& corner : hbm::corners_near(*problem_, peak.x.head(problem_->size()), p, at_limit)) {
    hbm::CornerSides sides(problem_, corner, observables::amplitude_quantity(problem_));
    if (!sides.slopes(hbm::with_angles(peak.x, corner), p).is_maximum()) continue;
    peak.kind = PeakKind::corner;
    peak.corner = corner;
    return;
  }
}

// Amplitude and gradient. False if the equations are singular.
bool PeakAmplitude::measure(Peak& peak, std::span<const double> design) {
  const Vector p = parameters(design);
  sensitivity_->hold(peak.instant);
  peak.gradient.resize(static_cast<Eigen::Index>(over_.size()));
  const bool done =
      peak.kind == PeakKind::resonance ? sensitivity_->at_resonance(peak.x, p, over_, peak.gradient)
      : peak.kind == PeakKind::corner ? sensitivity_->at_corner(*peak.corner, peak.x, p, over_, peak.gradient)
                                      : sensitivity_->at_frequency(peak.x, p, over_, peak.gradient);
  peak.amplitude = sensitivity_->amplitude();
  peak.slope = is_end(peak.kind) ? sensitivity_->multiplier() : 0;
  if (peak.instant) {
    const double theta = sensitivity_->extreme().theta;
    const double period = problem_->harmonics().odd ? std::numbers::pi : 2 * std::numbers::pi;
    const double moved = std::remainder(theta - *peak.instant, period);
    if (!(std::abs(moved) <= same_instant)) return false;  // it may be another one
    peak.instant = theta;
  }
  peak.piece = peak.kind == PeakKind::corner ? 0 : sensitivity_->piece();
  return done;
}

// The gradient and the displacement of a kink, from responses at neighbouring designs.
void PeakAmplitude::differences(Peak& peak, observables::Steps steps) {
  std::vector<double> design = state_.design;
  const auto problem = problem_;
  peak.along.resize(peak.x.size(), static_cast<Eigen::Index>(over_.size()));
  for (std::size_t k = 0; k < over_.size(); ++k) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double amplitude[2] = {none, none};
    Vector place[2] = {Vector::Constant(peak.x.size(), none), Vector::Constant(peak.x.size(), none)};
    const double h = small_difference * std::max(std::abs(design[k]), small_difference);
    for (const int side : {0, 1}) {
      design[k] = state_.design[k] + (side == 0 ? -h : h);
      const PeakState nearby = response(design, steps);
      double nearest = HUGE_VAL;
      for (const Peak& other : nearby.peaks) {
        if (is_end(other.kind) || !(std::abs(other.omega() - peak.omega()) < nearest)) continue;
        nearest = std::abs(other.omega() - peak.omega());
        observables::Sensitivity there(problem_);
        Vector unused(0);
        there.at_frequency(other.x, parameters(design), {}, unused);
        amplitude[side] = there.amplitude();
        place[side] = other.x;
      }
    }
    design[k] = state_.design[k];
    const auto column = static_cast<Eigen::Index>(k);
    peak.gradient[column] = (amplitude[1] - amplitude[0]) / (2 * h);
    peak.along.col(column) = (place[1] - place[0]) / (2 * h);
  }
  problem_ = problem;
}

// Adds the extrema of the motion at the ends of the window that may become the largest; one of those repeated
// by a motion with a shorter period.
void PeakAmplitude::add_extremes() {
  double most = 0;
  for (const Peak& peak : state_.peaks) most = std::max(most, peak.amplitude);
  std::vector<Peak> all;
  for (Peak& peak : state_.peaks) {
    std::vector<Peak> here{peak};
    if (is_end(peak.kind) && peak.amplitude >= watched_.kinks * most) {
      measure(peak, state_.design);
      const double own = sensitivity_->extreme().theta;
      for (const observables::Extreme& extreme : sensitivity_->extremes()) {
        if (extreme.amplitude < watched_.kinks * most || extreme.theta == own) continue;
        Peak further = peak;
        further.instant = extreme.theta;
        further.is_further = true;
        if (!measure(further, state_.design)) continue;
        const bool repeats = std::any_of(here.begin(), here.end(), [&](const Peak& other) {
          return std::abs(other.amplitude - further.amplitude) <= same_extreme * peak.amplitude &&
                 (other.gradient - further.gradient).norm() <= same_extreme * peak.gradient.norm();
        });
        if (!repeats) here.push_back(std::move(further));
      }
      if (here.size() > 1) here.front().instant = own;
      std::sort(here.begin(), here.end(), [](const Peak& a, const Peak& b) { return a.instant < b.instant; });
    }
    std::move(here.begin(), here.end(), std::back_inserter(all));
  }
  state_.peaks = std::move(all);
}

// Keeps the peaks that may be the highest.
void PeakAmplitude::watch() {
  auto& peaks = state_.peaks;
  double most = 0;
  for (const Peak& peak : peaks) most = std::max(most, peak.amplitude);
  const auto below = [&](const Peak& peak) {
    return peak.amplitude < (peak.kind == PeakKind::kink ? watched_.kinks : watched_.peaks) * most;
  };
  lower_.clear();
  for (const Peak& peak : peaks)
    if (below(peak)) lower_.push_back({peak.amplitude, peak.gradient});
  std::erase_if(peaks, below);
  const auto highest = std::max_element(
      peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) { return a.amplitude < b.amplitude; });
  state_.highest = static_cast<std::size_t>(highest - peaks.begin());
}

const PeakState& PeakAmplitude::trace(std::span<const double> design, observables::Steps steps) {
  PeakState found = response(design, steps);
  for (const auto& each : followers_)
    if (each) work_.factorizations += each->factorizations();
  followers_.clear();
  state_ = std::move(found);
  traced_ = state_.design;
  if (state_.peaks.empty()) return state_;
  sensitivity_ = std::make_unique<observables::Sensitivity>(problem_);
  section_ = std::make_unique<observables::CurveSection>(problem_, over_.front());
  for (Peak& peak : state_.peaks) {
    if (peak.kind == PeakKind::kink) classify(peak);
    measure(peak, state_.design);
  }
  add_extremes();
  watch();
  followers_.resize(state_.peaks.size());
  for (Peak& peak : state_.peaks)
    if (peak.kind == PeakKind::kink) differences(peak, steps);
  return state_;
}

observables::ResponsePoint PeakAmplitude::observe(
    const PeakState& state, const std::shared_ptr<const hbm::HbmProblem>& problem) const {
  Vector p = continuation::parameter_values(*problem);
  for (std::size_t k = 0; k < over_.size(); ++k) p[over_[k]] = state.design[k];
  const Peak& peak = state.peaks[state.highest];
  return observables::CurveSection(problem, over_.front()).observe(peak.x, p, held_by(peak.kind));
}

}  // namespace arcslip::optimize
