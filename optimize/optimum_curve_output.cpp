#include <arcslip/optimize/optimum_curve_output.hpp>

#include <arcslip/output/draw_figures.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>

namespace arcslip::optimize {
namespace {

constexpr double decade = 10;

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
