#include <arcslip/optimize/optimum_curve_output.hpp>

#include <arcslip/output/csv_text.hpp>
#include <arcslip/output/draw_figures.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <ostream>

namespace arcslip::optimize {
namespace {

constexpr double decade = 10;

// Of the only friction element; null where there is not exactly one.
const observables::ElementResponse* friction_of(const observables::ResponsePoint& point) {
  const observables::ElementResponse* only = nullptr;
  for (const auto& element : point.elements) {
    if (element.has_stick && only) return nullptr;
    if (element.has_stick) only = &element;
  }
  return only;
}

// As a branch over s, for the figures.
observables::ResponseBranch branch_of(const OptimumCurveResult& result) {
  observables::ResponseBranch branch;
  branch.over = result.curve.along;
  branch.set = result.set;
  for (const OptimumPoint& at : result.curve.points) {
    branch.points.push_back(at.response);
    branch.points.back().over = at.along;
  }
  return branch;
}

// What figure a kind of events is marked with; empty: none.
std::string mark_of(const std::string& kind) {
  return kind == "turning_point" ? "turn" : kind == "minimum" || kind == "maximum" ? kind : "";
}

output::FigureData figure_of(const scene::Scene& scene, const OptimumCurveResult& result) {
  const observables::ResponseBranch branch = branch_of(result);
  output::FigureData data = output::figure_data(scene, scene::StudyKind::optimum, {&branch, 1});
  if (data.lines.empty()) return data;
  output::FigureLine& line = data.lines.front();
  const auto add = [](output::Record& record, const OptimumPoint& at) {
    record.insert(record.end(), at.design.begin(), at.design.end());
  };
  for (const OptimumEvent& event : result.curve.events) {
    if (mark_of(event.kind).empty()) continue;
    output::Record record = line.parts[0][std::min(event.after, line.parts[0].size() - 1)];
    record[0] = event.point.along;
    record[data.frequency_column()] = output::in_scene_unit(scene, event.point.response.omega);
    record[data.amplitude_column()] = event.point.amplitude;
    add(record, event.point);
    line.marks.push_back({mark_of(event.kind), record});
  }
  for (std::size_t i = 0; i < line.parts[0].size(); ++i) add(line.parts[0][i], result.curve.points[i]);
  for (const DesignVariable& v : result.problem.over) {
    data.further.push_back({v.name, data.columns.size()});
    data.columns.push_back({output::with_unit(v.name, output::parameter_unit(scene, v.name))});
  }
  return data;
}

}  // namespace

void write_csv(std::ostream& out, const scene::Scene& scene, std::span<const OptimumCurveResult> results) {
  using output::detail::csv_number;
  if (results.empty()) return;
  const auto of_another = [&](const auto& result) { return result.study != results.front().study; };
  const bool several_studies = std::any_of(results.begin(), results.end(), of_another);
  std::vector<std::string> names;
  for (const OptimumCurveResult& result : results)
    for (const auto& [name, value] : result.set) output::detail::add_name(name, names);
  for (const OptimumCurveResult& result : results) output::detail::add_name(result.curve.along, names);
  for (const OptimumCurveResult& result : results)
    for (const DesignVariable& v : result.problem.over) output::detail::add_name(v.name, names);
  std::vector<std::string> titles(several_studies ? 1 : 0, "study");
  titles.insert(titles.end(), {"curve", "what"});
  for (const std::string& name : names)
    titles.push_back(output::with_unit(name, output::parameter_unit(scene, name)));
  titles.insert(titles.end(),
                {"amplitude (m)", output::with_unit("frequency", scene::unit_name(scene.frequency_unit)),
                 "stick (%)", "active peaks", "minimum"});
  output::detail::write_csv_header(out, titles);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const OptimumCurveResult& result = results[i];
    const OptimumCurve& curve = result.curve;
    const auto row = [&](const std::string& what, const OptimumPoint& at) {
      std::vector<std::string> cells(several_studies ? 1 : 0, output::detail::csv_text(result.study));
      cells.insert(cells.end(), {std::to_string(i + 1), what});
      for (const std::string& name : names) {
        std::string& cell = cells.emplace_back(name == curve.along ? csv_number(at.along) : "");
        for (const auto& [key, value] : result.set)
          if (key == name) cell = csv_number(value);
        for (std::size_t k = 0; k < at.design.size(); ++k)
          if (result.problem.over[k].name == name) cell = csv_number(at.design[k]);
      }
      const auto* element = friction_of(at.response);
      cells.insert(cells.end(),
                   {csv_number(at.amplitude), csv_number(output::in_scene_unit(scene, at.response.omega)),
                    element ? csv_number(element->stick_percent) : "", std::to_string(at.peaks.size()),
                    at.minimum ? "yes" : "no"});
      output::detail::write_csv_row(out, cells);
    };
    auto event = curve.events.begin();
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      row("point", curve.points[k]);
      for (; event != curve.events.end() && event->after <= k; ++event) row(event->kind, event->point);
    }
  }
}

output::Figures write_figures(const scene::Scene& scene, std::span<const OptimumCurveResult> results,
                              const std::string& folder, const std::string& name,
                              const scene::StopRequest& stop) {
  output::FigureData all;
  all.kind = scene::StudyKind::optimum;
  for (const OptimumCurveResult& result : results) {
    output::FigureData one = figure_of(scene, result);
    if (one.lines.empty()) continue;
    if (all.columns.empty())
      all = std::move(one);
    else
      all.lines.push_back(std::move(one.lines.front()));
  }
  for (std::size_t i = 0; i < all.columns.size(); ++i) {
    output::FigureColumn& column = all.columns[i];
    column.range = output::full_range(all, i);
    if (column.scale != output::Scale::percent && i != all.frequency_column())
      column.scale = column.range.lower > 0 && column.range.upper > decade * column.range.lower
                         ? output::Scale::logarithmic
                         : output::Scale::linear;
  }
  return output::draw_figures(scene, all, folder, name, stop);
}

}  // namespace arcslip::optimize
