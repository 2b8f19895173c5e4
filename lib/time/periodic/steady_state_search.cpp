#include <arcslip/time/periodic/steady_state_search.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

namespace arcslip::time {
namespace {

constexpr long first_trial = 2;                        // periods; the next ones at twice as many
constexpr int trial_newton_steps = 8, most_maps = 12;  // of a trial
constexpr double neutral_growth = 1e-6;                // |multiplier| above 1 by less: not unstable
constexpr double decaying = 1e-10;                     // below 1 by more
constexpr double near_unstable = 1e-3;                 // an unstable motion, relative: it is being left
constexpr double on_unstable = 1e-6;                   // an unstable motion: it has to be left
constexpr double disturbance = 1e-6;                   // relative
constexpr double same_state = 1e-7;                    // states, relative
constexpr int most_doublings = 60;

Vector scaled(const MotionState& state, double omega) {
  Vector y(state.x.size() + state.v.size() + state.z.size());
  y << state.x, state.v / omega, state.z;
  return y;
}

MotionState unscaled(const Vector& y, Eigen::Index n, double omega) {
  return {y.head(n), y.segment(n, n) * omega, y.tail(y.size() - 2 * n)};
}

// A periodic motion that Newton's method found.
struct Found {
  MotionState state;
  std::vector<std::complex<double>> multipliers;
  Matrix M;                        // in (x, v/omega, z), of the coordinates below
  std::vector<Eigen::Index> kept;  // all but sliders that rest throughout
  double largest() const { return multipliers.empty() ? 0 : std::abs(multipliers.front()); }
};

// Whether the motion that goes from X* + before to X* + after is on its way into X*.
bool is_attracted(const Found& to, const Vector& before, const Vector& after) {
  if (to.largest() >= 1 - decaying) return false;
  const double r = std::sqrt(std::max(to.largest(), 0.01));
  const Vector d = before(to.kept), rest = after(to.kept) - to.M * d;
  Matrix A = to.M / r, P = Matrix::Identity(A.rows(), A.cols());
  for (int k = 0; k < most_doublings; ++k) {
    const Matrix more = A.transpose() * P * A;
    P += more;
    if (!P.allFinite()) return false;
    if (more.norm() < 1e-12 * P.norm()) break;
    A = (A * A).eval();
  }
  return std::sqrt(rest.dot(P * rest)) <= 0.5 * (1 - r) * std::sqrt(d.dot(P * d));
}

class Settling {
 public:
  Settling(const Periods& integrate, const Flow& flow, const MotionState& start, double omega,
           const SettleOptions& options, const std::function<bool(long, double)>& progress)
      : integrate_(integrate), flow_(flow), omega_(omega), options_(options), progress_(progress) {
    result_.state = start;
    last_.push_front(start);
  }

  Settled run() {
    long next = first_trial;
    while (result_.periods < options_.periods) {
      if (!advance()) return std::move(result_);
      const int repeats = repeated();
      if (result_.periods == next || repeats > 0) {
        if (result_.periods == next) next *= 2;
        if (settles(repeats)) return std::move(result_);
        if (failed_) return std::move(result_);
      }
      if (progress_ && !progress_(result_.periods, result_.change)) {
        result_.reason = SettleEnd::user;
        return std::move(result_);
      }
    }
    result_.amplitude = late_amplitude_;
    return std::move(result_);
  }

 private:
  bool advance() {
    PeriodMotion period = integrate_(result_.state, 1, false);
    if (!period.done()) return fail(period);
    ++result_.periods;
    result_.change = change_of(result_.state, period.end, omega_);
    result_.state = period.end;
    if (2 * result_.periods > options_.periods) late_amplitude_ = std::max(late_amplitude_, period.amplitude);
    last_.push_front(std::move(period.end));
    if (last_.size() > static_cast<std::size_t>(options_.longest) + 1) last_.pop_back();
    return true;
  }

  bool fail(const PeriodMotion& period) {
    result_.reason = SettleEnd::failed;
    result_.failure = period.failure;
    result_.message = period.message;
    failed_ = true;
    return false;
  }

  double change(int m) const { return change_of(last_[static_cast<std::size_t>(m)], last_[0], omega_); }

  int known() const { return static_cast<int>(last_.size()) - 1; }  // periods

  // The smallest m after which the last state is the same; 0: none.
  int repeated() const {
    for (int m = 1; m <= known(); ++m)
      if (change(m) <= options_.tolerance) return m;
    return 0;
  }

  // A period that the motion may have, next to 1.
  int likely() const {
    int best = 1;
    for (int m = 2; m <= known(); ++m)
      if (change(m) < 0.5 * change(best)) best = m;
    return best;
  }

  bool settles(int repeats) {
    std::vector<int> candidates{1};
    const int other = repeats > 0 ? repeats : likely();
    if (other > 1) candidates.push_back(other);
    for (const int m : candidates) {
      std::optional<Found> found = periodic(result_.state, m);
      if (!found) continue;
      const Vector to = scaled(found->state, omega_);
      const Vector after = scaled(last_[0], omega_) - to;
      const Vector before = scaled(last_[static_cast<std::size_t>(m)], omega_) - to;
      const double size = std::max(to.norm(), 1e-300);
      if (found->largest() > 1 + neutral_growth) {
        if (after.norm() > near_unstable * size) continue;
        if (after.norm() <= on_unstable * size) disturb(*found);
        return false;
      }
      const bool there = std::max(before.norm(), after.norm()) <= options_.tolerance * size;
      if (there || is_attracted(*found, before, after)) return take(*found, m);
    }
    if (repeats == 0) return false;
    return end(repeats);
  }

  std::optional<Found> periodic(const MotionState& start, int m) {
    int maps = 0;
    const Flow flow = [&, map = keeping_places(flow_, m)](const MotionState& from) {
      return ++maps <= most_maps ? map(from) : PeriodMap();
    };
    ShootingOptions options;
    options.transients = 0;
    options.iterations = trial_newton_steps;
    options.tolerance = std::min(options_.tolerance, 1e-6);
    ShootingResult shot = shoot(flow, start, omega_, options);
    if (!shot.converged()) return std::nullopt;
    Found found{std::move(shot.start), std::move(shot.multipliers), {}, {}};
    const Eigen::Index n = start.x.size(), size = shot.map.monodromy.rows();
    for (Eigen::Index i = 0; i < size; ++i)
      if (std::none_of(shot.map.resting.begin(), shot.map.resting.end(),
                       [&](const RestingSlider& slider) { return 2 * n + slider.slider == i; }))
        found.kept.push_back(i);
    Vector scale = Vector::Ones(size);
    scale.segment(n, n).setConstant(omega_);
    const Matrix M = scale.cwiseInverse().asDiagonal() * shot.map.monodromy * scale.asDiagonal();
    found.M = M(found.kept, found.kept);
    return found;
  }

  // Along the fastest growth.
  void disturb(const Found& from) {
    const continuation::Modes modes = continuation::modes(from.M);
    if (modes.values.size() == 0) return;
    Eigen::Index largest = 0;
    modes.values.cwiseAbs().maxCoeff(&largest);
    Vector along = modes.V.col(largest).real();
    if (const Vector other = modes.V.col(largest).imag(); other.norm() > along.norm()) along = other;
    Vector y = scaled(result_.state, omega_);
    const double size = y.norm();
    for (std::size_t i = 0; i < from.kept.size(); ++i)
      y[from.kept[i]] += disturbance * size / along.norm() * along[static_cast<Eigen::Index>(i)];
    result_.state = unscaled(y, result_.state.x.size(), omega_);
    last_.assign(1, result_.state);
  }

  // With its least period.
  bool take(Found& found, int m) {
    MotionState state = found.state;
    for (int d = 1; 2 * d <= m; ++d) {
      PeriodMotion period = integrate_(state, 1, false);
      if (!period.done()) return fail(period);
      state = std::move(period.end);
      if (m % d != 0 || change_of(found.state, state, omega_) > same_state) continue;
      if (std::optional<Found> shorter = periodic(found.state, d)) {
        found = std::move(*shorter);
        m = d;
        break;
      }
    }
    result_.state = found.state;
    result_.multipliers = std::move(found.multipliers);
    return end(m);
  }

  bool end(int m) {
    const PeriodMotion motion = integrate_(result_.state, m, false);
    if (!motion.done()) return fail(motion);
    result_.reason = SettleEnd::settled;
    result_.period = m;
    result_.amplitude = motion.amplitude;
    result_.change = change_of(result_.state, motion.end, omega_);
    return true;
  }

  const Periods& integrate_;
  const Flow& flow_;
  double omega_;
  const SettleOptions& options_;
  const std::function<bool(long, double)>& progress_;
  std::deque<MotionState> last_;  // the newest first
  double late_amplitude_ = 0;
  bool failed_ = false;
  Settled result_;
};

}  // namespace

Flow keeping_places(const Flow& flow, int count) {
  return [&flow, count](const MotionState& start) {
    PeriodMap all;
    for (int k = 0; k < count; ++k) {
      const MotionState from = k == 0 ? start : all.end;
      PeriodMap map = flow(from);
      if (!map.done) return map;
      std::erase_if(map.resting, [&](const RestingSlider& slider) {
        return map.end.z[slider.slider] != from.z[slider.slider];
      });
      for (RestingSlider& slider : map.resting) {
        slider.offset = from.z[slider.slider];
        slider.derivative.setZero();
      }
      if (k == 0) {
        all = std::move(map);
        continue;
      }
      std::erase_if(all.resting, [&](const RestingSlider& slider) {
        return std::none_of(map.resting.begin(), map.resting.end(),
                            [&](const RestingSlider& other) { return other.slider == slider.slider; });
      });
      all.size = std::max(all.size, map.size);
      all.monodromy = (map.monodromy * all.monodromy).eval();
      all.end = std::move(map.end);
    }
    return all;
  };
}

Settled settle(const Periods& integrate, const Flow& flow, const MotionState& start, double omega,
               const SettleOptions& options, const std::function<bool(long, double)>& progress) {
  return Settling(integrate, flow, start, omega, options, progress).run();
}

}  // namespace arcslip::time
