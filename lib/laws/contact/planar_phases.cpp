#include <arcslip/laws/contact/planar_phases.hpp>

#include <arcslip/laws/contact/slip_onset.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::elements {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double resolved = 1e-8;      // of h psi within a panel, of the largest radius
constexpr double same_slider = 1e-13;  // of the motion
constexpr double same_end = 1e-6;      // rad: slip that ends so near to the end of the period began it
constexpr double edge = 1e-12;         // of the radius: a slider that is so close is at the edge
constexpr double clear_slip = 1e-3;    // of the motion
constexpr double first_turn = 2.5;     // rad
constexpr double least_first = 1e-3;   // of the longest panel
constexpr double exact_end = 1e-10;    // of the length of the panel where slip ends
constexpr int end_steps = 5;
constexpr double phase_per_panel = 4;  // rad, of the highest harmonic
constexpr std::size_t most_panels = 20000;
constexpr int rest_newton_steps = 40, rest_passes = 200;
constexpr double shortest_share = 0.01;  // of Newton's step
constexpr std::size_t pair_stride = 4;   // samples from one that is paired with others to the next
constexpr std::size_t sampled_periods = 2;

Eigen::Vector2d direction(double psi) {
  return {std::cos(psi), std::sin(psi)};
}
Eigen::Vector2d across(double psi) {
  return {-std::sin(psi), std::cos(psi)};
}

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
    : harmonics_(harmonics), centre_(harmonics), longest_(phase_per_panel / harmonics.order) {
  phases_.reserve(static_cast<std::size_t>(16 * harmonics.order + 64));
  panels_.reserve(static_cast<std::size_t>(8 * harmonics.order + 64));
  before_.reserve(panels_.capacity());
  const int count = static_cast<int>(pair_stride) * (4 * harmonics.order + 12);
  for (int k = 0; k < count; ++k)
    samples_.emplace_back(std::cos(whole_turn * k / count), std::sin(whole_turn * k / count));
  instants_.resize(samples_.size());
}

DiscPhases::State DiscPhases::closing(const Disc& disc, double theta) const {
  const DiscPoint at = disc.at(theta);
  if (at.v.norm() <= at.dh) return {false, at.x, 0};
  return {true, at.x, std::atan2(at.v[1], at.v[0])};
}

// A slider beyond the edge is moved to it.
DiscPhases::State DiscPhases::at_rest(const Disc& disc, double theta, const Eigen::Vector2d& w) const {
  const DiscPoint at = disc.at(theta);
  const Eigen::Vector2d y = at.x - w;
  const double d = y.norm();
  if (d < at.h * (1 - edge)) return {false, w, 0};
  const double psi = std::atan2(y[1], y[0]);
  const Eigen::Vector2d n = direction(psi), edge = at.x - at.h * n;
  return {n.dot(at.v) > at.dh, edge, psi};
}

// x'.n - h' within a panel, and its slope.
std::pair<double, double> DiscPhases::spare(const Disc& disc, const SlipPanel& panel, double theta) const {
  const DiscPoint p = disc.at(theta);
  const double psi = collocation_.psi(panel, theta);
  const Eigen::Vector2d n = direction(psi);
  const double turning = across(psi).dot(p.v);  // h psi'
  return {n.dot(p.v) - p.dh, n.dot(p.a) - p.ddh + (p.h > 0 ? turning * turning / p.h : 0)};
}

// Where the speed of slip first becomes negative in a panel, if it does: at a node, or in a dip between two.
std::optional<DiscPhases::Bracket> DiscPhases::end_of_slip(const Disc& disc, const SlipPanel& panel) const {
  double theta = panel.begin;
  auto [speed, slope] = spare(disc, panel, theta);
  for (int j = 0; j < panel_nodes; ++j) {
    if (panel.spare[j] < 0) return Bracket{theta, speed, panel.theta[j], panel.spare[j]};
    const double length = panel.theta[j] - theta;
    // No lower than where the tangents meet, if it is convex.
    if (slope < 0 && panel.gain[j] > 0 &&
        speed * panel.gain[j] - panel.spare[j] * slope + slope * panel.gain[j] * length < 0) {
      double below = theta, above = panel.theta[j];
      for (int i = 0; i < 40 && above - below > 1e-6 * length; ++i) {
        const double middle = 0.5 * (below + above);
        const auto [value, rise] = spare(disc, panel, middle);
        if (value < 0) return Bracket{theta, speed, middle, value};
        (rise < 0 ? below : above) = middle;
      }
    }
    theta = panel.theta[j];
    speed = panel.spare[j];
    slope = panel.gain[j];
  }
  return {};
}

// By Newton's method, with bisection where it leaves the bracket.
double DiscPhases::root_in(const Disc& disc, const SlipPanel& panel, const Bracket& bracket) const {
  auto [below, f_below, above, f_above] = bracket;
  if (!(f_below > 0)) return below;
  const double enough = std::max(exact_end * panel.length(), 1e-14);
  double root = below + f_below / (f_below - f_above) * (above - below);
  for (int i = 0; i < 80 && above - below > enough; ++i) {
    const auto [f, slope] = spare(disc, panel, root);
    (f >= 0 ? below : above) = root;
    const double step = slope < 0 ? f / slope : above - below;
    const double next = root - step;
    root = next >= below && next <= above ? next : 0.5 * (below + above);
    if (std::abs(step) <= enough) break;
  }
  return std::min(root, panel.theta[panel_nodes - 1]);
}

// The panel of the march before that has an angle in it, or begins soon after.
const SlipPanel* DiscPhases::known_near(double theta) {
  while (cursor_ < before_.size() && before_[cursor_].end <= theta + 0.2 * before_[cursor_].length())
    ++cursor_;
  if (cursor_ == before_.size() || before_[cursor_].begin > theta + 0.2 * before_[cursor_].length())
    return nullptr;
  return &before_[cursor_];
}

// Over which the direction of slip may turn by about one rad.
double DiscPhases::first_length(const Disc& disc, double theta) const {
  const DiscPoint p = disc.at(theta);
  const double speed = p.v.norm(), rate = std::abs(p.dh), width = std::max(p.h, 0.0);
  const double slowest =
      (speed > 0 ? p.a.norm() / speed : 0) + (width > 0 ? (speed + rate) / (width + 0.5 * rate) : 0);
  return slowest > 0 ? std::clamp(first_turn / slowest, least_first * longest_, longest_) : longest_;
}

double DiscPhases::solve(const Disc& disc, const SlipPanel* known, double theta, double to, double psi) {
  SlipPanel& panel = panels_.back();
  if (known != nullptr) {
    const double tail = collocation_.solve_near(disc, *known, theta, to, psi, tolerance_, panel);
    if (tail <= tolerance_) return tail;
  }
  return collocation_.solve(disc, theta, to, psi, tolerance_, panel);
}

// Makes the last panel end where slip ends, which is near an angle. False: it could not be followed so far.
bool DiscPhases::close_slip(const Disc& disc, double root) {
  for (int i = 0; i < end_steps; ++i) {
    const SlipPanel known = panels_.back();
    SlipPanel& panel = panels_.back();
    const double tail =
        collocation_.solve_near(disc, known, known.begin, root, known.from, tolerance_, panel);
    if (!(tail <= tolerance_)) return false;
    const double spare = panel.spare[panel_nodes - 1], gain = panel.gain[panel_nodes - 1];
    const double step = gain < 0 ? -spare / gain : 0;
    if (std::abs(step) <= std::max(exact_end * panel.length(), 1e-14)) return true;
    if (!(std::abs(step) <= 1e-2 * panel.length())) return true;
    root += step;
  }
  return true;
}

// Adds a panel that begins at theta, in the direction psi. False: it is too long, and the next one should
// have the length that is left in `length`, as after success; 0: that of the march before, or a guess.
bool DiscPhases::add_panel(const Disc& disc, double theta, double end, double psi, Lengths& lengths) {
  const SlipPanel* known = lengths.next > 0 ? nullptr : known_near(theta);
  if (lengths.next == 0 && known == nullptr) lengths.next = first_length(disc, theta);
  double to = known != nullptr ? known->end : theta + lengths.next;
  if (end - to < 1e-3 * (to - theta)) to = end;
  panels_.emplace_back();
  const double tail = solve(disc, known, theta, to, psi);
  const bool good = tail <= tolerance_;
  // The tail falls like the power of the number of nodes.
  const double ratio = std::pow(std::max(tail, 1e-6 * tolerance_) / tolerance_, -1.0 / panel_nodes);
  const double next = std::clamp(0.9 * ratio, 0.3, 3.0) * (to - theta);
  lengths.held = !good && (to - theta < lengths.least || panels_.size() > most_panels);
  if (!good && !lengths.held) {
    panels_.pop_back();
    lengths.next = std::min(next, 0.7 * (to - theta));
    return false;
  }
  if (lengths.held) {  // in the direction of the motion, for ever longer
    const DiscPoint at = disc.at(theta);
    const double along = at.v.norm() > 0 ? std::atan2(at.v[1], at.v[0]) : psi;
    collocation_.hold(disc, theta, to, along, panels_.back());
    lengths.least *= 10;
  }
  if (lengths.held)
    lengths.next = longest_;
  else
    lengths.next = before_.empty() ? std::min(next, longest_) : 0;
  return true;
}

// The integral of (x'.n - h')/h over a panel.
double DiscPhases::decay_exponent(const SlipPanel& panel) const {
  const SlipPanel::Nodes weights = collocation_.weights(panel);
  double exponent = 0;
  for (int j = 0; j < panel_nodes; ++j)
    exponent += panel.h[j] > 0 ? weights[j] * panel.spare[j] / panel.h[j] : never;
  return std::max(exponent, 0.0);
}

// From the state at `begin` until slip ends, or to `end`. decay: of a change of w across n.
double DiscPhases::slip(const Disc& disc, State& state, double begin, double end, double& decay, bool& ends) {
  double theta = begin, exponent = 0;
  Lengths lengths;
  ends = false;
  while (theta < end && !ends) {
    if (!add_panel(disc, theta, end, state.psi, lengths)) continue;
    if (const auto bracket = lengths.held ? std::nullopt : end_of_slip(disc, panels_.back())) {
      const double root = root_in(disc, panels_.back(), *bracket);
      const bool at_once = root - theta <= 1e-13;
      ends = at_once || close_slip(disc, root);
      if (at_once || !ends) panels_.pop_back();
      if (at_once) break;
      if (!ends) {  // the continuation beyond the end is hard to follow
        lengths.next = 0.5 * (root - theta);
        continue;
      }
    }
    exponent += decay_exponent(panels_.back());
    theta = panels_.back().end;
    state.psi = panels_.back().to();
  }
  decay = std::exp(-exponent);
  return ends ? theta : end;
}

// Adds the phases of an interval in contact. by: the derivative of w, which is multiplied.
void DiscPhases::march(const Disc& disc, State& state, DiscPhase::Begin from, double begin, double end,
                       Eigen::Matrix2d* by) {
  const auto most = static_cast<std::size_t>(16 * harmonics_.order + 64);
  const bool closes = from == DiscPhase::Begin::slip_end;  // after the period
  double theta = begin;
  const std::size_t first = phases_.size();
  while (theta < end) {
    DiscPhase phase;
    phase.from = from;
    phase.begin = theta;
    if (!state.slips) {
      const bool at_edge = from == DiscPhase::Begin::closing || from == DiscPhase::Begin::slip_end;
      double until = phases_.size() - first > most ? never : slip_onset(disc, state.w, at_edge, theta, end);
      if (opens_ && until >= end - negligible_slip) until = never;
      phase.state = DiscPhase::State::stick;
      phase.w = state.w;
      phase.end = std::min(until, end);
      if (phases_.size() > first && phases_.back().state == DiscPhase::State::stick)
        phases_.back().end = phase.end;  // without slip at the onset
      else
        phases_.push_back(phase);
      theta = phase.end;
      if (until == never) return;
      const DiscPoint p = disc.at(theta);
      const Eigen::Vector2d y = p.x - state.w;
      state.psi = std::atan2(y[1], y[0]);
      state.slips = true;
      from = DiscPhase::Begin::onset;
      continue;
    }
    phase.state = DiscPhase::State::slip;
    phase.first_panel = panels_.size();
    const double psi = state.psi;
    double decay = 1;
    bool ends = false;
    const double until = slip(disc, state, theta, end, decay, ends);
    phase.end = until;
    phase.last_panel = panels_.size();
    const DiscPoint p = disc.at(until);
    if (by != nullptr && until > theta) *by = decay * across(state.psi) * across(psi).transpose() * *by;
    if (until > theta) {
      for (std::size_t k = phase.first_panel; k < phase.last_panel; ++k)
        state.moved += displacement(panels_[k]);
      phases_.push_back(phase);
    }
    if (end - until < (closes ? same_end : negligible_slip)) return;
    if (ends) {
      state.w = p.x - std::max(p.h, 0.0) * direction(state.psi);
      state.slips = false;
      from = DiscPhase::Begin::slip_end;
    }
    theta = until;
  }
}

// Of the slider in slip over a panel, to relative precision.
Eigen::Vector2d DiscPhases::displacement(const SlipPanel& panel) const {
  const SlipPanel::Nodes weights = collocation_.weights(panel);
  Eigen::Vector2d sum(0, 0);
  for (int j = 0; j < panel_nodes; ++j)
    sum += weights[j] * panel.spare[j] * Eigen::Vector2d(panel.outward[0][j], panel.outward[1][j]);
  return sum;
}

DiscPhases::Period DiscPhases::period(const Disc& disc, double begin, const Eigen::Vector2d& w) {
  phases_.clear();
  panels_.swap(before_);
  panels_.clear();
  cursor_ = 0;
  State state = at_rest(disc, begin, w);
  Period map{{0, 0}, Eigen::Matrix2d::Identity()};
  march(disc, state, DiscPhase::Begin::start, begin, begin + whole_turn, &map.by);
  map.moved = state.moved;
  return map;
}

// Newton's method for w after one period, from w. Returns what is left, as a change of w: next to full stick
// the slider moves along one line only, so that this is by far larger than its change over the period. A step
// counts if it makes the next one shorter, with the same derivative.
double DiscPhases::iterate(const Disc& disc, double enough, Eigen::Vector2d& w) {
  Period map = period(disc, 0, w);
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
        const Eigen::Vector2d next = at_rest(disc, 0, w + share * step).w;
        const Period there = period(disc, 0, next);
        better = (inverse * there.moved).norm() < (1 - 0.25 * share) * left;
        if (!better) continue;
        w = next;
        map = there;
      }
    }
    if (better) continue;
    if (map.moved.norm() <= enough) break;
    w = at_rest(disc, 0, w + map.moved).w;  // never farther from the periodic motion
    map = period(disc, 0, w);
  }
  return left;
}

// Whether a pair of instants excludes full stick by far, without the centre.
bool DiscPhases::surely_slips(const Disc& disc) {
  const auto look_at_each = [&](std::size_t stride) {
    for (std::size_t k = 0; k < samples_.size(); k += stride) {
      const DiscPoint at = disc.at(samples_[k].first, samples_[k].second);
      instants_[k] = {0, at.x, at.h};
    }
  };
  look_at_each(pair_stride);
  short_of_stick_ = 0;
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
  if (!(short_of_stick_ > clear_slip * (disc.motion_bound(0) + disc.largest()))) return false;
  const Eigen::Vector2d w = stick_margin(instants_[first], instants_[second]).w;
  look_at_each(1);
  start_ = sampled_slider(instants_, w);
  return true;
}

// Turns the list so that it begins where slip ends, if the phase in which the period began is the same before
// and after.
bool DiscPhases::begin_at_slip_end() {
  const auto rest = std::find_if(phases_.begin(), phases_.end(), [](const DiscPhase& phase) {
    return phase.from == DiscPhase::Begin::slip_end;
  });
  DiscPhase &first = phases_.front(), &last = phases_.back();
  if (rest == phases_.end() || phases_.size() < 2 || last.state != first.state) return false;
  const bool slips = first.state == DiscPhase::State::slip;
  const auto turned = static_cast<std::size_t>(rest - phases_.begin());
  std::size_t moved = 0;  // panels
  for (std::size_t k = 0; k < turned; ++k)
    if (phases_[k].state == DiscPhase::State::slip) moved = phases_[k].last_panel;
  const double psi = slips ? panels_.back().to() - panels_.front().from : 0;
  for (std::size_t k = 0; k < moved; ++k)
    panels_[k].shift(whole_turn, whole_turn * std::round(psi / whole_turn));
  std::rotate(panels_.begin(), panels_.begin() + static_cast<std::ptrdiff_t>(moved), panels_.end());
  const std::size_t stay = panels_.size() - moved;
  for (std::size_t k = 0; k < phases_.size(); ++k) {
    DiscPhase& phase = phases_[k];
    if (k < turned) {
      phase.begin += whole_turn;
      phase.end += whole_turn;
    }
    if (phase.state != DiscPhase::State::slip) continue;
    phase.first_panel = k < turned ? phase.first_panel + stay : phase.first_panel - moved;
    phase.last_panel = k < turned ? phase.last_panel + stay : phase.last_panel - moved;
  }
  last.end = first.end;
  if (slips) last.last_panel = first.last_panel;
  std::rotate(phases_.begin(), phases_.begin() + static_cast<std::ptrdiff_t>(turned), phases_.end());
  // The first phase, which is the continuation of the last one, stands after it.
  phases_.erase(phases_.end() - static_cast<std::ptrdiff_t>(turned));
  return true;
}

void DiscPhases::find_periodic(const Disc& disc, bool near_stick) {
  const double size = disc.motion_bound(0) + disc.radius_bound(0), same = same_slider * size;
  Eigen::Vector2d w = at_rest(disc, 0, start_).w;
  const double error = iterate(disc, same, w);
  periodic_ = error <= 1e3 * same;
  if (periodic_ && !near_stick && begin_at_slip_end()) return;
  // Once more from the end of slip: next to full stick it is more exact.
  const auto rest = std::find_if(phases_.begin(), phases_.end(), [](const DiscPhase& phase) {
    return phase.from == DiscPhase::Begin::slip_end;
  });
  if (rest == phases_.end()) {  // slip throughout
    if (phases_.size() == 1 || panels_.empty()) return;
    State state{true, w, panels_.back().to()};
    phases_.clear();
    panels_.swap(before_);
    panels_.clear();
    cursor_ = 0;
    march(disc, state, DiscPhase::Begin::start, 0, whole_turn, nullptr);
    return;
  }
  const DiscPhase first = *rest;
  phases_.clear();
  panels_.clear();
  before_.clear();
  cursor_ = 0;
  State state{false, first.w, 0};
  march(disc, state, DiscPhase::Begin::slip_end, first.begin, first.begin + whole_turn, nullptr);
}

const std::vector<DiscPhase>& DiscPhases::find(const Disc& disc,
                                               std::span<const std::pair<double, double>> closed,
                                               bool opens) {
  phases_.clear();
  panels_.clear();
  before_.clear();
  cursor_ = 0;
  full_stick_ = false;
  short_of_stick_ = 0;
  periodic_ = true;
  opens_ = opens;
  tolerance_ = resolved * disc.largest();
  if (closed.empty()) {
    phases_.push_back({DiscPhase::State::open, DiscPhase::Begin::opening, 0, whole_turn});
    return phases_;
  }
  if (opens) {
    for (std::size_t i = 0; i < closed.size(); ++i) {
      const auto [begin, end] = closed[i];
      State state = closing(disc, begin);
      march(disc, state, DiscPhase::Begin::closing, begin, end, nullptr);
      const double next = i + 1 < closed.size() ? closed[i + 1].first : closed[0].first + whole_turn;
      phases_.push_back({DiscPhase::State::open, DiscPhase::Begin::opening, end, next});
    }
    return phases_;
  }
  if (surely_slips(disc)) {
    find_periodic(disc, false);
    return phases_;
  }
  centre_.find(disc);
  full_stick_ = centre_.r() <= same_slider * disc.motion_bound(0);
  if (full_stick_) {
    short_of_stick_ = 0;
    DiscPhase phase{DiscPhase::State::stick, DiscPhase::Begin::start, 0, whole_turn};
    phase.w = centre_.w();
    phases_.push_back(phase);
  } else {
    short_of_stick_ = centre_.r();
    start_ = centre_.w();
    find_periodic(disc, true);
  }
  return phases_;
}

Eigen::Vector2d DiscPhases::stretch(const Disc& disc, double theta) const {
  const double begin = phases_.front().begin;
  theta -= std::floor((theta - begin) / whole_turn) * whole_turn;
  const auto after = std::upper_bound(phases_.begin(), phases_.end(), theta,
                                      [](double at, const DiscPhase& phase) { return at < phase.begin; });
  const DiscPhase& phase = after == phases_.begin() ? phases_.front() : *(after - 1);
  const DiscPoint p = disc.at(theta);
  if (phase.state == DiscPhase::State::open) return {0, 0};
  if (phase.state == DiscPhase::State::stick) return p.x - phase.w;
  std::size_t k = phase.first_panel;
  while (k + 1 < phase.last_panel && panels_[k].end < theta) ++k;
  const double at = std::clamp(theta, panels_[k].begin, panels_[k].end);
  return std::max(p.h, 0.0) * direction(collocation_.psi(panels_[k], at));
}

std::uint64_t DiscPhases::sequence() const {
  if (full_stick_) return 2 + centre_.active().size();
  std::uint64_t sum = 1;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const DiscPhase& next = phases_[i + 1 == phases_.size() ? 0 : i + 1];
    sum += mixed_bits(64 * disc_phase_code(phases_[i]) + disc_phase_code(next));
  }
  return sum;
}

void DiscPhases::tell(FrictionState& state) const {
  state.slip_onsets.clear();
  state.slip_ends.clear();
  double stuck = 0, open = 0;
  const auto wrapped = [](double angle) { return angle - std::floor(angle / whole_turn) * whole_turn; };
  for (const DiscPhase& phase : phases_) {
    if (phase.state == DiscPhase::State::stick) stuck += phase.end - phase.begin;
    if (phase.state == DiscPhase::State::open) open += phase.end - phase.begin;
    if (phase.state != DiscPhase::State::slip) continue;
    if (phases_.size() == 1) continue;  // throughout
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
  for (const DiscPhase& phase : phases_) {
    const bool open = phase.state == DiscPhase::State::open, stuck = phase.state == DiscPhase::State::stick;
    intervals.push_back({open ? "open" : stuck ? "stick" : "slip", phase.begin, phase.end});
  }
}

}  // namespace arcslip::elements
