#pragma once
// Optimality certificate: first-order conditions, curvature and tolerance ranges of the optimum of V, the
// amplitude or the criterion over several cases (load_cases.hpp).

#include <arcslip/optimize/evaluation/evaluation.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// Tolerance range: the values of one parameter, with the others fixed at the optimum, for which
/// V <= (1 + share) V_opt and all limits hold.
struct ToleranceRange {
  double share = 0;
  double lower = 0, upper = 0;
  bool lower_is_bound = false, upper_is_bound = false;  // the range ends at a bound of the search
  bool lower_is_limit = false, upper_is_limit = false;  // the range ends at a limit of the search
};

struct CertifiedPeak {
  PeakKind kind = PeakKind::resonance;
  double omega = 0, amplitude = 0;  // rad/s, m
  bool active = false;              // as high as the highest, within 1e-6; mean: of its case
  double weight = 0;                // Lagrange multiplier; those of the active peaks add up to 1
  std::size_t in_case = 0;          // of Optimum::cases
};

/// Tolerances of the Karush-Kuhn-Tucker conditions: a search is complete only below both.
inline constexpr double most_stationarity = 1e-5;
inline constexpr double most_complementarity = 5e-7;

/// A response on a branch other than that of the peaks.
struct OtherResponse {
  std::string found_by;             // "sweep downwards", "search at the ends", "deflation"
  double omega = 0, amplitude = 0;  // rad/s, m
  std::size_t in_case = 0;          // of Optimum::cases
};

struct Certificate {
  std::vector<double> gradient;  // dV/dp_k, of a highest peak where there are several, m over the unit of p_k
  double stationarity = 0;       // |sum of weights * d ln A / dy + sum of multipliers * dc/dy|, without what
                                 // bounds hold; at most most_stationarity where the search is complete
  double complementarity = 0;  // sum of the multipliers of limits and peaks times what each is short of being
                               // active: by as much ln V may be above its minimum; at most
                               // most_complementarity where the search is complete
  std::vector<double>
      design_estimate;          // how far the harmonics left out may move each parameter; empty: not known
  bool design_flagged = false;  // that may be too low
  std::vector<double>
      to_minimum;  // Newton step from the optimum to the zero of the gradient; empty if kinked or limited
  Eigen::MatrixXd curvature;  // d2V/dp_j dp_k; empty where several peaks of a case are active (worst: of all
                              // cases), or at a kink
  std::vector<std::vector<ToleranceRange>> ranges;  // of each parameter: shares 0.01 and 0.05
  std::vector<double> lower_design;   // where V is lowest among the designs seen on the way to their ends, if
                                      // that is lower than V_opt and all limits hold there
  std::vector<CertifiedPeak> peaks;   // the watched ones
  std::vector<ActiveLimit> limits;    // the active ones
  std::vector<int> at_bound;          // of each parameter: -1 lower, 1 upper, 0 inside
  std::vector<OtherResponse> others;  // found on other branches, at the optimum's design
  bool others_lower = true;  // none of them is higher than the highest of its case (worst: of all, weighted)
};

}  // namespace arcslip::optimize
