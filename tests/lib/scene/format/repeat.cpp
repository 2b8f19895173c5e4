// Entries over an index, next to the same scenes written out and the closed form of waves around a ring.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/format/bad_scenes.hpp"
#include "lib/scene/format/read_text.hpp"

#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/scene/format/repeat.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>

using namespace arcslip;
using scene::test::faults_of;
using std::numbers::pi;

namespace {

constexpr int blades = 12;

// Twelve blades on a ring of springs, with friction between neighbours.
const std::string ring = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
  "structure": {
    "dofs": [{"repeat": 12, "name": "blade{i}"}],
    "masses": [{"repeat": 12, "name": "m{i}", "at": "blade{i}", "value": 1.24, "comment": "{tuned"}],
    "springs": [{"repeat": 12, "name": "k{i}", "at": "blade{i}",
                 "value": {"each": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12.5]}},
                {"name": "extra", "between": ["blade1", "blade7"], "value": 0.1},
                {"repeat": {"count": 12, "index": "n", "cyclic": true}, "name": "disk{n}",
                 "direction": {"blade{n-1}": -0.5, "blade{n}": 1, "blade{n+14}": -0.5}, "value": 0.4}],
    "dampers": [{"repeat": 12, "name": "c{i}", "at": "blade{i}", "value": 0.05}]},
  "elements": [{"repeat": {"count": 12, "cyclic": true}, "name": "damper{i}", "type": "jenkins",
                "between": ["blade{i}", "blade{i+1}"], "stiffness": 2, "friction_coefficient": 0.5,
                "normal_load": 3},
               {"repeat": 2, "name": "pad{i}", "type": "contact_2d", "tangential": {"at": "blade{i}"},
                "normal": {"at": "blade{i+2}"}, "tangential_stiffness": 1, "normal_stiffness": 1,
                "friction_coefficient": 0.3, "normal_load": {"each": [1, 2]}, "offset": {"each": ["static", "centred"]}}],
  "excitation": [{"repeat": 12, "name": "force{i}", "at": "blade{i}", "cosine": 1}],
  "ties": {"load": [{"repeat": 12, "name": "damper{i}.normal_load"}],
           "damping": ["c1.value", {"repeat": 11, "name": "c{i+1}.value"}]},
  "response": [{"repeat": 12, "name": "blade{i}", "at": "blade{i}"}]})";

std::string n(int i) {
  return std::to_string(i);
}

std::string b(int i) {
  return "\"blade" + n((i - 1 + blades) % blades + 1) + '"';
}

// A list over the blades, without its brackets.
template <class Item>
std::string over(int count, const Item& item) {
  std::string text;
  for (int i = 1; i <= count; ++i) text += (i == 1 ? "" : ", ") + item(i);
  return text;
}

// The ring, blade for blade.
std::string written_out() {
  const auto at = [](const std::string& name, const std::string& value) {
    return over(blades, [&](int i) {
      return "{\"name\": \"" + name + n(i) + "\", \"at\": " + b(i) + ", " + value + "}";
    });
  };
  const auto stiffness = [](int i) {
    return "{\"name\": \"k" + n(i) + "\", \"at\": " + b(i) + ", \"value\": " + (i == 12 ? "12.5" : n(i)) +
           "}";
  };
  const auto disk = [](int i) {
    return "{\"name\": \"disk" + n(i) + "\", \"direction\": {" + b(i - 1) + ": -0.5, " + b(i) + ": 1, " +
           b(i + 2) + ": -0.5}, \"value\": 0.4}";
  };
  const auto damper = [](int i) {
    return "{\"name\": \"damper" + n(i) + "\", \"type\": \"jenkins\", \"between\": [" + b(i) + ", " +
           b(i + 1) + R"(], "stiffness": 2, "friction_coefficient": 0.5, "normal_load": 3})";
  };
  const std::string pads = R"(
    {"name": "pad1", "type": "contact_2d", "tangential": {"at": "blade1"}, "normal": {"at": "blade3"},
     "tangential_stiffness": 1, "normal_stiffness": 1, "friction_coefficient": 0.3, "normal_load": 1,
     "offset": "static"},
    {"name": "pad2", "type": "contact_2d", "tangential": {"at": "blade2"}, "normal": {"at": "blade4"},
     "tangential_stiffness": 1, "normal_stiffness": 1, "friction_coefficient": 0.3, "normal_load": 2})";
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)" +
         over(blades, b) + "], \"masses\": [" + at("m", "\"value\": 1.24") + "], \"springs\": [" +
         over(blades, stiffness) + R"(, {"name": "extra", "between": ["blade1", "blade7"], "value": 0.1}, )" +
         over(blades, disk) + "], \"dampers\": [" + at("c", "\"value\": 0.05") + "]}, \"elements\": [" +
         over(blades, damper) + "," + pads + "], \"excitation\": [" + at("force", "\"cosine\": 1") +
         "], \"ties\": {\"load\": [" +
         over(blades, [](int i) { return "\"damper" + n(i) + ".normal_load\""; }) + "], \"damping\": [" +
         over(blades, [](int i) { return "\"c" + n(i) + ".value\""; }) + "]}, \"response\": [" +
         over(blades, [](int i) { return "{\"name\": " + b(i) + ", \"at\": " + b(i) + "}"; }) + "]}";
}

std::string with(std::string text, const std::string& piece, const std::string& replacement) {
  const std::size_t at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

}  // namespace

TEST_CASE("a ring said with entries over an index is the ring written out") {
  const scene::Scene brief = scenes::parse(ring);
  CHECK(scene::write(brief) == scene::write(scenes::parse(written_out())));
  CHECK(brief == scenes::parse(written_out()));
  CHECK(brief == scenes::parse(scene::write(brief)));
}

TEST_CASE("a chain of fifty masses has 49 links") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "structure": {
    "dofs": [{"repeat": 50, "name": "x{i}"}],
    "masses": [{"repeat": 50, "name": "m{i}", "at": "x{i}", "value": 1}],
    "springs": [{"name": "wall", "at": "x1", "value": 1000},
                {"repeat": 49, "name": "k{i}", "between": ["x{i}", "x{i+1}"], "value": 1000}]},
    "excitation": [{"name": "force", "at": "x50", "cosine": 1}], "response": {"at": "x50"}})");
  REQUIRE(s.dofs.size() == 50);
  REQUIRE(s.springs.size() == 50);
  for (int i = 1; i <= 49; ++i) {
    const scene::Part& link = s.springs[static_cast<std::size_t>(i)];
    CHECK(link.name == "k" + n(i));
    CHECK(link.directions.front() == scene::Direction{{i - 1, 1.0}, {i, -1.0}});
  }
}

// On a tuned ring a force that travels around it excites the waves of its nodal diameter alone: each blade
// moves with the amplitude A/|k + 4 q sin^2(pi m/N) + i w c - w^2 m0|, and lags behind the blade before it by
// 2 pi m/N.
TEST_CASE("an engine order excites its nodal diameter alone, with the amplitude of the closed form") {
  constexpr double mass = 1.24, k = 1, q = 0.4, c = 0.05, w = 1.1;
  for (const int order : {0, 1, 3, 6, 7, 11, 12, 15, -3, -1}) {
    CAPTURE(order);
    const scene::Scene s =
        scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
      "dofs": [{"repeat": 12, "name": "x{i}"}],
      "masses": [{"repeat": 12, "name": "m{i}", "at": "x{i}", "value": 1.24}],
      "springs": [{"repeat": 12, "name": "k{i}", "at": "x{i}", "value": 1},
                  {"repeat": {"count": 12, "cyclic": true}, "name": "q{i}", "between": ["x{i}", "x{i+1}"], "value": 0.4}],
      "dampers": [{"repeat": 12, "name": "c{i}", "at": "x{i}", "value": 0.05}]},
      "excitation": [{"repeat": 12, "name": "f{i}", "at": "x{i}", "cosine": 0.3, "sine": -0.4, "engine_order": )" +
                      n(order) + R"(}], "harmonics": {"order": 1},
      "response": [{"repeat": 12, "name": "blade{i}", "at": "x{i}"}]})");
    const auto found = observables::point_responses(s, {.frequency = w});
    REQUIRE(found.size() == 1);
    const auto& motions = found[0].point.responses;
    REQUIRE(motions.size() == blades);
    const double wave = std::sin(pi * order / blades);
    const double amplitude =
        0.5 / std::abs(std::complex<double>(k + 4 * q * wave * wave - mass * w * w, w * c));
    for (int d = 0; d < blades; ++d) {  // waves in the direction of ascending i
      std::complex<double> of_diameter = 0;
      for (int i = 0; i < blades; ++i)
        of_diameter += std::polar(motions[static_cast<std::size_t>(i)].amplitude / blades,
                                  2 * pi * d * i / blades - motions[static_cast<std::size_t>(i)].phase);
      const bool excited = (order - d) % blades == 0;
      CHECK(std::abs(std::abs(of_diameter) - (excited ? amplitude : 0)) < 1e-13 * amplitude);
    }
  }
}

TEST_CASE("quarters of a turn are exact, and a ground may move as an engine order, too") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "structure": {
    "dofs": [{"repeat": 4, "name": "x{i}"}], "masses": [{"repeat": 4, "name": "m{i}", "at": "x{i}", "value": 1}],
    "springs": [{"repeat": 4, "name": "k{i}", "at": "x{i}", "value": 1}]},
    "excitation": [{"repeat": 4, "name": "f{i}", "type": "base_acceleration", "at": "x{i}", "engine_order": -1,
                    "cosine": {"each": [1, 2, 3, 4]}, "sine": 5}],
    "response": {"at": "x1"}})");
  const std::vector<std::vector<double>> expected = {{1, 5}, {5, -2}, {-3, -5}, {-5, 4}};
  for (std::size_t i = 0; i < 4; ++i) CHECK(s.excitation[i].values == expected[i]);
}

TEST_CASE(
    "faults of repeated entries are reported at the entry, with the index, and once where they are the "
    "same") {
  const auto one = [](const std::string& text) {
    const auto faults = faults_of(text);
    REQUIRE(faults.size() == 1);
    return faults[0];
  };
  SECTION("a link beyond the end of a chain, behind an entry that is not repeated") {
    const auto fault =
        one(with(ring, R"({"name": "extra", "between": ["blade1", "blade7"], "value": 0.1})",
                 R"({"repeat": 12, "name": "e{i}", "between": ["blade{i}", "blade{i+1}"], "value": 1})"));
    CHECK(fault.pointer == "/structure/springs/1/between/1");
    CHECK(fault.message.starts_with("for i = 12: found \"blade13\", must be one of the degrees of freedom"));
  }
  SECTION("the same in every copy") {
    const auto fault = one(with(ring, "\"value\": 0.05", "\"value\": -0.05"));
    CHECK(fault.pointer == "/structure/dampers/0/value");
    CHECK(fault.message == "for i = 1, 2, 3 and 9 more: found -0.05, must be at least 0 N s/m");
  }
  SECTION("a wrong name in every copy, which differs") {
    const auto fault = one(with(ring, "[\"blade{i}\", \"blade{i+1}\"]", "[\"blade{i}\", \"blad{i+1}\"]"));
    CHECK(fault.pointer == "/elements/0/between/1");
    CHECK(fault.message.starts_with("for i = 1, 2, 3 and 9 more: found \"blad2\", must be one of"));
  }
  SECTION("two faults at one place of each copy") {
    const auto faults = faults_of(with(ring, "\"disk{n}\"", "\"disk{n}\", \"at\": 3, \"cc\": 1"));
    REQUIRE(faults.size() == 2);
    CHECK(faults[0].pointer == "/structure/springs/2/cc");
    CHECK(faults[1].pointer == "/structure/springs/2");
    CHECK(faults[1].message.starts_with("for n = 1, 2, 3 and 9 more: found \"at\", \"direction\" together"));
  }
  SECTION("one value of a list") {
    const auto fault = one(with(ring, "{\"each\": [1, 2]}", "{\"each\": [1, true]}"));
    CHECK(fault.pointer == "/elements/1/normal_load");
    CHECK(fault.message == "for i = 2: found true, must be a finite number (N)");
  }
  SECTION("a name without the index") {
    const auto fault = one(with(ring, "\"name\": \"m{i}\"", "\"name\": \"m\""));
    CHECK(fault.pointer == "/structure/masses/0/name");
    CHECK(fault.message ==
          "for i = 2, 3, 4 and 8 more: found the name \"m\" again, which is also at /structure/masses/0/name "
          "for "
          "i = 1; "
          "parts and constants must have different names");
  }
  SECTION("nothing acts on some degrees of freedom") {
    const auto fault = one(
        with(ring, "{\"repeat\": 12, \"name\": \"blade{i}\"}", R"("a", {"repeat": 12, "name": "blade{i}"})"));
    CHECK(fault.pointer == "/structure/dofs/0");
    CHECK(fault.message.starts_with("found nothing that acts on \"a\""));
    const auto more =
        one(with(ring, "[{\"repeat\": 12, \"name\": \"blade", "[{\"repeat\": 13, \"name\": \"blade"));
    CHECK(more.pointer == "/structure/dofs/0");
    CHECK(more.message.starts_with("for i = 13: found nothing that acts on \"blade13\""));
  }
  SECTION("a member of a tie") {
    const auto fault = one(with(ring, "{\"repeat\": 11, \"name\": \"c{i+1}.value\"}",
                                "{\"repeat\": 12, \"name\": \"c{i+1}.value\"}"));
    CHECK(fault.pointer == "/ties/damping/1");
    CHECK(fault.message.starts_with("for i = 12: found \"c13.value\", must be one of the parameters"));
  }
  SECTION("a response twice") {
    const auto fault =
        one(with(ring, "\"response\": [", R"("response": [{"name": "blade4", "at": "blade4"}, )"));
    CHECK(fault.pointer == "/response/1/name");
    CHECK(fault.message.starts_with("for i = 4: found the name \"blade4\" again"));
  }
}

TEST_CASE("all repeated entries together are bounded in values and in text") {
  std::string numbers;
  for (int i = 0; i < 300; ++i) numbers += "[" + n(i) + ", 1], ";
  const auto with_dofs = [](const std::string& entry) {
    return faults_of(
        scene::test::good_scene_with("\"response\"", "\"ties\": {\"t\": [" + entry + "]}, \"response\""));
  };
  const auto values = faults_of(scene::test::good_scene_with(
      "\"elements\": [", R"("elements": [{"repeat": 10000, "name": "p{i}", "type": "piecewise_linear_spring",
      "at": "a", "table": [)" +
                             numbers + "[300, 1]]}, "));
  REQUIRE(values.size() == 1);
  CHECK(values[0].pointer.starts_with("/elements/0/table/"));
  CHECK(values[0].message.starts_with("found copies of more than 5000000 values or 64 MB of text"));
  const auto text = with_dofs(R"({"repeat": 10000, "name": ")" + std::string(10'000, 'x') + "{i}\"}");
  REQUIRE(text.size() == 1);
  CHECK(text[0].pointer == "/ties/t/0/name");
}
