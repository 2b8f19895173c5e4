// What a scene is said to be a model of, and the windows that are proposed, against closed forms of one and
// two degrees of freedom.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/branches/model_description.hpp>
#include <arcslip/analyses/branches/proposed_window.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace arcslip;
using observables::describe_model;
using observables::proposed_window;
using std::numbers::pi;

namespace {

/// m = 2 kg, k = 8 N/m, c = 0.08 N s/m: omega = 2 rad/s, zeta = c/(2 m omega) = 1 %.
std::string oscillator(const std::string& elements, const std::string& dof = "a", double mass = 2,
                       double stiffness = 8, const std::string& more = "") {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [")" + dof +
         R"("], "masses": [{"name": "m", "at": ")" + dof + R"(", "value": )" + std::to_string(mass) +
         R"(}], "springs": [{"name": "k", "at": ")" + dof + R"(", "value": )" + std::to_string(stiffness) +
         R"(}], "dampers": [{"name": "c", "at": ")" + dof + R"(", "value": 0.08}]}, "elements": [)" +
         elements + R"(], "excitation": [{"name": "f", "at": ")" + dof + R"(", "cosine": 0.4}])" + more + "}";
}

const std::string slider =
    R"({"name": "d", "type": "jenkins", "at": "a", "stiffness": 10, "friction_coefficient": 0.5, "normal_load": 1})";

std::vector<std::string> doubts(const std::string& scene,
                                const std::vector<observables::WindowOfStudy>& windows = {}) {
  return describe_model(scenes::parse(scene), windows).doubts;
}

}  // namespace

TEST_CASE("a model is described by its mass, frequencies, damping ratios and static deflection") {
  // Stuck: omega = 3 rad/s, zeta = 0.08/(2 2 3) = 0.667 %; 0.4/8 m and 0.4/18 m.
  const auto described = describe_model(scenes::parse(oscillator(slider)), {});
  CHECK(described.facts ==
        std::vector<std::string>{
            "mass: 2 kg at \"a\"", "natural frequencies with all contacts free: 2 rad/s; stuck: 3 rad/s",
            "damping ratios of these modes, without friction, free: 1 %; stuck: 0.667 %",
            "static deflection of the response under the amplitude of the forces: 50 mm with all contacts "
            "free, 22.22 mm stuck"});
  CHECK(described.doubts.empty());
}

TEST_CASE("damping in proportion to masses and stiffnesses, and a loss factor, are in the damping ratios") {
  // alpha/(2 omega) + beta omega/2, and eta/2, next to 1 %.
  const auto with = [](const std::string& damping) {
    std::string scene = oscillator("");
    const std::string at = "\"dampers\"";
    scene.insert(scene.find(at), "\"damping\": [" + damping + "], ");
    return describe_model(scenes::parse(scene), {}).facts.at(2);
  };
  const std::string start = "damping ratios of these modes, without friction: ";
  CHECK(with(R"({"name": "r", "type": "rayleigh", "alpha": 0.08, "beta": 0.01})") == start + "4 %");
  CHECK(with(R"({"name": "l", "type": "loss_factor", "loss_factor": 0.06})") == start + "4 %");
}

TEST_CASE("masses along x and y are those of all coordinates that move alike") {
  const auto facts =
      describe_model(
          scenes::parse(R"({"format": "arcslip-scene-1", "structure": {"dofs": ["1.x", "1.y", "2.x"],
    "masses": [{"name": "m1", "at": "1.x", "value": 2}, {"name": "m2", "at": "1.y", "value": 3},
               {"name": "m3", "at": "2.x", "value": 4}],
    "springs": [{"name": "k1", "at": "1.x", "value": 8}, {"name": "k2", "at": "1.y", "value": 8},
                {"name": "k3", "at": "2.x", "value": 8}]},
    "excitation": [{"name": "f", "at": "1.x", "cosine": 1}], "response": {"at": "1.x"}})"),
          {})
          .facts;
  CHECK(facts.front() == "mass: 6 kg along x and 3 kg along y");
}

TEST_CASE("a structure that no spring holds has no static deflection while its contact is free") {
  std::string scene = oscillator(slider);
  const std::string spring = R"("springs": [{"name": "k", "at": "a", "value": 8.000000}], )";
  scene.erase(scene.find(spring), spring.size());
  const auto facts = describe_model(scenes::parse(scene), {}).facts;
  CHECK(
      facts.back() ==
      "static deflection of the response under the amplitude of the forces: none, since no spring holds the "
      "structure with all contacts free, 40 mm stuck");
}

TEST_CASE(
    "frequencies that are rarely meant, and masses and stiffnesses taken for each other, are asked about") {
  CHECK(doubts(oscillator("", "a", 2, 8)).empty());
  const auto high = doubts(oscillator("", "a", 1e-6, 1e9));  // sqrt(1e15) rad/s
  REQUIRE(high.size() == 1);
  CHECK(high[0].starts_with("the lowest natural frequency is 5.033e+06 Hz, which is rare: check the units."));
  const auto low = doubts(oscillator("", "a", 1e9, 1));  // 1/sqrt(1e9) rad/s is 1.6e-4 Hz, or 5033 Hz swapped
  REQUIRE(low.size() == 1);
  CHECK(
      low[0] ==
      "the highest natural frequency is 5.033e-06 Hz; are mass and stiffness taken for each other? Then they "
      "would be 31623 rad/s");
}

TEST_CASE("a window that no resonance of either state is in, nor passes, is reported with what to do") {
  const std::string scene = oscillator(slider);  // 2 to 3 rad/s
  CHECK(doubts(scene, {{"frf", {1.5, 2.5}}}).empty());
  CHECK(doubts(scene, {{"frf", {2.2, 2.8}}}).empty());  // passes on its way from free to stuck
  CHECK(doubts(scene, {{"frf", {2.8, 4}}}).empty());
  CHECK(
      doubts(scene, {{"frf", {1, 1.9}}}) ==
      std::vector<std::string>{
          "the window of the study \"frf\", 1 rad/s to 1.9 rad/s, has no resonance of small motions: natural "
          "frequencies with all contacts free: 2 rad/s above; stuck: 3 rad/s above. Choose another window, "
          "or "
          "leave it out to have one proposed"});
  CHECK(doubts(scene, {{"one", {1, 1.9}}, {"two", {3.1, 9}}}).size() == 2);
}

TEST_CASE("the window that is proposed reaches from free to stuck, with the margins of its formula") {
  // kappa = (3/2)^2 - 1 = 1.25: 3 kappa/(2 pi) = 0.597 is more than the half.
  const auto wide = proposed_window(scenes::parse(oscillator(slider)), {});
  REQUIRE(wide);
  CHECK(wide->lower == Approx(1));
  CHECK(wide->upper == Approx(4.5));
  CHECK(wide->reason ==
        "1 rad/s to 4.5 rad/s, around the first resonance, 2 rad/s with all contacts free and 3 rad/s stuck, "
        "with margins of 50 %");
  const auto linear = proposed_window(scenes::parse(oscillator("")), {});  // 3 zeta = 3 %, at least 5 %
  CHECK(linear->lower == Approx(1.9));
  CHECK(linear->upper == Approx(2.1));
  CHECK(linear->reason == "1.9 rad/s to 2.1 rad/s, around the first resonance, 2 rad/s, with margins of 5 %");
}

TEST_CASE("of the values of parameters those count that move the resonance most") {
  // k from 2 to 18 N/m and m from 1 to 2 kg: sqrt(2/2) to sqrt(18/1) rad/s.
  const auto window = proposed_window(scenes::parse(oscillator("")), {{"k.value", 2, 18}, {"m.value", 1, 2}});
  REQUIRE(window);
  CHECK(window->lower == Approx(0.94));  // 3 zeta = 3 0.08/(2 2 1) = 6 %
  CHECK(window->upper == Approx(4.50));  // 1.06 sqrt(18) = 4.497
}

TEST_CASE("springs that stiffen move the upper end to where the damping limits the amplitude") {
  // A = F/(c omega) and m omega^2 = k + 3 k_3 A^2: with F = 0.4, c = 0.08, k_3 = 1 it is 2 w^4 - 8 w^2 - 75 =
  // 0.
  const double square = (8 + std::sqrt(64 + 600.0)) / 4;
  const auto window = proposed_window(
      scenes::parse(oscillator(R"({"name": "e", "type": "cubic_spring", "at": "a", "stiffness": 1})")), {});
  REQUIRE(window);
  CHECK(std::abs(window->upper / (1.05 * std::sqrt(square)) - 1) < 5e-3);
  CHECK(window->reason.find(" where springs stiffen") != std::string::npos);
  CHECK(window->lower == Approx(1.9));
}

TEST_CASE("no window is proposed where the excitation drives no mode") {
  std::string scene = oscillator("");
  const std::string force = "\"cosine\": 0.4";
  scene.replace(scene.find(force), force.size(), "\"cosine\": 0");
  CHECK_FALSE(proposed_window(scenes::parse(scene), {}));
}
