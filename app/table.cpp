#include "table.hpp"

#include <arcslip/studies/friction_elements.hpp>
#include <arcslip/studies/units.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {
namespace {

using observables::Motion;
using observables::ResponseBranch;
using Row = std::vector<std::string>;

std::string formatted(const char* format, double value) {
  if (!std::isfinite(value)) {
    return "-";
  }
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// `parameters`: those that are set, then the one that the branches are over.
Row header(const scene::Scene& scene, const Row& parameters, const Row& friction) {
  Row row;
  for (const std::string& name : parameters) {
    row.push_back(studies::with_unit(name, studies::parameter_unit(scene, name)));
  }
  row.insert(row.end(),
             {"event", studies::with_unit("frequency", scene::unit_name(scene.frequency_unit)), "A_max (m)"});
  for (const std::string& name : friction) {
    row.push_back(friction.size() == 1 ? "stick (%)" : name + " stick (%)");
  }
  row.emplace_back("branch");
  return row;
}

/// A row for an event, or for a branch that has none.
Row row(const scene::Scene& scene, const ResponseBranch& branch, const observables::ResponseEvent* event,
        const Row& friction) {
  Row cells;
  for (const auto& [name, value] : branch.set) {
    cells.push_back(results::shortest(value));
  }
  if (!branch.over.empty()) {
    cells.push_back(event != nullptr ? formatted("%.8g", event->point.over) : "-");
  }
  if (event != nullptr) {
    const observables::ResponsePoint& point = event->point;
    cells.insert(cells.end(), {event->kind, formatted("%.8f", studies::in_scene_unit(scene, point.omega)),
                               point.unbounded ? "unbounded" : formatted("%.8e", point.amplitude)});
    for (const std::string& name : friction) {
      cells.push_back(formatted("%.4f", studies::stick_percent(point, name)));
    }
  } else {
    cells.insert(cells.end(), 3 + friction.size(), "-");
  }
  cells.emplace_back(observables::name(branch.status));
  return cells;
}

/// Of UTF-8.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

void write_aligned(std::ostream& out, std::vector<Row> rows) {
  std::vector<std::size_t> widths;
  for (Row& cells : rows) {
    widths.resize(std::max(widths.size(), cells.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i] = results::visible(cells[i]);
      widths[i] = std::max(widths[i], characters(cells[i]));
    }
  }
  for (const Row& cells : rows) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      line += (i > 0 ? "  " : "") + std::string(widths[i] - characters(cells[i]), ' ') + cells[i];
    }
    out << line << '\n';
  }
}

}  // namespace

void write_table(std::ostream& out, const scene::Scene& scene, std::span<const ResponseBranch> branches) {
  if (branches.empty()) {
    return;
  }
  Row parameters;
  for (const auto& [name, value] : branches.front().set) {
    parameters.push_back(name);
  }
  if (!branches.front().over.empty()) {
    parameters.push_back(branches.front().over);
  }
  const Row friction = studies::friction_elements(branches);
  std::vector<Row> rows{header(scene, parameters, friction)};
  for (const ResponseBranch& branch : branches) {
    for (const observables::ResponseEvent& event : branch.events) {
      rows.push_back(row(scene, branch, &event, friction));
    }
    if (branch.events.empty()) {
      rows.push_back(row(scene, branch, nullptr, friction));
    }
  }
  write_aligned(out, std::move(rows));
}

void write_table(std::ostream& out, const scene::Scene& scene, std::span<const Motion> motions) {
  if (motions.empty()) {
    return;
  }
  Row head;
  for (const auto& [name, value] : motions.front().set) {
    head.push_back(studies::with_unit(name, studies::parameter_unit(scene, name)));
  }
  head.insert(head.end(), {"method", studies::with_unit("frequency", scene::unit_name(scene.frequency_unit)),
                           "A_max (m)"});
  const auto& elements = motions.front().elements;
  for (const observables::ElementMotion& element : elements) {
    head.push_back(elements.size() == 1 ? "stick (%)" : element.name + " stick (%)");
  }
  head.insert(head.end(), {"E_friction (J)", "E_viscous (J)", "multiplier", "periods", "motion"});
  std::vector<Row> rows{head};
  for (const Motion& motion : motions) {
    Row& cells = rows.emplace_back();
    for (const auto& [name, value] : motion.set) {
      cells.push_back(results::shortest(value));
    }
    cells.insert(cells.end(), {std::string(scene::method_name(motion.method)),
                               formatted("%.8f", studies::in_scene_unit(scene, motion.omega)),
                               formatted("%.8e", motion.amplitude)});
    for (std::size_t i = 0; i < elements.size(); ++i) {
      cells.push_back(i < motion.elements.size() ? formatted("%.4f", motion.elements[i].stick_percent) : "-");
    }
    cells.insert(cells.end(),
                 {formatted("%.6e", motion.energy.friction), formatted("%.6e", motion.energy.viscous),
                  motion.multipliers.empty() ? "-" : formatted("%.6f", std::abs(motion.multipliers.front())),
                  std::to_string(motion.periods), observables::name(motion.status)});
  }
  write_aligned(out, std::move(rows));
}

}  // namespace arcslip::app
