#pragma once
// The branch of periodic responses over the excitation frequency, with peaks and folds, for one setting of a
// model.

#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/observe.hpp>
#include <arcslip/stability/stability_request.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

struct FrequencyWindow {
  double lower, upper;  // rad/s, 0 < lower < upper
};

struct FrequencyBranch {
  std::shared_ptr<const hbm::HbmProblem> problem;
  continuation::Branch branch;      // start_failed where no response was found to start from
  std::string unknown_stability{};  // why no point has any
};

/// A response to start from, and the problem in its scale; without a response, the reason.
struct FirstResponse {
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::optional<continuation::Vector> u;
  std::string failure;
  continuation::Counts work{};
};

/// The number of elements with a law that may have several responses at one frequency.
std::ptrdiff_t elements_with_several_responses(const model::Model& model);
inline bool may_have_several_responses(const model::Model& model) {
  return elements_with_several_responses(model) > 0;
}

/// Of a scene whose matrices are small or reduced (model/reduction_report.hpp). control: Model::control.
std::shared_ptr<const model::Model> model_of(const scene::Scene& scene, control::Control control);

/// With the displacement 1 m, and modes, where there are any, about omega; they take seconds for a large
/// structure, in which `control` is asked. Null after its end. frequency_scale: of the problem.
std::shared_ptr<const hbm::HbmProblem> problem_at(const std::shared_ptr<const model::Model>& model,
                                                  double omega, double frequency_scale,
                                                  const control::Control& control = {});

/// The same in the displacement of the first point of a branch.
std::shared_ptr<const hbm::HbmProblem> problem_of(const ResponseBranch& branch,
                                                  const std::shared_ptr<const model::Model>& model,
                                                  double omega, double frequency_scale,
                                                  const control::Control& control = {});

/// At omega with the model's own parameters. frequency_scale: of the problem.
FirstResponse first_response(const std::shared_ptr<const model::Model>& model, double omega,
                             double frequency_scale, const control::Control& control = {});

/// For a branch dominated by rounding errors, with as many rejected as accepted steps: that it is, and the
/// stiffnesses with too large a ratio. Empty: no doubt. p: of the branch.
std::string doubt_of_rounding(const model::Model& model, const continuation::Vector& p,
                              const SolverSummary& work);

/// For users of scenes: the message of a branch that ended early also names stiffnesses with too large a
/// ratio, and friction without a stiffness. It does not mention the Jacobian, which is not checked for
/// scenes.
void add_scene_hint(const model::Model& model, const continuation::Vector& p, continuation::Branch& branch);

/// The end of the message of a branch that left the window where it began.
inline constexpr const char* nothing_above = ": no response above that frequency was traced";

/// The status and stop of a branch over the frequency from omega = `from` on, in the unit of the scene, once
/// its points and events are there. upper: of the window, rad/s.
void set_end(const continuation::BranchStop& stop, double from, double upper, scene::FrequencyUnit unit,
             ResponseBranch& result);

/// Called at each point (event: null) and each event; false stops.
using Record = std::function<bool(Observer&, const continuation::Accepted&, const continuation::Event*)>;

/// Of curves of responses and of modes: no resonance narrower than a step goes by unseen.
inline constexpr double curve_tolerance = 1e-5;
/// The same where kinks are passed.
inline constexpr double curve_tolerance_across_kinks = 1e-3;

/// From more contacts on kinks are passed.
inline constexpr int most_located_contacts = 20;
bool passes_kinks(const model::Model& model);

/// Maximum step. curve: for plots, the larger of 1/150 of the window and 1e-4 of the highest frequency;
/// events: for peaks and folds only, with 1/200 of the frequency; both at most 1/20 of the window. Where
/// kinks are passed, 2.5 times that. passage: as curve, without peaks, and with folds at kinks to the length
/// of a step only, for where the branch passes a frequency.
enum class Steps { curve, events, passage };

/// Which events branches over the frequency have next to folds.
struct MonitoredEvents {
  StabilityRequest stability{};  // points have it, and bifurcations are events
  bool phase = false;            // points of phase resonance
  bool branch_points = false;    // where branches of the same harmonics cross
  double passage = 0;            // rad/s: where the branch passes this frequency; 0: not looked for
};

/// Options and monitors of branches over the frequency.
continuation::Options frequency_options(const FrequencyWindow& window, Steps steps,
                                        const control::Control& control);
/// With many contacts (scene::Kinks): kinks are passed, in a coarser curve with fewer points, unless a
/// monitor of stability or of branch points needs them.
void pass_kinks(const model::Model& model, const MonitoredEvents& watched, continuation::Options& options);
std::vector<continuation::Monitor> frequency_monitors(const std::shared_ptr<Observer>& observer, Steps steps,
                                                      const MonitoredEvents& watched);

/// Traces from omega = `from` in the window, upwards (direction 1) or downwards (-1). If `control` ends
/// the branch ends with reason user. displacement: the scale, m; 0: that of the first response.
FrequencyBranch frequency_branch(const std::shared_ptr<const model::Model>& model,
                                 const FrequencyWindow& window, double from, const Record& record = {},
                                 int direction = 1, Steps steps = Steps::curve,
                                 const control::Control& control = {}, const MonitoredEvents& watched = {},
                                 double displacement = 0);

/// A part of such a branch, with the steps of the whole window: from a response u of `problem` at
/// omega = `from`, or one close by, to where the branch reaches omega = `to` or an end of the window.
FrequencyBranch frequency_branch_part(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                      const FrequencyWindow& window, double from, double to,
                                      const continuation::Vector& u, const Record& record, int direction,
                                      Steps steps, const control::Control& control,
                                      const MonitoredEvents& watched);

}  // namespace arcslip::observables
