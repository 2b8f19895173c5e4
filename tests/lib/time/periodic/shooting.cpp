// Periodic motions and Floquet multipliers, against tests/reference/exact_1dof.json, closed forms and
// differences.
#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/time/equation/systems.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <numbers>

using namespace arcslip::time;
using namespace systems;
using reference::error;

namespace {

using Complex = std::complex<double>;

PeriodicMotion shot(const EquationOfMotion& equation, const ShootingOptions& options = {}) {
  EventDriven integrator(equation);
  return periodic_motion(integrator, at_rest(equation), options);
}

double stick_percent(const PeriodicMotion& motion) {
  return 100 * motion.period.friction.at(0).stick_time / motion.period.time;
}

// d end/d start of integrate() by central differences of fourth order, from a state within the limits.
Matrix differences(const EquationOfMotion& equation, const MotionState& start, double end,
                   double relative_step) {
  EventDriven integrator(equation);
  const auto n = equation.dofs(), size = 2 * n + equation.memory;
  const auto flow = [&](const Vector& y) -> Vector {
    const auto state =
        integrator.integrate({y.head(n), y.segment(n, n), y.tail(equation.memory)}, 0, end).end;
    Vector out(size);
    out << state.x, state.v, state.z;
    return out;
  };
  Vector y(size);
  y << start.x, start.v, start.z;
  const double h = relative_step;
  Matrix D(size, size);
  for (int j = 0; j < size; ++j) {
    const double step = h * (j >= n && j < 2 * n ? equation.omega : 1.0);
    const Vector e = Vector::Unit(size, j) * step;
    D.col(j) = (8 * (flow(y + e) - flow(y - e)) - (flow(y + 2 * e) - flow(y - 2 * e))) / (12 * step);
  }
  return D;
}

// d end/d start with velocities over omega, so that all entries are of one kind.
Matrix scaled(const EquationOfMotion& equation, Matrix D) {
  const auto n = equation.dofs();
  D.middleRows(n, n) /= equation.omega;
  D.middleCols(n, n) *= equation.omega;
  return D;
}

}  // namespace

TEST_CASE("amplitude, stick share and friction energy are the exact ones at every fixed frequency") {
  for (const auto& row : reference::exact("fixed_frequency")) {
    const double hertz = row["frequency_hz"], load = row["normal_load"], energy = row["energy_friction"];
    CAPTURE(hertz, load);
    const auto motion = shot(paper(hertz, load));
    REQUIRE(motion.converged());
    CHECK(motion.shooting.stable);
    CHECK(error(motion.period.amplitude, row["amplitude"]) < 1e-11);
    CHECK(std::abs(stick_percent(motion) - row["stick_percent"].get<double>()) < 1e-7);
    CHECK(std::abs(motion.period.friction[0].energy - energy) < 1e-9 * energy + 1e-13);
    const EnergyBalance& balance = motion.period.energy;
    CHECK(std::abs(balance.defect()) < 1e-12 * balance.input);
    CHECK(std::abs(balance.stored) < 1e-10 * balance.input);  // nothing is left in the springs after a period
  }
}

TEST_CASE("amplitude, stick share and friction energy are the exact ones at every resonance peak") {
  for (const auto& row : reference::exact("resonance_peaks")) {
    const double hertz = row["frequency_hz"], load = row["normal_load"], energy = row["energy_friction"];
    CAPTURE(hertz, load);
    const auto motion = shot(paper(hertz, load));
    REQUIRE(motion.converged());
    CHECK(error(motion.period.amplitude, row["amplitude"]) < 1e-11);
    CHECK(std::abs(stick_percent(motion) - row["stick_percent"].get<double>()) < 1e-9);
    CHECK(std::abs(motion.period.friction[0].energy - energy) <= 1e-9 * energy);
    CHECK(std::abs(motion.period.energy.defect()) < 1e-12 * motion.period.energy.input);
  }
}

TEST_CASE("the response at the optimal loads is exact with, without and with much viscous damping") {
  for (const auto& row : reference::exact("optima")) {
    const double c = row["c"];
    CAPTURE(c);
    const auto motion = shot(paper(row["frequency_hz"], row["normal_load"], c));
    REQUIRE(motion.converged());
    CHECK(error(motion.period.amplitude, row["amplitude"]) < 1e-11);
    CHECK(std::abs(stick_percent(motion) - row["stick_percent"].get<double>()) < 1e-6);
  }
}

TEST_CASE("the multipliers of the paper's system at 20 Hz and 3 N are 0.84767, 0.81154 and 0") {
  const auto motion = shot(paper(20, 3));
  REQUIRE(motion.shooting.multipliers.size() == 3);
  CHECK(std::abs(motion.shooting.multipliers[0] - 0.84767) < 5e-6);
  CHECK(std::abs(motion.shooting.multipliers[1] - 0.81154) < 5e-6);
  CHECK(std::abs(motion.shooting.multipliers[2]) < 1e-14);
  CHECK(motion.shooting.stable);
}

TEST_CASE("the monodromy matrix is that of differences through slip and its ends") {
  // From rest, where all sliders are stuck: every column is a derivative on both sides.
  auto one = paper(20, 0.3);
  EventDriven first(one);
  const MotionState rest = at_rest(one);
  REQUIRE(first.integrate(rest, 0, one.period()).events.size() >= 3);
  const Matrix M = first.map(rest, one.period()).monodromy;
  CHECK((scaled(one, M) - scaled(one, differences(one, rest, one.period(), 1e-7))).cwiseAbs().maxCoeff() <
        1e-7);

  const auto two = two_masses();
  EventDriven second(two);
  const MotionState start{Vector{{0.05, -0.1}}, Vector{{0.02, 0.01}}, Vector{{0.0, 0.05}}};
  REQUIRE(second.integrate(start, 0, two.period()).events.size() >= 6);
  const Matrix M2 = second.map(start, two.period()).monodromy;
  CHECK((scaled(two, M2) - scaled(two, differences(two, start, two.period(), 1e-4))).cwiseAbs().maxCoeff() <
        1e-9);
}

TEST_CASE("the monodromy matrix is that of differences where a sliding contact lifts off and closes") {
  EquationOfMotion equation = masses(Vector{{1.0, 0.7}});
  equation.K << 1.2, -0.2, -0.2, 0.9;
  equation.C << 0.04, -0.01, -0.01, 0.03;
  equation.omega = 0.8;
  equation.forces.push_back({Vector{{0.6, 0.0}}, 1, 1.0, 0.2});
  equation.forces.push_back({Vector{{0.0, 1.0}}, 1, 0.3, 0.9});
  equation.add("contact", elements::contact_2d().law({}), {1.1, 1.7, 0.3, 0.4}, Matrix::Identity(2, 2));
  EventDriven integrator(equation);
  MotionState start = at_rest(equation);
  start = integrator.integrate(start, 0, 3.3 * equation.period()).end;
  const double end = 1.1 * equation.period();
  const auto events = integrator.integrate(start, 0, end).events;
  const auto closes = [](const ContactEvent& event) { return event.from == "open"; };
  REQUIRE(std::any_of(events.begin(), events.end(), closes));
  const Matrix exact = integrator.map(start, end).monodromy;
  CHECK((scaled(equation, exact - differences(equation, start, end, 1e-4))).norm() < 1e-8 * exact.norm());
}

TEST_CASE("the multipliers are those of differences, and the same from any instant of the period") {
  const auto whole = shot(paper(20, 3));
  auto equation = paper(20, 3);
  const double angle = equation.omega * 0.018;  // within a stick phase, which lasts from 0.0126 s to 0.0248 s
  equation.forces[0].cosine = std::cos(angle);
  equation.forces[0].sine = -std::sin(angle);
  const auto motion = shot(equation);
  REQUIRE(motion.converged());
  const Matrix D = differences(equation, motion.shooting.start, equation.period(), 1e-7);
  CHECK((scaled(equation, D) - scaled(equation, motion.shooting.map.monodromy)).cwiseAbs().maxCoeff() < 1e-8);
  Eigen::VectorXcd values = continuation::eigenvalues(D);
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) > std::abs(b); });
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(values[static_cast<Eigen::Index>(i)] - whole.shooting.multipliers[i]) < 1e-8);
    CHECK(std::abs(motion.shooting.multipliers[i] - whole.shooting.multipliers[i]) < 1e-11);
  }
}

TEST_CASE(
    "a slider that slips at the start has no influence: its column is zero, its row that of the element") {
  const auto equation = two_masses();
  EventDriven integrator(equation);
  const MotionState start{Vector{{0.5, 0.1}}, Vector{{0.3, 0.1}},
                          Vector{{0.5 - 0.3 / 0.7, 0.4 - 0.15 / 0.4}}};
  const double end = 0.05;  // both slip throughout
  const Matrix M = integrator.map(start, end).monodromy;
  CHECK(integrator.integrate(start, 0, end).events.empty());
  CHECK(M.rightCols(2).isZero());
  CHECK(M.row(4) == M.row(0));
  CHECK((M.row(5) - M.row(0) + M.row(1)).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("without slip the multipliers are exp(-c T/2m) exp(+-i w_d T), and the resting slider has none") {
  const double m = 1.24, c = 0.134;
  const auto equation = paper(20, 4);
  const auto motion = shot(equation);
  REQUIRE(motion.shooting.multipliers.size() == 2);
  const double decay = c / (2 * m), w = std::sqrt(21390 / m - decay * decay), T = equation.period();
  const Complex exact = std::exp(Complex(-decay * T, w * T));
  for (const Complex& multiplier : motion.shooting.multipliers) {
    CHECK(std::abs(multiplier.real() - exact.real()) < 1e-13);
    CHECK(std::abs(std::abs(multiplier.imag()) - std::abs(exact.imag())) < 1e-13);
  }
  const auto undamped = shot(paper(20, 4, 0));
  REQUIRE(undamped.converged());
  CHECK(std::abs(undamped.shooting.multipliers[0]) == Approx(1).epsilon(1e-13));
  CHECK_FALSE(undamped.shooting.stable);  // neutral
}

TEST_CASE("two sliders that slip at once leave two zero multipliers, and two that take turns leave one") {
  auto equation = masses(Vector{{1.0, 1.0}});
  equation.K << 2.5, -0.6, -0.6, 2.5;
  equation.C = 0.1 * Matrix::Identity(2, 2);
  equation.forces.push_back({Vector{{1.0, 0.0}}, 1, 2, 0});
  equation.forces.push_back({Vector{{0.0, 1.0}}, 1, 0, 2});
  add_damper(equation, Vector{{1.0, 0.0}}, 1, 0);
  add_damper(equation, Vector{{0.0, 1.0}}, 1, 0);
  for (const double limit : {0.56, 0.84}) {
    equation.elements[0].fields[2] = equation.elements[1].fields[2] = limit;
    const auto motion = shot(equation);
    REQUIRE(motion.converged());
    REQUIRE(motion.period.events.size() == 8);
    bool at_once = false;
    for (std::size_t i = 0; i < 8; ++i)
      at_once = at_once || (motion.period.events[i].from == "stick" &&
                            motion.period.events[(i + 1) % 8].from == "stick");
    CHECK(at_once == (limit == 0.56));
    REQUIRE(motion.shooting.multipliers.size() == 6);
    CHECK(std::abs(motion.shooting.multipliers[5]) < 1e-14);
    if (at_once) CHECK(std::abs(motion.shooting.multipliers[4]) < 1e-14);
    if (!at_once) CHECK(std::abs(motion.shooting.multipliers[4]) > 1e-8);
    CHECK(std::abs(motion.shooting.multipliers[3]) > 0.1);
  }
}

TEST_CASE("shooting finds an unstable motion too, and says so") {
  const auto equation = oscillator(1, -0.3, 4, 1, 1.3);
  const auto motion = shot(equation);
  REQUIRE(motion.converged());
  CHECK_FALSE(motion.shooting.stable);
  CHECK(motion.period.amplitude == Approx(1 / std::abs(Complex(4 - 1.69, -0.39))).epsilon(1e-13));
  CHECK(std::abs(motion.shooting.multipliers[0]) ==
        Approx(std::exp(0.15 * equation.period())).epsilon(1e-12));
}

TEST_CASE("over three periods the motion is the same, and the multipliers are cubed") {
  const auto equation = two_masses();
  const auto one = shot(equation), three = shot(equation, {.periods = 3});
  REQUIRE(one.converged());
  REQUIRE(three.converged());
  CHECK((one.shooting.start.x - three.shooting.start.x).norm() < 1e-12);
  CHECK((one.shooting.start.z - three.shooting.start.z).norm() < 1e-12);
  CHECK(three.period.events.size() == 3 * one.period.events.size());
  REQUIRE(one.shooting.multipliers.size() == three.shooting.multipliers.size());
  for (std::size_t i = 0; i < one.shooting.multipliers.size(); ++i)
    CHECK(std::abs(std::abs(three.shooting.multipliers[i]) -
                   std::pow(std::abs(one.shooting.multipliers[i]), 3)) < 1e-11);
}

TEST_CASE("a long transient ends on the motion that shooting finds") {
  const auto equation = two_masses();
  EventDriven integrator(equation);
  const auto motion = shot(equation);
  const auto transient = integrator.integrate(at_rest(equation), 0, 400 * equation.period());
  CHECK((transient.end.x - motion.shooting.start.x).norm() < 1e-11);
  CHECK((transient.end.v - motion.shooting.start.v).norm() < 1e-11);
  CHECK((transient.end.z - motion.shooting.start.z).norm() < 1e-11);
}

TEST_CASE("next to full stick the motion passes into the stuck one") {
  // k_d A_stuck = mu Fn; above, A is that of the stuck structure, below, the slider takes 4 p (A - p/k_d) in
  // a period.
  const double w = 40 * std::numbers::pi, stuck = 1 / std::abs(Complex(21390 - 1.24 * w * w, 0.134 * w));
  const double limit = 3500 * stuck / 0.5;
  for (const double part : {1e-3, 1e-6, 1e-9})
    for (const double c : {0.0, 0.134}) {
      CAPTURE(part, c);
      const double A = c == 0 ? 1 / std::abs(21390 - 1.24 * w * w) : stuck;
      const double load = c == 0 ? 3500 * A / 0.5 : limit;
      const auto above = shot(paper(20, load * (1 + part), c)), below = shot(paper(20, load * (1 - part), c));
      REQUIRE(above.converged());
      CHECK(error(above.period.amplitude, A) < 1e-12);
      CHECK(stick_percent(above) == Approx(100).epsilon(1e-14));
      CHECK(above.shooting.multipliers.size() == 2);
      REQUIRE(below.converged());
      CHECK(below.shooting.multipliers.size() == 3);
      CHECK(below.period.events.size() == 4);
      CHECK(stick_percent(below) < 100);
      const double p = 0.5 * load * (1 - part), slip = below.period.amplitude - p / 3500;
      CHECK(std::abs(below.period.energy.friction - 4 * p * slip) < 1e-10 * 4 * p * slip + 1e-17 * p);
    }
}

TEST_CASE("next to full slip the motion passes into the free one") {
  // The force of the slider, at most p, changes the response by at most that of a square wave of p.
  const double w = 40 * std::numbers::pi, free = 1 / std::abs(Complex(17890 - 1.24 * w * w, 0.134 * w));
  for (const double load : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(load);
    const auto motion = shot(paper(20, load));
    REQUIRE(motion.converged());
    CHECK(motion.period.events.size() == 4);
    CHECK(std::abs(motion.period.amplitude / free - 1) < 1.5 * 0.5 * load);
    CHECK(motion.shooting.multipliers.size() == 3);
    const double p = 0.5 * load;
    CHECK(error(motion.period.energy.friction, 4 * p * (motion.period.amplitude - p / 3500)) < 1e-10);
  }
  CHECK(error(shot(paper(20, 0)).period.amplitude, free) < 1e-12);
}

TEST_CASE("without viscous damping slip alone makes a periodic motion") {
  for (const double load : {1.7, 3.0, 10.0, 500.0}) {
    CAPTURE(load);
    const auto motion = shot(paper(20.4, load, 0));
    REQUIRE(motion.converged());
    CHECK(motion.period.energy.viscous == 0);
    CHECK(std::abs(motion.period.energy.input - motion.period.energy.friction) <
          1e-12 * motion.period.energy.input + 1e-16);
  }
}

TEST_CASE("a mean force moves the centre of a resting slider, which then bears none of it") {
  auto equation = paper(20, 50);
  equation.forces.push_back({Vector::Ones(1), 0, 7, 0});
  const auto motion = shot(equation);
  REQUIRE(motion.converged());
  const double w = equation.omega;
  CHECK(error(motion.shooting.start.z[0], 7 / 17890.0) < 1e-12);
  CHECK(error(motion.period.amplitude, 7 / 17890.0 + 1 / std::abs(Complex(21390 - 1.24 * w * w, 0.134 * w))) <
        1e-12);
  CHECK(motion.shooting.multipliers.size() == 2);
}

TEST_CASE("a flow of one's own is shot at as well") {
  // x' = -x + 1/2 over 2 pi, and next to it v := v + (2 - v^2)/4, whose fixed point sqrt 2 has 1 - sqrt(2)/2.
  const Flow flow = [](const MotionState& start) {
    const double e = std::exp(-2 * std::numbers::pi), x = start.x[0], v = start.v[0];
    PeriodMap map;
    map.done = true;
    map.end = {Vector::Constant(1, 0.5 + (x - 0.5) * e), Vector::Constant(1, v + 0.25 * (2 - v * v)),
               Vector()};
    map.monodromy = Vector{{e, 1 - 0.5 * v}}.asDiagonal();
    return map;
  };
  const auto result =
      shoot(flow, {Vector::Constant(1, 5), Vector::Constant(1, 1), Vector()}, 1, {.transients = 0});
  REQUIRE(result.converged());
  CHECK(result.start.x[0] == Approx(0.5).epsilon(1e-14));
  CHECK(result.start.v[0] == Approx(std::numbers::sqrt2).epsilon(1e-14));
  CHECK(result.multipliers[0].real() == Approx(1 - 0.5 * std::numbers::sqrt2).epsilon(1e-9));
}

TEST_CASE("shooting fails with its reason: no periodic motion, a flow that fails, numbers that are none") {
  const auto resonance = oscillator(1, 0, 4, 1, 2);
  const auto none = shot(resonance);
  CHECK(none.shooting.reason == ShootingEnd::iterations);
  CHECK(none.shooting.message.find("no periodic motion after 50 Newton steps") == 0);

  const auto equation = two_masses();
  EventDriven limited(equation, {.events = 3});
  const auto failed = periodic_motion(limited, at_rest(equation));
  CHECK(failed.shooting.reason == ShootingEnd::flow_failed);
  CHECK(failed.shooting.message.find("3 events (the limit)") != std::string::npos);

  const Flow nothing = [](const MotionState& start) {
    PeriodMap map;
    map.done = true;
    map.end = start;
    map.monodromy.setConstant(2, 2, NAN);
    return map;
  };
  CHECK(shoot(nothing, {Vector::Ones(1), Vector::Ones(1), Vector()}, 1).reason == ShootingEnd::not_finite);
}

TEST_CASE("a free structure comes back where nothing pushes it on: one of its motions is found") {
  const auto equation = oscillator(2, 0, 0, 3, 1.7);
  const auto motion = shot(equation);
  REQUIRE(motion.converged());
  CHECK(std::abs(motion.shooting.start.v[0]) < 1e-13);
  CHECK_FALSE(motion.shooting.stable);
}
