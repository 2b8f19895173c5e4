#pragma once
// Computes the certificate of an optimum. Not installed.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/certificate/certificate.hpp>
#include <arcslip/optimize/evaluation/load_cases.hpp>

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

}  // namespace arcslip::optimize
