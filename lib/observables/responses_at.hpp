#pragma once
// The periodic responses at one excitation frequency.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// Responses at omega and the model's own parameters: where springs are linear one. Where a law may give
/// several also those at which a frequency branch from omega/4 to 4 omega passes omega, each once; others, on
/// branches that do not meet this one, are not looked for. None: why.
struct ResponsesAt {
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::vector<continuation::Vector> u;
  std::string unbounded, failure;
  std::string doubt;  // why others on that branch may be missing; empty: they are not
};
ResponsesAt responses_at(const std::shared_ptr<const model::Model>& model, double omega,
                         const GoOn& go_on = {});

struct PointSettings {
  double frequency = 0;  // of the excitation, in the scene's unit
  int steps = 1000;      // of the history, to which the angles where slip begins and ends are added
  friend bool operator==(const PointSettings&, const PointSettings&) = default;
};

/// complete: `point` is a response, with its maxima. failed, stopped: there is none.
struct PointResponse {
  std::string study, kind;  // name and kind of the study that asked for it; empty where nobody said so
  Status status = Status::complete;
  Stop stop;
  std::vector<std::pair<std::string, double>> set;         // what for_each gave it
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  std::vector<int> harmonics;                              // orders n of the coefficients
  std::string doubt;                                       // why other responses may be missing; empty: none
  ResponsePoint point;
  History history;  // over one period, both ends included
  SolverSummary solver;
};

/// All that is known of each response at settings.frequency, or one that says why there is none.
std::vector<PointResponse> point_responses(const scene::Scene& scene, const PointSettings& settings,
                                           const ProgressCallback& progress = {});

}  // namespace arcslip::observables
