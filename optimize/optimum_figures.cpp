// The figures of optima.
#include <arcslip/optimize/case_label.hpp>
#include <arcslip/optimize/optimum_figures.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/studies/units.hpp>

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
      if (mark.kind == "minimum") mark.label = value_label(scene, result->problem, mark.record[0]);
  }
}

// One line for each case, whatever the cases set: branches are told apart by their number until then.
results::FigureData lines_of_cases(const scene::Scene& scene, scene::StudyKind kind,
                                   const OptimumResult& result,
                                   std::vector<ResponseBranch> CaseCurves::*branches, bool weighted) {
  const OptimumProblem& problem = result.problem;
  std::vector<ResponseBranch> all;
  for (const CaseCurves& curves : result.curves)
    for (ResponseBranch branch : curves.*branches) {
      const double factor = weighted ? result.optimum.cases[curves.of].weight : 1;
      branch.set = {{problem.over[0].name, static_cast<double>(curves.of)}};
      for (auto& point : branch.points) point.amplitude *= factor;
      for (auto& event : branch.events) event.point.amplitude *= factor;
      all.push_back(std::move(branch));
    }
  results::FigureData data = studies::figures_of(scene, kind, all);
  if (!result.set.empty()) data.title = studies::assignment(scene, result.set) + ": " + data.title;
  std::set<std::vector<std::string>> names;
  for (results::FigureLine& line : data.lines) {
    const CaseResult& each = result.optimum.cases[static_cast<std::size_t>(line.set[0].second)];
    line.set = result.set;
    line.set.insert(line.set.end(), each.set.begin(), each.set.end());
    line.set.insert(line.set.end(), each.scatter.begin(), each.scatter.end());
    line.heading = studies::assignment(scene, line.set);
    line.label = case_label(scene, problem, each);
    if (each.weight != 1)
      line.label += (weighted ? ", times " : ", weight ") + results::shortest(to_four_digits(each.weight));
    std::vector<std::string>& own = data.parameters;
    own.clear();
    for (const auto* values : {&each.set, &each.scatter})
      for (const auto& value : *values) own.push_back(value.first);
    names.insert(own);
  }
  if (names.size() != 1) {  // no common title: each line with names
    data.parameters.clear();
    for (std::size_t i = 0; i < data.lines.size(); ++i)
      data.lines[i].label = case_text(scene, problem, result.optimum.cases[result.curves[i].of]);
  }
  return data;
}

// The highest of a line at a value of the parameter, between its points; NaN beyond them.
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

// Of what is to be least: its curve, made of the lines, the optimum on it and the ranges around.
void add_criterion(const scene::Scene& scene, const OptimumResult& result, results::FigureData& data) {
  const bool mean = result.problem.criterion == Criterion::mean;
  const std::size_t amplitude = studies::amplitude_column(scene::StudyKind::peaks);
  std::set<double> places;
  for (const results::FigureLine& line : data.lines)
    for (const auto& part : line.parts)
      for (const auto& record : part) places.insert(record[0]);
  double sum = 0;
  for (const CaseCurves& each : result.curves) sum += result.optimum.cases[each.of].weight;
  results::FigureLine criterion;
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
      const double weight = result.optimum.cases[result.curves[i].of].weight;
      value = mean ? value + weight * own / sum : std::max(value, own);
    }
    if (std::isfinite(value)) curve.push_back(record(at, value));
  }
  criterion.marks.push_back({"minimum", record(result.optimum.design[0], result.optimum.amplitude), best});
  criterion.bands = bands(result.optimum);
  for (results::FigureLine& line : data.lines) line.marks.clear();
  data.lines.push_back(std::move(criterion));
}

void add(results::FigureData data, const std::string& name, std::vector<results::FigureData>& all) {
  if (data.lines.empty()) return;
  data.name = name;
  all.push_back(std::move(data));
}

void add_cases(const scene::Scene& scene, const OptimumResult& result, const std::string& name,
               std::vector<results::FigureData>& all) {
  const auto& cases = result.optimum.cases;
  const bool weighted = result.problem.criterion == Criterion::worst &&
                        std::any_of(cases.begin(), cases.end(), [](auto& each) { return each.weight != 1; });
  results::FigureData peaks =
      lines_of_cases(scene, scene::StudyKind::peaks, result, &CaseCurves::peaks, weighted);
  if (!peaks.lines.empty()) {
    add_criterion(scene, result, peaks);
    if (weighted) {
      const std::size_t amplitude = studies::amplitude_column(scene::StudyKind::peaks);
      peaks.columns[amplitude].label = "amplitude times weight (m)";
      for (results::Figure& figure : peaks.figures)
        if (figure.y == amplitude) figure.y_label = "peak " + peaks.columns[amplitude].label;
    }
    add(std::move(peaks), name, all);
  }
  add(lines_of_cases(scene, scene::StudyKind::frf, result, &CaseCurves::responses, false),
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
  results::FigureData peaks = studies::figures_of(scene, scene::StudyKind::peaks, curves);
  add_tolerances(scene, results, peaks);
  add(std::move(peaks), "", all);
  add(studies::figures_of(scene, scene::StudyKind::frf, responses), "responses", all);
  return all;
}

}  // namespace arcslip::optimize
