#include <arcslip/output/figure_data.hpp>

#include <arcslip/output/friction_elements.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <limits>
#include <ostream>

namespace arcslip::output {
namespace {

using observables::ResponseBranch;
using observables::ResponsePoint;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> stick_percents(const ResponsePoint& point, const std::vector<std::string>& friction) {
  std::vector<double> percents;
  for (const std::string& element : friction) {
    percents.push_back(stick_percent(point, element));
  }
  return percents;
}

double amplitude(const ResponsePoint& point) {
  return point.unbounded ? nan : point.amplitude;
}

std::string label(const scene::Scene& scene, const ResponseBranch& branch) {
  std::string text;
  for (const auto& [name, value] : branch.set) {
    text.append(text.empty() ? "" : ", ").append(quantity(value, parameter_unit(scene, name)));
  }
  return text;
}

void write_record(std::ostream& out, double frequency, double height, const std::vector<double>& stick) {
  out << shortest(frequency) << ' ' << shortest(height);
  for (const double percent : stick) {
    out << ' ' << shortest(percent);
  }
  out << '\n';
}

void write_marks(std::ostream& out, const FigureLine& line, bool peaks) {
  bool any = false;
  for (const FigureMark& mark : line.marks) {
    if (mark.peak == peaks) {
      write_record(out, mark.frequency, mark.amplitude, mark.stick);
      any = true;
    }
  }
  if (any) {
    out << "\n\n";
  }
}

}  // namespace

FigureData figure_data(const scene::Scene& scene, std::span<const ResponseBranch> branches) {
  FigureData data;
  data.title = scene.title;
  data.frequency_unit = scene::to_rad_per_s(scene.frequency_unit);
  data.frequency_label = with_unit("frequency", scene::unit_name(scene.frequency_unit));
  data.friction = friction_elements(branches);
  data.frequency = {infinity, -infinity};
  data.amplitude = {infinity, 0};
  for (const ResponseBranch& branch : branches) {
    if (branch.points.empty()) {
      continue;
    }
    if (data.parameters.empty()) {
      for (const auto& [name, value] : branch.set) {
        data.parameters.push_back(name);
      }
    }
    auto line = std::find_if(data.lines.begin(), data.lines.end(), [&](const FigureLine& candidate) {
      return candidate.parts.front()->set == branch.set;
    });
    if (line == data.lines.end()) {
      line = data.lines.insert(line, FigureLine{label(scene, branch), {}, {}});
    }
    line->parts.push_back(&branch);
    for (const observables::ResponseEvent& event : branch.events) {
      if (event.kind == "peak" || event.kind == "fold") {
        line->marks.push_back({event.kind == "peak", in_scene_unit(scene, event.point.omega),
                               amplitude(event.point), stick_percents(event.point, data.friction)});
      }
    }
    for (const ResponsePoint& point : branch.points) {
      const double frequency = in_scene_unit(scene, point.omega);
      data.frequency = {std::min(data.frequency.lower, frequency), std::max(data.frequency.upper, frequency)};
      if (const double height = amplitude(point); height > 0) {
        data.amplitude = {std::min(data.amplitude.lower, height), std::max(data.amplitude.upper, height)};
      }
    }
    for (const FigureMark& mark : line->marks) {
      if (mark.amplitude > 0) {
        data.amplitude.upper = std::max(data.amplitude.upper, mark.amplitude);
      }
    }
  }
  return data;
}

void write_figure_data(std::ostream& out, const scene::Scene& scene, const FigureData& data) {
  out << "# " << data.frequency_label << ", amplitude (m)";
  for (const std::string& element : data.friction) {
    out << ", " << element << " stick (%)";
  }
  out << '\n';
  for (const FigureLine& line : data.lines) {
    out << "# " << assignment(scene, line.parts.front()->set) << '\n';
    for (const ResponseBranch* part : line.parts) {
      for (const ResponsePoint& point : part->points) {
        write_record(out, in_scene_unit(scene, point.omega), amplitude(point),
                     stick_percents(point, data.friction));
      }
      out << '\n';
    }
    out << '\n';
    write_marks(out, line, true);
    write_marks(out, line, false);
  }
}

}  // namespace arcslip::output
