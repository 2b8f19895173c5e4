#include <arcslip/laws/contact/planar_phases.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::elements {
namespace {

constexpr double same_slider = 1e-13;  // of the motion
constexpr double clear_slip = 1e-3;    // of the motion
constexpr int rest_newton_steps = 40, rest_passes = 200;
constexpr double shortest_share = 0.01;  // of Newton's step
constexpr std::size_t pair_stride = 4;   // samples from one that is paired with others to the next
constexpr std::size_t sampled_periods = 2;

std::uint64_t disc_phase_code(const DiscPhase& phase) {
  const auto from = phase.from == DiscPhase::Begin::start ? DiscPhase::Begin::slip_end : phase.from;
  return static_cast<std::uint64_t>(1 + static_cast<int>(phase.state) + 3 * static_cast<int>(from));
}

// Where a slider that begins at w is after some periods, moved to the edge of the disc at each of the
// instants: from so near to the periodic motion, fewer periods are marched.
Eigen::Vector2d sampled_slider(const std::vector<DiscInstant>& instants, Eigen::Vector2d w) {
  for (std::size_t k = 0; k <= sampled_periods * instants.size(); ++k) {
    const DiscInstant& at = instants[k % instants.size()];
    const Eigen::Vector2d y = at.x - w;
    const double d = y.norm();
    if (d > at.h) w = at.x - at.h / d * y;
  }
  return w;
}

}  // namespace

DiscPhases::DiscPhases(const Harmonics& harmonics)
    : march_(harmonics),
      centre_(harmonics),
      angles_(static_cast<int>(pair_stride) * (4 * harmonics.order + 12)),
      instants_(angles_.theta.size()) {}

// Newton's method for w after one period, from w. Returns what is left, as a change of w: next to full stick
// the slider moves along one line only, so that this is by far larger than its change over the period. A step
// counts if it makes the next one shorter, with the same derivative.
double DiscPhases::iterate(const Disc& disc, double enough, Eigen::Vector2d& w) {
  DiscMarch::Period map = march_.period(disc, 0, w);
  double left = map.moved.norm();
  for (int i = 0; i < rest_passes && map.moved.norm() > 0; ++i) {
    left = map.moved.norm();
    const Eigen::Matrix2d A = Eigen::Matrix2d::Identity() - map.by;
    bool better = false;
    if (i < rest_newton_steps && A.determinant() > 1e-15) {
      const Eigen::Matrix2d inverse = A.inverse();
      const Eigen::Vector2d step = inverse * map.moved;
      left = step.norm();
      if (left <= enough) break;
      for (double share = 1; share > shortest_share && !better; share *= 0.5) {
        const Eigen::Vector2d next = march_.at_rest(disc, 0, w + share * step).w;
        const DiscMarch::Period there = march_.period(disc, 0, next);
        better = (inverse * there.moved).norm() < (1 - 0.25 * share) * left;
        if (!better) continue;
        w = next;
        map = there;
      }
    }
    if (better) continue;
    if (map.moved.norm() <= enough) break;
    w = march_.at_rest(disc, 0, w + map.moved).w;  // never farther from the periodic motion
    map = march_.period(disc, 0, w);
  }
  return left;
}

// Whether a pair of instants excludes full stick by far, without the centre.
bool DiscPhases::surely_slips(const Disc& disc) {
  disc.at(angles_, pair_stride, instants_);
  short_of_stick_ = 0;
  const double clear = clear_slip * (disc.motion_bound(0) + disc.largest());
  double most = 0;  // of the distance from the mean without the radius: twice of it bounds that of a pair
  for (std::size_t i = 0; i < instants_.size(); i += pair_stride)
    most = std::max(most, (instants_[i].x - disc.mean()).norm() - instants_[i].h);
  if (!(most > clear)) return false;
  std::size_t first = 0, second = 0;
  for (std::size_t i = 0; i < instants_.size(); i += pair_stride)
    for (std::size_t j = 0; j < i; j += pair_stride) {
      const double apart = instants_[i].h + instants_[j].h + 2 * short_of_stick_;
      const double square = (instants_[i].x - instants_[j].x).squaredNorm();
      if (!(apart > 0) || !(square > apart * apart)) continue;
      short_of_stick_ = 0.5 * (std::sqrt(square) - instants_[i].h - instants_[j].h);
      first = i;
      second = j;
    }
  if (!(short_of_stick_ > clear)) return false;
  const Eigen::Vector2d w = stick_margin(instants_[first], instants_[second]).w;
  disc.at(angles_, 1, instants_);
  start_ = sampled_slider(instants_, w);
  return true;
}

void DiscPhases::find_periodic(const Disc& disc, bool near_stick) {
  const double size = disc.motion_bound(0) + disc.radius_bound(0), same = same_slider * size;
  Eigen::Vector2d w = march_.at_rest(disc, 0, start_).w;
  const double error = iterate(disc, same, w);
  periodic_ = error <= 1e3 * same;
  if (periodic_ && !near_stick && march_.begin_at_slip_end()) return;
  // Once more from the end of slip: next to full stick it is more exact.
  const auto rest = std::find_if(list().begin(), list().end(), [](const DiscPhase& phase) {
    return phase.from == DiscPhase::Begin::slip_end;
  });
  if (rest == list().end()) {  // slip throughout
    if (list().size() == 1 || march_.panels() == 0) return;
    DiscMarch::State state{true, w, march_.panel(march_.panels() - 1).to()};
    march_.again();
    march_.march(disc, state, DiscPhase::Begin::start, 0, whole_turn, nullptr);
    return;
  }
  const DiscPhase first = *rest;
  march_.clear();
  DiscMarch::State state{false, first.w, 0};
  march_.march(disc, state, DiscPhase::Begin::slip_end, first.begin, first.begin + whole_turn, nullptr);
}

const std::vector<DiscPhase>& DiscPhases::find(const Disc& disc,
                                               std::span<const std::pair<double, double>> closed,
                                               bool opens) {
  march_.begin(disc, opens);
  full_stick_ = false;
  short_of_stick_ = 0;
  periodic_ = true;
  if (closed.empty()) {
    march_.add({DiscPhase::State::open, DiscPhase::Begin::opening, 0, whole_turn});
    return list();
  }
  if (opens) {
    for (std::size_t i = 0; i < closed.size(); ++i) {
      const auto [begin, end] = closed[i];
      DiscMarch::State state = march_.closing(disc, begin);
      march_.march(disc, state, DiscPhase::Begin::closing, begin, end, nullptr);
      const double next = i + 1 < closed.size() ? closed[i + 1].first : closed[0].first + whole_turn;
      march_.add({DiscPhase::State::open, DiscPhase::Begin::opening, end, next});
    }
    return list();
  }
  if (surely_slips(disc)) {
    find_periodic(disc, false);
    return list();
  }
  centre_.find(disc);
  full_stick_ = centre_.r() <= same_slider * disc.motion_bound(0);
  if (full_stick_) {
    short_of_stick_ = 0;
    DiscPhase phase{DiscPhase::State::stick, DiscPhase::Begin::start, 0, whole_turn};
    phase.w = centre_.w();
    march_.add(phase);
  } else {
    short_of_stick_ = centre_.r();
    start_ = centre_.w();
    find_periodic(disc, true);
  }
  return list();
}

std::uint64_t DiscPhases::sequence() const {
  if (full_stick_) return 2 + centre_.active().size();
  std::uint64_t sum = 1;
  for (std::size_t i = 0; i < list().size(); ++i) {
    const DiscPhase& next = list()[i + 1 == list().size() ? 0 : i + 1];
    sum += mixed_bits(64 * disc_phase_code(list()[i]) + disc_phase_code(next));
  }
  return sum;
}

void DiscPhases::tell(FrictionState& state) const {
  state.slip_onsets.clear();
  state.slip_ends.clear();
  double stuck = 0, open = 0;
  const auto wrapped = [](double angle) { return angle - std::floor(angle / whole_turn) * whole_turn; };
  for (const DiscPhase& phase : list()) {
    if (phase.state == DiscPhase::State::stick) stuck += phase.end - phase.begin;
    if (phase.state == DiscPhase::State::open) open += phase.end - phase.begin;
    if (phase.state != DiscPhase::State::slip) continue;
    if (list().size() == 1) continue;  // throughout
    state.slip_onsets.push_back(wrapped(phase.begin));
    state.slip_ends.push_back(wrapped(phase.end));
  }
  std::sort(state.slip_onsets.begin(), state.slip_onsets.end());
  std::sort(state.slip_ends.begin(), state.slip_ends.end());
  state.stick_share = full_stick_ ? 1 : stuck / whole_turn;
  state.open_share = open / whole_turn;
}

void DiscPhases::tell(std::vector<ContactInterval>& intervals) const {
  intervals.clear();
  for (const DiscPhase& phase : list()) {
    const bool open = phase.state == DiscPhase::State::open, stuck = phase.state == DiscPhase::State::stick;
    intervals.push_back({open ? "open" : stuck ? "stick" : "slip", phase.begin, phase.end});
  }
}

}  // namespace arcslip::elements
