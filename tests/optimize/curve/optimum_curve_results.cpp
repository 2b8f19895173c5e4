// Curves of optima in JSON, CSV and figures.

#include "catch.hpp"
#include "contains.hpp"

#include "optimize/curve/optimum_curves.hpp"

#include <arcslip/optimize/study/optimum_results.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace optimum_curves {

TEST_CASE("result files tell every point of the curve and every event") {
  const scene::Scene s = levels();
  OptimumCurveResult result;
  result.study = "levels";
  result.problem = {{{"damper.normal_load", 5, 10}}, 15, 60};
  result.curve = optimum_curve(s, result.problem, {"force.cosine", 1, 8});
  const std::vector<OptimumCurveResult> results = {result};
  std::ostringstream text;
  const results::Results all =
      studies::collected<OptimumCurveResult>(s, described_curves(s, result.problem, "force.cosine"), results);
  results::write_json(text, all);
  const auto document = nlohmann::json::parse(text.str());
  CHECK(document["format"] == "arcslip-optimum-curves-1");
  const auto& curve = document["optimum_curves"][0];
  CHECK(curve["along"] == "force.cosine");
  CHECK(curve["status"] == "complete");
  REQUIRE(curve["points"].size() == result.curve.points.size());
  const OptimumPoint& last = result.curve.points.back();
  CHECK(curve["points"].back()["force.cosine"] == last.along);
  CHECK(curve["points"].back()["damper.normal_load"] == last.design[0]);
  CHECK(curve["points"].back()["amplitude"] == last.amplitude);
  CHECK(curve["points"].back()["at_bound"]["damper.normal_load"] == "upper");
  CHECK(curve["points"].back()["peaks"][0]["weight"] == 1);
  REQUIRE(curve["events"].size() == 2);
  CHECK(curve["events"][0]["kind"] == "bound_left");
  CHECK(curve["events"][0]["parameter"] == "damper.normal_load");
  CHECK(curve["events"][0]["point"]["at_bound"]["damper.normal_load"] == "lower");

  std::ostringstream csv;
  results::write_csv(csv, all, "points");
  std::istringstream lines(csv.str());
  std::string line;
  std::vector<std::string> rows;
  while (std::getline(lines, line)) rows.push_back(line);
  CHECK(rows.size() == 1 + result.curve.points.size());
  CHECK(rows[0].starts_with("study,curve,force.cosine (N),damper.normal_load (N),amplitude (m),peaks,"));
  CHECK(rows[1].starts_with("levels,1,1,5,"));
  std::ostringstream events;
  results::write_csv(events, all, "events");
  CHECK(contains(events.str(), "\r\nlevels,1,bound_left,damper.normal_load,"));

  const auto folder =
      std::filesystem::temp_directory_path() / ("arcslip_optimum_curve_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto figures = output::draw_figures(figures_of(s, results), folder.string(), "best");
  std::ifstream script(folder / "best.gp");
  const std::string commands{std::istreambuf_iterator<char>(script), {}};
  for (const char* figure :
       {"best_damper.normal_load.svg", "best_amplitude.svg", "best_stick.svg", "best_contact.svg"})
    CHECK(contains(commands, figure));
  CHECK((figures.images.size() == 8 || !figures.problem.empty()));
  std::filesystem::remove_all(folder);
}

}  // namespace optimum_curves
