// How far sliders that stick throughout leave the amplitude open: closed forms, and motions in time that
// begin with their sliders elsewhere.
#include "catch.hpp"

#include "contains.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/laws/every_law.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/analyses/responses/stick_offset_range.hpp>
#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <random>
#include <sstream>

using namespace arcslip;
using continuation::Vector;

namespace {

observables::PointResponse at(const scene::Scene& s, double frequency) {
  const auto found =
      observables::point_responses(s, {.frequency = frequency, .offsets = observables::Offsets::range});
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].status == observables::Status::complete);
  REQUIRE(found[0].offset_range);
  return found[0];
}

// 1 kg on a spring of 3 N/m and a slider of 2 N/m with the limit 1 N.
scene::Scene one(double force, double constant, const std::string& offset = "centred") {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 3}], "dampers": [{"name": "c", "at": "x", "value": 0.2}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "x", "stiffness": 2, "friction_coefficient": 0.5,
                  "normal_load": 2, "offset": ")"
       << offset << R"("}], "excitation": [{"name": "f", "at": "x", "cosine": )" << force
       << R"(}, {"name": "load", "at": "x", "harmonic": 0, "cosine": )" << constant
       << R"(}], "harmonics": {"order": 5}, "studies": [{"kind": "frf", "from": 1, "to": 4}]})";
  return scenes::parse(text.str());
}

// Three masses: contacts that may stick between them and to the ground, one of which slips where `slips`, one
// under a load that varies.
scene::Scene three(double slips) {
  std::ostringstream text;
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "n"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 0.7},
                 {"name": "mn", "at": "n", "value": 0.4}],
      "springs": [{"name": "ka", "at": "a", "value": 2}, {"name": "kab", "between": ["a", "b"], "value": 1},
                  {"name": "kb", "at": "b", "value": 0.8}, {"name": "kn", "at": "n", "value": 3}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.3}, {"name": "cb", "at": "b", "value": 0.3},
                  {"name": "cn", "at": "n", "value": 0.4}]},
    "elements": [
      {"name": "wall", "type": "jenkins", "at": "a", "stiffness": 0.8, "friction_coefficient": 0.5, "normal_load": 1.6},
      {"name": "pad", "type": "contact_2d", "tangential": {"at": "b"}, "normal": {"at": "n"},
       "tangential_stiffness": 0.9, "normal_stiffness": 0.7, "friction_coefficient": 0.4, "normal_load": 2},
      {"name": "between", "type": "jenkins", "between": ["a", "b"], "stiffness": 0.6, "friction_coefficient": 0.5,
       "normal_load": )"
       << slips << R"(}],
    "excitation": [{"name": "f", "at": "a", "cosine": 0.5}, {"name": "g", "at": "n", "sine": 0.4},
                   {"name": "load", "at": "b", "harmonic": 0, "cosine": 0.1}],
    "response": {"at": "a"}, "harmonics": {"order": 41}, "studies": [{"kind": "frf", "from": 0.5, "to": 3}]})";
  return scenes::parse(text.str());
}

}  // namespace

TEST_CASE("a slider that sticks rests where it is placed, with the Jacobian of that") {
  const elements::Harmonics h{4, false};
  std::mt19937 bits(5);
  const std::pair<const elements::PlainLaw*, std::vector<double>> laws[] = {
      {&elements::jenkins(), {2, 0.5, 10}}, {&elements::contact_2d(), {2, 0.4, 0.5, 10}}};
  for (const auto& [law, fields] : laws)
    for (const double share : {0.0, 0.3, 1.0}) {
      CAPTURE(law->name(), share);
      const auto element = law->element(h, {});
      elements::FrictionState state;
      REQUIRE(element->place_slider(share));
      const Vector u = every_law::random(law->directions() * h.size(), 0.5, bits);
      element->move_to(u, fields, true);
      REQUIRE(element->friction(state));
      REQUIRE(state.stick_share == 1);
      CHECK(std::abs(element->force()[0] - (1 - share) * state.mean_max - share * state.mean_min) < 1e-13);
      const auto force = [&](const Vector& at) -> Vector {
        element->move_to(at, fields, false);
        return element->force();
      };
      const Eigen::MatrixXd J = element->jacobian();
      CHECK((J - every_law::differences(force, u, 1e-6)).norm() < 1e-7 * J.norm());
    }
  CHECK_FALSE(elements::contact_3d().element(h, {})->place_slider(0.5));
}

TEST_CASE("the amplitude of one mass on a slider that sticks grows by what its offset shifts the mean") {
  // The slider moves the mean by (k_d/k)(h - X) to both sides of the constant load's place, X: of the motion.
  const double w = 2, X = 0.4 / std::hypot(3 + 2 - w * w, 0.2 * w), h = 0.5, shift = 2.0 / 3 * (h - X);
  REQUIRE(X < h);
  for (const char* offset : {"centred", "static"}) {
    CAPTURE(offset);
    const auto found = *at(one(0.4, 0, offset), w).offset_range;
    CHECK(found.failure.empty());
    CHECK(found.sliders == 1);
    CHECK(std::abs(found.amplitude_min - X) < 1e-9 * X);
    CHECK(std::abs(found.amplitude_max - (X + shift)) < 1e-12);
    // Under a load of 0.1 N the mean is 0.1/3 - shift to 0.1/3 + shift.
    REQUIRE(shift > 0.1 / 3);
    const auto loaded = *at(one(0.4, 0.1, offset), w).offset_range;
    CHECK(std::abs(loaded.amplitude_min - X) < 1e-9 * X);
    CHECK(std::abs(loaded.amplitude_max - (X + 0.1 / 3 + shift)) < 1e-12);
    // Of 1 N the least mean is above 0.
    const auto heavy = *at(one(0.4, 1, offset), w).offset_range;
    CHECK(std::abs(heavy.amplitude_min - (X + 1.0 / 3 - shift)) < 1e-9);
    CHECK(std::abs(heavy.amplitude_max - (X + 1.0 / 3 + shift)) < 1e-12);
  }
}

TEST_CASE("where every slider slips the range is the amplitude itself, and without the key there is none") {
  const auto found = at(one(2, 0.1), 2);
  CHECK(found.point.elements[0].stick_percent < 90);
  CHECK(found.offset_range->sliders == 0);
  CHECK(std::abs(found.offset_range->amplitude_max / found.point.amplitude - 1) < 1e-12);
  CHECK(found.offset_range->amplitude_max == found.offset_range->amplitude_min);
  const auto unasked = observables::point_responses(one(2, 0.1), {.frequency = 2});
  CHECK_FALSE(unasked[0].offset_range);
}

TEST_CASE("a body that nothing but friction holds has no range, and the message says so") {
  scene::Scene s = one(0.2, 0.1, "static");
  scene::set(s, "k.value", 0);
  const auto found = *at(s, 3).offset_range;
  CHECK(contains(found.failure, "nothing but friction holds the mean position"));
}

TEST_CASE(
    "a slider that loads another contact changes its slip, not the mean: between two dampers of closed "
    "form") {
  // The slider moves n, at rest, by p/(k + k_n) to either side, so that the pad slips under 1 -+ 0.2 N.
  const auto scene = [](const std::string& pad) {
    return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["t", "n"],
        "masses": [{"name": "mt", "at": "t", "value": 1}, {"name": "mn", "at": "n", "value": 1}],
        "springs": [{"name": "kt", "at": "t", "value": 1}, {"name": "kn", "at": "n", "value": 1}],
        "dampers": [{"name": "ct", "at": "t", "value": 0.05}, {"name": "cn", "at": "n", "value": 0.05}]},
      "elements": [{"name": "pad", )" +
                         pad +
                         R"(, "friction_coefficient": 0.3}, {"name": "held", "type": "jenkins", "at": "n",
                    "stiffness": 2, "friction_coefficient": 0.5, "normal_load": 0.8}], "excitation": [{"name": "f", "at": "t", "cosine": 0.3}], "response": {"at": "t"},
      "harmonics": {"order": 15}, "studies": [{"kind": "frf", "from": 0.5, "to": 3}]})");
  };
  for (const double w : {1.1, 1.3}) {
    CAPTURE(w);
    const auto found = *at(scene(R"("type": "contact_2d", "tangential": {"at": "t"}, "normal": {"at": "n"},
      "tangential_stiffness": 1, "normal_stiffness": 1, "normal_load": 1)"),
                           w)
                            .offset_range;
    CHECK(found.failure.empty());
    CHECK(found.sliders == 1);
    double amplitudes[2];
    for (const int side : {0, 1})
      amplitudes[side] = at(scene(R"("type": "jenkins", "at": "t", "stiffness": 1, "normal_load": )" +
                                  std::string(side ? "1.2" : "0.8")),
                            w)
                             .point.amplitude;
    CAPTURE(amplitudes[0], amplitudes[1]);
    CHECK(std::abs(amplitudes[0] / amplitudes[1] - 1) > 0.05);
    CHECK(std::abs(found.amplitude_min / std::min(amplitudes[0], amplitudes[1]) - 1) < 1e-9);
    CHECK(std::abs(found.amplitude_max / std::max(amplitudes[0], amplitudes[1]) - 1) < 1e-9);
  }
}

TEST_CASE("motions in time whose sliders begin anywhere stay within the range, and come to its ends") {
  for (const double slips : {0.05, 5.0}) {
    CAPTURE(slips);
    const double w = 1.3;
    const scene::Scene s = three(slips);
    const auto response = at(s, w);
    const auto& range = *response.offset_range;
    CHECK(range.failure.empty());
    CHECK(range.sliders == (slips < 1 ? 2 : 3));
    for (std::size_t e = 0; e < 3; ++e)
      CHECK((response.point.elements[e].stick_percent == 100) == (e < 2 || slips > 1));
    const double spread = range.amplitude_max - range.amplitude_min;
    CHECK(spread > 0.1 * range.amplitude_min);

    const auto pair = compared_with_exact::balanced(s, w);
    time::EventDriven integrator(pair.equation);
    const double period = pair.equation.period();
    const time::MotionState start = time::state_of(*pair.problem, pair.u, pair.p);
    time::Matrix held = pair.equation.K, drawn = time::Matrix::Zero(3, 3);
    for (int e = 0; e < (slips < 1 ? 2 : 3); ++e) {
      const auto& element = pair.equation.elements[static_cast<std::size_t>(e)];
      const time::Vector d = element.directions.col(0);
      held += element.fields[0] * d * d.transpose();
      drawn.col(e) = element.fields[0] * d;
    }
    double least = HUGE_VAL, most = 0;
    // Moved with the means that the sliders would hold, so that little is left to settle.
    const auto settle = [&](const time::Vector& dz) {
      time::MotionState moved = start;
      moved.z += dz;
      moved.x += held.ldlt().solve(drawn * dz);
      const auto settled = integrator.integrate(moved, 0, 60 * period);
      REQUIRE(settled.reason == time::EndReason::reached);
      const auto motion = integrator.integrate(settled.end, 60 * period, 61 * period);
      REQUIRE(motion.reason == time::EndReason::reached);
      least = std::min(least, motion.amplitude);
      most = std::max(most, motion.amplitude);
    };
    for (int i = -8; i <= 8; ++i)
      for (int j = -8; j <= 8; ++j) settle(time::Vector{{0.25 * i, 0.25 * j, 0.3 * ((i * i + j) % 5 - 2)}});
    // Just within the corners, where each slider meets a bound.
    time::Vector room = time::Vector::Zero(3);
    for (int e = 0; e < 3; ++e) {
      const auto& element = response.point.elements[static_cast<std::size_t>(e)];
      room[e] = 0.5 * (element.mean_force_max - element.mean_force_min) /
                pair.equation.elements[static_cast<std::size_t>(e)].fields[0];
    }
    time::Matrix along(3, 3);
    for (int e = 0; e < 3; ++e)
      along.row(e) = pair.equation.elements[static_cast<std::size_t>(e)].directions.col(0);
    const time::Matrix to_bound = time::Matrix::Identity(3, 3) - along * held.ldlt().solve(drawn);
    for (int corner = 0; corner < 8; ++corner) {
      const time::Vector signs{
          {corner % 2 ? 1.0 : -1.0, corner / 2 % 2 ? 1.0 : -1.0, corner / 4 ? 1.0 : -1.0}};
      settle(0.999 * to_bound.lu().solve(signs.cwiseProduct(room)));
    }
    CAPTURE(range.amplitude_min, range.amplitude_max, least, most);
    CHECK(least > range.amplitude_min * (1 - 1e-4));
    CHECK(most < range.amplitude_max * (1 + 1e-4));
    CHECK(least < range.amplitude_min + 0.05 * spread);
    CHECK(most > range.amplitude_max - (slips < 1 ? 0.05 : 0.002) * spread);
  }
}
