#include <arcslip/time/march.hpp>

#include <arcslip/time/polynomial.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace arcslip::time {
namespace {

// Of a sum of size 1 after all the operations behind it.
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

constexpr long between_questions = 16;  // whether to go on, in pieces

}  // namespace

March::March(const EquationOfMotion& equation, const EventLimits& limits)
    : equation_(equation), limits_(limits), linear_(equation) {
  for (std::size_t e = 0; e < equation.elements.size(); ++e) {
    const Element& element = equation.elements[e];
    if (element.slider >= 0)
      frictions_.push_back(
          {static_cast<int>(e), element.slider, element.direction, element.stiffness, element.slip_limit});
  }
}

void March::begin(const State& start, double time, bool derivatives) {
  const Eigen::Index n = equation_.dofs(), sliders = equation_.sliders;
  const Eigen::Index columns = derivatives ? 1 + 2 * n + sliders : 1;
  X_.setZero(n, columns);
  V_.setZero(n, columns);
  Z_.setZero(sliders, columns);
  g_.setZero(static_cast<Eigen::Index>(equation_.elements.size()), columns);
  X_.col(0) = start.x;
  V_.col(0) = start.v;
  Z_.col(0) = start.z;
  if (derivatives) {
    X_.middleCols(1, n).setIdentity();
    V_.middleCols(1 + n, n).setIdentity();
    Z_.rightCols(sliders).setIdentity();
  }
  for (Friction& friction : frictions_) {
    friction.slip = 0;
    const auto e = static_cast<std::size_t>(friction.element);
    linear_.set_stuck(e, friction.stuck());
    if (!friction.stuck()) continue;
    const double q = friction.direction.dot(start.x);
    auto z = Z_.row(friction.slider);
    const double reach = friction.limit / friction.stiffness;  // infinite without stiffness: never slips
    if (std::abs(q - z[0]) > reach) z[0] = q - std::copysign(reach, q - z[0]);
    g_.row(friction.element) = friction.stiffness * z;
  }
  t_ = from_ = time;
  events_ = pieces_ = 0;
  moved_ = false;
  reason_ = EndReason::reached;
}

bool March::find(double to) {
  if (!(t_ < to)) return false;
  if (events_ >= limits_.events) reason_ = EndReason::events;
  if (pieces_++ >= limits_.pieces || !(t_ + linear_.longest() > t_)) reason_ = EndReason::pieces;
  if (!X_.allFinite() || !V_.allFinite()) reason_ = EndReason::not_finite;
  if (limits_.stop && pieces_ % between_questions == 0 && limits_.stop()) reason_ = EndReason::stopped;
  if (reason_ != EndReason::reached) return false;
  end_ = std::min(t_ + linear_.longest(), to);
  h_ = end_ - t_;  // of the rounded time, or the force would lead or lag by more with every piece
  linear_.expand(t_, h_, X_, V_, g_);
  locate();
  return true;
}

// The first event on the piece; of several in one instant, one, and the others at the start of the next
// piece.
void March::locate() {
  s_ = 1;
  event_.reset();
  const auto look = [&](std::size_t i, double size, int direction) {
    const auto s = first_fall(guard_, rounding * size);
    if (!s || (event_ && *s >= s_)) return;
    s_ = *s;
    switching_ = i;
    const bool onset = frictions_[i].stuck();
    event_ = {t_ + s_ * h_, frictions_[i].element, onset ? EventKind::slip_onset : EventKind::slip_end,
              direction};
  };
  for (std::size_t i = 0; i < frictions_.size(); ++i) {
    const Friction& friction = frictions_[i];
    if (friction.free()) continue;
    if (friction.slip != 0) {
      const double size = linear_.velocity(friction.direction, guard_);
      for (double& c : guard_) c *= friction.slip;
      look(i, size, friction.slip);
      continue;
    }
    // mu F_n - sigma k_d (q - z), for both signs
    const double offset = g_(friction.element, 0);
    const double size = friction.stiffness * linear_.displacement(friction.direction, guard_) +
                        std::abs(offset) + friction.limit;
    for (double& c : guard_) c *= -friction.stiffness;
    guard_[0] += offset + friction.limit;
    look(i, size, 1);
    for (double& c : guard_) c = -c;
    guard_[0] += 2 * friction.limit;
    look(i, size, -1);
  }
  recorded_ = event_ && (moved_ || s_ > 0);
}

void March::finish() {
  if (s_ > 0) {
    linear_.at(s_, X_, V_);
    moved_ = true;
  }
  t_ = piece_end();
  if (!event_) return;
  ++events_;
  switch_contact(frictions_[switching_]);
}

void March::switch_contact(Friction& friction) {
  const Eigen::Index e = friction.element;
  if (friction.slip == 0) {
    friction.slip = event_->direction;
    g_.row(e).setZero();
    g_(e, 0) = -friction.slip * friction.limit;
  } else {
    Z_.row(friction.slider) = friction.direction.transpose() * X_;
    Z_(friction.slider, 0) -= friction.slip * friction.limit / friction.stiffness;
    friction.slip = 0;
    g_.row(e) = friction.stiffness * Z_.row(friction.slider);
  }
  linear_.set_stuck(static_cast<std::size_t>(e), friction.stuck());
}

double March::slider(const Friction& friction, double q) const {
  if (friction.stuck()) return Z_(friction.slider, 0);
  return friction.free() ? q : q - friction.slip * friction.limit / friction.stiffness;
}

double March::force(const Friction& friction, double q) const {
  if (friction.stuck()) return friction.stiffness * (q - Z_(friction.slider, 0));
  return friction.slip * friction.limit;
}

State March::state() const {
  State state{X_.col(0), V_.col(0), Z_.col(0)};
  for (const Friction& friction : frictions_)
    state.z[friction.slider] = slider(friction, friction.direction.dot(state.x));
  return state;
}

double March::size() const {
  return std::hypot(X_.col(0).norm(), V_.col(0).norm() / equation_.omega);
}

Matrix March::monodromy() const {
  const Eigen::Index n = X_.rows(), sliders = Z_.rows();
  Matrix M(2 * n + sliders, 2 * n + sliders);
  M.topRows(n) = X_.rightCols(M.cols());
  M.middleRows(n, n) = V_.rightCols(M.cols());
  M.bottomRows(sliders) = Z_.rightCols(M.cols());
  for (const Friction& friction : frictions_)
    if (!friction.stuck())
      M.row(2 * n + friction.slider) = friction.direction.transpose() * X_.rightCols(M.cols());
  return M;
}

std::string March::message() const {
  std::ostringstream text;
  text.precision(10);
  switch (reason_) {
    case EndReason::reached:
      text << "reached the end of the interval at " << t_ << " s";
      break;
    case EndReason::events:
      text << events_ << " events (the limit) up to " << t_
           << " s: the contact chatters, or the interval is long";
      break;
    case EndReason::pieces:
      text << pieces_ - 1 << " pieces (limit " << limits_.pieces << ") up to " << t_ << " s, each at most "
           << linear_.longest()
           << " s: the fastest mode or the strongest damper is much faster than the interval";
      break;
    case EndReason::not_finite:
      text << "the motion is no longer finite at " << t_ << " s";
      break;
    case EndReason::stopped:
      text << "stopped as asked, at " << t_ << " s";
      break;
  }
  return text.str();
}

}  // namespace arcslip::time
