#pragma once
// Scenes with modes, and their branches.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/reasons.hpp>

#include <string>

namespace modes {

using namespace arcslip;
using observables::ResponseBranch;
using observables::ResponsePoint;
using scenes::parse;

// One mass, m = k = 1 unless reported, with elements.
inline scene::Scene oscillator(const std::string& elements, int order, double damping = 0,
                               const std::string& excitation = R"("harmonic": 1, "cosine": 1)") {
  return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}],
      "dampers": [{"name": "c", "at": "x", "value": )" +
               std::to_string(damping) + R"(}]},
    "elements": [)" +
               elements + R"(], "excitation": [{"name": "f", "at": "x", )" + excitation +
               R"(}], "harmonics": {"order": )" + std::to_string(order) + R"(},
    "response": {"at": "x"}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
}

inline double value_of(const scene::Scene& s, const std::string& name) {
  const model::Model built = model::build(s);
  return built.parameters[static_cast<std::size_t>(model::parameter_index(built, name))].value;
}

// The displacement at which the contact "damper" begins to slip.
inline double onset_of_slip(const scene::Scene& s) {
  return value_of(s, "damper.friction_coefficient") * value_of(s, "damper.normal_load") /
         value_of(s, "damper.stiffness");
}

inline ResponseBranch mode(const scene::Scene& s, int number, double from, double to) {
  return observables::nonlinear_modes(s, {number, from, to}).front();
}

// The last point of a branch that must be complete.
inline ResponsePoint at_end(const ResponseBranch& branch, double amplitude) {
  INFO(branch.stop.message);
  REQUIRE(branch.status == observables::Status::complete);
  CHECK(branch.stop.reason == observables::reasons::boundary);
  CHECK(branch.points.back().amplitude == Approx(amplitude).epsilon(1e-14));
  return branch.points.back();
}

inline constexpr const char* cubic = R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1})";

// Two masses of 1 between walls, on springs of 1.
inline std::string two_masses(const std::string& elements, int order, const std::string& response) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k1", "at": "x1", "value": 1}, {"name": "k12", "between": ["x1", "x2"], "value": 1},
                  {"name": "k2", "at": "x2", "value": 1}]},
    "elements": [)" +
         elements + R"(], "excitation": [{"name": "f", "at": "x1", "cosine": 1}],
    "harmonics": {"order": )" +
         std::to_string(order) + R"(}, "response": {"at": ")" + response +
         R"("}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})";
}

inline constexpr const char* cubic_at_x1 =
    R"({"name": "s", "type": "cubic_spring", "at": "x1", "stiffness": 0.5})";

inline std::string failure(const scene::Scene& s, int number, double from, double to,
                           const results::Reason& reason) {
  const ResponseBranch branch = mode(s, number, from, to);
  CHECK(branch.status == observables::Status::failed);
  CHECK(branch.stop.reason == reason);
  CHECK(branch.points.empty());
  CHECK(branch.events.empty());
  return branch.stop.message;
}

inline void check_contains(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
}

}  // namespace modes
