#include <arcslip/studies/presentation/branches.hpp>

#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/presentation/histories.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

namespace arcslip::studies {
namespace {

constexpr const char* multipliers_key = "multipliers";
constexpr int multipliers_in_tables = 2;

using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponsePoint;
using observables::Solution;

bool has_maxima(const ResponseBranch& branch) {
  return !branch.points.empty() && !std::isnan(branch.points.front().maxima.velocity);
}

bool has_stability(const ResponseBranch& branch) {
  return std::any_of(branch.points.begin(), branch.points.end(),
                     [](const ResponsePoint& point) { return point.stability.has_value(); });
}

bool has_locations(const ResponseBranch& branch) {
  return std::any_of(branch.points.begin(), branch.points.end(),
                     [](const ResponsePoint& point) { return !std::isnan(point.location_estimate); });
}

// What the points of a branch have.
Asked asked_of(const ResponseBranch& branch) {
  return {.over = branch.over,
          .maxima = has_maxima(branch),
          .mode = !branch.points.empty() && !std::isnan(branch.points.front().damping_ratio),
          .stability = has_stability(branch),
          .located = has_maxima(branch) && has_locations(branch)};
}

/// The tables of branches with the same columns.
struct BranchTables {
  BranchTables(const scene::Scene& scene, Asked asked) : points(responses(scene, asked)) {
    events.add({"kind"}, "", "`peak`, `fold` and so on",
               [](const ResponseEvent& event) { return event.kind; });
    events.add({"nonsmooth"}, "", "at a kink of the branch",
               [](const ResponseEvent& event) { return event.nonsmooth; });
    events.add({"located"}, "", "false: replaced by the nearest point",
               [](const ResponseEvent& event) { return event.located; });
    events.add({"after"}, "", "index of the preceding point",
               [](const ResponseEvent& event) { return event.after; });
    const auto add_location = [](auto& table, auto point) {
      table.add(
          {"location_estimate"}, "",
          "estimated effect of the neglected harmonics on `omega`, or on the parameter of a response over "
          "another one, in its unit; null where it is not known",
          [point](const auto& at) { return point(at).location_estimate; });
    };
    if (asked.maxima && !asked.mode)  // a curve of special points
      add_location(points, [](const ResponsePoint& at) -> const Solution& { return at; });
    const bool of_curve = asked.maxima && !asked.mode;
    asked.maxima = !asked.mode;
    events.add(responses(scene, asked), [](const ResponseEvent& event) { return &event.point; });
    if (!asked.mode)
      add_location(events, [](const ResponseEvent& at) -> const Solution& { return at.point; });
    if (of_curve)
      events.add(
          {"parameter_estimate"}, "",
          "of an extremum, a turn or a cusp of a curve: the same effect on its parameter, in its unit; "
          "null where it is not known",
          [](const ResponseEvent& at) { return at.point.parameter_estimate; });
  }

  results::TableOf<ResponsePoint> points;
  results::TableOf<ResponseEvent> events;
};

std::vector<results::Shown> shown(const scene::Scene& scene, const Asked& asked) {
  std::vector<results::Shown> all;
  if (asked.leaving) all = {{"no.", {"id"}}, {"period", {"period"}}};
  // Of the parameter that the branch is over; on a curve of special points of their frequency.
  const std::string location = "location_estimate";
  std::vector<std::string> doubts{"truncation_flagged"};
  if (asked.located) doubts.push_back(location);  // not known where the event is: nor what it is there
  const bool of_frequency = asked.over.empty() || asked.maxima;
  if (!asked.over.empty())
    all.push_back({.title = results::with_unit(asked.over, parameter_unit(scene, asked.over)),
                   .path = {asked.over},
                   .error = {of_frequency ? "parameter_estimate" : location},
                   .doubtful = doubts});
  all.push_back({"event", {"kind"}});
  all.push_back({.title = results::with_unit("frequency", scene::unit_name(scene.frequency_unit)),
                 .path = {"frequency"},
                 .format = "%.8f",
                 .error = of_frequency ? std::vector{location} : std::vector<std::string>(),
                 .error_unit = in_scene_unit(scene, 1),
                 .doubtful = of_frequency ? doubts : std::vector<std::string>()});
  all.push_back({.title = asked.mode ? "A" : "A_max",
                 .path = {"amplitude"},
                 .format = "%.8e",
                 .otherwise = "unbounded",
                 .error = {"truncation_estimate"},
                 .doubtful = doubts,
                 .unit = "m"});
  if (asked.mode) all.push_back({"damping ratio", {"damping_ratio"}, "%.8f"});
  add_stick(scene, all, doubts);
  if (asked.stability) {  // `stable` of an event leaves out the multipliers that make it one
    const auto& limits = observables::event_kinds::limits_of_stability;
    all.push_back({.title = "largest multipliers", .path = {multipliers_key}});
    all.push_back({.title = "stable",
                   .path = {"stable"},
                   .instead = {"limit", "kind", {limits.begin(), limits.end()}}});
  }
  return all;
}

/// Tables have the largest multipliers as columns, and files all that the study keeps.
std::vector<results::Column> with_multipliers(std::vector<results::Column> columns) {
  for (results::Column& column : columns)
    if (column.path.back() == multipliers_key) column.spread = multipliers_in_tables;
  return columns;
}

results::Schema schema(const scene::Scene& scene, const Asked& asked, const BranchTables& tables) {
  return {.format = "arcslip-branches-1",
          .list = "branches",
          .noun = "branch",
          .tables = {{"points", with_multipliers(tables.points.columns()), {"elements"}},
                     {"events", with_multipliers(tables.events.columns()), {"elements"}}},
          .shown = shown(scene, asked),
          .shown_table = "events"};
}

const char* name(observables::Symmetry symmetry) {
  if (symmetry == observables::Symmetry::none) return "none";
  return symmetry == observables::Symmetry::antisymmetric ? "antisymmetric" : "mirror_pair";
}

results::Object leaves(const scene::Scene& scene, const observables::Leaves& at) {
  return {{"event", at.event},
          {"kind", at.kind},
          {"frequency", in_scene_unit(scene, at.omega), std::string(scene::unit_name(scene.frequency_unit))}};
}

// What is reported below the table: what its motions are, where they are unstable, and what was not
// followed.
std::string branch_remark(const scene::Scene& scene, const ResponseBranch& branch) {
  std::string text;
  const auto add = [&](const std::string& more) {
    if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
  };
  if (branch.isolated) add("no other branch reaches it");
  if (!branch.leaves.kind.empty()) {
    add(branch.symmetry == observables::Symmetry::mirror_pair ? "a pair of mirror images" : "");
    add("period " + std::to_string(branch.period));
  }
  add(branch.no_peak);
  add(unstable_ranges(scene, branch));
  add(untraced(branch));
  return text;
}

results::Result result(const scene::Scene& scene, const ResponseBranch& branch, const BranchTables& tables,
                       const Asked& asked, const RunOptions& options) {
  results::Result result{0, {branch.study, branch.kind, named(scene, branch.set)}, {}, {}};
  result.head.parent = branch.parent;
  if (!branch.over.empty()) result.head.facts.push_back({"over", branch.over});
  if (!branch.of.empty()) result.head.facts.push_back({"of", branch.of});
  result.head.facts.push_back({"parameters", named(scene, branch.parameters)});
  result.head.facts.push_back({"period", branch.period});
  if (asked.leaving) {
    result.head.facts.push_back({"symmetry", name(branch.symmetry)});
    if (branch.isolated) result.head.facts.push_back({"isolated", true});
    if (!branch.leaves.kind.empty()) result.head.facts.push_back({"leaves", leaves(scene, branch.leaves)});
  }
  if (options.coefficients)
    result.head.facts.push_back(
        {"harmonics", results::Value::List(branch.harmonics.begin(), branch.harmonics.end())});
  if (options.points) result.tables.push_back(tables.points.rows(branch.points));
  result.tables.resize(1);
  result.tables.push_back(tables.events.rows(branch.events));
  result.end = {branch.status,
                stop(branch.stop),
                {{"solver", solver(branch.solver)}},
                doubt_of(branch),
                {},
                branch_remark(scene, branch)};
  if (!branch.no_peak.empty()) result.end.facts.push_back({"no_peak", branch.no_peak});
  if (!branch.untraced.empty())
    result.end.facts.push_back(
        {"untraced", results::Value::List(branch.untraced.begin(), branch.untraced.end())});
  return result;
}

}  // namespace

Described<ResponseBranch> branches(const scene::Scene& scene, Asked asked, const RunOptions& options) {
  asked.coefficients = options.coefficients;
  const auto tables = std::make_shared<const BranchTables>(scene, asked);
  const auto kept = options.motions ? std::make_shared<const scene::Scene>(scene) : nullptr;
  return {schema(scene, asked, *tables),
          [&scene, tables, asked, options, kept](const ResponseBranch& branch) {
            results::Result all = result(scene, branch, *tables, asked, options);
            const bool has_motions = !branch.points.empty() && !branch.points.front().unknowns.empty();
            if (kept && has_motions) all.end.motion = motion_at(kept, branch);
            return all;
          }};
}

results::Results results_of(const scene::Scene& scene, std::span<const ResponseBranch> all,
                            const RunOptions& options) {
  results::Results found{header(scene), {}, {}};
  std::map<std::tuple<std::string, bool, bool, bool, bool>, std::size_t>
      index;  // of schemas, by their distinguishing columns
  std::vector<Described<ResponseBranch>> described;
  const bool leaving = std::any_of(all.begin(), all.end(), [](const ResponseBranch& branch) {
    return branch.isolated || !branch.leaves.kind.empty();
  });
  for (const ResponseBranch& branch : all) {
    Asked asked = asked_of(branch);
    asked.leaving = leaving;
    const auto [at, is_new] = index.try_emplace(
        {asked.over, asked.maxima, asked.mode, asked.stability, asked.located}, described.size());
    if (is_new) {
      described.push_back(branches(scene, asked, options));
      found.schemas.push_back(described.back().schema);
    }
    add_columns(scene, branch.set, found.schemas[at->second].set);
    found.results.push_back(described[at->second].result(branch));
    found.results.back().schema = at->second;
  }
  if (all.empty()) found.schemas.push_back(branches(scene, {}, options).schema);
  return found;
}

}  // namespace arcslip::studies
