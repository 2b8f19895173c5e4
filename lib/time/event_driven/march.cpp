#include <arcslip/time/event_driven/march.hpp>

#include <arcslip/time/event_driven/polynomial_roots.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace arcslip::time {
namespace {

constexpr long pieces_per_question = 16;  // whether to go on, in pieces,
constexpr double long_piece = 1e7;        // and before each of more multiplications: some 10 ms

std::vector<Contact> contacts_of(const EquationOfMotion& equation) {
  std::vector<Contact> contacts;
  Eigen::Index row = 0;
  for (std::size_t e = 0; e < equation.elements.size(); ++e) {
    const TimeElement& element = equation.elements[e];
    auto automata = element.law->automata(element.fields);
    if (!automata)
      throw NotPiecewiseLinear("event-driven integration requires piecewise linear laws: the element \"" +
                               element.name + "\" is not");
    for (auto& automaton : *automata) {
      const int k = automaton.memory;
      std::vector<Vector> along(element.directions.colwise().begin(), element.directions.colwise().end());
      Contact& contact = contacts.emplace_back(Contact{static_cast<int>(e),
                                                       std::move(automaton),
                                                       element.directions,
                                                       std::move(along),
                                                       row,
                                                       -1,
                                                       -1,
                                                       {},
                                                       {}});
      if (k >= 0) {
        const elements::Slider slider = elements::slider_of(contact.automaton);
        contact.memory = element.memory + k;
        contact.slider = slider.direction;
        contact.lower = element.directions * slider.lower.transpose();
        contact.upper = element.directions * slider.upper.transpose();
        contact.room = slider.room;
        contact.centre = slider.centre;
      }
      row += element.directions.cols();
    }
  }
  return contacts;
}

std::vector<LinearMotion::Part> parts_of(const std::vector<Contact>& contacts) {
  std::vector<LinearMotion::Part> parts;
  for (const Contact& contact : contacts) {
    parts.push_back({contact.directions, {}});
    for (const auto& mode : contact.automaton.modes) parts.back().stiffnesses.push_back(mode.f_q);
  }
  return parts;
}

}  // namespace

March::March(const EquationOfMotion& equation, const EventLimits& limits)
    : equation_(equation),
      limits_(limits),
      contacts_(contacts_of(equation)),
      linear_(equation, parts_of(contacts_), limits.control) {
  std::size_t most = 0;
  for (const Contact& contact : contacts_) most = std::max(most, contact.along.size());
  displacement_.resize(most);
  velocity_.resize(most);
}

void March::begin(const MotionState& start, double time, Columns carried, const EquationRates* by) {
  const Eigen::Index n = equation_.dofs(), memory = equation_.memory;
  const bool derivatives = carried != Columns::motion;
  const Eigen::Index columns = derivatives ? 1 + 2 * n + memory + (by ? 1 : 0) : 1;
  linear_.vary(by);
  X_.setZero(n, columns);
  V_.setZero(n, columns);
  Z_.setZero(memory, columns);
  X_.col(0) = start.x;
  V_.col(0) = start.v;
  Z_.col(0) = start.z;
  if (derivatives) {
    X_.middleCols(1, n).setIdentity();
    V_.middleCols(1 + n, n).setIdentity();
    Z_.middleCols(1 + 2 * n, memory).setIdentity();
  }
  for (const TimeElement& element : equation_.elements) {
    const int own = element.law->memory();
    elements::StepEnd at(element.law->directions(), own);
    Vector z = Z_.col(0).segment(element.memory, own);
    element.law->in_time(element.fields)->begin(element.directions.transpose() * start.x, z, at);
    Z_.col(0).segment(element.memory, own) = z;
  }
  g_.setZero(contacts_.empty() ? 0 : contacts_.back().row + contacts_.back().directions.cols(), columns);
  std::size_t of_element = 0;  // automaton
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& contact = contacts_[i];
    of_element = i > 0 && contacts_[i - 1].element == contact.element ? of_element + 1 : 0;
    const ElementRates* rates = by ? &by->elements[static_cast<std::size_t>(contact.element)] : nullptr;
    const bool changes = rates && !rates->automata.empty();
    contact.rates = changes ? &rates->automata[of_element] : nullptr;
    contact.slider_rates = changes && contact.slider >= 0 ? &rates->sliders[of_element] : nullptr;
    contact.now = 0;
    if (derivatives && contact.slider >= 0 && Z_(contact.memory, 0) != start.z[contact.memory]) draw(contact);
    enter(contact);
  }
  t_ = from_ = time;
  events_ = pieces_ = 0;
  moved_ = false;
  reason_ = EndReason::reached;
}

// A slider that TimeLaw::begin() moved to its limit is where it is when it follows there.
void March::draw(const Contact& contact) {
  const Vector q = contact.directions.transpose() * X_.col(0);
  const auto& modes = contact.automaton.modes;
  const auto distance = [&](const elements::Mode& mode) {
    return mode.rests ? std::numeric_limits<double>::infinity()
                      : std::abs(mode.z_q.dot(q.transpose()) + mode.z_0 - Z_(contact.memory, 0));
  };
  const auto nearest = std::min_element(
      modes.begin(), modes.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (nearest->rests) return;
  auto by = Z_.row(contact.memory).tail(Z_.cols() - 1);
  by = nearest->z_q * (contact.directions.transpose() * X_.rightCols(X_.cols() - 1));
  if (!contact.rates) return;
  const elements::Mode& rates = contact.rates->modes[static_cast<std::size_t>(nearest - modes.begin())];
  by[by.size() - 1] += rates.z_q.dot(q.transpose()) + rates.z_0;
}

// The force independent of the displacement within a mode: that of its memory if it rests, otherwise that of
// the memory at q = 0.
void March::enter(Contact& contact) {
  const elements::Mode& mode = contact.mode();
  auto g = g_.middleRows(contact.row, contact.directions.cols());
  g.setZero();
  g.col(0) = -mode.f_0;
  if (contact.memory >= 0 && mode.rests) g.noalias() -= mode.f_z * Z_.row(contact.memory);
  const elements::Mode* rates = contact.mode_rates();
  if (rates) {
    g.rightCols(1) -= rates->f_0;
    if (contact.memory >= 0 && mode.rests) g.rightCols(1) -= rates->f_z * Z_(contact.memory, 0);
  }
  linear_.set_stiffness(static_cast<std::size_t>(&contact - contacts_.data()), mode.f_q,
                        rates ? &rates->f_q : nullptr);
}

bool March::find(double to) {
  if (!(t_ < to)) return false;
  if (linear_.stopped()) {
    reason_ = EndReason::stopped;
    return false;
  }
  if (events_ >= limits_.events) reason_ = EndReason::events;
  if (pieces_++ >= limits_.pieces || !(t_ + linear_.longest() > t_)) reason_ = EndReason::pieces;
  if (!X_.allFinite() || !V_.allFinite()) reason_ = EndReason::not_finite;
  const double multiplications =
      2.0 * LinearMotion::order * static_cast<double>(X_.rows()) * static_cast<double>(X_.size());
  const bool asks = multiplications > long_piece || pieces_ % pieces_per_question == 0;
  if (asks && !limits_.control.keep_going()) reason_ = EndReason::stopped;
  if (reason_ != EndReason::reached) return false;
  end_ = std::min(t_ + linear_.longest(), to);
  h_ = end_ - t_;  // of the rounded time, or the force would lead or lag by more with every piece
  if (!linear_.expand(t_, h_, X_, V_, g_, limits_.control)) {
    reason_ = EndReason::stopped;
    return false;
  }
  locate();
  return true;
}

// The first event on the piece; of several at the same instant one, and the others at the start of the
// next piece.
void March::locate() {
  s_ = 1;
  event_.reset();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    const auto& leaves = contact.mode().leaves;
    for (std::size_t k = 0; k < contact.along.size(); ++k) displacement_[k].made = velocity_[k].made = false;
    for (const elements::Guard& guard : leaves) {
      const bool follows = contact.follows();
      const double by_memory = contact.memory < 0 ? 0 : guard.z;
      const double z = by_memory == 0 ? 0 : follows ? contact.mode().z_0 : Z_(contact.memory, 0);
      const double offset = guard.c + by_memory * z;
      double size = std::abs(guard.c) + std::abs(offset - guard.c);
      guard_.fill(0);
      const auto add = [&](double factor, Sized& part, auto series_of, const Vector& d) {
        if (factor == 0) return;
        if (!part.made) part.size = (linear_.*series_of)(d, part.series);
        part.made = true;
        size += std::abs(factor) * part.size;
        for (std::size_t j = 0; j < guard_.size(); ++j) guard_[j] += factor * part.series[j];
      };
      for (std::size_t k = 0; k < contact.along.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        const double by_q = (guard.q.size() > 0 ? guard.q[at] : 0) +
                            (follows && by_memory != 0 ? by_memory * contact.mode().z_q[at] : 0);
        add(by_q, displacement_[k], &LinearMotion::displacement, contact.along[k]);
        if (guard.v.size() > 0) add(guard.v[at], velocity_[k], &LinearMotion::velocity, contact.along[k]);
      }
      guard_[0] += offset;
      const auto s = first_fall(guard_, sum_rounding * size);
      if (!s || (event_ && *s >= s_)) continue;
      s_ = *s;
      switching_ = i;
      leaving_ = &guard;
      event_ = {t_ + s_ * h_, contact.element, contact.mode().name,
                contact.automaton.modes[static_cast<std::size_t>(guard.to)].name};
    }
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
  Contact& contact = contacts_[switching_];
  if (contact.follows()) settle(contact);
  contact.now = leaving_->to;
  enter(contact);
}

// The memory that followed, at the instant of the event. Where that instant moves, by -dg/g', z moves along.
void March::settle(const Contact& contact) {
  const elements::Mode& mode = contact.mode();
  auto z = Z_.row(contact.memory);
  z.setZero();
  double rate = 0, guard_rate = 0;
  const bool at_rest = leaving_->v.size() > 0 && !leaving_->v.isZero(0);  // a guard of the memory's velocity
  if (V_.cols() > 1) change_.setZero(V_.cols());
  for (std::size_t k = 0; k < contact.along.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const Vector& d = contact.along[k];
    z.noalias() += mode.z_q[at] * d.transpose() * X_;
    if (V_.cols() == 1 || at_rest) continue;
    const double by_q = (leaving_->q.size() > 0 ? leaving_->q[at] : 0) + leaving_->z * mode.z_q[at];
    rate += mode.z_q[at] * d.dot(V_.col(0));
    guard_rate += by_q * d.dot(V_.col(0));
    change_.noalias() += by_q * d.transpose() * X_;
  }
  if (const elements::Mode* rates = contact.mode_rates()) {
    const elements::Guard& guard = rates->leaves[static_cast<std::size_t>(leaving_ - mode.leaves.data())];
    const Vector q = contact.directions.transpose() * X_.col(0);
    const double by_mode = rates->z_q.dot(q.transpose()) + rates->z_0;
    z[z.size() - 1] += by_mode;
    if (!at_rest) {
      const double memory = mode.z_q.dot(q.transpose()) + mode.z_0;
      change_[z.size() - 1] += (guard.q.size() > 0 ? guard.q.dot(q.transpose()) : 0) + guard.z * memory +
                               leaving_->z * by_mode + guard.c;
    }
  }
  if (rate != 0 && guard_rate != 0) z.tail(z.size() - 1) -= rate / guard_rate * change_.tail(z.size() - 1);
  z[0] += mode.z_0;
}

double March::memory(const Contact& contact, const Vector& q) const {
  if (!contact.follows()) return Z_(contact.memory, 0);
  return contact.mode().z_q.dot(q.transpose()) + contact.mode().z_0;
}

double March::force(const Contact& contact, const Vector& q) const {
  const elements::Mode& mode = contact.mode();
  const double by_memory = contact.memory >= 0 && mode.rests ? mode.f_z[0] * Z_(contact.memory, 0) : 0;
  return mode.f_q.row(0).dot(q.transpose()) + by_memory + mode.f_0[0];
}

MotionState March::state() const {
  MotionState state{X_.col(0), V_.col(0), Z_.col(0)};
  for (const Contact& contact : contacts_)
    if (contact.follows())
      state.z[contact.memory] = memory(contact, contact.directions.transpose() * state.x);
  return state;
}

double March::size() const {
  return std::hypot(X_.col(0).norm(), V_.col(0).norm() / equation_.omega);
}

Matrix March::monodromy() const {
  const Eigen::Index n = X_.rows(), memory = Z_.rows();
  Matrix M(2 * n + memory, 2 * n + memory);
  M.topRows(n) = X_.middleCols(1, M.cols());
  M.middleRows(n, n) = V_.middleCols(1, M.cols());
  M.bottomRows(memory) = Z_.middleCols(1, M.cols());
  for (const Contact& contact : contacts_)
    if (contact.follows())
      M.row(2 * n + contact.memory) =
          contact.mode().z_q * (contact.directions.transpose() * X_.middleCols(1, M.cols()));
  return M;
}

Vector March::by_parameter(double rate) const {
  const Eigen::Index n = X_.rows(), memory = Z_.rows(), last = X_.cols() - 1;
  Vector end(2 * n + memory);
  end.head(n) = X_.col(last) + rate * V_.col(0);
  end.segment(n, n) = V_.col(last) + rate * linear_.acceleration(s_);
  end.tail(memory) = Z_.col(last);
  for (const Contact& contact : contacts_)
    if (contact.follows())
      end[2 * n + contact.memory] = contact.mode().z_q.dot(contact.directions.transpose() * end.head(n));
  for (const Contact& contact : contacts_)
    if (const elements::Mode* rates = contact.mode_rates(); rates && contact.follows())
      end[2 * n + contact.memory] += rates->z_q.dot(contact.directions.transpose() * X_.col(0)) + rates->z_0;
  return end;
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
      text << "stopped by the caller at " << t_ << " s";
      break;
  }
  return text.str();
}

}  // namespace arcslip::time
