#pragma once
// The branch of periodic responses over the excitation frequency, with peaks and folds, for one setting of a
// model.

#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/observe.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace arcslip::observables {

struct FrequencyWindow {
  double lower, upper;  // rad/s, 0 < lower < upper
};

struct FrequencyBranch {
  std::shared_ptr<const hbm::HbmProblem> problem;
  continuation::Branch branch;  // start_failed where no response was found to start from
};

/// A response to start from, and the problem in its scale; no response: why there is none.
struct FirstResponse {
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::optional<continuation::Vector> u;
  std::string failure;
};

/// Whether to go on: asked about all the time, whatever is under way. Once it was false it stays so; what was
/// under way is then left as it is, and means nothing.
using GoOn = std::function<bool()>;

/// At omega with the model's own parameters. frequency_scale: of the problem.
FirstResponse first_response(const std::shared_ptr<const model::Model>& model, double omega,
                             double frequency_scale, const GoOn& go_on = {});

/// Of a branch that was followed in its rounding, with as many steps rejected as made: which stiffnesses lie
/// too far apart. Empty: no doubt. p: of the branch.
std::string doubt_of_rounding(const model::Model& model, const continuation::Vector& p,
                              const continuation::Counts& counts);

/// For the user of a scene: the message of a branch that ended early also says which stiffnesses lie too far
/// apart, if any do. Of the Jacobian it does not speak, which scenes are traced without a check of.
void speak_of_scene(const model::Model& model, const continuation::Vector& p, continuation::Branch& branch);

/// Called at each point (event: null) and each event; false stops.
using Record = std::function<bool(Observer&, const continuation::Accepted&, const continuation::Event*)>;

/// How long steps may be. curve: about 1/150 of the window, to be looked at. events: for its peaks and folds
/// alone, also 1/200 of the highest frequency, but no longer than 1/20 of the window.
enum class Steps { curve, events };

/// Traces from omega = `from` in the window, upwards (direction 1) or downwards (-1). Where go_on says false
/// the branch ends with reason user.
FrequencyBranch frequency_branch(const std::shared_ptr<const model::Model>& model,
                                 const FrequencyWindow& window, double from, const Record& record = {},
                                 int direction = 1, Steps steps = Steps::curve, const GoOn& go_on = {});

}  // namespace arcslip::observables
