#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/problem.hpp>

using namespace arcslip;

namespace {

// A response from nothing leaves no force: less than 1e-8 of what excites it.
void check_found(const scene::Scene& s, double omega) {
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1e-4, 25);
  const auto p = hbm::parameters_at(*problem, omega);
  const auto u = hbm::steady_state(problem, p).u;
  REQUIRE(u);
  const auto at = problem->hbm_evaluator();
  REQUIRE(at->move_to(*u, p, continuation::Needs::residual) == continuation::Evaluated::ok);
  continuation::Vector force(u->size());
  at->stiffness().force(force);
  CHECK(at->residual().norm() < 1e-8 * force.norm());
}

}  // namespace

TEST_CASE("a response is found from rest where plain Newton cycles: 20 Hz, Fn = 2 N") {
  // Exact amplitude: tests/reference/exact_1dof.json.
  const auto point = scenes::response_at(scenes::paper(55, 2), 20);
  CHECK(std::abs(point.amplitude / 0.000833658419611 - 1) < 5e-8);
}

TEST_CASE("a response is found at every load and frequency, from nothing") {
  for (double hz : {0.3, 5.0, 18.0, 19.1, 20.0, 20.9, 30.0, 500.0})
    for (double load : {0.0, 1e-6, 0.1, 1.0, 2.0, 3.0, 4.0, 10.0, 300.0, 1e6}) {
      CAPTURE(hz, load);
      check_found(scenes::paper(9, load), hz * scenes::hertz);
    }
}

TEST_CASE("a response is found where the branch from rest turns back through zero excitation") {
  // Seeds where neither Newton's method nor a branch that ends at zero excitation finds one.
  for (const std::uint64_t seed : {192, 2210, 4159, 4669, 4777, 5696, 6867, 6899}) {
    const scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first_and_second);
    const auto& window = scenes::window(s);
    for (double hz : {window.from, 0.5 * (window.from + window.to), window.to}) {
      CAPTURE(seed, hz);
      check_found(s, hz * scenes::hertz);
    }
  }
}

TEST_CASE("a response is found of a contact that lifts off without damping, next to stiff and soft springs") {
  // Newton's method from rest cycles, and branches over the excitation and the forces of the contact pass
  // undamped resonances.
  check_found(scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["t", "n"],
    "masses": [{"name": "mt", "at": "t", "value": 9.2}, {"name": "mn", "at": "n", "value": 1.69e-4}],
    "springs": [{"name": "kt", "at": "t", "value": 1.556e7}, {"name": "kn", "at": "n", "value": 1554},
                {"name": "ktn", "direction": {"t": 1, "n": 1}, "value": 0.194}],
    "dampers": [{"name": "ct", "at": "t", "value": 0.0136}]},
    "elements": [{"name": "pad", "type": "contact_2d", "tangential": {"at": "t"}, "normal": {"at": "n"},
                  "tangential_stiffness": 0.757, "normal_stiffness": 1.507e6, "friction_coefficient": 6.12e-4,
                  "normal_load": 0.0118}],
    "excitation": [{"name": "force", "direction": {"t": 1, "n": 0.6}, "cosine": -24.76},
                   {"name": "pull", "at": "n", "harmonic": 0, "cosine": -0.4}],
    "harmonics": {"order": 3}, "response": {"at": "t"}})"),
              2559.7);
}
