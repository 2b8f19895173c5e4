#include <arcslip/studies/presentation/histories.hpp>

#include <string>
#include <utility>

namespace arcslip::studies {

using observables::ElementHistory;
using observables::ResponseBranch;
using observables::ResponsePoint;

std::span<const std::string_view> direction_names(const scene::Part& element) {
  return element.type->slots_with(element.options);
}

results::TableOf<Instant> history_table(const scene::Scene& scene) {
  results::TableOf<Instant> table;
  const std::vector<scene::Part> elements = scene::all_elements(scene);
  table.add({"time"}, "s", "of the period",
            [](const Instant& at) { return at.history->angle[at.i] / at.history->base_frequency; });
  table.add({"angle"}, "rad", "base frequency times the time",
            [](const Instant& at) { return at.history->angle[at.i]; });
  table.add({"displacement"}, "m", "of the response",
            [](const Instant& at) { return at.history->displacement[at.i]; });
  table.add({"velocity"}, "m/s", "of the response",
            [](const Instant& at) { return at.history->velocity[at.i]; });
  const auto add = [&](std::size_t e, const char* key, const char* unit, const char* help,
                       std::vector<double> ElementHistory::*member) {
    table.add({"elements", elements[e].name, key}, unit, help,
              [e, member](const Instant& at) { return (at.history->elements[e].*member)[at.i]; });
  };
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!elements[e].detailed) continue;
    add(e, "displacement", "m", "of the element", &ElementHistory::displacement);
    add(e, "velocity", "m/s", "of the element", &ElementHistory::velocity);
    add(e, "force", "N", "of the law, against the motion", &ElementHistory::force);
    add(e, "series", "N", "the same as the truncated Fourier series", &ElementHistory::series);
    const auto names = direction_names(elements[e]);
    for (std::size_t i = 1; i < names.size(); ++i) {
      const auto add_further = [&](const char* key, const char* unit, const char* help,
                                   std::vector<double> observables::DirectionHistory::*member) {
        table.add({"elements", elements[e].name, "directions", std::string(names[i]), key}, unit, help,
                  [e, i, member](const Instant& at) {
                    return (at.history->elements[e].further[i - 1].*member)[at.i];
                  });
      };
      add_further("displacement", "m", "along a further direction",
                  &observables::DirectionHistory::displacement);
      add_further("force", "N", "along a further direction", &observables::DirectionHistory::force);
    }
  }
  return table;
}

std::vector<Instant> instants(const observables::History& history) {
  std::vector<Instant> all;
  for (std::size_t i = 0; i < history.angle.size(); ++i) all.push_back({&history, i});
  return all;
}

namespace {

/// What a motion is computed from. All angles at which contacts change are those of one element.
ResponsePoint kept(const ResponsePoint& point) {
  ResponsePoint some;
  auto& angles = some.elements.emplace_back().slip_angles;
  for (const observables::ElementResponse& element : point.elements) {
    angles.insert(angles.end(), element.slip_angles.begin(), element.slip_angles.end());
    angles.insert(angles.end(), element.reversal_angles.begin(), element.reversal_angles.end());
  }
  some.omega = point.omega;
  some.over = point.over;
  some.unbounded = point.unbounded;
  some.unknowns = point.unknowns;
  return some;
}

}  // namespace

results::MotionAt motion_at(std::shared_ptr<const scene::Scene> scene, const ResponseBranch& branch) {
  auto some = std::make_shared<ResponseBranch>();
  some->over = branch.over;
  some->set = branch.set;
  some->harmonics = branch.harmonics;
  some->period = branch.period;
  for (const ResponsePoint& point : branch.points) some->points.push_back(kept(point));
  for (const observables::ResponseEvent& event : branch.events)
    some->events.push_back({.kind = {}, .point = kept(event.point)});
  return [scene = std::move(scene), some = std::move(some)](std::size_t table, std::size_t row, int steps) {
    const ResponsePoint& point = table == 0 ? some->points.at(row) : some->events.at(row).point;
    const auto angles = observables::loop_angles(point, steps);
    const observables::History history = observables::history(*scene, *some, point, angles);
    const auto columns = history_table(*scene);
    return results::TableRows{{"history", columns.columns(), {"elements"}, true},
                              columns.rows(instants(history))};
  };
}

}  // namespace arcslip::studies
