#include <arcslip/studies/branches.hpp>

#include <arcslip/results/text.hpp>

#include <cmath>
#include <map>
#include <utility>

namespace arcslip::studies {
namespace {

using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponsePoint;

bool has_maxima(const ResponseBranch& branch) {
  return !branch.points.empty() && !std::isnan(branch.points.front().maxima.velocity);
}

/// The tables of branches with the same columns.
struct Tables {
  Tables(const scene::Scene& scene, const ResponseBranch& branch, bool coefficients)
      : points(responses(scene, {branch.over, has_maxima(branch), coefficients})) {
    events.add({"kind"}, "", "`peak`, `fold` and so on",
               [](const ResponseEvent& event) { return event.kind; });
    events.add({"nonsmooth"}, "", "at a kink of the branch",
               [](const ResponseEvent& event) { return event.nonsmooth; });
    events.add({"located"}, "", "false: the nearest point in its place",
               [](const ResponseEvent& event) { return event.located; });
    events.add({"after"}, "", "index of the point before it",
               [](const ResponseEvent& event) { return event.after; });
    events.add(responses(scene, {branch.over, true, coefficients}),
               [](const ResponseEvent& event) { return &event.point; });
  }

  results::TableOf<ResponsePoint> points;
  results::TableOf<ResponseEvent> events;
  std::size_t schema = 0;
};

std::vector<results::Shown> shown(const scene::Scene& scene, const std::string& over) {
  std::vector<results::Shown> all;
  if (!over.empty()) all.push_back({results::with_unit(over, parameter_unit(scene, over)), {over}});
  all.push_back({"event", {"kind"}});
  all.push_back(
      {results::with_unit("frequency", scene::unit_name(scene.frequency_unit)), {"frequency"}, "%.8f"});
  all.push_back({"A_max (m)", {"amplitude"}, "%.8e", "unbounded"});
  add_stick(scene, all);
  return all;
}

results::Schema schema(const scene::Scene& scene, const std::string& over, const Tables& tables) {
  return {.format = "arcslip-branches-1",
          .list = "branches",
          .noun = "branch",
          .tables = {{"points", tables.points.columns(), {"elements"}},
                     {"events", tables.events.columns(), {"elements"}}},
          .shown = shown(scene, over),
          .shown_table = "events"};
}

results::Result result(const scene::Scene& scene, const ResponseBranch& branch, const Tables& tables,
                       const RunOptions& options) {
  results::Result result{tables.schema, {branch.study, branch.kind, named(scene, branch.set)}, {}, {}};
  if (!branch.over.empty()) result.head.facts.push_back({"over", branch.over});
  result.head.facts.push_back({"parameters", named(scene, branch.parameters)});
  if (options.coefficients)
    result.head.facts.push_back(
        {"harmonics", results::Value::List(branch.harmonics.begin(), branch.harmonics.end())});
  if (options.points) result.tables.push_back(tables.points.rows(branch.points));
  result.tables.resize(1);
  result.tables.push_back(tables.events.rows(branch.events));
  result.end = {observables::name(branch.status),
                stop(branch.stop),
                {{"solver", solver(branch.solver)}},
                doubt_of(branch)};
  return result;
}

}  // namespace

results::Results results_of(const scene::Scene& scene, std::span<const ResponseBranch> branches,
                            const RunOptions& options) {
  results::Results all{header(scene), {}, {}};
  std::map<std::pair<std::string, bool>, Tables> tables;  // by what tells their columns apart
  const auto tables_of = [&](const ResponseBranch& branch) -> const Tables& {
    const auto [at, is_new] =
        tables.try_emplace({branch.over, has_maxima(branch)}, scene, branch, options.coefficients);
    if (is_new) {
      at->second.schema = all.schemas.size();
      all.schemas.push_back(schema(scene, branch.over, at->second));
    }
    return at->second;
  };
  for (const ResponseBranch& branch : branches) {
    const Tables& of_branch = tables_of(branch);
    add_columns(scene, branch.set, all.schemas[of_branch.schema].set);
    all.results.push_back(result(scene, branch, of_branch, options));
  }
  if (branches.empty()) tables_of({});
  return all;
}

}  // namespace arcslip::studies
