#include <arcslip/analyses/branches/parameter_trace.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::observables {
namespace {

constexpr double largest_parameter_step = 1.0 / 12;  // of the parameter

}  // namespace

continuation::Options OverParameter::options() const {
  continuation::Options options;
  options.lower = lower();
  options.upper = upper();
  options.check_jacobian = false;
  options.step.largest_parameter =
      std::min(upper() - lower(), std::numeric_limits<double>::max()) / points_in_range;
  options.largest_state = resolvable;
  if (!has_one_sign()) return options;
  options.step.relative_parameter = largest_parameter_step;
  const double scale = model->parameters[static_cast<std::size_t>(index)].scale;
  const double least = std::min(std::abs(from), std::abs(to));
  options.step.smallest =
      std::max(std::min(options.step.smallest, smallest_step * largest_parameter_step * least / scale),
               std::numeric_limits<double>::min());
  return options;
}

double OverParameter::share(double value) const {
  const double share = has_one_sign() && value / from > 0 ? std::log(value / from) / std::log(to / from)
                                                          : (value - from) / (to - from);
  return std::clamp(share, 0.0, 1.0);
}

double OverParameter::value(double share) const {
  if (share <= 0) return from;
  if (share >= 1) return to;
  return has_one_sign() ? from * std::pow(to / from, share) : from + share * (to - from);
}

std::shared_ptr<const model::Model> OverParameter::at(double value) const {
  auto moved = std::make_shared<model::Model>(*model);
  moved->parameters[static_cast<std::size_t>(index)].value = value;
  return moved;
}

OverParameter over_parameter(scene::Scene scene, const std::string& over, double from, double to,
                             control::Control control) {
  scene::set(scene, over, to);
  scene::set(scene, over, from);
  model::Model model = model::build(scene);
  model.control = std::move(control);
  OverParameter result;
  result.name = over;
  result.index = model::parameter_index(model, over);
  result.from = from;
  result.to = to;
  const double product = from * to, width = std::abs(to - from);  // which may overflow or vanish
  const double mean =
      std::isnormal(product) ? std::sqrt(product) : std::sqrt(std::abs(from)) * std::sqrt(std::abs(to));
  model.parameters[static_cast<std::size_t>(result.index)].scale =
      result.has_one_sign() ? mean : std::min(width, std::numeric_limits<double>::max());
  result.model = std::make_shared<const model::Model>(std::move(model));
  return result;
}

void set_end(const OverParameter& way, const continuation::BranchStop& stop, const std::string& doubt,
             ResponseBranch& result) {
  result.status = status_of(stop.reason);
  result.stop = {reason_of(stop.reason), stop.value, stop.limit, stop.message};
  if (stop.reason != continuation::StopReason::boundary) return;
  result.stop.limit = way.to;
  if (stop.value == way.to) {
    result.doubt = doubt;
    result.stop.message = "reached the end of the range at " + way.name + " = " + to_digits(way.to, 8) +
                          (doubt.empty() ? "" : "; " + doubt);
    return;
  }
  result.status = Status::stopped;
  double farthest = way.from;
  for (const auto& event : result.events)
    if (event.kind == event_kinds::fold && way.direction() * (event.point.over - farthest) > 0)
      farthest = event.point.over;
  result.stop.message = "turned back at " + way.name + " = " + to_digits(farthest, 8) +
                        " and left the range at its start, " + to_digits(way.from, 8);
}

}  // namespace arcslip::observables
