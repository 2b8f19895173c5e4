// Multipliers of piecewise linear structures in the oscillators of each set of modes: where modes are nearly
// defective, where there is no mass, and on the modes that matter.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/stability/along_harmonics.hpp"
#include "lib/stability/multiplier_distance.hpp"
#include "lib/time/equation/systems.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>
#include <arcslip/stability/floquet.hpp>
#include <arcslip/stability/stability.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

using namespace arcslip;
using namespace arcslip::time;
using multiplier_distance::difference;

namespace {

using Complex = std::complex<double>;
constexpr double turn = 2 * std::numbers::pi;

// The sum of exp(lambda T) over the eigenvalues of a structure without elements: as accurate next to a double
// one as elsewhere.
double trace_of(const EquationOfMotion& equation) {
  const auto n = equation.dofs();
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  const Matrix inverse = equation.M.diagonal().cwiseInverse().asDiagonal();
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -inverse * equation.K;
  A.bottomRightCorner(n, n) = -inverse * equation.C;
  Complex sum = 0;
  for (const Complex& each : continuation::eigenvalues(A)) sum += std::exp(each * equation.period());
  return sum.real();
}

double trace_of_map(const EquationOfMotion& equation) {
  Floquet floquet(equation);
  REQUIRE(floquet.compute(equation.omega, {1}, {}));
  return floquet.map().trace();
}

std::string text(int n) {
  return std::to_string(n);
}

// A chain from the ground on, with a friction damper at a third and one at the end of it.
scene::Scene chain(int n, int order, double damping) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": [{"repeat": )" +
                       text(n) + R"(, "name": "x{i}"}],
      "masses": [{"repeat": )" +
                       text(n) + R"(, "name": "m{i}", "at": "x{i}", "value": 1}],
      "springs": [{"name": "k0", "at": "x1", "value": 1},
                  {"repeat": )" +
                       text(n - 1) + R"(, "name": "k{i}", "between": ["x{i}", "x{i+1}"], "value": 1}],
      "dampers": [{"repeat": )" +
                       text(n) + R"(, "name": "c{i}", "at": "x{i}", "value": )" + std::to_string(damping) +
                       R"(}]},
    "elements": [{"name": "d1", "type": "jenkins", "at": "x)" +
                       text(n / 3) + R"(", "stiffness": 0.3,
        "friction_coefficient": 0.5, "normal_load": 0.2},
      {"name": "d2", "type": "jenkins", "at": "x)" +
                       text(n) + R"(", "stiffness": 0.5, "friction_coefficient": 0.5,
        "normal_load": 0.3}],
    "excitation": [{"name": "force", "at": "x)" +
                       text(n) + R"(", "cosine": 0.1}], "response": {"at": "x)" + text(n) +
                       R"("}, "harmonics": {"order": )" + text(order) + "}}");
}

}  // namespace

TEST_CASE("next to where eigenvectors are parallel the map has the trace of the closed form") {
  // A damper along (1, 1) of two masses: as it grows, pairs of eigenvalues meet.
  auto equation = systems::masses(Vector{{1.0, 1.0}});
  equation.K << 1, 0, 0, 4;
  equation.omega = 1.3;
  for (int i = 0; i <= 400; ++i) {
    const double c = 0.02 * i;
    CAPTURE(c);
    equation.C = Matrix::Constant(2, 2, c);
    CHECK(std::abs(trace_of_map(equation) - trace_of(equation)) < 1e-11);
  }
  // Critical damping, next to it, a motion without a spring, and one that grows.
  for (const double k : {1.0, 1 + 1e-12, 1 - 1e-12, 1 - 1e-7, 0.0, -0.3})
    for (const double c : {2.0, 0.0}) {
      CAPTURE(k, c);
      const auto one = systems::oscillator(1, c, k);
      const double gamma = c / 2, square = k - gamma * gamma, nu = std::sqrt(std::abs(square));
      const double exact =
          2 * std::exp(-gamma * turn) * (square >= 0 ? std::cos(nu * turn) : std::cosh(nu * turn));
      CHECK(std::abs(trace_of_map(one) - exact) < 1e-12 * std::max(1.0, exact));
    }
}

TEST_CASE("a slider behind a spring without a mass between them is one slider on both springs in series") {
  // x - spring k_s - node without mass - slider: in slip the node follows the slider's constant force.
  const double k_s = 5000, k_t = 3500, in_series = k_s * k_t / (k_s + k_t);
  const auto balanced = [](const std::string& dofs, const std::string& spring, const std::string& at,
                           double stiffness, int order) {
    auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
      "structure": {"dofs": [)" +
                           dofs + R"(], "masses": [{"name": "m", "at": "x", "value": 1.24}],
        "springs": [{"name": "k", "at": "x", "value": 17890})" +
                           spring + R"(],
        "dampers": [{"name": "c", "at": "x", "value": 0.134}]},
      "elements": [{"name": "damper", "type": "jenkins", "at": ")" +
                           at + R"(", "stiffness": 1,
        "friction_coefficient": 0.5, "normal_load": 3}],
      "excitation": [{"name": "force", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
    scene::set(s, "damper.stiffness", stiffness);
    s.harmonics.order = order;
    return compared_with_exact::balanced(s, 20);
  };
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    const int order = i == 0 ? 9 : 61;
    const auto with_node = balanced(
        R"("x", "node")", R"(, {"name": "s", "between": ["x", "node"], "value": 5000})", "node", k_t, order);
    const auto without = balanced(R"("x")", "", "x", in_series, order);
    Floquet massless(with_node.equation), simple(without.equation);
    CHECK(massless.modes() == 1);
    const auto expected = along_harmonics::multipliers(without, simple);
    CHECK(std::abs(expected[0]) < 1);
    // The node's motion has a corner at each onset of slip.
    errors[i] = difference(along_harmonics::multipliers(with_node, massless), expected);
    // Of the same motion, to rounding.
    CHECK(difference(along_harmonics::multipliers(without, massless), expected) < 1e-13);
  }
  CAPTURE(errors[0], errors[1]);
  CHECK(errors[0] < 2e-2);
  CHECK(errors[1] < 0.15 * errors[0]);
}

TEST_CASE("a degree of freedom without mass that has a damper, or nothing, is named") {
  auto equation = systems::masses(Vector{{1.0, 0.0}});
  equation.dof_names = {"x", "tip"};
  equation.K << 2, -1, -1, 1;
  CHECK_NOTHROW(Floquet(equation));
  equation.C(1, 1) = 0.1;
  CHECK_THROWS_WITH(Floquet(equation),
                    "degree of freedom \"tip\" has no mass of its own, and a damper acts on it");
  equation.C.setZero();
  equation.K << 1, 0, 0, 0;
  CHECK_THROWS_WITH(
      Floquet(equation),
      "degree of freedom \"tip\" has no mass of its own, and no spring of the structure holds it");
}

TEST_CASE(
    "on the modes that matter a chain has the multipliers of all of its modes, and an error that says so") {
  for (const int n : {30, 100}) {
    CAPTURE(n);
    const double first = 2 * std::sin(turn / 4 / (2 * n + 1));
    const auto pair = compared_with_exact::balanced(chain(n, 5, 0.2 * first), 1.2 * first);
    Floquet whole(pair.equation);
    const auto exact = along_harmonics::multipliers(pair, whole);
    for (const double reach : {3.0, 6.0}) {
      CAPTURE(reach);
      const double harmonic = 5 * pair.equation.omega;
      Floquet reduced(pair.equation, {reach * harmonic}), finer(pair.equation, {2 * reach * harmonic});
      REQUIRE(reduced.modes() < n);
      const auto found = along_harmonics::multipliers(pair, reduced);
      CHECK(static_cast<int>(found.size()) <= 2 * reduced.modes() + 2);
      const double error = observables::distance(found, exact),
                   estimate = observables::distance(found, along_harmonics::multipliers(pair, finer));
      CAPTURE(error, estimate);
      CHECK(error < 2 * estimate);
      CHECK(error < 0.1);
      CHECK(std::abs(std::abs(found.front()) - std::abs(exact.front())) < 1e-2);
    }
  }
}

TEST_CASE("with another load or stiffness the multipliers are those of a structure met for the first time") {
  const auto pair = [](double load, double stiffness) {
    auto s = chain(5, 7, 0.05);
    scene::set(s, "d1.normal_load", load);
    scene::set(s, "d2.stiffness", stiffness);
    return compared_with_exact::balanced(s, 0.4);
  };
  const auto start = pair(0.2, 0.5);
  Floquet moved(start.equation);
  along_harmonics::multipliers(start, moved);
  for (const auto& [load, stiffness] : {std::pair{0.1, 0.5}, {0.1, 0.7}, {0.2, 0.5}}) {
    CAPTURE(load, stiffness);
    const auto there = pair(load, stiffness);
    Floquet fresh(there.equation);
    moved.move_to(there.equation);
    CHECK(difference(along_harmonics::multipliers(there, moved), along_harmonics::multipliers(there, fresh)) <
          1e-12);
  }
  auto massless = start.equation;
  massless.M(0, 0) = 0;
  CHECK_THROWS_AS(moved.move_to(massless), SingularMass);
  CHECK(along_harmonics::multipliers(start, moved).size() > 0);
}
