#include <arcslip/laws/contact/planar_phases.hpp>

#include <arcslip/laws/contact/slip_onset.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::elements {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double resolved = 1e-8;     // of h psi within a panel, of the largest radius
constexpr double same_end = 1e-6;     // rad: slip that ends so near to the end of the period began it
constexpr double edge = 1e-12;        // of the radius: a slider that is so close is at the edge
constexpr double first_turn = 2.5;    // rad
constexpr double least_first = 1e-3;  // of the longest panel
constexpr double exact_end = 1e-10;   // of the length of the panel where slip ends
constexpr int end_steps = 5;
constexpr double phase_per_panel = 4;  // rad, of the highest harmonic
constexpr std::size_t most_panels = 20000;

Eigen::Vector2d direction(double psi) {
  return {std::cos(psi), std::sin(psi)};
}
Eigen::Vector2d across(double psi) {
  return {-std::sin(psi), std::cos(psi)};
}

}  // namespace

DiscMarch::DiscMarch(const Harmonics& harmonics)
    : harmonics_(harmonics), longest_(phase_per_panel / harmonics.order) {
  phases_.reserve(static_cast<std::size_t>(16 * harmonics.order + 64));
  panels_.reserve(static_cast<std::size_t>(8 * harmonics.order + 64));
  before_.reserve(panels_.capacity());
}

void DiscMarch::clear() {
  phases_.clear();
  panels_.clear();
  before_.clear();
  cursor_ = 0;
}

void DiscMarch::begin(const Disc& disc, bool opens) {
  clear();
  opens_ = opens;
  tolerance_ = resolved * disc.largest();
}

void DiscMarch::again() {
  phases_.clear();
  panels_.swap(before_);
  panels_.clear();
  cursor_ = 0;
}

DiscMarch::State DiscMarch::closing(const Disc& disc, double theta) const {
  const DiscPoint at = disc.at(theta);
  if (at.v.norm() <= at.dh) return {false, at.x, 0};
  return {true, at.x, std::atan2(at.v[1], at.v[0])};
}

DiscMarch::State DiscMarch::at_rest(const Disc& disc, double theta, const Eigen::Vector2d& w) const {
  const DiscPoint at = disc.at(theta);
  const Eigen::Vector2d y = at.x - w;
  const double d = y.norm();
  if (d < at.h * (1 - edge)) return {false, w, 0};
  const double psi = std::atan2(y[1], y[0]);
  const Eigen::Vector2d n = direction(psi), edge = at.x - at.h * n;
  return {n.dot(at.v) > at.dh, edge, psi};
}

// x'.n - h' within a panel, and its slope.
std::pair<double, double> DiscMarch::spare(const Disc& disc, const SlipPanel& panel, double theta) const {
  const DiscPoint p = disc.at(theta);
  const double psi = collocation_.psi(panel, theta);
  const Eigen::Vector2d n = direction(psi);
  const double turning = across(psi).dot(p.v);  // h psi'
  return {n.dot(p.v) - p.dh, n.dot(p.a) - p.ddh + (p.h > 0 ? turning * turning / p.h : 0)};
}

// Where the speed of slip first becomes negative in a panel, if it does: at a node, or in a dip between two.
std::optional<DiscMarch::Bracket> DiscMarch::end_of_slip(const Disc& disc, const SlipPanel& panel) const {
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
double DiscMarch::root_in(const Disc& disc, const SlipPanel& panel, const Bracket& bracket) const {
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
const SlipPanel* DiscMarch::known_near(double theta) {
  while (cursor_ < before_.size() && before_[cursor_].end <= theta + 0.2 * before_[cursor_].length())
    ++cursor_;
  if (cursor_ == before_.size() || before_[cursor_].begin > theta + 0.2 * before_[cursor_].length())
    return nullptr;
  return &before_[cursor_];
}

// Over which the direction of slip may turn by about one rad.
double DiscMarch::first_length(const Disc& disc, double theta) const {
  const DiscPoint p = disc.at(theta);
  const double speed = p.v.norm(), rate = std::abs(p.dh), width = std::max(p.h, 0.0);
  const double slowest =
      (speed > 0 ? p.a.norm() / speed : 0) + (width > 0 ? (speed + rate) / (width + 0.5 * rate) : 0);
  return slowest > 0 ? std::clamp(first_turn / slowest, least_first * longest_, longest_) : longest_;
}

double DiscMarch::solve(const Disc& disc, const SlipPanel* known, double theta, double to, double psi) {
  SlipPanel& panel = panels_.back();
  if (known != nullptr) {
    const double tail = collocation_.solve_near(disc, *known, theta, to, psi, tolerance_, panel);
    if (tail <= tolerance_) return tail;
  }
  return collocation_.solve(disc, theta, to, psi, tolerance_, panel);
}

// Makes the last panel end where slip ends, which is near an angle. False: it could not be followed so far.
bool DiscMarch::close_slip(const Disc& disc, double root) {
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
bool DiscMarch::add_panel(const Disc& disc, double theta, double end, double psi, Lengths& lengths) {
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
double DiscMarch::decay_exponent(const SlipPanel& panel) const {
  const SlipPanel::Nodes weights = collocation_.weights(panel);
  double exponent = 0;
  for (int j = 0; j < panel_nodes; ++j)
    exponent += panel.h[j] > 0 ? weights[j] * panel.spare[j] / panel.h[j] : never;
  return std::max(exponent, 0.0);
}

// From the state at `begin` until slip ends, or to `end`. decay: of a change of w across n.
double DiscMarch::slip(const Disc& disc, State& state, double begin, double end, double& decay, bool& ends) {
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

void DiscMarch::march(const Disc& disc, State& state, DiscPhase::Begin from, double begin, double end,
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
Eigen::Vector2d DiscMarch::displacement(const SlipPanel& panel) const {
  const SlipPanel::Nodes weights = collocation_.weights(panel);
  Eigen::Vector2d sum(0, 0);
  for (int j = 0; j < panel_nodes; ++j)
    sum += weights[j] * panel.spare[j] * Eigen::Vector2d(panel.outward[0][j], panel.outward[1][j]);
  return sum;
}

DiscMarch::Period DiscMarch::period(const Disc& disc, double begin, const Eigen::Vector2d& w) {
  again();
  State state = at_rest(disc, begin, w);
  Period map{{0, 0}, Eigen::Matrix2d::Identity()};
  march(disc, state, DiscPhase::Begin::start, begin, begin + whole_turn, &map.by);
  map.moved = state.moved;
  return map;
}

bool DiscMarch::begin_at_slip_end() {
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

Eigen::Vector2d DiscMarch::stretch(const Disc& disc, double theta) const {
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

}  // namespace arcslip::elements
