#include <arcslip/optimize/optimum_figures.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/studies/units.hpp>

#include <algorithm>

namespace arcslip::optimize {
namespace {

constexpr double decade = 10;
constexpr auto branch_kind = studies::BranchKind::over_parameter;

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
  if (kind == event_kinds::turning_point) return observables::event_kinds::turn;
  return kind == event_kinds::minimum || kind == event_kinds::maximum ? kind : "";
}

results::FigureData figure_of(const scene::Scene& scene, const OptimumCurveResult& result) {
  const observables::ResponseBranch branch = branch_of(result);
  results::FigureData data = studies::figures_of(scene, branch_kind, {&branch, 1});
  if (data.lines.empty()) return data;
  results::FigureLine& line = data.lines.front();
  const auto add = [](results::Record& record, const OptimumPoint& at) {
    record.insert(record.end(), at.design.begin(), at.design.end());
  };
  for (const OptimumEvent& event : result.curve.events) {
    if (mark_of(event.kind).empty()) continue;
    results::Record record = line.parts[0][std::min(event.after, line.parts[0].size() - 1)];
    record[0] = event.point.along;
    record[studies::frequency_column(branch_kind)] =
        studies::in_scene_unit(scene, event.point.response.omega);
    record[studies::amplitude_column(branch_kind)] = event.point.amplitude;
    add(record, event.point);
    line.marks.push_back({mark_of(event.kind), record});
  }
  for (std::size_t i = 0; i < line.parts[0].size(); ++i) add(line.parts[0][i], result.curve.points[i]);
  for (const DesignVariable& v : result.problem.over) {
    const std::string label = results::with_unit(v.name, studies::parameter_unit(scene, v.name));
    data.figures.push_back({v.name, 0, data.columns.size(), data.columns[0].label, label});
    data.columns.push_back({label});
  }
  return data;
}

}  // namespace

results::FigureData figures_of(const scene::Scene& scene, std::span<const OptimumCurveResult> results) {
  results::FigureData all;
  for (const OptimumCurveResult& result : results) {
    results::FigureData one = figure_of(scene, result);
    if (one.lines.empty()) continue;
    if (all.columns.empty())
      all = std::move(one);
    else
      all.lines.push_back(std::move(one.lines.front()));
  }
  for (std::size_t i = 0; i < all.columns.size(); ++i) {
    results::FigureColumn& column = all.columns[i];
    column.range = results::full_range(all, i);
    if (column.scale != results::Scale::percent && i != studies::frequency_column(branch_kind))
      column.scale = column.range.lower > 0 && column.range.upper > decade * column.range.lower
                         ? results::Scale::logarithmic
                         : results::Scale::linear;
  }
  return all;
}

}  // namespace arcslip::optimize
