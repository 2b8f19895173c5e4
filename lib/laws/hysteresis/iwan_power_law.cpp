#include <arcslip/laws/hysteresis/iwan_power_law.hpp>

#include <cmath>

namespace arcslip::elements {

PowerLaw::PowerLaw(double chi, double beta)
    : chi_(chi), beta_(beta), largest_((1 + beta) / (beta + (chi + 1) / (chi + 2))) {}

double PowerLaw::largest_by_chi() const {
  return -largest_ * largest_ / ((1 + beta_) * (chi_ + 2) * (chi_ + 2));
}

double PowerLaw::largest_by_beta() const {
  return largest_ * (1 - largest_) / (1 + beta_);
}

PowerLaw::Values PowerLaw::at(double y) const {
  const double t = y / largest_;
  if (!(t < 1)) return {0, 1, 0, 0};
  if (t <= 0) return {1, 0, 0, 0};
  const double power = chi_ == 0 ? t : std::pow(t, chi_ + 1);
  const double lost = power / (1 + beta_), below = y * lost / (chi_ + 2);  // g = y - below
  const double D = (1 + beta_) / largest_;
  const double by_chi = std::log(t) - 1 / (chi_ + 2) + (chi_ + 1) / (D * (chi_ + 2) * (chi_ + 2));
  const double by_beta = (chi_ + 1) / D - (chi_ + 2) / (1 + beta_);
  return {1 - lost, below * (chi_ + 1), -below * by_chi, -below * by_beta};
}

PowerLaw::Share PowerLaw::between(double t_0, double t_1) const {
  const double p_0 = std::pow(t_0, chi_ + 1), p_1 = std::pow(t_1, chi_ + 1);
  return {(p_1 - p_0) / (1 + beta_),
          largest_ * (t_1 * p_1 - t_0 * p_0) * (chi_ + 1) / ((1 + beta_) * (chi_ + 2))};
}

PowerLaw::Share PowerLaw::at_most() const {
  const double share = beta_ / (1 + beta_);
  return {share, share * largest_};
}

}  // namespace arcslip::elements
