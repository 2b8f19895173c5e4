// Uses each of the three libraries once. Exit code 0 where all of them answer as they should.
#include <arcslip/continuation/problem/problem_from_functions.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <cmath>
#include <iostream>
#include <sstream>

namespace {

// u = p^2 from p = 0 to 2: the branch ends at (4, 2).
bool traces_a_parabola() {
  using namespace arcslip::continuation;
  const auto parabola =
      from_functions(1, {{"p", "", 0}}, [](In u, In p, Out F) { F[0] = u[0] - p[0] * p[0]; });
  Options options;
  options.lower = 0;
  options.upper = 2;
  const Branch branch = trace(parabola, {.u = Vector::Zero(1), .p = parameter_values(*parabola)}, options);
  return branch.stop.reason == StopReason::boundary && std::abs(branch.points.back().u[0] - 4) < 1e-9;
}

bool reads_a_scene() {
  std::istringstream file(R"({
    "format": "arcslip-scene-1",
    "structure": {"dofs": ["blade"], "masses": [{"name": "m", "at": "blade", "value": 1.24}],
                  "springs": [{"name": "k", "between": ["blade", "ground"], "value": 17890.0}]},
    "excitation": [{"name": "force", "at": "blade", "harmonic": 1, "cosine": 1.0}],
    "response": {"at": "blade"},
    "studies": [{"name": "frf", "kind": "frf", "from": 18.0, "to": 22.0}]})");
  return arcslip::scene::value(arcslip::scene::read(file, arcslip::studies::catalogue()), "m.value") == 1.24;
}

bool finds_a_minimum() {
  const auto square = [](std::span<const double> x, std::span<double> g) {
    if (!g.empty()) g[0] = 2 * (x[0] - 1);
    return (x[0] - 1) * (x[0] - 1);
  };
  const auto result = arcslip::optimize::minimize({.objective = square, .lower = {-5}, .upper = {5}}, {3});
  return is_converged(result.reason) && std::abs(result.x[0] - 1) < 1e-6;
}

}  // namespace

int main() {
  const bool traced = traces_a_parabola(), read = reads_a_scene(), found = finds_a_minimum();
  std::cout << "continuation " << traced << ", structures " << read << ", optimize " << found << '\n';
  return traced && read && found ? 0 : 1;
}
