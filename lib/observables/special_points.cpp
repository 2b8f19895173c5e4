#include <arcslip/observables/special_points.hpp>

#include <arcslip/observables/unbounded.hpp>

#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::StopReason;
using continuation::Vector;

constexpr double beyond_display = 1e6;  // |u| in scales: where it is asked whether the response is bounded

// From one pole to the next. Returns where the branch goes on beyond it, or the end of the window.
double add_points(const std::shared_ptr<const model::Model>& model, double over, double from,
                  const FrequencyWindow& window, const std::string& kind, const GoOn& go_on,
                  SpecialPoints& found) {
  const double width = window.upper - window.lower;
  if (const auto growth = unbounded_resonance(model, from); growth.unbounded) {
    found.unbounded = growth.message;
    return beyond_pole({{from, HUGE_VAL}}, width);
  }
  const std::size_t before = found.points.size();
  std::vector<std::pair<double, double>> course{{from, 0.0}};
  bool unbounded = false;
  const auto record = [&](Observer& observer, const Accepted& now, const continuation::Event* event) {
    if (event) {
      if (event->monitor != kind) return true;
      Vector x(now.u.size() + 1);
      x << now.u, now.parameter;
      found.points.push_back({{}, over, std::move(x), event->nonsmooth});
      return true;
    }
    const double last = course.back().second;
    course.emplace_back(now.parameter, now.u.norm() / observer.problem().displacement());
    if (!(course.back().second > beyond_display && last <= beyond_display)) return true;
    const auto growth = unboundedness(observer.problem(), now.p, now.u);
    unbounded = growth.unbounded;
    if (unbounded) found.unbounded = growth.message;
    return !unbounded;
  };
  const auto swept = frequency_branch(model, window, from, record, 1, Steps::curve, go_on);
  for (std::size_t i = before; i < found.points.size(); ++i) found.points[i].problem = swept.problem;
  if (unbounded) return beyond_pole(course, width);
  if (swept.branch.stop.reason != StopReason::boundary) found.failure = swept.branch.stop.message;
  return window.upper;
}

}  // namespace

SpecialPoints special_points(const OverParameter& way, double over, const FrequencyWindow& window,
                             const std::string& kind, const GoOn& go_on) {
  SpecialPoints found;
  const auto model = way.at(over);
  double from = window.lower;
  for (int piece = 0; piece <= 2 * model->dofs && from < window.upper; ++piece)
    from = add_points(model, over, from, window, kind, go_on, found);
  return found;
}

}  // namespace arcslip::observables
