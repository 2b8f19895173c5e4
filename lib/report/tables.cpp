#include <arcslip/report/parts.hpp>

#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/sampling/distribution.hpp>
#include <arcslip/scene/combinations.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace arcslip::report {
namespace {

constexpr std::size_t most_parameters = 500;

void write_titles(Html& html, const std::vector<std::string>& titles) {
  html.open("thead").open("tr");
  for (const std::string& title : titles) html.element("th", title, {{"scope", "col"}});
  html.close().close();
}

/// Which studies go over a parameter: "12 values from 0.01 to 500 in the study "frf"".
std::map<std::string, std::string> varied(const scene::Scene& scene) {
  std::map<std::string, std::string> all;
  for (const scene::Study& study : scene.studies)
    for (const auto& [name, values] : study.for_each) {
      if (values.empty()) continue;
      const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
      std::string& text = all[name];
      text += (text.empty() ? "" : "; ") + std::to_string(values.size()) + " values from " +
              results::shortest(*lowest) + " to " + results::shortest(*highest) + " in the study \"" +
              study.name + "\"";
    }
  for (const scene::Study& study : scene.studies)
    for (const auto& [name, distribution] : study.samples.parameters) {
      const sampling::DistributionDescription& of = sampling::description(distribution.type);
      std::string& text = all[name];
      text += (text.empty() ? "" : "; ") + std::to_string(study.samples.count) + " samples, " +
              std::string(of.name);
      for (std::size_t i = 0; i < of.values.size(); ++i)
        text.append(i == 0 ? " of " : ", ")
            .append(of.values[i])
            .append(" ")
            .append(results::shortest(distribution.values[i]));
      text += ", in the study \"" + study.name + "\"";
    }
  return all;
}

/// The forces of elements that are given by formulas.
void write_formulas(Html& html, const scene::Scene& scene) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const scene::Part& element : scene::all_elements(scene)) {
    const std::vector<std::string> formulas = element.type->formulas(element.options);
    const auto names = element.type->slots_with(element.options);
    for (std::size_t i = 0; i < formulas.size(); ++i)
      all.emplace_back(
          element.name + (formulas.size() > 1 && i < names.size() ? "." + std::string(names[i]) : ""),
          formulas[i]);
  }
  if (all.empty()) return;
  html.open("table", {{"class", "formulas"}});
  write_titles(html, {"element", "force"});
  html.open("tbody");
  for (const auto& [name, formula] : all) {
    html.open("tr").element("th", name, {{"scope", "row"}});
    html.open("td").element("code", formula).close().close();
  }
  html.close().close();
}

}  // namespace

void write_parameters(Html& html, const Contents& contents) {
  const scene::Scene& scene = contents.scene;
  const std::vector<std::string> names = scene::parameter_names(scene);
  const std::map<std::string, std::string> over = varied(scene);
  html.open("details", {{"open", ""}, {"class", "parameters"}}).element("summary", "Parameters");
  html.open("div", {{"class", "wide"}}).open("table", {{"class", "sortable"}});
  std::vector<std::string> titles{"parameter", "value", "unit", "what it is"};
  const bool any_formula = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return scene::parameter_formula(scene, name) != nullptr;
  });
  if (any_formula) titles.emplace_back("given by");
  if (!over.empty()) titles.emplace_back("varied");
  write_titles(html, titles);
  html.open("tbody");
  for (std::size_t i = 0; i < std::min(names.size(), most_parameters); ++i) {
    const scene::Field field = scene::parameter_field(scene, names[i]);
    const auto values = over.find(names[i]);
    html.open("tr").element("th", names[i], {{"scope", "row"}});
    html.element("td", plain_number(scene::value(scene, names[i])), {{"class", "number"}});
    html.element("td", field.unit.empty() ? "-" : field.unit).element("td", field.help);
    if (any_formula) {
      const scene::NumberText* formula = scene::parameter_formula(scene, names[i]);
      html.element("td", formula != nullptr ? formula->text : "");
    }
    if (!over.empty()) html.element("td", values == over.end() ? "" : values->second);
    html.close();
  }
  html.close().close().close();
  write_formulas(html, scene);
  if (names.size() > most_parameters)
    html.element("p", "The scene has " + std::to_string(names.size()) + " parameters, of which the first " +
                          std::to_string(most_parameters) + " stand here; arcslip check prints all.");
  html.close();
}

void write_results(Html& html, const StudyContents& study, const std::string& row_id) {
  if (study.rows.empty()) return;
  std::vector<std::vector<results::ShownCell>> cells;
  for (const TableRow& row : study.rows) cells.push_back(row.cells);
  const std::vector<std::vector<std::string>> texts = results::text_rows(study.schema, cells);
  html.open("div", {{"class", "wide"}}).open("table", {{"class", "sortable results"}});
  write_titles(html, texts.front());
  html.open("tbody");
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    html.open("tr", {{"id", row_id + "-" + std::to_string(i)}});
    for (const std::string& cell : texts[i + 1]) {
      const bool is_kind = !study.rows[i].kind.empty() && cell == study.rows[i].kind;
      html.element("td", is_kind ? observables::event_kinds::words_of(cell) : cell);
    }
    html.close();
  }
  html.close().close().close();
  if (study.left_out > 0)
    html.element("p", "The page shows the first " + std::to_string(study.results - study.left_out) + " of " +
                          std::to_string(study.results) + " results; the files have them all.");
}

}  // namespace arcslip::report
