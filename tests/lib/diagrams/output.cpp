// Branches and diagrams as columns, JSON, CSV and figures, against the branches themselves and closed forms.
#include "catch.hpp"

#include <arcslip/continuation.hpp>
#include <arcslip/diagrams/output.hpp>
#include <arcslip/figures/layout.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <sstream>

using namespace arcslip;
using namespace arcslip::continuation;
using nlohmann::json;

namespace {

// x' = p x - x^3, and y' = -2 y.
std::shared_ptr<const Problem> pitchfork() {
  return from_functions(2, {{"p", "N"}}, [](In u, In p, Out F) {
    F[0] = p[0] * u[0] - u[0] * u[0] * u[0];
    F[1] = -2 * u[1];
  });
}

Options with_stability(double lower, double upper) {
  Options options{.lower = lower, .upper = upper};
  options.stability.emplace();
  return options;
}

Diagram of_pitchfork() {
  return trace_diagram(pitchfork(), {.u = Vector::Zero(2), .p = Vector{{-0.93}}}, with_stability(-1, 1));
}

// The Brusselator with A = 1: a Hopf point at B = 2 of frequency 1, l1 = -1/2 (examples/special_curves).
Branch of_brusselator(const std::shared_ptr<const Problem>& problem) {
  return trace(problem, {.u = Vector{{1.0, 1.0}}, .p = Vector{{1.0}}}, with_stability(1, 3),
               hopf_monitors(*problem));
}

std::shared_ptr<const Problem> brusselator() {
  return from_functions(2, {{"B", ""}}, [](In u, In p, Out F) {
    const double x = u[0], y = u[1], B = p[0];
    F[0] = 1 - (B + 1) * x + x * x * y;
    F[1] = B * x - x * x * y;
  });
}

json as_json(const results::Results& results) {
  std::ostringstream out;
  results::write_json(out, results);
  return json::parse(out.str());
}

// The cells of a CSV without quotes, by rows.
std::vector<std::vector<std::string>> as_cells(const results::Results& results, const std::string& table) {
  std::ostringstream out;
  results::write_csv(out, results, table);
  std::istringstream lines(out.str());
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

std::size_t column(const std::vector<std::vector<std::string>>& rows, const std::string& title) {
  const auto at = std::find(rows[0].begin(), rows[0].end(), title);
  CAPTURE(title, rows[0]);
  REQUIRE(at != rows[0].end());
  return static_cast<std::size_t>(at - rows[0].begin());
}

}  // namespace

TEST_CASE(
    "the JSON of a diagram has the points, ranges, events and branch points of its branches, bit for bit") {
  const Diagram diagram = of_pitchfork();
  REQUIRE(diagram.complete);
  diagrams::Columns columns = diagrams::columns_of(*pitchfork(), 0, {"x", "y"});
  columns.title = "pitchfork";
  const json all = as_json(diagrams::results_of(diagram, columns));
  CHECK(all["format"] == "arcslip-results-1");  // of two lists
  CHECK(all["title"] == "pitchfork");
  CHECK(all["program"].get<std::string>().starts_with("arcslip "));
  CHECK(all["units"]["branches"]["points"]["p"] == "N");
  REQUIRE(all["branches"].size() == diagram.branches.size());
  for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
    const json& written = all["branches"][b];
    const DiagramBranch& of = diagram.branches[b];
    CHECK(written["depth"] == of.depth);
    CHECK(written.contains("origin") == (of.origin >= 0));
    CHECK(written["status"] == "complete");
    CHECK(written["stop"]["reason"] == "boundary");
    CHECK(written["stop"]["message"] == of.branch.stop.message);
    CHECK(written["begin"]["reason"] == "boundary");
    CHECK(written["solver"]["jacobians"] == of.branch.counts.jacobians);
    REQUIRE(written["points"].size() == of.branch.points.size());
    for (std::size_t i = 0; i < of.branch.points.size(); ++i) {
      const Point& point = of.branch.points[i];
      const json& row = written["points"][i];
      CHECK(row["p"] == point.parameter);
      CHECK(row["x"] == point.u[0]);
      CHECK(row["y"] == point.u[1]);
      CHECK(row["arclength"] == point.arclength);
      REQUIRE(row.contains("unstable") == point.spectrum.has_value());
      if (!point.spectrum) continue;
      CHECK(row["unstable"] == point.spectrum->unstable);
      CHECK(row["eigenvalues"][1][0] == point.spectrum->leading[1].real());
    }
    REQUIRE(written["stability"].size() == of.stability.size());
    for (std::size_t i = 0; i < of.stability.size(); ++i) {
      CHECK(written["stability"][i]["last"] == of.stability[i].last);
      CHECK(written["stability"][i]["unstable"] == of.stability[i].unstable);
      CHECK(written["stability"][i]["to"] == of.branch.points[of.stability[i].last].parameter);
    }
    REQUIRE(written["events"].size() == 1);
    const json& event = written["events"][0];
    CHECK(event["kind"] == "branch_point");
    CHECK(event["label"] == "branch point");
    CHECK(event["criticality"] == "supercritical");
    CHECK(std::abs(event["p"].get<double>()) < 1e-9);
    CHECK(std::abs(event["normal_form"]["cubic"]["value"].get<double>() + 1) < 1e-6);  // z' = p z - z^3
  }
  REQUIRE(all["branch_points"].size() == 1);
  const json& point = all["branch_points"][0];
  CHECK(point["branch"] == 1);
  CHECK(point["event"] == 1);
  REQUIRE(point["half_branches"].size() == 4);
  for (std::size_t h = 0; h < 4; ++h)
    CHECK(point["half_branches"][h]["branch"] == diagram.branch_points[0].half_branches[h].branch + 1);
}

TEST_CASE(
    "the CSV of a branch has its points with their eigenvalues, and its Hopf point with its normal form") {
  const auto problem = brusselator();
  const Branch branch = of_brusselator(problem);
  REQUIRE(branch.events.size() == 1);
  const auto results = diagrams::results_of(branch, diagrams::columns_of(*problem, 0));
  const auto rows = as_cells(results, "points");
  REQUIRE(rows.size() == branch.points.size() + 1);
  const auto number = [](const std::string& cell) { return std::stod(cell); };
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const Point& point = branch.points[i];
    CHECK(number(rows[i + 1][column(rows, "B")]) == point.parameter);
    CHECK(number(rows[i + 1][column(rows, "u_2")]) == point.u[1]);
    CHECK(number(rows[i + 1][column(rows, "unstable")]) == (point.parameter > 2 ? 2 : 0));
  }
  CHECK(as_json(results)["format"] == "arcslip-diagram-1");
  const json event = as_json(results)["branches"][0]["events"][0];
  CHECK(event["kind"] == "hopf");
  CHECK(std::abs(event["B"].get<double>() - 2) < 1e-9);
  CHECK(std::abs(event["frequency"].get<double>() - 1) < 1e-8);
  CHECK(std::abs(event["normal_form"]["lyapunov"]["value"].get<double>() + 0.5) < 1e-5);
  const auto ranges = as_cells(results, "stability");
  REQUIRE(ranges.size() == 3);
  CHECK(ranges[1][column(ranges, "unstable")] == "0");
  CHECK(ranges[2][column(ranges, "unstable")] == "2");
}

TEST_CASE(
    "the figure of a diagram has dashes for what is unstable, from the branch point on, and names for it") {
  const Diagram diagram = of_pitchfork();
  const auto data = diagrams::figure_data_of(diagram, diagrams::columns_of(*pitchfork(), 0, {"x", "y"}));
  REQUIRE(data.lines.size() == 2);
  REQUIRE(data.figures.size() == 2);
  const results::FigureLine& line = data.lines[0];
  REQUIRE(line.parts.size() == 2);
  for (const auto& [part, unstable] : {std::pair{0, false}, std::pair{1, true}}) {
    CHECK(line.unstable[static_cast<std::size_t>(part)] == unstable);
    for (const results::Record& record : line.parts[static_cast<std::size_t>(part)])
      CHECK(
          (unstable ? record[0] > -1e-9 : record[0] < 1e-9));  // p = 0 is the end of one and begins the other
  }
  CHECK(std::abs(line.parts[1].front()[0]) < 1e-9);
  CHECK(line.parts[0].back() == line.parts[1].front());
  REQUIRE(data.lines[1].unstable == std::vector<bool>{false});
  for (const results::Record& record : data.lines[1].parts[0])
    CHECK(std::abs(record[1] * record[1] - record[0]) < 1e-9);
  REQUIRE(line.marks.size() == 1);
  CHECK(line.marks[0].label == "branch point");
  const auto figures = figures::figures_of(data);
  REQUIRE(figures.size() == 2);
  CHECK(figures[0].name == "x");
  CHECK(figures[0].x.label == "p (N)");
  CHECK(std::any_of(figures[0].curves[0].stretches.begin(), figures[0].curves[0].stretches.end(),
                    [](const auto& stretch) { return stretch.unstable; }));
  CHECK(std::any_of(figures[0].texts.begin(), figures[0].texts.end(),
                    [](const auto& text) { return text.text == "branch point"; }));
}

TEST_CASE(
    "a branch point has one number in all of a diagram, and other events are counted over all branches") {
  // u = 0 is left by the parabola at p = 0, which u = 1/2 crosses at p = 1/4.
  const auto problem = from_functions(
      1, {{"p", ""}}, [](In u, In p, Out F) { F[0] = u[0] * (u[0] * u[0] - p[0]) * (u[0] - 0.5); });
  const Diagram diagram = trace_diagram(problem, {.u = Vector::Zero(1), .p = Vector{{-0.9}}},
                                        Options{.lower = -1, .upper = 1}, {.depth = 2}, {fold_monitor()});
  const json all = as_json(diagrams::results_of(diagram, diagrams::columns_of(*problem, 0)));
  int points = 0;
  std::set<std::string> folds;
  for (const json& branch : all["branches"])
    for (const json& event : branch["events"]) {
      if (event["kind"] == "branch_point") {
        CHECK(event["label"] ==
              (std::abs(event["p"].get<double>()) < 0.1 ? "branch point 1" : "branch point 2"));
        ++points;
      } else {
        CHECK(folds.insert(event["label"]).second);
      }
    }
  CHECK(points == 4);
}

TEST_CASE("a table that results do not have is refused with those that they have") {
  std::ostringstream out;
  const auto results = diagrams::results_of(of_pitchfork(), diagrams::columns_of(*pitchfork(), 0));
  CHECK_THROWS_WITH(
      results::write_csv(out, results, "branch_points"),
      "the results have no table \"branch_points\", but: points, events, stability, half_branches");
  CHECK(out.str().empty());
}

TEST_CASE(
    "events of one kind are numbered in figures and tables, and monitors of one's own keep their names") {
  // p = x^3 - x: folds at x = -+ 1 / sqrt(3).
  const auto problem =
      from_functions(1, {{"p", ""}}, [](In u, In p, Out F) { F[0] = p[0] + u[0] - u[0] * u[0] * u[0]; });
  const Monitor middle{.name = "middle", .value = [](const Accepted& now) { return now.u[0]; }};
  const WholeBranch whole = trace_both(problem, {.u = Vector{{-0.1}}, .p = Vector{{0.099}}},
                                       with_stability(-1, 1), {fold_monitor(), middle});
  const json all = as_json(diagrams::results_of(whole, diagrams::columns_of(*problem, 0)));
  const json& events = all["branches"][0]["events"];
  REQUIRE(events.size() == 3);
  for (const auto& [e, kind, label] :
       {std::tuple{0, "fold", "fold 1"}, std::tuple{1, "event", "middle"}, std::tuple{2, "fold", "fold 2"}}) {
    CHECK(events[static_cast<std::size_t>(e)]["kind"] == kind);
    CHECK(events[static_cast<std::size_t>(e)]["label"] == label);
  }
  CHECK(all["branches"][0]["status"] == "complete");
  WholeBranch cut_short = whole;
  cut_short.begin.reason = StopReason::step_too_small;
  CHECK(as_json(diagrams::results_of(
            cut_short, diagrams::columns_of(*problem, 0)))["branches"][0]["status"] == "stopped");
  const auto data = diagrams::figure_data_of(whole, diagrams::columns_of(*problem, 0));
  CHECK(data.lines[0].unstable == std::vector<bool>{false, true, false});
  CHECK(data.lines[0].marks[1].label == "middle");
  CHECK(std::abs(data.lines[0].parts[0].back()[1] * data.lines[0].parts[0].back()[1] - 1.0 / 3) < 1e-9);
}

TEST_CASE("a diagram that is not complete says so in its notes, and branches that fail have that status") {
  const Diagram diagram = trace_diagram(pitchfork(), {.u = Vector::Zero(2), .p = Vector{{-0.93}}},
                                        {.lower = -1, .upper = 1}, {.branches = 1});
  const auto columns = diagrams::columns_of(*pitchfork(), 0);
  const json all = as_json(diagrams::results_of(diagram, columns));
  CHECK(all["notes"][0] == "the diagram is not complete: reached the maximum number of branches, 1");
  CHECK(all["branch_points"][0]["status"] == "stopped");
  CHECK(all["branch_points"][0]["half_branches"][2]["untraced"] ==
        "reached the maximum number of branches, 1");
  CHECK(all["branches"][0]["stability"].empty());
  CHECK(diagrams::figure_data_of(diagram, columns).lines[0].unstable.empty());
  const auto none = from_functions(1, {{"p", ""}}, [](In u, In, Out F) { F[0] = u[0] * u[0] + 1; });
  const Branch failed = trace(none, {.u = Vector{{1.0}}, .p = Vector{{0.0}}}, {.lower = -1, .upper = 1});
  const json of_failed = as_json(diagrams::results_of(failed, diagrams::columns_of(*none, 0)));
  CHECK(of_failed["branches"][0]["status"] == "failed");
  CHECK(of_failed["branches"][0]["stop"]["reason"] == "start_failed");
}

TEST_CASE("columns are those of the problem: names for all unknowns or none, of many their norm") {
  CHECK_THROWS_WITH(diagrams::columns_of(*pitchfork(), 0, {"x"}), "1 names are given for 2 unknowns");
  CHECK_THROWS_WITH(diagrams::columns_of(*pitchfork(), 1), "the free parameter is 1, must be from 0 to 0");
  const auto many = from_functions(13, {{"p", ""}}, [](In u, In p, Out F) { F = u.array() - p[0]; });
  const auto columns = diagrams::columns_of(*many, 0);
  REQUIRE(columns.quantities.size() == 1);
  CHECK(columns.quantities[0].name == "norm");
  Point point;
  point.u = Vector::Constant(13, 2);
  CHECK(std::abs(columns.quantities[0].value(point) - 2 * std::sqrt(13.0)) < 1e-14);
}
