#include <arcslip/laws/contact/normal_contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::elements {

NormalContact::NormalContact(const Harmonics& h)
    : harmonics_(h),
      reversals_(h),
      crossings_(h),
      moments_(h),
      n_(h.size()),
      F_(h.size()),
      by_stiffness_(h.size()),
      by_load_(h.size()),
      middle_(static_cast<std::size_t>(2 * h.order + 1)),
      half_(middle_.size()) {
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
    moments_.times(u_n, fourier_factor, by_stiffness_);
    moments_.integral(by_load_);
    by_load_ *= fourier_factor;
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
  moments_.add_to(J, fourier_factor * k_n_);
  J.row(0) *= 0.5;
}

// The intervals where N > 0.
void NormalContact::find_closed(In u_n) {
  constexpr double never = std::numeric_limits<double>::infinity();
  closed_.clear();
  const auto always = [&](bool closed) {
    opens_ = !closed;
    if (closed) closed_.emplace_back(0, whole_turn);
  };
  if (!(k_n_ > 0)) return always(n_[0] > 0);
  const auto& crossings = crossings_.find(u_n, -N_0_ / k_n_, reversals_);
  if (crossings.empty()) return always(crossings_.is_above());
  opens_ = true;
  double last_end = never;
  for (const auto& [theta, rises] : crossings) {
    if (rises)
      closed_.emplace_back(theta, never);
    else if (closed_.empty())
      last_end = theta + whole_turn;
    else
      closed_.back().second = theta;
  }
  if (closed_.back().second == never) closed_.back().second = last_end;
}

void NormalContact::tell(FrictionState& state) const {
  double high = n_[0], low = n_[0];
  for (const Reversal& turn : reversals()) {
    high = std::max(high, turn.x);
    low = std::min(low, turn.x);
  }
  state.load_max = std::max(high, 0.0);
  state.load_min = std::max(low, 0.0);
}

}  // namespace arcslip::elements
