#include <arcslip/stability/planar_slip_along.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::time {
namespace {

using Eigen::Vector2d;

constexpr double cut_angle = 1e-6;     // rad, of an opening or a closing
constexpr double cut_share = 1e-3;     // of a phase, at most
constexpr double fast = 300;           // g, over the fastest frequency: beyond, slip relaxes
constexpr double fastest_of_all = 30;  // rad/rad that count for this
constexpr double steady = 0.05;        // |r'| in relaxed slip, at most
constexpr double forgotten = 40;       // the integral of g over a beginning that is
constexpr double first_step = 1e-10;   // rad, of this integral

Vector2d direction(double psi) {
  return {std::cos(psi), std::sin(psi)};
}

double within_turn(double theta) {
  const double rest = std::fmod(theta, elements::whole_turn);
  return rest < 0 ? rest + elements::whole_turn : rest;
}

}  // namespace

bool DiscCourse::follow(const elements::Harmonics& harmonics, const Matrix& q, double fastest) {
  fast_ = fast * std::clamp(fastest, 1.0, fastest_of_all);
  phases_.clear();
  changes_.clear();
  breaks_.clear();
  if (!q.allFinite()) return false;
  if (!of_ || of_->disc.harmonics() != harmonics) of_.emplace(harmonics);
  auto& [normal, disc, found] = *of_;
  normal.move_to(q.col(2), contact_.k_n, contact_.N_0);
  disc.set(q.col(0), q.col(1), contact_.mu / contact_.k_t * normal.load());
  if (!std::isfinite(disc.motion_bound(3) + disc.radius_bound(3) + disc.largest())) return false;
  full_stick_ = false;
  if (disc.largest() > 0) {
    for (const elements::DiscPhase& each : found.find(disc, normal.closed(), normal.opens()))
      add(each.state, each.begin, each.end, each.first_panel, each.last_panel);
    full_stick_ = found.full_stick();
  } else {
    add_without_friction(normal.closed());
  }
  for (std::size_t k = 0; k < phases_.size() && phases_.size() > 1; ++k) {
    changes_.push_back(within_turn(phases_[k].begin));
    if (has_friction(phases_[k])) cut_ends(k);
  }
  return true;
}

// Slip where the contact is closed.
void DiscCourse::add_without_friction(std::span<const std::pair<double, double>> closed) {
  for (const auto& [begin, end] : closed) {
    if (!phases_.empty()) add(State::open, phases_.back().end, begin);
    add(State::slip, begin, end);
  }
  const double first = phases_.empty() ? 0 : phases_.front().begin;
  const double last = phases_.empty() ? 0 : phases_.back().end;
  if (last < first + elements::whole_turn) add(State::open, last, first + elements::whole_turn);
}

// Leaves out the ends of a phase next to openings and closings, and finds where its slip has settled.
void DiscCourse::cut_ends(std::size_t k) {
  const std::size_t count = phases_.size();
  Phase& phase = phases_[k];
  const double cut = std::min(cut_angle, cut_share * (phase.end - phase.begin));
  if (phases_[k == 0 ? count - 1 : k - 1].state == State::open) phase.from += cut;
  if (phases_[k + 1 == count ? 0 : k + 1].state == State::open) phase.to -= cut;
  if (phase.from > phase.begin)
    breaks_.push_back(within_turn(phase.from));
  else
    phase.settled = settled_from(phase);
  if (phase.to < phase.end) breaks_.push_back(within_turn(phase.to));
  if (phase.settled > phase.begin && phase.settled < phase.to) breaks_.push_back(within_turn(phase.settled));
}

// By longer and longer steps.
double DiscCourse::settled_from(const Phase& phase) const {
  double sum = 0, theta = phase.begin;
  for (double step = first_step; theta < phase.to; step *= 2) {
    sum += step * slip_at({&phase, std::min(theta + 0.5 * step, phase.to)}).g;
    theta += step;
    if (sum >= forgotten) return theta;
  }
  return phase.end;
}

void DiscCourse::add(State state, double begin, double end, std::size_t first_panel, std::size_t last_panel) {
  phases_.push_back({state, begin, end, first_panel, last_panel, begin, end, begin});
}

DiscCourse::Place DiscCourse::place_of(double theta) const {
  const double begin = phases_.front().begin;
  theta -= std::floor((theta - begin) / elements::whole_turn) * elements::whole_turn;
  const auto after = std::upper_bound(phases_.begin(), phases_.end(), theta,
                                      [](double angle, const Phase& phase) { return angle < phase.begin; });
  const Phase& phase = after == phases_.begin() ? phases_.front() : *(after - 1);
  return {&phase, std::min(theta, phase.end)};
}

// n, in slip.
Vector2d DiscCourse::normal_at(const Phase& phase, double theta) const {
  std::size_t k = phase.first_panel;
  while (k + 1 < phase.last_panel && of_->phases.panel(k).end < theta) ++k;
  const elements::SlipPanel& panel = of_->phases.panel(k);
  return direction(of_->phases.collocation().psi(panel, std::clamp(theta, panel.begin, panel.end)));
}

int DiscCourse::free_at(double theta) const {
  if (full_stick_) return 0;
  const Phase& phase = *place_of(theta).phase;
  if (phase.state == State::stick) return 2;
  return phase.state == State::slip && has_friction(phase) ? 1 : 0;
}

DiscCourse::Slip DiscCourse::slip_at(const Place& place) const {
  const auto& [phase, theta] = place;
  Slip slip{};
  slip.n = normal_at(*phase, theta);
  slip.t = elements::quarter_turn(slip.n);
  const elements::DiscPoint p = of_->disc.at(theta);
  slip.nearby = slip.relaxes = theta < phase->from || theta > phase->to || !(p.h > 0);
  if (slip.nearby) return slip;
  const double across = slip.t.dot(p.v), speed = std::max(slip.n.dot(p.v) - p.dh, 0.0);
  slip.g = speed / p.h;
  slip.turning = across / p.h;
  slip.turning_rate = (slip.t.dot(p.a) - slip.turning * (slip.n.dot(p.v) + p.dh)) / p.h;
  if (!(speed > 0)) return slip;
  const double gain = slip.n.dot(p.a) + slip.turning * across - p.ddh;
  const double r = p.h / speed, rate = (p.dh - r * gain) / speed;
  slip.relaxes = slip.g >= fast_ && theta >= phase->settled && std::abs(rate) <= steady;
  slip.first = r / (1 + rate);
  slip.second = r * r / ((1 + rate) * (1 + 2 * rate));
  return slip;
}

void DiscCourse::at(double angle, Values& values) const {
  values.by_q.setZero();
  values.by_memory.setZero();
  values.rate_by_q.setZero();
  values.rate_by_memory.setZero();
  values.relaxes = false;
  const Place place = place_of(angle);
  const Phase& phase = *place.phase;
  if (phase.state == State::open) return;
  const double k_t = contact_.k_t, by_normal = radius_by_normal();
  values.by_q(2, 2) = contact_.k_n;
  if (phase.state == State::stick) {
    values.by_q.topLeftCorner<2, 2>().diagonal().setConstant(k_t);
    values.by_memory.topRows<2>().diagonal().setConstant(-k_t);
    return;
  }
  if (!has_friction(phase)) return;
  const Slip slip = slip_at(place);
  const auto& [n, t, g, turning, turning_rate, first, second, is_nearby, relaxes] = slip;
  values.by_q.col(2).head<2>() = contact_.mu * contact_.k_n * n;
  values.relaxes = relaxes;
  values.relaxed_by_q = values.by_q;
  values.by_v.setZero();
  values.by_a.setZero();
  if (relaxes) {  // S' = t.dx'' - psi' n.dx' - psi'' dh - psi' dh'
    values.relaxed_by_q.col(2).head<2>() += k_t * by_normal * (second * turning_rate - first * turning) * t;
    values.by_v.topLeftCorner<2, 2>() = k_t * t * (first * t + second * turning * n).transpose();
    values.by_v.col(2).head<2>() = k_t * by_normal * second * turning * t;
    values.by_a.topLeftCorner<2, 2>() = -k_t * second * t * t.transpose();
  }
  if (is_nearby) return;
  values.by_q.topLeftCorner<2, 2>() = k_t * t * t.transpose();
  values.by_memory.col(0).head<2>() = k_t * t;
  values.rate_by_memory(0, 0) = -g;
  values.rate_by_q.row(0) << (turning * n - g * t).transpose(), -turning * by_normal;
}

void DiscCourse::relax(double theta, const Matrix& dq, const Matrix& dv, const Matrix& da,
                       Matrix& memory) const {
  const Place place = place_of(theta);
  memory.setZero();
  if (!has_friction(*place.phase)) return;  // at its opening
  const Slip slip = slip_at(place);
  const double h = radius_by_normal();
  const Vector S = dv.leftCols<2>() * slip.t - h * slip.turning * dq.col(2);
  const Vector rate = da.leftCols<2>() * slip.t - slip.turning * (dv.leftCols<2>() * slip.n) -
                      h * (slip.turning_rate * dq.col(2) + slip.turning * dv.col(2));
  memory.col(0) = slip.first * S - slip.second * rate - dq.leftCols<2>() * slip.t;
}

void DiscCourse::pass(std::size_t change, const Matrix& dq, Matrix& memory) const {
  const Phase &from = phases_[change == 0 ? phases_.size() - 1 : change - 1], &to = phases_[change];
  if (from.state == to.state) return;
  if (to.state == State::open || !(has_friction(to) || to.state == State::stick)) {
    memory.setZero();
    return;
  }
  const auto dx = dq.leftCols<2>();
  if (to.state == State::slip) {
    const Vector2d t = elements::quarter_turn(normal_at(to, to.begin));
    memory.col(0) = -((from.state == State::stick ? memory : Matrix(dx)) * t).eval();
    memory.col(1).setZero();
    return;
  }
  const Vector dh = radius_by_normal() * dq.col(2);
  if (from.state == State::slip) {
    const Vector2d n = normal_at(from, from.end), t = elements::quarter_turn(n);
    const Vector y = memory.col(0);
    memory = (dx * n - dh) * n.transpose() - y * t.transpose();
    return;
  }
  const elements::DiscPoint p = of_->disc.at(to.begin);
  memory = dx;
  if (p.dh > 0) memory -= dh * (p.v / p.dh).transpose();
}

}  // namespace arcslip::time
