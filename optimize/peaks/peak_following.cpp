// Tracking of the peaks from one design to another.

#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/optimize/peaks/peak_follower.hpp>
#include <arcslip/optimize/peaks/peak_unknowns.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double risen = 1.2;         // times the share that is watched: so high a lower peak is expected
constexpr double longest_step = 0.5;  // relative change of a parameter in one step
constexpr double farthest = 1;     // relative change since the last response: beyond, peaks may have come up
constexpr int most_attempts = 12;  // of Newton's method from one design to the next
constexpr double off_tangent = 0.5;  // of a step: corrections beyond are jumps to another solution,
constexpr double similar = 0.1;      // unless they are below this, relative, of the unknowns
constexpr double near = 1e-3;        // and this, relative, of the frequency
constexpr double difference = 1e-5;  // of central differences, relative

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

}  // namespace

// Whether a new peak is expected at the design of the state, by logarithmic extrapolation of the unwatched
// peaks from the last response.
bool PeakAmplitude::new_peak_expected() const {
  return std::any_of(lower_.begin(), lower_.end(), [&](const LowerPeak& peak) {
    double level = 0;
    for (std::size_t k = 0; k < traced_.size(); ++k)
      level += peak.gradient[static_cast<Eigen::Index>(k)] / peak.amplitude * traced_[k] *
               way(traced_[k], state_.design[k]);
    return peak.amplitude * std::exp(level) > risen * watched_.peaks * state_.amplitude();
  });
}

const PeakState& PeakAmplitude::at(std::span<const double> design) {
  if (std::equal(design.begin(), design.end(), state_.design.begin(), state_.design.end())) return state_;
  const Stoppable stoppable(*this);
  double most = 0;
  for (std::size_t k = 0; k < traced_.size(); ++k)
    most = std::max(most, std::abs(way(traced_[k], design[k])));
  const bool kinks = std::any_of(state_.peaks.begin(), state_.peaks.end(),
                                 [](const Peak& peak) { return peak.kind == PeakKind::kink; });
  if (state_.peaks.empty() || kinks || !(most < farthest)) return trace(design);
  std::vector<Peak> moved = state_.peaks;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (!follow(i, design, moved[i])) return trace(design);
  move_to(design, std::move(moved));
  return new_peak_expected() ? trace(design) : state_;
}

void PeakAmplitude::move_to(std::span<const double> design, std::vector<Peak>&& tracked) {
  state_.design.assign(design.begin(), design.end());
  state_.traced = false;
  state_.peaks = std::move(tracked);
  ++work_.followed;
  for (std::size_t i = 0; i < state_.peaks.size(); ++i)
    if (state_.peaks[i].amplitude > state_.peaks[state_.highest].amplitude) state_.highest = i;
}

bool PeakAmplitude::follow_to(std::span<const double> design, std::span<const std::size_t> needed) {
  if (std::equal(design.begin(), design.end(), state_.design.begin(), state_.design.end())) return true;
  const Stoppable stoppable(*this);
  std::vector<Peak> moved = state_.peaks;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (moved[i].kind != PeakKind::kink && follow(i, design, moved[i])) continue;
    if (std::find(needed.begin(), needed.end(), i) != needed.end()) return false;
    moved[i].kind = PeakKind::kink;
  }
  move_to(design, std::move(moved));
  return true;
}

PeakFollower& PeakAmplitude::follower(std::size_t peak) {
  auto& made = followers_[peak];
  if (made) return *made;
  const Peak& of = state_.peaks[peak];
  Vector p = parameters(state_.design);
  std::shared_ptr<const continuation::Problem> equations = problem_;
  if (of.kind == PeakKind::resonance)
    equations = continuation::stationary_points(problem_, model::frequency,
                                                observables::amplitude_quantity(problem_));
  else if (of.kind == PeakKind::corner)
    equations = hbm::corner_points(problem_, *of.corner);
  else
    p[model::frequency] = of.omega();
  made = std::make_unique<PeakFollower>(equations, over_, p);
  return *made;
}

// Whether a solution of the peak's equations is a peak of that kind.
bool PeakAmplitude::holds(std::size_t peak, const Vector& x) {
  const Peak& of = state_.peaks[peak];
  if (is_end(of.kind)) return true;
  const double omega = x[problem_->size()];
  if (!(omega >= window_.lower && omega <= window_.upper)) return false;
  PeakFollower& follower = *followers_[peak];
  if (of.kind == PeakKind::resonance) {
    const auto second = continuation::cusp_monitor().value;
    continuation::Scratch none;
    return second({x, x, x, 0, follower.at(), follower.factors(), omega, none}) < 0;
  }
  hbm::CornerSides sides(problem_, *of.corner, observables::amplitude_quantity(problem_));
  return sides.slopes(x, follower.parameters()).is_maximum();
}

bool PeakAmplitude::follow(std::size_t peak, std::span<const double> to, Peak& followed) {
  PeakFollower& by = follower(peak);
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

observables::ResponsePoint PeakAmplitude::observe(const Vector& x, PeakKind kind,
                                                  std::span<const double> design,
                                                  const observables::Observed& asked) {
  return section_->observe(x, parameters(design), held_by(kind), asked);
}

continuation::Matrix PeakAmplitude::tangents(std::size_t peak) {
  const Peak& of = state_.peaks[peak];
  if (of.kind == PeakKind::kink) return {};
  PeakFollower& by = follower(peak);
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

double PeakAmplitude::change(std::size_t peak, std::size_t k, const Observable& observable,
                             const observables::Observed& read) {
  const Peak& of = state_.peaks[peak];
  const continuation::Matrix along = of.kind == PeakKind::kink ? of.along : tangents(peak);
  if (along.size() == 0 || !along.col(static_cast<Eigen::Index>(k)).allFinite())
    return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> design = state_.design;
  const double h = difference * std::max(std::abs(design[k]), difference);
  double value[2];
  for (const int side : {0, 1}) {
    const Vector x = of.x + (side == 0 ? -h : h) * along.col(static_cast<Eigen::Index>(k));
    design[k] = state_.design[k] + (side == 0 ? -h : h);
    value[side] = observable(observe(x, of.kind, design, read));
  }
  return (value[1] - value[0]) / (2 * h);
}

}  // namespace arcslip::optimize
