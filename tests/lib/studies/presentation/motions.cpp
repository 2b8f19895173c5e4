#include "catch.hpp"
#include "lib/output/support.hpp"

#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/presentation/motions.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <sstream>

using namespace arcslip;
using Json = nlohmann::json;
using observables::Motion;

namespace {

scene::Scene made_up_scene() {
  scene::Scene scene = support::scene();
  scene.elements.push_back({"spring", &elements::cubic_spring(), scene.elements[0].directions, {1}});
  return scene;
}

/// Three instants of a slider.
Motion made_up_motion(double normal_load = 3) {
  Motion motion;
  motion.stop = {observables::reasons::periodic, 1e-12, 1e-9, "relative correction 1e-12"};
  motion.set = {{"damper.normal_load", normal_load}};
  motion.parameters = {{"m.value", 1.0}};
  motion.integrator = "event-driven";
  motion.omega = 10;
  motion.steps = 2;
  motion.periods = 9;
  motion.change = 1e-12;
  motion.amplitude = 0.2;
  motion.energy = {0.75, 0.5, 0.125, 0.0625};
  motion.elements = {{"damper", 60, 0.5}};
  motion.multipliers = {{0.5, 0.25}, {0.5, -0.25}, {0, 0}};
  motion.stable = true;
  motion.history.time = {0, 0.25, 0.5};
  motion.history.displacement = {0.2, -0.2, 0.2};
  motion.history.velocity = {0, 1.0 / 3, 0};
  motion.history.elements = {{"damper", {0.2, -0.2, 0.2}, {1.5, -1.5, 1.5}, {0.05, -0.05, 0.05}, {}},
                             {"spring", {1, 2, 3}, {4, 5, 6}, {}, {}}};
  return motion;
}

Json motions_json(const std::vector<Motion>& motions) {
  std::ostringstream text;
  results::write_json(text, studies::results_of(made_up_scene(), motions));
  return Json::parse(text.str());
}

std::vector<std::string> history_csv_lines(const std::vector<Motion>& motions) {
  std::ostringstream text;
  results::write_csv(text, studies::results_of(made_up_scene(), motions), "history");
  std::istringstream in(text.str());
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) {
    REQUIRE(line.ends_with('\r'));
    all.push_back(line.substr(0, line.size() - 1));
  }
  return all;
}

}  // namespace

TEST_CASE("a motion in JSON has its status, numbers, multipliers, elements and history") {
  const scene::Scene scene = made_up_scene();
  Motion named = made_up_motion();
  named.study = "loops";
  named.kind = "time";
  named.method = observables::TimeMethod::newmark_shooting;
  const Json json = motions_json({made_up_motion(5), named});
  CHECK(json["format"] == "arcslip-time-1");
  CHECK(json["scene_hash"] == scene::hash(scene));
  REQUIRE(json["motions"].size() == 2);
  CHECK_FALSE(json["motions"][0].contains("study"));
  CHECK(json["motions"][0]["set"] == Json{{"damper.normal_load", 5.0}});
  CHECK(json["motions"][0]["method"] == "shooting");
  const Json& m = json["motions"][1];
  CHECK(m["study"] == "loops");
  CHECK(m["kind"] == "time");
  CHECK(m["status"] == "complete");
  CHECK(m["stop"]["reason"] == "periodic");
  CHECK(m["parameters"] == Json{{"m.value", 1.0}});
  CHECK(m["method"] == "newmark-shooting");
  CHECK(m["integrator"] == "event-driven");
  CHECK(m["omega"] == 10.0);
  CHECK(m["frequency"].get<double>() == Approx(10 / (2 * 3.14159265358979)).epsilon(1e-14));
  CHECK(m["steps"] == 2);
  CHECK(m["periods"] == 9);
  CHECK(m["amplitude"] == 0.2);
  CHECK(m["energy_input"] == 0.75);
  CHECK(m["energy_stored"] == 0.0625);
  CHECK(m["energy_defect"] == 0.0625);
  CHECK(m["multipliers"] == Json{{0.5, 0.25}, {0.5, -0.25}, {0.0, 0.0}});
  CHECK(m["stable"] == true);
  CHECK(m["stick_percent"] == 60.0);
  CHECK(m["elements"] == Json{{"damper", {{"stick_percent", 60.0}, {"energy", 0.5}}}});
  const Json& history = m["history"];
  CHECK(history["time"] == Json{0.0, 0.25, 0.5});
  CHECK(history["velocity"][1].get<double>() == 1.0 / 3);
  CHECK(history["elements"]["damper"]["slider"] == Json{0.05, -0.05, 0.05});
  CHECK(history["elements"]["spring"] == Json{{"displacement", {1.0, 2.0, 3.0}}, {"force", {4.0, 5.0, 6.0}}});
}

TEST_CASE("a motion without multipliers is neither stable nor unstable, and what is not finite is null") {
  Motion failed;
  failed.status = observables::Status::failed;
  failed.amplitude = std::nan("");
  failed.history.time = {0};
  failed.history.displacement = {std::numeric_limits<double>::infinity()};
  const Json m = motions_json({failed})["motions"][0];
  CHECK(m["status"] == "failed");
  CHECK(m["multipliers"] == Json::array());
  CHECK_FALSE(m.contains("stable"));
  CHECK_FALSE(m.contains("stick_percent"));
  CHECK(m["amplitude"].is_null());
  CHECK(m["history"]["displacement"] == Json{nullptr});
  CHECK(m["history"]["velocity"] == Json::array());
  CHECK(m["history"]["elements"]["damper"]["force"] == Json::array());
}

TEST_CASE("CSV of motions has a row an instant, with units") {
  const auto all = history_csv_lines({made_up_motion(3), made_up_motion(0.5)});
  REQUIRE(all.size() == 7);
  CHECK(
      all[0] ==
      "study,damper.normal_load (N),motion,time (s),displacement (m),velocity (m/s),damper.displacement (m),"
      "damper.force (N),damper.slider (m),spring.displacement (m),spring.force (N)");
  CHECK(all[1] == ",3,1,0,0.2,0,0.2,1.5,0.05,1,4");
  CHECK(all[5] == ",0.5,2,0.25,-0.2,0.3333333333333333,-0.2,-1.5,-0.05,2,5");
  Motion other = made_up_motion();
  other.study = "b";
  CHECK(history_csv_lines({made_up_motion(), other})[4].find("b,3,2,0,") == 0);
}

TEST_CASE("figures of motions are the displacement, and the loop and the force of each friction element") {
  const scene::Scene scene = made_up_scene();
  const std::vector<Motion> motions{made_up_motion(1), made_up_motion(2)};
  const auto data = studies::figures_of(scene, motions);
  REQUIRE(data.lines.size() == 2);
  CHECK(data.lines[1].label == "2 N");
  CHECK(data.columns[2].range.upper == 0.2);
  CHECK(data.columns[3].range.lower == -1.5);
  const auto figures = data.figures;
  REQUIRE(figures.size() == 3);
  CHECK(figures[0].name == "displacement");
  CHECK(results::x_words(data, figures[0]) == "time");
  CHECK(figures[1].name == "hysteresis");
  CHECK(results::x_words(data, figures[1]) == "damper displacement");
  CHECK(data.columns[2].unit == "m");
  CHECK(results::y_words(data, figures[1]) == "damper force");
  CHECK(data.columns[3].unit == "N");
  CHECK(figures[2].name == "force");
  CHECK(figures[2].x == 0);
  CHECK(figures[2].y == 3);

  Motion two = made_up_motion();
  two.history.elements.push_back(two.history.elements.front());
  two.history.elements.back().name = "b/c";
  scene::Scene of_two = scene;
  of_two.elements.push_back(of_two.elements.front());
  of_two.elements.back().name = "b/c";
  const auto more = output::figure_files(studies::figures_of(of_two, std::vector{two}), "t", {{"svg"}, {}});
  CHECK(std::count(more.begin(), more.end(), "t_hysteresis_2_b_c.svg") == 1);
}

TEST_CASE("histories of more than 20 000 instants are thinned in figures, and keep their end") {
  Motion longer = made_up_motion();
  longer.history = {};
  for (int i = 0; i <= 100'000; ++i) {
    longer.history.time.push_back(i);
    longer.history.displacement.push_back(-i);
    longer.history.velocity.push_back(0);
  }
  const auto data = studies::figures_of(made_up_scene(), std::vector{longer});
  const auto& part = data.lines.at(0).parts.at(0);
  CHECK(part.size() <= 20'001);
  CHECK(part.size() > 15'000);
  CHECK(part.back()[0] == 100'000);
}

TEST_CASE("the figures of motions are drawn") {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
    WARN("gnuplot is not there");
    return;
  }
  const support::TemporaryFolder folder;
  const auto figures = output::draw_figures(
      studies::figures_of(made_up_scene(), std::vector{made_up_motion()}), folder.path(), "time");
  CHECK(figures.problem.empty());
  CHECK(figures.images.size() == 6);
  CHECK(support::content(folder / "time.dat").find("# displacement: displacement (") == 0);
  const auto none = output::draw_figures(studies::figures_of(made_up_scene(), std::vector<Motion>{}),
                                         folder.path(), "none");
  CHECK(none.problem == "no figure was drawn: there are no points");
}
