#include "catch.hpp"

#include <arcslip/figures/layout.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

using namespace arcslip;
using results::Figure;
using results::FigureData;
using results::FigureKeyEntry;

namespace event_kinds = observables::event_kinds;

namespace {

/// Lines y = height_i (1 + x) for x from 0 to 1, of these heights (m), over a frequency.
FigureData slopes(const std::vector<double>& heights) {
  FigureData data;
  data.title = "slopes";
  data.parameters = {"damper normal load"};
  data.columns = {{.words = "frequency", .unit = "Hz", .is_frequency = true},
                  {.words = "amplitude", .unit = "m", .is_amplitude = true}};
  for (const double height : heights) {
    results::FigureLine line{.label = std::to_string(data.lines.size() + 1) + " N"};
    auto& part = line.parts.emplace_back();
    for (int i = 0; i <= 10; ++i) part.push_back({0.1 * i, height * (1 + 0.1 * i)});
    data.lines.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < 2; ++i) data.columns[i].range = results::full_range(data, i);
  data.figures = {{.name = "amplitude"}};
  return data;
}

Figure first_of(const FigureData& data, const results::FigureStyle& style = {}) {
  return figures::figure_of(data, data.figures.front(), style);
}

std::vector<std::string> key_of(const Figure& figure) {
  std::vector<std::string> texts;
  for (const FigureKeyEntry& entry : figure.key) texts.push_back(entry.text);
  return texts;
}

bool has_text(const Figure& figure, const std::string& text) {
  return std::any_of(figure.texts.begin(), figure.texts.end(),
                     [&](const results::FigureText& each) { return each.text == text; });
}

}  // namespace

TEST_CASE("an axis has words and a unit whose prefix suits its numbers") {
  struct Case {
    double height;
    const char* label;
    double factor;
  };
  for (const Case& each : {Case{2e-3, "amplitude (mm)", 1e3}, Case{2e-6, "amplitude (µm)", 1e6},
                           Case{2, "amplitude (m)", 1}, Case{2e3, "amplitude (km)", 1e-3}}) {
    const Figure figure = first_of(slopes({each.height}));
    CHECK(figure.y.label == each.label);
    CHECK(figure.y.factor == Approx(each.factor).epsilon(1e-14));
    CHECK(figure.x.label == "frequency (Hz)");
    CHECK(figure.curves.front().y.front() == each.height);  // in SI
    CHECK(figure.y.place(each.height * 2) < 1);
    CHECK(figure.y.place(each.height) > 0);
  }
}

TEST_CASE("the prefix of a logarithmic axis is that of its middle") {
  FigureData data = slopes({1});
  data.columns[1].unit = "N";
  data.columns[1].scale = results::Scale::logarithmic;
  data.columns[1].range = {0.01, 500};
  CHECK(first_of(data).y.label == "amplitude (N)");
  data.columns[1].range = {0.01e3, 500e3};
  CHECK(first_of(data).y.label == "amplitude (kN)");
}

TEST_CASE("ticks are 1, 2 or 5 times powers of ten, and decades with lines between them") {
  FigureData data = slopes({1});
  std::vector<std::string> labels;
  for (const auto& tick : first_of(data).x.ticks) labels.push_back(tick.label);
  CHECK(labels == std::vector<std::string>{"0", "0.2", "0.4", "0.6", "0.8", "1"});
  data.columns[1].scale = results::Scale::logarithmic;
  data.columns[1].unit = "";
  data.columns[1].range = {1e-6, 1e-2};
  const Figure figure = first_of(data);
  std::set<std::string> words;
  std::size_t silent = 0;
  for (const auto& tick : figure.y.ticks) {
    if (tick.label.empty())
      ++silent;
    else
      words.insert(tick.label);
  }
  CHECK(words == std::set<std::string>{"10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²"});
  CHECK(silent >= 4 * 8);
}

TEST_CASE("dashes mean instability, and colours differ by line") {
  FigureData data = slopes({1, 2, 3});
  data.lines[1].unstable = {true};
  const Figure figure = first_of(data);
  REQUIRE(figure.curves.size() == 3);
  for (const auto& curve : figure.curves)
    for (const auto& stretch : curve.stretches) CHECK(stretch.unstable == (curve.line == 1));
  CHECK(figure.curves[0].colour == "#0d0887");
  CHECK(figure.curves[2].colour == "#e28a18");
  CHECK(key_of(figure) == std::vector<std::string>{"1 N", "2 N", "3 N", "unstable"});
  CHECK(figure.key_title == std::vector<std::string>{"damper normal load"});
  const Figure grey = first_of(data, {.is_grey = true});
  for (const auto& curve : grey.curves) {
    CHECK(curve.colour.substr(1, 2) == curve.colour.substr(3, 2));
    CHECK(curve.colour.substr(1, 2) == curve.colour.substr(5, 2));
  }
}

TEST_CASE("each of a few curves has its name next to it") {
  const Figure figure = first_of(slopes({1, 2, 3}));
  for (const char* name : {"1 N", "2 N", "3 N"}) CHECK(has_text(figure, name));
  CHECK(first_of(slopes(std::vector<double>(40, 1))).texts.empty());
}

TEST_CASE("marks that would cover each other are one, with their count") {
  FigureData data = slopes({1});
  for (const double at : {0.5, 0.501, 0.502, 0.503, 0.504, 0.1, 0.9})
    data.lines[0].marks.push_back({event_kinds::fold, {at, 1 + at}});
  const Figure figure = first_of(data);
  REQUIRE(figure.symbols.size() == 3);
  CHECK(figure.symbols[0].count == 5);
  CHECK(figure.symbols[1].count == 1);
  CHECK(has_text(figure, "5 × fold"));
  CHECK(key_of(figure) == std::vector<std::string>{"1 N", "fold"});
}

TEST_CASE("a mark with words of its own has them, and no other mark of its kind does") {
  FigureData data = slopes({1});
  data.lines[0].marks.push_back({event_kinds::minimum, {0.2, 1.2}, "0.2 N"});
  data.lines[0].marks.push_back({event_kinds::minimum, {0.8, 1.8}});
  const Figure figure = first_of(data);
  const auto text = std::find_if(figure.texts.begin(), figure.texts.end(),
                                 [](const results::FigureText& each) { return each.text == "0.2 N"; });
  REQUIRE(text != figure.texts.end());
  CHECK(text->x == 0.2);
}

TEST_CASE("a main curve is drawn before the others, wider and dark") {
  FigureData data = slopes({1, 2, 3});
  data.lines[0].is_main = true;
  const Figure figure = first_of(data);
  CHECK(figure.curves.back().line == 0);
  CHECK(figure.curves.back().width == 3);
  CHECK(figure.curves.back().colour == "#111111");
}

TEST_CASE("many curves are drawn as their median and quantile bands, which the figure says") {
  // Heights 1 ... 2001: the median at x is 1001 (1 + x), the quartiles are 501 and 1501, the twentieths 101
  // and 1901.
  std::vector<double> heights;
  for (int i = 1; i <= 2001; ++i) heights.push_back(i);
  const FigureData data = slopes(heights);
  const Figure figure = first_of(data);
  CHECK(figure.note == "2001 curves: their median, and bands of a half and nine tenths");
  REQUIRE(figure.curves.size() == 1);
  const auto& median = figure.curves.front();
  for (std::size_t i = 0; i < median.x.size(); ++i)
    CHECK(median.y[i] == Approx(1001 * (1 + median.x[i])).epsilon(1e-12));
  REQUIRE(figure.fills.size() == 2);
  for (const auto& at : figure.fills[0].strips[0]) {
    CHECK(at[1] == Approx(101 * (1 + at[0])).epsilon(1e-12));
    CHECK(at[2] == Approx(1901 * (1 + at[0])).epsilon(1e-12));
  }
  for (const auto& at : figure.fills[1].strips[0]) {
    CHECK(at[1] == Approx(501 * (1 + at[0])).epsilon(1e-12));
    CHECK(at[2] == Approx(1501 * (1 + at[0])).epsilon(1e-12));
  }
  CHECK(first_of(slopes(std::vector<double>(200, 1))).note.empty());
}

TEST_CASE("many curves that turn back are some of them, which the figure says") {
  std::vector<double> heights(1000);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = 1 + static_cast<double>(i);
  FigureData data = slopes(heights);
  data.figures = {{.name = "loop", .x = 1, .y = 0}};
  const Figure figure = first_of(data);
  CHECK(figure.note == "200 of 1000 curves");
  CHECK(figure.curves.size() == 200);
}

TEST_CASE("the receptance is the amplitude over the force, a figure next to that of amplitudes") {
  FigureData data = slopes({2e-3, 6e-3, 1});
  data.lines[0].force = 2;
  data.lines[1].force = 3;
  results::add_receptance(data);
  REQUIRE(data.figures.size() == 2);
  const Figure figure = figures::figure_of(data, data.figures[1]);
  CHECK(figure.name == "receptance");
  CHECK(figure.y.label == "receptance (mm/N)");
  REQUIRE(figure.curves.size() == 2);  // the third line has no force
  CHECK(figure.curves[0].y.front() == Approx(1e-3).epsilon(1e-14));
  CHECK(figure.curves[1].y.back() == Approx(4e-3).epsilon(1e-14));
  FigureData without = slopes({1});
  results::add_receptance(without);
  CHECK(without.figures.size() == 1);
}
