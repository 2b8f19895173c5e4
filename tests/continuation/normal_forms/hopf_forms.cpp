// First Lyapunov coefficients of textbook systems, and the cycles that emerge.
//
// The numbers come from reductions in real coordinates, by the formula 3.4.11 of Guckenheimer and Holmes
// (1983) for r' = a r^3, turned to |q| = 1: l1 = 4 a / (omega N^2) with q N the vector of those coordinates.
// For systems of three unknowns the centre manifold is their graph of second order, in 50 digits.

#include "catch.hpp"

#include "continuation/events/hopf_problems.hpp"

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/normal_forms/codimension_two.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

using namespace problems;

namespace {

struct Textbook {
  const char* name;
  int size;
  ResidualFunction residual;
  JacobianFunction jacobian;
  Vector start;
  double lower, upper;
  double hopf, frequency, lyapunov;
};

std::vector<Textbook> textbook_systems() {
  std::vector<Textbook> all;
  // Brusselator, A = 1: -(2 + A^2) / (2 A (1 + 2 A^2)).
  all.push_back({"Brusselator", 2,
                 [](In u, In p, Out F) {
                   F << 1 - (p[0] + 1) * u[0] + u[0] * u[0] * u[1], p[0] * u[0] - u[0] * u[0] * u[1];
                 },
                 [](In u, In p, Eigen::Ref<Matrix> J) {
                   J << 2 * u[0] * u[1] - p[0] - 1, u[0] * u[0], p[0] - 2 * u[0] * u[1], -u[0] * u[0];
                 },
                 Vector{{1.0, 0.5}}, 0.5, 4, 2, 1, -0.5});
  all.push_back(
      {"van der Pol", 2, [](In u, In p, Out F) { F << u[1], -u[0] + (p[0] - u[0] * u[0]) * u[1]; },
       [](In u, In p, Eigen::Ref<Matrix> J) { J << 0, 1, -1 - 2 * u[0] * u[1], p[0] - u[0] * u[0]; },
       Vector::Zero(2), -1, 1.1, 0, 1, -0.25});
  all.push_back({"Rayleigh", 2,
                 [](In u, In p, Out F) { F << u[1], -u[0] + p[0] * u[1] - u[1] * u[1] * u[1]; },
                 [](In u, In p, Eigen::Ref<Matrix> J) { J << 0, 1, -1, p[0] - 3 * u[1] * u[1]; },
                 Vector::Zero(2), -1, 1.1, 0, 1, -0.75});
  // v' = v - v^3 / 3 - w + I, w' = e (v + a - b w), e = 0.08, a = 0.7, b = 0.8: 1 - v^2 = e b.
  const double v = -std::sqrt(0.936), current = (v + 0.7) / 0.8 - v + v * v * v / 3;
  all.push_back({"FitzHugh-Nagumo", 2,
                 [](In u, In p, Out F) {
                   F << u[0] - u[0] * u[0] * u[0] / 3 - u[1] + p[0], 0.08 * (u[0] + 0.7 - 0.8 * u[1]);
                 },
                 [](In u, In, Eigen::Ref<Matrix> J) { J << 1 - u[0] * u[0], -1, 0.08, -0.064; },
                 Vector{{-1.2, -0.6}}, 0, 0.6, current, std::sqrt(1186.0) / 125,
                 1071875 * std::sqrt(1186.0) / 37978092});
  // u' = a - u + u^2 v, v' = b - u^2 v with b free, a = 3/16: b = 5/16.
  all.push_back({"Schnakenberg", 2,
                 [](In u, In p, Out F) {
                   const double uuv = u[0] * u[0] * u[1];
                   F << 0.1875 - u[0] + uuv, p[0] - uuv;
                 },
                 [](In u, In, Eigen::Ref<Matrix> J) {
                   J << -1 + 2 * u[0] * u[1], u[0] * u[0], -2 * u[0] * u[1], -u[0] * u[0];
                 },
                 Vector{{0.4, 1.4}}, 0.2, 0.35, 0.3125, 0.5, -2.0 / 3});
  // x' = -x + a y + x^2 y, y' = b - a y - x^2 y, a = 0.08: b^2 = 18/25.
  all.push_back({"Selkov", 2,
                 [](In u, In p, Out F) {
                   const double rate = 0.08 * u[1] + u[0] * u[0] * u[1];
                   F << -u[0] + rate, p[0] - rate;
                 },
                 [](In u, In, Eigen::Ref<Matrix> J) {
                   const double a = 2 * u[0] * u[1], b = 0.08 + u[0] * u[0];
                   J << -1 + a, b, -a, -b;
                 },
                 Vector{{0.7, 1.2}}, 0.7, 1, std::sqrt(0.72), 2 * std::sqrt(5.0) / 5,
                 -33 * std::sqrt(5.0) / 260});
  // Rosenzweig and MacArthur: x' = x (1 - x) - 2 x y / (a + x), y' = -y + 2 x y / (a + x): a = 1/3.
  all.push_back({"predator and prey", 2,
                 [](In u, In p, Out F) {
                   const double eaten = 2 * u[0] * u[1] / (p[0] + u[0]);
                   F << u[0] * (1 - u[0]) - eaten, eaten - u[1];
                 },
                 [](In u, In p, Eigen::Ref<Matrix> J) {
                   const double s = p[0] + u[0], a = 2 * u[1] * p[0] / (s * s), b = 2 * u[0] / s;
                   J << 1 - 2 * u[0] - a, -b, a, b - 1;
                 },
                 Vector{{0.5, 0.25}}, 0.2, 0.5, 1.0 / 3, std::sqrt(1.0 / 3), -9 * std::sqrt(3.0) / 8});
  all.push_back({"Lorenz", 3,
                 [](In u, In p, Out F) {
                   F << 10 * (u[1] - u[0]), u[0] * (p[0] - u[2]) - u[1], u[0] * u[1] - 8.0 / 3 * u[2];
                 },
                 [](In u, In p, Eigen::Ref<Matrix> J) {
                   J << -10, 10, 0, p[0] - u[2], -1, -u[0], u[1], u[0], -8.0 / 3;
                 },
                 Vector{{7.1, 7.1, 19.0}}, 20, 30, 470.0 / 19, 9.6245300637157563534,
                 0.00026551897258367143});
  // x' = y, y' = z, z' = -a z - y - x + x^2, at a = 1: -0.3, as in the manual of MatCont.
  all.push_back({"adaptive control", 3,
                 [](In u, In p, Out F) { F << u[1], u[2], -p[0] * u[2] - u[1] - u[0] + u[0] * u[0]; },
                 [](In u, In p, Eigen::Ref<Matrix> J) { J << 0, 1, 0, 0, 0, 1, -1 + 2 * u[0], -1, -p[0]; },
                 Vector::Zero(3), 0.5, 2, 1, 1, -0.3});
  all.push_back({"Roessler", 3,
                 [](In u, In p, Out F) { F << -u[1] - u[2], u[0] + p[0] * u[1], 2 + u[2] * (u[0] - 4); },
                 [](In u, In p, Eigen::Ref<Matrix> J) { J << 0, -1, -1, 1, p[0], 0, u[2], 0, u[0] - 4; },
                 Vector{{0.03, -0.5, 0.5}}, 0.05, 0.3, 0.124967482339959737, 1.0080321898721490145,
                 -0.0054120326610924672});
  return all;
}

enum class Given { nothing, jacobian, all };

std::shared_ptr<const Problem> problem_of(const Textbook& system, Given given) {
  Functions f;
  f.size = system.size;
  f.parameters = {{"p", ""}};
  f.residual = system.residual;
  if (given != Given::nothing) f.jacobian = system.jacobian;
  return from_functions(std::move(f));
}

Event hopf_of(const std::shared_ptr<const Problem>& problem, const Vector& start, double lower,
              double upper) {
  const Branch branch =
      trace(problem, {.u = start, .p = Vector{{lower}}}, window(lower, upper), hopf_monitors(*problem));
  CAPTURE(branch.stop.message);
  REQUIRE(branch.events.size() == 1);
  return branch.events[0];
}

}  // namespace

TEST_CASE(
    "first Lyapunov coefficients of ten systems are their closed forms, with J to 1e-10, by F to 1e-7") {
  for (const Textbook& system : textbook_systems())
    for (const Given given : {Given::jacobian, Given::nothing}) {
      const bool exact = given == Given::jacobian;
      const Event event = hopf_of(problem_of(system, given), system.start, system.lower, system.upper);
      const Hopf& hopf = std::get<Hopf>(event.data);
      const double off = std::abs(hopf.lyapunov.value / system.lyapunov - 1);
      CAPTURE(system.name, exact, off, hopf.lyapunov.value, hopf.lyapunov.error, event.point.parameter);
      CHECK(std::abs(event.point.parameter - system.hopf) < 1e-8);
      CHECK(std::abs(hopf.frequency - system.frequency) < 1e-7);
      CHECK(off < (exact ? 1e-10 : 1e-7));
      CHECK(off * std::abs(system.lyapunov) <= hopf.lyapunov.error);
      CHECK(hopf.lyapunov.error < (exact ? 1e-8 : 1e-7) * std::abs(system.lyapunov));
      CHECK(hopf.criticality ==
            (system.lyapunov < 0 ? Criticality::supercritical : Criticality::subcritical));
    }
}

namespace {

// Z' = (p + i) Z + (s + i b) Z |Z|^2 with Z = x + i y: the cycle |Z|^2 = -p / s has the frequency 1 - p b /
// s.
std::shared_ptr<const Problem> normal_form(double s, double b, bool derivatives) {
  Functions f;
  f.size = 2;
  f.parameters = {{"p", ""}};
  f.residual = [=](In u, In p, Out F) {
    const double square = u.squaredNorm(), growth = p[0] + s * square, turning = 1 + b * square;
    F << growth * u[0] - turning * u[1], turning * u[0] + growth * u[1];
  };
  if (derivatives) {
    f.jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) {
      const double x = u[0], y = u[1], g = p[0] + s * (x * x + y * y), t = 1 + b * (x * x + y * y);
      J << g + 2 * x * (s * x - b * y), -t + 2 * y * (s * x - b * y), t + 2 * x * (b * x + s * y),
          g + 2 * y * (b * x + s * y);
    };
    f.directional = [=](int order, In u, In, In v, In q, Out d) {
      // |u + e v|^2 = m0 + m1 e + m2 e^2
      const double m0 = u.squaredNorm(), m1 = 2 * u.dot(v), m2 = v.squaredNorm();
      const auto part = [&](double m, double linear, In w, double sign) -> Vector {
        const double growth = sign * linear + s * m, turning = b * m;
        return Vector{{growth * w[0] - turning * w[1], turning * w[0] + growth * w[1]}};
      };
      static_cast<void>(m0);
      if (order == 2)
        d = 2 * (part(m2, 0, u, 0) + part(m1, q[0], v, 1));
      else
        d = 6 * part(m2, 0, v, 0);
    };
  }
  return from_functions(std::move(f));
}

}  // namespace

TEST_CASE("the form of a Hopf point that is found by its frequency takes J once") {
  int jacobians = 0;  // z' = (p + i) z - z |z|^2: c = -2 with |q| = 1
  Functions f;
  f.size = 2;
  f.parameters = {{"p", ""}};
  f.residual = [](In u, In p, Out F) {
    const double growth = p[0] - u.squaredNorm();
    F << growth * u[0] - u[1], u[0] + growth * u[1];
  };
  f.jacobian = [&](In u, In p, Eigen::Ref<Matrix> J) {
    ++jacobians;
    const double x = u[0], y = u[1], g = p[0] - x * x - y * y;
    J << g - 2 * x * x, -1 - 2 * x * y, 1 - 2 * x * y, g - 2 * y * y;
  };
  f.derivative = [](In u, In, int, Out dF) { dF = u; };
  f.directional = [](int order, In u, In, In v, In q, Out d) {
    if (order == 2)
      d = 2 * q[0] * v - 2 * (v.squaredNorm() * u + 2 * u.dot(v) * v);
    else
      d = -6 * v.squaredNorm() * v;
  };
  const auto problem = from_functions(f);
  const auto at = problem->evaluator();
  const Hopf hopf = hopf_form_near(*at, {Vector::Zero(2), Vector::Zero(1), 0, Vector::Ones(3)}, 1.1);
  CHECK(jacobians == 1);
  CHECK(std::abs(hopf.frequency - 1) < 1e-14);
  CHECK(std::abs(hopf.lyapunov.value + 2) < 1e-13);
}

TEST_CASE(
    "errors of Lyapunov coefficients by F alone are estimated, wherever the steps lead to the Hopf point") {
  for (const Textbook& system : textbook_systems())
    for (int k = 0; k < 20; ++k) {
      const double upper = system.upper + 3e-3 * k * (system.upper - system.lower);
      const Event event = hopf_of(problem_of(system, Given::nothing), system.start, system.lower, upper);
      const Coefficient& lyapunov = std::get<Hopf>(event.data).lyapunov;
      CAPTURE(system.name, k, lyapunov.value, lyapunov.error);
      CHECK(std::abs(lyapunov.value - system.lyapunov) <= lyapunov.error);
      CHECK(lyapunov.error < 1e-6 * std::abs(system.lyapunov));
    }
}

TEST_CASE(
    "cycles near the Hopf point of the normal form are its cycles, with derivatives of the user or none") {
  for (const double s : {-0.7, 0.7})
    for (const bool given : {true, false}) {
      const double b = 0.4, e = 0.01;
      const Event event = hopf_of(normal_form(s, b, given), Vector::Zero(2), -0.5, 0.6);
      const Hopf& hopf = std::get<Hopf>(event.data);
      const double tolerance = given ? 1e-13 : 1e-9;
      CHECK(std::abs(hopf.lyapunov.value - 2 * s) < tolerance);
      CHECK(std::abs(hopf.detuning.value - 2 * b) < tolerance);
      CHECK(std::abs(hopf.growth.value - 1) < tolerance);
      CHECK(std::abs(hopf.drift.value) < tolerance);
      const NearbyCycle cycle = cycle_near(event, e);
      CHECK(std::abs(cycle.parameter + 2 * s * e * e) < tolerance);
      CHECK(std::abs(cycle.frequency - (1 + 2 * b * e * e)) < tolerance);
      for (const double theta : {0.0, 1.0, 2.5})
        CHECK(std::abs(cycle.at(theta).norm() - std::sqrt(2.0) * e) < 1e-9);
    }
}

TEST_CASE("the first approximation of Selkov's cycles leaves errors of the third power of the amplitude") {
  const Textbook selkov = textbook_systems()[5];
  const auto problem = problem_of(selkov, Given::jacobian);
  const Event event = hopf_of(problem, selkov.start, selkov.lower, selkov.upper);
  const auto at = problem->evaluator();
  Matrix J(2, 2);
  selkov.jacobian(event.point.u, Vector{{event.point.parameter}}, J);
  const Eigen::Vector2cd w{-J(1, 0), std::complex<double>(J(0, 0), selkov.frequency)};  // J^T w = -i omega w
  const auto errors = [&](double e) {
    const NearbyCycle cycle = cycle_near(event, e);
    const int places = 16;
    std::complex<double> along = 0;
    double largest = 0;
    for (int k = 0; k < places; ++k) {
      const double theta = 2 * std::numbers::pi * k / places, h = 1e-4;
      at->move_to(cycle.at(theta), Vector{{cycle.parameter}}, Needs::residual);
      const Vector rate = (8 * (cycle.at(theta + h) - cycle.at(theta - h)) -
                           (cycle.at(theta + 2 * h) - cycle.at(theta - 2 * h))) /
                          (12 * h);
      const Vector miss = cycle.frequency * rate - at->residual();
      largest = std::max(largest, miss.norm());
      along += w.dot(miss.cast<std::complex<double>>()) * std::polar(1.0 / places, -theta);
    }
    return std::pair{largest, std::abs(along)};
  };
  const auto [rough, rough_along] = errors(0.02);
  const auto [fine, fine_along] = errors(0.01);
  CHECK(std::abs(rough / fine - 8) < 0.5);
  // What moves amplitude and phase has errors of the fifth power, by p and frequency of the second.
  CHECK(rough_along / fine_along > 28);
}

TEST_CASE("a sparse Jacobian has the normal form of the dense one") {
  const Line line{10};
  const auto problem = line.problem();
  const double A = 2;
  const Start start{line.homogeneous(A, 4), Vector{{4.0, A}}, 0, 1};
  const Branch branch = trace(problem, start, window(4, line.B(1, A) + 0.1), hopf_monitors(*problem));
  REQUIRE(branch.events.size() == 1);
  const Hopf& sparse = std::get<Hopf>(branch.events[0].data);
  const auto dense_problem = from_functions(
      problem->size(), {parameter("B", 1), parameter("A", 2)},
      [problem](In u, In p, Out F) {
        const auto at = problem->evaluator();
        at->move_to(u, p, Needs::residual);
        F = at->residual();
      },
      [problem](In u, In p, Eigen::Ref<Matrix> J) {
        const auto at = problem->evaluator();
        at->move_to(u, p, Needs::jacobian);
        J = Matrix(std::get<SparseMatrix>(at->jacobian()));
      });
  const Branch dense = trace(dense_problem, start, window(4, line.B(1, A) + 0.1), hopf_monitors(*problem));
  REQUIRE(dense.events.size() == 1);
  const Hopf& full = std::get<Hopf>(dense.events[0].data);
  CHECK(std::abs(sparse.lyapunov.value / full.lyapunov.value - 1) < 1e-9);
  CHECK(std::abs(sparse.growth.value / full.growth.value - 1) < 1e-9);
  // Re mu = (B - 1 - A^2 - (d1 + d2) wave) / 2 for each mode.
  CHECK(std::abs(sparse.growth.value - 0.5) < 1e-9);
}

TEST_CASE("unknowns of sizes from 1e-6 to 1e6 have the normal form of their units") {
  // The Brusselator in x s, y / s: l1 is that of |q| = 1 in these units; the growth has none.
  for (const bool exact : {true, false})
    for (const double s : {1e-6, 1e-3, 1e3, 1e6}) {
      Functions f;
      f.size = 2;
      f.parameters = {{"B", ""}};
      f.scales = Vector{{s, 1 / s}};
      f.residual = [=](In u, In p, Out F) {
        const double x = u[0] / s, y = u[1] * s, x2y = x * x * y;
        F << s * (1 - (p[0] + 1) * x + x2y), (p[0] * x - x2y) / s;
      };
      if (exact)
        f.jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) {
          const double x = u[0] / s, y = u[1] * s;
          J << 2 * x * y - p[0] - 1, s * s * x * x, (p[0] - 2 * x * y) / (s * s), -x * x;
        };
      const Event event = hopf_of(from_functions(std::move(f)), Vector{{s, 0.5 / s}}, 0.5, 4);
      const Hopf& hopf = std::get<Hopf>(event.data);
      // q in the units of the Brusselator is (1, i - 1) / sqrt(3) with l1 = -1/2, and z turns with |q|.
      const double length = std::hypot(s, std::sqrt(2.0) / s) / std::sqrt(3.0);
      CAPTURE(exact, s);
      CHECK(std::abs(hopf.growth.value - 0.5) < (exact ? 1e-9 : 1e-7));
      CHECK(std::abs(hopf.lyapunov.value * length * length / -0.5 - 1) < (exact ? 1e-8 : 1e-6));
    }
}

TEST_CASE(
    "next to a zero-Hopf point a Lyapunov coefficient is within its error, which grows like the "
    "coefficient") {
  // w = (x, y, v): z' = (p + i) z + z v of z = x + i y, and v' = -s v + a |z|^2, with v = a |z|^2 / s on the
  // centre manifold: l1 = 4 a / (s |T (1, -i, 0)|^2) in the coordinates u = T w.
  const Matrix mixed{{1.0, 0.3, -0.7}, {-0.2, 0.9, 0.4}, {0.5, -0.6, 1.3}};
  const Matrix T = GENERATE(0, 1) ? mixed : Matrix::Identity(3, 3);
  const Matrix back = solve(T, Matrix::Identity(3, 3));
  const double a = -0.7, size = T.col(0).squaredNorm() + T.col(1).squaredNorm();
  for (const bool exact : {true, false})
    for (const double s : {1e-1, 1e-3, 1e-5, 1e-6}) {
      CAPTURE(exact, s);
      const auto rates = [a, s](const Vector& w, double p) {
        return Vector{{p * w[0] - w[1] + w[0] * w[2], w[0] + p * w[1] + w[1] * w[2],
                       -s * w[2] + a * (w[0] * w[0] + w[1] * w[1])}};
      };
      Functions f;
      f.size = 3;
      f.parameters = {parameter("p", 0)};
      f.residual = [=](In u, In p, Out F) { F = T * rates(back * u, p[0]); };
      if (exact)
        f.jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) {
          const Vector w = back * u;
          const Matrix of_w{
              {p[0] + w[2], -1, w[0]}, {1, p[0] + w[2], w[1]}, {2 * a * w[0], 2 * a * w[1], -s}};
          J = T * of_w * back;
        };
      const auto problem = from_functions(f);
      const auto at = problem->evaluator();
      const PlaceOfForms place{Vector::Zero(3), Vector::Zero(1), 0, Vector::Ones(4)};
      const Hopf hopf = hopf_form_near(*at, place, 1);
      const double lyapunov = 4 * a / (s * size), error = std::abs(hopf.lyapunov.value - lyapunov);
      CHECK(error <= hopf.lyapunov.error);
      CHECK(hopf.lyapunov.error < (exact ? 1e-8 : 1e-3) / (s * s));
    }
}

TEST_CASE("without a normal form a Hopf point has none, and no cycles near it") {
  const auto problem = problem_of(textbook_systems()[0], Given::jacobian);
  const Branch branch = trace(problem, {.u = Vector{{1.0, 0.5}}, .p = Vector{{0.5}}}, window(0.5, 4),
                              hopf_monitors(*problem, {.normal_form = false}));
  REQUIRE(branch.events.size() == 1);
  const Hopf& hopf = std::get<Hopf>(branch.events[0].data);
  CHECK(std::abs(hopf.frequency - 1) < 1e-12);
  CHECK(!hopf.lyapunov.known());
  CHECK(hopf.criticality == Criticality::unknown);
  CHECK_THROWS_WITH(cycle_near(branch.events[0], 0.1),
                    Catch::Matchers::Contains("normal form of the Hopf point at 2") &&
                        Catch::Matchers::Contains("is not known"));
}

TEST_CASE("cycles near an event ask for a Hopf point and a positive amplitude") {
  const Event hopf = hopf_of(problem_of(textbook_systems()[1], Given::jacobian), Vector::Zero(2), -1, 1.1);
  Event other;
  other.monitor = "half";
  CHECK_THROWS_WITH(cycle_near(other, 0.1), "the event \"half\" has no data of a Hopf point");
  for (const double amplitude : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    CHECK_THROWS_WITH(cycle_near(hopf, amplitude),
                      Catch::Matchers::Contains("the amplitude of a cycle is ") &&
                          Catch::Matchers::Contains("must be positive"));
}

TEST_CASE("a Hopf point of a linear system has l1 = 0 and an unknown criticality") {
  const auto problem = from_functions(
      2, {{"p", ""}}, [](In u, In p, Out F) { F << p[0] * u[0] - u[1], u[0] + p[0] * u[1]; },
      [](In, In p, Eigen::Ref<Matrix> J) { J << p[0], -1, 1, p[0]; });
  const Hopf hopf = std::get<Hopf>(hopf_of(problem, Vector::Zero(2), -0.5, 0.6).data);
  CHECK(std::abs(hopf.lyapunov.value) <= hopf.lyapunov.error);
  CHECK(hopf.lyapunov.error < 1e-10);
  CHECK(hopf.criticality == Criticality::unknown);
  CHECK(std::abs(hopf.growth.value - 1) < 1e-9);
}

TEST_CASE(
    "a derivative of the user that throws or is not finite leaves the normal form unknown, and the event") {
  for (const bool throws : {true, false}) {
    Functions f;
    f.size = 2;
    f.parameters = {{"p", ""}};
    f.residual = textbook_systems()[1].residual;
    f.jacobian = textbook_systems()[1].jacobian;
    f.directional = [=](int, In, In, In, In, Out d) {
      if (throws) throw std::runtime_error("no third derivative");
      d.setConstant(std::nan(""));
    };
    const Hopf hopf = std::get<Hopf>(hopf_of(from_functions(std::move(f)), Vector::Zero(2), -1, 1.1).data);
    CHECK(std::abs(hopf.frequency - 1) < 1e-12);
    CHECK(!hopf.lyapunov.known());
    CHECK(hopf.criticality == Criticality::unknown);
  }
}

TEST_CASE("the normal form of a Hopf point next to a kink is that of its own piece") {
  // van der Pol's equation with a further force beyond |x| = d.
  for (const double d : {1e-2, 1e-4}) {
    Functions f;
    f.size = 2;
    f.parameters = {{"p", ""}};
    f.residual = [=](In u, In p, Out F) {
      F << u[1], -u[0] + (p[0] - u[0] * u[0]) * u[1] - std::max(0.0, u[0] - d) - std::min(0.0, u[0] + d);
    };
    f.piece = [=](In u, In) { return u[0] > d ? 2 : u[0] < -d ? 1 : 0; };
    const Hopf hopf = std::get<Hopf>(hopf_of(from_functions(std::move(f)), Vector::Zero(2), -1, 1.1).data);
    CAPTURE(d, hopf.lyapunov.value, hopf.lyapunov.error);
    CHECK(std::abs(hopf.lyapunov.value + 0.25) < (d < 1e-3 ? 1e-3 : 1e-7));
    CHECK(std::abs(hopf.lyapunov.value + 0.25) <= hopf.lyapunov.error);
  }
}

TEST_CASE("the normal form of a Hopf point survives saving") {
  const auto problem = problem_of(textbook_systems()[5], Given::jacobian);
  Tracer tracer(problem, {.u = Vector{{0.7, 1.2}}, .p = Vector{{0.7}}}, window(0.7, 1),
                hopf_monitors(*problem));
  while (tracer.step()) {
  }
  const State state = state_from_json(to_json(tracer.save()));
  REQUIRE(state.branch.events.size() == 1);
  const Hopf &kept = std::get<Hopf>(state.branch.events[0].data),
             &hopf = std::get<Hopf>(tracer.branch().events[0].data);
  CHECK(kept.lyapunov.value == hopf.lyapunov.value);
  CHECK(kept.growth.error == hopf.growth.error);
  CHECK(kept.criticality == Criticality::supercritical);
  CHECK(kept.mean == hopf.mean);
  CHECK(kept.second_imaginary == hopf.second_imaginary);
  CHECK(kept.frequency_shift == hopf.frequency_shift);
}
