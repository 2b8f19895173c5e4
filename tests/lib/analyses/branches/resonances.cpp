// Where resonances lie: natural frequencies in closed form, free and stuck, and what is reported next to a
// window.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/branches/resonances.hpp>
#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/model/model.hpp>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using namespace arcslip;
using observables::Contacts;
using observables::ModeAtRest;
using std::numbers::pi;

namespace {

/// Two equal masses between walls: springs k at the walls, k2 between, a friction element at the first mass.
/// The frequencies of the free structure are sqrt(k/m) and sqrt((k + 2 k2)/m).
scene::Scene pair(const std::string& response = R"({"at": "a"})",
                  const std::string& force = R"({"name": "f", "at": "a", "cosine": 1})",
                  const std::string& elements = R"({"name": "d", "type": "jenkins", "at": "a", "stiffness": 5,
                    "friction_coefficient": 0.5, "normal_load": 1})",
                  const std::string& more_masses = "") {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["a", "b"],
    "masses": [{"name": "ma", "at": "a", "value": 2}, {"name": "mb", "at": "b", "value": 2})" +
                       more_masses + R"(],
    "springs": [{"name": "ka", "at": "a", "value": 8}, {"name": "kb", "at": "b", "value": 8},
                {"name": "k2", "between": ["a", "b"], "value": 21}],
    "dampers": [{"name": "ca", "at": "a", "value": 0.1}, {"name": "cb", "at": "b", "value": 0.1}]},
    "elements": [)" + elements +
                       R"(], "excitation": [)" + force + R"(], "response": )" + response +
                       R"(, "harmonics": {"order": 2}})");
}

std::vector<ModeAtRest> modes(const scene::Scene& scene, Contacts contacts) {
  const model::Model model = model::build(scene);
  const auto found = observables::modes_at_rest(model, model::defaults(model), contacts);
  REQUIRE(found);
  return *found;
}

/// Roots of m^2 w^4 - m (2 (k + k2) + e) w^2 + (k + k2 + e)(k + k2) - k2^2, with m = 2, k = 8, k2 = 21.
std::vector<double> with_spring_at_first(double e) {
  const double half = (29 + 29 + e) / 2, root = std::sqrt(half * half - ((29 + e) * 29 - 441));
  return {std::sqrt((half - root) / 2), std::sqrt((half + root) / 2)};
}

}  // namespace

TEST_CASE("natural frequencies are those of the free structure, and of the one whose contacts are springs") {
  const scene::Scene scene = pair();
  const auto free = modes(scene, Contacts::free), stuck = modes(scene, Contacts::stuck);
  REQUIRE(free.size() == 2);
  CHECK(std::abs(free[0].omega - 2) < 1e-14);
  CHECK(std::abs(free[1].omega - 5) < 1e-14);
  const auto expected = with_spring_at_first(5);
  REQUIRE(stuck.size() == 2);
  for (const std::size_t k : {0U, 1U}) CHECK(std::abs(stuck[k].omega / expected[k] - 1) < 1e-14);
}

TEST_CASE("springs act with their tangent at rest, a gap and rigid friction are open or closed") {
  const auto with = [](const std::string& element, Contacts contacts) {
    return modes(pair(R"({"at": "a"})", R"({"name": "f", "at": "a", "cosine": 1})", element), contacts);
  };
  // k q + 7 q^3 at the first mass, and k q_1 q_2 between both: with a negative k softer than at rest it could
  // be.
  for (const double k : {5.0, -3.0}) {
    const auto spring =
        with(R"({"name": "e", "type": "polynomial_spring", "at": "a", "coefficients": {"1": )" +
                 std::to_string(k) + R"(, "3": 7}})",
             Contacts::free);
    const auto expected = with_spring_at_first(k);
    CHECK(std::abs(spring[0].omega - expected[0]) < 1e-13);
    CHECK(std::abs(spring[1].omega - expected[1]) < 1e-13);
    const auto coupling = with(
        R"({"name": "e", "type": "polynomial_coupling", "potential": [{"powers": {"a": 1, "b": 1}, "value": )" +
            std::to_string(k) + R"(}]})",
        Contacts::stuck);
    CHECK(std::abs(coupling[0].omega - std::sqrt((8 + k) / 2)) < 1e-13);  // both masses alike
    CHECK(std::abs(coupling[1].omega - std::sqrt((50 - k) / 2)) < 1e-13);
  }
  const std::string gap = R"({"name": "e", "type": "gap_spring", "at": "a", "stiffness": 5, "gap": 0.1})";
  const std::string rigid =
      R"({"name": "e", "type": "coulomb", "at": "a", "friction_coefficient": 0.5, "normal_load": 1})";
  const auto closed = with_spring_at_first(5);
  for (const Contacts contacts : {Contacts::free, Contacts::stuck}) {
    const bool stuck = contacts == Contacts::stuck;
    const auto of_gap = with(gap, contacts), of_rigid = with(rigid, contacts);
    CHECK(std::abs(of_gap[0].omega - (stuck ? closed[0] : 2)) < 1e-13);
    CHECK(std::abs(of_gap[1].omega - (stuck ? closed[1] : 5)) < 1e-13);
    // The first mass is held: the second one is left, between 8 and 21 N/m.
    CHECK(std::abs(of_rigid[0].omega - (stuck ? std::sqrt(29 / 2.0) : 2)) < 1e-5);
  }
}

TEST_CASE("modes without a response or without an excitation are reported") {
  // In the first mode both masses move alike, in the second one against each other.
  const std::string difference = R"({"direction": {"a": 1, "b": -1}})";
  const std::string alike = R"({"name": "f", "direction": {"a": 1, "b": 1}, "cosine": 1})";
  const auto free = modes(pair(difference, alike), Contacts::free);
  CHECK(!free[0].responds);
  CHECK(free[0].driven);
  CHECK(free[1].responds);
  CHECK(!free[1].driven);
  for (const ModeAtRest& mode : modes(pair(), Contacts::free)) CHECK((mode.responds && mode.driven));
}

TEST_CASE("of modes of one frequency the motion that the excitation drives says whether the response moves") {
  // A mass that moves in two directions, with equal springs but for the factor of the second one.
  const auto in_plane = [](const std::string& force, const std::string& response, const std::string& second) {
    return modes(scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["x", "y"], "masses": [{"name": "mx", "at": "x", "value": 2}, {"name": "my", "at": "y", "value": 2}],
    "springs": [{"name": "kx", "at": "x", "value": 8}, {"name": "ky", "at": "y", "value": )" +
                               second + R"(}]}, "excitation": [{"name": "f", "direction": )" + force +
                               R"(, "cosine": 1}], "response": {"direction": )" + response + "}}"),
                 Contacts::free);
  };
  const std::string x = R"({"x": 1})", y = R"({"y": 1})", skew = R"({"x": 3, "y": 4})",
                    across = R"({"x": 4, "y": -3})";
  for (const char* const second : {"8", "8.000008"}) {  // frequencies 5e-7 apart
    for (const auto& along : {x, y, skew})
      for (const ModeAtRest& mode : in_plane(along, along, second)) CHECK((mode.responds && mode.driven));
    for (const ModeAtRest& mode : in_plane(skew, x, second)) CHECK((mode.responds && mode.driven));
    for (const auto& [force, response] : {std::pair{x, y}, {skew, across}})
      for (const ModeAtRest& mode : in_plane(force, response, second)) CHECK((!mode.responds && mode.driven));
  }
  const auto apart = in_plane(x, x, "8.0001");  // 6e-6 apart
  CHECK((apart[0].responds && apart[0].driven));
  CHECK((!apart[1].responds && !apart[1].driven));
}

TEST_CASE("a motion that no spring resists has no natural frequency") {
  const scene::Scene scene =
      scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["a", "b"], "masses": [{"name": "ma", "at": "a", "value": 2}, {"name": "mb", "at": "b", "value": 2}],
    "springs": [{"name": "k", "between": ["a", "b"], "value": 9}]},
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "response": {"at": "a"}})");
  const auto found = modes(scene, Contacts::free);
  REQUIRE(found.size() == 1);
  CHECK(std::abs(found[0].omega - 3) < 1e-14);
}

TEST_CASE("a mass that only a contact holds has a natural frequency while it sticks") {
  const scene::Scene scene =
      scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["a"], "masses": [{"name": "m", "at": "a", "value": 2}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "a", "stiffness": 18, "friction_coefficient": 0.5, "normal_load": 1}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "response": {"at": "a"}})");
  CHECK(modes(scene, Contacts::free).empty());
  const auto stuck = modes(scene, Contacts::stuck);
  REQUIRE(stuck.size() == 1);
  CHECK(std::abs(stuck[0].omega - 3) < 1e-14);
}

TEST_CASE("in a sector they are those of the wave of the excitation") {
  for (const int order : {0, 1, 3, 5, 6}) {
    CAPTURE(order);
    const scene::Scene scene =
        scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
      "cyclic": {"sectors": 6, "engine_order": )" +
                      std::to_string(order % 6) + R"(},
      "dofs": ["a"], "masses": [{"name": "m", "at": "a", "value": 2}],
      "springs": [{"name": "k", "at": "a", "value": 8}, {"name": "c", "between": ["a", {"next": "a"}], "value": 3}]},
      "excitation": [{"name": "f", "at": "a", "cosine": 1}], "response": {"at": "a"}})");
    const auto found = modes(scene, Contacts::free);
    REQUIRE(found.size() == 1);
    const double s = std::sin(pi * order / 6);
    CHECK(std::abs(found[0].omega - std::sqrt((8 + 4 * 3 * s * s) / 2)) < 1e-14);
  }
}

TEST_CASE("a window is reported which resonances lie below, within and above it") {
  const model::Model model = model::build(pair());
  const auto all = observables::resonances(model, model::defaults(model));
  const auto unit = scene::FrequencyUnit::radian_per_second;
  CHECK(
      observables::text_of(all, {3, 4}, unit) ==
      "natural frequencies with all contacts free: 2 rad/s below, 5 rad/s above; stuck: 2.2751 rad/s below, "
      "5.1307 rad/s above");
  CHECK(observables::text_of(all, {1, 10}, unit) ==
        "natural frequencies with all contacts free: 2 and 5 rad/s within; stuck: 2.2751 and 5.1307 rad/s "
        "within");
  CHECK(observables::text_of(all, unit) ==
        "natural frequencies with all contacts free: 2 and 5 rad/s; stuck: 2.2751 and 5.1307 rad/s");
  const auto third =
      model::build(pair(R"({"at": "a"})", R"({"name": "f", "at": "a", "harmonic": 2, "cosine": 1})", ""));
  CHECK(observables::text_of(observables::resonances(third, model::defaults(third)), {1.5, 2}, unit) ==
        "natural frequencies over 2 (the lowest harmonic of the excitation): 1 rad/s below, 2.5 rad/s above");
}

TEST_CASE("a frequency response without a peak says where resonances lie, and one with a peak does not") {
  const scene::Scene scene = pair();
  const auto without = observables::frequency_response(scene, {.from = 3, .to = 4});
  REQUIRE(without.size() == 1);
  CHECK(without[0].no_peak ==
        "no peak between 3 rad/s and 4 rad/s; natural frequencies with all contacts free: 2 rad/s below, 5 "
        "rad/s "
        "above; stuck: 2.2751 rad/s below, 5.1307 rad/s above");
  CHECK(observables::frequency_response(scene, {.from = 1, .to = 4})[0].no_peak.empty());
  const auto shooting = observables::frequency_response(
      scene, {.from = 3, .to = 4, .method = observables::ResponseMethod::shooting});
  CHECK(shooting[0].no_peak == without[0].no_peak);
  const auto curves = observables::resonance_peaks(scene, {"d.normal_load", 0.5, 1, 3, 4});
  REQUIRE(curves.size() == 1);
  CHECK(curves[0].stop.message.ends_with("above; stuck: 2.2751 rad/s below, 5.1307 rad/s above"));
}

TEST_CASE("mass and stiffness taken for each other are asked about") {
  // As meant: sqrt(k/m) = 300 rad/s; given the other way round 1/300 rad/s.
  const auto scene = [](double mass, double spring) {
    return scenes::parse(
        R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["a"],
      "masses": [{"name": "m", "at": "a", "value": )" +
        std::to_string(mass) + R"(}],
      "springs": [{"name": "k", "at": "a", "value": )" +
        std::to_string(spring) + R"(}],
      "dampers": [{"name": "c", "at": "a", "value": 1}]},
      "excitation": [{"name": "f", "at": "a", "cosine": 1}], "response": {"at": "a"}})");
  };
  const auto swapped = observables::frequency_response(scene(180000, 2), {.from = 100, .to = 500});
  CHECK(swapped[0].no_peak.ends_with(
      "are mass and stiffness taken for each other? Then they would be 300 rad/s"));
  const auto low = observables::frequency_response(scene(180000, 2), {.from = 10, .to = 50});
  CHECK(low[0].no_peak.ends_with("natural frequencies: 0.0033333 rad/s below"));
}

TEST_CASE("a narrow window has as many points as its curve asks for, and a resonance in it is found") {
  // m = k = 1: the peak is at sqrt(1 - 2 zeta^2) with the amplitude 1/(2 zeta sqrt(1 - zeta^2)).
  const auto response = [](double zeta) {
    std::ostringstream damping;
    damping << 2 * zeta;
    const auto scene =
        scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["a"],
      "masses": [{"name": "m", "at": "a", "value": 1}], "springs": [{"name": "k", "at": "a", "value": 1}],
      "dampers": [{"name": "c", "at": "a", "value": )" +
                      damping.str() + R"(}]},
      "excitation": [{"name": "f", "at": "a", "cosine": 1}], "response": {"at": "a"}, "harmonics": {"order": 1}})");
    const auto branches = observables::frequency_response(scene, {.from = 0.9999, .to = 1.0001});
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].status == observables::Status::complete);
    return branches[0];
  };
  CHECK(response(0.2).points.size() < 30);
  for (const double zeta : {1e-4, 1e-5, 2e-6}) {
    const auto branch = response(zeta);
    CAPTURE(zeta, branch.points.size());
    REQUIRE(branch.events.size() == 1);
    CHECK(std::abs(branch.events[0].point.omega - std::sqrt(1 - 2 * zeta * zeta)) < 1e-14);
    CHECK(std::abs(branch.events[0].point.amplitude * 2 * zeta * std::sqrt(1 - zeta * zeta) - 1) < 1e-9);
  }
}
