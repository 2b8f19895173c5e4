// Names and titles of strangers in a page.

#include "catch.hpp"
#include "contains.hpp"
#include "lib/report/page_of.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

using namespace report_test;
using markup::Element;
using Json = nlohmann::json;

namespace {

/// What tries to become markup or script, alone and in its neighbourhood: a hundred.
std::vector<std::string> hostile_names() {
  const std::vector<std::string> cores{"</script><script>alert(1)</script>",
                                       "<img src=x onerror=alert(1)>",
                                       "\" onmouseover=\"alert(1)",
                                       "' onmouseover='alert(1)",
                                       "</style><style>*{display:none}",
                                       "</title><body onload=alert(1)>",
                                       "<!--<script>",
                                       "--></script>",
                                       "]]><svg/onload=alert(1)>",
                                       "javascript:alert(1)",
                                       "&lt;script&gt;alert(1)&lt;/script&gt;",
                                       "&#60;img src=x onerror=alert(1)&#62;",
                                       "</td></tr></table><iframe src=//x>",
                                       "\\u003cscript\\u003e",
                                       "\\\"><script>",
                                       "`${alert(1)}`",
                                       "a\u2028alert(1)\u2029",
                                       "\u202egnp.exe",
                                       "<a href=\"data:text/html,x\">",
                                       "{{constructor.constructor('alert(1)')()}}"};
  std::vector<std::string> all;
  for (const std::string& core : cores)
    for (const char* before : {"", "x", "\"", "'>", "</text></svg>"}) all.push_back(before + core);
  return all;
}

/// What a study may be called, since files are.
std::string without_slashes(std::string name) {
  for (const char slash : {'/', '\\'}) std::replace(name.begin(), name.end(), slash, '|');
  return name;
}

std::string quoted(const std::string& text) {
  return Json(text).dump();
}

/// How many elements of each name, and which attributes.
std::map<std::string, int> shape_of(const std::vector<Element>& all) {
  std::map<std::string, int> shape;
  for (const Element& each : all) {
    ++shape[each.name];
    for (const auto& [name, value] : each.attributes) ++shape[each.name + " " + name];
  }
  return shape;
}

}  // namespace

TEST_CASE("a hundred hostile names and titles become no markup and no script") {
  const std::map<std::string, int> harmless =
      shape_of(markup::elements(page_of(scene_of(two_masses("\"t\"", "\"a\"", "\"b\"")))));
  int taken = 0;
  for (const std::string& name : hostile_names()) {
    CAPTURE(name);
    const std::string study = quoted(without_slashes(name));
    std::string page;
    try {
      page = page_of(scene_of(two_masses(quoted(name), quoted(name + "1"), quoted(name + "2"), study)));
      ++taken;
    } catch (const scene::SceneError&) {  // no name of a part: a title alone
      page = page_of(scene_of(two_masses(quoted(name), "\"a\"", "\"b\"")));
    }
    std::vector<Element> all;
    REQUIRE_NOTHROW(all = markup::elements(page));
    CHECK(shape_of(all) == harmless);
    CHECK_FALSE(contains(page, "\u2028"));
    CHECK_FALSE(contains(page, "\u202e"));
    const std::vector<Element> data = markup::named(all, "script");
    CHECK(data.front().text.find('<') == std::string::npos);
    CHECK_NOTHROW(Json::parse(data.front().text));
  }
  CHECK(hostile_names().size() == 100);
  CHECK(taken > 20);
}

TEST_CASE("a hostile name is shown as it is") {
  const std::string name = "<img src=x onerror=alert(1)>\"'&amp;";
  const std::string page = page_of(scene_of(two_masses(quoted(name), "\"a\"", "\"b\"")));
  const std::vector<Element> all = markup::elements(page);
  CHECK(markup::named(all, "h1").front().text == name);
  CHECK(markup::named(all, "title").front().text == name);
}
