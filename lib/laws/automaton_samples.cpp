#include <arcslip/laws/automaton_samples.hpp>

#include <arcslip/fourier/samples.hpp>
#include <arcslip/laws/piece_hash.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::elements {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double same_height = 1e-12;  // of the range of a bound

std::uint64_t with_sample(std::uint64_t piece, int sample) {
  return hashed(piece, static_cast<std::uint64_t>(sample) << 2);
}

bool has_velocity(const Guard& guard) {
  for (Eigen::Index i = 0; i < guard.v.size(); ++i)
    if (guard.v[i] != 0) return true;
  return false;
}

}  // namespace

AutomatonSamples::AutomatonSamples(Automaton automaton, const Harmonics& harmonics, int count)
    : automaton_(automaton.memory), odd_(harmonics.odd), samples_(static_cast<std::size_t>(count)) {
  renew(std::move(automaton));
}

void AutomatonSamples::renew(Automaton automaton) {
  automaton_ = std::move(automaton);
  has_open_ = false;
  lower_ = upper_ = 0;
  for (std::size_t m = 0; m < automaton_.modes.size(); ++m) {
    const Mode& mode = automaton_.modes[m];
    has_open_ = has_open_ || mode.open;
    if (mode.rests || mode.open) continue;
    if (mode.way >= 0) lower_ = static_cast<int>(m);
    if (mode.way <= 0) upper_ = static_cast<int>(m);
  }
}

double AutomatonSamples::moving_bound(const Mode& mode, const Eigen::MatrixXd& q, int s) {
  double sum = 0;
  for (Eigen::Index i = 0; i < mode.z_q.size(); ++i) sum += mode.z_q[i] * q(s, i);
  return sum;
}

double AutomatonSamples::bound(const Mode& mode, const Eigen::MatrixXd& q, int s, double sign) {
  return mode.z_0 + sign * moving_bound(mode, q, s);
}

void AutomatonSamples::follow(const Eigen::MatrixXd& q) {
  sticks_ = false;
  first_ = 0;
  first_sign_ = 1;
  if (!slides() || !mode(0).rests || opens(q))
    march(q, false);
  else if (find_bounds(q))
    march(q, true);
}

// The mode by the guards without velocities; a slider beyond a bound is moved to it.
void AutomatonSamples::locate(const Eigen::MatrixXd& q, int s, Sample& at) const {
  at.mode = 0;
  for (std::size_t left = automaton_.modes.size(); left > 0; --left) {
    const Mode& here = mode(at.mode);
    if (slides() && !here.rests) {
      at.z = bound(here, q, s, at.sign);
      at.anchor = s;
      at.anchor_mode = at.mode;
      at.anchor_sign = at.sign;
    }
    const auto leaves = std::find_if(here.leaves.begin(), here.leaves.end(), [&](const Guard& guard) {
      if (has_velocity(guard)) return false;
      double g = guard.z * at.z + guard.c;
      for (Eigen::Index i = 0; i < guard.q.size(); ++i) g += at.sign * guard.q[i] * q(s, i);
      return g < 0;
    });
    if (leaves == here.leaves.end()) return;
    at.mode = leaves->to;
  }
}

// Whether it does at a sample, which is the first one then.
bool AutomatonSamples::opens(const Eigen::MatrixXd& q) {
  for (int s = 0; has_open_ && s < static_cast<int>(samples_.size()); ++s) {
    Sample at;
    at.z = bound(mode(lower_), q, s);
    locate(q, s, at);
    if (!mode(at.mode).open) continue;
    first_ = s;
    return true;
  }
  return false;
}

// Where the bounds are highest and lowest. False where neither moves the slider, which sticks then.
bool AutomatonSamples::find_bounds(const Eigen::MatrixXd& q) {
  const int count = static_cast<int>(samples_.size());
  // Without their constants, which may be far larger than the motion.
  const double lower_0 = mode(lower_).z_0, upper_0 = mode(upper_).z_0;
  double high = -infinite, low = infinite, least = infinite;
  for (int s = 0; s < count; ++s) {
    const double lower = moving_bound(mode(lower_), q, s);
    high = std::max(high, lower);
    least = std::min(least, lower);
    low = std::min(low, moving_bound(mode(upper_), q, s));
  }
  // The first of several that are equal to rounding, as in a motion with a shorter period than the force.
  const double same = same_height * (high - least);
  const auto first_of = [&](int bound_mode, double height) {
    int s = 0;
    while (s + 1 < count && std::abs(moving_bound(mode(bound_mode), q, s) - height) > same) ++s;
    return s;
  };
  highest_ = first_of(lower_, high);
  lowest_ = first_of(upper_, low);
  first_ = highest_;
  if (odd_) {
    if (-low > high) {
      first_ = lowest_;
      first_sign_ = -1;
    }
    high = std::max(high, -low);
    low = -high;
  }
  if (high - low > upper_0 - lower_0) return true;
  Sample at{0, first_sign_, 0.5 * (high + low) + (lower_0 == -upper_0 ? 0 : 0.5 * (lower_0 + upper_0))};
  locate(q, first_, at);
  if (!mode(at.mode).rests) return true;  // without friction
  stick(high, low);
  return false;
}

void AutomatonSamples::stick(double high, double low) {
  sticks_ = true;
  const double lower_0 = mode(lower_).z_0, upper_0 = mode(upper_).z_0;
  stuck_ = odd_ ? StuckSlider{0, 0} : stuck_slider(automaton_.offset, high + lower_0, low + upper_0);
  piece_ = 1;
  if (stuck_.lower > 0) piece_ = with_sample(piece_, highest_);
  if (stuck_.upper > 0) piece_ = with_sample(piece_ + 1, lowest_);
  Sample all;
  all.z = stuck_.lower * high + stuck_.upper * low;
  if (stuck_.lower != stuck_.upper || lower_0 != -upper_0)
    all.z += stuck_.lower * lower_0 + stuck_.upper * upper_0;
  std::fill(samples_.begin(), samples_.end(), all);
}

void AutomatonSamples::march(const Eigen::MatrixXd& q, bool at_bound) {
  const int count = static_cast<int>(samples_.size());
  piece_ = with_sample(2, 2 * first_ + (first_sign_ < 0));
  Sample at;
  for (int k = 0; k < count; ++k) {
    const bool wrapped = first_ + k >= count;
    const int s = wrapped ? first_ + k - count : first_ + k;
    at.sign = wrapped && odd_ ? -first_sign_ : first_sign_;
    if (k == 0 && at_bound)
      at = {lower_, at.sign, bound(mode(lower_), q, s, at.sign), s, lower_, at.sign};
    else
      locate(q, s, at);
    samples_[static_cast<std::size_t>(s)] = at;
    piece_ = hashed(piece_, static_cast<std::uint64_t>(at.mode) + 1);
  }
}

Eigen::VectorXd AutomatonSamples::force_after(int sample, const Eigen::MatrixXd& q, int row) const {
  Sample there = at(sample);
  locate(q, row, there);
  const Mode& in = mode(there.mode);
  Eigen::VectorXd f = in.f_q * q.row(row).transpose() + there.sign * in.f_0;
  if (holds(in)) f += there.sign * there.z * in.f_z;
  return f;
}

Eigen::MatrixXd sampled_force(const std::vector<Automaton>& automata, const Harmonics& h, In u, int count,
                              std::span<const double> angles) {
  const Samples samples(h, h.odd ? (count + 1) / 2 : count);
  const Eigen::Index c = h.size(), d = u.size() / c;
  Eigen::MatrixXd motion(samples.count(), d), q(1, d);
  for (Eigen::Index i = 0; i < d; ++i) samples.values(u.segment(i * c, c), motion.col(i));
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(angles.size()), d);
  for (const Automaton& automaton : automata) {
    AutomatonSamples course(automaton, h, samples.count());
    course.follow(motion);
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const double spans = std::floor(angles[k] / h.span()), at = angles[k] - spans * h.span();
      const double turned = h.odd && std::fmod(spans, 2) != 0 ? -1 : 1;
      for (Eigen::Index i = 0; i < d; ++i)
        q(0, i) = turned * series_values(h, u.segment(i * c, c), angles[k]).x;
      const int last = std::min(static_cast<int>(at / samples.weight()), samples.count() - 1);
      all.row(static_cast<Eigen::Index>(k)) += turned * course.force_after(last, q, 0).transpose();
    }
  }
  return all;
}

}  // namespace arcslip::elements
