#include <arcslip/analyses/branches/branch_description.hpp>

#include <arcslip/results/event_kinds.hpp>
#include <arcslip/stability/stability.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::observables {

namespace {

constexpr double constant = 1e-11;             // relative changes of the amplitude below
constexpr double at_rest_to = 1e-12;           // of |u|: a coordinate with less does not move
constexpr std::ptrdiff_t points_per_side = 2;  // that are looked at, on each side
constexpr double largest_estimate = 0.1;       // of the amplitude: beyond, the first order is not all
constexpr int points_of_flat_peak = 3;         // on both sides: a point may lie next to any peak by chance

}  // namespace

using continuation::StopReason;

ResponseBranch described(const model::Model& model, const std::string& over) {
  ResponseBranch branch;
  branch.over = over;
  for (const auto& parameter : model.parameters)
    if (parameter.name != "frequency" && parameter.name != over)
      branch.parameters.emplace_back(parameter.name, parameter.value);
  const auto& h = model.harmonics;
  branch.period = h.period;
  branch.symmetry = h.odd ? Symmetry::antisymmetric : Symmetry::none;
  for (int i = 0; i < h.cosines(); ++i) branch.harmonics.push_back(h.cosine_order(i));
  return branch;
}

bool departs(const std::vector<std::pair<double, double>>& course, double arclength, double amplitude) {
  const auto after = std::upper_bound(course.begin(), course.end(), arclength,
                                      [](double s, const auto& point) { return s < point.first; });
  const auto differs = [&](const auto& point) {
    return std::abs(point.second - amplitude) > constant * std::abs(amplitude);
  };
  const auto first = after - course.begin() > points_per_side ? after - points_per_side : course.begin();
  const auto last = course.end() - after > points_per_side ? after + points_per_side : course.end();
  return std::any_of(first, after, differs) && std::any_of(after, last, differs);
}

bool is_rounding(const Solution& point) {
  const auto& u = point.unknowns;
  return !point.unbounded &&
         point.amplitude <=
             at_rest_to *
                 Eigen::Map<const continuation::Vector>(u.data(), static_cast<Eigen::Index>(u.size())).norm();
}

void drop_peaks_of_rounding(ResponseBranch& branch) {
  std::erase_if(branch.events, [](const ResponseEvent& event) {
    return event.kind == event_kinds::peak && is_rounding(event.point);
  });
}

void drop_extrema_of_rounding(const std::vector<std::pair<double, double>>& course,
                              const std::vector<double>& at, ResponseBranch& result) {
  std::vector<bool> drops(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::string& kind = result.events[i].kind;
    if (kind != event_kinds::maximum && kind != event_kinds::minimum) continue;
    const double amplitude = result.events[i].point.amplitude;
    const double side = kind == event_kinds::maximum ? 1 : -1;
    const auto is_beyond = [&](double other) {
      return side * (amplitude - other) >= -constant * std::abs(amplitude);
    };
    const auto next = std::upper_bound(course.begin(), course.end(), at[i],
                                       [](double s, const auto& point) { return s < point.first; });
    const bool follows_event = i > 0 && (next == course.begin() || at[i - 1] >= (next - 1)->first);
    const bool precedes_event = i + 1 < at.size() && (next == course.end() || at[i + 1] <= next->first);
    const bool before = follows_event ? is_beyond(result.events[i - 1].point.amplitude)
                                      : next == course.begin() || is_beyond((next - 1)->second);
    const bool after = precedes_event ? is_beyond(result.events[i + 1].point.amplitude)
                                      : next == course.end() || is_beyond(next->second);
    drops[i] = !before || !after || is_rounding(result.events[i].point) || !departs(course, at[i], amplitude);
  }
  for (std::size_t i = at.size(); i-- > 0;)
    if (drops[i]) result.events.erase(result.events.begin() + static_cast<std::ptrdiff_t>(i));
}

namespace {

template <class To, class Counts>
void add_to(To& to, const Counts& counts) {
  to.points += counts.points;
  to.rejected_steps += counts.rejected_steps;
  to.residuals += counts.residuals;
  to.jacobians += counts.jacobians;
  to.factorizations += counts.factorizations;
  to.solves += counts.solves;
}

void add_name(const std::string& solver, SolverSummary& to) {
  if (to.linear_solver.find(solver) == std::string::npos)
    to.linear_solver += (to.linear_solver.empty() ? "" : ", ") + solver;
}

}  // namespace

void estimate_flat_peaks(ResponseBranch& branch) {
  const auto& points = branch.points;
  for (ResponseEvent& event : branch.events) {
    if (event.kind != event_kinds::peak || event.point.unbounded) continue;
    const Solution& peak = event.point;
    double largest = peak.truncation_estimate;
    int level = 0;
    const auto is_level = [&](const Solution& nearby) {
      const double known_to = 2 * (peak.truncation_estimate + nearby.truncation_estimate);
      const double above = nearby.amplitude - peak.amplitude;
      const bool is_known =
          !nearby.truncation_flagged && nearby.truncation_estimate < largest_estimate * peak.amplitude;
      if (!is_known || !(std::abs(above) < known_to)) return false;
      largest = std::max(largest, nearby.truncation_estimate + std::max(above, 0.0));
      ++level;
      return true;
    };
    for (std::size_t i = event.after + 1; i-- > 0 && is_level(points[i]);) continue;
    for (std::size_t i = event.after + 1; i < points.size() && is_level(points[i]); ++i) continue;
    if (level >= points_of_flat_peak) event.point.truncation_estimate = largest;
  }
}

ResponseEvent event_of(const continuation::Event& event, ResponsePoint point) {
  set_apart(event.monitor, point);
  return {event.monitor, event.nonsmooth, event.located, std::move(point), event.after};
}

void add(const continuation::Counts& counts, SolverSummary& to) {
  add_to(to, counts);
}

void add(const continuation::Branch& traced, SolverSummary& to) {
  add_to(to, traced.counts);
  add_name(traced.linear_solver, to);
}

void add(const SolverSummary& part, SolverSummary& to) {
  add_to(to, part);
  add_name(part.linear_solver, to);
  to.seconds += part.seconds;
}

Status status_of(StopReason reason) {
  switch (reason) {
    case StopReason::boundary:
      return Status::complete;
    case StopReason::user:
    case StopReason::point_limit:
      return Status::stopped;
    default:
      return Status::failed;
  }
}

std::string frequency_text(double omega, scene::FrequencyUnit unit) {
  return to_digits(omega / scene::to_rad_per_s(unit), 8) + ' ' + std::string(scene::unit_name(unit));
}

}  // namespace arcslip::observables
