#include <arcslip/diagrams/output.hpp>
#include <arcslip/diagrams/parts.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace arcslip::diagrams {
namespace {

using continuation::Branch;
using continuation::Event;
using continuation::Point;
using results::FigureData;
using results::FigureLine;
using results::Record;

Record record_of(const Point& point, const Columns& columns) {
  Record record{point.parameter};
  for (const Quantity& quantity : columns.quantities) record.push_back(quantity.value(point));
  return record;
}

bool changes_stability(const Event& event) {
  return std::holds_alternative<continuation::Fold>(event.data) ||
         std::holds_alternative<continuation::BranchPoint>(event.data) ||
         std::holds_alternative<continuation::Hopf>(event.data);
}

// The points of a branch with its events between them, in parts of one stability.
void add_curve(const BranchPart& of, const Columns& columns, FigureLine& line) {
  const Branch& branch = *of.branch;
  std::size_t range = 0, event = 0;
  const auto begin_part = [&] {
    line.parts.emplace_back();
    if (!of.stability.empty()) line.unstable.push_back(of.stability[range].unstable > 0);
  };
  begin_part();
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    line.parts.back().push_back(record_of(branch.points[i], columns));
    bool is_change = range + 1 < of.stability.size() && of.stability[range].last == i;
    const auto change = [&](const Record& at) {
      ++range;
      begin_part();
      line.parts.back().push_back(at);
      is_change = false;
    };
    for (; event < branch.events.size() && branch.events[event].after == i; ++event) {
      line.parts.back().push_back(record_of(branch.events[event].point, columns));
      if (is_change && changes_stability(branch.events[event])) change(Record(line.parts.back().back()));
    }
    if (is_change) change(Record(line.parts.back().back()));
  }
}

FigureData data_of(const std::vector<BranchPart>& parts, const Columns& columns) {
  FigureData data;
  data.title = columns.title;
  data.columns.push_back({columns.parameter, columns.parameter_unit});
  for (std::size_t q = 0; q < columns.quantities.size(); ++q) {
    data.columns.push_back({columns.quantities[q].name, columns.quantities[q].unit});
    data.figures.push_back({columns.quantities[q].name, 0, q + 1});
  }
  for (const BranchPart& part : parts) {
    FigureLine line;
    if (parts.size() > 1) line.label = "branch " + std::to_string(data.lines.size() + 1);
    line.heading = line.label;
    const bool has_unknowns = !part.branch->points.empty() && part.branch->points.front().u.size() > 0;
    if (has_unknowns) add_curve(part, columns, line);
    for (std::size_t e = 0; e < part.labels.size(); ++e)
      if (const Event& event = part.branch->events[e]; event.point.u.size() > 0)
        line.marks.push_back({kind_of(event), record_of(event.point, columns), part.labels[e]});
    data.lines.push_back(std::move(line));
  }
  for (std::size_t c = 0; c < data.columns.size(); ++c) data.columns[c].range = results::full_range(data, c);
  return data;
}

}  // namespace

FigureData figure_data_of(const Branch& branch, const Columns& columns) {
  return data_of(parts_of(branch), columns);
}

FigureData figure_data_of(const continuation::WholeBranch& branch, const Columns& columns) {
  return data_of(parts_of(branch), columns);
}

FigureData figure_data_of(const continuation::Diagram& diagram, const Columns& columns) {
  return data_of(parts_of(diagram), columns);
}

}  // namespace arcslip::diagrams
