// Slip and its end, against closed forms and other integrations.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/time/equation/systems.hpp"

#include <arcslip/time/event_driven/event_driven.hpp>

#include <Eigen/LU>

#include <algorithm>

using namespace arcslip::time;
using namespace systems;

namespace {

MotionState at(double x, double v, double z) {
  return {Vector::Constant(1, x), Vector::Constant(1, v), Vector::Constant(1, z)};
}

std::vector<double> times(const EventDrivenMotion& motion, std::string_view to) {
  std::vector<double> t;
  for (const ContactEvent& event : motion.events)
    if (event.to == to) t.push_back(event.time);
  return t;
}

double relative_defect(const EnergyBalance& energy) {
  return std::abs(energy.defect()) /
         std::max({std::abs(energy.input), energy.friction, energy.viscous, std::abs(energy.stored)});
}

// Runge-Kutta of fourth order with small steps, the slider drawn after at the end of each.
MotionState small_steps(const EquationOfMotion& equation, MotionState s, double end, int steps) {
  const double h = end / steps;
  const Matrix inverse = equation.M.inverse();
  Vector f;
  const auto acceleration = [&](double t, const Vector& x, const Vector& v) -> Vector {
    equation.force(t, f);
    for (const TimeElement& e : equation.elements) {
      const Vector d = e.directions;
      const double force = e.fields[0] * (d.dot(x) - s.z[e.memory]), limit = systems::limit_of(e);
      f -= std::clamp(force, -limit, limit) * d;
    }
    return inverse * (f - equation.C * v - equation.K * x);
  };
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const Vector a1 = acceleration(t, s.x, s.v), v2 = s.v + 0.5 * h * a1;
    const Vector a2 = acceleration(t + 0.5 * h, s.x + 0.5 * h * s.v, v2), v3 = s.v + 0.5 * h * a2;
    const Vector a3 = acceleration(t + 0.5 * h, s.x + 0.5 * h * v2, v3), v4 = s.v + h * a3;
    const Vector a4 = acceleration(t + h, s.x + h * v3, v4);
    s.x += h / 6 * (s.v + 2 * v2 + 2 * v3 + v4);
    s.v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    for (const TimeElement& e : equation.elements) {
      const double q = Vector(e.directions).dot(s.x), reach = systems::limit_of(e) / e.fields[0];
      s.z[e.memory] = std::clamp(s.z[e.memory], q - reach, q + reach);
    }
  }
  return s;
}

double distance(const MotionState& a, const MotionState& b) {
  return std::max({(a.x - b.x).cwiseAbs().maxCoeff(), (a.v - b.v).cwiseAbs().maxCoeff(),
                   (a.z - b.z).cwiseAbs().maxCoeff()});
}

}  // namespace

TEST_CASE("free vibration with friction turns where the energy says, half swing by half swing") {
  // From X with f = +p down to -B: k (X^2 - B^2)/2 = p (X + B - 2 p/k_d). The swing falls to X = p/k_d.
  const double k = 40, kd = 15, p = 0.7, reach = p / kd;
  auto equation = oscillator(1.3, 0, k);
  add_damper(equation, Vector::Ones(1), kd, p);
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(at(0.5, 0, 0.5 - reach), 0, 40);
  const auto ends = times(motion, "stick");
  REQUIRE(ends.size() > 40);
  const auto history = integrator.integrate(at(0.5, 0, 0.5 - reach), 0, 40, ends).history;
  double X = 0.5;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double B = (-p + std::sqrt((k * X - p) * (k * X - p) + 4 * k * p * reach)) / k;
    CHECK(std::abs(history.displacement[i]) == Approx(B).epsilon(1e-12));
    CHECK(std::abs(history.velocity[i]) < 1e-13);
    CHECK(std::abs(history.elements[0].force[i]) == Approx(p).epsilon(1e-13));
    X = B;
  }
  CHECK(X == Approx(reach).epsilon(0.05));
  CHECK(relative_defect(motion.energy) < 1e-12);
}

TEST_CASE("the first slip begins when the closed form of the stuck oscillator says") {
  const double m = 1.3, k = 40, kd = 15, p = 0.7, reach = p / kd, X = 0.5;
  auto equation = oscillator(m, 0, k);
  add_damper(equation, Vector::Ones(1), kd, p);
  const double centre = kd * (X - reach) / (k + kd);
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(at(X, 0, X - reach), 0, 1);
  REQUIRE_FALSE(motion.events.empty());
  CHECK(motion.events[0].from == "stick");
  CHECK(motion.events[0].to == "slip-");
  CHECK(motion.events[0].time ==
        Approx(std::acos((X - 2 * reach - centre) / (X - centre)) / std::sqrt((k + kd) / m)).epsilon(1e-14));
}

TEST_CASE("a nearly rigid slider takes 2 p/k from the amplitude with every half swing") {
  const double k = 40, p = 0.7, kd = 1e8;
  auto equation = oscillator(1, 0, k);
  add_damper(equation, Vector::Ones(1), kd, p);
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(at(0.5, 0, 0.5 - p / kd), 0, 4);
  const auto ends = times(motion, "stick");
  REQUIRE(ends.size() >= 3);
  const auto history = integrator.integrate(at(0.5, 0, 0.5 - p / kd), 0, 4, ends).history;
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(std::abs(history.displacement[i]) ==
          Approx(0.5 - 2 * p / k * static_cast<double>(i + 1)).epsilon(1e-6));  // p/kd = 7e-9
}

TEST_CASE("the energy balance closes to 1e-12 over 40 periods of two masses with two dampers") {
  const auto equation = two_masses();
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(at_rest(equation), 0, 40 * equation.period());
  CHECK(motion.events.size() > 100);
  CHECK(motion.energy.friction > 0.1 * motion.energy.input);
  CHECK(motion.energy.viscous > 0.1 * motion.energy.input);
  CHECK(relative_defect(motion.energy) < 1e-12);
  CHECK(motion.energy.friction ==
        Approx(motion.friction[0].energy + motion.friction[1].energy).epsilon(1e-14));
}

TEST_CASE("small Runge-Kutta steps converge to the motion of two masses with two dampers") {
  const auto equation = two_masses();
  const double end = 6 * equation.period();
  EventDriven integrator(equation);
  const auto exact = integrator.integrate(at_rest(equation), 0, end);
  const double coarse = distance(small_steps(equation, at_rest(equation), end, 6000), exact.end);
  const double fine = distance(small_steps(equation, at_rest(equation), end, 600000), exact.end);
  CAPTURE(coarse, fine);
  CHECK(coarse > 1e3 * fine);  // second order at the events: 1e4, with scatter of where they fall in a step
  CHECK(fine < 1e-9);
}

TEST_CASE("two equal masses with equal dampers slip at the same instants as one does") {
  const auto one = paper(20, 3);
  auto two = masses(Vector{{1.24, 1.24}});
  two.omega = one.omega;
  two.K = 17890 * Matrix::Identity(2, 2);
  two.C = 0.134 * Matrix::Identity(2, 2);
  two.forces.push_back({Vector{{1.0, -1.0}}, 1, 1, 0});  // the second moves opposite to the first
  add_damper(two, Vector{{1.0, 0.0}}, 3500, 1.5);
  add_damper(two, Vector{{0.0, 1.0}}, 3500, 1.5);
  EventDriven integrator(two), single(one);
  const auto pair = integrator.integrate(at_rest(two), 0, 20 * one.period());
  const auto alone = single.integrate(at_rest(one), 0, 20 * one.period());
  REQUIRE(pair.events.size() == 2 * alone.events.size());
  for (std::size_t i = 0; i < pair.events.size(); ++i)
    CHECK(std::abs(pair.events[i].time - alone.events[i / 2].time) < 1e-14);
  CHECK(std::abs(pair.end.x[0] - alone.end.x[0]) < 1e-13 * alone.amplitude);
  CHECK(pair.end.x[1] == -pair.end.x[0]);
}

TEST_CASE("an integration that is cut anywhere goes on as if it had not been") {
  const auto equation = two_masses();
  EventDriven integrator(equation);
  const double end = 3 * equation.period();
  const auto whole = integrator.integrate(at_rest(equation), 0, end);
  std::vector<double> cuts;
  for (const ContactEvent& event : whole.events) cuts.push_back(event.time);
  for (int i = 1; i < 40; ++i) cuts.push_back(end * i / 40);
  for (double cut : cuts) {
    const auto first = integrator.integrate(at_rest(equation), 0, cut);
    const auto second = integrator.integrate(first.end, cut, end);
    CAPTURE(cut);
    CHECK(distance(second.end, whole.end) < 1e-13);
    // An event in the cut itself belongs to either side, or is contact at a start and so to none.
    const bool in_event =
        std::any_of(whole.events.begin(), whole.events.end(),
                    [&](const ContactEvent& event) { return std::abs(event.time - cut) < 1e-12; });
    if (!in_event) CHECK(first.events.size() + second.events.size() == whole.events.size());
  }
}

TEST_CASE(
    "an element without normal load follows without force, and one never reaching its limit never slips") {
  auto equation = paper(20, 0);
  EventDriven integrator(equation), without(oscillator(1.24, 0.134, 17890, 1, equation.omega));
  const auto end = 10 * equation.period();
  const auto motion = integrator.integrate(at_rest(equation), 0, end, std::vector<double>{0.3 * end});
  const auto free = without.integrate({Vector::Zero(1), Vector::Zero(1), Vector()}, 0, end);
  CHECK(std::abs(motion.end.x[0] - free.end.x[0]) < 1e-14 * free.amplitude);
  CHECK(motion.end.z[0] == motion.end.x[0]);
  CHECK(motion.history.elements[0].force[0] == 0);
  CHECK(motion.events.empty());
  CHECK(motion.friction[0].stick_time == 0);
  CHECK(motion.energy.friction == 0);

  EventDriven stuck(paper(20, 1e6));
  const auto rest = stuck.integrate(at_rest(equation), 0, end);
  CHECK(rest.events.empty());
  CHECK(rest.friction[0].stick_time == Approx(end).epsilon(1e-13));
}

TEST_CASE("a slider beyond its limit is drawn after at the start, and that is no event") {
  auto equation = oscillator(1, 0, 40);
  add_damper(equation, Vector::Ones(1), 10, 2);
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(at(0.5, 0.1, -7), 0, 1e-9, std::vector<double>{0.0});
  CHECK(motion.history.elements[0].force[0] == 2);
  CHECK(motion.history.elements[0].slider[0] == Approx(0.3).epsilon(1e-15));
  CHECK(motion.events.empty());
  CHECK(motion.friction[0].stick_time == 0);  // x' > 0: it slips on
}

TEST_CASE("contact at the limit is determined by the motion: outward it slips, inward it sticks") {
  auto equation = oscillator(1, 0, 40);
  add_damper(equation, Vector::Ones(1), 10, 2);
  EventDriven integrator(equation);
  CHECK(integrator.integrate(at(0.5, 0.1, 0.3), 0, 1e-6).friction[0].stick_time == 0);
  CHECK(integrator.integrate(at(0.5, -0.1, 0.3), 0, 1e-6).friction[0].stick_time == 1e-6);
  CHECK(integrator.integrate(at(0.5, 0, 0.3), 0, 1e-6).friction[0].stick_time == 1e-6);  // a turning point
  equation.K(0, 0) = 0;
  equation.forces.push_back({Vector::Ones(1), 0, 2.5, 0});  // at rest, pushed outward over the limit
  EventDriven pushed(equation);
  CHECK(pushed.integrate(at(0.5, 0, 0.3), 0, 1e-3).friction[0].stick_time == 0);
}

TEST_CASE("a mass held at its limit by a force just as strong stays there without an event") {
  auto equation = masses(Vector::Ones(1));
  equation.forces.push_back({Vector::Ones(1), 0, 2, 0});
  add_damper(equation, Vector::Ones(1), 10, 2);
  EventDriven integrator(equation);
  const auto motion = integrator.integrate(at(0.2, 0, 0), 0, 100);
  CHECK(motion.events.empty());
  CHECK(motion.end.x[0] == Approx(0.2).epsilon(1e-15));
}

TEST_CASE("a swing that just touches the limit does not slip, and one beyond it by 1e-9 does") {
  // Free and stuck about z = 0: |f| reaches k_d X.
  for (const double excess : {-1e-9, 1e-9}) {
    auto equation = oscillator(1, 0, 40);
    add_damper(equation, Vector::Ones(1), 10, 1 / (1 + excess));
    EventDriven integrator(equation);
    const auto motion = integrator.integrate(at(0, 0.1 * std::sqrt(50.0), 0), 0, 20);
    CAPTURE(excess);
    if (excess < 0) CHECK(motion.events.empty());
    if (excess > 0) {
      REQUIRE(motion.events.size() > 1);
      // The slip lasts from where x is p/k_d to its turning point, 1e-10 further.
      const double slip = std::acos(1 / (1 + excess)) / std::sqrt(50.0);
      CHECK(motion.events[1].time - motion.events[0].time == Approx(slip).epsilon(1e-6));
    }
  }
}

TEST_CASE("an event-driven integration that is too long ends with the limit that ended it") {
  const auto equation = two_masses();
  EventDriven few_events(equation, {.events = 7}), few_pieces(equation, {.pieces = 50});
  const auto events = few_events.integrate(at_rest(equation), 0, 1e3);
  CHECK(events.reason == EndReason::events);
  CHECK(events.events.size() == 7);
  CHECK(events.time == events.events.back().time);
  CHECK(events.message.find("7 events (the limit)") == 0);
  const auto pieces = few_pieces.integrate(at_rest(equation), 0, 1e3);
  CHECK(pieces.reason == EndReason::pieces);
  CHECK(pieces.message.find("50 pieces (limit 50)") == 0);
  CHECK(relative_defect(pieces.energy) < 1e-12);
  EventDriven stiff(oscillator(1, 0, 1e40));  // a piece is shorter than the rounding of the time
  const auto none = stiff.integrate({Vector::Ones(1), Vector::Zero(1), Vector()}, 1, 2);
  CHECK(none.reason == EndReason::pieces);
  CHECK(none.time == 1);
}

TEST_CASE(
    "an event-driven integration asks whether to go on, and ends with what there is where it is not to") {
  const auto equation = two_masses();
  EventLimits limits;
  int asked = 0;
  limits.control = controls::polled([&] { return ++asked != 3; });
  EventDriven events(equation, limits);
  const auto motion = events.integrate(at_rest(equation), 0, 1e6);
  CHECK(motion.reason == EndReason::stopped);
  CHECK(asked == 3);
  CHECK(motion.time > 0);
  CHECK(motion.message.find("stopped by the caller") == 0);
  CHECK(relative_defect(motion.energy) < 1e-12);
}

TEST_CASE("a map of many degrees of freedom asks whether to go on within a piece") {
  EquationOfMotion equation = masses(Vector::Ones(300));
  equation.K.setIdentity();
  equation.forces.push_back({Vector::Ones(300), 1, 1.0, 0});
  EventLimits limits;
  int asked = 0;
  limits.control = controls::polled([&] { return ++asked != 3; });
  EventDriven events(equation, limits);
  const auto map = events.map(at_rest(equation), 1);
  CHECK_FALSE(map.done);
  CHECK(asked == 3);
  CHECK(map.message.find("stopped by the caller at 0 s") == 0);
}

TEST_CASE("an orbit that is stopped before its first piece has no derivatives") {
  EquationOfMotion equation = masses(Vector::Ones(300));
  equation.K.setIdentity();
  EventLimits limits;
  limits.control = controls::stopped();
  EventDriven events(equation, limits);
  const EquationRates rates;
  const Orbit orbit = events.orbit(at_rest(equation), &rates);
  CHECK_FALSE(orbit.map.done);
  CHECK(orbit.by_parameter.size() == 0);
}

TEST_CASE("before each decomposition of many degrees of freedom it is asked whether to go on") {
  constexpr int n = 400;
  EquationOfMotion equation = masses(Vector::LinSpaced(n, 1, 2));
  equation.K.setIdentity();
  equation.forces.push_back({Vector::Ones(n), 1, 1.0, 0});
  int asked = 0, last = 1;
  EventLimits limits;
  for (; last <= 4; ++last) {  // of M, of two stiffnesses and of C
    asked = 0;
    limits.control = controls::polled([&] { return ++asked != last; });
    EventDriven events(equation, limits);
    const auto motion = events.integrate(at_rest(equation), 0, 1);
    CAPTURE(last);
    CHECK(motion.reason == EndReason::stopped);
    CHECK(motion.time == 0);
    CHECK(asked == last);
    // So has an orbit, without the derivatives of a motion that was not begun.
    const EquationRates rates;
    const Orbit orbit = events.orbit(at_rest(equation), &rates);
    CHECK_FALSE(orbit.map.done);
    CHECK(orbit.map.message.find("stopped by the caller at 0 s") == 0);
    CHECK(orbit.by_parameter.size() == 0);
    CHECK(asked == last);
  }
  asked = 0;
  limits.control = controls::polled([&] { return ++asked > 0; });
  EventDriven events(equation, limits);
  CHECK(asked == 4);
  CHECK(events.integrate(at_rest(equation), 0, 1).reason == EndReason::reached);
}

TEST_CASE("a motion that grows beyond all numbers ends as not finite") {
  EventDriven integrator(oscillator(1, 0, -100));  // a negative spring
  const auto motion = integrator.integrate({Vector::Ones(1), Vector::Zero(1), Vector()}, 0, 1000);
  CHECK(motion.reason == EndReason::not_finite);
  CHECK(motion.time < 1000);
}

TEST_CASE("a degree of freedom without mass is named, and a cubic spring refused") {
  auto equation = two_masses();
  equation.dof_names = {"hub", "tip"};
  equation.M(1, 1) = 0;
  CHECK_THROWS_WITH(EventDriven(equation),
                    "degree of freedom \"tip\" has no mass of its own (M is singular)");
  equation.M << 1, 1, 1, 1;  // one mass on x_hub + x_tip
  CHECK_THROWS_AS(EventDriven(equation), SingularMass);
  equation = two_masses();
  equation.add("s", elements::cubic_spring().law({}), {2}, Vector{{1.0, 0.0}});
  CHECK_THROWS_AS(EventDriven(equation), NotPiecewiseLinear);
  equation.elements.back().fields[0] = 0;
  EventDriven integrator(equation);
  CHECK(
      integrator.integrate(at_rest(equation), 0, 1, std::vector<double>{0.5}).history.elements[2].force[0] ==
      0);
}
