#include <arcslip/studies/branches.hpp>

#include <arcslip/studies/columns.hpp>
#include <arcslip/studies/units.hpp>

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

results::TableOf<ResponsePoint> points(const scene::Scene& scene, const ResponseBranch& branch,
                                       const BranchOptions& options) {
  return responses(scene, {branch.over, has_maxima(branch), options.coefficients});
}

results::TableOf<ResponseEvent> events(const scene::Scene& scene, const ResponseBranch& branch,
                                       const BranchOptions& options) {
  results::TableOf<ResponseEvent> table;
  table.add({"kind"}, "", "`peak`, `fold` and so on", [](const ResponseEvent& event) { return event.kind; });
  table.add({"nonsmooth"}, "", "at a kink of the branch",
            [](const ResponseEvent& event) { return event.nonsmooth; });
  table.add({"located"}, "", "false: the nearest point in its place",
            [](const ResponseEvent& event) { return event.located; });
  table.add({"after"}, "", "index of the point before it",
            [](const ResponseEvent& event) { return event.after; });
  table.add(responses(scene, {branch.over, true, options.coefficients}),
            [](const ResponseEvent& event) { return &event.point; });
  return table;
}

std::vector<results::Shown> shown(const scene::Scene& scene, const std::string& over) {
  std::vector<results::Shown> all;
  if (!over.empty()) all.push_back({with_unit(over, parameter_unit(scene, over)), {over}});
  all.push_back({"event", {"kind"}});
  all.push_back({with_unit("frequency", scene::unit_name(scene.frequency_unit)), {"frequency"}, "%.8f"});
  all.push_back({"A_max (m)", {"amplitude"}, "%.8e", "unbounded"});
  add_stick(scene, all);
  return all;
}

results::Schema schema(const scene::Scene& scene, const ResponseBranch& branch,
                       const BranchOptions& options) {
  return {.format = "arcslip-branches-1",
          .list = "branches",
          .noun = "branch",
          .tables = {{"points", points(scene, branch, options).columns(), {"elements"}},
                     {"events", events(scene, branch, options).columns(), {"elements"}}},
          .shown = shown(scene, branch.over),
          .shown_table = "events"};
}

results::Object solver(const observables::SolverSummary& summary) {
  return {{"linear_solver", summary.linear_solver},
          {"unknowns", summary.unknowns},
          {"points", summary.points},
          {"rejected_steps", summary.rejected_steps},
          {"residuals", summary.residuals},
          {"jacobians", summary.jacobians},
          {"factorizations", summary.factorizations},
          {"solves", summary.solves},
          {"seconds", summary.seconds, "s"}};
}

results::Result result(const scene::Scene& scene, const ResponseBranch& branch,
                       const BranchOptions& options) {
  results::Result result;
  result.head = {branch.study, branch.kind, named(scene, branch.set)};
  if (!branch.over.empty()) result.head.facts.push_back({"over", branch.over});
  result.head.facts.push_back({"parameters", named(scene, branch.parameters)});
  if (options.coefficients) {
    results::Value::List harmonics;
    for (const int n : branch.harmonics) harmonics.emplace_back(n);
    result.head.facts.push_back({"harmonics", std::move(harmonics)});
  }
  result.tables = {points(scene, branch, options).rows(branch.points),
                   events(scene, branch, options).rows(branch.events)};
  result.end = {observables::name(branch.status),
                stop(branch.stop),
                {{"solver", solver(branch.solver)}},
                doubt_of(branch)};
  return result;
}

}  // namespace

results::Results results_of(const scene::Scene& scene, std::span<const ResponseBranch> branches,
                            const BranchOptions& options) {
  results::Results all{header(scene), {}, {}};
  std::map<std::pair<std::string, bool>, std::size_t> schemas;  // by what tells their columns apart
  for (const ResponseBranch& branch : branches) {
    const auto [at, is_new] = schemas.try_emplace({branch.over, has_maxima(branch)}, all.schemas.size());
    if (is_new) all.schemas.push_back(schema(scene, branch, options));
    add_columns(scene, branch.set, all.schemas[at->second].set);
    all.results.push_back(result(scene, branch, options));
    all.results.back().schema = at->second;
  }
  if (branches.empty()) all.schemas.push_back(schema(scene, {}, options));
  return all;
}

}  // namespace arcslip::studies
