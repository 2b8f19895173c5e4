#pragma once
// The page of all studies of a scene.

#include "lib/report/markup.hpp"

#include <arcslip/report/report.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace report_test {

using namespace arcslip;

inline scene::Scene scene_of(const std::string& json) {
  std::istringstream text(json);
  return scene::read(text, studies::catalogue());
}

inline std::string page_of(const scene::Scene& scene) {
  studies::RunOptions options;
  options.figures = true;
  report::Report report(scene, scene.studies);
  std::vector<results::Schema> schemas;
  for (const scene::Study& study : scene.studies)
    schemas.push_back(studies::kind_of(*study.type).schema(scene, study, options));
  report.begin(studies::header(scene), schemas);
  for (std::size_t i = 0; i < scene.studies.size(); ++i) {
    const scene::Study& study = scene.studies[i];
    report.add_figures(i, studies::kind_of(*study.type).run(scene, study, options, i, report));
  }
  report.finish();
  std::ostringstream page;
  report.write(page);
  return page.str();
}

/// Two masses with a damper and a cubic spring: the scene with these names, each as JSON has it.
inline std::string two_masses(const std::string& title, const std::string& first, const std::string& second,
                              const std::string& study = R"("t")") {
  std::string text = R"({"format": "arcslip-scene-1", "title": TITLE, "structure": {"dofs": [FIRST, SECOND],
    "masses": [{"name": "m1", "at": FIRST, "value": 1}, {"name": SECOND, "at": SECOND, "value": 2}],
    "springs": [{"name": "k1", "at": FIRST, "value": 4000},
                {"name": "k2", "between": [SECOND, FIRST], "value": 3000}],
    "dampers": [{"name": "c", "at": FIRST, "value": 1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": SECOND, "stiffness": 1000,
                  "friction_coefficient": 0.5, "normal_load": 3},
                 {"name": "h", "type": "cubic_spring", "at": SECOND, "stiffness": 1000}],
    "excitation": [{"name": "f", "at": SECOND, "cosine": 5}], "harmonics": {"order": 3},
    "response": {"at": SECOND},
    "studies": [{"name": STUDY, "kind": "frf", "from": 4, "to": 9, "for_each": {"d.normal_load": [1, 3]}}]})";
  for (const auto& [place, name] :
       {std::pair{"TITLE", title}, {"FIRST", first}, {"SECOND", second}, {"STUDY", study}})
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + name.size()))
      text.replace(at, std::string_view(place).size(), name);
  return text;
}

}  // namespace report_test
