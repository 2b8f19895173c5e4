#pragma once
// Frequency responses: the branch of periodic responses over the excitation frequency, with its peaks and
// folds.

#include <arcslip/analyses/branches/all_branches.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/stability/stability_request.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace arcslip::observables {

/// one: the branch from the lower end on; all: also those that leave it, and so on
/// (analyses/branches/all_branches.hpp).
enum class Branches { one, all };

/// harmonic_balance: the harmonics of the scene; shooting: exact motions in time, of piecewise linear scenes
/// (time/periodic/shooting_problem.hpp).
enum class ResponseMethod { harmonic_balance, shooting };

/// Of the excitation, in the scene's unit; from < to.
struct FrequencyRange {
  double from = 0, to = 0;
  StabilityRequest
      stability{};  // of the points, and their bifurcations; where all branches are asked for, always
  Branches branches = Branches::one;
  BranchLimits limits{};                                     // of all branches
  ResponseMethod method = ResponseMethod::harmonic_balance;  // shooting: for one branch only
  Steps steps = Steps::curve;  // no key: events, where nothing else of the branches is of interest
  Observed points{}, events = everything;  // no keys: what is asked for
  friend bool operator==(const FrequencyRange&, const FrequencyRange&) = default;
};

/// One branch, or several if an unbounded resonance divides it or all are asked for. A branch that ends early
/// is reported with its reason. Throws std::invalid_argument unless from < to. Threads may share the scene.
std::vector<ResponseBranch> frequency_response(const scene::Scene& scene, const FrequencyRange& range,
                                               const control::Control& control = {});

/// All branches of a model, with their equations: those of Branches::all, without a message where no peak is.
std::vector<TracedBranch> traced_branches(std::shared_ptr<const model::Model> model,
                                          scene::FrequencyUnit unit, const FrequencyRange& range, Steps steps,
                                          const control::Control& control);

/// A response of which parts have more harmonics than others (Solution::order).
struct RefinedResponse {
  std::vector<ResponseBranch> branches;
  double change = 0;  // of the amplitude by the harmonics added, at the ends of the parts and where it is
                      // largest in them, relative to the largest amplitude of all
};

/// From the branches of a scene with fewer harmonics, those of `scene`, where only parts are traced anew:
/// those in which the truncation estimate exceeds accuracy times the largest amplitude, or is flagged
/// (analyses/branches/harmonic_refinement.hpp). Nothing where all has to be traced anew: with all branches,
/// by shooting, for a response that does not reach the end of its window, where these parts are most of it,
/// where another response is found at the end of a part, and after the end of `control`.
std::optional<RefinedResponse> refined_response(const scene::Scene& scene, const FrequencyRange& range,
                                                std::span<const ResponseBranch> coarse, double accuracy,
                                                const control::Control& control = {});

}  // namespace arcslip::observables
