#include <arcslip/laws/contact/contact_phases.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::elements {
namespace {

constexpr double same_reversals = 1e-6;  // rad: reversals of both bounds, where the load is constant
constexpr double same_bounds = 1e-12;    // of the size of the motion
constexpr double no_onset = std::numeric_limits<double>::infinity();

std::uint64_t contact_phase_code(const ContactPhase& phase) {
  const int state = static_cast<int>(phase.state), rest = static_cast<int>(phase.rest.at);
  return static_cast<std::uint64_t>(1 + state + 3 * (rest + 3 * (1 + static_cast<int>(phase.sign))));
}

}  // namespace

ContactPhases::ContactPhases(const Harmonics& harmonics, Offset offset)
    : harmonics_(harmonics), reversals_(harmonics), normal_(harmonics), offset_(offset) {
  const auto most = static_cast<std::size_t>(2 * harmonics.order + 2);
  lower_.u.resize(harmonics.size());
  upper_.u.resize(harmonics.size());
  for (auto* turns : {&lower_.turns, &upper_.turns}) turns->reserve(2 * most);
  phases_.reserve(8 * most);
}

Reversal ContactPhases::Bound::turn(long i) const {
  const long n = static_cast<long>(turns.size());
  const long turns_before = i >= 0 ? i / n : -((n - 1 - i) / n);
  Reversal at = turns[static_cast<std::size_t>(i - turns_before * n)];
  at.theta += static_cast<double>(turns_before) * whole_turn;
  return at;
}

long ContactPhases::Bound::piece(double theta) const {
  const double before = std::floor((theta - turns.front().theta) / whole_turn);
  const double angle = theta - before * whole_turn;
  const auto after = std::upper_bound(turns.begin(), turns.end(), angle,
                                      [](double t, const Reversal& at) { return t < at.theta; });
  return static_cast<long>(before) * static_cast<long>(turns.size()) + (after - turns.begin()) - 1;
}

const std::vector<ContactPhase>& ContactPhases::find(In u_t, In u_n, const ContactLaw& law) {
  phases_.clear();
  full_stick_ = false;
  frictionless_ = !(law.mu > 0);
  gap_ = law.N_0 <= 0;  // a preload is balanced at rest, so that the force by N_0 has a kink there
  normal_.move_to(u_n, law.k_n, law.N_0);
  const auto closed = normal_.closed();
  const double ratio = law.mu * law.k_n / law.k_t, h = law.mu * law.N_0 / law.k_t;
  lower_.u = u_t - ratio * u_n;
  upper_.u = u_t + ratio * u_n;
  lower_.u[0] -= h;
  upper_.u[0] += h;
  lower_.turns.clear();
  upper_.turns.clear();
  if (closed.empty()) {
    phases_.push_back({ContactPhase::State::open, 0, whole_turn});
    return phases_;
  }
  lower_.turns = reversals_.find(lower_.u);
  upper_.turns = reversals_.find(upper_.u);
  if (normal_.opens()) {
    for (std::size_t i = 0; i < closed.size(); ++i) {
      const auto [begin, end] = closed[i];
      sweep({SliderRest::At::closing, begin, series_values(harmonics_, u_t, begin).x}, end);
      const double next = i + 1 < closed.size() ? closed[i + 1].first : closed[0].first + whole_turn;
      phases_.push_back({ContactPhase::State::open, end, next});
    }
    return phases_;
  }
  const auto less = [](const Reversal& a, const Reversal& b) { return a.x < b.x; };
  largest_lower_ = {0, lower_.u[0]};
  smallest_upper_ = {0, upper_.u[0]};
  if (!lower_.turns.empty())
    largest_lower_ = *std::max_element(lower_.turns.begin(), lower_.turns.end(), less);
  if (!upper_.turns.empty())
    smallest_upper_ = *std::min_element(upper_.turns.begin(), upper_.turns.end(), less);
  choose_nearest();
  full_stick_ = largest_lower_.x <= smallest_upper_.x;
  if (full_stick_) {
    ContactPhase phase{ContactPhase::State::stick, 0, whole_turn};
    held_ = stuck_slider(offset_, largest_lower_.x, smallest_upper_.x, share_);
    phase.rest.w = held_.lower * largest_lower_.x + held_.upper * smallest_upper_.x;
    phases_.push_back(phase);
  } else {
    // w <= b < a since the upper bound was at b, and a at the largest value of the lower one.
    sweep({SliderRest::At::lower_reversal, largest_lower_.theta, largest_lower_.x},
          largest_lower_.theta + whole_turn);
  }
  return phases_;
}

// A motion of a part of the period has its extremes several times, equal but for rounding: the nearest two.
void ContactPhases::choose_nearest() {
  const double same =
      same_bounds * (series_bound(harmonics_, lower_.u, 0) + series_bound(harmonics_, upper_.u, 0));
  const double a = largest_lower_.x, b = smallest_upper_.x;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Reversal& lower : lower_.turns)
    for (const Reversal& upper : upper_.turns) {
      if (lower.x < a - same || upper.x > b + same) continue;
      double apart = upper.theta - lower.theta;
      if (apart < 0) apart += whole_turn;
      if (apart >= nearest - same_reversals) continue;
      nearest = apart;
      largest_lower_.theta = lower.theta;
      smallest_upper_.theta = upper.theta;
    }
}

// Where the bound reaches w from the side it comes from, in a piece that begins before `until`.
ContactPhases::Onset ContactPhases::onset(const Bound& bound, bool upwards, double begin, double end,
                                          double until, double w) const {
  if (bound.turns.empty()) return {no_onset, 0};
  for (long i = bound.piece(begin);; ++i) {
    const Reversal from = bound.turn(i), to = bound.turn(i + 1);
    if (from.theta >= until) return {no_onset, 0};
    if (to.theta <= begin) continue;  // the index of the piece is that of a rounded angle
    if ((to.x > from.x) != upwards || (upwards ? to.x <= w : to.x >= w)) continue;
    const double at = std::max(reversals_.crossing(bound.u, from, to, w), begin);
    return {at < end - negligible_slip ? at : no_onset, i};
  }
}

// Slip, until its bound turns or the contact opens. rest: where it ends.
void ContactPhases::slip(double sign, Onset from, double end, SliderRest& rest) {
  const Reversal turn = (sign > 0 ? lower_ : upper_).turn(from.piece + 1);
  rest = {sign > 0 ? SliderRest::At::lower_reversal : SliderRest::At::upper_reversal,
          std::clamp(turn.theta, from.theta, end), turn.x};
  phases_.push_back({ContactPhase::State::slip, from.theta, rest.theta, sign});
}

// From the rest, or from a closing, to the end of contact or of the period.
void ContactPhases::sweep(SliderRest rest, double end) {
  if (rest.at == SliderRest::At::closing) {
    const long below = lower_.turns.empty() ? 0 : lower_.piece(rest.theta);
    const long above = upper_.turns.empty() ? 0 : upper_.piece(rest.theta);
    if (!lower_.turns.empty() && lower_.rises(below))
      slip(1, {rest.theta, below}, end, rest);
    else if (!upper_.turns.empty() && !upper_.rises(above))
      slip(-1, {rest.theta, above}, end, rest);
  }
  while (rest.theta < end) {
    const Onset up = onset(lower_, true, rest.theta, end, end, rest.w);
    const Onset down = onset(upper_, false, rest.theta, end, std::min(up.theta, end), rest.w);
    const Onset& first = up.theta <= down.theta ? up : down;
    const double until = std::min(first.theta, end);
    phases_.push_back({ContactPhase::State::stick, rest.theta, until, 0, rest});
    if (first.theta == no_onset) return;
    slip(up.theta <= down.theta ? 1 : -1, first, end, rest);
  }
}

std::uint64_t ContactPhases::sequence() const {
  return gap_ ? ~sequence_of_phases() : sequence_of_phases();
}

std::uint64_t ContactPhases::sequence_of_phases() const {
  if (frictionless_) return (normal_.opens() ? 1 : 0) + 2 * normal_.closed().size();
  if (full_stick_) {  // its offset follows one extreme, or both
    const bool at_lower = held_.lower > 0, at_upper = held_.upper > 0;
    if (!at_lower && !at_upper) return 2;
    const std::uint64_t bounds = at_lower && at_upper ? 0 : at_lower ? 1 : 2;
    const auto after_a = [&](double theta) {
      const double after = theta - largest_lower_.theta;
      return after < 0 ? after + whole_turn : after;
    };
    const double b = after_a(smallest_upper_.theta);
    std::uint64_t between = 0, beyond = 0;
    for (const Reversal& at : lower_.turns)
      if (after_a(at.theta) > same_reversals && after_a(at.theta) < b - same_reversals) ++between;
    for (const Reversal& at : upper_.turns)
      if (after_a(at.theta) > b + same_reversals && after_a(at.theta) < whole_turn - same_reversals) ++beyond;
    return 3 + between + 4096 * beyond + (bounds << 32);
  }
  std::uint64_t sum = 1;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const ContactPhase& next = phases_[i + 1 == phases_.size() ? 0 : i + 1];
    sum += mixed_bits(64 * contact_phase_code(phases_[i]) + contact_phase_code(next));
  }
  return sum;
}

void ContactPhases::tell(FrictionState& state) const {
  state.slip_onsets.clear();
  state.slip_ends.clear();
  double stuck = 0, open = 0;
  const auto wrapped = [](double angle) { return angle - std::floor(angle / whole_turn) * whole_turn; };
  for (const ContactPhase& phase : phases_) {
    if (phase.state == ContactPhase::State::stick) stuck += phase.end - phase.begin;
    if (phase.state == ContactPhase::State::open) open += phase.end - phase.begin;
    if (phase.state != ContactPhase::State::slip || phase.sign == 0) continue;
    state.slip_onsets.push_back(wrapped(phase.begin));
    state.slip_ends.push_back(wrapped(phase.end));
  }
  std::sort(state.slip_onsets.begin(), state.slip_onsets.end());
  std::sort(state.slip_ends.begin(), state.slip_ends.end());
  state.stick_share = full_stick_ ? 1 : stuck / whole_turn;
  state.open_share = normal_.closed().empty() ? 1 : open / whole_turn;
  normal_.tell(state);
}

void ContactPhases::tell(std::vector<ContactInterval>& intervals) const {
  using State = ContactPhase::State;
  intervals.clear();
  for (const auto& [state, begin, end, sign, rest] : phases_) {
    const char* slip = sign > 0 ? "slip+" : sign < 0 ? "slip-" : "slip";
    intervals.push_back({state == State::open ? "open" : state == State::stick ? "stick" : slip, begin, end});
  }
}

}  // namespace arcslip::elements
