#include <arcslip/optimize/study/optimum_results.hpp>

#include <arcslip/optimize/study/optimum_text.hpp>

#include <arcslip/results/table_of.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace arcslip::optimize {
namespace {

using observables::ResponsePoint;
using results::Object;
using results::TableOf;
using results::Value;

Object named(const scene::Scene& scene, const OptimumProblem& problem, std::span<const double> design) {
  Object all;
  for (std::size_t k = 0; k < design.size(); ++k)
    all.push_back({problem.over[k].name, design[k], studies::parameter_unit(scene, problem.over[k].name)});
  return all;
}

std::string place_at_bound(int side) {
  return side < 0 ? "lower" : side > 0 ? "upper" : "inside";
}

Object places_at_bounds(const OptimumProblem& problem, const std::vector<int>& at_bound) {
  Object all;
  for (std::size_t k = 0; k < at_bound.size(); ++k)
    all.push_back({problem.over[k].name, place_at_bound(at_bound[k])});
  return all;
}

// All of a response but its amplitude, which is said of what it belongs to.
TableOf<ResponsePoint> response_table(const scene::Scene& scene) {
  return studies::responses(scene, {.amplitude = false});
}

void add_response(const scene::Scene& scene, const ResponsePoint& response, Object& all) {
  const TableOf<ResponsePoint> table = response_table(scene);
  for (results::Member& member : results::object(table.columns(), table.rows(std::vector{response}), 0))
    all.push_back(std::move(member));
}

// As a scene file has it.
Object place_of(const scene::Scene& scene, const scene::Direction& direction) {
  const auto name = [&](const scene::Term& term) { return scene.dofs[static_cast<std::size_t>(term.dof)]; };
  if (direction.size() == 1 && direction[0].weight == 1) return {{"at", name(direction[0])}};
  Object weights;
  for (const scene::Term& term : direction) weights.push_back({name(term), term.weight});
  return {{"direction", weights}};
}

template <class Item, class Get>
void add_design(const scene::Scene& scene, const OptimumProblem& problem, Get design, TableOf<Item>& table) {
  for (std::size_t k = 0; k < problem.over.size(); ++k)
    table.add({problem.over[k].name}, studies::parameter_unit(scene, problem.over[k].name), "of the design",
              [design, k](const Item& item) { return design(item)[k]; });
}

TableOf<Evaluation> course(const scene::Scene& scene, const OptimumProblem& problem) {
  TableOf<Evaluation> table;
  add_design(scene, problem, [](const Evaluation& at) -> const auto& { return at.design; }, table);
  table.add({"amplitude"}, "m", "of the criterion; null: unbounded",
            [](const Evaluation& at) { return at.amplitude; });
  return table;
}

TableOf<LoadCaseResult> cases(const scene::Scene& scene, const OptimumProblem& problem) {
  TableOf<LoadCaseResult> table;
  table.add({"set"}, "", "parameters set by the case",
            [&scene](const LoadCaseResult& at) { return studies::named(scene, at.set); });
  if (!problem.scatter.empty()) {
    table.add({"scatter"}, "", "values of the uncertain parameters",
              [&scene](const LoadCaseResult& at) { return studies::named(scene, at.scatter); });
    table.add({"of"}, "", "which of the study's cases it belongs to, from 1",
              [](const LoadCaseResult& at) { return at.of + 1; });
  }
  table.add({"response"}, "", "the response of the case, if it has its own",
            [&scene, &problem](const LoadCaseResult& at) {
              return at.of < problem.cases.size() && problem.cases[at.of].response
                         ? std::optional(place_of(scene, *problem.cases[at.of].response))
                         : std::nullopt;
            });
  table.add({"weight"}, "", "of its amplitude", [](const LoadCaseResult& at) { return at.weight; });
  table.add({"active"}, "", "as high as the highest, within 1e-6 (mean: always)",
            [](const LoadCaseResult& at) { return at.active; });
  table.add({"multiplier"}, "", "Lagrange multiplier",
            [](const LoadCaseResult& at) { return at.multiplier; });
  table.add({"amplitude"}, "m", "without the weight", [](const LoadCaseResult& at) { return at.amplitude; });
  table.add(response_table(scene), [](const LoadCaseResult& at) { return &at.point; });
  return table;
}

Value optimum_value(const scene::Scene& scene, const OptimumResult& result) {
  const Optimum& found = result.optimum;
  if (found.design.empty() || !std::isfinite(found.amplitude)) return {};
  Object all = named(scene, result.problem, found.design);
  all.push_back({"amplitude", found.amplitude, "m"});
  add_response(scene, found.point, all);
  all.push_back({"feasible", found.feasible});
  return all;
}

Object range(const ToleranceRange& range) {
  return {{"share", range.share},
          {"lower", range.lower},
          {"upper", range.upper},
          {"lower_is_bound", range.lower_is_bound},
          {"upper_is_bound", range.upper_is_bound},
          {"lower_is_limit", range.lower_is_limit},
          {"upper_is_limit", range.upper_is_limit}};
}

Object certificate(const scene::Scene& scene, const OptimumProblem& problem, const Certificate& c,
                   bool has_cases) {
  const auto in_case = [&](Object object, std::size_t number) {
    if (has_cases) object.push_back({"case", number + 1});
    return object;
  };
  Object slopes;
  for (std::size_t k = 0; k < c.gradient.size(); ++k) slopes.push_back({problem.over[k].name, c.gradient[k]});
  Object all{{"gradient", std::move(slopes)},
             {"stationarity", c.stationarity},
             {"complementarity", c.complementarity}};
  if (!c.design_estimate.empty()) {
    all.push_back({"design_estimate", named(scene, problem, c.design_estimate)});
    all.push_back({"design_flagged", c.design_flagged});
  }
  if (!c.to_minimum.empty()) all.push_back({"to_minimum", named(scene, problem, c.to_minimum)});
  if (c.curvature.size() > 0) {
    Value::List rows;
    for (Eigen::Index i = 0; i < c.curvature.rows(); ++i) {
      const Eigen::VectorXd row = c.curvature.row(i);
      rows.emplace_back(std::vector<double>(row.begin(), row.end()));
    }
    all.push_back({"curvature", std::move(rows)});
  }
  Object ranges;
  for (std::size_t k = 0; k < c.ranges.size(); ++k) {
    Value::List of_parameter;
    for (const ToleranceRange& each : c.ranges[k]) of_parameter.emplace_back(range(each));
    if (!of_parameter.empty()) ranges.push_back({problem.over[k].name, std::move(of_parameter)});
  }
  all.push_back({"ranges", std::move(ranges)});
  Value::List peaks, limits, others;
  for (const CertifiedPeak& peak : c.peaks)
    peaks.emplace_back(in_case({{"kind", name(peak.kind)},
                                {"frequency", studies::in_scene_unit(scene, peak.omega)},
                                {"omega", peak.omega},
                                {"amplitude", peak.amplitude},
                                {"active", peak.active},
                                {"weight", peak.weight}},
                               peak.in_case));
  for (const ActiveLimit& limit : c.limits)
    limits.emplace_back(
        in_case({{"limit", limit.limit}, {"multiplier", limit.multiplier}, {"by_height", limit.by_height}},
                limit.in_case));
  for (const OtherResponse& other : c.others)
    others.emplace_back(in_case({{"found_by", other.found_by},
                                 {"frequency", studies::in_scene_unit(scene, other.omega)},
                                 {"amplitude", other.amplitude}},
                                other.in_case));
  all.push_back({"peaks", std::move(peaks)});
  all.push_back({"limits", std::move(limits)});
  all.push_back({"at_bound", places_at_bounds(problem, c.at_bound)});
  all.push_back({"others", std::move(others)});
  all.push_back({"others_lower", c.others_lower});
  return all;
}

Object direct(const scene::Scene& scene, const OptimumResult& result) {
  const DirectOptimum& direct = result.direct;
  if (!direct.found) return {{"message", direct.message}};
  Object all{{result.problem.over[0].name, direct.point.over,
              studies::parameter_unit(scene, result.problem.over[0].name)},
             {"amplitude", direct.point.amplitude, "m"}};
  add_response(scene, direct.point, all);
  all.push_back({"difference", Object{{"design", result.difference_of_design()},
                                      {"amplitude", result.difference_of_amplitude()}}});
  return all;
}

Value::List texts(const std::vector<std::string>& all) {
  return {all.begin(), all.end()};
}

Object facts(const scene::Scene& scene, const OptimumResult& result) {
  const Optimum& found = result.optimum;
  Object all{{"optimum", optimum_value(scene, result)}};
  if (result.has_cases()) all.push_back({"criterion", name(result.problem.criterion)});
  if (!result.problem.scatter.empty()) all.push_back({"scatter_rounds", found.scatter_rounds});
  all.insert(all.end(), {{"algorithm", found.algorithm},
                         {"epigraph", found.epigraph},
                         {"evaluations", found.evaluations.size()},
                         {"responses", found.work.responses},
                         {"followed", found.work.followed},
                         {"factorizations", found.work.factorizations},
                         {"seconds", found.seconds, "s"},
                         {"notes", texts(found.notes)}});
  if (found.starts)
    all.push_back({"starts", Object{{"count", found.starts->count},
                                    {"to_optimum", found.starts->to_optimum},
                                    {"to_none", found.starts->to_none},
                                    {"highest", found.starts->highest, "m"}}});
  if (found.certificate)
    all.push_back(
        {"certificate", certificate(scene, result.problem, *found.certificate, result.has_cases())});
  if (result.direct.found || !result.direct.message.empty()) all.push_back({"direct", direct(scene, result)});
  return all;
}

// Of the responses at the optimum.
std::string doubt(const OptimumResult& result) {
  for (const observables::ResponseBranch& branch : result.responses)
    if (std::string doubts = studies::doubt_of(branch); !doubts.empty()) return doubts;
  return {};
}

TableOf<OptimumPoint> points(const scene::Scene& scene, const OptimumProblem& problem,
                             const std::string& along) {
  TableOf<OptimumPoint> table;
  table.add({along}, studies::parameter_unit(scene, along), "the continuation parameter",
            [](const OptimumPoint& at) { return at.along; });
  add_design(scene, problem, [](const OptimumPoint& at) -> const auto& { return at.design; }, table);
  table.add({"amplitude"}, "m", "A_max", [](const OptimumPoint& at) { return at.amplitude; });
  table.add({"peaks"}, "", "the active peaks", [&scene](const OptimumPoint& at) {
    Value::List peaks;
    for (const OptimumPeak& peak : at.peaks)
      peaks.emplace_back(Object{{"kind", name(peak.kind)},
                                {"frequency", studies::in_scene_unit(scene, peak.omega)},
                                {"omega", peak.omega},
                                {"weight", peak.weight}});
    return peaks;
  });
  for (std::size_t k = 0; k < problem.over.size(); ++k)
    table.add({"at_bound", problem.over[k].name}, "", "`lower`, `inside`, `upper`",
              [k](const OptimumPoint& at) {
                return k < at.at_bound.size() ? std::optional(place_at_bound(at.at_bound[k])) : std::nullopt;
              });
  table.add({"minimum"}, "", "false: a saddle", [](const OptimumPoint& at) { return at.minimum; });
  table.add(response_table(scene), [](const OptimumPoint& at) { return &at.response; });
  return table;
}

TableOf<OptimumEvent> events(const scene::Scene& scene, const OptimumProblem& problem,
                             const std::string& along) {
  const auto of_peak = [](const OptimumEvent& event, double value) {
    return event.omega > 0 ? std::optional(value) : std::nullopt;
  };
  TableOf<OptimumEvent> table;
  table.add({"kind"}, "", "what changes", [](const OptimumEvent& event) { return event.kind; });
  table.add({"parameter"}, "", "of a bound", [](const OptimumEvent& event) {
    return event.parameter.empty() ? std::nullopt : std::optional(event.parameter);
  });
  table.add({"frequency"}, std::string(scene::unit_name(scene.frequency_unit)), "of the peak that changes",
            [of_peak, &scene](const OptimumEvent& event) {
              return of_peak(event, studies::in_scene_unit(scene, event.omega));
            });
  table.add({"omega"}, "rad/s", "of the peak that changes",
            [of_peak](const OptimumEvent& event) { return of_peak(event, event.omega); });
  table.add({"nonsmooth"}, "", "at another event", [](const OptimumEvent& event) { return event.nonsmooth; });
  table.add({"after"}, "", "index of the preceding point",
            [](const OptimumEvent& event) { return event.after; });
  table.add(points(scene, problem, along), [](const OptimumEvent& event) { return &event.point; }, {"point"});
  return table;
}

}  // namespace

studies::Described<OptimumResult> described_optima(const scene::Scene& scene, const OptimumProblem& problem) {
  const auto of_course = std::make_shared<const TableOf<Evaluation>>(course(scene, problem));
  const auto of_cases = std::make_shared<const TableOf<LoadCaseResult>>(cases(scene, problem));
  results::Schema schema{.format = "arcslip-optimum-1",
                         .list = "optima",
                         .noun = "search",
                         .tables = {{"course", of_course->columns()}},
                         .nearby = {"optimum", "algorithm", "evaluations", "stop"}};
  if (has_cases(problem)) schema.tables.push_back({"cases", of_cases->columns(), {"elements"}});
  return {std::move(schema), [&scene, of_course, of_cases](const OptimumResult& each) {
            results::Result result{.schema = 0,
                                   .head = {each.study, each.kind, studies::named(scene, each.set)},
                                   .tables = {of_course->rows(each.optimum.evaluations)},
                                   .end = {each.status, studies::stop(each.stop), facts(scene, each),
                                           doubt(each), text_of(scene, each)}};
            if (each.has_cases()) result.tables.push_back(of_cases->rows(each.optimum.cases));
            return result;
          }};
}

studies::Described<OptimumCurveResult> described_curves(const scene::Scene& scene,
                                                        const OptimumProblem& problem,
                                                        const std::string& along) {
  const auto of_points = std::make_shared<const TableOf<OptimumPoint>>(points(scene, problem, along));
  const auto of_events = std::make_shared<const TableOf<OptimumEvent>>(events(scene, problem, along));
  results::Schema schema{
      .format = "arcslip-optimum-curves-1",
      .list = "optimum_curves",
      .noun = "curve",
      .tables = {{"points", of_points->columns(), {"elements"}}, {"events", of_events->columns()}}};
  return {std::move(schema), [&scene, of_points, of_events](const OptimumCurveResult& each) {
            const OptimumCurve& curve = each.curve;
            return results::Result{
                .schema = 0,
                .head = {each.study, each.kind, studies::named(scene, each.set), {{"along", curve.along}}},
                .tables = {of_points->rows(curve.points), of_events->rows(curve.events)},
                .end = {curve.status,
                        studies::stop(curve.stop),
                        {{"notes", texts(curve.notes)},
                         {"pieces", curve.work.pieces},
                         {"evaluations", curve.work.evaluations},
                         {"hessians", curve.work.hessians},
                         {"responses", curve.work.peaks.responses},
                         {"followed", curve.work.peaks.followed},
                         {"factorizations", curve.work.peaks.factorizations},
                         {"seconds", curve.work.seconds, "s"}},
                        "",
                        text_of(scene, each)}};
          }};
}

}  // namespace arcslip::optimize
