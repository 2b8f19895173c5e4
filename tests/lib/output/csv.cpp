#include "catch.hpp"
#include "lib/output/support.hpp"

#include <arcslip/output/csv.hpp>
#include <arcslip/output/event_places.hpp>

#include <sstream>

using namespace arcslip;

namespace {

std::vector<std::string> lines(const scene::Scene& scene,
                               const std::vector<observables::ResponseBranch>& branches) {
  std::ostringstream text;
  output::write_csv(text, scene, branches);
  std::istringstream in(text.str());
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) {
    REQUIRE(!line.empty());
    REQUIRE(line.back() == '\r');  // RFC 4180
    line.pop_back();
    all.push_back(line);
  }
  return all;
}

}  // namespace

TEST_CASE("the header of CSV carries units") {
  CHECK(lines(support::scene(), {support::branch()}).at(0) ==
        "damper.normal_load (N),branch,event,frequency (Hz),amplitude (m),phase (rad),stick (%),"
        "truncation_estimate (m),truncation_flagged,energy_friction (J),energy_viscous (J),"
        "energy_total (J),energy_input (J),friction (%),force_in_phase (N/m),force_out_of_phase (N/m),"
        "theta_0 (rad),theta_star (rad),equivalent_stiffness (N/m),equivalent_damping (N s/m)");
}

TEST_CASE("CSV has a row a point, with the events in order") {
  const auto rows = lines(support::scene(), {support::branch(3), support::branch(0.5)});
  REQUIRE(rows.size() == 1 + 2 * 6);
  const std::string more = ",0.375,0.375,66.66666666666667,0,8,0.5,1.5,10,0.75";
  CHECK(rows[1] == "3,1,,1,0.01,0.5,100,1e-09,no,0.25,0.125" + more);
  CHECK(rows[3] == "3,1,peak,1.5,0.1,0.5,40,1e-09,no,0.25,0.125" + more);
  CHECK(rows[9] == "0.5,2,peak,1.5,0.1,0.5,40,1e-09,no,0.25,0.125" + more);
}

TEST_CASE("the parameter that a branch is over has a column with its unit, after those that are set") {
  auto branch = support::peaks();
  branch.set = {{"c.value", 0.5}};
  const auto rows = lines(support::scene(), {branch});
  CHECK(rows.at(0).find("c.value (N s/m),damper.normal_load (N),branch,event,frequency (Hz),") == 0);
  REQUIRE(rows.size() == 1 + 5);
  CHECK(rows[2].find("0.5,1,1,,1.51,0.04,") == 0);
  CHECK(rows[3].find("0.5,4,1,minimum,1.57,0.01,") == 0);
  CHECK(rows[4].find("0.5,10,1,,1.62,0.05,") == 0);
}

TEST_CASE("a response over the frequency and one over a parameter share that parameter's column") {
  const auto rows = lines(support::scene(), {support::branch(3), support::peaks()});
  CHECK(rows.at(0).find("damper.normal_load (N),branch,") == 0);
  CHECK(rows[1].find("3,1,,1,") == 0);
  CHECK(rows[7].find("0.1,2,,1.5,") == 0);
}

TEST_CASE("CSV tells the study of each row where branches are of several") {
  auto first = support::branch(3);
  auto second = support::peaks();
  first.study = "frf";
  CHECK(lines(support::scene(), {first, first}).at(0).find("damper.normal_load (N),") == 0);
  second.study = "the peaks";
  const auto rows = lines(support::scene(), {first, second});
  CHECK(rows.at(0).find("study,damper.normal_load (N),branch,") == 0);
  CHECK(rows[1].find("frf,3,1,,1,") == 0);
  CHECK(rows[7].find("the peaks,0.1,2,,1.5,") == 0);
}

TEST_CASE("an event at a fixed frequency and amplitude stands where its parameter lies") {
  auto branch = support::peaks();
  for (auto& point : branch.points) {
    point.omega = 10;
    point.amplitude = 1;
  }
  branch.events[0].point.omega = 10;
  branch.events[0].point.amplitude = 1;
  CHECK(output::points_before_events(branch) == std::vector<std::size_t>{2});
  branch.events[0].point.over = 20;
  CHECK(output::points_before_events(branch) == std::vector<std::size_t>{3});
}

TEST_CASE("an unbounded peak in CSV has its frequency, inf, and nothing else") {
  auto branch = support::branch();
  branch.events[0].point.unbounded = true;
  branch.events[0].point.elements.clear();
  branch.points.resize(2);
  CHECK(lines(support::scene(), {branch}).back() == "3,1,peak,1.5,inf" + std::string(15, ','));
}

TEST_CASE("several friction elements have a column each") {
  auto branch = support::branch();
  branch.events.clear();
  for (auto& point : branch.points) {
    point.elements.push_back({"tip", true, 12.5, {}, {}, 0});
  }
  const auto rows = lines(support::scene(), {branch});
  CHECK(rows[0].find(",damper.stick (%),tip.stick (%),") != std::string::npos);
  CHECK(rows[0].find(",damper.theta_0 (rad),") < rows[0].find(",tip.equivalent_damping (N s/m)"));
  CHECK(rows[1].find(",10,0.75,,,,") != std::string::npos);  // of the tip nothing is known
  CHECK(rows[1].find(",100,12.5,") != std::string::npos);
}

TEST_CASE("names with commas and quotes are quoted in CSV") {
  auto scene = support::scene();
  scene.elements[0].name = "a \"b\", c";
  auto branch = support::branch();
  branch.set = {{"a \"b\", c.normal_load", 3}};
  CHECK(lines(scene, {branch})[0].find("\"a \"\"b\"\", c.normal_load (N)\",branch,") == 0);
}

TEST_CASE("no branch gives a header alone") {
  CHECK(lines(support::scene(), {}).size() == 1);
}

TEST_CASE("a fold stands between the points around it, beyond both in frequency") {
  auto branch = support::branch();
  branch.points = {support::point(1, 0.1),    support::point(1.5, 0.5),  support::point(1.9, 0.9),
                   support::point(1.95, 0.8), support::point(1.5, 0.35), support::point(1.55, 0.2),
                   support::point(2, 0.05)};
  branch.events = {{"peak", false, true, support::point(1.94, 0.92)},
                   {"fold", false, true, support::point(1.97, 0.86)},
                   {"fold", false, true, support::point(1.45, 0.28)}};
  CHECK(output::points_before_events(branch) == std::vector<std::size_t>{3, 3, 5});
}

TEST_CASE("events of a branch without points, or with one, come at its end") {
  auto branch = support::branch();
  branch.points.resize(1);
  CHECK(output::points_before_events(branch) == std::vector<std::size_t>{1});
  branch.points.clear();
  CHECK(output::points_before_events(branch) == std::vector<std::size_t>{0});
}
