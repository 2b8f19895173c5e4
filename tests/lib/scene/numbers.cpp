// Numbers of scenes that are texts: units, and formulas of other parameters.
#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/unit.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "lib/scene/format/read_text.hpp"

using namespace arcslip::scene;
using namespace arcslip::scene::test;

namespace {

std::optional<double> converted(const std::string& text, const char* wanted) {
  const auto quantity = split_quantity(text);
  const auto unit = quantity ? unit_of(quantity->unit) : std::nullopt;
  return unit ? value_in(quantity->number, *unit, *unit_of(wanted)) : std::nullopt;
}

// Springs of 47 Hz and a damper in proportion to them.
std::string oscillator(const std::string& more = "") {
  return R"x({"format": "arcslip-scene-2",
    "constants": {"ratio": 0.12, "f0": "47 Hz", "limit": {"value": "3 N", "bounds": [0.1, 20], "help": "of friction"})x" +
         more + R"x(},
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": "800 g"}],
      "springs": [{"name": "k", "at": "x", "value": "m*(2*pi*f0)^2"}],
      "dampers": [{"name": "c", "at": "x", "value": "2*0.0015*sqrt(k*m)"}]},
    "elements": [{"name": "damper", "type": "jenkins", "at": "x", "stiffness": "ratio*k",
      "normal_load": "limit/damper.friction_coefficient", "friction_coefficient": 0.3}],
    "excitation": [{"name": "force", "at": "x", "cosine": "2000 mN"}],
    "studies": [{"kind": "frf", "from": "30 Hz", "to": "0.07 kHz"},
                {"kind": "trace", "over": "limit", "from": 1, "to": 4, "frequency": 47}]})x";
}

}  // namespace

TEST_CASE("a number with a unit is the number that it is in SI units, to the last digit") {
  CHECK(converted("0.2 mm", "m") == 0.0002);
  CHECK(converted("0.1um", "m") == 1e-7);
  CHECK(converted("0.3 \u00b5m", "m") == 3e-7);
  CHECK(converted("1.2e5 N/m", "N/m") == 1.2e5);
  CHECK(converted("3 kN/mm", "N/m") == 3e6);
  CHECK(converted("12 N s/mm", "N s/m") == 12e3);
  CHECK(converted("210 GPa", "N/m^2") == 210e9);
  CHECK(converted("7.85 g/cm^3", "kg/m^3") == 7850);
  CHECK(converted("7.85 t/m\u00b3", "kg/m^3") == 7850);
  CHECK(converted("15 %", "-") == 0.15);
  CHECK(converted("2 J/(m^2 s)", "W/m^2") == 2);
  CHECK(converted("3e-13 mm^3/(N mm)", "m^3/J") == 3e-19);
  CHECK(converted("-4 mN", "N") == -0.004);
  CHECK(converted("48.4 Hz", "Hz") == 48.4);
  CHECK(*converted("48.4 Hz", "rad/s") == Approx(48.4 * 2 * std::numbers::pi).epsilon(1e-15));
  CHECK(*converted("3000 rpm", "Hz") == Approx(50).epsilon(1e-15));
  CHECK(*converted("360 deg/s", "Hz") == Approx(1).epsilon(1e-15));
  CHECK(converted("2 min", "s") == 120);
}

TEST_CASE("what is no number with that unit") {
  for (const char* text : {"3", "N", "3*k", "3 + 2", "3/m", "", "k", "- 3 N", "nan N", "inf m", "3e999 m"}) {
    CAPTURE(text);
    CHECK_FALSE(split_quantity(text));
  }
  for (const char* unit :
       {"", "parsec", "N m/s m", "mmm", "kkg", "m^", "m^0", "m^99", "N/", "/s", "N/(m", "km%"}) {
    CAPTURE(unit);
    CHECK_FALSE(unit_of(unit));
  }
  CHECK_FALSE(converted("3 kg", "N"));
  CHECK_FALSE(converted("3 Hz", "1/s"));  // which would be 3 or 6 pi
  CHECK_FALSE(converted("3 1/s", "Hz"));
  CHECK_FALSE(converted("1e300 Gm", "m"));
  CHECK(coherent_text(*unit_of("kN/mm")) == "N/m");
  CHECK(coherent_text(*unit_of("kg^2 m/s^4")) == "kg^2 m/s^4");
  CHECK(coherent_text(*unit_of("%")) == "-");
  CHECK(coherent_text(*unit_of("rpm")) == "Hz");
  CHECK(coherent_text(*unit_of("deg/s")) == "rad/s");
}

TEST_CASE("formulas give numbers in the order in which they follow each other") {
  const Scene scene = read_text(oscillator());
  const double k = 0.8 * std::pow(2 * std::numbers::pi * 47, 2);
  CHECK(scene.springs[0].values[0] == Approx(k).epsilon(1e-15));
  CHECK(scene.dampers[0].values[0] == Approx(0.003 * std::sqrt(k * 0.8)).epsilon(1e-15));
  CHECK(value(scene, "damper.stiffness") == Approx(0.12 * k).epsilon(1e-15));
  CHECK(value(scene, "damper.normal_load") == 3 / 0.3);
  CHECK(value(scene, "k") == value(scene, "k.value"));
  CHECK(scene.excitation[0].values[0] == 2);
  CHECK(scene.masses[0].values[0] == 0.8);
  CHECK(parameter_formula(scene, "k")->parameters == std::vector<std::string>{"m.value", "f0"});
  CHECK(parameter_formula(scene, "m") == nullptr);
}

TEST_CASE("a scene with formulas is written as it was given, and read again") {
  const Scene scene = read_text(oscillator());
  const std::string text = write(scene);
  CHECK(text.find("\"value\": \"m*(2*pi*f0)^2\"") != std::string::npos);
  CHECK(text.find("\"value\": \"800 g\"") != std::string::npos);
  CHECK(text.find("\"limit\": {\"value\": \"3 N\", \"unit\": \"N\", \"bounds\": [0.1, 20]") !=
        std::string::npos);
  CHECK(read_text(text) == scene);
  CHECK(hash(read_text(text)) == hash(scene));
  CHECK_NOTHROW(check(scene));
}

TEST_CASE("numbers follow a parameter that is set") {
  Scene scene = read_text(oscillator());
  set(scene, "m", 1);
  const double k = std::pow(2 * std::numbers::pi * 47, 2);
  CHECK(value(scene, "k") == Approx(k).epsilon(1e-15));
  CHECK(value(scene, "damper.stiffness") == Approx(0.12 * k).epsilon(1e-15));
  CHECK(scene.masses[0].texts[0].text.empty());
  set(scene, "limit", 6);
  CHECK(value(scene, "damper.normal_load") == 20);
  CHECK(read_text(write(scene)) == scene);
}

TEST_CASE("what cannot be set leaves the scene as it is") {
  const Scene scene = read_text(oscillator());
  const auto refused = [&](const char* parameter, double value, const std::string& message) {
    Scene other = scene;
    CAPTURE(parameter, value);
    CHECK_THROWS_WITH(set(other, parameter, value), Catch::Matchers::Contains(message));
    CHECK(other == scene);
  };
  refused("k", 3,
          "parameter \"k.value\" is given by the formula \"m*(2*pi*f0)^2\", must be set by what it follows: "
          "\"m.value\", \"f0\"");
  refused("limit", 30, "found 30, must be at least 0.1 and at most 20 N");
  refused("ratio", -1, "\"damper.stiffness\", which is \"ratio*k\", would be out of its bounds: found -");
  refused("damper.friction_coefficient", 0,
          "which is \"limit/damper.friction_coefficient\", would be out of its");
  refused("f", 0, "unknown parameter \"f\"");
}

TEST_CASE("a text in code is a formula, or a number with a unit") {
  Scene scene = read_text(oscillator());
  set_text(scene, "damper.stiffness", "0.5*k");
  CHECK(value(scene, "damper.stiffness") == 0.5 * value(scene, "k"));
  set_text(scene, "damper.stiffness", "12 kN/m");
  CHECK(value(scene, "damper.stiffness") == 12000);
  set_text(scene, "damper.stiffness", "2*pi");
  CHECK(value(scene, "damper.stiffness") == 2 * std::numbers::pi);
  set_text(scene, "k", "12 kN/m");
  CHECK(value(scene, "c") == Approx(0.003 * std::sqrt(12e3 * 0.8)).epsilon(1e-15));
  CHECK(read_text(write(scene)) == scene);
  const Scene before = scene;
  for (const auto& [text, message] : {std::pair{"limit", "which is N, must be kg"},
                                      {"3 N", "must be in a unit of the same dimension as kg"},
                                      {"3 kgg", "found the unknown unit \"kgg\""},
                                      {"-1", "which is -1, must be at least 0 kg"},
                                      {"m", "which follows itself"}}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(set_text(scene, "m", text), Catch::Matchers::Contains(message));
    CHECK(scene == before);
  }
  set_text(scene, "k", "1e4*m");
  CHECK_THROWS_WITH(set_text(scene, "m", "k/1e4"), Catch::Matchers::Contains("which follows itself"));
}

TEST_CASE("studies name parameters that are not given by formulas, a part for its value") {
  const Scene scene = read_text(oscillator());
  CHECK(parameter_field(scene, "limit").unit == "N");
  CHECK(parameter_field(scene, "ratio").lower == -infinity);
  std::string over_k = oscillator();
  over_k.replace(over_k.find("\"over\": \"limit\""), 15, "\"over\": \"k\"");
  CHECK_THROWS_WITH(
      read_text(over_k),
      Catch::Matchers::Contains("/studies/1/over: found \"k.value\", which is given by the formula "
                                "\"m*(2*pi*f0)^2\"; must be what that follows: \"m.value\", \"f0\""));
  std::string over_m = oscillator();
  over_m.replace(over_m.find("\"over\": \"limit\""), 15, "\"over\": \"m\"");
  CHECK(write(read_text(over_m)).find("\"over\": \"m.value\"") != std::string::npos);
}

TEST_CASE("dimensions of formulas, as far as they are known") {
  using arcslip::formula::Formula;
  const std::vector<std::string_view> names = {"m", "k", "c", "w", "x", "any"};
  const std::vector<std::string> units = {"kg", "N/m", "N s/m", "rad/s", "m", ""};
  const auto fault = [&](const std::string& text, const char* wanted) {
    return dimension_fault(Formula(std::span(&text, 1), arcslip::formula::names_of(names)), units, wanted);
  };
  for (const auto& [text, wanted] : {std::pair{"m*w^2", "N/m"},
                                     {"sqrt(k/m)", "rad/s"},
                                     {"k^0.5*m^0.5", "N s/m"},
                                     {"c*w/k", "-"},
                                     {"0.12*m", "N/m"},  // a plain number may have any unit
                                     {"k + any", "N/m"},
                                     {"max(k, 3)", "N/m"},
                                     {"sin(w*m/c)", "-"},
                                     {"exp(-c/(m*w))", "-"},
                                     {"if(x > 0.1, k, 2*k)", "N/m"},
                                     {"hypot(k, m*w^2)", "N/m"},
                                     {"abs(-k)", "N/m"},
                                     {"sign(x)", "-"},
                                     {"m*w^2/2*x^2", "J"},
                                     {"x^any", "kg"}}) {
    CAPTURE(text, wanted);
    CHECK(fault(text, wanted).empty());
  }
  CHECK(fault("m*w", "N/m") == "which is N s/m, must be N/m");
  CHECK(fault("k - c", "N/m") == "which adds or compares N/m and N s/m");
  CHECK(fault("sin(x)", "-") == "which has a function of m");
  CHECK(fault("2^x", "-") == "which has an exponent in m");
  CHECK(fault("if(k < m, x, x)", "m") == "which compares N/m and kg");
  CHECK(fault("if(w > 3, k, m)", "N/m") == "which chooses between N/m and kg");
  CHECK(fault("k/k", "m") == "which is a pure number, must be m");
  CHECK(fault("sqrt(m)", "m") == "which is another dimension, must be m");
}

TEST_CASE("turns and radians are kept apart where formulas give frequencies") {
  const auto with = [](const std::string& f0, const std::string& from) {
    std::string text = oscillator();
    text.replace(text.find("\"47 Hz\""), 7, '"' + f0 + '"');
    return text.replace(text.find("\"30 Hz\""), 7, '"' + from + '"');
  };
  CHECK(value(read_text(with("2820 rpm", "30 Hz")), "f0") == Approx(47).epsilon(1e-15));
  CHECK_NOTHROW(read_text(with("47 Hz", "f0")));
  CHECK_THROWS_WITH(read_text(with("47 rad/s", "f0")), Catch::Matchers::Contains("which is 1/s, must be Hz"));
  CHECK_THROWS_WITH(read_text(with("47 Hz", "sqrt(k/m)")),
                    Catch::Matchers::Contains("which is 1/s, must be Hz"));
}

TEST_CASE("what follows a number with a fault has no fault of its own") {
  for (const auto& [wrong, pointer] :
       {std::pair{"\"800 N\"", "/structure/masses/0/value"}, {"-1", "/structure/masses/0/value"}}) {
    std::string text = oscillator();
    text.replace(text.find("\"800 g\""), 7, wrong);
    try {
      read_text(text);
      FAIL("a fault is there");
    } catch (const SceneError& error) {
      REQUIRE(error.faults().size() == 1);
      CHECK(error.faults()[0].pointer == pointer);
    }
  }
}

TEST_CASE("a chain of formulas is short where it branches") {
  std::string more;
  for (int i = 0; i < 60; ++i) {  // written out 2^60 terms
    const std::string from = i == 0 ? "ratio" : "a" + std::to_string(i - 1);
    more += ", \"a" + std::to_string(i) + "\": \"0.5*(" + from + " + " + from + "^1.0)\"";
  }
  Scene scene = read_text(oscillator(more));
  CHECK(value(scene, "a59") == Approx(0.12));
  set(scene, "ratio", 0.2);
  CHECK(value(scene, "a59") == Approx(0.2));
}

TEST_CASE("a chain of more than a hundred formulas is refused, in either order") {
  const auto chain = [](int length, bool backward) {
    std::string more;
    for (int k = 0; k < length; ++k) {
      const int i = backward ? length - 1 - k : k;
      more += ", \"a" + std::to_string(i) + "\": \"" + (i == 0 ? "ratio" : "a" + std::to_string(i - 1)) +
              " + 1\"";
    }
    return oscillator(more);
  };
  for (const bool backward : {false, true}) {
    CAPTURE(backward);
    CHECK(value(read_text(chain(100, backward)), "a99") == Approx(100.12));
    CHECK_THROWS_WITH(read_text(chain(101, backward)),
                      Catch::Matchers::Contains("a chain of more than 100 formulas"));
    CHECK_THROWS_WITH(read_text(chain(20000, backward)),
                      Catch::Matchers::Contains("a chain of more than 100 formulas"));
  }
}

TEST_CASE("numbers of studies follow parameters that the study does not change") {
  const auto with_study = [](const std::string& study) {
    std::string text = oscillator();
    return text.replace(text.find("\"studies\""), std::string::npos, "\"studies\": [" + study + "]}");
  };
  const auto settings = [](const Scene& scene) {
    std::vector<std::pair<std::string, double>> all;
    Settings copy = scene.studies[0].settings;
    scene.studies[0].type->settings().visit_numbers(
        copy, [&](const std::string& pointer, double& number) { all.emplace_back(pointer, number); });
    return all;
  };
  using Numbers = std::vector<std::pair<std::string, double>>;
  Scene frf = read_text(with_study(R"({"kind": "frf", "from": "0.5*f0", "to": "1.5*f0"})"));
  CHECK(settings(frf) == Numbers{{"/from", 23.5}, {"/to", 70.5}});
  set(frf, "f0", 20);
  CHECK(settings(frf) == Numbers{{"/from", 10}, {"/to", 30}});
  CHECK(write(frf).find("\"from\": \"0.5*f0\"") != std::string::npos);
  CHECK(read_text(write(frf)) == frf);
  Scene peaks = read_text(with_study(
      R"({"kind": "peaks", "over": "ratio", "from": "0.1*m", "to": "m", "frequency": ["0.5*f0", 60]})"));
  set(peaks, "f0", 20);
  set(peaks, "m", 2);
  CHECK(settings(peaks) ==
        Numbers{{"/from", 0.1 * 2}, {"/to", 2}, {"/frequency/0", 10}, {"/frequency/1", 60}});
  Scene best = read_text(with_study(
      R"({"kind": "optimum", "over": ["limit"], "bounds": [["force.cosine", "5*force.cosine"]], "frequency": [30, "1.5*f0"]})"));
  set(best, "force.cosine", 3);
  const auto of_best = settings(best);
  CHECK(of_best.at(0) == std::pair<std::string, double>{"/bounds/0/0", 3});
  CHECK(of_best.at(1) == std::pair<std::string, double>{"/bounds/0/1", 15});
  CHECK(read_text(write(best)) == best);

  const auto refused = [&](const std::string& study, const std::string& message) {
    CAPTURE(study);
    CHECK_THROWS_WITH(read_text(with_study(study)), Catch::Matchers::Contains(message));
  };
  refused(R"({"kind": "frf", "from": "0.5*f0", "to": 70, "for_each": {"f0": [40, 50]}})",
          "/studies/0/from: found \"0.5*f0\", which follows \"f0\", which \"for_each\" changes");
  refused(R"({"kind": "trace", "over": "m", "from": 0.1, "to": "2*m", "frequency": 47})",
          "/studies/0/to: found \"2*m\", which follows \"m.value\", which the study is \"over\"");
  refused(R"({"kind": "frf", "from": "0.5*f1", "to": 70})", "found the unknown name \"f1\"");
  refused(R"({"kind": "frf", "from": "m", "to": 70})", "which is kg, must be Hz");
  refused(R"({"kind": "frf", "from": 1, "to": 70, "for_each": {"f0": ["2*m", 50]}})",
          "found \"2*m\", a formula of parameters, must be a number");
}
