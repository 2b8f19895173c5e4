#pragma once
// Lagrange multipliers at a minimum of V (load_cases.hpp): m_ck >= 0 of the active peaks, those with the
// highest w_c A_ck of their group g, and n_i >= 0 of the active limits c_i(p) <= 0, including bounds,
//
//   minimize |sum of m_ck d ln A_ck / dy + sum of n_i dc_i / dy|
//   such that the m_ck of group g add up to its share of V
//
// with the scaled variables y (scaled_parameter.hpp). The minimum is 0 at a stationary p, and all m_ck add up
// to 1. Not installed.

#include <arcslip/optimize/evaluation/evaluation.hpp>
#include <arcslip/optimize/evaluation/load_cases.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace arcslip::optimize {

inline constexpr double as_high = 1e-6;  // relative: a peak that is nearer to the highest is as high

struct ActivePeak {
  std::size_t in_case, peak;  // of the cases, and of its state
  double multiplier = 0;
};

struct Balance {
  std::vector<ActivePeak> active;
  std::vector<ActiveLimit> limits;  // with their multipliers
  Vector left{};                    // residual gradient: V decreases in the opposite direction
  double stationarity = 0;          // its norm
  double complementarity = 0;       // sum of m_ck ln(V_g / (w_c A_ck)) + sum of n_i (-c_i)
  std::vector<int> at_bound;        // of each parameter: -1 lower, 1 upper, 0 inside
  bool smooth = true;               // one active peak in each group, and none at a kink
};

/// Whether the first-order conditions of a minimum hold.
bool is_stationary(const Balance& balance);

/// The balance at the current design of the cases, V finite.
Balance balance(const LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                std::vector<ActiveLimit> limits);

/// m >= 0 that minimizes |G m| such that the entries of each group add up to its share (> 0, groups counted
/// from 0, none empty). An active-set method; G need not have full rank.
Eigen::VectorXd least_combination(const Eigen::MatrixXd& G, const std::vector<std::size_t>& group,
                                  const std::vector<double>& shares);

}  // namespace arcslip::optimize
