// Rings of equal sectors: one sector, and all of them written out.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/format/only_fault.hpp"

#include <string>

using namespace arcslip;

namespace {

std::string with(std::string text, const std::string& piece, const std::string& replacement) {
  const std::size_t at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

const std::string sector = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "cyclic": {"sectors": 3, "engine_order": 2},
    "dofs": ["tip", "disk"],
    "masses": [{"name": "m", "at": "tip", "value": 1.24}, {"name": "md", "at": {"next": "disk"}, "value": 2}],
    "springs": [{"name": "k", "between": ["tip", "disk"], "value": 4},
                {"name": "link", "between": ["disk", {"next": "disk"}], "value": 0.5},
                {"name": "g", "direction": {"disk": 1, "tip": -0.5, "next": {"tip": -0.25}}, "value": 2}],
    "dampers": [{"name": "c", "at": "tip", "value": 0.05}]},
  "elements": [{"name": "damper", "type": "jenkins", "between": [{"next": "tip"}, "tip"], "stiffness": 2,
                "friction_coefficient": 0.5, "normal_load": 3},
               {"name": "pad", "type": "contact_2d", "tangential": {"between": ["tip", {"next": "disk"}]},
                "normal": {"at": {"next": "tip"}}, "tangential_stiffness": 1, "normal_stiffness": 1,
                "friction_coefficient": 0.3, "normal_load": 3}],
  "excitation": [{"name": "f", "at": "tip", "cosine": 1}, {"name": "h", "at": "disk", "harmonic": 2, "cosine": 1},
                 {"name": "base", "type": "base_acceleration", "harmonic": 0, "cosine": 1}],
  "ties": {"load": ["damper.normal_load", "pad.normal_load"]},
  "response": [{"name": "tip", "at": "tip"}]})";

// The same, sector for sector.
std::string written_out() {
  const std::string ties =
      R"("load": [{"repeat": 3, "name": "damper{i}.normal_load"}, {"repeat": 3, "name": "pad{i}.normal_load"}])";
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["tip1", "tip2", "tip3", "disk1", "disk2", "disk3"],
    "masses": [{"repeat": 3, "name": "m{i}", "at": "tip{i}", "value": 1.24},
               {"repeat": {"count": 3, "cyclic": true}, "name": "md{i}", "at": "disk{i+1}", "value": 2}],
    "springs": [{"repeat": 3, "name": "k{i}", "between": ["tip{i}", "disk{i}"], "value": 4},
                {"repeat": {"count": 3, "cyclic": true}, "name": "link{i}", "between": ["disk{i}", "disk{i+1}"], "value": 0.5},
                {"repeat": {"count": 3, "cyclic": true}, "name": "g{i}",
                 "direction": {"disk{i}": 1, "tip{i}": -0.5, "tip{i+1}": -0.25}, "value": 2}],
    "dampers": [{"repeat": 3, "name": "c{i}", "at": "tip{i}", "value": 0.05}]},
  "elements": [{"repeat": {"count": 3, "cyclic": true}, "name": "damper{i}", "type": "jenkins",
                "between": ["tip{i+1}", "tip{i}"], "stiffness": 2, "friction_coefficient": 0.5, "normal_load": 3},
               {"repeat": {"count": 3, "cyclic": true}, "name": "pad{i}", "type": "contact_2d",
                "tangential": {"between": ["tip{i}", "disk{i+1}"]}, "normal": {"at": "tip{i+1}"},
                "tangential_stiffness": 1, "normal_stiffness": 1, "friction_coefficient": 0.3, "normal_load": 3}],
  "excitation": [{"repeat": 3, "name": "f{i}", "at": "tip{i}", "cosine": 1, "engine_order": 2},
                 {"repeat": 3, "name": "h{i}", "at": "disk{i}", "harmonic": 2, "cosine": 1, "engine_order": 4},
                 {"repeat": 3, "name": "base{i}", "type": "base_acceleration", "harmonic": 0, "cosine": 1,
                  "direction": {"tip{i}": 1, "disk{i}": 1}}],
  "ties": {)" +
         ties + R"(}, "response": [{"repeat": 3, "name": "tip{i}", "at": "tip{i}"}]})";
}

std::string full() {
  return with(sector, "\"engine_order\": 2}", "\"engine_order\": 2, \"full\": true}");
}

void check_fault(const std::string& text, const std::string& pointer, const std::string& part) {
  CAPTURE(text);
  scene::test::check_only_fault([&] { scenes::parse(text); }, pointer, part);
}

}  // namespace

TEST_CASE("one sector is read as it is said, and written so that it is read again") {
  const scene::Scene s = scenes::parse(sector);
  CHECK(s.cyclic == scene::Cyclic{3, 2});
  CHECK(s.masses[1].directions[0] == scene::Direction{{1, 1.0, true}});
  CHECK(s.springs[1].directions[0] == scene::Direction{{1, 1.0}, {1, -1.0, true}});
  CHECK(s.springs[2].directions[0] == scene::Direction{{1, 1.0}, {0, -0.5}, {0, -0.25, true}});
  CHECK(s.elements[0].directions[0] == scene::Direction{{0, 1.0, true}, {0, -1.0}});
  CHECK(s == scenes::parse(scene::write(s)));
}

TEST_CASE("the full ring is its sector written out, with a parameter of each part for all sectors") {
  scene::Scene all = scenes::parse(full());
  CHECK(all == scenes::parse(scene::write(all)));
  scene::set(all, "k.value", 5);
  CHECK(scene::value(all, "k3.value") == 5);
  CHECK_THROWS_WITH(scene::set(all, "k3.value", 5), Catch::Contains("is given by the formula \"k.value\""));
  scene::set(all, "k.value", 4);
  scene::Scene out = scenes::parse(written_out());
  CHECK(all.constants.front() == out.constants.front());
  out.constants = all.constants;
  for (auto section :
       {&scene::Scene::masses, &scene::Scene::springs, &scene::Scene::dampers, &scene::Scene::elements})
    for (std::size_t i = 0; i < (all.*section).size(); ++i) (out.*section)[i].texts = (all.*section)[i].texts;
  CHECK(scene::write(all) == scene::write(out));
  CHECK(all == out);
}

TEST_CASE("a dof named next, an engine order beyond the sectors, and a response that need not be given") {
  const std::string text = R"({"format": "arcslip-scene-1", "structure": {
    "cyclic": {"sectors": 4, "engine_order": 9, "full": true}, "dofs": ["next"],
    "masses": [{"name": "m", "at": "next", "value": 1}],
    "springs": [{"name": "k", "at": "next", "frequency": 3},
                {"name": "q", "direction": {"next": {"next": -1}}, "value": 2}]},
    "excitation": [{"name": "f", "at": "next", "cosine": 1}]})";
  const scene::Scene s = scenes::parse(text);
  CHECK(s.dofs == std::vector<std::string>{"next1", "next2", "next3", "next4"});
  CHECK(s.response() == scene::Direction{{0, 1.0}});
  CHECK(s.springs[7].directions[0] == scene::Direction{{0, -1.0}});
  CHECK(s.excitation[1].values == std::vector<double>{0, 1});
}

TEST_CASE("mistuning multiplies values of single sectors, which are then parameters of their own") {
  const std::string factors = R"("full": true, "mistuning": {"k.value": [1, 1.5, 0.5]}})";
  scene::Scene s = scenes::parse(with(sector, "\"engine_order\": 2}", "\"engine_order\": 2, " + factors));
  CHECK(scene::value(s, "k1.value") == 4);
  CHECK(scene::value(s, "k2.value") == 6);
  CHECK(scene::value(s, "k3.value") == 2);
  CHECK_THROWS_WITH(scene::value(s, "k.value"), Catch::Contains("unknown parameter \"k.value\""));
  scene::set(s, "k2.value", 7);
  scene::set(s, "link.value", 7);
  CHECK(scene::value(s, "link2.value") == 7);
  CHECK(s == scenes::parse(scene::write(s)));
}

TEST_CASE("faults of rings are reported where the user wrote them") {
  const auto cyclic = [](const std::string& keys) {
    return with(sector, R"("sectors": 3, "engine_order": 2)", keys);
  };
  const std::string at = "/structure/cyclic";
  check_fault(cyclic(R"("engine_order": 2)"), at + "/sectors",
              "found no key \"sectors\", which is required: must be an integer from 2 to 10000");
  check_fault(cyclic(R"("sectors": 1, "engine_order": 2)"), at + "/sectors",
              "found 1, must be an integer from 2");
  check_fault(cyclic(R"("sectors": 3)"), at + "/engine_order", "found no key \"engine_order\"");
  check_fault(cyclic(R"("sectors": 3, "engine_order": 2, "full": 1)"), at + "/full", "must be true or false");
  check_fault(cyclic(R"("sectors": 3, "engine_order": 2, "mistuning": {})"), at + "/mistuning",
              "which belongs to a full ring");
  check_fault(cyclic(R"("sectors": 3, "engine_order": 2, "nodal": 1)"), at + "/nodal", "unknown key");
  check_fault(with(full(), "\"full\": true", R"("full": true, "nodal": 1)"), at + "/nodal", "unknown key");
  const auto mistuned = [](const std::string& keys) {
    return with(full(), "\"full\": true", "\"full\": true, \"mistuning\": " + keys);
  };
  check_fault(mistuned("3"), at + "/mistuning", "found 3 (a number)");
  check_fault(mistuned(R"({"kk.value": [1, 1, 1]})"), at + "/mistuning/kk.value",
              "found \"kk.value\", must be one of the numbers of the sector's parts \"m.value\"");
  check_fault(mistuned(R"({"k.value": [1, 1]})"), at + "/mistuning/k.value",
              "found a list of 2, must be a list of 3 numbers, a factor for each sector");
  check_fault(mistuned(R"({"k.value": [1, 1, "a"]})"), at + "/mistuning/k.value/2",
              "found \"a\", a formula of parameters, must be a number");
  check_fault(mistuned(R"({"k.value": [1, 1, -1e308]})"), at + "/mistuning/k.value/2",
              "found -1e+308, with which the value is too large for a number");
  check_fault(mistuned(R"({"m.value": [1, -1, 1]})"), "/structure/masses/0/value",
              "for sector = 2: found -1.24, must be at least 0 kg");
  check_fault(mistuned(R"({"damper.normal_load": [1, 2, 1]})"), "/ties/load", "must have one common value");
  check_fault(with(full(), "\"at\": \"tip\", \"value\": 0.05", "\"at\": \"top\", \"value\": 0.05"),
              "/structure/dampers/0/at", "for sector = 1, 2, 3: found \"top\"");
  check_fault(with(sector, "\"harmonic\": 2", "\"engine_order\": 2"), "/excitation/1/engine_order",
              "which belongs to repeated excitations");
  check_fault(with(full(), "\"harmonic\": 2", "\"engine_order\": 2"), "/excitation/1/engine_order", "");
  check_fault(with(sector, R"({"name": "tip", "at": "tip"})", R"({"name": "tip", "at": {"next": "tip"}})"),
              "/response/0/at", "found a place of the next sector, must be a degree of freedom by its name");
  check_fault(with(sector, R"("at": "tip", "cosine")", R"("at": {"next": "tip"}, "cosine")"),
              "/excitation/0/at", "found a place of the next sector");
  check_fault(with(sector, R"("next": {"tip": -0.25})", R"("next": {"top": -0.25})"),
              "/structure/springs/2/direction/next/top",
              "found \"top\", must be one of the degrees of freedom");
  check_fault(with(full(), "\"dofs\": [", "\"beam\": {}, \"dofs\": ["), at + "/full",
              "found true next to \"beam\", must be false");
  check_fault(with(full(), "\"ties\"", "\"patches\": [], \"ties\""), at + "/full",
              "found true next to \"patches\", must be false");
  check_fault(with(sector, "\"ties\"", R"("harmonics": {"order": 4, "period": 2}, "ties")"),
              "/harmonics/period", "found 2, must be 1 for one sector");
  check_fault(
      with(sector, "\"dampers\"", R"("damping": [{"name": "z", "type": "modal", "ratio": 0.01}], "dampers")"),
      "/structure/damping/0/type", "the modes of a ring are not those of one sector");
  check_fault(R"({"format": "arcslip-scene-1", "structure": {"dofs": ["x"],
    "masses": [{"name": "m", "at": "x", "value": 1}],
    "springs": [{"name": "k", "between": ["x", {"next": "x"}], "value": 1}, {"name": "k0", "at": "x", "value": 1}]},
    "excitation": [{"name": "f", "at": "x", "cosine": 1}]})",
              "/structure/springs/0/between/1", "belongs to masses, springs, dampers");
}

TEST_CASE(
    "a full ring of one row without a response has that of each sector, however many keys stand before it") {
  // A key that is added to the scene moves those that are there.
  const std::string one =
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["tip"],
    "cyclic": {"sectors": 3, "engine_order": 1, "full": true},
    "masses": [{"name": "m", "at": "tip", "value": 1}], "springs": [{"name": "k", "at": "tip", "value": 4}]},
    "excitation": [{"name": "f", "at": "tip", "cosine": 1}])";
  const std::vector<std::string> more = {"",
                                         R"(, "title": "t")",
                                         R"(, "ties": {})",
                                         R"(, "elements": [])",
                                         R"(, "studies": [])",
                                         R"(, "labels": {})",
                                         R"(, "harmonics": {"order": 3})"};
  std::string text = one;
  for (const std::string& key : more) {
    text += key;
    CAPTURE(text);
    const scene::Scene ring = scenes::parse(text + "}");
    CHECK(ring.dofs == std::vector<std::string>{"tip1", "tip2", "tip3"});
    CHECK(ring.masses.size() == 3);
  }
}
