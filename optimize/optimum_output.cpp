#include <arcslip/optimize/optimum_output.hpp>

#include <arcslip/output/csv_text.hpp>
#include <arcslip/output/json_text.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace arcslip::optimize {
namespace {

using output::detail::Json;
using output::detail::text;

Json named(const OptimumProblem& problem, std::span<const double> design) {
  Json json = Json::object();
  for (std::size_t k = 0; k < design.size(); ++k) json[problem.over[k].name] = design[k];
  return json;
}

void add_place(Json& json, const scene::Scene& scene, const observables::ResponsePoint& point) {
  json["frequency"] = output::in_scene_unit(scene, point.omega);
  json["omega"] = point.omega;
  const auto has_stick = [](const auto& element) { return element.has_stick; };
  if (std::count_if(point.elements.begin(), point.elements.end(), has_stick) == 1)
    json["stick_percent"] =
        std::find_if(point.elements.begin(), point.elements.end(), has_stick)->stick_percent;
  json["energy_friction"] = point.energy_friction;
  Json& elements = json["elements"] = Json::object();
  for (const auto& element : point.elements)
    if (element.has_stick)
      elements[element.name] = {{"stick_percent", element.stick_percent}, {"energy", element.energy}};
}

Json optimum_of(const scene::Scene& scene, const OptimumResult& result) {
  const Optimum& found = result.optimum;
  if (found.design.empty() || !std::isfinite(found.amplitude)) return nullptr;
  Json json = named(result.problem, found.design);
  json["amplitude"] = found.amplitude;
  add_place(json, scene, found.point);
  json["feasible"] = found.feasible;
  return json;
}

// As a scene file has it.
Json place_of(const scene::Scene& scene, const scene::Direction& direction) {
  const auto name = [&](const scene::Term& term) { return scene.dofs[static_cast<std::size_t>(term.dof)]; };
  if (direction.size() == 1 && direction[0].weight == 1) return {{"at", name(direction[0])}};
  Json weights = Json::object();
  for (const scene::Term& term : direction) weights[name(term)] = term.weight;
  return {{"direction", weights}};
}

Json cases_of(const scene::Scene& scene, const OptimumResult& result) {
  Json list = Json::array();
  for (const CaseResult& each : result.optimum.cases) {
    Json& json = list.emplace_back(Json{{"set", output::detail::named_values(each.set)}});
    if (!result.problem.scatter.empty()) {
      json["scatter"] = output::detail::named_values(each.scatter);
      json["of"] = each.of + 1;
    }
    if (each.of < result.problem.cases.size() && result.problem.cases[each.of].response)
      json["response"] = place_of(scene, *result.problem.cases[each.of].response);
    json["weight"] = each.weight;
    json["amplitude"] = each.amplitude;
    add_place(json, scene, each.point);
    json["active"] = each.active;
    json["multiplier"] = each.multiplier;
  }
  return list;
}

Json certificate_of(const scene::Scene& scene, const OptimumProblem& problem, const Certificate& c,
                    bool has_cases) {
  Json json = {{"gradient", named(problem, c.gradient)},
               {"stationarity", c.stationarity},
               {"complementarity", c.complementarity}};
  if (!c.to_minimum.empty()) json["to_minimum"] = named(problem, c.to_minimum);
  if (c.curvature.size() > 0) {
    Json& rows = json["curvature"] = Json::array();
    for (Eigen::Index i = 0; i < c.curvature.rows(); ++i) {
      const Eigen::VectorXd row = c.curvature.row(i);
      rows.push_back(std::vector<double>(row.begin(), row.end()));
    }
  }
  Json& ranges = json["ranges"] = Json::object();
  for (std::size_t k = 0; k < c.ranges.size(); ++k)
    for (const ToleranceRange& range : c.ranges[k])
      ranges[problem.over[k].name].push_back({{"share", range.share},
                                              {"lower", range.lower},
                                              {"upper", range.upper},
                                              {"lower_is_bound", range.lower_is_bound},
                                              {"upper_is_bound", range.upper_is_bound},
                                              {"lower_is_limit", range.lower_is_limit},
                                              {"upper_is_limit", range.upper_is_limit}});
  Json& peaks = json["peaks"] = Json::array();
  for (const CertifiedPeak& peak : c.peaks)
    peaks.push_back({{"kind", name(peak.kind)},
                     {"frequency", output::in_scene_unit(scene, peak.omega)},
                     {"omega", peak.omega},
                     {"amplitude", peak.amplitude},
                     {"active", peak.active},
                     {"weight", peak.weight}});
  for (std::size_t i = 0; has_cases && i < peaks.size(); ++i) peaks[i]["case"] = c.peaks[i].in_case + 1;
  Json& limits = json["limits"] = Json::array();
  for (const ActiveLimit& limit : c.limits) {
    limits.push_back(
        {{"limit", limit.limit}, {"multiplier", limit.multiplier}, {"by_height", limit.by_height}});
    if (has_cases) limits.back()["case"] = limit.in_case + 1;
  }
  json["at_bound"] = Json::object();
  for (std::size_t k = 0; k < c.at_bound.size(); ++k)
    json["at_bound"][problem.over[k].name] = c.at_bound[k] < 0   ? "lower"
                                             : c.at_bound[k] > 0 ? "upper"
                                                                 : "inside";
  Json& others = json["others"] = Json::array();
  for (const OtherResponse& other : c.others)
    others.push_back({{"found_by", other.found_by},
                      {"frequency", output::in_scene_unit(scene, other.omega)},
                      {"amplitude", other.amplitude}});
  for (std::size_t i = 0; has_cases && i < others.size(); ++i) others[i]["case"] = c.others[i].in_case + 1;
  json["others_lower"] = c.others_lower;
  return json;
}

Json direct_of(const scene::Scene& scene, const OptimumResult& result) {
  const DirectOptimum& direct = result.direct;
  if (!direct.found) return {{"message", direct.message}};
  Json json = {{result.problem.over[0].name, direct.point.over}, {"amplitude", direct.point.amplitude}};
  add_place(json, scene, direct.point);
  json["difference"] = {{"design", result.difference_of_design()},
                        {"amplitude", result.difference_of_amplitude()}};
  return json;
}

Json json_of(const scene::Scene& scene, const OptimumResult& result) {
  const Optimum& found = result.optimum;
  Json json = Json::object();
  if (!result.study.empty()) json["study"] = result.study;
  if (!result.kind.empty()) json["kind"] = result.kind;
  json["status"] = observables::name(result.status);
  json["stop"] = output::detail::stop(result.stop);
  json["set"] = output::detail::named_values(result.set);
  json["optimum"] = optimum_of(scene, result);
  if (result.has_cases()) {
    json["criterion"] = scene::criterion_name(result.problem.criterion);
    json["cases"] = cases_of(scene, result);
  }
  if (!result.problem.scatter.empty()) json["scatter_rounds"] = found.scatter_rounds;
  json["algorithm"] = found.algorithm;
  json["epigraph"] = found.epigraph;
  json["evaluations"] = found.evaluations.size();
  json["responses"] = found.work.responses;
  json["followed"] = found.work.followed;
  json["factorizations"] = found.work.factorizations;
  json["seconds"] = found.seconds;
  json["notes"] = found.notes;
  if (found.certificate)
    json["certificate"] = certificate_of(scene, result.problem, *found.certificate, result.has_cases());
  if (result.direct.found || !result.direct.message.empty()) json["direct"] = direct_of(scene, result);
  Json& course = json["course"] = Json::array();
  for (const Evaluation& evaluation : found.evaluations) {
    course.push_back(named(result.problem, evaluation.design));
    course.back()["amplitude"] = evaluation.amplitude;
  }
  return json;
}

}  // namespace

output::JsonSection json_section(const scene::Scene& scene, std::span<const OptimumResult> results) {
  const bool single = results.size() == 1;
  return {"arcslip-optimum-1", single ? "optimum" : "optima", [&scene, results, single](std::ostream& out) {
            if (single) {
              const OptimumResult& only = results.front();
              out << text(optimum_of(scene, only)) << ",\n\"algorithm\": " << text(only.optimum.algorithm)
                  << ",\n\"evaluations\": " << only.optimum.evaluations.size()
                  << ",\n\"stop\": " << text(output::detail::stop(only.stop)) << ",\n\"optima\": ";
            }
            output::detail::write_list(out, results,
                                       [&](const OptimumResult& result) { return json_of(scene, result); });
          }};
}

void write_csv(std::ostream& out, const scene::Scene& scene, std::span<const OptimumResult> results) {
  using output::detail::csv_number;
  if (results.empty()) return;
  const auto of_another = [&](const OptimumResult& result) { return result.study != results.front().study; };
  const bool several_studies = std::any_of(results.begin(), results.end(), of_another);
  std::vector<std::string> names;
  for (const OptimumResult& result : results)
    for (const auto& [name, value] : result.set) output::detail::add_name(name, names);
  for (const OptimumResult& result : results)
    for (const DesignVariable& v : result.problem.over) output::detail::add_name(v.name, names);
  std::vector<std::string> titles(several_studies ? 1 : 0, "study");
  titles.insert(titles.end(), {"optimum", "what"});
  for (const std::string& name : names)
    titles.push_back(output::with_unit(name, output::parameter_unit(scene, name)));
  titles.insert(titles.end(),
                {"amplitude (m)", output::with_unit("frequency", scene::unit_name(scene.frequency_unit))});
  output::detail::write_csv_header(out, titles);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const OptimumResult& result = results[i];
    const auto row = [&](const std::string& what, std::span<const double> design, double amplitude,
                         const std::string& frequency) {
      std::vector<std::string> cells(several_studies ? 1 : 0, output::detail::csv_text(result.study));
      cells.insert(cells.end(), {std::to_string(i + 1), what});
      for (const std::string& name : names) {
        std::string& cell = cells.emplace_back();
        for (const auto& [key, value] : result.set)
          if (key == name) cell = csv_number(value);
        for (std::size_t k = 0; k < design.size(); ++k)
          if (result.problem.over[k].name == name) cell = csv_number(design[k]);
      }
      cells.insert(cells.end(), {std::isinf(amplitude) ? "inf" : csv_number(amplitude), frequency});
      output::detail::write_csv_row(out, cells);
    };
    for (const Evaluation& evaluation : result.optimum.evaluations)
      row("evaluation", evaluation.design, evaluation.amplitude, "");
    if (result.optimum.design.empty()) continue;
    for (std::size_t c = 0; result.has_cases() && c < result.optimum.cases.size(); ++c)
      row("case " + std::to_string(c + 1), result.optimum.design, result.optimum.cases[c].amplitude,
          csv_number(output::in_scene_unit(scene, result.optimum.cases[c].point.omega)));
    row("optimum", result.optimum.design, result.optimum.amplitude,
        csv_number(output::in_scene_unit(scene, result.optimum.point.omega)));
  }
}

}  // namespace arcslip::optimize
