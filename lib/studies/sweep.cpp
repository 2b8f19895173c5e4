// The study "sweep": which motions a slow sweep of the frequency follows.
#include <arcslip/analyses/modes_and_time/frequency_sweep.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::studies {
namespace {

using observables::FrequencySweep;
using observables::SweepDirection;
using observables::SweepJump;
using observables::SweepPoint;
using observables::SweepSettings;
using scene::file::KeyGroup;
using scene::file::Reading;

constexpr int most_points = 1'000'000;

std::vector<scene::file::Word<SweepDirection>> direction_words() {
  std::vector<scene::file::Word<SweepDirection>> words;
  for (const auto direction : {SweepDirection::up, SweepDirection::down, SweepDirection::up_down})
    words.push_back({name(direction), direction});
  return words;
}

KeyGroup<SweepSettings> spacing() {
  using namespace scene::file;
  return {{{"spacing", scene::KeyType::frequency, "frequency", "above 0", "", false,
            "largest difference between two frequencies, instead of \"points\""}},
          [](const Reading& reading, SweepSettings& s) {
            const Location place = reading.keys.find("spacing");
            if (place.node == nullptr) return;
            s.spacing = reading.number(place, reading.frequency).value_or(0);
          },
          [](const SweepSettings& s, const scene::Scene&, Node::Object& to) {
            if (s.spacing > 0) to.push_back({"spacing", node(s.spacing)});
          },
          {},
          {},
          {},
          [](SweepSettings& s, const scene::NumberVisitor& visit) { visit("/spacing", s.spacing); }};
}

KeyGroup<SweepSettings> points() {
  using namespace scene::file;
  KeyGroup<SweepSettings> group = whole("points", &SweepSettings::points, 2, most_points,
                                        "number of frequencies, equally spaced, both ends included");
  group.write = [write = group.write](const SweepSettings& s, const scene::Scene& scene, Node::Object& to) {
    if (s.spacing == 0) write(s, scene, to);
  };
  return group;
}

void check_number(const Reading& reading, SweepSettings& sweep) {
  if (sweep.spacing > 0 && reading.keys.has("points"))
    reading.faults.add(reading.keys.find("points").pointer,
                       "found next to \"spacing\", which takes its place: give one of them");
  if (sweep.spacing > 0 && (sweep.to - sweep.from) / sweep.spacing > most_points)
    reading.faults.add(reading.keys.find("spacing").pointer,
                       "found " + scene::file::number_text(sweep.spacing) + ", which makes more than " +
                           std::to_string(most_points) + " frequencies");
}

scene::file::KeysOf<SweepSettings> keys_of_sweep() {
  using namespace scene::file;
  KeysOf<SweepSettings> keys;
  keys.add(frequency_range(&SweepSettings::from, &SweepSettings::to));
  keys.add(points());
  keys.add(spacing());
  keys.add(
      word("direction", &SweepSettings::direction, direction_words(),
           "from the first frequency to the last one, from the last to the first, or one after the other"));
  keys.add(whole("periods", &SweepSettings::periods, 1, most_periods,
                 "maximum number of excitation periods at each frequency"));
  keys.add(whole("steps", &SweepSettings::steps, 1, most_steps, "steps per period of Newmark's method"));
  keys.add(number(&SweepSettings::tolerance,
                  {.name = "tolerance", .unit = "-", .lower = 0, .upper = 1, .lower_open = true},
                  "a motion is periodic if the relative change of its state over its period is below this"));
  keys.check(check_number);
  return keys;
}

/// A row, with the direction of its sweep.
template <class Item>
struct Of {
  const FrequencySweep* sweep;
  const Item* item;
};

struct SweepTables {
  explicit SweepTables(const scene::Scene& scene) {
    const std::string unit(scene::unit_name(scene.frequency_unit));
    const auto in_unit = [&scene](double omega) { return in_scene_unit(scene, omega); };
    using Point = Of<SweepPoint>;
    using Jump = Of<SweepJump>;
    points.add({"omega"}, "rad/s", "excitation frequency", [](const Point& at) { return at.item->omega; });
    points.add({"frequency"}, unit, "excitation frequency",
               [=](const Point& at) { return in_unit(at.item->omega); });
    points.add({"direction"}, "", "of the sweep",
               [](const Point& at) { return std::string(name(at.sweep->direction)); });
    points.add({"amplitude"}, "m",
               "largest absolute displacement of the response over the period of the motion; if it is not "
               "settled, over the second half of the periods",
               [](const Point& at) { return at.item->amplitude; });
    points.add({"settled"}, "", "whether a periodic motion was reached that is not unstable",
               [](const Point& at) { return at.item->settled; });
    points.add({"motion_period"}, "", "of the motion, in excitation periods; absent if it is not settled",
               [](const Point& at) {
                 return at.item->settled ? std::optional(static_cast<long>(at.item->period)) : std::nullopt;
               });
    points.add({"periods"}, "", "excitation periods until then",
               [](const Point& at) { return at.item->periods; });
    points.add({"period_change"}, "",
               "of the state over the period of the motion, or over the last excitation period, relative",
               [](const Point& at) { return at.item->change; });
    points.add(
        {"largest_multiplier"}, "",
        "largest modulus of the Floquet multipliers over the period of the motion, where they are known",
        [](const Point& at) {
          const double value = at.item->largest_multiplier;
          return std::isnan(value) ? std::nullopt : std::optional(value);
        });
    jumps.add({"kind"}, "", "`jump`",
              [](const Jump&) { return std::string(observables::event_kinds::jump.name); });
    jumps.add({"direction"}, "", "of the sweep",
              [](const Jump& at) { return std::string(name(at.sweep->direction)); });
    jumps.add({"omega"}, "rad/s", "last frequency before", [](const Jump& at) { return at.item->omega; });
    jumps.add({"frequency"}, unit, "last frequency before",
              [=](const Jump& at) { return in_unit(at.item->omega); });
    jumps.add({"frequency_after"}, unit, "first frequency after",
              [=](const Jump& at) { return in_unit(at.item->omega_after); });
    jumps.add({"amplitude"}, "m", "before", [](const Jump& at) { return at.item->amplitude; });
    jumps.add({"amplitude_after"}, "m", "after", [](const Jump& at) { return at.item->amplitude_after; });
    jumps.add({"after"}, "", "index of the preceding point",
              [](const Jump& at) { return static_cast<long>(at.item->after); });
    jumps.add({"by_step"}, "", "whether smaller steps do not jump there",
              [](const Jump& at) { return at.item->by_step; });
  }

  results::TableOf<Of<SweepPoint>> points;
  results::TableOf<Of<SweepJump>> jumps;
};

template <class Item>
std::vector<Of<Item>> rows_of(const FrequencySweep& sweep, const std::vector<Item>& items) {
  std::vector<Of<Item>> rows;
  for (const Item& item : items) rows.push_back({&sweep, &item});
  return rows;
}

/// Ranges of the frequency with the same kind of motion that is not of the excitation's period: "period 2
/// from 0.73 to 0.75 rad/s; not settled from 0.6 to 0.61 rad/s"; "" for none.
std::string other_motions(const scene::Scene& scene, const FrequencySweep& sweep) {
  std::string text;
  const auto frequency = [&](std::size_t i) {
    return results::to_digits(in_scene_unit(scene, sweep.points[i].omega), 6);
  };
  const auto& points = sweep.points;
  for (std::size_t i = 0; i < points.size();) {
    std::size_t last = i;
    while (last + 1 < points.size() && points[last + 1].period == points[i].period) ++last;
    if (points[i].period != 1) {
      if (!text.empty()) text += "; ";
      text += points[i].settled ? "period " + std::to_string(points[i].period) : "not settled";
      text += (last > i ? " from " : " at ") + frequency(i);
      if (last > i) text += " to " + frequency(last);
      text.append(" ").append(scene::unit_name(scene.frequency_unit));
    }
    i = last + 1;
  }
  return text;
}

Described<FrequencySweep> described_sweep(const scene::Scene& scene, const SweepSettings&,
                                          const RunOptions& options) {
  const auto tables = std::make_shared<const SweepTables>(scene);
  const std::string unit(scene::unit_name(scene.frequency_unit));
  results::Schema schema{
      .format = "arcslip-sweeps-1",
      .list = "sweeps",
      .noun = "sweep",
      .tables = {{"points", tables->points.columns()}, {"events", tables->jumps.columns()}},
      .shown = {{"direction", {"direction"}},
                {"event", {"kind"}},
                {results::with_unit("from", unit), {"frequency"}, "%.8f"},
                {results::with_unit("to", unit), {"frequency_after"}, "%.8f"},
                {.title = "A_max before", .path = {"amplitude"}, .format = "%.6e", .unit = "m"},
                {.title = "A_max after", .path = {"amplitude_after"}, .format = "%.6e", .unit = "m"}},
      .shown_table = "events"};
  return {std::move(schema), [&scene, tables, points = options.points](const FrequencySweep& sweep) {
            results::Result result{.schema = 0,
                                   .head = {sweep.study,
                                            sweep.kind,
                                            named(scene, sweep.set),
                                            {{"direction", std::string(name(sweep.direction))},
                                             {"parameters", named(scene, sweep.parameters)}}},
                                   .tables = {},
                                   .end = {sweep.status,
                                           stop(sweep.stop),
                                           {{"integrator", sweep.integrator},
                                            {"steps", sweep.steps},
                                            {"periods", sweep.periods},
                                            {"seconds", sweep.seconds, "s"}},
                                           sweep.doubt,
                                           {},
                                           other_motions(scene, sweep)}};
            result.head.parent = sweep.parent;
            if (points) result.tables.push_back(tables->points.rows(rows_of(sweep, sweep.points)));
            result.tables.resize(1);
            result.tables.push_back(tables->jumps.rows(rows_of(sweep, sweep.jumps)));
            return result;
          }};
}

using results::Record;

Record sweep_record(const scene::Scene& scene, const SweepPoint& point) {
  return {in_scene_unit(scene, point.omega), point.amplitude,
          point.settled ? point.period : observables::no_value};
}

/// A line for each sweep, interrupted where it jumps.
results::FigureLine line_of_sweep(const scene::Scene& scene, const FrequencySweep& sweep) {
  results::FigureLine line = line_of(scene, sweep.set);
  line.label += (line.label.empty() ? "" : ", ") + std::string(name(sweep.direction));
  line.parts.emplace_back();
  auto jump = sweep.jumps.begin();
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    line.parts.back().push_back(sweep_record(scene, sweep.points[i]));
    if (jump == sweep.jumps.end() || jump->after != i) continue;
    const Record before{in_scene_unit(scene, jump->omega), jump->amplitude, observables::no_value};
    const Record after{in_scene_unit(scene, jump->omega_after), jump->amplitude_after, observables::no_value};
    line.parts.back().push_back(before);
    line.parts.push_back({after});
    line.marks.push_back({observables::event_kinds::jump, before});
    line.marks.push_back({observables::event_kinds::jump, after});
    ++jump;
  }
  return line;
}

std::vector<results::FigureData> sweep_figures(const scene::Scene& scene,
                                               std::span<const FrequencySweep> sweeps) {
  results::FigureData data;
  data.title = scene.title;
  data.columns = {
      {.words = label_of(scene, "frequency"), .unit = std::string(scene::unit_name(scene.frequency_unit))},
      {.words = label_of(scene, "amplitude"), .unit = "m", .is_amplitude = true},
      {.words = "period (of the excitation's)"}};
  for (const FrequencySweep& sweep : sweeps) {
    if (sweep.points.empty()) continue;
    if (data.parameters.empty()) {
      for (const auto& [name, value] : sweep.set) data.parameters.push_back(words_of(scene, name));
      data.parameters.emplace_back("sweep");
    }
    data.lines.push_back(line_of_sweep(scene, sweep));
  }
  for (std::size_t i = 0; i < data.columns.size(); ++i) data.columns[i].range = results::full_range(data, i);
  if (const results::Range positive = results::range_of(data, 1, 0); positive.upper >= positive.lower) {
    data.columns[1].scale = results::Scale::logarithmic;  // as that of frequency responses
    data.columns[1].range = positive;
  }
  data.figures = {{"amplitude", 0, 1}};
  return {data};
}

std::unique_ptr<Computation> computed_sweeps(const scene::Scene& scene, const SweepSettings& settings,
                                             const RunOptions& options) {
  return std::make_unique<ComputationOf<FrequencySweep>>(
      described_sweep(scene, settings, options),
      [&settings](const Case& at, const control::Control& control) {
        return observables::frequency_sweep(at.scene, settings, control);
      },
      [&scene](std::span<const FrequencySweep> sweeps) { return sweep_figures(scene, sweeps); });
}

}  // namespace

const StudyKind& sweep() {
  static const StudyKind kind(
      {.name = "sweep",
       .help = "the motions that a slow sweep of the frequency up and down follows, with their jumps",
       .coefficients = false},
      keys_of_sweep(), computed_sweeps);
  return kind;
}

}  // namespace arcslip::studies
