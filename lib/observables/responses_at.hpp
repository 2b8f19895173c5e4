#pragma once
// The periodic responses at one excitation frequency.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/observables/offset_range.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/observables/stability_request.hpp>
#include <arcslip/scene/scene.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// Responses at omega and the model's own parameters. If a law may have several responses, also those at
/// which a frequency branch from omega/4 to 4 omega crosses omega, each once; responses on disconnected
/// branches are not searched for. Without a response: the reason.
struct ResponsesAt {
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::vector<continuation::Vector> u;
  std::string unbounded, failure;
  std::string doubt;  // why others on that branch may be missing; empty: none are
};
ResponsesAt responses_at(const std::shared_ptr<const model::Model>& model, double omega,
                         const GoOn& go_on = {});

/// Of these, the one with the amplitude (m) nearest to the one given, with its stability where that is known.
/// Without a response: the reason.
struct ResponseOfAmplitude {
  std::shared_ptr<const hbm::HbmProblem> problem;
  continuation::Vector u;
  std::optional<ResponsePoint> point;
  std::string failure;
};
ResponseOfAmplitude response_of_amplitude(const std::shared_ptr<const model::Model>& model, double omega,
                                          double amplitude, const GoOn& go_on = {});

/// Of sliders that stick throughout the period: the choices of their elements, or also a search for the range
/// of what they leave open, PointResponse::offset_range.
enum class Offsets { chosen, range };

struct PointSettings {
  double frequency = 0;  // of the excitation, in the scene's unit
  int steps = 1000;      // of the history, in addition to the onsets and ends of slip
  Offsets offsets = Offsets::chosen;
  StabilityRequest stability{};
  friend bool operator==(const PointSettings&, const PointSettings&) = default;
};

/// complete: `point` is a response, with its maxima. failed, stopped: no response.
struct PointResponse {
  std::string study, kind;  // name and kind of its study; may be empty
  Status status = Status::complete;
  Stop stop;
  std::vector<std::pair<std::string, double>> set;         // set by for_each
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  std::vector<int> harmonics;                              // n of the coefficients
  std::string doubt;                                       // why other responses may be missing; empty: none
  ResponsePoint point;
  std::optional<OffsetRange> offset_range;
  History history;  // over one period, both ends included
  SolverSummary solver;
};

/// All quantities of each response at settings.frequency, or one result with the reason why there is none.
std::vector<PointResponse> point_responses(const scene::Scene& scene, const PointSettings& settings,
                                           const ProgressCallback& progress = {});

}  // namespace arcslip::observables
