// The figures of optima.

#include <arcslip/optimize/study/optimum_results.hpp>

#include <arcslip/optimize/study/optimum_text.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>

namespace arcslip::optimize {
namespace {

using observables::ResponseBranch;

double to_four_digits(double value) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.4g", value);
  return std::strtod(digits.data(), nullptr);
}

std::string value_label(const scene::Scene& scene, const OptimumProblem& problem, double value) {
  return results::quantity(to_four_digits(value), studies::parameter_unit(scene, problem.over[0].name));
}

std::vector<results::FigureBand> bands(const Optimum& optimum) {
  std::vector<results::FigureBand> all;
  if (!optimum.certificate || optimum.certificate->ranges.empty()) return all;
  auto ranges = optimum.certificate->ranges[0];
  std::sort(ranges.begin(), ranges.end(), [](auto& a, auto& b) { return a.share > b.share; });
  for (const ToleranceRange& range : ranges)
    all.push_back({"within " + results::quantity(100 * range.share, "%"), {range.lower, range.upper}});
  return all;
}

// The ranges of tolerance behind the curve of peaks of the same setting, and the load at its minimum.
void add_tolerances(const scene::Scene& scene, std::span<const OptimumResult> results,
                    results::FigureData& data) {
  for (results::FigureLine& line : data.lines) {
    const auto result = std::find_if(results.begin(), results.end(),
                                     [&](const OptimumResult& each) { return each.set == line.set; });
    if (result == results.end()) continue;
    line.bands = bands(result->optimum);
    if (!line.label.empty()) continue;
    for (results::FigureMark& mark : line.marks)
      if (mark.kind == observables::event_kinds::minimum)
        mark.label = value_label(scene, result->problem, mark.record[0]);
  }
}

// Draws the response of the optimum before those of other designs, and says which one it is.
void name_optimum(std::span<const OptimumResult> results, results::FigureData& data) {
  const auto is_optimum = [&](const results::FigureLine& line) {
    return std::any_of(results.begin(), results.end(), [&](const OptimumResult& result) {
      auto set = result.set;
      for (std::size_t i = 0; i < result.problem.over.size() && i < result.optimum.design.size(); ++i)
        set.emplace_back(result.problem.over[i].name, result.optimum.design[i]);
      return std::equal(set.begin(), set.end(), line.set.begin(), line.set.end(), [](auto& a, auto& b) {
        return a.first == b.first && to_four_digits(a.second) == to_four_digits(b.second);
      });
    });
  };
  if (std::all_of(data.lines.begin(), data.lines.end(), is_optimum)) return;
  for (results::FigureLine& line : data.lines)
    if (is_optimum(line)) {
      line.is_main = true;
      line.label += ", optimum";
    }
}

// A line for each case that has a curve, whatever the cases set.
struct CaseLines {
  results::FigureData data;
  std::vector<LoadCaseResult> cases;  // of the lines
};

CaseLines lines_of_cases(const scene::Scene& scene, studies::BranchKind kind, const OptimumResult& result,
                         std::vector<ResponseBranch> CaseCurves::* branches, bool weighted) {
  const OptimumProblem& problem = result.problem;
  std::vector<std::vector<ResponseBranch>> all;  // of each line
  std::vector<studies::LineOfBranches> lines;
  std::vector<std::vector<std::string>> names;
  CaseLines found;
  for (const CaseCurves& curves : result.curves) {
    const LoadCaseResult& each = result.optimum.cases[curves.of];
    std::vector<ResponseBranch>& own = all.emplace_back(curves.*branches);
    const bool any = std::any_of(own.begin(), own.end(), [](auto& branch) { return !branch.points.empty(); });
    if (!any) continue;
    for (ResponseBranch& branch : own) {
      const double factor = weighted ? each.weight : 1;
      for (auto& point : branch.points) point.amplitude *= factor;
      for (auto& event : branch.events) event.point.amplitude *= factor;
    }
    std::vector<std::pair<std::string, double>> set = result.set;
    std::vector<std::string>& of_case = names.emplace_back();
    for (const auto* values : {&each.set, &each.scatter})
      for (const auto& value : *values) {
        set.push_back(value);
        of_case.push_back(value.first);
      }
    studies::LineOfBranches& line = lines.emplace_back();
    LoadCaseResult shown = each;
    if (curves.all_places) shown.of = problem.cases.size();  // without its place
    const bool single = result.curves.size() == 1;           // nothing to tell it from
    line.line = {.label = single ? "" : case_label(scene, problem, shown),
                 .heading = studies::assignment(scene, set),
                 .set = std::move(set)};
    if (each.weight != 1)
      line.line.label +=
          (weighted ? ", times " : ", weight ") + results::shortest(to_four_digits(each.weight));
    for (const ResponseBranch& branch : own) line.branches.push_back(&branch);
    found.cases.push_back(std::move(shown));
  }
  results::FigureData& data = found.data;
  data = studies::figures_of(scene, kind, std::move(lines));
  if (!result.set.empty()) data.title = studies::assignment(scene, result.set) + ": " + data.title;
  const bool alike = std::all_of(names.begin(), names.end(), [&](auto& own) { return own == names[0]; });
  if (alike && !names.empty())
    for (const std::string& own : names.front()) data.parameters.push_back(studies::words_of(scene, own));
  for (std::size_t i = 0; !alike && i < data.lines.size(); ++i)  // no common title: each line with names
    data.lines[i].label = case_text(scene, problem, found.cases[i]);
  return found;
}

// The highest interpolated value of a line at a value of the parameter; NaN beyond its points.
double height(const results::FigureLine& line, std::size_t column, double at) {
  double highest = std::numeric_limits<double>::quiet_NaN();
  for (const auto& part : line.parts)
    for (std::size_t i = 1; i < part.size(); ++i) {
      const auto &a = part[i - 1], &b = part[i];
      if ((at - a[0]) * (at - b[0]) > 0 || a[0] == b[0]) continue;
      const double t = (at - a[0]) / (b[0] - a[0]);
      highest = std::fmax(highest, (1 - t) * a[column] + t * b[column]);
    }
  return highest;
}

// The criterion: its curve, computed from the lines, with the optimum and its tolerance ranges. A single line
// is the criterion itself.
void add_criterion(const scene::Scene& scene, const OptimumResult& result, CaseLines& lines) {
  results::FigureData& data = lines.data;
  const bool mean = result.problem.criterion == Criterion::mean;
  const std::size_t amplitude = studies::amplitude_column(studies::BranchKind::peaks);
  std::set<double> places;
  for (const results::FigureLine& line : data.lines)
    for (const auto& part : line.parts)
      for (const auto& record : part) places.insert(record[0]);
  double sum = 0;
  for (const LoadCaseResult& each : lines.cases) sum += each.weight;
  results::FigureLine criterion;
  criterion.is_main = true;
  const std::string best = value_label(scene, result.problem, result.optimum.design[0]);
  criterion.label = (mean ? "mean, least at " : "worst, least at ") + best;
  auto& curve = criterion.parts.emplace_back();
  const auto record = [&](double at, double value) {
    results::Record values(data.columns.size(), std::numeric_limits<double>::quiet_NaN());
    values[0] = at;
    values[amplitude] = value;
    return values;
  };
  for (const double at : places) {
    double value = 0;
    for (std::size_t i = 0; i < data.lines.size(); ++i) {
      const double own = height(data.lines[i], amplitude, at);
      value = mean ? value + lines.cases[i].weight * own / sum : std::max(value, own);
    }
    if (std::isfinite(value)) curve.push_back(record(at, value));
  }
  for (results::FigureLine& line : data.lines) line.marks.clear();
  const bool single = data.lines.size() == 1 && result.optimum.cases[result.curves.front().of].weight == 1;
  if (!single) data.lines.push_back(std::move(criterion));
  results::FigureLine& of_criterion = data.lines.back();
  of_criterion.marks.push_back(
      {observables::event_kinds::minimum, record(result.optimum.design[0], result.optimum.amplitude), best});
  of_criterion.bands = bands(result.optimum);
}

void add_figure(results::FigureData data, const std::string& name, std::vector<results::FigureData>& all) {
  if (data.lines.empty()) return;
  data.name = name;
  all.push_back(std::move(data));
}

void add_cases(const scene::Scene& scene, const OptimumResult& result, const std::string& name,
               std::vector<results::FigureData>& all) {
  const auto& cases = result.optimum.cases;
  const bool weighted = result.problem.criterion == Criterion::worst &&
                        std::any_of(cases.begin(), cases.end(), [](auto& each) { return each.weight != 1; });
  CaseLines of_peaks =
      lines_of_cases(scene, studies::BranchKind::peaks, result, &CaseCurves::peaks, weighted);
  results::FigureData& peaks = of_peaks.data;
  if (!peaks.lines.empty()) {
    add_criterion(scene, result, of_peaks);
    if (weighted) {
      const std::size_t amplitude = studies::amplitude_column(studies::BranchKind::peaks);
      peaks.columns[amplitude].words += " times weight";
      for (results::FigureView& figure : peaks.figures)
        if (figure.y == amplitude) figure.y_words = "peak " + peaks.columns[amplitude].words;
    }
    add_figure(std::move(peaks), name, all);
  }
  add_figure(
      lines_of_cases(scene, studies::BranchKind::responses, result, &CaseCurves::responses, false).data,
      name.empty() ? "responses" : name + "_responses", all);
}

}  // namespace

std::vector<results::FigureData> figures_of(const scene::Scene& scene,
                                            std::span<const OptimumResult> results) {
  std::vector<results::FigureData> all;
  std::vector<ResponseBranch> curves, responses;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const OptimumResult& result = results[i];
    if (!result.curves.empty())
      add_cases(scene, result, result.set.empty() ? "" : std::to_string(i + 1), all);
    for (ResponseBranch curve : result.direct.curves) {
      curve.set = result.set;
      curves.push_back(std::move(curve));
    }
    for (ResponseBranch branch : result.responses) {
      branch.set.insert(branch.set.begin(), result.set.begin(), result.set.end());
      responses.push_back(std::move(branch));
    }
  }
  results::FigureData peaks = studies::figures_of(scene, studies::BranchKind::peaks, curves);
  add_tolerances(scene, results, peaks);
  add_figure(std::move(peaks), "", all);
  results::FigureData of_responses = studies::figures_of(scene, studies::BranchKind::responses, responses);
  name_optimum(results, of_responses);
  add_figure(std::move(of_responses), "responses", all);
  return all;
}

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

results::FigureData figure_of(const scene::Scene& scene, const OptimumCurveResult& result) {
  const observables::ResponseBranch branch = branch_of(result);
  results::FigureData data = studies::figures_of(scene, branch_kind, {&branch, 1});
  if (data.lines.empty()) return data;
  results::FigureLine& line = data.lines.front();
  const auto add = [](results::Record& record, const OptimumPoint& at) {
    record.insert(record.end(), at.design.begin(), at.design.end());
  };
  for (const OptimumEvent& event : result.curve.events) {
    const auto* const own =
        std::find(event_kinds::of_curves.begin(), event_kinds::of_curves.end(), event.kind);
    const results::EventKind kind =
        own != event_kinds::of_curves.end() ? *own : observables::event_kinds::kind_named(event.kind);
    if (kind.mark.shape == results::Shape::none) continue;
    results::Record record = line.parts[0][std::min(event.after, line.parts[0].size() - 1)];
    record[0] = event.point.along;
    record[studies::frequency_column(branch_kind)] =
        studies::in_scene_unit(scene, event.point.response.omega);
    record[studies::amplitude_column(branch_kind)] = event.point.amplitude;
    add(record, event.point);
    line.marks.push_back({kind, record});
  }
  for (std::size_t i = 0; i < line.parts[0].size(); ++i) add(line.parts[0][i], result.curve.points[i]);
  for (const DesignVariable& v : result.problem.over) {
    data.figures.push_back({v.name, 0, data.columns.size()});
    data.columns.push_back({studies::words_of(scene, v.name), studies::axis_unit(scene, v.name)});
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
