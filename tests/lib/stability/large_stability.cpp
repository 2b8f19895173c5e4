// Multipliers of structures with more than 100 degrees of freedom.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/stability/stability.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>

#include <cmath>

using namespace arcslip;

namespace {

// A bar of unit length, mass and stiffness, held at one end and excited at the other.
scene::Scene long_chain(int n, const std::string& elements) {
  const std::string k = std::to_string(n), c = std::to_string(0.02 * n), last = "x" + std::to_string(n - 1);
  std::string dofs, masses, springs, dampers;
  for (int i = 0; i < n; ++i) {
    const std::string comma = i == 0 ? "" : ", ", x = "x" + std::to_string(i), number = std::to_string(i);
    const std::string place =
        i == 0 ? R"("at": "x0")" : R"("between": ["x)" + std::to_string(i - 1) + R"(", ")" + x + R"("])";
    dofs += comma + "\"" + x + "\"";
    masses += comma + R"({"name": "m)" + number + R"(", "at": ")" + x + R"(", "value": )" +
              std::to_string(1.0 / n) + "}";
    springs += comma + R"({"name": "k)" + number + R"(", )" + place + R"(, "value": )" + k + "}";
    dampers += comma + R"({"name": "c)" + number + R"(", )" + place + R"(, "value": )" + c + "}";
  }
  return scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)" + dofs +
      R"(], "masses": [)" + masses + R"(], "springs": [)" + springs + R"(], "dampers": [)" + dampers +
      R"(]}, "elements": [)" + elements + R"(], "excitation": [{"name": "f", "at": ")" + last +
      R"(", "cosine": 0.3}], "response": {"at": ")" + last + R"("}, "harmonics": {"order": 15}})");
}

}  // namespace

TEST_CASE("a large structure has the multipliers of its low modes, with an error for the others") {
  const auto s = long_chain(150, R"({"name": "d", "type": "jenkins", "at": "x70", "stiffness": 2,
    "friction_coefficient": 0.5, "normal_load": 0.3}, {"name": "stop", "type": "gap_spring", "at": "x149",
    "stiffness": 0.5, "gap": 0.3})");
  const double omega = 1.5;
  observables::PointSettings settings;
  settings.frequency = omega;
  settings.stability = true;
  const auto response = observables::point_responses(s, settings).front();
  REQUIRE(response.point.stability);
  const auto& stability = *response.point.stability;
  CHECK(response.point.elements.at(0).stick_percent < 99);
  CHECK(response.point.amplitude > 0.35);  // beyond the gap
  CHECK(stability.multipliers.size() <= 2 * 50 + 1);

  // Of the same motion with all modes.
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const auto at = observables::responses_at(model, omega, observables::EndSearch::needless);
  REQUIRE_FALSE(at.u.empty());
  const auto p = hbm::parameters_at(*at.problem, omega);
  const auto evaluator = at.problem->hbm_evaluator();
  evaluator->move_to(at.u.front(), p, continuation::Needs::residual);
  std::vector<time::ElementCourse> courses;
  time::courses_of(*at.problem, *evaluator, courses);
  time::Floquet whole(time::equation_of_motion(*model, p));
  REQUIRE(whole.compute(omega, at.problem->harmonics(), courses));
  REQUIRE(whole.modes() == 150);
  const double left_out = observables::distance(stability.multipliers, whole.multipliers());
  CAPTURE(left_out, stability.error);
  CHECK(left_out > 1e-7);
  CHECK(left_out < stability.error);
  CHECK(stability.error < 0.02);
  CHECK(std::abs(std::abs(stability.multipliers[0]) - std::abs(whole.multipliers()[0])) < 2e-4);
}

TEST_CASE("structures that are too large for multipliers say so") {
  const std::string reported =
      "without its stability: the structure has 101 degrees of freedom, and at most 100 are supported by "
      "Hill's "
      "method, with unsymmetric matrices or with laws that are not piecewise linear";
  observables::PointSettings settings;
  settings.frequency = 1.5;
  settings.stability = true;
  const auto cubic = observables::point_responses(
      long_chain(101, R"({"name": "s", "type": "cubic_spring", "at": "x100", "stiffness": 1})"), settings);
  REQUIRE(cubic.front().status == observables::Status::complete);
  CHECK_FALSE(cubic.front().point.stability);
  CHECK(cubic.front().doubt == reported);
  settings.stability.by_hill = true;
  const auto by_hill = observables::point_responses(
      long_chain(101, R"({"name": "s", "type": "gap_spring", "at": "x100", "stiffness": 1, "gap": 0.3})"),
      settings);
  REQUIRE(by_hill.front().status == observables::Status::complete);
  CHECK_FALSE(by_hill.front().point.stability);
  CHECK(by_hill.front().doubt == reported);
}
