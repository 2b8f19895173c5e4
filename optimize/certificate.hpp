#pragma once
// How sure, and how sharp, an optimum is.

#include <arcslip/optimize/peak_amplitude.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// The values of one parameter, with the others as at the optimum, for which A_max <= (1 + share) A_opt.
struct ToleranceRange {
  double share = 0;
  double lower = 0, upper = 0;
  bool lower_is_bound = false, upper_is_bound = false;  // the bound of the search comes first
};

struct CertifiedPeak {
  PeakKind kind = PeakKind::resonance;
  double omega = 0, amplitude = 0;  // rad/s, m
  bool active = false;              // as high as the highest, within 1e-6; mean: of its case
  double weight = 0;                // its multiplier: those of the active peaks add up to 1
  std::size_t in_case = 0;          // of Optimum::cases
};

/// A response on another branch than that of the peaks.
struct OtherResponse {
  std::string found_by;             // "sweep downwards", "deflation"
  double omega = 0, amplitude = 0;  // rad/s, m
  std::size_t in_case = 0;          // of Optimum::cases
};

struct Certificate {
  std::vector<double> gradient;  // dA/dp_k at the highest peak, m over the unit of p_k
  double stationarity = 0;       // |sum of weights * d ln A / d ln p|, without what a bound holds
  std::vector<double>
      to_minimum;             // Newton step from the optimum to the zero of the gradient; empty if kinked
  Eigen::MatrixXd curvature;  // d2A/dp_j dp_k; empty where several peaks are active, or at a kink
  std::vector<std::vector<ToleranceRange>> ranges;  // of each parameter: shares 0.01 and 0.05
  std::vector<CertifiedPeak> peaks;                 // that are watched
  std::vector<int> at_bound;                        // of each parameter: -1 lower, 1 upper, 0 inside
  std::vector<OtherResponse> others;                // found on other branches, at the optimum's design
  bool others_lower = true;                         // none of them is higher
};

/// At the design of the last traced response of `peaks`, which is the optimum; it moves elsewhere meanwhile.
/// go_on: asked between parts; false ends the certificate where it is.
Certificate certify(PeakAmplitude& peaks, std::span<const double> lower, std::span<const double> upper,
                    const std::function<bool()>& go_on = {});

}  // namespace arcslip::optimize
