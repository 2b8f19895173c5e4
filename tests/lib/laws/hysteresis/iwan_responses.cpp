#include "catch.hpp"

#include "lib/laws/hysteresis/iwan_laws.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <random>
#include <sstream>

using namespace arcslip;

TEST_CASE("in harmonics a table comes to the exact march in time, in random structures") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> number(0.1, 1);
  int compared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<std::pair<double, double>> sliders;
    for (int j = 0; j < 1 + trial % 6; ++j) sliders.emplace_back(number(random), 0.3 * number(random));
    const char* places[] = {R"("at": "a")", R"("at": "b")", R"("between": ["a", "b"])"};
    const bool even = trial % 2 == 1;
    std::ostringstream text;
    text.precision(17);
    text
        << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["a", "b"], "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b",
        "value": )"
        << number(random) << R"(}], "springs": [{"name": "ka", "at": "a", "value": 1},
        {"name": "kb", "between": ["a", "b"], "value": )"
        << 2 * number(random)
        << R"(}], "dampers": [{"name": "ca", "at": "a", "value": 0.1}, {"name": "cb", "at": "b", "value": 0.1}]},
      "elements": [{"name": "joint", )"
        << places[trial % 3] << ", " << iwan_laws::table(sliders)
        << R"(}], "excitation": [{"name": "f", "at": "a", "cosine": )" << number(random) << "}"
        << (even ? R"(, {"name": "g", "at": "b", "sine": 0.2, "harmonic": 2})" : "")
        << R"(], "response": {"at": "b"}, "harmonics": {"order": 101}})";
    const scene::Scene s = scenes::parse(text.str());
    const double frequency = 0.3 + number(random);
    const auto found = observables::point_responses(s, {.frequency = frequency});
    const auto motion = observables::motion_in_time(s, {.frequency = frequency});
    CAPTURE(trial, sliders, frequency, motion.stop.message);
    REQUIRE(found.size() == 1);
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(motion.integrator == "event-driven");
    const auto& point = found[0].point;
    CHECK(std::abs(point.energy_friction - motion.energy.friction) < 1e-5 * point.energy_input);
    CHECK(std::abs(motion.energy.defect()) < 1e-9);
    // A slider that never slips keeps an offset of its own in time, and with it the mean.
    if (motion.energy.friction == 0 || even) continue;
    CHECK(std::abs(point.amplitude / motion.amplitude - 1) < 3e-6);
    CHECK(std::abs(point.elements[0].stick_percent - motion.elements[0].stick_percent) < 1e-2);
    ++compared;
  }
  CHECK(compared > 30);
}

TEST_CASE("in microslip a response comes to its limit as N^-4, and that of a table as N^-3") {
  for (const bool microslip : {true, false}) {
    const std::string joint = microslip ? R"("type": "iwan", "stiffness": 2, "slip_force": 4)"
                                        : iwan_laws::table({{1, 0.2}, {0.5, 0.3}, {0.5, 0.7}});
    const auto amplitude = [&](int order) {
      const auto found =
          observables::point_responses(iwan_laws::oscillator(joint, 1, order), {.frequency = 0.47});
      REQUIRE(found.size() == 1);
      return found[0].point.amplitude;
    };
    const double limit = amplitude(401);
    for (const int order : {7, 15, 31, 63, 127}) {
      CAPTURE(microslip, order);
      const double error = std::abs(amplitude(order) / limit - 1);
      CHECK(error < (microslip ? 1e-3 * std::pow(order, -4) : 0.1 * std::pow(order, -3)));
    }
  }
}

TEST_CASE("in time a continuous distribution is divided into sliders, with an error of sliders^-2") {
  const std::string continuous[] = {
      R"("type": "iwan", "stiffness": 2, "slip_force": 0.6)",
      R"("type": "iwan", "distribution": "four-parameter", "stiffness": 2, "slip_force": 0.6, "exponent": -0.5,
         "beta": 0.3)"};
  for (const std::string& joint : continuous)
    for (const double frequency : {0.9, 1.3}) {
      const auto found =
          observables::point_responses(iwan_laws::oscillator(joint, 0.4, 101), {.frequency = frequency});
      REQUIRE(found.size() == 1);
      const auto& point = found[0].point;
      for (const int sliders : {20, 60}) {
        const scene::Scene s =
            iwan_laws::oscillator(joint + R"(, "sliders": )" + std::to_string(sliders), 0.4);
        const auto motion = observables::motion_in_time(s, {.frequency = frequency});
        const auto newmark = observables::motion_in_time(
            s, {.frequency = frequency, .method = observables::TimeMethod::newmark_shooting, .steps = 1000});
        REQUIRE(motion.status == observables::Status::complete);
        REQUIRE(newmark.status == observables::Status::complete);
        CHECK(motion.integrator == "event-driven");
        CAPTURE(joint, frequency, sliders);
        CHECK(std::abs(motion.amplitude / point.amplitude - 1) < 0.8 / (sliders * sliders));
        CHECK(std::abs(motion.energy.friction / point.energy_friction - 1) < 2.5 / (sliders * sliders));
        CHECK(std::abs(newmark.amplitude / motion.amplitude - 1) < 2e-5);
        const double stick = point.elements[0].stick_percent;
        CHECK(std::abs(motion.elements[0].stick_percent - stick) < 100.0 / (sliders * sliders));
        CHECK(std::abs(newmark.elements[0].stick_percent - stick) < 100.0 / (sliders * sliders) + 0.06);
      }
    }
}

TEST_CASE("every study works with an iwan element, and is complete") {
  const auto run = [](const std::string& joint, const std::string& slip) {
    std::string text = scene::write(iwan_laws::oscillator(joint, 0.4, 9));
    const std::string old = text.substr(text.find("\"studies\""));
    text.replace(text.find(old), old.size(), R"("studies": [
      {"kind": "frf", "from": 0.4, "to": 2.5},
      {"kind": "trace", "over": ")" + slip + R"(", "from": 0.1, "to": 2, "frequency": 1.2},
      {"kind": "peaks", "over": ")" + slip + R"(", "from": 0.1, "to": 2, "frequency": [0.8, 2.2]},
      {"kind": "point", "frequency": 1.2}, {"kind": "time", "frequency": 1.2},
      {"kind": "optimum", "over": [")" + slip + R"("], "bounds": [[0.1, 2]], "frequency": [0.8, 2.2]}]})");
    const scene::Scene s = scenes::parse(text);
    std::istringstream again(scene::write(s));
    CHECK(scene::read(again, test_catalogue::whole()) == s);
    std::ostringstream out;
    results::write_json(out, studies::run(s));
    const auto json = nlohmann::json::parse(out.str());
    for (const char* kind : {"branches", "responses", "motions", "optima"})
      for (const auto& each : json.at(kind)) {
        CAPTURE(joint, kind, each.value("status", ""));
        CHECK(each["status"] == "complete");
      }
  };
  run(R"("type": "iwan", "stiffness": 2, "slip_force": 0.6)", "joint.slip_force");
  run(iwan_laws::four_parameter, "joint.slip_force");
  run(iwan_laws::table({{1, 0.2}, {0.5, 0.3}, {0.5, 0.7}}), "joint.slip_factor");
}

TEST_CASE("at its peaks the example of a bolted joint dissipates as in closed form, with slope 3 + chi") {
  const scene::Scene s = scenes::example("microslip_joint");
  const auto branches = scenes::frequency_responses(s, s.studies.front().for_each);
  REQUIRE(branches.size() == 8);
  double amplitude = 0, energy = 0, slope = 0;
  int in_microslip = 0;
  for (const auto& branch : branches) {
    CAPTURE(branch.stop.message);
    REQUIRE(branch.status == observables::Status::complete);
    REQUIRE(branch.events.size() == 1);
    const auto& peak = branch.events[0].point;
    REQUIRE(peak.elements.size() == 1);
    const double dissipated = peak.elements[0].energy;
    CAPTURE(peak.amplitude, dissipated);
    if (energy > 0) slope = std::log(dissipated / energy) / std::log(peak.amplitude / amplitude);
    if (peak.amplitude < 2.87614678899) {  // phi_max of Kt = 2, Fs = 3, chi = -0.1, beta = 0.1
      ++in_microslip;
      CHECK(std::abs(dissipated / (0.45904818005 * std::pow(peak.amplitude, 2.9)) - 1) < 1e-10);
      if (energy > 0) CHECK(std::abs(slope - 2.9) < 1e-9);
    }
    amplitude = peak.amplitude;
    energy = dissipated;
  }
  CHECK(in_microslip == 7);
  CHECK(slope < 2);  // from the last in microslip to the one in macroslip
}
