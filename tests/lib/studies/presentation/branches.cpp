#include "catch.hpp"
#include "lib/output/support.hpp"

#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/table_writer.hpp>
#include <arcslip/results/version.hpp>
#include <arcslip/studies/presentation/branches.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

using namespace arcslip;
using Json = nlohmann::json;

namespace {

Json branches_json(const scene::Scene& scene, const std::vector<observables::ResponseBranch>& branches,
                   const studies::RunOptions& options = {}) {
  std::ostringstream text;
  results::write_json(text, studies::results_of(scene, branches, options));
  return Json::parse(text.str());
}

std::vector<std::string> branch_csv_lines(const scene::Scene& scene,
                                          const std::vector<observables::ResponseBranch>& branches,
                                          const std::string& table = "points") {
  std::stringstream text;
  results::write_csv(text, studies::results_of(scene, branches), table);
  std::vector<std::string> all;
  for (std::string line; std::getline(text, line);) {
    REQUIRE(line.ends_with('\r'));
    all.push_back(line.substr(0, line.size() - 1));
  }
  return all;
}

scene::Scene with_element(const std::string& name, const scene::PartType& type) {
  scene::Scene scene = support::scene();
  scene.elements.push_back(scene.elements.front());
  scene.elements.back().name = name;
  scene.elements.back().type = &type;
  scene.elements.back().values.resize(type.fields({}).size());
  return scene;
}

}  // namespace

TEST_CASE("JSON carries the format, the program, the scene and its hash") {
  const scene::Scene scene = support::scene("A \"title\"\nin two lines");
  const Json json = branches_json(scene, {});
  CHECK(json["format"] == "arcslip-branches-1");
  CHECK(json["program"] == "arcslip " + std::string(results::version()));
  CHECK(json["scene_hash"] == scene::hash(scene));
  CHECK(json["title"] == "A \"title\"\nin two lines");
  CHECK(json["frequency_unit"] == "Hz");
  CHECK(json["branches"] == Json::array());
}

TEST_CASE("a branch in JSON has its status, stop, parameters, points, events and solver") {
  const Json json = branches_json(support::scene(), {support::branch(3), support::branch(5)});
  REQUIRE(json["branches"].size() == 2);
  const Json& branch = json["branches"][1];
  CHECK(branch["status"] == "complete");
  CHECK(branch["stop"] == Json{{"reason", "boundary"},
                               {"value", 2.0},
                               {"limit", 2.0},
                               {"message", "reached the end of the window at 2 Hz"}});
  CHECK(branch["set"] == Json{{"damper.normal_load", 5.0}});
  CHECK(branch["parameters"] == Json{{"m.value", 1.0}, {"k.value", 100.0}});
  CHECK(branch["solver"]["linear_solver"] == "dense LU");
  CHECK(branch["solver"]["factorizations"] == 9);
  CHECK_FALSE(branch.contains("harmonics"));
  REQUIRE(branch["points"].size() == 5);
  const Json& point = branch["points"][0];
  CHECK(point["frequency"].get<double>() == Approx(1).epsilon(1e-15));
  CHECK(point["omega"].get<double>() == support::point(1, 1).omega);
  CHECK(point["amplitude"] == 0.01);
  CHECK(point["stick_percent"] == 100.0);
  CHECK(point["elements"]["damper"] == Json{{"stick_percent", 100.0},
                                            {"slip_angles", {1.5, 4.5}},
                                            {"reversal_angles", {0.5, 3.5}},
                                            {"energy", 0.25},
                                            {"theta_0", 0.5},
                                            {"theta_star", 1.5},
                                            {"in_phase", 1.0},
                                            {"out_of_phase", 0.6},
                                            {"equivalent_stiffness", 10.0},
                                            {"equivalent_damping", 0.75}});
  CHECK(point["energy_total"] == 0.375);
  CHECK(point["energy_input"] == 0.375);
  CHECK(point["friction_percent"].get<double>() == Approx(200.0 / 3).epsilon(1e-15));
  CHECK(point["force_per_displacement"] ==
        Json{{"in_phase",
              {{"total", 0.0}, {"inertia", -40.0}, {"spring", 30.0}, {"contact", 10.0}, {"excitation", 0.5}}},
             {"out_of_phase", {{"total", 8.0}, {"viscous", 2.0}, {"contact", 6.0}, {"excitation", 8.0}}}});
  CHECK_FALSE(point.contains("maxima"));
  CHECK_FALSE(point["elements"]["damper"].contains("maxima"));
  CHECK_FALSE(point.contains("coefficients"));
  REQUIRE(branch["events"].size() == 1);
  CHECK(branch["events"][0]["kind"] == "peak");
  CHECK(branch["events"][0]["amplitude"] == 0.1);
}

TEST_CASE(
    "each point and event in JSON holds the value of the parameter that its branch is over, by its name") {
  const Json json = branches_json(support::scene(), {support::peaks(), support::branch()});
  const Json& peaks = json["branches"][0];
  CHECK(peaks["over"] == "damper.normal_load");
  CHECK(peaks["points"][1]["damper.normal_load"] == 1.0);
  CHECK(peaks["points"][1]["frequency"].get<double>() == Approx(1.51).epsilon(1e-15));
  CHECK(peaks["events"][0]["kind"] == "minimum");
  CHECK(peaks["events"][0]["damper.normal_load"] == 4.0);
  const Json& response = json["branches"][1];
  CHECK_FALSE(response.contains("over"));
  CHECK_FALSE(response["points"][0].contains("damper.normal_load"));
}

TEST_CASE("a branch in JSON reports its study, where it knows it") {
  auto branch = support::branch();
  CHECK_FALSE(branches_json(support::scene(), {branch})["branches"][0].contains("study"));
  branch.study = "a \"study\"";
  branch.kind = "frf";
  const Json json = branches_json(support::scene(), {branch})["branches"][0];
  CHECK(json["study"] == "a \"study\"");
  CHECK(json["kind"] == "frf");
}

TEST_CASE("the status of a branch is written by its name") {
  auto branch = support::branch();
  branch.status = observables::Status::stopped;
  CHECK(branches_json(support::scene(), {branch})["branches"][0]["status"] == "stopped");
  branch.status = observables::Status::failed;
  CHECK(branches_json(support::scene(), {branch})["branches"][0]["status"] == "failed");
}

TEST_CASE("numbers in JSON read back exactly") {
  auto branch = support::branch();
  const std::vector<double> numbers{0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, 8.84970005351e-4, -0.0};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    branch.points.resize(numbers.size(), support::point(1, 1));
    branch.points[i].amplitude = numbers[i];
  }
  const Json json = branches_json(support::scene(), {branch});
  for (std::size_t i = 0; i < numbers.size(); ++i)
    CHECK(json["branches"][0]["points"][i]["amplitude"].get<double>() == numbers[i]);
}

TEST_CASE("coefficients come with their harmonics when they are asked for") {
  const Json json = branches_json(support::scene(), {support::branch()}, {.coefficients = true});
  CHECK(json["branches"][0]["harmonics"] == Json{1, 3});
  CHECK(json["branches"][0]["points"][1]["coefficients"] == Json{0.05, 0.0, 0.0, -0.05});
}

TEST_CASE("maxima over the period are written where there are any") {
  auto branch = support::branch();
  auto& event = branch.events[0].point;
  event.maxima = {1.5, 20, {}};
  event.maxima.force_per_displacement = {3, 4};
  event.elements[0].maxima = {1, 0.5, 0.75};
  const Json json = branches_json(support::scene(), {branch})["branches"][0]["events"][0];
  CHECK(json["maxima"] ==
        Json{{"velocity", 1.5}, {"acceleration", 20.0}, {"in_phase", 3.0}, {"out_of_phase", 4.0}});
  CHECK(json["elements"]["damper"]["maxima"] == Json{{"force", 1.0}, {"cosine", 0.5}, {"sine", 0.75}});
}

TEST_CASE("with a nonlinear spring its part of the forces is written, and no angles of contact for it") {
  auto branch = support::branch();
  branch.points[0].elements.push_back({"spring", false, 0, {}, {}, 0, {}});
  branch.points[0].forces.nonlinear_spring = {7, 0};
  const Json json =
      branches_json(with_element("spring", elements::cubic_spring()), {branch})["branches"][0]["points"][0];
  CHECK(json["force_per_displacement"]["in_phase"]["nonlinear_spring"] == 7.0);
  CHECK(json["elements"]["spring"]["equivalent_stiffness"].is_null());
  CHECK_FALSE(json["elements"]["spring"].contains("theta_0"));
}

TEST_CASE("an unbounded amplitude is null and said to be unbounded") {
  auto branch = support::branch();
  branch.events[0].point.unbounded = true;
  const Json event = branches_json(support::scene(), {branch})["branches"][0]["events"][0];
  CHECK(event["amplitude"].is_null());
  CHECK(event["phase"].is_null());
  CHECK(event["unbounded"] == true);
  CHECK(event["frequency"].get<double>() == Approx(1.5));
}

TEST_CASE("what is not finite never reaches JSON") {
  auto branch = support::branch();
  for (double& value : branch.points[0].coefficients) value = std::numeric_limits<double>::infinity();
  branch.points[0].amplitude = std::nan("");
  branch.points[0].elements[0].slip_angles = {-std::numeric_limits<double>::infinity()};
  branch.stop.limit = std::numeric_limits<double>::infinity();
  const Json json = branches_json(support::scene(), {branch}, {.coefficients = true});
  CHECK(json["branches"][0]["points"][0]["amplitude"].is_null());
  CHECK(json["branches"][0]["points"][0]["elements"]["damper"]["slip_angles"][0].is_null());
  CHECK(json["branches"][0]["stop"]["limit"].is_null());
}

TEST_CASE("stick_percent stands at the top of a point only with exactly one friction element") {
  auto branch = support::branch();
  branch.points[0].elements.push_back({"spring", false, 0, {}, {}, 0, {}});
  branch.points[2].elements.clear();
  const Json points =
      branches_json(with_element("spring", elements::cubic_spring()), {branch})["branches"][0]["points"];
  CHECK(points[0].contains("stick_percent"));
  CHECK_FALSE(points[0]["elements"]["spring"].contains("stick_percent"));
  CHECK_FALSE(points[2].contains("stick_percent"));
  CHECK(points[2]["elements"] == Json::object());
  branch.points[1].elements.push_back({"second", true, 10, {}, {}, 0, {}});
  const Json two =
      branches_json(with_element("second", elements::jenkins()), {branch})["branches"][0]["points"][1];
  CHECK_FALSE(two.contains("stick_percent"));
  CHECK(two["elements"]["second"]["stick_percent"] == 10.0);
}

TEST_CASE("an event says after which point of its branch it comes") {
  auto branch = support::branch();
  branch.events[0].after = 2;
  CHECK(branches_json(support::scene(), {branch})["branches"][0]["events"][0]["after"] == 2);
}

TEST_CASE(
    "a branch as CSV has a row for each point with its quantities and their units, and one for each event") {
  const auto points = branch_csv_lines(support::scene(), {support::branch(3), support::branch(0.5)});
  REQUIRE(points.size() == 1 + 2 * 5);
  CHECK(points[0].starts_with(
      "study,damper.normal_load (N),branch,omega (rad/s),frequency (Hz),amplitude (m),unbounded,"
      "phase (rad),truncation_estimate (m),truncation_flagged,energy_friction (J),"));
  CHECK(
      points[0].ends_with(",damper.in_phase (N),damper.out_of_phase (N),damper.equivalent_stiffness (N/m),"
                          "damper.equivalent_damping (N s/m)"));
  CHECK(points[1].starts_with(",3,1,6.283185307179586,1,0.01,,0.5,1e-09,false,0.25,0.125,0.375,"));
  CHECK(points[1].ends_with(",1,0.6,10,0.75"));
  CHECK(points[6].starts_with(",0.5,2,6.283185307179586,"));
  const auto events = branch_csv_lines(support::scene(), {support::branch(3)}, "events");
  REQUIRE(events.size() == 2);
  CHECK(events[0].starts_with(
      "study,damper.normal_load (N),branch,kind,nonsmooth,located,after,omega (rad/s),"));
  CHECK(events[1].starts_with(",3,1,peak,false,true,0,"));
  CHECK(branch_csv_lines(support::scene(), {}).size() == 1);
}

TEST_CASE("the parameter that a branch is over is the first column of its table, with its unit") {
  auto branch = support::peaks();
  branch.set = {{"c.value", 0.5}};
  const auto points = branch_csv_lines(support::scene(), {branch});
  CHECK(points.at(0).starts_with("study,c.value (N s/m),branch,damper.normal_load (N),omega (rad/s),"));
  CHECK(points.at(2).starts_with(",0.5,1,1,"));
}

TEST_CASE("a response over the frequency and one over a parameter share that parameter's column") {
  auto second = support::peaks();
  second.study = "the peaks";
  const auto points = branch_csv_lines(support::scene(), {support::branch(3), second});
  CHECK(points.at(0).find("damper.normal_load (N)") == points.at(0).rfind("damper.normal_load (N)"));
  CHECK(points.at(0).ends_with(",damper.normal_load (N)"));
  CHECK(points.at(1).ends_with(",3"));
  CHECK(points.at(6).starts_with("the peaks,2,9."));
  CHECK(points.at(6).ends_with(",0.1"));
}

TEST_CASE("an unbounded peak in CSV has its frequency, and says so") {
  auto branch = support::branch();
  branch.events[0].point.unbounded = true;
  branch.events[0].point.elements.clear();
  const std::string row = branch_csv_lines(support::scene(), {branch}, "events").at(1);
  CHECK(row.starts_with(",3,1,peak,false,true,0,9."));
  CHECK(row.find(",1.5,,true,,,") != std::string::npos);
}

TEST_CASE("names with commas and quotes are quoted in CSV") {
  auto scene = support::scene();
  scene.elements[0].name = "a \"b\", c";
  auto branch = support::branch();
  branch.set = {{"a \"b\", c.normal_load", 3}};
  CHECK(branch_csv_lines(scene, {branch})[0].starts_with("study,\"a \"\"b\"\", c.normal_load (N)\",branch,"));
}

namespace {

/// A branch over the frequency with a multiplier outside at some points, and limits of stability after them.
observables::ResponseBranch with_limits(const std::vector<int>& unstable,
                                        const std::vector<std::pair<double, std::size_t>>& limits) {
  observables::ResponseBranch branch;
  for (const int count : unstable) {
    observables::ResponsePoint& point = branch.points.emplace_back();
    point.omega = static_cast<double>(branch.points.size());
    point.amplitude = 1;
    point.stability.emplace().unstable = count;
  }
  for (const auto& [omega, after] : limits) {
    observables::ResponseEvent event{"fold", false, true, branch.points.front(), after};
    event.point.omega = omega;
    event.point.stability->unstable = 0;  // next to the one that makes it a limit
    branch.events.push_back(std::move(event));
  }
  return branch;
}

}  // namespace

TEST_CASE(
    "unstable parts of a branch lie between its limits of stability, also where no point is between two") {
  scene::Scene s = support::scene();
  s.frequency_unit = scene::FrequencyUnit::radian_per_second;
  const auto text = [&](const observables::ResponseBranch& branch) {
    return studies::unstable_ranges(s, branch);
  };
  CHECK(text(with_limits({0, 0, 0}, {})).empty());
  CHECK(text(with_limits({0, 1, 1, 0}, {})) == "unstable from 2 to 3 rad/s");
  CHECK(text(with_limits({0, 1, 1, 0}, {{1.5, 0}, {3.5, 2}})) == "unstable from 1.5 to 3.5 rad/s");
  CHECK(text(with_limits({1, 1}, {{1.25, 0}, {1.5, 0}})) == "unstable from 1 to 1.25, from 1.5 to 2 rad/s");
  CHECK(text(with_limits({0, 0}, {{1.25, 0}, {1.5, 0}})) == "unstable from 1.25 to 1.5 rad/s");
  CHECK(text(with_limits({1, 1, 0}, {{1.25, 0}, {1.5, 0}, {2.5, 1}})) ==
        "unstable from 1 to 1.25, from 1.5 to 2.5 rad/s");
  // Where multipliers jump next to a limit, the points decide.
  CHECK(text(with_limits({0, 0, 1}, {{1.5, 0}})) == "unstable from 3 to 3 rad/s");
  CHECK(text(with_limits({1, 1, 0}, {{1.5, 0}})) == "unstable from 1 to 2 rad/s");
  // A branch that turns back: frequencies need not rise.
  CHECK(text(with_limits({0, 1, 1}, {{1.5, 0}})) == "unstable from 1.5 to 3 rad/s");
}

TEST_CASE("a limit of stability is no stable motion in the table, and other motions keep their word") {
  const scene::Scene s = support::scene();
  observables::ResponseBranch branch = with_limits({0, 1, 1, 0}, {{1.5, 0}, {3.5, 2}});
  branch.events.push_back(branch.events.front());
  branch.events.back().kind = "peak";
  branch.events.push_back(branch.events.front());
  branch.events.back().point.stability->unstable = 1;  // another one is outside
  std::ostringstream table;
  results::write_table(table, studies::results_of(s, {&branch, 1}));
  std::istringstream lines(table.str());
  std::vector<std::string> words;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row{std::istream_iterator<std::string>(cells), {}};
    words.push_back(row[row.size() - 2]);
  }
  CHECK(words == std::vector<std::string>{"stable", "limit", "limit", "yes", "no"});
}
