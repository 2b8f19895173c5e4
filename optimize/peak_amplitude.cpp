#include <arcslip/optimize/peak_amplitude.hpp>

#include <arcslip/observables/unbounded.hpp>
#include <arcslip/optimize/follower.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::optimize {
namespace {

using continuation::StopReason;

constexpr double watched_kink = 0.9;    // as watched_share, where a peak cannot be followed at all
constexpr double risen = 0.9;           // of the highest amplitude: so high a lower peak is expected
constexpr double beyond_display = 1e6;  // |u| in scales: where it is asked whether the response is bounded
constexpr double at_limit = 1e-6;       // of mu F_n: a peak nearer to a stick limit sits at its corner
constexpr double longest_step = 0.5;    // relative change of a parameter in one step
constexpr double farthest = 1;     // relative change since the last response: beyond, peaks may have come up
constexpr int most_attempts = 12;  // of Newton's method from one design to the next
constexpr double off_tangent = 0.5;  // of a step: corrections beyond are jumps to another solution,
constexpr double similar = 0.1;      // unless they are below this, relative, of the unknowns
constexpr double near = 1e-3;        // and this, relative, of the frequency
constexpr double difference = 1e-5;  // of central differences, relative
constexpr double small_difference = 1e-6;

bool is_end(PeakKind kind) {
  return kind == PeakKind::lower_end || kind == PeakKind::upper_end;
}

bool by_ratio(double from, double to) {
  return from * to > 0;
}

double way(double from, double to) {
  return by_ratio(from, to) ? std::log(to / from) : (to - from) / std::max(std::abs(from), std::abs(to));
}

// From `from` at s = 0 to `to` at s = 1, by a constant ratio where both have one sign.
double on_way(double from, double to, double s) {
  return s == 1 ? to : by_ratio(from, to) ? from * std::exp(s * std::log(to / from)) : from + s * (to - from);
}

double slope_on_way(double from, double to, double s) {
  return by_ratio(from, to) ? on_way(from, to, s) * std::log(to / from) : to - from;
}

// u and omega, and at a corner the angles of its reversals: the unknowns of slip_corner_points().
Vector with_angles(const Vector& x, const hbm::SlipCorner& corner) {
  Vector all(x.size() + 2);
  all << x, corner.anchor, corner.reversal;
  return all;
}

// The unknowns of the equations of a peak.
Vector unknowns(const Peak& peak) {
  if (is_end(peak.kind)) return peak.x.head(peak.x.size() - 1);
  return peak.kind == PeakKind::corner ? with_angles(peak.x, *peak.corner) : peak.x;
}

void set_unknowns(Peak& peak, const Vector& all) {
  const Eigen::Index size = std::min(all.size(), peak.x.size());
  peak.x.head(size) = all.head(size);
  if (peak.kind != PeakKind::corner) return;
  peak.corner->anchor = all[size];
  peak.corner->reversal = all[size + 1];
}

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

double PeakState::amplitude() const {
  if (unbounded) return std::numeric_limits<double>::infinity();
  return peaks.empty() ? std::numeric_limits<double>::quiet_NaN() : peaks[highest].amplitude;
}

PeakAmplitude::PeakAmplitude(std::shared_ptr<const model::Model> model, std::vector<int> over,
                             const observables::FrequencyWindow& window)
    : model_(std::move(model)), over_(std::move(over)), window_(window) {}

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

// With the places of all peaks, smooth ones as resonances and others as kinks.
PeakState PeakAmplitude::response(std::span<const double> design) {
  PeakState found;
  found.design.assign(design.begin(), design.end());
  ++work_.responses;
  const auto model = model_at(design);
  if (const auto growth = observables::unbounded_resonance(model, window_.lower); growth.unbounded) {
    found.unbounded = true;
    found.message = growth.message;
    return found;
  }
  // Without an observer, which would have the equations evaluated at each point.
  const auto traced =
      observables::frequency_branch(model, window_, window_.lower, {}, 1, observables::Steps::events);
  work_.factorizations += traced.branch.counts.factorizations;
  const auto& points = traced.branch.points;
  bool asked = false;
  for (const continuation::Point& point : points) {
    const bool beyond = point.u.norm() > beyond_display * traced.problem->displacement();
    if (beyond && !asked) {
      const Vector p = hbm::parameters_at(*traced.problem, point.parameter);
      const auto growth = observables::unboundedness(*traced.problem, p, point.u);
      if (growth.unbounded) {
        found.unbounded = true;
        found.message = growth.message;
        return found;
      }
    }
    asked = beyond;
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
    if (event.monitor == "peak")
      found.peaks.push_back({event.nonsmooth ? PeakKind::kink : PeakKind::resonance, place(event.point)});
  if (found.complete) {
    found.upper_end = points.back().u;
    found.peaks.push_back({PeakKind::upper_end, place(points.back())});
  }
  return found;
}

// Whose corner a nonsmooth peak is, if it is one where an element begins to slip.
void PeakAmplitude::classify(Peak& peak) {
  const Vector p = parameters(state_.design);
  for (const hbm::SlipCorner& corner :
       hbm::slip_corners_near(*problem_, peak.x.head(problem_->size()), p, at_limit)) {
    hbm::CornerSides sides(problem_, corner, observables::amplitude_quantity(problem_));
    if (!sides.slopes(with_angles(peak.x, corner), p).is_maximum()) continue;
    peak.kind = PeakKind::corner;
    peak.corner = corner;
    return;
  }
}

// Amplitude and gradient. False where the equations are singular.
bool PeakAmplitude::measure(Peak& peak, std::span<const double> design) {
  const Vector p = parameters(design);
  peak.gradient.resize(static_cast<Eigen::Index>(over_.size()));
  const bool done =
      peak.kind == PeakKind::resonance ? sensitivity_->at_resonance(peak.x, p, over_, peak.gradient)
      : peak.kind == PeakKind::corner ? sensitivity_->at_corner(*peak.corner, peak.x, p, over_, peak.gradient)
                                      : sensitivity_->at_frequency(peak.x, p, over_, peak.gradient);
  peak.amplitude = sensitivity_->amplitude();
  peak.slope = is_end(peak.kind) ? sensitivity_->multiplier() : 0;
  peak.piece = peak.kind == PeakKind::corner ? 0 : sensitivity_->piece();
  return done;
}

// The gradient at a kink, from responses at neighbouring designs.
void PeakAmplitude::differences(Peak& peak) {
  std::vector<double> design = state_.design;
  const auto problem = problem_;
  for (std::size_t k = 0; k < over_.size(); ++k) {
    double amplitude[2] = {0, 0};
    const double h = small_difference * std::max(std::abs(design[k]), small_difference);
    for (const int side : {0, 1}) {
      design[k] = state_.design[k] + (side == 0 ? -h : h);
      const PeakState beside = response(design);
      double nearest = HUGE_VAL;
      for (const Peak& other : beside.peaks) {
        if (is_end(other.kind) || !(std::abs(other.omega() - peak.omega()) < nearest)) continue;
        nearest = std::abs(other.omega() - peak.omega());
        observables::Sensitivity there(problem_);
        Vector unused(0);
        there.at_frequency(other.x, parameters(design), {}, unused);
        amplitude[side] = there.amplitude();
      }
    }
    design[k] = state_.design[k];
    peak.gradient[static_cast<Eigen::Index>(k)] = (amplitude[1] - amplitude[0]) / (2 * h);
  }
  problem_ = problem;
}

// Keeps the peaks that may be the highest.
void PeakAmplitude::watch() {
  auto& peaks = state_.peaks;
  double most = 0;
  for (const Peak& peak : peaks) most = std::max(most, peak.amplitude);
  const auto below = [&](const Peak& peak) {
    return peak.amplitude < (peak.kind == PeakKind::kink ? watched_kink : watched_share) * most;
  };
  lower_.clear();
  for (const Peak& peak : peaks)
    if (below(peak)) lower_.push_back({peak.amplitude, peak.gradient});
  std::erase_if(peaks, below);
  const auto highest = std::max_element(
      peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) { return a.amplitude < b.amplitude; });
  state_.highest = static_cast<std::size_t>(highest - peaks.begin());
}

// Whether a peak that is not watched is expected to have come up at the design of the state: by its slopes at
// the last response, over the logarithms.
bool PeakAmplitude::came_up() const {
  return std::any_of(lower_.begin(), lower_.end(), [&](const LowerPeak& peak) {
    double level = 0;
    for (std::size_t k = 0; k < traced_.size(); ++k)
      level += peak.gradient[static_cast<Eigen::Index>(k)] / peak.amplitude * traced_[k] *
               way(traced_[k], state_.design[k]);
    return peak.amplitude * std::exp(level) > risen * state_.amplitude();
  });
}

const PeakState& PeakAmplitude::trace(std::span<const double> design) {
  for (const auto& each : followers_)
    if (each) work_.factorizations += each->factorizations();
  followers_.clear();
  state_ = response(design);
  traced_ = state_.design;
  if (state_.peaks.empty()) return state_;
  sensitivity_ = std::make_unique<observables::Sensitivity>(problem_);
  section_ = std::make_unique<observables::CurveSection>(problem_, over_.front());
  for (Peak& peak : state_.peaks) {
    if (peak.kind == PeakKind::kink) classify(peak);
    measure(peak, state_.design);
  }
  watch();
  for (Peak& peak : state_.peaks)
    if (peak.kind == PeakKind::kink) differences(peak);
  followers_.resize(state_.peaks.size());
  return state_;
}

const PeakState& PeakAmplitude::at(std::span<const double> design) {
  if (std::equal(design.begin(), design.end(), state_.design.begin(), state_.design.end())) return state_;
  double most = 0;
  for (std::size_t k = 0; k < traced_.size(); ++k)
    most = std::max(most, std::abs(way(traced_[k], design[k])));
  const bool kinks = std::any_of(state_.peaks.begin(), state_.peaks.end(),
                                 [](const Peak& peak) { return peak.kind == PeakKind::kink; });
  if (state_.peaks.empty() || kinks || !(most < farthest)) return trace(design);
  std::vector<Peak> moved = state_.peaks;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (!follow(i, design, moved[i])) return trace(design);
  state_.design.assign(design.begin(), design.end());
  state_.peaks = std::move(moved);
  ++work_.followed;
  for (std::size_t i = 0; i < state_.peaks.size(); ++i)
    if (state_.peaks[i].amplitude > state_.peaks[state_.highest].amplitude) state_.highest = i;
  return came_up() ? trace(design) : state_;
}

bool PeakAmplitude::follow_to(std::span<const double> design, std::span<const std::size_t> needed) {
  if (std::equal(design.begin(), design.end(), state_.design.begin(), state_.design.end())) return true;
  std::vector<Peak> moved = state_.peaks;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (moved[i].kind != PeakKind::kink && follow(i, design, moved[i])) continue;
    if (std::find(needed.begin(), needed.end(), i) != needed.end()) return false;
    moved[i].kind = PeakKind::kink;
  }
  state_.design.assign(design.begin(), design.end());
  state_.peaks = std::move(moved);
  ++work_.followed;
  for (std::size_t i = 0; i < state_.peaks.size(); ++i)
    if (state_.peaks[i].amplitude > state_.peaks[state_.highest].amplitude) state_.highest = i;
  return true;
}

Follower& PeakAmplitude::follower(std::size_t peak) {
  auto& made = followers_[peak];
  if (made) return *made;
  const Peak& of = state_.peaks[peak];
  Vector p = parameters(state_.design);
  std::shared_ptr<const continuation::Problem> equations = problem_;
  if (of.kind == PeakKind::resonance)
    equations = continuation::stationary_points(problem_, model::frequency,
                                                observables::amplitude_quantity(problem_));
  else if (of.kind == PeakKind::corner)
    equations = hbm::slip_corner_points(problem_, *of.corner);
  else
    p[model::frequency] = of.omega();
  made = std::make_unique<Follower>(equations, over_, p);
  return *made;
}

// Whether a solution of the peak's equations is a peak of that kind.
bool PeakAmplitude::holds(std::size_t peak, const Vector& x) {
  const Peak& of = state_.peaks[peak];
  if (is_end(of.kind)) return true;
  const double omega = x[problem_->size()];
  if (!(omega >= window_.lower && omega <= window_.upper)) return false;
  Follower& follower = *followers_[peak];
  if (of.kind == PeakKind::resonance) {
    const auto second = continuation::cusp_monitor().value;
    return second({x, x, x, 0, follower.at(), follower.factors(), omega}) < 0;
  }
  hbm::CornerSides sides(problem_, *of.corner, observables::amplitude_quantity(problem_));
  return sides.slopes(x, follower.parameters()).is_maximum();
}

bool PeakAmplitude::follow(std::size_t peak, std::span<const double> to, Peak& followed) {
  Follower& by = follower(peak);
  const std::vector<double>& from = state_.design;
  Vector here = unknowns(followed);
  const Eigen::Index n = problem_->size(), size = here.size();
  if (!by.is_at(here, from) && !by.linearize(here, from)) return false;
  double most = 0;
  for (std::size_t k = 0; k < to.size(); ++k) most = std::max(most, std::abs(way(from[k], to[k])));
  double done = 0, step = std::min(1.0, longest_step / most);
  std::vector<double> design(to.size());
  Vector direction, predicted, next;
  bool accepted = true;
  for (int attempt = 0; done < 1; ++attempt) {
    if (attempt == most_attempts) return false;
    if (accepted) {
      direction = Vector::Zero(size);
      for (std::size_t k = 0; k < to.size(); ++k)
        if (from[k] != to[k]) direction += slope_on_way(from[k], to[k], done) * by.tangent(k);
      if (!direction.allFinite()) return false;
    }
    const double until = done + step > 1 - near ? 1 : done + step;
    for (std::size_t k = 0; k < to.size(); ++k) design[k] = on_way(from[k], to[k], until);
    const Vector change = (until - done) * direction;
    predicted = here + change;
    next = predicted;
    accepted = by.correct(next, design) &&
               (next - predicted).head(n).norm() <=
                   off_tangent * change.head(n).norm() + similar * next.head(n).norm() &&
               (size == n ||
                std::abs(next[n] - predicted[n]) <= off_tangent * std::abs(change[n]) + near * next[n]) &&
               holds(peak, next);
    if (accepted) {
      here = next;
      done = until;
    } else {
      step /= 2;
    }
  }
  set_unknowns(followed, here);
  return measure(followed, to);
}

observables::ResponsePoint PeakAmplitude::observe(const Vector& x, std::span<const double> design) {
  return section_->observe(x, parameters(design));
}

continuation::Matrix PeakAmplitude::tangents(std::size_t peak) {
  const Peak& of = state_.peaks[peak];
  if (of.kind == PeakKind::kink) return {};
  Follower& by = follower(peak);
  const Vector here = unknowns(of);
  if (!by.is_at(here, state_.design) && !by.linearize(here, state_.design)) return {};
  continuation::Matrix all = continuation::Matrix::Zero(of.x.size(), static_cast<Eigen::Index>(over_.size()));
  const Eigen::Index size = std::min(here.size(), of.x.size());
  for (std::size_t k = 0; k < over_.size(); ++k)
    all.col(static_cast<Eigen::Index>(k)).head(size) = by.tangent(k).head(size);
  if (!all.allFinite()) return {};
  return all;
}

continuation::Matrix PeakAmplitude::hessian(std::size_t peak) {
  const continuation::Matrix along = tangents(peak);
  Peak of = state_.peaks[peak];
  continuation::Matrix second(along.cols(), along.cols());
  if (along.size() == 0 || !measure(of, state_.design) || !sensitivity_->second_derivatives(along, second))
    return {};
  return second;
}

double PeakAmplitude::change(std::size_t peak, std::size_t k, const Observable& observable) {
  const Peak& of = state_.peaks[peak];
  const continuation::Matrix along = tangents(peak);
  if (along.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> design = state_.design;
  const double h = difference * std::max(std::abs(design[k]), difference);
  double value[2];
  for (const int side : {0, 1}) {
    const Vector x = of.x + (side == 0 ? -h : h) * along.col(static_cast<Eigen::Index>(k));
    design[k] = state_.design[k] + (side == 0 ? -h : h);
    value[side] = observable(observe(x, design));
  }
  return (value[1] - value[0]) / (2 * h);
}

}  // namespace arcslip::optimize
