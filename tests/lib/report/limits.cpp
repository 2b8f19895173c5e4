// Pages of many results and points.

#include "catch.hpp"
#include "contains.hpp"
#include "lib/report/page_of.hpp"
#include "lib/results/made_up.hpp"

#include <arcslip/report/parts.hpp>
#include <arcslip/results/reasons.hpp>

#include <cmath>
#include <numbers>

using namespace report_test;

namespace {

const char* const bare_scene = R"({"format": "arcslip-scene-1", "structure": {"dofs": ["a"],
  "masses": [{"name": "m", "at": "a", "value": 1}], "springs": [{"name": "k", "at": "a", "value": 1}],
  "dampers": [{"name": "c", "at": "a", "value": 1}]},
  "excitation": [{"name": "f", "at": "a", "cosine": 1}], "response": {"at": "a"},
  "studies": [{"name": "s", "kind": "frf", "from": 1, "to": 2}]})";

/// A study of many results, each with a row, of which some end early.
std::string page_of_results(int count, int stopped, std::vector<results::FigureData> figures = {}) {
  const scene::Scene scene = scene_of(bare_scene);
  results::Schema schema{.format = "things-1",
                         .list = "things",
                         .noun = "thing",
                         .tables = {{"rows", made_up::table().columns(), {"elements"}}},
                         .shown = {{"x (m)", {"x"}}},
                         .shown_table = "rows"};
  report::Report report(scene, scene.studies);
  report.begin({"program 1", "hash", "t", "Hz"}, {&schema, 1});
  for (int i = 0; i < count; ++i) {
    report.curve({"s", "frf"}, 0);
    report.rows(0, made_up::table().rows(std::vector<made_up::Item>{{1000.0 + i}}));
    const bool early = i < stopped;
    report.end(
        {early ? results::Status::stopped : results::Status::complete,
         {{"reason", "point_limit"}, {"message", early ? "the maximum number of points was reached" : ""}}});
  }
  report.add_figures(0, std::move(figures));
  std::ostringstream page;
  report.write(page);
  return page.str();
}

/// A wave with noise in so many points.
results::FigureData wave(std::size_t points, double noise) {
  results::FigureData data;
  data.columns = {{"x", "", results::Scale::linear, {0, 1}}, {"y", "", results::Scale::linear, {-1, 1}}};
  data.figures = {{"y", 0, 1, "x", "y"}};
  data.lines.emplace_back().parts.emplace_back();
  for (std::size_t i = 0; i < points; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(points - 1);
    const double sign = i % 2 == 0 ? 1 : -1;
    data.lines[0].parts[0].push_back({x, (1 - noise) * std::sin(6 * std::numbers::pi * x) + sign * noise});
  }
  return data;
}

}  // namespace

TEST_CASE("of more than 1000 results a page shows the first 1000, and says so") {
  const std::string page = page_of_results(1003, 0);
  CHECK(contains(page, "<td>1999</td>"));
  CHECK_FALSE(contains(page, "<td>2000</td>"));
  CHECK(contains(page, "The page shows the first 1000 of 1003 results"));
  CHECK_FALSE(contains(page_of_results(1000, 0), "The page shows the first"));
}

TEST_CASE("what ended early comes before the scene, with what to do, however late in the study") {
  const std::string page = page_of_results(1, 1);
  const std::size_t doubt = page.find("Not complete: ");
  REQUIRE(doubt != std::string::npos);
  CHECK(doubt < page.find("<section id=\"scene\""));
  CHECK(contains(page, "The maximum number of points was reached."));
  CHECK(contains(page, "What to do: Choose a shorter range"));
  CHECK(contains(page_of_results(2000, 2000), "And 1000 more of the study"));
  CHECK(contains(page_of_results(1, 0), "Each result is complete"));
}

TEST_CASE("a study that was not started is said to be so") {
  CHECK(contains(page_of_results(0, 0), "Not started: "));
}

TEST_CASE("a page keeps to its number of points, and says that it left some out") {
  const std::string all = page_of_results(1, 0, {wave(20'000, 0.01)});
  CHECK_FALSE(contains(all, "The curves show"));
  const std::string fewer = page_of_results(1, 0, {wave(300'000, 1e-4)});
  CHECK(contains(fewer, " of 300000 points"));
  CHECK(fewer.size() < all.size() + 2'000'000);
}

TEST_CASE("a thinned curve is nowhere farther from the curve than its tolerance") {
  const results::FigureData data = wave(5001, 0);
  for (const double tolerance : {1e-2, 1e-4}) {
    const results::FigureData fewer = report::thinned(data, tolerance);
    const auto& part = fewer.lines[0].parts[0];
    CAPTURE(tolerance, part.size());
    CHECK(part.size() < 2500);
    CHECK(part.front() == data.lines[0].parts[0].front());
    CHECK(part.back() == data.lines[0].parts[0].back());
    std::size_t k = 1;
    for (const results::Record& at : data.lines[0].parts[0]) {
      while (k + 1 < part.size() && part[k][0] < at[0]) ++k;
      const auto &a = part[k - 1], &b = part[k];
      const double share = (at[0] - a[0]) / (b[0] - a[0]);
      const double vertical = std::abs(a[1] + share * (b[1] - a[1]) - at[1]) / 2;  // of the axis, which is 2
      const double slope = std::abs((b[1] - a[1]) / 2 / (b[0] - a[0]));
      CHECK(vertical <= tolerance * (1 + slope) * 1.5);
    }
  }
}

TEST_CASE("each reason for an early end of a branch comes with what to do") {
  using namespace observables::reasons;
  for (const results::Reason& reason :
       {user,          point_limit,        time_limit,      memory_limit,
        start_failed,  step_too_small,     state_too_large, unbounded,
        not_evaluated, monitor_failed,     event,           no_mode,
        period_limit,  no_periodic_motion, no_convergence,  singular,
        not_finite,    event_limit,        energy_defect,   not_piecewise_linear,
        massless,      set_valued,         loss_factor,     sector,
        several_places}) {
    CAPTURE(reason.code);
    CHECK(report::advice(reason.code).size() > 10);
  }
}

TEST_CASE("a drawing has no room for many degrees of freedom, and says so") {
  std::string dofs, masses, springs;
  for (int i = 0; i < 40; ++i) {
    const std::string name = "\"x" + std::to_string(i) + "\"", comma = i > 0 ? "," : "";
    dofs += comma + name;
    masses += comma + R"({"name": "m)" + std::to_string(i) + R"(", "at": )" + name + R"(, "value": 1})";
    springs += comma + R"({"name": "k)" + std::to_string(i) + R"(", "at": )" + name + R"(, "value": 1})";
  }
  const scene::Scene scene = scene_of(R"({"format": "arcslip-scene-1", "structure": {"dofs": [)" + dofs +
                                      R"(], "masses": [)" + masses + R"(], "springs": [)" + springs +
                                      R"(]}, "excitation": [{"name": "f", "at": "x0", "cosine": 1}],
    "response": {"at": "x0"}})");
  std::ostringstream out;
  report::Html html(out);
  report::write_drawing(html, scene);
  CHECK(contains(out.str(), "is not drawn: it has 40 degrees of freedom"));
}

TEST_CASE("a name that is too long for a drawing is cut between characters") {
  CHECK(report::shortened("damper", 6) == "damper");
  CHECK(report::shortened("dampers", 6) == "dampe…");
  CHECK(report::shortened("Dämpfer", 7) == "Dämpfer");
  CHECK(report::shortened("ßßßßßß", 4) == "ßßß…");
}
