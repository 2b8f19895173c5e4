// Floquet multipliers along motions of hysteretic laws: closed forms, Liouville's formula, and differences of
// an independent march of the whole structure.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/stability/along_harmonics.hpp"
#include "lib/stability/cosine.hpp"
#include "lib/stability/multiplier_distance.hpp"
#include "lib/stability/rate_march.hpp"
#include "lib/time/equation/systems.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/laws/hysteresis/bouc_wen.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/stability/floquet.hpp>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

using namespace arcslip;
using multiplier_distance::distance, multiplier_distance::difference;
using namespace arcslip::time;

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

void add_wire(EquationOfMotion& equation, const Vector& d, double k, double a, double z_y, double n,
              double s) {
  equation.add("wire" + std::to_string(equation.memory), elements::bouc_wen().law({}), {k, a, z_y, n, s}, d);
}

EquationOfMotion equation_of(const rate_march::Structure& structure) {
  EquationOfMotion equation;
  equation.M = structure.M;
  equation.C = structure.C;
  equation.K = structure.K;
  equation.omega = structure.omega;
  for (const auto& w : structure.wires) add_wire(equation, w.d, w.k, w.a, w.z_y, w.n, w.s);
  for (const auto& s : structure.sliders) systems::add_damper(equation, s.d, s.k, s.limit);
  for (const auto& c : structure.cubics) equation.add("cubic", elements::cubic_spring().law({}), {c.k}, c.d);
  return equation;
}

// The courses of the periodic motion that begins at y.
std::vector<ElementCourse> courses_of(const rate_march::Structure& structure, Vector y, int steps, int order,
                                      const EquationOfMotion& equation) {
  const elements::Harmonics harmonics{order};
  const int count = 2 * order + 2, each = steps / count;
  REQUIRE(each * count == steps);
  rate_march::March march(structure, steps);
  std::vector<ElementCourse> courses;
  for (const auto& element : equation.elements)
    courses.push_back({Matrix::Zero(harmonics.size(), element.directions.cols()), {}});
  Vector phi(harmonics.size());
  for (int i = 0; i < count; ++i) {
    elements::series_basis(harmonics, 2 * pi * i / count, phi);
    phi *= 2.0 / count;
    phi[0] = 1.0 / count;
    for (std::size_t e = 0; e < courses.size(); ++e)
      courses[e].q +=
          phi * (equation.elements[e].directions.transpose() * y.head(equation.dofs())).transpose();
    march.advance(y, i * each, each);
  }
  return courses;
}

rate_march::Structure oscillator(const rate_march::Wire& wire, double force, double omega) {
  return {.M = Matrix::Ones(1, 1),
          .C = Matrix::Constant(1, 1, 0.08),
          .K = Matrix::Constant(1, 1, 0.7),
          .g = Vector::Constant(1, force),
          .g_2 = Vector::Constant(1, 0.3 * force),
          .omega = omega,
          .wires = {wire}};
}

rate_march::Structure three_masses() {
  rate_march::Structure s{.M = Vector{{1.0, 0.7, 0.5}}.asDiagonal().toDenseMatrix(),
                          .C = Matrix{{0.06, -0.02, 0}, {-0.02, 0.05, -0.01}, {0, -0.01, 0.03}},
                          .K = Matrix{{2.0, -0.9, 0}, {-0.9, 1.7, -0.5}, {0, -0.5, 0.9}},
                          .g = Vector{{0.8, 0.0, 0.3}},
                          .g_2 = Vector{{0.0, 0.2, 0.1}},
                          .omega = 0.83};
  s.wires = {{Vector{{1.0, 0.0, 0.0}}, 0.9, 0.2, 0.5, 1, 0.5},
             {Vector{{0.0, 1.0, -1.0}}, 0.6, 0, 0.3, 2.4, 0.9}};
  s.sliders = {{Vector{{0.0, 1.0, 0.0}}, 0.5, 0.2}};
  s.cubics = {{Vector{{1.0, -1.0, 0.0}}, 0.4}};
  return s;
}

// The displacements at which q reverses, in their order.
std::vector<double> reversals(const elements::Harmonics& harmonics, const Vector& q) {
  std::vector<double> found;
  constexpr int count = 2000;
  const auto slope = [&](double theta) { return elements::series_values(harmonics, q, theta).d1; };
  for (int i = 0; i < count; ++i) {
    double low = 2 * pi * i / count, high = 2 * pi * (i + 1) / count;
    const bool rises = slope(low) > 0;
    if (rises == (slope(high) > 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((slope(middle) > 0) == rises ? low : high) = middle;
    }
    found.push_back(elements::series_values(harmonics, q, low).x);
  }
  return found;
}

// The integral of (dr/dz) q' over a period of the memory that repeats, by the method of Runge and Kutta over
// q.
double integral(const elements::Harmonics& harmonics, const Vector& q, double z_y, double n, double s) {
  const auto at = reversals(harmonics, q);
  struct State {
    double z, sum;
  };
  const auto loop = [&](double z) {
    State now{z, 0};
    for (std::size_t k = 0; k < at.size(); ++k) {
      const double to = k + 1 < at.size() ? at[k + 1] : at[0], way = to > at[k] ? 1 : -1;
      double rest = std::abs(to - at[k]);
      const double longest = rest / 2000;
      while (rest > 1e-14 * z_y) {
        // Shorter where z passes 0: r has no further derivative there.
        const double h = way * std::min({rest, longest, 0.02 * std::abs(now.z) + 1e-7 * z_y});
        rest -= std::abs(h);
        const auto step = [&](double part, double side) {
          const auto rate = [&](double here) {
            const double share = std::max(side * here / z_y, 0.0), turn = s * way * side + 1 - s;
            return State{1 - std::pow(share, n) * turn, -n * std::pow(share, n - 1) * turn * side / z_y};
          };
          const State a = rate(now.z), b = rate(now.z + part / 2 * a.z), c = rate(now.z + part / 2 * b.z),
                      d = rate(now.z + part * c.z);
          return State{now.z + part / 6 * (a.z + 2 * b.z + 2 * c.z + d.z),
                       now.sum + part / 6 * (a.sum + 2 * b.sum + 2 * c.sum + d.sum)};
        };
        const double side = now.z != 0 ? std::copysign(1, now.z) : way;
        const State end = step(h, side);
        if (end.z * side >= 0) {
          now = end;
          continue;
        }
        double low = 0, high = 1;  // z passes 0
        for (int j = 0; j < 60; ++j) {
          const double middle = 0.5 * (low + high);
          (step(middle * h, side).z * side >= 0 ? low : high) = middle;
        }
        now = step(low * h, side);
        now.z = 0;
        now = step((1 - low) * h, -side);
      }
    }
    return now;
  };
  double low = -z_y, high = z_y;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (loop(middle).z > middle ? low : high) = middle;
  }
  return loop(low).sum;
}

}  // namespace

TEST_CASE("with an elastic share of 1 the memory goes its own way: its multiplier is the closed form") {
  // q = A cos theta, exponent 1, elastic unloading: from a reversal at -x_e, x grows to 0 as q does, and on
  // as 1 - exp(-g): x_e = 1 - exp(-(2A/z_y - x_e)), and half a period leaves 1 - x_e of a disturbance.
  const double m = 1, c = 0.1, k = 0.6, wire = 0.9;
  for (const double A : {1e-6, 0.1, 0.7, 3.0, 1e4})
    for (const bool odd : {false, true}) {
      CAPTURE(A, odd);
      const double z_y = 0.4;
      auto equation = systems::oscillator(m, c, k);
      add_wire(equation, Vector::Ones(1), wire, 1, z_y, 1, 0.5);
      const elements::Harmonics harmonics{3, odd};
      Floquet floquet(equation);
      REQUIRE(floquet.compute(1, harmonics, cosine::along(equation, harmonics, A)));
      double x = 0;  // by Newton's method for 1 - x - exp(-(2A/z_y - x)) = 0
      for (int i = 0; i < 100; ++i) {
        const double e = std::exp(x - 2 * A / z_y);
        x += (1 - x - e) / (1 + e);
      }
      const double rest = std::exp(x - 2 * A / z_y);
      const double decay = std::exp(-pi * c / m), rate = std::sqrt((k + wire) / m - c * c / 4);
      const std::vector<Complex> exact{std::polar(decay, 2 * pi * rate), std::polar(decay, -2 * pi * rate),
                                       rest * rest};
      REQUIRE(floquet.multipliers().size() == 3);
      CHECK(difference(floquet.multipliers(), exact) < 2e-13);
    }
}

TEST_CASE("the product of the multipliers is what damping and the wires' yield leave of a volume") {
  // Along any q: exp(-tr(M^-1 C) T + the integrals of dr/dz q').
  auto equation = systems::masses(Vector{{1.0, 0.7}});
  equation.K << 2.0, -0.6, -0.6, 1.3;
  equation.C << 0.1, -0.03, -0.03, 0.05;
  const double omega = 0.7;
  struct Fields {
    double z_y, n, s;
  };
  const elements::Harmonics harmonics{4};
  Matrix q = Matrix::Zero(harmonics.size(), 1);
  q.col(0) << 0.1, 0.9, -0.3, 0.5, 0.1, 0.4, -0.1, 0.3, -0.1;
  for (const Fields wire : {Fields{0.6, 1, 0.5}, {0.9, 1.4, 0.8}, {1.5, 3, 0.5}, {0.8, 2, 3}, {2, 8, 0.7}}) {
    CAPTURE(wire.z_y, wire.n, wire.s);
    auto with = equation;
    add_wire(with, Vector{{1.0, 0.0}}, 0.8, 0.1, wire.z_y, wire.n, wire.s);
    add_wire(with, Vector{{1.0, -1.0}}, 0.5, 0.1, 1.3 * wire.z_y, wire.n, wire.s);
    Floquet floquet(with);
    REQUIRE(floquet.compute(omega, harmonics, {{q, {}}, {q, {}}}));
    const double exponent = -(0.1 + 0.05 / 0.7) * 2 * pi / omega +
                            integral(harmonics, q.col(0), wire.z_y, wire.n, wire.s) +
                            integral(harmonics, q.col(0), 1.3 * wire.z_y, wire.n, wire.s);
    const double error = floquet.map().determinant() / std::exp(exponent) - 1;
    UNSCOPED_INFO(error << " of exp(" << exponent << ")");
    CHECK(std::abs(error) < 1e-9);
    REQUIRE(floquet.multipliers().size() == 6);
    Complex product = 1;
    for (const Complex& each : floquet.multipliers()) product *= each;
    CHECK(std::abs(product / std::exp(exponent) - 1.0) < 1e-9);
  }
}

TEST_CASE("given the same orbit, the multipliers are those of differences of an independent march",
          "[numbers]") {
  const Vector one = Vector::Ones(1);
  // With so many harmonics of the orbit that its series leaves less.
  constexpr int steps = 8000, order = 799;
  const rate_march::Structure all[] = {oscillator({one, 0.9, 0.2, 0.4, 1, 0.5}, 0.5, 0.9),
                                       oscillator({one, 0.9, 0.1, 0.6, 2, 0.8}, 0.4, 1.2),
                                       oscillator({one, 0.9, 0, 0.5, 2.5, 2.5}, 0.6, 0.4),
                                       oscillator({one, 0.9, 0.3, 0.3, 12, 0.5}, 0.5, 1.1), three_masses()};
  for (const auto& structure : all) {
    rate_march::March march(structure, steps);
    const Vector start = march.periodic(40);
    const auto exact = march.multipliers(start, 2e-3 * start.norm());
    const auto equation = equation_of(structure);
    Floquet floquet(equation);
    REQUIRE(floquet.compute(structure.omega, {order}, courses_of(structure, start, steps, order, equation)));
    const double error = difference(floquet.multipliers(), exact);
    CAPTURE(structure.dofs(), structure.wires[0].n, error, exact, floquet.multipliers());
    CHECK(floquet.multipliers().size() == exact.size());
    CHECK(error < 5e-9);
  }
}

TEST_CASE("along harmonic balance the multipliers come to those of the march at least like N^-3") {
  const auto structure = three_masses();
  rate_march::March march(structure, 2000);
  const Vector start = march.periodic(40);
  const auto exact = march.multipliers(start, 2e-3 * start.norm());
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y", "z"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 0.7},
                 {"name": "mz", "at": "z", "value": 0.5}],
      "springs": [{"name": "kx", "at": "x", "value": 1.1}, {"name": "ky", "at": "y", "value": 0.3},
                  {"name": "kz", "at": "z", "value": 0.4}, {"name": "kxy", "between": ["x", "y"], "value": 0.9},
                  {"name": "kyz", "between": ["y", "z"], "value": 0.5}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.04}, {"name": "cy", "at": "y", "value": 0.02},
                  {"name": "cz", "at": "z", "value": 0.02}, {"name": "cxy", "between": ["x", "y"], "value": 0.02},
                  {"name": "cyz", "between": ["y", "z"], "value": 0.01}]},
    "elements": [
      {"name": "wire", "type": "bouc_wen", "at": "x", "stiffness": 0.9, "elastic_share": 0.2,
       "yield_displacement": 0.5, "exponent": 1, "shape": 0.5},
      {"name": "link", "type": "bouc_wen", "between": ["y", "z"], "stiffness": 0.6, "elastic_share": 0,
       "yield_displacement": 0.3, "exponent": 2.4, "shape": 0.9},
      {"name": "damper", "type": "jenkins", "at": "y", "stiffness": 0.5, "friction_coefficient": 1,
       "normal_load": 0.2},
      {"name": "cubic", "type": "cubic_spring", "between": ["x", "y"], "stiffness": 0.4}],
    "excitation": [{"name": "fx", "at": "x", "cosine": 0.8}, {"name": "fz", "at": "z", "cosine": 0.3},
      {"name": "gy", "at": "y", "harmonic": 2, "sine": 0.2}, {"name": "gz", "at": "z", "harmonic": 2, "sine": 0.1}],
    "response": {"at": "x"}})");
  double first = 0;
  for (const int order : {5, 15, 45, 91}) {
    s.harmonics.order = order;
    const auto pair = compared_with_exact::balanced(s, structure.omega);
    const double error = difference(along_harmonics::multipliers(pair), exact);
    UNSCOPED_INFO(order << " harmonics: " << error);
    if (order == 5) first = error;
    CHECK(error < 2 * first * std::pow(5.0 / order, 3));
  }
  CHECK(first < 5e-3);
}

TEST_CASE("with a sharp yield the multipliers come to those of a friction damper, as 1/n^2") {
  // In parallel: a spring a k and a damper of stiffness (1 - a) k and slip limit (1 - a) k z_y.
  const double k = 0.9, a = 0.2, z_y = 0.4;
  const elements::Harmonics harmonics{3};
  Matrix q = Matrix::Zero(harmonics.size(), 1);
  q.col(0) << 0.1, 0.9, -0.3, 0.2, 0.1, 0.4, -0.1;
  const auto masses = [] {
    auto equation = systems::masses(Vector{{1.0, 0.7}});
    equation.K << 2.0, -0.6, -0.6, 1.3;
    equation.C << 0.1, -0.03, -0.03, 0.05;
    return equation;
  };
  const Vector d{{1.0, -1.0}};
  auto damped = masses();
  damped.K += a * k * d * d.transpose();
  systems::add_damper(damped, d, (1 - a) * k, (1 - a) * k * z_y);
  Floquet limit(damped);
  REQUIRE(limit.compute(0.7, harmonics, {{q, {}}}));
  double before = 0;
  for (const double n : {50.0, 100.0, 200.0, 400.0}) {
    auto equation = masses();
    add_wire(equation, d, k, a, z_y, n, 0.5);
    Floquet floquet(equation);
    REQUIRE(floquet.compute(0.7, harmonics, {{q, {}}}));
    const double error = difference(floquet.multipliers(), limit.multipliers());
    CAPTURE(n, error, before);
    CHECK(error < 1 / (n * n));
    if (before > 0) CHECK(std::abs(before / error - 4) < 0.2);
    before = error;
  }
}

TEST_CASE("small motions of a wire leave it elastic, and large ones leave its elastic share") {
  const double c = 0.1, k = 0.7, wire = 0.9, a = 0.2;
  const auto pair = [&](double stiffness) {
    const double rate = 2 * pi * std::sqrt(stiffness - c * c / 4);
    return std::vector<Complex>{std::polar(std::exp(-pi * c), rate), std::polar(std::exp(-pi * c), -rate)};
  };
  for (const double n : {1.0, 1.5, 4.0, 100.0})
    for (const double s : {0.5, 0.9, 4.0}) {
      CAPTURE(n, s);
      auto equation = systems::oscillator(1, c, k);
      add_wire(equation, Vector::Ones(1), wire, a, 1, n, s);
      const elements::Harmonics harmonics{5, true};
      Floquet floquet(equation);
      for (const double A : {0.0, 1e-12, 1e-9}) {
        REQUIRE(floquet.compute(1, harmonics, cosine::along(equation, harmonics, A)));
        auto exact = pair(k + wire);
        exact.push_back(1);
        CHECK(difference(floquet.multipliers(), exact) < 1e-13 + 20 * s * A);
        CHECK(std::abs(floquet.multipliers()[0]) <= 1 + 1e-13);
      }
      for (const double A : {1e3, 1e6, 1e9}) {
        REQUIRE(floquet.compute(1, harmonics, cosine::along(equation, harmonics, A)));
        auto exact = pair(k + a * wire);
        exact.push_back(0);
        // While it yields dq = O(sqrt(z_y/A)) goes by.
        CHECK(difference(floquet.multipliers(), exact) < 10 * s / std::sqrt(A));
      }
    }
}

TEST_CASE("multipliers are continuous where a motion reverses once more, and do not depend on the start") {
  auto equation = systems::oscillator(1, 0.1, 0.7);
  add_wire(equation, Vector::Ones(1), 0.9, 0.2, 0.5, 1, 0.8);
  const elements::Harmonics harmonics{3};
  // cos theta + b cos 3 theta has two more reversals in each half of a period where b < -1/9 or b > 1/9.
  const auto at = [&](double b, double turned) {
    Matrix q = Matrix::Zero(harmonics.size(), 1);
    q(harmonics.cosine_index(1), 0) = std::cos(turned);
    q(harmonics.sine_index(1), 0) = std::sin(turned);
    q(harmonics.cosine_index(3), 0) = b * std::cos(3 * turned);
    q(harmonics.sine_index(3), 0) = b * std::sin(3 * turned);
    Floquet floquet(equation);
    REQUIRE(floquet.compute(0.8, harmonics, {{q, {}}}));
    return floquet.multipliers();
  };
  for (const double sign : {1.0, -1.0}) {
    const auto before = at(sign * (1.0 / 9 - 1e-7), 0), beyond = at(sign * (1.0 / 9 + 1e-7), 0);
    CHECK(difference(before, beyond) < 1e-5);
    for (const auto& [b, tolerance] : {std::pair{0.3, 1e-10}, {1.0 / 9, 1e-5}}) {
      const auto here = at(sign * b, 0);
      for (const double turned : {0.1, 1.234, 3.0}) {
        CAPTURE(sign, b, turned);
        CHECK(difference(at(sign * b, turned), here) < tolerance);
      }
    }
  }
}
