#pragma once
// The periodic responses at one excitation frequency.

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/stick_offset_range.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/stability/stability_request.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// Responses at omega and the model's own parameters, each once. With a search: those
/// at which the frequency branch to 4 omega passes omega, also next to a fold, from omega/4 on or from below
/// the lowest natural frequency above omega/10; others by further_responses() and deflation
/// (analyses/branches/other_solutions.hpp); and where the branches through each of them, in the same window,
/// pass omega. One that none of these reaches is missing. Without a response: the reason.
struct ResponsesAt {
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::vector<continuation::Vector> u;
  std::string unbounded, failure;
  continuation::Counts work;     // of the first one
  bool several = false;          // may be: others were looked for
  FrequencyWindow window{0, 0};  // in which, rad/s
  std::string doubt;             // why others on those branches may be missing; empty: none are
};
/// guesses: unknowns near further ones.
ResponsesAt responses_at(const std::shared_ptr<const model::Model>& model, double omega, EndSearch search,
                         const control::Control& control = {},
                         const std::vector<continuation::Vector>& guesses = {});

/// Of these, the one with the amplitude (m) nearest to the one given, with its stability where that is known.
/// Without a response: the reason.
struct ResponseOfAmplitude {
  std::shared_ptr<const hbm::HbmProblem> problem;
  continuation::Vector u;
  std::optional<ResponsePoint> point;
  std::string failure;
};
ResponseOfAmplitude response_of_amplitude(const std::shared_ptr<const model::Model>& model, double omega,
                                          double amplitude, const control::Control& control = {});

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
  int found = 0;  // how many responses a search found, where a law may have several; 0: none was made
  ResponsePoint point;
  std::optional<OffsetRange> offset_range;
  History history;  // over one period, both ends included
  SolverSummary solver;
};

/// All quantities of each response at settings.frequency, or one result with the reason why there is none.
/// known: those of the scene with fewer harmonics, next to which responses are looked for as well.
std::vector<PointResponse> point_responses(const scene::Scene& scene, const PointSettings& settings,
                                           const control::Control& control = {},
                                           std::span<const PointResponse> known = {});

}  // namespace arcslip::observables
