#pragma once
// Responses over any parameter, at a fixed excitation frequency.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/stability/stability_request.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::observables {

/// A parameter `over`, its range, and a frequency in the scene's unit.
struct ParameterRange {
  std::string over;
  double from = 0, to = 0, frequency = 0;
  StabilityRequest stability{};  // of the points, and their bifurcations
  ResponseMethod method = ResponseMethod::harmonic_balance;
  Observed points{}, events = everything;  // no keys: what is asked for
  friend bool operator==(const ParameterRange&, const ParameterRange&) = default;
};

/// The branches over a parameter at one frequency, one for each response found at range.from; with a cubic
/// spring there may be several; by shooting the one of shooting_response.hpp. Events:
/// "fold" in that parameter, "maximum" and "minimum" of the amplitude.
/// Throws scene::ParameterError for an unknown parameter or a range beyond its bounds.
std::vector<ResponseBranch> parameter_response(const scene::Scene& scene, const ParameterRange& range,
                                               const control::Control& control = {});

/// From the branch of a scene with fewer harmonics, that of `scene`, where only parts are traced anew, as of
/// a frequency response. Nothing where there are several branches.
std::optional<RefinedResponse> refined_response(const scene::Scene& scene, const ParameterRange& range,
                                                std::span<const ResponseBranch> coarse, double accuracy,
                                                const control::Control& control = {});

}  // namespace arcslip::observables
