#include <arcslip/elements/normal_contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace arcslip::elements {
namespace {

constexpr double turn_angle = 2 * std::numbers::pi;
constexpr double kappa = 1 / std::numbers::pi;

}  // namespace

NormalContact::NormalContact(const Harmonics& h)
    : harmonics_(h),
      reversals_(h),
      moments_(h),
      n_(h.size()),
      F_(h.size()),
      by_stiffness_(h.size()),
      by_load_(h.size()),
      middle_(static_cast<std::size_t>(2 * h.order + 1)),
      half_(middle_.size()) {
  turns_.reserve(static_cast<std::size_t>(4 * h.order + 16));
  closed_.reserve(static_cast<std::size_t>(2 * h.order + 2));
}

void NormalContact::move_to(In u_n, double k_n, double N_0) {
  k_n_ = k_n;
  N_0_ = N_0;
  n_ = k_n * u_n;
  n_[0] += N_0;
  find_closed(u_n);
  F_.setZero();
  by_stiffness_.setZero();
  by_load_.setZero();
  if (!opens_) {  // without the preload, whose digits would be those of the force
    F_ = k_n * u_n;
    F_[0] += std::min(N_0, 0.0);
    by_stiffness_ = u_n;
    by_load_[0] = 1;
  } else {
    moments_.clear();
    for (const auto& [begin, end] : closed_) {
      powers(0.5 * (begin + end), static_cast<int>(middle_.size()), middle_.data());
      powers(0.5 * (end - begin), static_cast<int>(half_.size()), half_.data());
      moments_.add_interval(end - begin, middle_.data(), half_.data());
    }
    moments_.close();
    moments_.times(u_n, kappa, by_stiffness_);
    moments_.integral(by_load_);
    by_load_ *= kappa;
    by_stiffness_[0] *= 0.5;
    by_load_[0] *= 0.5;
    F_ = k_n * by_stiffness_ + N_0 * by_load_;
    F_[0] -= std::max(N_0, 0.0);
  }
  if (N_0 > 0) by_load_[0] -= 1;
}

void NormalContact::jacobian(Eigen::Ref<Eigen::MatrixXd> J) const {
  J.setZero();
  if (!opens_) {
    J.diagonal().setConstant(k_n_);
    return;
  }
  moments_.add_to(J, kappa * k_n_);
  J.row(0) *= 0.5;
}

// The intervals where N > 0, between the reversals that enclose their ends.
void NormalContact::find_closed(In u_n) {
  constexpr double never = std::numeric_limits<double>::infinity();
  closed_.clear();
  opens_ = false;
  turns_.clear();
  if (k_n_ > 0) turns_ = reversals_.find(u_n);
  const double level = -N_0_ / k_n_;
  const auto always = [&](bool closed) {
    opens_ = !closed;
    if (closed) closed_.emplace_back(0, turn_angle);
  };
  if (turns_.empty()) return always(n_[0] > 0);
  const auto is_closed = [&](const Reversal& at) { return at.x > level; };
  if (std::all_of(turns_.begin(), turns_.end(), is_closed)) return always(true);
  if (std::none_of(turns_.begin(), turns_.end(), is_closed)) return always(false);
  opens_ = true;
  double last_end = -never;
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    const Reversal from = turns_[i];
    Reversal to = turns_[i + 1 == turns_.size() ? 0 : i + 1];
    if (i + 1 == turns_.size()) to.theta += turn_angle;
    if (is_closed(from) == is_closed(to)) continue;
    const double at = reversals_.crossing(u_n, from, to, level);
    if (is_closed(to))
      closed_.emplace_back(at, never);
    else if (closed_.empty())
      last_end = at + turn_angle;
    else
      closed_.back().second = at;
  }
  if (closed_.back().second == never) closed_.back().second = last_end;
}

void NormalContact::tell(FrictionState& state) const {
  double high = n_[0], low = n_[0];
  for (const Reversal& turn : turns_) {
    const double N = N_0_ + k_n_ * turn.x;
    high = std::max(high, N);
    low = std::min(low, N);
  }
  state.load_max = std::max(high, 0.0);
  state.load_min = std::max(low, 0.0);
}

}  // namespace arcslip::elements
