// The study "accuracy": time and error of the ways to compute a frequency response.
#include <arcslip/analyses/modes_and_time/accuracy.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::studies {
namespace {

using observables::Accuracy;
using observables::AccuracySettings;
using observables::Trial;
using observables::Way;

constexpr int highest_order = 999;
constexpr double rounding = 1e-16;  // the least error that is drawn
constexpr results::EventKind best{
    .name = "best", .words = "best", .mark = {results::Shape::filled_circle, 0.7}};

scene::file::KeysOf<AccuracySettings> keys_of_accuracy() {
  scene::file::KeysOf<AccuracySettings> keys;
  keys.add(scene::file::frequency_range(&AccuracySettings::from, &AccuracySettings::to));
  keys.add(scene::file::whole("order", &AccuracySettings::order, 1, highest_order,
                              "the highest order to try; the reference has twice as many harmonics"));
  return keys;
}

results::TableOf<Trial> table(const scene::Scene& scene) {
  results::TableOf<Trial> trials;
  const std::string unit(scene::unit_name(scene.frequency_unit));
  trials.add(
      {"method"}, "",
      "`exact`: harmonic balance with exact integrals where the laws have them; `sampled`: with samples of "
      "all friction; `newmark`: shooting by Newmark's method; `event-driven`: shooting, exact in time",
      [](const Trial& at) { return std::string(name(at.way)); });
  trials.add({"order"}, "", "of the harmonics; 0 in time",
             [](const Trial& at) { return static_cast<long>(at.order); });
  trials.add({"samples"}, "", "of a period where friction is sampled, or steps of Newmark's method; else 0",
             [](const Trial& at) { return static_cast<long>(at.samples); });
  trials.add({"seconds"}, "s", "the least of up to three runs; in time of one frequency",
             [](const Trial& at) { return at.seconds; });
  trials.add({"points"}, "", "of the frequency response; in time 1",
             [](const Trial& at) { return at.points; });
  trials.add({"seconds_per_point"}, "s", "their ratio",
             [](const Trial& at) { return at.seconds_per_point(); });
  trials.add({"amplitude"}, "m", "of the highest peak; in time at the frequency of the peak of the reference",
             [](const Trial& at) { return at.amplitude; });
  trials.add({"frequency"}, unit, "where that is",
             [&scene](const Trial& at) { return in_scene_unit(scene, at.omega); });
  trials.add({"error"}, "", "relative difference of the amplitude from the reference",
             [](const Trial& at) { return at.error; });
  trials.add({"estimate"}, "", "of that error, from the harmonics left out; null in time",
             [](const Trial& at) { return at.estimate; });
  trials.add({"flagged"}, "", "the estimate may be too low", [](const Trial& at) { return at.flagged; });
  trials.add({"best"}, "", "no other has less error for a point in less time",
             [](const Trial& at) { return at.best; });
  return trials;
}

Described<Accuracy> described_accuracy(const scene::Scene& scene, const AccuracySettings&,
                                       const RunOptions&) {
  const auto trials = std::make_shared<const results::TableOf<Trial>>(table(scene));
  results::Schema schema{.format = "arcslip-accuracy-1",
                         .list = "comparisons",
                         .noun = "comparison",
                         .tables = {{"trials", trials->columns()}},
                         .shown = {{"method", {"method"}},
                                   {"order", {"order"}},
                                   {"samples", {"samples"}},
                                   {"s/point", {"seconds_per_point"}, "%.2e"},
                                   {"error", {"error"}, "%.1e"},
                                   {"estimate", {"estimate"}, "%.1e"},
                                   {"best", {"best"}}},
                         .shown_table = "trials"};
  return {std::move(schema), [&scene, trials](const Accuracy& found) {
            const results::Object reference{{"order", found.reference_order},
                                            {"amplitude", found.reference_amplitude, "m"},
                                            {"frequency", in_scene_unit(scene, found.reference_omega),
                                             std::string(scene::unit_name(scene.frequency_unit))},
                                            {"error", found.reference_error}};
            results::Result result{
                .schema = 0,
                .head = {found.study,
                         found.kind,
                         named(scene, found.set),
                         {{"parameters", named(scene, found.parameters)}, {"reference", reference}}},
                .tables = {trials->rows(found.trials)},
                .end = {found.status,
                        stop(found.stop),
                        {{"left_out", results::Value::List(found.left_out.begin(), found.left_out.end())}},
                        {},
                        {},
                        found.status == results::Status::complete ? found.stop.message : ""}};
            return result;
          }};
}

using results::Record;

// Trials of one line: of a method, and of one density of samples.
std::string series(const Trial& trial) {
  std::string text(name(trial.way));
  if (trial.way == Way::sampled) text += trial.samples < 32 * trial.order ? ", coarse" : ", fine";
  return text;
}

// A line for each method, through its trials in the order of their times; the best ones are marked.
std::vector<results::FigureData> accuracy_figures(const scene::Scene& scene, std::span<const Accuracy> all) {
  results::FigureData data;
  data.title = scene.title;
  data.columns = {{"time for a point", "s", results::Scale::logarithmic},
                  {"relative error of the highest peak", "", results::Scale::logarithmic}};
  for (const Accuracy& found : all) {
    std::vector<std::pair<std::string, std::vector<Record>>> lines;
    std::vector<std::vector<results::FigureMark>> marks;
    for (const Trial& trial : found.trials) {
      const Record record{trial.seconds_per_point(), std::max(trial.error, rounding)};
      if (lines.empty() || lines.back().first != series(trial)) {
        lines.push_back({series(trial), {}});
        marks.emplace_back();
      }
      lines.back().second.push_back(record);
      if (trial.best) marks.back().push_back({best, record});
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      auto& [label, points] = lines[i];
      std::sort(points.begin(), points.end());
      if (data.parameters.empty()) {
        for (const auto& [name, value] : found.set) data.parameters.push_back(words_of(scene, name));
        data.parameters.emplace_back("method");
      }
      results::FigureLine line = line_of(scene, found.set);
      line.label += (line.label.empty() ? "" : ", ") + label;
      line.parts.push_back(std::move(points));
      line.marks = std::move(marks[i]);
      data.lines.push_back(std::move(line));
    }
  }
  for (std::size_t i = 0; i < data.columns.size(); ++i) data.columns[i].range = results::range_of(data, i, 0);
  data.figures = {{"accuracy", 0, 1}};
  return {data};
}

std::unique_ptr<Computation> computed_accuracy(const scene::Scene& scene, const AccuracySettings& settings,
                                               const RunOptions& options) {
  return std::make_unique<ComputationOf<Accuracy>>(
      described_accuracy(scene, settings, options),
      [&settings](const Case& at, const control::Control& control) {
        return std::vector{observables::accuracy(at.scene, settings, control)};
      },
      [&scene](std::span<const Accuracy> all) { return accuracy_figures(scene, all); });
}

}  // namespace

const StudyKind& accuracy() {
  static const StudyKind kind({.name = "accuracy",
                               .help = "time and error of the ways to compute a frequency response",
                               .coefficients = false,
                               .timed = true},
                              keys_of_accuracy(), computed_accuracy);
  return kind;
}

}  // namespace arcslip::studies
