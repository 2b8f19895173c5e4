#pragma once
// Computes the certificate of an optimum, and its parts. Not installed.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/certificate/certificate.hpp>
#include <arcslip/optimize/certificate/multipliers.hpp>

#include <functional>
#include <span>
#include <vector>

namespace arcslip::optimize {

/// Certifies the current design of the cases as the optimum; the cases move to other designs meanwhile.
/// control: asked between the parts; its end ends the certificate early. limits: the active ones. margin: the
/// largest c(p) of all limits at the current design; none: no limits.
Certificate certify(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                    std::vector<ActiveLimit> limits = {}, const std::function<double()>& margin = {},
                    const control::Control& control = {});

/// Adds ranges to the certificate, by its curvature, and lower_design. The cases are at the optimum, and move
/// to other designs. lower to control: as of certify().
void add_ranges(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                const std::function<double()>& margin, const control::Control& control,
                Certificate& certificate);

struct DesignEstimate {
  std::vector<double> change;  // |dp|, in the units of the parameters; empty: not known, as at a kink, where
                               // a limit is active, or where the equations are singular
  bool flagged = false;        // the estimate may be too low
};

/// At the current design of the cases, with its balance. control: asked before each derivative; at its
/// end the estimate is not known.
DesignEstimate design_estimate(const LoadCases& cases, const Balance& balance,
                               const control::Control& control = {});

/// Responses on branches that the search does not follow. Of one case: the highest response on the branch
/// from the upper end of the window, if the traced branch does not end there; where a law may have several
/// responses, on those through further responses at both ends, as of a window within a hysteresis; and by
/// deflation at the highest peak.
std::vector<OtherResponse> other_responses(const PeakAmplitude& peaks, std::span<const double> design,
                                           const PeakState& optimum, const control::Control& control);

}  // namespace arcslip::optimize
