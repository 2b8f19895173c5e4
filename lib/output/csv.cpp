#include <arcslip/output/csv.hpp>

#include <arcslip/output/csv_text.hpp>
#include <arcslip/output/event_places.hpp>
#include <arcslip/output/friction_elements.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace arcslip::output {
namespace {

using detail::csv_number;
using detail::csv_text;
using detail::write_csv_row;
using observables::ResponseBranch;
using observables::ResponsePoint;

struct Columns {
  bool study = false;                   // whether branches are of more than one study
  std::vector<std::string> parameters;  // that some branch sets or is over
  std::vector<std::string> friction;    // elements that stick and slip
};

Columns columns_of(std::span<const ResponseBranch> branches) {
  Columns columns;
  for (const ResponseBranch& branch : branches) {
    columns.study = columns.study || branch.study != branches.front().study;
    for (const auto& [name, value] : branch.set) {
      detail::add_name(name, columns.parameters);
    }
    detail::add_name(branch.over, columns.parameters);
  }
  columns.friction = friction_elements(branches);
  return columns;
}

constexpr std::array<const char*, 4> of_friction_elements = {
    "theta_0 (rad)", "theta_star (rad)", "equivalent_stiffness (N/m)", "equivalent_damping (N s/m)"};

std::vector<std::string> header(const scene::Scene& scene, const Columns& columns) {
  std::vector<std::string> cells(columns.study ? 1 : 0, "study");
  for (const std::string& name : columns.parameters) {
    cells.push_back(with_unit(name, parameter_unit(scene, name)));
  }
  cells.insert(cells.end(),
               {"branch", "event", with_unit("frequency", scene::unit_name(scene.frequency_unit)),
                "amplitude (m)", "phase (rad)"});
  for (const std::string& name : columns.friction) {
    cells.push_back(columns.friction.size() == 1 ? "stick (%)" : name + ".stick (%)");
  }
  cells.insert(cells.end(), {"truncation_estimate (m)", "truncation_flagged", "energy_friction (J)",
                             "energy_viscous (J)", "energy_total (J)", "energy_input (J)", "friction (%)",
                             "force_in_phase (N/m)", "force_out_of_phase (N/m)"});
  for (const std::string& name : columns.friction) {
    const std::string of = columns.friction.size() == 1 ? "" : name + ".";
    for (const char* quantity : of_friction_elements) {
      cells.push_back(of + quantity);
    }
  }
  return cells;
}

/// An element of a point by its name; without values where there is none.
observables::ElementResponse element(const ResponsePoint& point, const std::string& name) {
  const auto found = std::find_if(point.elements.begin(), point.elements.end(),
                                  [&](const auto& candidate) { return candidate.name == name; });
  return found == point.elements.end() ? observables::ElementResponse{} : *found;
}

/// The value of a parameter at a point: where the branch has come, what is set for it, or the scene's own.
double parameter(const ResponseBranch& branch, const ResponsePoint& point, const std::string& name) {
  if (name == branch.over) {
    return point.over;
  }
  for (const auto* values : {&branch.set, &branch.parameters}) {
    for (const auto& [key, value] : *values) {
      if (key == name) {
        return value;
      }
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> row(const scene::Scene& scene, const Columns& columns, const ResponseBranch& branch,
                             std::size_t branch_number, const std::string& event, const ResponsePoint& point,
                             std::size_t count) {
  std::vector<std::string> cells(columns.study ? 1 : 0, csv_text(branch.study));
  for (const std::string& name : columns.parameters) {
    cells.push_back(csv_number(parameter(branch, point, name)));
  }
  cells.push_back(std::to_string(branch_number));
  cells.push_back(csv_text(event));
  cells.push_back(csv_number(in_scene_unit(scene, point.omega)));
  if (point.unbounded) {  // nothing but its place is known
    cells.emplace_back("inf");
    cells.resize(count);
    return cells;
  }
  cells.push_back(csv_number(point.amplitude));
  cells.push_back(csv_number(point.phase));
  for (const std::string& name : columns.friction) {
    cells.push_back(csv_number(stick_percent(point, name)));
  }
  cells.push_back(csv_number(point.truncation_estimate));
  cells.emplace_back(point.truncation_flagged ? "yes" : "no");
  cells.push_back(csv_number(point.energy_friction));
  const observables::PhaseParts force = point.forces.total();
  for (const double value : {point.energy_viscous, point.energy_total(), point.energy_input,
                             point.friction_percent(), force.in_phase, force.out_of_phase}) {
    cells.push_back(csv_number(value));
  }
  for (const std::string& name : columns.friction) {
    const observables::ElementResponse of = element(point, name);
    for (const double value : {of.theta_0, of.theta_star, of.equivalent_stiffness, of.equivalent_damping}) {
      cells.push_back(csv_number(value));
    }
  }
  return cells;
}

}  // namespace

void write_csv(std::ostream& out, const scene::Scene& scene, std::span<const ResponseBranch> branches) {
  const Columns columns = columns_of(branches);
  const std::vector<std::string> heads = header(scene, columns);
  detail::write_csv_header(out, heads);
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const ResponseBranch& branch = branches[b];
    const std::vector<std::size_t> before = points_before_events(branch);
    std::size_t event = 0;
    for (std::size_t i = 0; i <= branch.points.size(); ++i) {
      for (; event < branch.events.size() && before[event] == i; ++event) {
        const observables::ResponseEvent& found = branch.events[event];
        write_csv_row(out, row(scene, columns, branch, b + 1, found.kind, found.point, heads.size()));
      }
      if (i < branch.points.size()) {
        write_csv_row(out, row(scene, columns, branch, b + 1, "", branch.points[i], heads.size()));
      }
    }
  }
}

}  // namespace arcslip::output
