#include "catch.hpp"
#include "lib/analyses/responses/reference.hpp"
#include "lib/time/newmark/newmark_systems.hpp"

#include <algorithm>
#include <complex>
#include <numbers>
#include <random>

using namespace time_test;

namespace {

using std::numbers::pi;

double relative(double value, double exact) {
  return std::abs(value / exact - 1);
}

/// The step of one degree of freedom, m x'' + c x' + k x + clamp(f + kd y) = F, by bisection.
double increment_by_bisection(double A, double b, double f, double kd, double limit) {
  double low = -1e6, high = 1e6;
  for (int i = 0; i < 200; ++i) {
    const double y = 0.5 * (low + high);
    (A * y + std::clamp(f + kd * y, -limit, limit) < b ? low : high) = y;
  }
  return 0.5 * (low + high);
}

}  // namespace

TEST_CASE("a free linear oscillator keeps its energy, and its period is too long by (w h)^2/12") {
  const double w = 3.7;
  for (long steps : {20L, 100L, 1000L}) {
    CAPTURE(steps);
    const auto equation = oscillator(2.5, 0, 2.5 * w * w, 0, w);
    Newmark newmark(equation, steps);
    newmark.begin({vector({0.3}), vector({0}), Vector()});
    const double energy = 0.5 * 2.5 * w * w * 0.3 * 0.3;
    double angle = 0, last = 0;  // of the motion
    const long count = 50 * steps;
    for (long k = 0; k < count; ++k) {
      REQUIRE(newmark.step() == Solved::yes);
      const double now = std::atan2(-newmark.state().v[0] / w, newmark.state().x[0]);
      angle += std::remainder(now - last, 2 * pi);
      last = now;
    }
    CHECK(std::abs(newmark.energy().stored) < 1e-15 * static_cast<double>(count) * energy);
    const double u = 2 * pi / static_cast<double>(steps);
    const double lengthening = u * static_cast<double>(count) / angle - 1;
    CHECK(relative(lengthening, u * u / 12) < 0.1 * u * u + 1e-9);  // the next term is (w h)^4 by 1/240
    CHECK(relative(angle / static_cast<double>(count), 2 * std::atan(u / 2)) < 1e-12);
  }
}

TEST_CASE("a forced linear oscillator comes to its closed form at second order") {
  const double m = 1.5, c = 0.8, k = 40, f = 2, w = 4.1;
  const std::complex<double> response = f / std::complex<double>(k - m * w * w, w * c);
  const auto error = [&](long steps) {
    const auto motion = settled(oscillator(m, c, k, f, w), steps, 60, true);
    double largest = 0;
    for (std::size_t i = 0; i < motion.history.time.size(); ++i) {
      const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(steps);
      const auto turned = response * std::polar(1.0, angle);
      largest = std::max(largest, std::abs(motion.history.displacement[i] - turned.real()));
      largest = std::max(largest, std::abs(motion.history.velocity[i] / w + turned.imag()));
    }
    CHECK(relative(motion.amplitude, std::abs(response)) < 100.0 / static_cast<double>(steps * steps));
    return largest / std::abs(response);
  };
  double last = error(100);
  CHECK(last < 0.01);
  for (long steps : {200L, 400L, 800L, 1600L}) {
    const double now = error(steps);
    CHECK(last / now == Approx(4).epsilon(0.01));
    last = now;
  }
}

TEST_CASE("the paper's oscillator comes to its exact amplitudes at second order", "[numbers]") {
  for (const auto& entry : reference::exact("fixed_frequency")) {
    const double exact = entry["amplitude"], hertz = entry["frequency_hz"], load = entry["normal_load"];
    CAPTURE(hertz, load);
    const bool sticks = entry["state"] == "stick";  // then only c damps what begins
    const auto error = [&](double steps) {
      const auto motion = settled(paper(hertz, load), static_cast<long>(steps), sticks ? 7000 : 600);
      REQUIRE(motion.done());
      // The oscillator's frequencies fall by the share (w h)^2/12 = 3.3/steps^2, and near the resonance of
      // the slipping or stuck structure the amplitude changes by up to 36 times that.
      CHECK(relative(motion.amplitude, exact) < 120 / (steps * steps));
      CHECK(motion.friction.at(0).stick_share * 100 ==
            Approx(entry["stick_percent"].get<double>()).margin(200 / steps));
      CHECK(motion.energy.friction ==
            Approx(entry["energy_friction"].get<double>()).margin(0.004 * 250 / (steps * steps)));
      CHECK(std::abs(motion.energy.defect()) < 1e-15);
      return relative(motion.amplitude, exact);
    };
    const double coarse = error(100);
    if (sticks) continue;
    const double fine = error(400);
    if (coarse > 20.0 / (100 * 100)) CHECK(coarse / fine == Approx(16).epsilon(0.25));
  }
}

TEST_CASE("energy balances to rounding with friction, and at second order with a cubic spring") {
  auto equation = paper(19.6, 2);
  Newmark newmark(equation, 50);
  newmark.begin(at_rest(equation));
  REQUIRE(run(newmark, 5000) == Solved::yes);
  CHECK(newmark.energy().friction > 0.1);
  CHECK(newmark.energy().input > newmark.energy().friction);
  CHECK(std::abs(newmark.energy().defect()) < 1e-13 * newmark.energy().input);

  const auto defect = [](long steps) {
    auto duffing = oscillator(1, 0.1, 1, 0.5, 1.2);
    add_cubic(duffing, vector({1}), 0.5);
    Newmark with_spring(duffing, steps);
    with_spring.begin(at_rest(duffing));
    REQUIRE(run(with_spring, 3 * steps) == Solved::yes);
    return with_spring.energy().defect();
  };
  CHECK(defect(400) / defect(800) == Approx(4).epsilon(0.02));
}

TEST_CASE("without slip limit the damper is not there, and with an infinite one it is a spring") {
  const auto amplitude = [](const EquationOfMotion& equation) { return settled(equation, 64, 40).amplitude; };
  auto none = oscillator(1.24, 2, 17890, 1, 120);
  auto spring = oscillator(1.24, 2, 17890 + 3500, 1, 120);
  auto free = none, stuck = none, beyond = none;
  add_damper(free, vector({1}), 3500, 0);
  add_damper(stuck, vector({1}), 3500, 1e300);
  add_damper(beyond, vector({1}), 3500, std::numeric_limits<double>::infinity());
  CHECK(relative(amplitude(free), amplitude(none)) < 1e-12);
  CHECK(relative(amplitude(stuck), amplitude(spring)) < 1e-12);
  CHECK(relative(amplitude(beyond), amplitude(spring)) < 1e-12);
  CHECK(settled(free, 64, 40).friction.at(0).stick_share == 0);
  CHECK(settled(stuck, 64, 40).friction.at(0).stick_share == 1);
}

TEST_CASE("each step with friction is the one solution of its balance of forces, however large the step") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> decade(-4, 4), sign(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double A = std::pow(10, decade(random)), kd = std::pow(10, decade(random) + 2);
    const double limit = std::pow(10, decade(random)), b = sign(random) * 100;
    auto equation = oscillator(1, 0, 1, 0, 1);
    add_damper(equation, vector({1}), kd, limit);
    ImplicitElements element(equation.elements, 1);
    element.set_matrix(Matrix::Constant(1, 1, A));
    element.begin(vector({0}), vector({0}), vector({sign(random) * limit / kd}));
    const double f = element.force()[0];
    Vector y = vector({sign(random) * 1e3});
    CAPTURE(A, kd, limit, b, f, y[0]);
    REQUIRE(element.solve(vector({b}), y) == Solved::yes);
    CHECK(y[0] == Approx(increment_by_bisection(A, b, f, kd, limit)).epsilon(1e-10));
  }
}

TEST_CASE("many coupled dampers in one huge step are solved whatever the guess") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto matrix = [&](Eigen::Index rows, Eigen::Index columns) {
    return Matrix(Matrix::NullaryExpr(rows, columns, [&] { return normal(random); }));
  };
  for (int i = 0; i < 300; ++i) {
    const int n = 1 + i % 6, count = 1 + i % 11;
    const Matrix R = matrix(n, n), D = matrix(n, count);
    EquationOfMotion dampers;
    for (int e = 0; e < count; ++e) {
      const double stiffness = std::exp(6 * normal(random)), limit = std::exp(2 * normal(random));
      add_damper(dampers, D.col(e), stiffness, limit);
    }
    const std::vector<TimeElement>& elements = dampers.elements;
    ImplicitElements all(elements, n);
    const Matrix A = R * R.transpose() + 1e-3 * Matrix::Identity(n, n);
    all.set_matrix(A);
    all.begin(Vector::Zero(n), Vector::Zero(n), Vector::Zero(count));
    Vector y = 100 * matrix(n, 1);
    const Vector b = 10 * matrix(n, 1);
    CAPTURE(i);
    REQUIRE(all.solve(b, y) == Solved::yes);
    Vector balance = b - A * y;
    for (int e = 0; e < count; ++e) {
      const TimeElement& element = elements[static_cast<std::size_t>(e)];
      const double limit = systems::limit_of(element);
      balance -= D.col(e) * std::clamp(element.fields[0] * D.col(e).dot(y), -limit, limit);
    }
    const double size = (A.cwiseAbs() * y.cwiseAbs()).maxCoeff() + b.cwiseAbs().maxCoeff() + 1;
    const double stiffest = 1 + D.cwiseAbs().maxCoeff() * D.cwiseAbs().maxCoeff() * y.cwiseAbs().maxCoeff();
    double stiffness = 0;
    for (const TimeElement& element : elements) stiffness = std::max(stiffness, element.fields[0]);
    CHECK(balance.cwiseAbs().maxCoeff() < 1e-11 * (size + stiffest * stiffness));
  }
}

TEST_CASE("a damper behind a massless degree of freedom and a spring acts as one damper of both in series") {
  const double ks = 5000, kd = 3500, limit = 1.5;
  auto direct = oscillator(1.24, 0.134, 17890, 1, 2 * pi * 19.7);
  add_damper(direct, vector({1}), ks * kd / (ks + kd), limit);
  EquationOfMotion behind = direct;
  behind.M = Matrix{{1.24, 0}, {0, 0}};
  behind.C = Matrix{{0.134, 0}, {0, 0}};
  behind.K = Matrix{{17890 + ks, -ks}, {-ks, ks}};
  behind.elements.clear();
  behind.memory = 0;
  add_damper(behind, vector({0, 1}), kd, limit);
  behind.forces = {{vector({1, 0}), 1, 1, 0}};
  behind.response = vector({1, 0});
  Newmark one(direct, 40), two(behind, 40);
  REQUIRE(one.begin(at_rest(direct)) == Solved::yes);
  REQUIRE(two.begin(at_rest(behind)) == Solved::yes);
  for (int k = 0; k < 4000; ++k) {
    REQUIRE(one.step() == Solved::yes);
    REQUIRE(two.step() == Solved::yes);
    CHECK(std::abs(one.state().x[0] - two.state().x[0]) < 1e-15);
    CHECK(std::abs(one.elements().force()[0] - two.elements().force()[0]) < 1e-11);
  }
  CHECK(two.energy().friction == Approx(one.energy().friction).epsilon(1e-11));
  CHECK(std::abs(two.energy().defect()) < 1e-13 * two.energy().input);
}

TEST_CASE("a massless degree of freedom takes its place at the beginning, with the sliders it draws") {
  // 100 x + clamp(400 x) = 3 + force of a spring of 50 to a mass at 0: beyond the limit of 1, x = 2/150
  EquationOfMotion equation = oscillator(1, 0, 1, 0, 1);
  equation.M = Matrix{{1, 0}, {0, 0}};
  equation.C = Matrix::Zero(2, 2);
  equation.K = Matrix{{51, -50}, {-50, 150}};
  equation.forces = {{vector({0, 1}), 1, 3, 0}};
  equation.response = vector({1, 0});
  add_damper(equation, vector({0, 1}), 400, 1);
  Newmark newmark(equation, 100);
  REQUIRE(newmark.begin({vector({0, 0.7}), vector({0, 0.3}), vector({0})}) == Solved::yes);
  // its own place, 0.7, holds nothing: the slider was drawn to 0.7 - 1/400 with it
  const double force = newmark.elements().force()[0];
  CHECK(150 * newmark.state().x[1] + force == Approx(3).epsilon(1e-14));
  CHECK(force == Approx(-1).epsilon(1e-12));
  CHECK(newmark.state().z[0] == Approx(newmark.state().x[1] + 1.0 / 400).epsilon(1e-14));
  REQUIRE(newmark.begin(at_rest(equation)) == Solved::yes);
  CHECK(newmark.state().x[1] == Approx(2.0 / 150).epsilon(1e-14));
  CHECK(newmark.state().v[1] == 0);
}

TEST_CASE("a massless degree of freedom with a damper follows its equation of first order") {
  const double c = 2, k = 5, f = 3, w = 1.7;
  const std::complex<double> response = f / std::complex<double>(k, w * c);
  const auto error = [&](long steps) {
    auto equation = oscillator(0, c, k, f, w);
    Newmark newmark(equation, steps);
    REQUIRE(newmark.begin(at_rest(equation)) == Solved::yes);
    CHECK(newmark.state().v[0] == Approx(f / c).epsilon(1e-14));  // x = 0 at the beginning
    const auto motion = newmark_periods(
        newmark, newmark_periods(newmark, at_rest(equation), 20, false, true).end, 1, true, false);
    double largest = 0;
    for (std::size_t i = 0; i < motion.history.time.size(); ++i) {
      const auto turned =
          response * std::polar(1.0, 2 * pi * static_cast<double>(i) / static_cast<double>(steps));
      largest = std::max(largest, std::abs(motion.history.displacement[i] - turned.real()));
      largest = std::max(largest, std::abs(motion.history.velocity[i] / w + turned.imag()));
    }
    return largest / std::abs(response);
  };
  CHECK(error(100) < 1e-3);
  CHECK(error(100) / error(200) == Approx(4).epsilon(0.01));
}

TEST_CASE("a slider that slips for half of the way in a step sticks for half of it") {
  // Without mass: x + clamp(...) = cos, in four steps from 1 over 0 to -1 and back. From x = 3/4 to 1/4 the
  // damper turns from 1/4 to -1/4 N over 1/4 m, half of the way; then it slips.
  auto equation = oscillator(0, 0, 1, 1, 1);
  add_damper(equation, vector({1}), 2, 0.25);
  Newmark newmark(equation, 4);
  const auto motion = newmark_periods(newmark, at_rest(equation), 1, true, true);
  REQUIRE(motion.done());
  CHECK(motion.history.displacement[0] == Approx(0.75).epsilon(1e-14));
  CHECK(motion.history.displacement[1] == Approx(0.25).epsilon(1e-14));
  CHECK(motion.friction.at(0).stick_share == Approx(0.25).epsilon(1e-14));
}

TEST_CASE(
    "what nothing holds, and what grows beyond all numbers, ends with its reason and the motion so far") {
  EquationOfMotion loose = paper(20, 3);
  loose.M = Matrix{{1.24, 0}, {0, 0}};
  loose.C = Matrix::Zero(2, 2);
  loose.K = Matrix{{17890, 0}, {0, 0}};
  loose.elements[0].directions = vector({0, 1});
  loose.forces = {{vector({1, 0.5}), 1, 1, 0}, {vector({0, 1}), 1, 0, 4}};
  loose.response = vector({1, 0});
  Newmark slips(loose, 100);
  const auto ended = newmark_periods(slips, at_rest(loose), 3, true, true);
  CHECK(ended.failure == reasons::singular);
  CHECK(ended.message.find("the equations are singular in the step after t = 0.00") == 0);
  CHECK(ended.history.time.size() > 1);
  CHECK(ended.history.time.back() == ended.time);
  CHECK(ended.time < 0.05);

  auto runaway = oscillator(1, 0, -1e6, 1, 1);
  Newmark grows(runaway, 10000);
  const auto gone = newmark_periods(grows, at_rest(runaway), 10, true, true);
  CHECK(gone.failure == reasons::not_finite);
  CHECK(gone.history.time.size() > 100);
  CHECK(std::isfinite(gone.history.displacement.back()));
  for (const auto solved : {Solved::no, Solved::singular, Solved::not_finite})
    CHECK_FALSE(failure_of(solved, 1).first.code.empty());

  auto nowhere = oscillator(std::nan(""), 0, 1, 1, 1);
  Newmark nan(nowhere, 10);
  CHECK(newmark_periods(nan, at_rest(nowhere), 1, true, true).failure == reasons::not_finite);
}

TEST_CASE("a softening spring that jumps through within a step is solved or ends with a reason") {
  for (const long steps : {1L, 2L, 3L, 5L, 8L, 1000L}) {
    auto equation = oscillator(1, 0.1, 1, 0.4, 0.8);
    add_cubic(equation, vector({1}), -0.2);
    Newmark newmark(equation, steps);
    const auto motion = newmark_periods(newmark, at_rest(equation), 20, true, true);
    CAPTURE(steps, motion.failure);
    CHECK((motion.done() || motion.failure == reasons::no_convergence ||
           motion.failure == reasons::not_finite));
    for (const double x : motion.history.displacement) REQUIRE(std::isfinite(x));
    if (steps == 1000) CHECK(motion.done());
  }
}

TEST_CASE("one step per period and a million are both taken, and balance their energy") {
  for (const long steps : {1L, 2L, 3L, 1'000'000L}) {
    CAPTURE(steps);
    const auto equation = paper(20, 3);
    Newmark newmark(equation, steps);
    newmark.begin(at_rest(equation));
    REQUIRE(run(newmark, std::max(steps, 500L)) == Solved::yes);
    const auto energy = newmark.energy();
    const double roundings = 1e-15 * static_cast<double>(newmark.step_number());
    CHECK(std::abs(energy.defect()) <= roundings * (std::abs(energy.input) + energy.friction));
  }
  CHECK_THROWS_WITH(Newmark(paper(20, 3), 0), "steps per period: found 0, must be at least 1");
  CHECK_THROWS_WITH(Newmark(paper(0, 3), 10), Catch::Contains("frequency: found 0"));
}

TEST_CASE("a million steps per period leave an error of 1e-10, not of rounding") {
  // of the closed form; halving the steps twice from 1000 steps, the error of second order is 3e-6
  const double m = 1.5, c = 6, k = 40, f = 2, w = 4.1;
  const std::complex<double> response = f / std::complex<double>(k - m * w * w, w * c);
  const auto equation = oscillator(m, c, k, f, w);
  Newmark newmark(equation, 1'000'000);
  newmark.begin({vector({response.real()}), vector({-w * response.imag()}), Vector()});
  REQUIRE(run(newmark, 1'000'000) == Solved::yes);
  CHECK(std::abs(newmark.state().x[0] - response.real()) < 1e-10 * std::abs(response));
}

TEST_CASE("contacts far stiffer than the structure come to Den Hartog's closed form of Coulomb friction",
          "[numbers]") {
  for (const double kd : {1e9, 1e12, 1e15}) {
    CAPTURE(kd);
    auto equation = oscillator(1.24, 2, 17890, 1, 2 * pi * 18);
    add_damper(equation, vector({1}), kd, 0.3);
    const long steps = kd == 1e12 ? 16000 : 1000;
    const auto motion = settled(equation, steps, 300);
    REQUIRE(motion.done());
    CHECK(std::abs(motion.energy.defect()) < 1e-12 * motion.energy.input);
    // Den Hartog 1931: Coulomb and viscous friction, sliding without stops
    const double w = std::sqrt(17890 / 1.24), beta = 2 * pi * 18 / w, zeta = 2 / (2 * 1.24 * w);
    const double damped = std::sqrt(1 - zeta * zeta), sine = std::sin(damped * pi / beta) / damped;
    const double below = std::cosh(zeta * pi / beta) + std::cos(damped * pi / beta);
    const double G = (std::sinh(zeta * pi / beta) - zeta * sine) / below, H = sine / (beta * below);
    const double V = 1 / std::hypot(1 - beta * beta, 2 * zeta * beta);
    const double amplitude = (std::sqrt(V * V - 0.09 * H * H) - 0.3 * G) / 17890;
    // the force turns within one step, wherever in it the velocity does: at first order
    CHECK(motion.amplitude == Approx(amplitude).epsilon(4.0 / static_cast<double>(steps)));
  }
}
