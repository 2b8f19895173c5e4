// Figures of what contacts do: their areas are the shares of the states.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/output/support.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/figures/layout.hpp>
#include <arcslip/output/gnuplot_script.hpp>
#include <arcslip/studies/presentation/figures.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

using namespace arcslip;
using observables::ResponseBranch;
using results::FigureArea;
using results::FigureView;
using std::numbers::pi;
using studies::BranchKind;

namespace {

const FigureView* contact_figure(const results::FigureData& data, const std::string& name = "contact") {
  const auto found = std::find_if(data.figures.begin(), data.figures.end(),
                                  [&](const FigureView& figure) { return figure.name == name; });
  return found == data.figures.end() ? nullptr : &*found;
}

// Of the kinds that begin so, degrees times the unit of x.
double area(const FigureView& figure, const std::string& kind) {
  double sum = 0;
  for (const FigureArea& each : figure.areas) {
    if (!each.kind.starts_with(kind)) continue;
    for (const auto& strip : each.strips)
      for (std::size_t i = 0; i + 1 < strip.size(); ++i)
        sum += 0.5 * (strip[i + 1][0] - strip[i][0]) *
               (strip[i][2] - strip[i][1] + strip[i + 1][2] - strip[i + 1][1]);
  }
  return sum;
}

// A point of support::point with these states, which begin at these degrees.
observables::ResponsePoint at(double hertz, std::vector<std::pair<const char*, double>> states) {
  auto point = support::point(hertz, 1);
  auto& contact = point.elements[0].contact;
  for (const auto& [state, begin] : states) contact.push_back({state, begin * pi / 180, 0});
  for (std::size_t i = 0; i < contact.size(); ++i)
    contact[i].end = i + 1 < contact.size() ? contact[i + 1].begin : contact[0].begin + 2 * pi;
  return point;
}

FigureView made_up(std::vector<observables::ResponsePoint> points) {
  ResponseBranch branch = support::branch();
  branch.points = std::move(points);
  const auto data = studies::figures_of(support::scene(), BranchKind::responses, std::vector{branch});
  const FigureView* figure = contact_figure(data);
  REQUIRE(figure);
  return *figure;
}

}  // namespace

TEST_CASE("the areas of stick and separation are the integrals of their shares over the frequency") {
  struct Case {
    const char* name;
    observables::FrequencyRange window;
  };
  for (const auto& [name, window] :
       {Case{"rubbing_pad", {60, 180}}, Case{"under_platform_damper", {230, 300}}}) {
    scene::Scene s = scenes::example(name);
    s.harmonics.order = 5;
    const auto branches = observables::frequency_response(s, window);
    REQUIRE(branches.size() == 1);
    const auto data = studies::figures_of(s, BranchKind::responses, branches);
    for (std::size_t e = 0; e < s.elements.size(); ++e) {
      const std::string own = s.elements.size() > 1 ? "contact_" + s.elements[e].name : "contact";
      CAPTURE(name, own);
      const FigureView* figure = contact_figure(data, own);
      REQUIRE(figure);
      double stick = 0, open = 0, before = -1, reached = 0;
      const observables::ElementResponse* last = nullptr;
      for (const auto& point : branches[0].points) {
        const double x = point.omega / scene::to_rad_per_s(s.frequency_unit);
        if (!(x > reached)) continue;
        const auto& element = point.elements[e];
        if (last) {
          stick += 0.5 * (x - before) * (element.stick_percent + last->stick_percent);
          open += 0.5 * (x - before) * (element.open_percent + last->open_percent);
        }
        last = &element;
        before = reached = x;
      }
      const double all = 360 * (before - branches[0].points[0].omega / scene::to_rad_per_s(s.frequency_unit));
      CHECK(std::abs(area(*figure, "stick") / 3.6 - stick) < 1e-9 * all);
      CHECK(std::abs(area(*figure, "open") / 3.6 - open) < 1e-9 * all);
      CHECK(std::abs(area(*figure, "") - all) < 1e-9 * all);
      CHECK(stick > 0);
      CHECK(area(*figure, "slip+") > 0);
      CHECK(area(*figure, "slip-") > 0);
    }
  }
}

TEST_CASE("where a boundary passes the beginning of the period its strip goes on at the other end") {
  const FigureView figure = made_up({at(1, {{"stick", 20}, {"slip+", 100}, {"slip-", 300}}),
                                     at(2, {{"slip+", 80}, {"slip-", 280}, {"stick", 340}})});
  REQUIRE(figure.areas.size() == 3);
  const FigureArea& stick = figure.areas[0];
  CHECK(stick.kind == "stick");
  REQUIRE(stick.strips.size() == 2);  // from 20..100 to -20..80
  CHECK(stick.strips[0].front()[1] == Approx(20));
  CHECK(stick.strips[0].back()[1] == 0);
  CHECK(stick.strips[0].back()[2] == Approx(80));
  CHECK(stick.strips[1].front()[1] == 360);
  CHECK(stick.strips[1].back()[1] == Approx(340));
  CHECK(area(figure, "") == Approx(360));
}

TEST_CASE("where the order of the states changes strips end half-way between the points") {
  const FigureView figure = made_up({at(1, {{"stick", 0}}), at(2, {{"stick", 10}, {"open", 200}})});
  REQUIRE(figure.areas.size() == 2);
  CHECK(area(figure, "open") == Approx(0.5 * 170));
  CHECK(area(figure, "stick") == Approx(0.5 * 360 + 0.5 * 190));
}

TEST_CASE("a branch that turns back is shown as in a sweep upwards, and gaps stay empty") {
  const auto stick = at(1, {{"stick", 0}}), more = at(2, {{"stick", 0}});
  const auto open = [](double hertz) { return at(hertz, {{"open", 0}}); };
  CHECK(area(made_up({stick, more, open(1.5), open(1.2), open(1.8)}), "open") == 0);
  CHECK(area(made_up({stick, more, open(1.5), open(3)}), "open") == Approx(0.5 * 360));
  const auto silent = support::point(2.5, 1);
  CHECK(area(made_up({stick, more, silent, at(3, {{"stick", 0}}), at(4, {{"stick", 0}})}), "stick") ==
        Approx(2 * 360));
}

TEST_CASE("contacts are drawn of a single line, alone or by their names, and of no patch") {
  ResponseBranch branch = support::branch(), other = support::branch(5);
  branch.points = other.points = {at(1, {{"stick", 0}}), at(2, {{"slip", 0}})};
  const auto of = [](std::vector<ResponseBranch> all, BranchKind kind = BranchKind::responses) {
    return studies::figures_of(support::scene(), kind, all);
  };
  CHECK(contact_figure(of({branch})));
  CHECK_FALSE(contact_figure(of({branch, other})));
  CHECK_FALSE(contact_figure(of({branch}, BranchKind::folds)));
  auto two = branch;
  for (auto& point : two.points) {
    point.elements.push_back(point.elements[0]);
    point.elements.back().name = "second";
  }
  CHECK(contact_figure(of({two}), "contact_damper"));
  CHECK(contact_figure(of({two}), "contact_second"));
  for (auto& point : two.points) point.elements[1].of_patch = true;
  CHECK(contact_figure(of({two})));
  auto peaks = support::peaks();
  for (auto& point : peaks.points) point.elements[0].contact = {{"stick", 0, 2 * pi}};
  const auto data = of({peaks}, BranchKind::peaks);
  REQUIRE(contact_figure(data));
  CHECK(results::x_words(data, *contact_figure(data)) == "damper normal load");
  CHECK(area(*contact_figure(data), "stick") == Approx(360 * 29.9));
}

TEST_CASE("areas are blocks of strips in the data of gnuplot, after those of the figures before") {
  ResponseBranch branch = support::branch();
  branch.points = {at(1, {{"stick", 20}, {"slip+", 100}}), at(2, {{"stick", 340}, {"slip+", 100}})};
  const auto all =
      figures::figures_of(studies::figures_of(support::scene(), BranchKind::responses, std::vector{branch}));
  REQUIRE(all.size() == 3);
  std::ostringstream text, script;
  output::write_figure_data(text, all);
  output::write_gnuplot_script(script, all, "f", {"f_amplitude", "f_stick", "f_contact"}, {"svg"}, {});
  // A curve and a peak of each of the two figures before them.
  CHECK(script.str().find("data index 4 using 1:2:3 with filledcurves") != std::string::npos);
  CHECK(script.str().find("data index 5 using 1:2:3 with filledcurves") != std::string::npos);
  CHECK(script.str().find("title 'slip+'") != std::string::npos);
  CHECK(text.str().find("# from and to: stick\n1 20 ") != std::string::npos);
  std::size_t blocks = 1;
  for (auto i = text.str().find("\n\n\n"); i != std::string::npos; i = text.str().find("\n\n\n", i + 3))
    ++blocks;
  CHECK(blocks >= 4);
}
