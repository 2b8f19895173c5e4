#include <arcslip/laws/hysteresis/masing_element.hpp>

#include <arcslip/laws/piece_hash.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
MasingElement::MasingElement(const Harmonics& h)
    : h_(h),
      loops_(h),
      moments_(h),
      over_(h.order),
      end_(h.order),
      length_(h.order),
      A_(h.size()),
      B_(h.size()),
      F_(h.size()),
      l_(h.size()),
      m_(h.size()),
      b_(h.size()),
      by_shape_{Eigen::VectorXd(h.size()), Eigen::VectorXd(h.size())},
      J_(h.size(), h.size()),
      L_(h.size(), 2 * h.order + 4),
      V_(h.size(), 2 * h.order + 4),
      turned_(static_cast<std::size_t>(2 * h.order + 1)),
      inverse_(2 * h.order + 1) {
  states_.reserve(static_cast<std::size_t>(4 * h.order + 32));
  inverse_[0] = 0;
  for (int k = 1; k < inverse_.size(); ++k) inverse_[k] = 1.0 / k;
}

void MasingElement::powers_less_one(double t, int count, Powers& w) {
  double *re = w.re.data(), *im = w.im.data();
  re[0] = im[0] = 0;
  if (count < 2) return;
  const double half = std::sin(0.5 * t);
  re[1] = -2 * half * half;
  im[1] = std::sin(t);
  for (int known = 1; known + 1 < count; known *= 2) {  // [1 .. known] are there
    const double a = re[known], b = im[known];
    const int more = std::min(known, count - 1 - known);
    for (int k = 1; k <= more; ++k) {
      re[known + k] = re[k] + a + (re[k] * a - im[k] * b);
      im[known + k] = im[k] + b + (re[k] * b + im[k] * a);
    }
  }
}

void MasingElement::add_interval(double length, double factor, const Powers& w, Powers& sum) const {
  const int more = h_.order;
  sum.re[0] += factor * length;
  sum.re.segment(1, more) += factor * inverse_.segment(1, more) * w.im.segment(1, more);
  sum.im.segment(1, more) -= factor * inverse_.segment(1, more) * w.re.segment(1, more);
}

void MasingElement::move_to(In u, std::span<const double> fields, bool jacobian) {
  scales_ = set(fields);
  A_.setZero();
  B_.setZero();
  for (auto& shape : by_shape_) shape.setZero();
  if (jacobian) J_.setZero();
  stuck_ = 0;
  piece_ = 0;
  const double first = 2 * first_slip() * unit(), reach = series_bound(h_, u, 0);
  const bool surely_stuck = h_.odd && 2 * reach <= first;
  if (!surely_stuck) loops_.find(u);
  const bool sticks = surely_stuck || loops_.parts().empty() || loops_.range() <= first;
  if (sticks && scales_.slip_force > 0) stick(u, jacobian);
  if (!sticks) slide(u, jacobian);
  F_ = scales_.stiffness * A_ + scales_.slip_force * B_;
}

void MasingElement::stick(In u, bool jacobian) {
  stuck_ = 1;
  piece_ = 1;
  A_ = u;
  if (jacobian) J_.diagonal().setConstant(scales_.stiffness);
  if (h_.odd) return;
  const bool moves = !loops_.anchors().empty();
  const Anchor none{0, u[0], 0, -1};
  const Anchor& high = moves ? loops_.anchors().front() : none;
  const Anchor& low = moves ? loops_.anchors()[static_cast<std::size_t>(loops_.lowest())] : none;
  piece_ += 1 + static_cast<std::uint64_t>(moves ? loops_.lowest() : 0);
  A_[0] -= 0.5 * (high.x + low.x);
  if (!jacobian) return;
  fill_basis(high.theta, l_);
  fill_basis(low.theta, m_);
  J_.row(0) -= 0.5 * scales_.stiffness * (l_ + m_).transpose();
}

void MasingElement::find_states() {
  const auto& anchors = loops_.anchors();
  states_.clear();
  for (const Anchor& to : anchors) {
    const bool outer = to.parent < 0;
    const auto parent = static_cast<std::size_t>(outer ? 0 : to.parent);
    const double way = outer ? loops_.range() : to.x - anchors[parent].x;
    const double half = 0.5 * std::abs(way);
    const Backbone there = at(y_of(half));
    if (outer) {
      states_.push_back({there.slope * half, there.rest, there.slope, there.by_shape});
      continue;
    }
    const State& from = states_[parent];
    const double twice = 2 * anchors[parent].way;
    State state{from.a + there.slope * way, from.b + twice * there.rest, there.slope, from.shapes};
    for (int k = 0; k < most_shapes; ++k) state.shapes[k] += twice * there.by_shape[k];
    states_.push_back(state);
  }
}

// How loops are nested and which kinks of the backbone each part has passed; parts without any do not count.
void MasingElement::find_piece() {
  piece_ = empty_hash;
  if (scales_.slip_force == 0) return;
  for (const BranchPart& part : loops_.parts()) {
    const std::uint64_t passed = level(y_of(0.5 * std::abs(part.end.x - anchor(part).x)));
    if (passed > 0) piece_ = hashed(piece_, passed);
  }
  if (!h_.odd && states_.front().slope > 0)
    piece_ = hashed(piece_, static_cast<std::uint64_t>(loops_.lowest()));
}

void MasingElement::slide(In u, bool jacobian) {
  const double kappa = (h_.odd ? 2 : 1) / std::numbers::pi;
  find_states();
  find_piece();
  moments_.clear();
  const auto count = static_cast<Eigen::Index>(states_.size());
  if (jacobian) {
    if (L_.cols() < count) {  // of a motion with reversals that are rounding
      L_.resize(Eigen::NoChange, 2 * count);
      V_.resize(Eigen::NoChange, 2 * count);
    }
    L_.leftCols(count).setZero();
    V_.leftCols(count).setZero();
  }
  for (const BranchPart& part : loops_.parts()) add(u, part, jacobian);
  moments_.close();
  A_ *= kappa;
  B_ *= kappa;
  for (auto& shape : by_shape_) shape *= kappa;
  moments_.times(u, kappa, A_);
  if (jacobian) {
    moments_.add_to(J_, kappa * scales_.stiffness);
    add_anchors();
  }
  stuck_ = std::clamp(stuck_ / h_.span(), 0.0, 1.0);
  if (h_.odd) return;
  A_[0] *= 0.5;
  B_[0] *= 0.5;
  for (auto& shape : by_shape_) shape[0] *= 0.5;
  if (jacobian) J_.row(0) *= 0.5;
}

// Integrals over a part, turned from t = 0 to the angle at which it begins.
void MasingElement::add(In u, const BranchPart& part, bool jacobian) {
  const double length = part.end.theta - part.begin.theta;
  const State& from = states_[static_cast<std::size_t>(part.anchor)];
  integrate(u, part, over_);
  powers(part.begin.theta, static_cast<int>(turned_.size()), turned_.data());
  stuck_ += over_.slope.re[0];
  for (int q = 0; q < moments_.count(); ++q) {
    const int k = q * h_.stride();
    const double re = over_.slope.re[k], im = over_.slope.im[k];
    const std::complex<double>& z = turned_[static_cast<std::size_t>(k)];
    moments_.add(q, re * z.real() - im * z.imag(), re * z.imag() + im * z.real());
  }
  powers_less_one(length, h_.order + 1, end_);
  length_.clear();
  add_interval(length, 1, end_, length_);
  turn(length_, l_);
  turn(over_.slope, m_);
  turn(over_.rest, b_);
  A_ += from.a * l_ - anchor(part).x * m_;
  B_ += b_ + from.b * l_;
  for (int k = 0; k < shapes(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    turn(over_.shapes[at], b_);
    by_shape_[at] += b_ + from.shapes[at] * l_;
  }
  if (!jacobian) return;
  L_.col(part.anchor) += l_;
  V_.col(part.anchor) -= m_;
}

// The part of the Jacobian behind G, one rank for each anchor, from the last to the first.
void MasingElement::add_anchors() {
  const auto& anchors = loops_.anchors();
  const double factor = (h_.odd ? 2 : 1) / std::numbers::pi * scales_.stiffness;
  for (auto i = static_cast<Eigen::Index>(anchors.size()) - 1; i > 0; --i) {
    const Eigen::Index parent = anchors[static_cast<std::size_t>(i)].parent;
    const double slope = states_[static_cast<std::size_t>(i)].slope;
    V_.col(i) += slope * L_.col(i);
    V_.col(parent) -= slope * L_.col(i);
    L_.col(parent) += L_.col(i);
  }
  const double half = 0.5 * states_.front().slope;
  V_.col(0) += half * L_.col(0);
  if (h_.odd)  // phi(theta + pi) = -phi(theta)
    V_.col(0) += half * L_.col(0);
  else
    V_.col(loops_.lowest()) -= half * L_.col(0);
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    fill_basis(anchors[i].theta, m_);
    J_.noalias() += (factor * V_.col(static_cast<Eigen::Index>(i))) * m_.transpose();
  }
}

// Integrals of phi from those of exp(i k t), with turned_ at the angle where t = 0.
void MasingElement::turn(const Powers& relative, Eigen::VectorXd& along) const {
  for (int i = 0; i < h_.cosines(); ++i) {
    const int n = h_.cosine_order(i);
    const std::complex<double>& z = turned_[static_cast<std::size_t>(n)];
    along[i] = relative.re[n] * z.real() - relative.im[n] * z.imag();
  }
  for (int j = 0; j < h_.sines(); ++j) {
    const int n = h_.sine_order(j);
    const std::complex<double>& z = turned_[static_cast<std::size_t>(n)];
    along[h_.cosines() + j] = relative.re[n] * z.imag() + relative.im[n] * z.real();
  }
}

void MasingElement::fill_basis(double theta, Out phi) {
  powers(theta, h_.order + 1, turned_.data());
  for (int i = 0; i < h_.cosines(); ++i)
    phi[i] = turned_[static_cast<std::size_t>(h_.cosine_order(i))].real();
  for (int j = 0; j < h_.sines(); ++j)
    phi[h_.cosines() + j] = turned_[static_cast<std::size_t>(h_.sine_order(j))].imag();
}

void MasingElement::field_derivative(int field, Out dF) const {
  if (field == 0)
    dF = scales_.by_first * A_;
  else if (field == 1)
    dF = scales_.by_second * B_;
  else
    dF = scales_.slip_force * by_shape_[static_cast<std::size_t>(field - 2)];
}

bool MasingElement::friction(FrictionState& state) const {
  state.slip_onsets.clear();
  state.slip_ends.clear();
  state.stick_share = stuck_;
  return true;
}

void MasingElement::force_at(In u, std::span<const double> fields, std::span<const double> angles, Out f) {
  scales_ = set(fields);
  f.setZero();
  if (scales_.slip_force == 0) return;
  loops_.find(u);
  const auto& parts = loops_.parts();
  if (parts.empty()) return;
  find_states();
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double spans = std::floor((angles[i] - parts.front().begin.theta) / h_.span());
    const double theta = angles[i] - spans * h_.span();
    const double sign = h_.odd && std::fmod(spans, 2) != 0 ? -1 : 1;  // x(theta + pi) = -x(theta)
    const auto after =
        std::upper_bound(parts.begin() + 1, parts.end(), theta,
                         [](double t, const BranchPart& part) { return t < part.begin.theta; });
    const BranchPart& part = *(after - 1);
    const State& from = states_[static_cast<std::size_t>(part.anchor)];
    const double way = sign * series_values(h_, u, angles[i]).x - anchor(part).x;
    const Backbone there = at(y_of(0.5 * std::abs(way)));
    const double a = from.a + there.slope * way, b = from.b + 2 * anchor(part).way * there.rest;
    f[static_cast<Eigen::Index>(i)] = sign * (scales_.stiffness * a + scales_.slip_force * b);
  }
}

}  // namespace arcslip::elements
