#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/steady_state.hpp>

using namespace arcslip;

TEST_CASE("a response is found from rest where plain Newton cycles: 20 Hz, Fn = 2 N") {
  // Exact amplitude: tests/reference/exact_1dof.json.
  const auto point = scenes::response_at(scenes::paper(55, 2), 20);
  CHECK(std::abs(point.amplitude / 0.000833658419611 - 1) < 5e-8);
}

TEST_CASE("a response is found at every load and frequency, from nothing") {
  for (double hz : {0.3, 5.0, 18.0, 19.1, 20.0, 20.9, 30.0, 500.0})
    for (double load : {0.0, 1e-6, 0.1, 1.0, 2.0, 3.0, 4.0, 10.0, 300.0, 1e6}) {
      const auto s = scenes::paper(9, load);
      const auto model = std::make_shared<const model::Model>(model::build(s));
      const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1e-4, 25);
      const auto p = hbm::parameters_at(*problem, hz * scenes::hertz);
      const auto u = hbm::steady_state(problem, p);
      CAPTURE(hz, load);
      REQUIRE(u);
      const auto at = problem->hbm_evaluator();
      at->move_to(*u, p, continuation::Needs::residual);
      CHECK(at->residual().norm() < 1e-8);  // of a force of 1 N
    }
}
