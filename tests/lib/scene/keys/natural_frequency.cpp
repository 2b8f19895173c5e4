// Springs and dampers given by a natural frequency and a damping ratio, next to the closed forms of one mass.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/responses_at.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;
using std::numbers::pi;

namespace {

// Masses, springs and dampers on x, y and z.
scene::Scene structure(const std::string& masses, const std::string& springs, const std::string& dampers,
                       const std::string& unit = "Hz") {
  return scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": ")" + unit +
      R"(", "structure": {"dofs": ["x", "y", "z"], "masses": [)" + masses + R"(], "springs": [)" + springs +
      R"({"name": "xy", "between": ["x", "y"], "value": 3}, {"name": "yz", "between": ["y", "z"], "value": 7}], "dampers": [)" +
      dampers + R"(]}, "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
}

}  // namespace

// At its natural frequency a mass moves by f0/(2 zeta k) and lags by a quarter of a period.
TEST_CASE("one mass has the natural frequency and the damping ratio that it is given") {
  constexpr double mass = 1.3, force = 0.7;
  for (const double zeta : {1e-4, 0.02, 0.5, 2.0})
    for (const double frequency : {1e-3, 50.0, 2e5}) {
      CAPTURE(zeta, frequency);
      const auto text = [](double value) {
        std::ostringstream out;
        out.precision(17);
        out << value;
        return out.str();
      };
      const scene::Scene s = scenes::parse(
          R"({"format": "arcslip-scene-1", "structure": {"dofs": ["x"],
              "masses": [{"name": "m", "at": "x", "value": 1}, {"name": "tip", "at": "x", "value": 0.3}],
              "springs": [{"name": "k", "at": "x", "frequency": )" +
          text(frequency) + R"(}], "dampers": [{"name": "c", "at": "x", "damping_ratio": )" + text(zeta) +
          R"(}]}, "excitation": [{"name": "f", "at": "x", "cosine": 0.7}], "harmonics": {"order": 1}, "response": {"at": "x"}})");
      const double stiffness = std::pow(2 * pi * frequency, 2) * mass;
      CHECK(std::abs(scene::value(s, "k.value") / stiffness - 1) < 1e-15);
      CHECK(std::abs(scene::value(s, "c.value") / (2 * zeta * std::sqrt(stiffness * mass)) - 1) < 1e-15);
      const auto found = observables::point_responses(s, {.frequency = frequency});
      REQUIRE(found.size() == 1);
      // The cancelled k - m w^2 leaves a rounding error over 2 zeta k.
      CHECK(std::abs(found[0].point.amplitude / (force / (2 * zeta * stiffness)) - 1) < 1e-15 / zeta + 1e-14);
      CHECK(std::abs(found[0].point.phase - pi / 2) < 1e-15 / zeta + 1e-14);
    }
}

TEST_CASE("springs to other degrees of freedom do not count, and parallel ones do") {
  const std::string masses =
      R"({"name": "m1", "at": "x", "value": 2}, {"name": "m2", "direction": {"y": 2}, "value": 0.5},
    {"name": "m3", "at": "z", "value": 1})";
  const scene::Scene s = structure(
      masses,
      R"({"name": "k1", "at": "x", "frequency": 3}, {"name": "k2", "direction": {"y": -0.5}, "frequency": 4},
         {"name": "a", "between": ["z", "ground"], "value": 5}, {"name": "b", "at": "z", "value": 11},)",
      R"({"name": "c1", "at": "x", "damping_ratio": 0.1}, {"name": "c3", "between": ["ground", "z"], "damping_ratio": 0.25})",
      "rad/s");
  CHECK(scene::value(s, "k1.value") == 9 * 2);
  CHECK(scene::value(s, "k2.value") == 16 * 2 * 4);  // of half the displacement
  CHECK(std::abs(scene::value(s, "c1.value") - 2 * 0.1 * 3 * 2) < 1e-15);
  CHECK(std::abs(scene::value(s, "c3.value") - 2 * 0.25 * 4) < 1e-15);
  CHECK(scenes::parse(scene::write(s)) == s);
}

TEST_CASE("each blade of a ring may have a natural frequency of its own") {
  const scene::Scene s =
      scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": [{"repeat": 3, "name": "x{i}"}], "masses": [{"repeat": 3, "name": "m{i}", "at": "x{i}", "value": 2}],
    "springs": [{"repeat": 3, "name": "k{i}", "at": "x{i}", "frequency": {"each": [1, 2, 3]}}]},
    "excitation": [{"name": "f", "at": "x1", "cosine": 1}], "response": {"at": "x1"}})");
  for (int i = 1; i <= 3; ++i) CHECK(scene::value(s, "k" + std::to_string(i) + ".value") == 2 * i * i);
}

TEST_CASE("what is missing for a natural frequency or a damping ratio is reported") {
  const std::string mass = R"({"name": "m", "at": "x", "value": 1})";
  const auto fault = [](const std::string& masses, const std::string& springs, const std::string& dampers) {
    try {
      structure(masses, springs, dampers);
    } catch (const scene::SceneError& error) {
      REQUIRE(error.faults().size() == 1);
      return error.faults()[0].pointer + ": " + error.faults()[0].message;
    }
    return std::string();
  };
  const std::string spring = R"({"name": "k", "at": "x", "frequency": 50},)";
  CHECK(fault(mass, spring, "").empty());
  CHECK(fault(R"({"name": "m", "at": "y", "value": 1})", spring, "") ==
        "/structure/springs/0/frequency: found no mass on \"x\", must be a \"value\", or there must be a "
        "mass above 0 kg");
  CHECK(
      fault(mass + R"(, {"name": "link", "between": ["x", "y"], "value": 1})", spring, "") ==
      "/structure/springs/0/frequency: found the mass \"link\", which acts on \"x\" and on others; must be a "
      "\"value\", or the masses on \"x\" must act there alone");
  CHECK(fault(mass, R"({"name": "k", "between": ["x", "y"], "frequency": 50},)", "") ==
        "/structure/springs/0/frequency: found a part between degrees of freedom, must be a \"value\": "
        "\"frequency\" is that of the mass on one");
  CHECK(fault(mass, R"({"name": "k", "at": "x", "frequency": 50, "value": 1},)", "") ==
        "/structure/springs/0/frequency: found \"frequency\" and \"value\" together, must be one of them");
  CHECK(fault(mass, R"({"name": "k", "at": "x", "frequency": 50, "frequency": 51},)", "") ==
        "/structure/springs/0/frequency: found the key \"frequency\" again, must stand only once");
  CHECK(fault(mass, R"({"name": "k", "at": "x", "frequency": 0},)", "") ==
        "/structure/springs/0/frequency: found 0, must be above 0 Hz");
  CHECK(fault(mass, R"({"name": "k", "at": "x", "frequency": true},)", "") ==
        "/structure/springs/0/frequency: found true, must be a number, above 0 Hz");
  CHECK(fault(mass, R"({"name": "k", "at": "x", "frequency": 1e200},)", "") ==
        "/structure/springs/0/frequency: found 1e+200, with which the value is too large for a number");
  CHECK(fault(mass, R"({"name": "k", "at": "w", "frequency": 50},)", "")
            .starts_with("/structure/springs/0/at: found \"w\", must be one of the degrees of freedom"));
  CHECK(fault(R"({"name": "m", "at": "x", "value": -1})", spring, "") ==
        "/structure/masses/0/value: found -1, must be at least 0 kg");
  const std::string damper = R"({"name": "c", "at": "x", "damping_ratio": 0.01})";
  CHECK(fault(mass, spring, damper).empty());
  CHECK(fault(mass, "", damper) ==
        "/structure/dampers/0/damping_ratio: found no spring on \"x\" alone, must be a \"value\", or there "
        "must be "
        "one above 0 N/m, from \"x\" to \"ground\"");
  CHECK(fault(R"({"name": "m", "at": "y", "value": 1})", R"({"name": "k", "at": "x", "value": 50},)", damper)
            .starts_with("/structure/dampers/0/damping_ratio: found no mass on \"x\""));
  CHECK(fault(mass, spring, R"({"name": "c", "at": "x", "damping_ratio": -0.01})") ==
        "/structure/dampers/0/damping_ratio: found -0.01, must be at least 0");
  CHECK(fault(mass, R"({"name": "k", "at": "x", "damping_ratio": 0.1, "value": 1},)", "")
            .starts_with("/structure/springs/0/damping_ratio: found the unknown key \"damping_ratio\""));
}
