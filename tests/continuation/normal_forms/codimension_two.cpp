// Points of codimension 2 of systems that are normal forms, with a further unknown v' = -v + quadratic terms
// that acts on them, in turned coordinates u = Q y. Near v = m x^2 + k |Z|^2 its action is that of cubic
// terms.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <Eigen/LU>

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/special_points/hopf_curve.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <complex>

using namespace problems;

namespace {

using Rate = std::function<Vector(const Vector& y, In p)>;
using Z = std::complex<double>;

// Q = 1 - 2 h h^T / h.h.
Matrix reflection_of(int n) {
  const Vector h = Vector::LinSpaced(n, 1, n);
  return Matrix::Identity(n, n) - 2 / h.squaredNorm() * h * h.transpose();
}

// u' = Q f(Q u, p) with the parameters p1 and p2.
std::shared_ptr<const Problem> turned(int n, const Rate& f) {
  const Matrix Q = reflection_of(n);
  return from_functions(n, {parameter("p1", 0), parameter("p2", 0)},
                        [=](In u, In p, Out F) { F = Q * f(Q * u, p); });
}

using Bend = std::function<Vector(const Vector& y)>;

// The same of x = y + phi(y) with y' = f, for quadratic forms phi: x' = f + phi' f, phi' f = (phi(y + f) -
// phi(y - f)) / 2. Forms without resonant terms leave the coefficients of the normal form as they are.
std::shared_ptr<const Problem> turned_and_bent(int n, const Rate& f, const Bend& phi) {
  return turned(n, [=](const Vector& x, In p) -> Vector {
    Vector y = x;
    for (int k = 0; k < 100; ++k) {
      const Vector next = x - phi(y);
      if (next == y) break;
      y = next;
    }
    const Vector rate = f(y, p);
    return rate + 0.5 * (phi(y + rate) - phi(y - rate));
  });
}

void check_value(const Coefficient& found, double expected, double tolerance = 1e-6) {
  CAPTURE(found.value, found.error, expected);
  CHECK(std::abs(found.value - expected) < tolerance);
  CHECK(found.error < 100 * tolerance);
}

// The curve of Hopf points over p2 that begins at the first one of a branch over p1.
Branch hopf_curve_of(const std::shared_ptr<const Problem>& problem, const Start& start, double lower,
                     double upper, double last) {
  const Branch branch =
      trace(problem, start, window(lower, upper), hopf_monitors(*problem, {.normal_form = false}));
  CAPTURE(branch.stop.message);
  REQUIRE(!branch.events.empty());
  const Event& onset = branch.events.front();
  const auto curve = hopf_points(problem, 0, std::get<Hopf>(onset.data).frequency);
  const Start on_it{
      .u = with_frequency(onset), .p = start.p, .free = 1, .direction = last > start.p[1] ? 1 : -1};
  return trace(curve, on_it, window(std::min(last, start.p[1]), std::max(last, start.p[1])),
               hopf_curve_monitors(*curve));
}

const double squared = 0.6, mixed_term = -1.4;

// w_0' = w_1, w_1' = p1 + p2 w_0 + a w_0^2 + b w_0 w_1.
std::shared_ptr<const Problem> bogdanov_takens_system(double b) {
  return turned(2, [b](const Vector& y, In p) -> Vector {
    return Vector{{y[1], p[0] + p[1] * y[0] + squared * y[0] * y[0] + b * y[0] * y[1]}};
  });
}

Event bogdanov_takens_of(const std::shared_ptr<const Problem>& problem) {
  // y_0 = -p2 / 2a at the folds, p1 = p2^2 / 4a.
  const double p2 = -0.5, y = -p2 / (2 * squared) + 0.3;
  const Vector p{{-p2 * y - squared * y * y, p2}};
  const Start start{reflection_of(2) * Vector{{y, 0}}, p, 0, 1};
  const Branch branch = trace(problem, start, window(-1, 1), {fold_monitor()});
  REQUIRE(branch.events.size() == 1);
  const auto curve = folds(problem, 0);
  const Branch points = trace(curve, {with_parameter(branch.events[0].point), p, 1, 1}, window(-0.5, 0.5),
                              fold_curve_monitors(*curve));
  CAPTURE(points.stop.message);
  REQUIRE(points.events.size() == 1);
  CHECK(points.events[0].monitor == "bogdanov_takens");
  return points.events[0];
}

}  // namespace

TEST_CASE("a Bogdanov-Takens point has its two coefficients, and Hopf points leave it as they say") {
  for (const double b : {mixed_term, -mixed_term}) {
    const auto problem = bogdanov_takens_system(b);
    const Event event = bogdanov_takens_of(problem);
    CHECK(std::abs(event.point.parameter) < 1e-8);
    const auto& form = std::get<BogdanovTakens>(event.data);
    // Both change their sign with q_0.
    check_value({std::abs(form.a.value), form.a.error}, squared);
    check_value({std::abs(form.b.value), form.b.error}, std::abs(b));
    CHECK((form.a.value * form.b.value < 0) == (b < 0));
    CHECK(form.criticality == (b < 0 ? Criticality::supercritical : Criticality::subcritical));

    // At the Hopf points y = 0, p1 = 0, omega^2 = -p2.
    const HopfCurveOrigin origin = hopf_curve_at(problem, 0, event, Vector{{0.0, 0.0}}, 1);
    const Branch curve =
        trace(origin.curve, {origin.u, origin.p, origin.free, 1, origin.tangent}, window(-0.5, 0.5));
    CAPTURE(curve.stop.message);
    CHECK(curve.stop.reason == StopReason::boundary);
    REQUIRE(curve.points.size() > 5);
    for (const Point& point : curve.points) {
      CHECK(point.u.head(3).norm() < 1e-7);
      CHECK(std::abs(point.u[3] + point.parameter) < 1e-6);
    }
    CHECK(curve.points.back().parameter == -0.5);
    const Branch rest = trace(
        problem,
        {Vector::Zero(2) + 0.3 * reflection_of(2).col(0), Vector{{0.5 * 0.3 - squared * 0.09, -0.5}}, 0, -1},
        window(-1, 1), hopf_monitors(*problem));
    for (const Event& hopf : rest.events) CHECK(std::get<Hopf>(hopf.data).criticality == form.criticality);
    const Branch other =
        trace(problem, {0.1 * reflection_of(2).col(0), Vector{{0.5 * 0.1 - squared * 0.01, -0.5}}, 0, 1},
              window(-1, 1), hopf_monitors(*problem));
    CHECK(rest.events.size() + other.events.size() >= 1);
    for (const Event& hopf : other.events) CHECK(std::get<Hopf>(hopf.data).criticality == form.criticality);
  }
}

TEST_CASE("a curve of Hopf points asks for a Bogdanov-Takens point and for the parameters of its curve") {
  const auto problem = bogdanov_takens_system(mixed_term);
  Event event = bogdanov_takens_of(problem);
  const Vector p{{0.0, 0.0}};
  CHECK_THROWS_WITH(hopf_curve_at(problem, 0, event, p, 0),
                    Catch::Matchers::Contains("are not those of a curve"));
  CHECK_THROWS_WITH(hopf_curve_at(problem, 0, event, p, 2), Catch::Matchers::Contains("2 with 2 free"));
  CHECK_THROWS_WITH(hopf_curve_at(problem, 0, event, Vector::Zero(3), 1),
                    Catch::Matchers::Contains("3 with 1"));
  CHECK_THROWS_AS(hopf_curve_at(problem, 5, event, p, 1), std::out_of_range);
  CHECK_THROWS_AS(hopf_curve_at(nullptr, 0, event, p, 1), std::invalid_argument);
  event.data = Hopf{};
  CHECK_THROWS_WITH(
      hopf_curve_at(problem, 0, event, p, 1),
      "the event \"bogdanov_takens\" is no Bogdanov-Takens point of a curve of folds of this problem");
}

TEST_CASE("a cusp has the cubic coefficient of its centre manifold") {
  // x' = p1 + p2 x - 0.7 x^3 + 0.5 x v, v' = -v + 0.6 x^2: c = -0.4.
  const auto problem = turned(2, [](const Vector& y, In p) -> Vector {
    return Vector{
        {p[0] + p[1] * y[0] - 0.7 * std::pow(y[0], 3) + 0.5 * y[0] * y[1], -y[1] + 0.6 * y[0] * y[0]}};
  });
  const double x = -1, v = 0.6, p2 = 0.5, p1 = -p2 * x + 0.7 * x * x * x - 0.5 * x * v;
  const Branch branch = trace(problem, {reflection_of(2) * Vector{{x, v}}, Vector{{p1, p2}}, 0, 1},
                              window(-1, 1), {fold_monitor()});
  REQUIRE(branch.events.size() == 2);
  const auto curve = folds(problem, 0);
  const Branch points = trace(curve, {with_parameter(branch.events[0].point), Vector{{p1, p2}}, 1, -1},
                              window(-0.5, 0.6), fold_curve_monitors(*curve));
  const auto cusps = events_named(points, cusp_event);
  REQUIRE(cusps.size() == 1);
  CHECK(std::abs(cusps[0].point.parameter) < 1e-8);
  check_value(std::get<Cusp>(cusps[0].data).cubic, -0.4, 1e-5);
}

TEST_CASE("a generalized Hopf point lies where the cubic term of Bautin's normal form is zero") {
  // Z' = (p1 + 2 i) Z + (p2 + 0.3 i) Z |Z|^2 - Z |Z|^4.
  const auto problem = turned(2, [](const Vector& y, In p) -> Vector {
    const Z z(y[0], y[1]);
    const double square = std::norm(z);
    const Z rate = Z(p[0], 2) * z + Z(p[1], 0.3) * z * square - z * square * square;
    return Vector{{rate.real(), rate.imag()}};
  });
  const Branch curve = hopf_curve_of(problem, {Vector::Zero(2), Vector{{-0.5, -0.4}}, 0, 1}, -0.5, 0.6, 0.5);
  REQUIRE(curve.events.size() == 1);
  CHECK(curve.events[0].monitor == "generalized_hopf");
  CHECK(std::abs(curve.events[0].point.parameter) < 1e-7);
  const auto& form = std::get<GeneralizedHopf>(curve.events[0].data);
  CHECK(std::abs(form.frequency - 2) < 1e-8);
  check_value(form.lyapunov, 0);
  CHECK(std::abs(std::abs(form.detuning.value) - 0.6) < 1e-6);
}

namespace {

// Bautin's normal form Z' = (p1 + 2 i) Z + (p2 + 0.3 i) Z |Z|^2 + (e + 0.4 i) Z |Z|^4 with v' = -1.5 v + Z
// Z*, in coordinates u in which y = Psi(u) is not linear, Psi'(0) = 1, with J by complex steps. |q| = 1 makes
// Z sqrt(2) z.
template <class T>
Eigen::Matrix<T, 3, 1> bautin_in_curved_coordinates(const Eigen::Matrix<T, 3, 1>& u, In p, double e,
                                                    double curved) {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  const T a = u[0], b = u[1], c = u[2];
  const Vector3 y{a + curved * (0.3 * b * b - 0.2 * a * c),
                  b + curved * (0.4 * a * a + 0.25 * a * b * c - 0.1 * c * c),
                  c + curved * (0.2 * a * b + 0.15 * b * b * b)};
  Eigen::Matrix<T, 3, 3> by;
  by << -0.2 * c, 0.6 * b, -0.2 * a, 0.8 * a + 0.25 * b * c, 0.25 * a * c, 0.25 * a * b - 0.2 * c, 0.2 * b,
      0.2 * a + 0.45 * b * b, T(0);
  by = curved * by + Eigen::Matrix<T, 3, 3>::Identity();
  const T square = y[0] * y[0] + y[1] * y[1];
  const T real = p[0] + p[1] * square + e * square * square,
          imaginary = 2.0 + 0.3 * square + 0.4 * square * square;
  const Vector3 f{real * y[0] - imaginary * y[1], imaginary * y[0] + real * y[1], square - 1.5 * y[2]};
  Eigen::Matrix<T, 3, 3> cofactors;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r = (i + 1) % 3, s = (i + 2) % 3, k = (j + 1) % 3, l = (j + 2) % 3;
      cofactors(i, j) = by(r, k) * by(s, l) - by(r, l) * by(s, k);
    }
  const T determinant = by(0, 0) * cofactors(0, 0) + by(0, 1) * cofactors(0, 1) + by(0, 2) * cofactors(0, 2);
  return cofactors.transpose() * f / determinant;
}

std::shared_ptr<const Problem> bautin_problem(double e, double curved, bool exact) {
  const auto residual = [=](In u, In p, Out F) {
    F = bautin_in_curved_coordinates<double>(Eigen::Vector3d(u), p, e, curved);
  };
  const std::vector<Parameter> parameters{parameter("p1", 0), parameter("p2", 0)};
  if (!exact) return from_functions(3, parameters, residual);
  return from_functions(3, parameters, residual, [=](In u, In p, Eigen::Ref<Matrix> J) {
    for (int j = 0; j < 3; ++j) {
      Eigen::Vector3cd x = u.cast<Z>();
      x[j] += Z(0, 1e-100);
      J.col(j) = bautin_in_curved_coordinates<Z>(x, p, e, curved).imag() * 1e100;
    }
  });
}

}  // namespace

TEST_CASE(
    "the second Lyapunov coefficient is that of Bautin's normal form in any coordinates, where J is exact") {
  for (const double e : {-1.0, 0.7, 0.02})
    for (const double curved : {0.0, 1e-6, 1.0}) {
      const auto hopf_points = [&](bool exact) {
        const Branch curve = hopf_curve_of(bautin_problem(e, curved, exact),
                                           {Vector::Zero(3), Vector{{-0.5, -0.4}}, 0, 1}, -0.5, 0.6, 0.5);
        REQUIRE(curve.events.size() == 1);
        return std::get<GeneralizedHopf>(curve.events[0].data);
      };
      const Coefficient l2 = hopf_points(true).second_lyapunov;
      REQUIRE(l2.known());
      CHECK(std::abs(l2.value - 2 * e) < 1e-7);
      CHECK(std::abs(l2.value - 2 * e) <= l2.error);
      CHECK(l2.error < 1e-5);
      CHECK_FALSE(hopf_points(false).second_lyapunov.known());
    }
}

namespace {

struct ZeroHopfNumbers {
  double s = -0.8, g = 0.3, f = -0.5;  // x' = p1 + x^2 + s |Z|^2 + g x^3 + f x |Z|^2 + alpha x v
  double theta = 1.2, turning = 0.4, e = 0.25,
         d = -0.35;  // Z' = (p2 + 2i + (theta + i turning) x + e x^2 + ...) Z
  double m = 0.6, k = -0.9, alpha = 0.7,
         gamma = 1.1;  // v' = -v + m x^2 + k |Z|^2, Z' += d Z |Z|^2 + gamma v Z
};

std::shared_ptr<const Problem> zero_hopf_system(const ZeroHopfNumbers& c) {
  const auto bend = [](const Vector& y) -> Vector {
    const double x = y[0];
    const Z z(y[1], y[2]),
        more = Z(0.2, 0.3) * x * std::conj(z) + Z(0.02, 0.01) * z * z + 0.04 * std::norm(z);
    return Vector{{0.03 * x * y[1] + 0.2 * (z * z).real(), more.real(), more.imag(), 0.05 * x * y[2]}};
  };
  const Rate rate_of = [c](const Vector& y, In p) -> Vector {
    const double x = y[0], v = y[3];
    const Z z(y[1], y[2]);
    const double square = std::norm(z);
    const Z rate = (Z(p[1] + c.theta * x + c.e * x * x + c.d * square + c.gamma * v, 2 + c.turning * x)) * z;
    return Vector{{p[0] + x * x + c.s * square + c.g * x * x * x + c.f * x * square + c.alpha * x * v,
                   rate.real(), rate.imag(), -v + c.m * x * x + c.k * square}};
  };
  return turned_and_bent(4, rate_of, bend);
}

void check_zero_hopf(const ZeroHopf& form, const ZeroHopfNumbers& c) {
  CHECK(std::abs(form.frequency - 2) < 1e-7);
  const double side = form.g200.value > 0 ? 1 : -1;  // of q_0
  check_value(form.g200, side * 2);
  check_value(form.g011, side * 2 * c.s);
  check_value(form.g110_real, side * c.theta);
  check_value(form.g110_imaginary, side * c.turning);
  check_value(form.g300, 6 * (c.g + c.alpha * c.m), 1e-5);
  check_value(form.g111, 2 * (c.f + c.alpha * c.k), 1e-5);
  check_value(form.g210_real, 2 * (c.e + c.gamma * c.m), 1e-5);
  check_value(form.g210_imaginary, 0, 1e-5);
  check_value(form.g021_real, 4 * (c.d + c.gamma * c.k), 1e-5);
  check_value(form.g021_imaginary, 0, 1e-5);
}

}  // namespace

TEST_CASE(
    "a zero-Hopf point is found on its curve of Hopf points and on that of folds, with its coefficients") {
  const ZeroHopfNumbers c;
  const auto problem = zero_hopf_system(c);
  const Matrix Q = reflection_of(4);
  // The branch through x = -0.5 at p2 = 0.2: a Hopf point, then the fold.
  const double x = -0.5, v = c.m * x * x, p1 = -(x * x + c.g * x * x * x + c.alpha * x * v);
  const Start start{Q * Vector{{x, 0, 0, v}}, Vector{{p1, 0.2}}, 0, 1};
  const Branch curve = hopf_curve_of(problem, start, -1, 0.5, -0.3);
  const auto found = events_named(curve, "zero_hopf");
  CAPTURE(curve.stop.message);
  REQUIRE(found.size() == 1);
  CHECK(curve.events.size() == 1);  // l1 has a pole there, and no zero
  CHECK(std::abs(found[0].point.parameter) < 1e-7);
  check_zero_hopf(std::get<ZeroHopf>(found[0].data), c);

  const Branch branch = trace(problem, start, window(-1, 0.5), {fold_monitor()});
  REQUIRE(!branch.events.empty());
  const auto fold_curve = folds(problem, 0);
  const Branch of_folds = trace(fold_curve, {with_parameter(branch.events[0].point), start.p, 1, -1},
                                window(-0.3, 0.5), fold_curve_monitors(*fold_curve));
  const auto on_folds = events_named(of_folds, "zero_hopf");
  REQUIRE(on_folds.size() == 1);
  CHECK(std::abs(on_folds[0].point.parameter) < 1e-7);
  check_zero_hopf(std::get<ZeroHopf>(on_folds[0].data), c);
}

TEST_CASE("a double Hopf point is found on its curve, with its coefficients") {
  const double a = -0.5, b = 0.8, c = -1.1, d = -0.4, k1 = 0.6, k2 = -0.3, act1 = 0.9, act2 = -0.7;
  const auto bend = [](const Vector& y) -> Vector {
    const Z z1(y[0], y[1]), z2(y[2], y[3]),
        m1 = Z(0.1, 0.2) * z2 * z2 + Z(0.2, -0.1) * z1 * std::conj(z2) + 0.1 * z1 * z1,
        m2 = Z(0.2, 0.3) * z1 * std::conj(z2) + Z(0.1, 0.2) * z1 * z1 + Z(0.1, -0.2) * z1 * z2 +
             Z(0.1, 0.3) * std::norm(z1);
    return Vector{{m1.real(), m1.imag(), m2.real(), m2.imag(), 0.03 * (z1 * z2).real()}};
  };
  const Rate rate = [=](const Vector& y, In p) -> Vector {
    const Z z1(y[0], y[1]), z2(y[2], y[3]);
    const double n1 = std::norm(z1), n2 = std::norm(z2), v = y[4];
    const Z r1 = Z(p[0] + a * n1 + b * n2 + act1 * v, 1) * z1,
            r2 = Z(p[1] + c * n1 + d * n2 + act2 * v, std::sqrt(7.0)) * z2;
    return Vector{{r1.real(), r1.imag(), r2.real(), r2.imag(), -v + k1 * n1 + k2 * n2}};
  };
  const auto problem = turned_and_bent(5, rate, bend);
  const Branch curve = hopf_curve_of(problem, {Vector::Zero(5), Vector{{-0.5, -0.4}}, 0, 1}, -0.5, 0.6, 0.45);
  CAPTURE(curve.stop.message);
  REQUIRE(curve.events.size() == 1);
  CHECK(curve.events[0].monitor == "double_hopf");
  CHECK(std::abs(curve.events[0].point.parameter) < 1e-7);
  const auto& form = std::get<DoubleHopf>(curve.events[0].data);
  CHECK(std::abs(form.frequency - 1) < 1e-7);
  CHECK(std::abs(form.other_frequency - std::sqrt(7.0)) < 1e-7);
  check_value(form.g2100, 4 * (a + act1 * k1), 1e-5);
  check_value(form.g1011, 2 * (b + act1 * k2), 1e-5);
  check_value(form.g1110, 2 * (c + act2 * k1), 1e-5);
  check_value(form.g0021, 4 * (d + act2 * k2), 1e-5);
}

TEST_CASE("monitors of codimension 2 are for curves of special points, of up to 500 unknowns") {
  const auto problem = bogdanov_takens_system(mixed_term);
  const auto curve = hopf_points(problem, 0, 1);
  const Branch branch = trace(problem, {Vector{{0.3, 0.0}}, Vector{{-0.1, -0.5}}, 0, 1}, window(-1, 1),
                              {hopf_curve_monitors(*curve)[1]});
  CHECK(branch.stop.reason == StopReason::monitor_failed);
  CHECK_THAT(branch.stop.message, Catch::Matchers::Contains("for curves of folds and of Hopf points"));
  const auto large = [](int n) {
    return from_functions(
        n, {parameter("p", 0), parameter("q", 0)}, [](In u, In p, Out F) { F = u * p[0]; },
        [=](In, In p, Eigen::Ref<Matrix> J) { J = p[0] * Matrix::Identity(n, n); });
  };
  CHECK_THROWS_WITH(fold_curve_monitors(*folds(large(501), 0)),
                    Catch::Matchers::Contains("at most 500 unknowns, not 501"));
  CHECK(fold_curve_monitors(*folds(large(500), 0)).size() == 501);
}

TEST_CASE("points of codimension 2 survive saving") {
  State state;
  Event event;
  event.data = ZeroHopf{.frequency = 2, .g200 = {1, 0.5}};
  state.branch.events.push_back(event);
  event.data = DoubleHopf{.frequency = 2, .other_frequency = 3, .g1110 = {4, 0.25}};
  state.branch.events.push_back(event);
  event.data = BogdanovTakens{{1, 2}, {3, 4}, Criticality::subcritical};
  state.branch.events.push_back(event);
  event.data = GeneralizedHopf{1, {2, 3}, {4, 5}, {6, 7}};
  state.branch.events.push_back(event);
  event.data = Cusp{{6, 7}};
  state.branch.events.push_back(event);
  const State kept = state_from_json(to_json(state));
  CHECK(std::get<ZeroHopf>(kept.branch.events[0].data).g200.error == 0.5);
  CHECK(!std::get<ZeroHopf>(kept.branch.events[0].data).g021_real.known());
  CHECK(std::get<DoubleHopf>(kept.branch.events[1].data).g1110.value == 4);
  CHECK(std::get<DoubleHopf>(kept.branch.events[1].data).other_frequency == 3);
  CHECK(std::get<BogdanovTakens>(kept.branch.events[2].data).b.value == 3);
  CHECK(std::get<BogdanovTakens>(kept.branch.events[2].data).criticality == Criticality::subcritical);
  CHECK(std::get<GeneralizedHopf>(kept.branch.events[3].data).detuning.error == 5);
  CHECK(std::get<GeneralizedHopf>(kept.branch.events[3].data).second_lyapunov.value == 6);
  CHECK(std::get<Cusp>(kept.branch.events[4].data).cubic.error == 7);
}
