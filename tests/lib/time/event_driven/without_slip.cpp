// Structures without slip, against closed forms.
#include "catch.hpp"

#include "lib/time/equation/systems.hpp"

#include <arcslip/time/event_driven/event_driven.hpp>

using namespace arcslip::time;
using namespace systems;

namespace {

std::vector<double> instants(double end, int count) {
  std::vector<double> t;
  for (int i = 0; i <= count; ++i) t.push_back(end * i / count);
  return t;
}

// The largest difference from x(t), relative to the largest x.
template <class Function>
double error(const EquationOfMotion& equation, const MotionState& start, double end, Function&& x) {
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(start, 0, end, instants(end, 97));
  REQUIRE(motion.reason == EndReason::reached);
  REQUIRE(motion.history.time.size() == 98);
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < motion.history.time.size(); ++i) {
    const double exact = x(motion.history.time[i]);
    worst = std::max(worst, std::abs(motion.history.displacement[i] - exact));
    size = std::max(size, std::abs(exact));
  }
  return worst / size;
}

MotionState moving(double x, double v) {
  return {Vector::Constant(1, x), Vector::Constant(1, v), Vector()};
}

}  // namespace

TEST_CASE("an undamped oscillator in resonance grows as f0 t sin(w t)/(2 m w)") {
  const double m = 1.24, w = 120.1, f0 = 2;
  const auto equation = oscillator(m, 0, m * w * w, f0, w);
  CHECK(error(equation, at_rest(equation), 50 * equation.period(),
              [&](double t) { return f0 * t / (2 * m * w) * std::sin(w * t); }) < 1e-12);
}

TEST_CASE("a free mass under cos(w t) drifts not at all, and one that moves keeps its speed") {
  const auto equation = oscillator(2, 0, 0, 3, 1.7);
  CHECK(error(equation, at_rest(equation), 40,
              [](double t) { return 3 / (2 * 1.7 * 1.7) * (1 - std::cos(1.7 * t)); }) < 1e-13);
  const auto free = masses(Vector::Constant(1, 2));
  CHECK(error(free, moving(1, -0.3), 1e4, [](double t) { return 1 - 0.3 * t; }) < 1e-15);
}

TEST_CASE("a critically damped oscillator returns as (x0 + (v0 + w x0) t) exp(-w t)") {
  const double w = 3;
  CHECK(error(oscillator(1, 2 * w, w * w), moving(1, -7), 8,
              [&](double t) { return (1 + (-7 + w) * t) * std::exp(-w * t); }) < 1e-14);
}

TEST_CASE("an overdamped oscillator whose rates differ by 1e4 follows both") {
  const double a = 0.02, b = 200;  // x = exp(-a t), exp(-b t)
  CHECK(error(oscillator(1, a + b, a * b), moving(1, 3), 10, [&](double t) {
          const double fast = (3 + a) / (a - b);
          return (1 - fast) * std::exp(-a * t) + fast * std::exp(-b * t);
        }) < 1e-14);
}

TEST_CASE("a mean force and a mean speed of a free mass make a parabola") {
  auto equation = masses(Vector::Constant(1, 2));
  equation.forces.push_back({Vector::Ones(1), 0, 3, 99});  // sin 0 = 0: the 99 N do nothing
  CHECK(error(equation, moving(1, -4), 20, [](double t) { return 1 - 4 * t + 0.75 * t * t; }) < 1e-15);
}

TEST_CASE("two masses tied by a spring move as their modes do") {
  auto equation = masses(Vector{{1.0, 1.0}});
  equation.K << 2, -1, -1, 2;  // w^2 = 1, 3
  const MotionState start{Vector{{1.0, 0.0}}, Vector{{0.0, 0.5}}, Vector()};
  CHECK(error(equation, start, 60, [](double t) {
          const double w = std::sqrt(3.0);
          return 0.5 * (std::cos(t) + std::cos(w * t)) + 0.25 * (std::sin(t) - std::sin(w * t) / w);
        }) < 1e-13);
}

TEST_CASE("the amplitude is the extreme between the instants, not the largest of them") {
  const auto equation = oscillator(1, 0, 4);  // x = 0.3 cos 2t + 0.2 sin 2t
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(moving(0.3, 0.4), 0, 3);
  CHECK(motion.amplitude == Approx(std::hypot(0.3, 0.2)).epsilon(1e-15));
  CHECK(std::fmod(2 * motion.amplitude_time, std::acos(-1.0)) == Approx(std::atan2(0.2, 0.3)).epsilon(1e-13));
}

TEST_CASE("a stuck damper is a spring from where its slider is") {
  auto equation = oscillator(1, 0, 3);
  add_damper(equation, Vector::Ones(1), 1, 100);
  MotionState start{Vector::Zero(1), Vector::Zero(1), Vector::Constant(1, 0.8)};
  CHECK(error(equation, start, 30, [](double t) { return 0.2 * (1 - std::cos(2 * t)); }) < 1e-13);
}
