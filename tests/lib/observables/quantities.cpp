// The table of quantities: what it says is what is written, limited and documented.

#include "catch.hpp"
#include "environment.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/studies/presentation/branches.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

using namespace arcslip;
using observables::Quantity;

namespace {

template <class Of>
std::string rows(std::span<const Quantity<Of>> all) {
  std::string text;
  for (const auto& each : all) {
    const auto unit = each.unit == observables::frequency_unit ? "the scene's" : each.unit;
    text.append("| `").append(each.path).append("` | ").append(unit).append(" | ").append(each.meaning) +=
        " |\n";
  }
  return text;
}

template <class Of>
std::set<std::string> paths(std::span<const Quantity<Of>> all) {
  std::set<std::string> found;
  for (const auto& each : all) found.insert(std::string(each.path));
  return found;
}

// Of all that is no object.
void add_paths(const nlohmann::json& json, const std::string& prefix, std::set<std::string>& found) {
  for (const auto& [key, value] : json.items())
    if (value.is_object())
      add_paths(value, prefix + key + ".", found);
    else
      found.insert(prefix + key);
}

}  // namespace

TEST_CASE("the documentation of results has the rows of the table of quantities") {
  std::ifstream file(source_folder() + "/docs/results.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const auto& wanted :
       {rows(observables::response_quantities()), rows(observables::stability_quantities()),
        rows(observables::mode_quantities()), rows(observables::element_quantities()),
        rows(observables::patch_quantities()), rows(observables::named_response_quantities())}) {
    INFO("the table is to be:\n" << wanted);
    CHECK(text.str().find(wanted) != std::string::npos);
  }
}

TEST_CASE("JSON has the quantities of the table, with their values, and no others") {
  auto wanted = paths(observables::response_quantities());
  const auto of_element = paths(observables::element_quantities());
  CHECK(wanted.size() == observables::response_quantities().size());
  CHECK(of_element.size() == observables::element_quantities().size());

  std::set<std::string> found, found_of_elements;
  enum { damper_alone, with_spring, with_contact };
  for (const int kind : {damper_alone, with_spring, with_contact}) {
    scene::Scene s = scenes::paper(5, 3);
    const scene::Direction x = s.elements[0].directions[0];
    if (kind == damper_alone) s.elements[0].wear_coefficient = 1e-12;
    if (kind == with_spring) s.elements.push_back({"h", &elements::cubic_spring(), {x}, {1e6}, 1});
    if (kind == with_contact)
      s.elements.push_back({"c", &elements::contact_2d(), {x, x}, {1e3, 1e3, 0.3, 1}, 1});
    const auto branches = observables::frequency_response(s, scenes::window(s));
    std::stringstream text;
    results::write_json(text, studies::results_of(s, branches));
    const auto branch = nlohmann::json::parse(text.str())["branches"][0];
    REQUIRE(branch["events"].size() == branches[0].events.size());
    REQUIRE_FALSE(branch["events"].empty());
    for (std::size_t i = 0; i < branches[0].events.size(); ++i) {
      auto json = branch["events"][i];
      const auto& point = branches[0].events[i].point;
      for (const auto& each : observables::response_quantities()) {
        const auto* get = std::get_if<observables::ResponseQuantity::Number>(&each.get);
        std::string pointer = "/" + std::string(each.path);
        std::replace(pointer.begin(), pointer.end(), '.', '/');
        CAPTURE(pointer);
        if (each.has && !each.has(point))
          CHECK_FALSE(json.contains(nlohmann::json::json_pointer(pointer)));
        else if (get && each.unit != observables::frequency_unit)
          CHECK(json[nlohmann::json::json_pointer(pointer)] == (*get)(point));
      }
      for (const auto& element : json["elements"]) add_paths(element, "", found_of_elements);
      for (const char* other : {"elements", "kind", "nonsmooth", "located", "after", "location_estimate"})
        json.erase(other);
      add_paths(json, "", found);
    }
  }
  wanted.erase("unbounded");
  CHECK(found == wanted);
  CHECK(found_of_elements == of_element);
}

TEST_CASE("responses that a scene names have columns of their own, each as if it were followed") {
  scene::Scene s = scenes::chain(5, true);
  const scene::Direction c = s.response(), a = {{0, 1.0}}, between = {{0, 1.0}, {1, -1.0}};
  s.responses = {{"tip", c}, {"root", a}, {"stretch", between}};
  const auto branches = observables::frequency_response(s, scenes::window(s));
  std::stringstream text;
  results::write_json(text, studies::results_of(s, branches));
  const auto json = nlohmann::json::parse(text.str())["branches"][0];
  REQUIRE(json["points"].size() > 20);
  REQUIRE_FALSE(json["events"].empty());
  for (const auto& list : {json["points"], json["events"]})
    for (const auto& point : list) {
      CHECK(point["responses"].size() == 3);
      for (const char* each : {"amplitude", "phase"})  // up to the order of sums
        CHECK(point["responses"]["tip"][each].get<double>() ==
              Approx(point[each].get<double>()).epsilon(1e-13).margin(1e-14));
    }
  const double omega = json["points"][0]["frequency"];
  for (const auto& [name, direction] : {std::pair("root", a), std::pair("stretch", between)}) {
    scene::Scene followed = s;
    followed.responses = {{"", direction}};
    const auto alone = scenes::response_at(followed, omega);
    CHECK(alone.responses.empty());
    CHECK(json["points"][0]["responses"][name]["amplitude"].get<double>() ==
          Approx(alone.amplitude).epsilon(1e-10));
    CHECK(json["points"][0]["responses"][name]["phase"].get<double>() == Approx(alone.phase).epsilon(1e-10));
  }
}

TEST_CASE("the parameter of a study has no name by which points have a quantity") {
  std::vector<observables::ResponseQuantity> all(observables::response_quantities().begin(),
                                                 observables::response_quantities().end());
  all.insert(all.end(), observables::mode_quantities().begin(), observables::mode_quantities().end());
  for (const auto& each : all) {
    const std::string_view top = each.path.substr(0, each.path.find('.'));
    if (top == "frequency") continue;  // which no parameter of a scene is called
    CAPTURE(std::string(top));
    INFO("\"" << top << "\" is to be one of result_names in scene/keys/enum_words.hpp");
    CHECK(std::count(scene::file::result_names.begin(), scene::file::result_names.end(), top) == 1);
  }
}

TEST_CASE("a path that is none is refused") {
  CHECK_THROWS_WITH(observables::response_quantity("amplitud"), "no quantity \"amplitud\"");
  CHECK(observables::response_quantity("maxima.velocity").unit == "m/s");
  CHECK(observables::element_quantity("energy").unit == "J");
}

TEST_CASE("points of a curve of peaks tell how far the harmonics left out move their frequency") {
  scene::Scene s = scenes::paper(5, 3);
  const auto curves = observables::resonance_peaks(
      s, {.over = "damper.normal_load", .from = 2, .to = 4, .frequency_from = 18, .frequency_to = 22});
  std::stringstream text;
  results::write_json(text, studies::results_of(s, curves));
  const auto points = nlohmann::json::parse(text.str())["branches"][0]["points"];
  REQUIRE(points.size() > 5);
  const auto peak = [](const scene::Scene& scene) {
    const auto branches = observables::frequency_response(scene, scenes::window(scene));
    for (const auto& event : branches[0].events)
      if (event.kind == "peak") return event.point.omega;
    return 0.0;
  };
  for (const auto& point : {points.front(), points.back()}) {
    scene::set(s, "damper.normal_load", point["damper.normal_load"]);
    s.harmonics.order = 5;
    const double few = peak(s);
    CHECK(std::abs(few - point["omega"].get<double>()) < 1e-8 * few);
    s.harmonics.order = 101;
    CHECK(point["location_estimate"].get<double>() == Approx(std::abs(peak(s) - few)).epsilon(0.3));
  }
}
