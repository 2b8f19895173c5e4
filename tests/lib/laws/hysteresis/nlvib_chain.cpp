#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>

#include <cmath>

using namespace arcslip;

TEST_CASE("the chain of NLvib's example 07 is traced from end to end, with its peaks") {
  // 3 masses; friction at the first and between the first two, cubic springs at the second and between the
  // last two, a one-sided spring at the third. NLvib's numbers are of 256 samples, and of contacts that stick
  // from where they were without force, not about the centre of their motion: the mean of the motion differs.
  const auto chain = [](const char* response) {
    return scenes::parse(std::string(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["a", "b", "c"],
        "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1},
                   {"name": "mc", "at": "c", "value": 1}],
        "springs": [{"name": "k0", "at": "a", "value": 1}, {"name": "k1", "between": ["a", "b"], "value": 1},
                    {"name": "k2", "between": ["b", "c"], "value": 1}, {"name": "k3", "at": "c", "value": 1}],
        "dampers": [{"name": "c0", "at": "a", "value": 0.02}, {"name": "c1", "between": ["a", "b"], "value": 0.02},
                    {"name": "c2", "between": ["b", "c"], "value": 0.02}, {"name": "c3", "at": "c", "value": 0.02}]},
      "elements": [
        {"name": "d1", "type": "jenkins", "at": "a", "stiffness": 20, "friction_coefficient": 1, "normal_load": 1},
        {"name": "d2", "type": "jenkins", "between": ["a", "b"], "stiffness": 20, "friction_coefficient": 1,
         "normal_load": 1},
        {"name": "s1", "type": "cubic_spring", "at": "b", "stiffness": 1},
        {"name": "s2", "type": "cubic_spring", "between": ["b", "c"], "stiffness": 1},
        {"name": "g", "type": "gap_spring", "at": "c", "stiffness": 1, "gap": 0.25}],
      "excitation": [{"name": "f", "at": "b", "cosine": 1}], "harmonics": {"order": 7},
      "response": {"at": ")") +
                         response + R"("},
      "studies": [{"name": "frf", "kind": "frf", "from": 0.5, "to": 2}]})");
  };
  const auto rms = [](const observables::ResponsePoint& point) {
    double sum = point.coefficients[0] * point.coefficients[0];
    for (std::size_t i = 2; i < point.coefficients.size(); ++i)
      sum += 0.5 * point.coefficients[i] * point.coefficients[i];
    return std::sqrt(sum);
  };
  struct Expected {
    const char* response;
    double rms, omega, from, to;
  };
  for (const Expected& each : {Expected{"a", 0.167265, 1.25720, 1.2, 1.4},
                               {"b", 0.206267, 1.26717, 1.2, 1.4},
                               {"c", 0.727831, 1.65924, 1.64, 2}}) {
    const scene::Scene s = chain(each.response);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(branches.size() == 1);
    const auto& branch = branches[0];
    CAPTURE(each.response, branch.stop.message);
    REQUIRE(branch.status == observables::Status::complete);
    double most = 0, at = 0;
    for (const auto& point : branch.points)
      if (point.omega > each.from && point.omega < each.to && rms(point) > most)
        most = rms(point), at = point.omega;
    CHECK(std::abs(most / each.rms - 1) < (each.response[0] == 'c' ? 6e-2 : 1e-2));
    CHECK(std::abs(at - each.omega) < 0.01);
    // Its own witness is the motion in time.
    const auto motion = observables::motion_in_time(s, {.frequency = 1.2641});
    REQUIRE(motion.status == observables::Status::complete);
    scene::Scene fine = s;
    fine.harmonics.order = 41;
    const auto response = observables::point_responses(fine, {.frequency = 1.2641});
    REQUIRE(response.size() == 1);
    CHECK(std::abs(response[0].point.amplitude / motion.amplitude - 1) < 1e-4);
  }
}

TEST_CASE("the example of a chain with a gap comes to 2 rad/s, through the fold at which NLvib stalls") {
  const scene::Scene s = scenes::example("gap_limited_chain");
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  const auto& branch = branches[0];
  CAPTURE(branch.stop.message);
  CHECK(branch.status == observables::Status::complete);
  REQUIRE_FALSE(branch.points.empty());
  CHECK(std::abs(branch.points.back().omega - 2) < 1e-12);
  double last = 0;
  for (const auto& event : branch.events)
    if (event.kind == "fold" && event.point.omega > last) last = event.point.omega;
  CHECK(std::abs(last - 1.6594) < 2e-3);  // NLvib, whose stuck contacts have another mean force
}
