#include <arcslip/optimize/optimum_output.hpp>

#include <arcslip/output/csv_text.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace arcslip::optimize {
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
