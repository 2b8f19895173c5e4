// What a page has without scripts.

#include "catch.hpp"
#include "contains.hpp"
#include "lib/report/page_of.hpp"

#include <arcslip/results/table_writer.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace report_test;
using markup::Element;
using markup::named;

namespace {

std::string page_of_two_masses() {
  return page_of(scene_of(two_masses("\"A title\"", "\"inner\"", "\"outer\"")));
}

/// Texts of the cells of each row of the table of results.
std::vector<std::string> rows_of_results(const std::vector<Element>& all) {
  std::vector<std::string> rows;
  for (const Element& row : named(all, "tr"))
    if (row.attributes.contains("id")) rows.push_back(row.text);
  return rows;
}

}  // namespace

TEST_CASE("without scripts a page has its doubts, drawing, parameters, curves and results, in this order") {
  const std::string page = page_of_two_masses();
  std::size_t last = 0;
  for (const char* part : {"<h1>A title</h1>", "<section id=\"doubts\"", "<svg class=\"scene\"",
                           "<table class=\"sortable\">", "<figure class=\"curve\"", "<svg class=\"plain\"",
                           "<table class=\"sortable results\">", "<script type=\"application/json\""}) {
    CAPTURE(part);
    const std::size_t at = page.find(part);
    REQUIRE(at != std::string::npos);
    CHECK(at > last);
    last = at;
  }
  CHECK(page.ends_with("</html>\n"));
}

TEST_CASE("the table of a page has the rows of the table on a terminal, with its digits") {
  const scene::Scene scene = scene_of(two_masses("\"t\"", "\"a\"", "\"b\""));
  std::ostringstream table;
  results::write_table(table, studies::run(scene));
  std::vector<std::string> lines;  // without blanks, as the cells of a row follow each other
  std::istringstream text(table.str());
  for (std::string line; std::getline(text, line);) {
    std::erase(line, ' ');
    if (const std::size_t peak = line.find("peak"); peak != std::string::npos) line.insert(peak, "resonance");
    lines.push_back(line);
  }
  lines.erase(lines.begin());  // titles
  std::vector<std::string> rows = rows_of_results(markup::elements(page_of(scene)));
  for (std::string& row : rows) std::erase(row, ' ');
  CHECK(rows == lines);
  CHECK(rows.size() >= 4);
}

TEST_CASE("a page has all parameters with value, unit and meaning, and what is varied") {
  const scene::Scene scene = scene_of(two_masses("\"t\"", "\"a\"", "\"b\""));
  const std::string page = page_of(scene);
  for (const std::string& name : scene::parameter_names(scene))
    CHECK(contains(page, "<th scope=\"row\">" + name + "</th>"));
  CHECK(contains(page, "<td class=\"number\">3000</td><td>N/m</td>"));
  CHECK(contains(page, "2 values from 1 to 3 in the study &quot;t&quot;"));
}

TEST_CASE("a plain curve has a line for each setting and a mark for each peak, within its drawing") {
  const std::vector<Element> all = markup::elements(page_of_two_masses());
  const std::vector<Element> lines = named(all, "path", "line"), marks = named(all, "path", "mark");
  CHECK(lines.size() >= 4);  // of amplitude and stick, two each, and of the keys
  CHECK(marks.size() >= 4);
  const std::regex number("-?[0-9]+(\\.[0-9]+)?");
  for (const Element& line : lines) {
    const std::string path = line.attributes.at("d");
    bool is_x = true;
    for (std::sregex_iterator at(path.begin(), path.end(), number), end; at != end; ++at, is_x = !is_x) {
      const double value = std::stod(at->str());
      if (path.find('L') == std::string::npos) continue;  // of a key
      CHECK(value >= 0);
      CHECK(value <= (is_x ? 760 : 400));
    }
  }
}

TEST_CASE("a drawing has each mass, spring, damper and element, with names and values") {
  const std::vector<Element> all = markup::elements(page_of_two_masses());
  CHECK(named(all, "g", "mass").size() == 2);
  const std::vector<Element> links = named(all, "g", "link");
  CHECK(links.size() == 5);
  std::string text;
  for (const Element& link : links) text += link.text + "\n";
  for (const char* part : {"k1", "4000 N/m", "k2", "3000 N/m", "c", "1 N s/m", "jenkins", "cubic_spring"})
    CHECK(contains(text, part));
}

TEST_CASE("the data of a page is JSON, with the numbers of the curves and the rows that marks stand for") {
  const std::vector<Element> all = markup::elements(page_of_two_masses());
  const std::vector<Element> scripts = named(all, "script");
  REQUIRE(!scripts.empty());
  const auto json = nlohmann::json::parse(scripts.front().text);
  const auto& data = json["studies"][0][0];
  CHECK(data["lines"].size() == 2);
  CHECK(data["columns"][0]["label"] == "frequency (Hz)");
  CHECK(data["columns"][0]["frequency"] == true);
  CHECK(data["columns"].back()["label"] == "estimated error of the amplitude (mm)");
  CHECK(data["columns"].back()["pointOnly"] == true);
  std::vector<int> rows;
  for (const auto& line : data["lines"])
    for (const auto& mark : line["marks"]) rows.push_back(mark["row"].get<int>());
  std::sort(rows.begin(), rows.end());
  REQUIRE(!rows.empty());
  CHECK(rows.front() == 0);
  CHECK(std::adjacent_find(rows.begin(), rows.end()) == rows.end());
  const auto& first = data["lines"][0]["parts"][0]["columns"];
  CHECK(first[0][0].get<double>() == Approx(4));
  CHECK(first[0].back().get<double>() == Approx(9));
}

TEST_CASE("the same results give the same page") {
  CHECK(page_of_two_masses() == page_of_two_masses());
}

TEST_CASE("a page needs nothing from elsewhere") {
  const std::string page = page_of_two_masses();
  for (const Element& each : markup::elements(page))
    for (const auto& [name, value] : each.attributes) {
      CAPTURE(each.name, name, value);
      CHECK_FALSE(name.starts_with("on"));
      CHECK(name != "src");
      CHECK(name != "style");
      if (name == "href") CHECK(value.starts_with("#"));
    }
  CHECK(contains(page, "content=\"default-src &#39;none&#39;; script-src &#39;sha256-"));
  CHECK_FALSE(contains(page, "unsafe-"));
}

TEST_CASE("the forces of elements by formulas are next to the parameters, as text") {
  std::string json = two_masses("\"t\"", "\"a\"", "\"b\"");
  const std::string cubic = R"("type": "cubic_spring", "at": "b", "stiffness": 1000)";
  REQUIRE(contains(json, cubic));
  json.replace(json.find(cubic), cubic.size(),
               R"x("type": "formula", "at": "b", "force": "s*q^3*(q^2<1)", "parameters": {"s": 1000})x");
  const std::string page = page_of(scene_of(json));
  CHECK(contains(page, "<code>s*q^3*(q^2&lt;1)</code>"));
  CHECK_FALSE(contains(page_of(scene_of(two_masses("\"t\"", "\"a\"", "\"b\""))), "class=\"formulas\""));
}

TEST_CASE("the data of a page have motions at peaks and other points, as laws of force have them") {
  const std::string page = page_of(scene_of(two_masses("\"t\"", "\"a\"", "\"b\"")));
  const std::vector<markup::Element> all = markup::elements(page);
  const auto data = nlohmann::json::parse(markup::named(all, "script").front().text)["studies"][0][0];
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto unpacked = [&](const nlohmann::json& series) {
    const std::string text = series["of"];
    std::vector<double> values;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
      const auto step = static_cast<double>(64 * digits.find(text[i]) + digits.find(text[i + 1]));
      values.push_back((step / 4095 * 2 - 1) * series["most"].get<double>());
    }
    return values;
  };
  for (const auto& line : data["lines"]) {
    const auto& motions = line["motions"];
    REQUIRE(motions.size() >= 5);
    CHECK(motions[0]["words"] == "resonance peak");
    const double limit = 0.5 * line["set"][0].get<double>();  // friction coefficient times normal load
    for (const auto& motion : motions) {
      CHECK(motion["period"].get<double>() * motion["at"][0].get<double>() == Approx(1).epsilon(1e-6));
      const std::vector<double> x = unpacked(motion["x"]);
      const auto [least, most] = std::minmax_element(x.begin(), x.end());
      // The amplitude lies between two instants: cos(pi/40) is 0.997.
      CHECK(std::max(-*least, *most) == Approx(motion["at"][1].get<double>()).epsilon(5e-3));
      CHECK(x.front() == Approx(x.back()).margin(1e-3 * *most));
      REQUIRE(motion["loops"].size() == 1);
      CHECK(motion["loops"][0]["name"] == "d");
      CHECK_FALSE(motion["loops"][0].contains("q"));  // the element is at the response
      const std::vector<double> force = unpacked(motion["loops"][0]["f"]);
      const bool sticks = motion["at"][2].get<double>() > 99.999;
      const double largest = *std::max_element(force.begin(), force.end());
      CHECK(largest <= limit * (1 + 1e-6));
      if (!sticks) CHECK(largest == Approx(limit).epsilon(1e-3));
    }
  }
}
