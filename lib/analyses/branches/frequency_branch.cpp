#include <arcslip/analyses/branches/frequency_branch.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/passages.hpp>
#include <arcslip/analyses/branches/phase_resonance.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/control/interruptible.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/model/stiffness_contrast.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr double points_in_window = 150;    // at least, from end to end, of a curve
constexpr double points_across_kinks = 60;  // the same, where kinks are passed
constexpr double points_in_narrow_window =
    20;  // the same, whatever its width, and where only events are asked for
constexpr double step_in_narrow_window = 1e-4;  // relative to the highest frequency: longer ones are limited
constexpr double step_between_events = 1.0 / 200;  // the same, where only events are asked for
constexpr double largest_frequency_step = 0.05;  // of the frequency, so that wide windows keep their low end
constexpr double rejected_in_rounding = 0.5;     // steps, over points: where the branch lies in its rounding
constexpr double largest_near_first = 1e8;       // of the response without elements to the first one
constexpr int quick_dofs = 200;                  // up to here a problem is made in a tenth of a second

// Next to a drifting degree of freedom: of contacts that open, if there are any.
std::string no_contact_closes(const model::Model& model, const Vector& p) {
  const bool opens = std::any_of(model.elements.begin(), model.elements.end(),
                                 [&](const auto& element) { return model::is_open_at_rest(element, p); });
  return opens ? ", nor does a contact that the constant forces close" : "";
}

// What may have made a computation fail, as the end of its message.
std::string causes(const model::Model& model, const Vector& p) {
  std::string text;
  for (const auto& element : model.elements)
    if (element.law->set_valued())
      text +=
          "; the friction of \"" + element.name +
          "\" has no stiffness: where it stops the motion, responses may not be found; give the contact a "
          "stiffness";
  if (const std::string apart = model::stiffness_apart(model, p); !apart.empty()) text += "; " + apart;
  return text;
}

}  // namespace

std::string doubt_of_rounding(const model::Model& model, const Vector& p, const SolverSummary& work) {
  const bool in_rounding =
      static_cast<double>(work.rejected_steps) > rejected_in_rounding * static_cast<double>(work.points);
  const std::string apart = in_rounding ? model::stiffness_apart(model, p) : "";
  return apart.empty() ? "" : "dominated by rounding errors, so that its results lose digits: " + apart;
}

namespace {

// A sentence where only contacts that stick hold a mean position, or nothing.
std::string held_by_friction(const model::Model& model, const Vector& p) {
  const auto dof = model::drifting_dof(model, p, false);
  if (!dof || model::drifting_dof(model, p)) return {};
  return "; only friction holds the mean position of " + model::coordinate_name(model, *dof) +
         ", and no longer where it slips in each period";
}

}  // namespace

namespace {

// Replaces what is addressed to callers of the engine.
void leave_out_options(std::string& message) {
  const auto replace = [&](std::string_view from, std::string_view until, std::string_view by) {
    const auto at = message.find(from),
               end = at == std::string::npos ? at : message.find(until, at + from.size());
    if (end != std::string::npos) message.replace(at, end + until.size() - at, by);
  };
  replace(continuation::needs_tangent, "", "");
  replace("the step that `", "` allows", "the largest step");
  replace("give it a smaller `scale`, or ", "", "give it ");
}

}  // namespace

void add_scene_hint(const model::Model& model, const Vector& p, continuation::Branch& branch) {
  using continuation::StopReason;
  if (branch.stop.reason == StopReason::user || branch.stop.reason == StopReason::boundary) return;
  std::string& message = branch.stop.message;
  leave_out_options(message);
  message += causes(model, p);
  message += held_by_friction(model, p);
}

void set_end(const continuation::BranchStop& stop, double from, double upper, scene::FrequencyUnit unit,
             ResponseBranch& result) {
  using continuation::StopReason;
  const auto with_unit = [&](double omega) { return frequency_text(omega, unit); };
  const double per_unit = scene::to_rad_per_s(unit);
  result.status = status_of(stop.reason);
  result.stop = {reason_of(stop.reason), stop.value, stop.limit, stop.message};
  if (stop.reason == StopReason::start_failed) {
    result.stop.value = from / per_unit;
    result.stop.limit = 0;
    result.stop.message = "no periodic response was found at " + with_unit(from) + ": " + stop.message;
  } else if (stop.reason == StopReason::boundary) {
    result.stop.value = stop.value / per_unit;
    result.stop.limit = upper / per_unit;
    if (stop.value == upper) {
      result.stop.message = "reached the end of the window at " + with_unit(upper);
      return;
    }
    result.status = Status::stopped;
    double highest = from;
    for (const auto& point : result.points) highest = std::max(highest, point.omega);
    for (const auto& event : result.events) highest = std::max(highest, event.point.omega);
    result.stop.message = "turned back at " + with_unit(highest) + " and left the window at its lower end, " +
                          with_unit(stop.value) + nothing_above;
  }
}

std::shared_ptr<const hbm::HbmProblem> problem_at(const std::shared_ptr<const model::Model>& model,
                                                  double omega, double frequency_scale,
                                                  const control::Control& control) {
  try {
    return control::interruptible(
        [model, omega, frequency_scale](const control::Control&) {
          return std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1, frequency_scale, omega);
        },
        model->dofs > quick_dofs ? control : control::Control(), "");
  } catch (const control::Interrupted&) {
    return {};
  }
}

std::ptrdiff_t elements_with_several_responses(const model::Model& model) {
  const Vector p = model::defaults(model);
  return std::count_if(model.elements.begin(), model.elements.end(), [&](const auto& element) {
    const std::vector<double> fields = element.fields(p);
    for (int i = 0; i < element.law->directions(); ++i)
      if (element.law->traits(fields, i).several_responses) return true;
    return false;
  });
}

std::shared_ptr<const model::Model> model_of(const scene::Scene& scene, control::Control control) {
  auto model = std::make_shared<model::Model>(model::build(scene));
  model->control = std::move(control);
  return model;
}

std::shared_ptr<const hbm::HbmProblem> problem_of(const ResponseBranch& branch,
                                                  const std::shared_ptr<const model::Model>& model,
                                                  double omega, double frequency_scale,
                                                  const control::Control& control) {
  const auto unscaled = problem_at(model, omega, frequency_scale, control);
  if (!unscaled) return nullptr;
  const auto& at_first = branch.points.front().unknowns;
  const double size =
      Eigen::Map<const Vector>(at_first.data(), static_cast<Eigen::Index>(at_first.size())).norm();
  return std::make_shared<const hbm::HbmProblem>(*unscaled, size > 0 ? size : 1);
}

FirstResponse first_response(const std::shared_ptr<const model::Model>& model, double omega,
                             double frequency_scale, const control::Control& control) {
  const auto found = problem_at(model, omega, frequency_scale, control);
  if (!found) {  // without modes, which are not waited for
    constexpr double at_rest = 0;
    return {std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1, frequency_scale, at_rest),
            {},
            "stopped by the caller"};
  }
  const hbm::HbmProblem& unscaled = *found;
  const auto problem_with = [&](double displacement) {
    const double scale = displacement > 0 && std::isfinite(displacement) ? displacement : 1;
    return std::make_shared<const hbm::HbmProblem>(unscaled, scale);
  };
  const Vector p = hbm::parameters_at(unscaled, omega);
  const auto problem = problem_with(hbm::linear_response(unscaled, p).norm());
  if (const auto dof = model::drifting_dof(*model, p))
    return {
        problem,
        {},
        "no spring holds the mean position of " + model::coordinate_name(*model, *dof) +
            no_contact_closes(*model, p) +
            ", and friction leaves it free to drift; add a spring between it and the ground or a supported "
            "degree of freedom, or excite odd harmonics only, with an odd \"period\" of the harmonics, or "
            "let a "
            "contact that sticks hold it, with \"offset\": \"static\""};
  const auto [u, work] = hbm::steady_state(problem, p, control);
  if (!u && !control.keep_going()) return {problem, {}, "stopped by the caller", work};
  if (!u) {
    return {
        problem,
        {},
        "Newton's method failed from rest, from the linear response and from motions at random, and so did "
        "continuation in the excitation level and in the forces of the elements" +
            causes(*model, p) + held_by_friction(*model, p),
        work};
  }
  return {problem_with(u->norm()), u, {}, work};
}

continuation::Options frequency_options(const FrequencyWindow& window, Steps steps,
                                        const control::Control& control) {
  const double width = window.upper - window.lower;
  continuation::Options options;
  options.lower = window.lower;
  options.upper = window.upper;
  options.check_jacobian = false;
  const double in_narrow_window =
      (steps == Steps::events ? step_between_events : step_in_narrow_window) * window.upper;
  options.step.largest_parameter =
      std::clamp(in_narrow_window, width / points_in_window, width / points_in_narrow_window);
  if (steps != Steps::events) options.step.curve_tolerance = curve_tolerance;
  options.step.relative_parameter = largest_frequency_step;
  options.step.smallest =
      std::max(std::min(options.step.smallest, smallest_step * largest_frequency_step * window.lower / width),
               std::numeric_limits<double>::min());  // also where the window spans hundreds of decades
  options.largest_state = resolvable;
  options.control = control;
  return options;
}

bool passes_kinks(const model::Model& model) {
  if (model.settings.friction != scene::Friction::exact) return false;
  if (model.settings.kinks != scene::Kinks::automatic) return model.settings.kinks == scene::Kinks::passed;
  const auto contacts = std::count_if(model.elements.begin(), model.elements.end(), [&](const auto& element) {
    return element.law->corners(model.harmonics) != nullptr;
  });
  return contacts > most_located_contacts;
}

void pass_kinks(const model::Model& model, const MonitoredEvents& watched, continuation::Options& options) {
  if (watched.stability || watched.branch_points || watched.passage > 0) return;
  if (!(options.step.curve_tolerance > 0) || !passes_kinks(model)) return;
  options.step.pass_kinks = true;
  options.step.curve_tolerance = curve_tolerance_across_kinks;
  options.step.largest_parameter *= points_in_window / points_across_kinks;
}

std::vector<continuation::Monitor> frequency_monitors(const std::shared_ptr<Observer>& observer, Steps steps,
                                                      const MonitoredEvents& watched) {
  std::vector monitors{continuation::fold_monitor()};  // so that no pair of folds is stepped over
  monitors[0].divides_at_kinks = false;
  if (steps != Steps::passage) {
    monitors.insert(monitors.begin(), peak_monitor(observer));
    monitors[1].divides_at_kinks = monitors[0].divides_at_kinks;
  }
  if (watched.stability) {
    observer->watch_stability(watched.stability);
    for (auto& monitor : stability_monitors(observer)) monitors.push_back(std::move(monitor));
  }
  if (watched.branch_points) monitors.push_back(continuation::branch_point_monitor());
  if (watched.passage > 0) monitors.push_back(passage_monitor(watched.passage));
  return monitors;
}

namespace {

FrequencyBranch traced(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& u, double from,
                       const continuation::Options& options, const Record& record, int direction, Steps steps,
                       const MonitoredEvents& watched) {
  const auto observer = std::make_shared<Observer>(problem);
  continuation::Observer each;
  if (record)
    each = [&](const continuation::Accepted& now, const continuation::Event* event) {
      return record(*observer, now, event);
    };
  auto monitors = frequency_monitors(observer, steps, watched);
  if (watched.phase) monitors.push_back(phase_resonance_monitor(observer, direction));
  const Vector p = hbm::parameters_at(*problem, from);
  FrequencyBranch found{problem, continuation::trace(problem, {u, p, model::frequency, direction}, options,
                                                     std::move(monitors), each)};
  found.unknown_stability = observer->unknown_stability();
  add_scene_hint(problem->model(), p, found.branch);
  return found;
}

// The response without the elements over the scale of a problem, if it is larger: where contacts stick, or
// the ground hardly moves, the first response is small next to all that follows. The middle one of three,
// since one of them may be at a resonance. Contacts alone may hold the structure, which then has a response
// of any size without them.
double size_without_elements(const hbm::HbmProblem& problem, const FrequencyWindow& window) {
  std::array<double, 3> sizes{};
  const std::array at{window.lower, std::midpoint(window.lower, window.upper), window.upper};
  for (std::size_t i = 0; i < at.size(); ++i)
    sizes[i] = hbm::linear_response(problem, hbm::parameters_at(problem, at[i])).norm();
  std::sort(sizes.begin(), sizes.end(),
            [](double a, double b) { return a < b || (!std::isnan(a) && std::isnan(b)); });
  const double size = sizes[1] / problem.displacement();
  return std::isnan(size) ? 1.0 : std::clamp(size, 1.0, largest_near_first);
}

}  // namespace

FrequencyBranch frequency_branch(const std::shared_ptr<const model::Model>& model,
                                 const FrequencyWindow& window, double from, const Record& record,
                                 int direction, Steps steps, const control::Control& control,
                                 const MonitoredEvents& watched, double displacement) {
  const double width = window.upper - window.lower;
  const FirstResponse first = first_response(model, from, width, control);
  if (!first.u) {
    FrequencyBranch none{first.problem, {}};
    none.branch.counts = first.work;
    if (!control.keep_going()) {
      none.branch.stop = {continuation::StopReason::user, 1, 1, "stopped by the caller"};
      return none;
    }
    none.branch.stop = {continuation::StopReason::start_failed, from, 0, first.failure};
    return none;
  }
  const auto problem = displacement > 0
                           ? std::make_shared<const hbm::HbmProblem>(*first.problem, displacement)
                           : first.problem;
  continuation::Options options = frequency_options(window, steps, control);
  pass_kinks(*model, watched, options);
  options.largest_state *= size_without_elements(*problem, window);
  FrequencyBranch found = traced(problem, *first.u, from, options, record, direction, steps, watched);
  found.branch.counts += first.work;
  return found;
}

FrequencyBranch frequency_branch_part(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                      const FrequencyWindow& window, double from, double to, const Vector& u,
                                      const Record& record, int direction, Steps steps,
                                      const control::Control& control, const MonitoredEvents& watched) {
  continuation::Options options = frequency_options(window, steps, control);
  pass_kinks(problem->model(), watched, options);
  (to > from ? options.upper : options.lower) = to;
  return traced(problem, u, from, options, record, direction, steps, watched);
}

}  // namespace arcslip::observables
