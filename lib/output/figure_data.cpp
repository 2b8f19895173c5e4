#include <arcslip/output/figure_data.hpp>

#include <arcslip/output/friction_elements.hpp>
#include <arcslip/output/units.hpp>
#include <arcslip/scene/visible.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace arcslip::output {
namespace {

using observables::ResponseBranch;
using observables::ResponsePoint;
using scene::StudyKind;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double decade = 10;

Record record(const scene::Scene& scene, const FigureData& data, const ResponsePoint& point) {
  Record values;
  if (data.kind != StudyKind::frf) {
    values.push_back(point.over);
  }
  values.push_back(in_scene_unit(scene, point.omega));
  values.push_back(point.unbounded ? nan : point.amplitude);
  for (const std::string& element : data.friction) {
    values.push_back(stick_percent(point, element));
  }
  return values;
}

template <class Visit>
void for_each_record(const FigureData& data, const Visit& visit) {
  for (const FigureLine& line : data.lines) {
    for (const auto& part : line.parts) {
      std::for_each(part.begin(), part.end(), visit);
    }
    for (const FigureMark& mark : line.marks) {
      visit(mark.record);
    }
  }
}

Range range_of(const FigureData& data, std::size_t column, double above) {
  Range range{infinity, -infinity};
  for_each_record(data, [&](const Record& values) {
    const double value = values[column];
    if (std::isfinite(value) && value > above) {
      range = {std::min(range.lower, value), std::max(range.upper, value)};
    }
  });
  return range;
}

/// Amplitudes of frequency responses are shown by their logarithm, which no resonance dwarfs; other columns
/// where they are positive and span decades.
void set_ranges(FigureData& data) {
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    FigureColumn& column = data.columns[i];
    column.range = full_range(data, i);
    if (column.scale == Scale::percent || i == data.frequency_column()) {
      continue;
    }
    const bool is_amplitude = i == data.amplitude_column();
    const Range positive = is_amplitude ? range_of(data, i, 0) : column.range;
    if (positive.lower > 0 && positive.upper >= positive.lower &&
        ((is_amplitude && data.kind == StudyKind::frf) || positive.upper > decade * positive.lower)) {
      column.scale = Scale::logarithmic;
      column.range = positive;
    }
  }
}

void set_columns(const scene::Scene& scene, std::span<const ResponseBranch> branches, FigureData& data) {
  if (data.kind != StudyKind::frf) {
    const std::string name = branches.empty() ? "" : branches.front().over;
    data.columns.push_back({with_unit(name, name.empty() ? "" : parameter_unit(scene, name))});
  }
  data.columns.push_back({with_unit("frequency", scene::unit_name(scene.frequency_unit))});
  data.columns.push_back({"amplitude (m)"});
  for (const std::string& element : data.friction) {
    data.columns.push_back({element + " stick (%)", Scale::percent});
  }
}

void write_record(std::ostream& out, const Record& values) {
  const char* separator = "";
  for (const double value : values) {
    out << separator << shortest(value);
    separator = " ";
  }
  out << '\n';
}

}  // namespace

std::string set_label(const scene::Scene& scene, const std::vector<std::pair<std::string, double>>& set) {
  std::string text;
  for (const auto& [name, value] : set) {
    text.append(text.empty() ? "" : ", ").append(quantity(value, parameter_unit(scene, name)));
  }
  return text;
}

Range full_range(const FigureData& data, std::size_t column) {
  return range_of(data, column, -infinity);
}

FigureData figure_data(const scene::Scene& scene, StudyKind kind, std::span<const ResponseBranch> branches) {
  FigureData data;
  data.kind = kind;
  data.title = scene.title;
  data.friction = friction_elements(branches);
  set_columns(scene, branches, data);
  for (const ResponseBranch& branch : branches) {
    if (branch.points.empty()) {
      continue;
    }
    if (data.parameters.empty()) {
      for (const auto& [name, value] : branch.set) {
        data.parameters.push_back(name);
      }
    }
    auto line = std::find_if(data.lines.begin(), data.lines.end(),
                             [&](const FigureLine& candidate) { return candidate.set == branch.set; });
    if (line == data.lines.end()) {
      line = data.lines.insert(line, FigureLine{set_label(scene, branch.set), branch.set, {}, {}});
    }
    for (const observables::ResponseEvent& event : branch.events) {
      line->unbounded = line->unbounded || event.point.unbounded;
      if (std::find(mark_kinds.begin(), mark_kinds.end(), event.kind) != mark_kinds.end()) {
        line->marks.push_back({event.kind, record(scene, data, event.point)});
      }
    }
    std::vector<Record>& part = line->parts.emplace_back();
    for (const ResponsePoint& point : branch.points) {
      line->unbounded = line->unbounded || point.unbounded;
      part.push_back(record(scene, data, point));
    }
  }
  set_ranges(data);
  return data;
}

void write_figure_data(std::ostream& out, const scene::Scene& scene, const FigureData& data) {
  const char* separator = "# ";
  for (const FigureColumn& column : data.columns) {
    out << separator << scene::visible(column.label);
    separator = ", ";
  }
  out << '\n';
  for (const FigureLine& line : data.lines) {
    out << "# " << assignment(scene, line.set) << '\n';
    for (const auto& part : line.parts) {
      for (const Record& values : part) {
        write_record(out, values);
      }
      out << '\n';
    }
    out << '\n';
    for (const std::string_view kind : mark_kinds) {
      bool any = false;
      for (const FigureMark& mark : line.marks) {
        if (mark.kind == kind) {
          write_record(out, mark.record);
          any = true;
        }
      }
      out << (any ? "\n\n" : "");
    }
  }
}

}  // namespace arcslip::output
