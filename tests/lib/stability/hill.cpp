// Hill's method next to closed forms and next to the multipliers in time.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/stability/along_harmonics.hpp"
#include "lib/stability/cosine.hpp"
#include "lib/stability/multiplier_distance.hpp"
#include "lib/time/equation/systems.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/laws/memoryless/gap_spring.hpp>
#include <arcslip/laws/memoryless/polynomial_spring.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/stability/hill.hpp>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

using namespace arcslip;
using namespace arcslip::time;
using multiplier_distance::difference;
using std::numbers::pi;

namespace {

struct Both {
  std::vector<std::complex<double>> in_time, by_hill, half_in_time, half_by_hill;
};

Both multipliers_both_ways(const scene::Scene& s, double frequency) {
  const auto pair = compared_with_exact::balanced(s, frequency);
  const auto courses = along_harmonics::courses(pair);
  Floquet floquet(pair.equation);
  Hill hill(pair.equation);
  REQUIRE(floquet.compute(pair.equation.omega, pair.problem->harmonics(), courses));
  REQUIRE(hill.compute(pair.equation.omega, pair.problem->harmonics(), courses));
  return {floquet.multipliers(), hill.multipliers(), floquet.half_multipliers(), hill.half_multipliers()};
}

scene::Scene two_cubic_masses(int order, const std::string& more = "") {
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 0.6}],
      "springs": [{"name": "k1", "at": "x1", "value": 1}, {"name": "k12", "between": ["x1", "x2"], "value": 0.8}],
      "dampers": [{"name": "c1", "at": "x1", "value": 0.02}, {"name": "c2", "at": "x2", "value": 0.05}]},
    "elements": [{"name": "s1", "type": "cubic_spring", "at": "x1", "stiffness": 0.7},
      {"name": "s2", "type": "cubic_spring", "between": ["x1", "x2"], "stiffness": 0.4}],
    "excitation": [{"name": "force", "at": "x1", "cosine": 0.5})" +
                         more + R"(], "response": {"at": "x1"}})");
  s.harmonics.order = order;
  return s;
}

}  // namespace

TEST_CASE("Hill's method: on the boundaries of Mathieu's stability the trace of the map is 2 or -2",
          "[numbers]") {
  const double q = 5, by_cubic = 1.5, A = std::sqrt(2 * q / by_cubic);
  const struct {
    double a, trace;
  } cases[] = {
      {-5.80004602085, 2}, {-5.79008059864, -2}, {1.85818754155, -2}, {2.09946044549, 2}, {7.44910973953, 2}};
  for (const bool odd : {false, true})
    for (const auto& [a, trace] : cases) {
      CAPTURE(a, odd);
      auto equation = systems::oscillator(1, 0, a - by_cubic * A * A);
      equation.add("cubic", elements::cubic_spring().law({}), {1.0}, Matrix::Ones(1, 1));
      CHECK(std::abs(cosine::trace<Hill>(equation, {1, odd}, A) - (odd ? -trace : 2)) < (odd ? 1e-8 : 1e-7));
    }
}

TEST_CASE(
    "Hill's method: the trace of Meissner's equation, whose stiffness jumps, converges with the orders") {
  auto equation = systems::oscillator(1, 0, 0.5);
  equation.add("stop", elements::gap_spring().law({}), {1.0, 0.0}, Matrix::Ones(1, 1));
  const double a = std::sqrt(1.5), b = std::sqrt(0.5);
  const double exact =
      2 * std::cos(pi * a) * std::cos(pi * b) - (a / b + b / a) * std::sin(pi * a) * std::sin(pi * b);
  const double coarse = std::abs(cosine::trace<Hill>(equation, {5}, 1) - exact),
               fine = std::abs(cosine::trace<Hill>(equation, {15}, 1) - exact);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-3);
  CHECK(fine < 0.3 * coarse);  // 20 and 40 orders
}

TEST_CASE(
    "Hill's method: the product of the multipliers is what damping leaves, also by the motion's velocity") {
  auto self = systems::oscillator(1, 0, 1);
  self.add("vdp", elements::van_der_pol().law({}), {0.3, 0.5}, Matrix::Ones(1, 1));
  Hill hill(self);
  REQUIRE(hill.compute(1.1, {1}, cosine::along(self, {1}, 0.9)));
  const double damping = 0.3 * (0.9 * 0.9 / (2 * 0.25) - 1);
  CHECK(std::abs(hill.map().determinant() * std::exp(damping * 2 * pi / 1.1) - 1) < 1e-9);
}

TEST_CASE("Hill's method agrees with the multipliers in time along smooth motions", "[numbers]") {
  for (const double frequency : {0.3, 0.9, 1.3, 2.4}) {
    CAPTURE(frequency);
    const auto both = multipliers_both_ways(two_cubic_masses(9), frequency);
    REQUIRE(both.by_hill.size() == 4);
    REQUIRE(both.half_by_hill.size() == 4);
    CHECK(difference(both.in_time, both.by_hill) < 1e-9);
    CHECK(difference(both.half_in_time, both.half_by_hill) < 1e-9);
    const auto all = multipliers_both_ways(
        two_cubic_masses(9, R"(, {"name": "second", "at": "x2", "harmonic": 2, "sine": 0.2})"), frequency);
    CHECK(all.half_by_hill.empty());
    CHECK(difference(all.in_time, all.by_hill) < 1e-9);
  }
}

TEST_CASE("Hill's method is refused with the reason where a slider has a memory") {
  const auto pair = compared_with_exact::balanced(scenes::paper(3), 20);
  CHECK_THROWS_WITH(Hill(pair.equation),
                    "Hill's method is for laws without memory: that of \"damper\" makes its "
                    "spectrum fragment");
  CHECK_THROWS_AS(Hill(systems::oscillator(0, 0.1, 1)), SingularMass);
}

TEST_CASE("Hill's method: no multipliers along a motion that is not finite or too fast") {
  auto equation = systems::oscillator(1, 0.1, 1);
  equation.add("cubic", elements::cubic_spring().law({}), {1.0}, Matrix::Ones(1, 1));
  Hill hill(equation);
  for (const double amplitude : {double(NAN), 1e200, double(INFINITY), 1e9})
    CHECK_FALSE(hill.compute(1, {1}, cosine::along(equation, {1}, amplitude)));
  CHECK(hill.compute(1, {1}, cosine::along(equation, {1}, 0.5)));
  CHECK_FALSE(hill.compute(1, {1}, cosine::along(equation, {1}, 0.5), controls::stopped()));
}
