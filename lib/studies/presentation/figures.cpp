#include <arcslip/studies/presentation/figures.hpp>

#include <arcslip/observables/quantities.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/presentation/figure_parts.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::studies {
namespace {

// A share of the period that an element or a patch spends in a state of contact.
struct Share {
  std::string element, state;  // "stick", "separation"
  std::vector<observables::ElementResponse> observables::ResponsePoint::* list;
  double observables::ElementResponse::* percent;
};

// Those of all contacts, in the order of the points; of patches, the totals.
std::vector<Share> contact_shares(std::span<const observables::ResponseBranch* const> branches) {
  using observables::ElementResponse, observables::ResponsePoint;
  std::vector<Share> shares;
  for (const observables::ResponseBranch* branch : branches) {
    for (const observables::ResponsePoint& point : branch->points) {
      for (const auto list : {&ResponsePoint::elements, &ResponsePoint::patches})
        for (const ElementResponse& element : point.*list) {
          if (element.of_patch) continue;
          if (element.has_stick)
            shares.push_back({element.name, "stick", list, &ElementResponse::stick_percent});
          if (element.has_normal_load)
            shares.push_back({element.name, "separation", list, &ElementResponse::open_percent});
        }
      if (!point.elements.empty()) return shares;  // every point of a scene has the same elements
    }
  }
  return shares;
}

// %; NaN where the point does not know.
double percent(const observables::ResponsePoint& point, const Share& share) {
  for (const observables::ElementResponse& candidate : point.*share.list)
    if (candidate.has_stick && candidate.name == share.element) return candidate.*share.percent;
  return std::numeric_limits<double>::quiet_NaN();
}

using observables::ResponseBranch;
using observables::ResponsePoint;

// What a point has that no axis shows.
struct Reported {
  const char* words;
  const char* unit;
  double (*value)(const ResponsePoint& point);
};

double largest_multiplier(const ResponsePoint& point) {
  const bool known = point.stability && !point.stability->multipliers.empty();
  return known ? std::abs(point.stability->multipliers.front()) : observables::no_value;
}

// The quantities of a point, in their order: those of its kind, shares, and what no axis shows.
struct Quantities {
  std::vector<Share> shares;
  std::vector<Reported> reported;
};

Quantities quantities_of(BranchKind kind, std::span<const ResponseBranch* const> branches) {
  Quantities all{contact_shares(branches), {}};
  if (kind != BranchKind::modes)
    all.reported.push_back({"estimated error of the amplitude", "m",
                            [](const ResponsePoint& point) { return point.truncation_estimate; }});
  const bool has_multipliers =
      std::any_of(branches.begin(), branches.end(), [](const ResponseBranch* branch) {
        return std::any_of(branch->points.begin(), branch->points.end(), [](const ResponsePoint& point) {
          return std::isfinite(largest_multiplier(point));
        });
      });
  if (has_multipliers) all.reported.push_back({"largest multiplier (modulus)", "", largest_multiplier});
  return all;
}

using results::FigureColumn;
using results::FigureData;
using results::FigureLine;
using results::FigureView;
using results::Range;
using results::Record;
using results::Scale;

constexpr double decade = 10;
constexpr std::size_t most_motions = 108;  // of one set of lines
constexpr std::size_t damping_column = 2;  // of modes

Record record(const scene::Scene& scene, BranchKind kind, const Quantities& quantities,
              const ResponsePoint& point) {
  Record values;
  if (kind == BranchKind::modes) {
    values = {point.amplitude, in_scene_unit(scene, point.omega), point.damping_ratio};
  } else {
    if (kind != BranchKind::responses) values.push_back(point.over);
    values.push_back(in_scene_unit(scene, point.omega));
    values.push_back(point.unbounded ? observables::no_value : point.amplitude);
  }
  for (const Share& share : quantities.shares) values.push_back(percent(point, share));
  for (const Reported& each : quantities.reported) values.push_back(each.value(point));
  return values;
}

/// Amplitudes of frequency responses are shown by their logarithm, which no resonance dwarfs; other columns
/// where they are positive and span decades.
void set_ranges(BranchKind kind, FigureData& data) {
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    FigureColumn& column = data.columns[i];
    column.range = results::full_range(data, i);
    if (column.scale == Scale::percent || i == frequency_column(kind) || !column.has_axis) continue;
    if (kind == BranchKind::modes && i == damping_column) continue;
    const bool is_amplitude = i == amplitude_column(kind);
    const Range positive = is_amplitude ? results::range_of(data, i, 0) : column.range;
    if (positive.lower > 0 && positive.upper >= positive.lower &&
        ((is_amplitude && kind == BranchKind::responses) || positive.upper > decade * positive.lower)) {
      column.scale = Scale::logarithmic;
      column.range = positive;
    }
  }
}

void set_columns(const scene::Scene& scene, BranchKind kind, const Quantities& quantities,
                 const std::string& over, FigureData& data) {
  const FigureColumn amplitude{
      .words = label_of(scene, "amplitude"), .unit = "m", .is_amplitude = kind != BranchKind::modes};
  if (kind == BranchKind::modes) data.columns.push_back(amplitude);
  if (kind != BranchKind::responses && kind != BranchKind::modes)
    data.columns.push_back(
        {.words = words_of(scene, over), .unit = over.empty() ? "" : axis_unit(scene, over)});
  data.columns.push_back({.words = label_of(scene, "frequency"),
                          .unit = std::string(scene::unit_name(scene.frequency_unit)),
                          .is_frequency = kind != BranchKind::modes});
  data.columns.push_back(kind == BranchKind::modes ? FigureColumn{"damping ratio"} : amplitude);
  for (const Share& share : quantities.shares)
    data.columns.push_back({share.element + " " + share.state, "%", Scale::percent});
  for (const Reported& report : quantities.reported)
    data.columns.push_back({.words = report.words, .unit = report.unit, .has_axis = false});
}

/// A figure for each state of each contact, with its share on one of the axes.
void add_share_figures(BranchKind kind, const std::vector<Share>& shares, const FigureView& first,
                       bool over_share, FigureData& data) {
  const std::size_t first_share_column = frequency_column(kind) + 2;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Share& share = shares[i];
    const auto of_state = std::count_if(shares.begin(), shares.end(),
                                        [&](const Share& other) { return other.state == share.state; });
    FigureView figure = first;
    figure.name += share.state;
    (over_share ? figure.x : figure.y) = first_share_column + i;
    (over_share ? figure.x_words : figure.y_words) =
        (of_state > 1 ? share.element + ": " : "") + share.state + " of the period";
    if (of_state > 1) figure.name += "_" + share.element;
    data.figures.push_back(std::move(figure));
  }
}

void set_figures(const scene::Scene& scene, BranchKind kind, const std::vector<Share>& shares,
                 FigureData& data) {
  const std::size_t frequency = frequency_column(kind), amplitude = amplitude_column(kind);
  if (kind == BranchKind::peaks) {
    const std::string peak = (has_label(scene, "amplitude") ? "" : "peak ") + data.columns[amplitude].words;
    const std::string resonance =
        (has_label(scene, "frequency") ? "" : "resonance ") + data.columns[frequency].words;
    data.figures = {{"amplitude", 0, amplitude, "", peak}, {"frequency", 0, frequency, "", resonance}};
    add_share_figures(kind, shares, {"amplitude_over_", 0, amplitude, "", peak}, true, data);
  } else if (kind == BranchKind::folds) {
    data.figures = {{"folds", frequency, 0}};
  } else if (kind == BranchKind::bifurcations) {
    data.figures = {{"bifurcations", frequency, 0}};
  } else if (kind == BranchKind::modes) {
    data.figures = {{"frequency", amplitude, frequency}, {"damping_ratio", amplitude, damping_column}};
    add_share_figures(kind, shares, {"", amplitude, 0}, false, data);
  } else {  // responses, also those of optima
    data.figures = {{"amplitude", 0, amplitude}};
    add_share_figures(kind, shares, {"", 0, 0}, false, data);
  }
}

}  // namespace

std::size_t frequency_column(BranchKind kind) {
  return kind == BranchKind::responses ? 0 : 1;
}

std::size_t amplitude_column(BranchKind kind) {
  return kind == BranchKind::modes ? 0 : frequency_column(kind) + 1;
}

FigureLine line_of(const scene::Scene& scene, const std::vector<std::pair<std::string, double>>& set) {
  return {.label = set_label(scene, set),
          .heading = assignment(scene, set),
          .set = set,
          .force = force_amplitude(scene, set)};
}

namespace {

/// The points of a branch in parts of one stability, which meet at the events between them, or half way.
template <class RecordOf>
void add_parts(const ResponseBranch& branch, RecordOf record_of, FigureLine& line) {
  const auto is_unstable = [](const ResponsePoint& point) {
    return point.stability && point.stability->unstable > 0;
  };
  const bool known = std::any_of(branch.points.begin(), branch.points.end(),
                                 [](const ResponsePoint& point) { return point.stability.has_value(); });
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const ResponsePoint& point = branch.points[i];
    if (i == 0 || is_unstable(point) != is_unstable(branch.points[i - 1])) {
      Record middle;
      if (i > 0) {
        middle = record_of(branch.points[i - 1]);
        const Record next = record_of(point);
        for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = 0.5 * (middle[k] + next[k]);
        for (const auto& event : branch.events)
          if (event.after + 1 == i) middle = record_of(event.point);
        line.parts.back().push_back(middle);
      }
      line.parts.emplace_back();
      if (i > 0) line.parts.back().push_back(middle);
      if (known) line.unstable.resize(line.parts.size() - 1, false);
      if (known) line.unstable.push_back(is_unstable(point));
    }
    line.parts.back().push_back(record_of(point));
  }
}

}  // namespace

FigureData figures_of(const scene::Scene& scene, BranchKind kind, std::vector<LineOfBranches> lines) {
  FigureData data;
  data.title = scene.title;
  std::vector<const ResponseBranch*> branches;
  for (const LineOfBranches& each : lines)
    branches.insert(branches.end(), each.branches.begin(), each.branches.end());
  const Quantities quantities = quantities_of(kind, branches);
  set_columns(scene, kind, quantities, branches.empty() ? "" : branches.front()->over, data);
  const std::size_t motions_each = most_motions / std::max<std::size_t>(1, lines.size());
  for (LineOfBranches& each : lines) {
    FigureLine line = std::move(each.line);
    for (const ResponseBranch* branch : each.branches) {
      if (branch->points.empty()) continue;
      for (const observables::ResponseEvent& event : branch->events) {
        if (event.kind == branch->of) continue;  // an end of the curve
        line.unbounded = line.unbounded || event.point.unbounded;
        const results::EventKind of = observables::event_kinds::kind_named(event.kind);
        if (of.mark.shape != results::Shape::none)
          line.marks.push_back({of, record(scene, kind, quantities, event.point)});
      }
      for (const ResponsePoint& point : branch->points) line.unbounded = line.unbounded || point.unbounded;
      add_parts(
          *branch, [&](const ResponsePoint& point) { return record(scene, kind, quantities, point); }, line);
    }
    if (kind == BranchKind::responses)
      line.motions = motions_on(scene, each.branches, motions_each, [&](const ResponsePoint& point) {
        return record(scene, kind, quantities, point);
      });
    if (!line.parts.empty()) data.lines.push_back(std::move(line));
  }
  set_ranges(kind, data);
  set_figures(scene, kind, quantities.shares, data);
  if (data.lines.size() == 1 && kind != BranchKind::folds && kind != BranchKind::bifurcations) {
    const auto column_0 = [&](const ResponsePoint& point) { return record(scene, kind, {}, point)[0]; };
    for (FigureView& figure : contact_figures(branches, column_0)) data.figures.push_back(std::move(figure));
  }
  return data;
}

namespace {

/// Puts words before the texts of a line.
void prepend(const std::string& words, FigureLine& line) {
  for (std::string* text : {&line.label, &line.heading}) *text = words + (text->empty() ? "" : ", " + *text);
}

/// That of a curve of bifurcations has their kind, too.
FigureLine line_of_branch(const scene::Scene& scene, const ResponseBranch& branch) {
  FigureLine line = line_of(scene, branch.set);
  if (branch.of.empty()) return line;
  prepend(observables::event_kinds::words_of(branch.of), line);
  return line;
}

/// Names what lines of the same parameters differ in: the period of their motions, or that no other branch
/// reaches them.
void name_branches(std::vector<LineOfBranches>& lines) {
  const auto first = [](const LineOfBranches& line) { return line.branches.front(); };
  const bool have_periods =
      std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return first(line)->period != 1; });
  for (LineOfBranches& each : lines) {
    if (first(each)->isolated) prepend("isolated", each.line);
    const int period = first(each)->period;
    if (have_periods) prepend(std::to_string(period) + (period == 1 ? " period" : " periods"), each.line);
  }
}

/// Numbers lines whose labels would take the room of the figure: their headings tell what is set.
void number_long(FigureData& data) {
  constexpr std::size_t longest = 32;
  if (std::none_of(data.lines.begin(), data.lines.end(),
                   [](const FigureLine& line) { return line.label.size() > longest; }))
    return;
  for (std::size_t i = 0; i < data.lines.size(); ++i) data.lines[i].label = std::to_string(i + 1);
  data.parameters = {"setting"};
}

}  // namespace

FigureData figures_of(const scene::Scene& scene, BranchKind kind, std::span<const ResponseBranch> branches) {
  std::vector<LineOfBranches> lines;
  for (const ResponseBranch& branch : branches) {
    auto line = std::find_if(lines.begin(), lines.end(), [&](const LineOfBranches& candidate) {
      const ResponseBranch& other = *candidate.branches.front();
      return candidate.line.set == branch.set && other.of == branch.of && other.period == branch.period &&
             other.isolated == branch.isolated;
    });
    if (line == lines.end()) line = lines.insert(line, {line_of_branch(scene, branch), {}});
    line->branches.push_back(&branch);
  }
  name_branches(lines);
  FigureData data = figures_of(scene, kind, std::move(lines));
  for (std::size_t i = 0; !data.lines.empty() && i < data.lines.front().set.size(); ++i)
    data.parameters.push_back(words_of(scene, data.lines.front().set[i].first));
  number_long(data);
  return data;
}

namespace {

using observables::Motion;
using results::FigureData;
using results::Record;

constexpr std::size_t most_instants = 20'000;

/// A hysteresis loop: an element of the histories.
struct Loop {
  std::size_t element;
  std::string name;
};

/// Those of the friction elements, and of their further directions, which follow all elements of the scene.
std::vector<Loop> loops_of(const scene::Scene& scene, std::span<const Motion> motions) {
  std::vector<Loop> loops;
  const std::vector<scene::Part> elements = scene::all_elements(scene);
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (elements[e].detailed && observables::is_friction_part(elements[e]))
      loops.push_back({e, elements[e].name});
  const auto longest = std::max_element(motions.begin(), motions.end(), [](const Motion& a, const Motion& b) {
    return a.history.elements.size() < b.history.elements.size();
  });
  for (std::size_t e = elements.size(); longest != motions.end() && e < longest->history.elements.size(); ++e)
    loops.push_back({e, longest->history.elements[e].name});
  return loops;
}

Record record(const time::TimeHistory& history, const std::vector<Loop>& loops, std::size_t i) {
  Record values{history.time[i], history.displacement[i]};
  for (const auto& [e, name] : loops) {
    const bool is_there = e < history.elements.size();  // not in a motion that could not be integrated
    values.push_back(is_there ? history.elements[e].displacement[i] : observables::no_value);
    values.push_back(is_there ? history.elements[e].force[i] : observables::no_value);
  }
  return values;
}

std::vector<Record> records(const time::TimeHistory& history, const std::vector<Loop>& loops) {
  std::vector<Record> all;
  const std::size_t count = history.time.size();
  const std::size_t stride = (count + most_instants - 1) / most_instants;
  for (std::size_t i = 0; i < count; i += stride) all.push_back(record(history, loops, i));
  if (count > 0 && (count - 1) % stride != 0) all.push_back(record(history, loops, count - 1));
  return all;
}

void set_figures(const std::vector<Loop>& loops, FigureData& data) {
  data.figures = {{"displacement", 0, 1}};
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const std::size_t q = 2 + 2 * i;
    const std::string of = loops.size() > 1 ? "_" + std::to_string(i + 1) + "_" + loops[i].name : "";
    data.figures.push_back({"hysteresis" + of, q, q + 1});
    data.figures.push_back({"force" + of, 0, q + 1});
  }
}

}  // namespace

FigureData figures_of(const scene::Scene& scene, std::span<const Motion> motions) {
  FigureData data;
  data.title = scene.title;
  const std::vector<Loop> loops = loops_of(scene, motions);
  data.columns = {{"time", "s"}, {label_of(scene, "displacement"), "m"}};
  for (const Loop& loop : loops) {
    data.columns.push_back({loop.name + " displacement", "m"});
    data.columns.push_back({loop.name + " force", "N"});
  }
  for (const Motion& motion : motions) {
    if (motion.history.time.empty()) continue;
    if (data.parameters.empty())
      for (const auto& [name, value] : motion.set) data.parameters.push_back(words_of(scene, name));
    data.lines.push_back(line_of(scene, motion.set));
    data.lines.back().parts = {records(motion.history, loops)};
  }
  for (std::size_t i = 0; i < data.columns.size(); ++i) data.columns[i].range = results::full_range(data, i);
  set_figures(loops, data);
  number_long(data);
  return data;
}

}  // namespace arcslip::studies
