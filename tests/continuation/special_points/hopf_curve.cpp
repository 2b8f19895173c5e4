#include "catch.hpp"

#include "continuation/events/hopf_problems.hpp"

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/special_points/hopf_curve.hpp>

using namespace problems;

namespace {

// The Hopf points of the branch from u at p, in the order of arclength.
std::vector<Event> hopfs(const std::shared_ptr<const Problem>& problem, const Vector& u, const Vector& p,
                         int along, double upper) {
  return trace(problem, {u, p, along, 1}, window(p[along], upper), hopf_monitors(*problem)).events;
}

Branch curve_of(const std::shared_ptr<const Problem>& problem, const Event& event, const Vector& p, int along,
                int free, int direction, const Options& options) {
  return trace(hopf_points(problem, along, std::get<Hopf>(event.data).frequency),
               {with_frequency(event), p, free, direction}, options, {zero_frequency_monitor()});
}

}  // namespace

TEST_CASE("the Brusselator's Hopf points lie on B = 1 + A^2, omega = A") {
  const Vector p{{1.0, 0.5}};
  const auto found = hopfs(brusselator(), Vector{{1.0, 0.5}}, p, 1, 3);
  REQUIRE(found.size() == 1);
  for (int direction : {-1, 1}) {
    const Branch curve = curve_of(brusselator(), found[0], p, 1, 0, direction, window(0.1, 3));
    REQUIRE(curve.stop.reason == StopReason::boundary);
    CHECK(curve.events.empty());
    for (const Point& point : curve.points) {
      const double A = point.parameter;
      CHECK(std::abs(point.u[0] - A) < 1e-11);
      CHECK(std::abs(point.u[2] - (1 + A * A)) < 1e-11);
      CHECK(std::abs(point.u[3] - A * A) < 1e-11);
    }
  }
}

TEST_CASE("each mode of the Brusselator along a line has its own curve of Hopf points") {
  const Line line;
  const Vector p{{4.0, 2.0}};
  const auto found = hopfs(line.problem(), line.homogeneous(2, 4), p, 0, line.B(4, 2) + 0.01);
  REQUIRE(found.size() == 4);
  for (int k : {1, 3, 4}) {
    const Branch curve =
        curve_of(line.problem(), found[static_cast<std::size_t>(k - 1)], p, 0, 1, 1, window(2, 4));
    CAPTURE(k);
    REQUIRE(curve.stop.reason == StopReason::boundary);
    for (const Point& point : curve.points) {
      const double A = point.parameter, omega = line.frequency(k, A);
      CHECK(std::abs(point.u[2 * line.nodes] - line.B(k, A)) < 1e-10);
      CHECK(std::abs(point.u[2 * line.nodes + 1] - omega * omega) < 1e-9);
    }
  }
}

TEST_CASE("the Hopf points of the Lorenz equations lie on r = s (s + b + 3) / (s - b - 1)") {
  const double b = 8.0 / 3, x = std::sqrt(b);
  const Vector p{{2.0, 10.0, b}};
  const auto found = hopfs(lorenz(), Vector{{x, x, 1.0}}, p, 0, 30);
  REQUIRE(found.size() == 1);
  for (int direction : {-1, 1}) {
    Options options = window(4.5, 40);
    const Branch curve = curve_of(lorenz(), found[0], p, 0, 1, direction, options);
    REQUIRE(curve.stop.reason == StopReason::boundary);
    REQUIRE(curve.points.size() > 10);
    for (const Point& point : curve.points) {
      const double s = point.parameter, r = s * (s + b + 3) / (s - b - 1);
      CHECK(std::abs(point.u[3] / r - 1) < 1e-11);
      CHECK(std::abs(point.u[4] / (b * (s + r)) - 1) < 1e-11);
    }
  }
}

TEST_CASE("the ab problem's curve of Hopf points goes through a Bogdanov-Takens point to neutral saddles") {
  const Vector p{{0.0, 14.0, 2.0}};
  const auto found = hopfs(ab(), Vector::Zero(2), p, 0, 0.2);
  REQUIRE(found.size() == 1);
  const Branch curve = curve_of(ab(), found[0], p, 0, 2, 1, window(2, 20));
  REQUIRE(curve.stop.reason == StopReason::boundary);
  const auto points = events_named(curve, "bogdanov_takens");
  REQUIRE(points.size() == 1);
  CHECK(std::abs(points[0].point.u[2] - 0.10954326764) < 1e-11);
  CHECK(std::abs(points[0].point.parameter - 2.07318490371) < 1e-11);
  // Back at p3 = 2, at the neutral saddle.
  const Point& last = curve.points.back();
  CHECK(last.parameter == Approx(2).margin(1e-12));
  CHECK(last.u[3] < 0);
  CHECK(std::abs(last.u[2] - 0.1057105012) < 5e-11);
}

TEST_CASE(
    "the Jacobian of a problem of Hopf points is its derivative, also where the pair is real or no Hopf "
    "pair") {
  const auto problem = hopf_points(ab(), 0, 1);
  for (const Vector& x :
       {Vector{{0.3, 1.1, 0.12, 2.0}}, Vector{{0.1, 0.3, 0.05, -1.0}}, Vector{{0.6, 2.2, 0.13, 0.5}}}) {
    const JacobianError check = check_jacobian(*problem, x, Vector{{0.0, 14.0, 2.0}});
    CHECK(check.message == "");
  }
  const Vector p{{1.1, 0.0}};  // with second derivatives given
  CHECK(check_jacobian(*hopf_points(brusselator(), 1, 1), Vector{{0.9, 1.2, 1.7, 1.1}}, p).message == "");
  const Line line;
  Vector x(2 * line.nodes + 2);
  x << line.homogeneous(2, 5) + 0.05 * Vector::Random(2 * line.nodes), 5.1, 3.9;
  CHECK(check_jacobian(*hopf_points(line.problem(), 0, 2), x, Vector{{0.0, 2.0}}).message == "");
}

TEST_CASE("curves of Hopf points refuse what they cannot follow, and say why") {
  REQUIRE_THROWS_AS(hopf_points(ab(), 3, 1), std::out_of_range);
  REQUIRE_THROWS_AS(hopf_points(ab(), -1, 1), std::out_of_range);
  REQUIRE_THROWS_AS(hopf_points(ab(), 0, 0), std::invalid_argument);
  REQUIRE_THROWS_AS(hopf_points(cusp(), 0, 1), std::invalid_argument);
  Event fold;
  fold.data = Fold{};
  REQUIRE_THROWS_AS(with_frequency(fold), std::invalid_argument);
}
