#include <arcslip/output/csv.hpp>

#include <arcslip/observables/quantities.hpp>
#include <arcslip/output/csv_text.hpp>
#include <arcslip/output/event_places.hpp>
#include <arcslip/output/friction_elements.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
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

/// A quantity and what its column is called.
struct Column {
  std::string_view path, name;
};

constexpr Column of_response[] = {{"frequency", "frequency"}, {"amplitude", "amplitude"}, {"phase", "phase"}};
constexpr Column of_response_behind_stick[] = {
    {"truncation_estimate", "truncation_estimate"},
    {"truncation_flagged", "truncation_flagged"},
    {"energy_friction", "energy_friction"},
    {"energy_viscous", "energy_viscous"},
    {"energy_total", "energy_total"},
    {"energy_input", "energy_input"},
    {"friction_percent", "friction"},
    {"force_per_displacement.in_phase.total", "force_in_phase"},
    {"force_per_displacement.out_of_phase.total", "force_out_of_phase"}};
constexpr Column stick = {"stick_percent", "stick"};
constexpr Column of_friction_element[] = {{"theta_0", "theta_0"},
                                          {"theta_star", "theta_star"},
                                          {"equivalent_stiffness", "equivalent_stiffness"},
                                          {"equivalent_damping", "equivalent_damping"}};

std::string title(const scene::Scene& scene, const Column& column) {
  const std::string_view unit = observables::response_quantity(column.path).unit;
  return with_unit(column.name,
                   unit == observables::frequency_unit ? scene::unit_name(scene.frequency_unit) : unit);
}

std::string title(const std::string& prefix, const Column& column) {
  return prefix + with_unit(column.name, observables::element_quantity(column.path).unit);
}

std::vector<std::string> header(const scene::Scene& scene, const Columns& columns) {
  std::vector<std::string> cells(columns.study ? 1 : 0, "study");
  for (const std::string& name : columns.parameters) {
    cells.push_back(with_unit(name, parameter_unit(scene, name)));
  }
  cells.insert(cells.end(), {"branch", "event"});
  for (const Column& column : of_response) {
    cells.push_back(title(scene, column));
  }
  const auto prefix = [&](const std::string& name) { return columns.friction.size() == 1 ? "" : name + "."; };
  for (const std::string& name : columns.friction) {
    cells.push_back(title(prefix(name), stick));
  }
  for (const Column& column : of_response_behind_stick) {
    cells.push_back(title(scene, column));
  }
  for (const std::string& name : columns.friction) {
    for (const Column& column : of_friction_element) {
      cells.push_back(title(prefix(name), column));
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

std::string cell(const scene::Scene& scene, const Column& column, const ResponsePoint& point) {
  const auto& quantity = observables::response_quantity(column.path);
  if (const auto* flag = std::get_if<observables::ResponseQuantity::Flag>(&quantity.get)) {
    return (*flag)(point) ? "yes" : "no";
  }
  const double value = number(quantity, point);
  return csv_number(quantity.unit == observables::frequency_unit ? in_scene_unit(scene, value) : value);
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
  if (point.unbounded) {  // nothing but its place is known
    cells.insert(cells.end(), {cell(scene, of_response[0], point), "inf"});
    cells.resize(count);
    return cells;
  }
  for (const Column& column : of_response) {
    cells.push_back(cell(scene, column, point));
  }
  for (const std::string& name : columns.friction) {
    cells.push_back(csv_number(stick_percent(point, name)));
  }
  for (const Column& column : of_response_behind_stick) {
    cells.push_back(cell(scene, column, point));
  }
  for (const std::string& name : columns.friction) {
    const observables::ElementResponse of = element(point, name);
    for (const Column& column : of_friction_element) {
      cells.push_back(csv_number(number(observables::element_quantity(column.path), of)));
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
