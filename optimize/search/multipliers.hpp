#pragma once
// The balance of gradients at a minimum of V (cases.hpp): multipliers m_ck >= 0 of the active peaks, those
// whose w_c A_ck is the highest of their group g, and n_i >= 0 of the active limits c_i(p) <= 0, those of
// bounds among them,
//
//   minimise |sum of m_ck d ln A_ck / dy + sum of n_i dc_i / dy|
//   such that the m_ck of group g add up to its share of V
//
// over the scaled variables y (scaled_parameter.hpp). The minimum is 0 where p is stationary, and all m_ck
// add up to 1. Not installed.

#include <arcslip/optimize/search/certificate.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace arcslip::optimize {

struct ActivePeak {
  std::size_t in_case, peak;  // of the cases, and of its state
  double multiplier = 0;
};

struct Balance {
  std::vector<ActivePeak> active;
  std::vector<ActiveLimit> limits;  // with their multipliers
  Vector left{};                    // the sum of the gradients: V falls the other way, to first order
  double stationarity = 0;          // its norm
  double complementarity = 0;       // sum of m_ck ln(V_g / (w_c A_ck)) + sum of n_i (-c_i)
  std::vector<int> at_bound;        // of each parameter: -1 lower, 1 upper, 0 inside
  bool smooth = true;               // one active peak in each group, and none at a kink
};

/// Whether these are the conditions of a minimum, but for that of second order.
bool is_stationary(const Balance& balance);

/// Where the cases stand, V finite.
Balance balance(const Cases& cases, std::span<const double> lower, std::span<const double> upper,
                std::vector<ActiveLimit> limits);

/// m >= 0 of least |G m| such that the entries of each group add up to its share (> 0, groups counted from
/// 0, none empty). An active-set method: G need not have full rank.
Eigen::VectorXd least_combination(const Eigen::MatrixXd& G, const std::vector<std::size_t>& group,
                                  const std::vector<double>& shares);

}  // namespace arcslip::optimize
