#include "catch.hpp"

#include "continuation/problems.hpp"

using namespace problems;

TEST_CASE("the folds of mu + x - x^3 are found at mu = +-2/3^(3/2), in both directions") {
  const double fold = 0.3849001794597505;
  for (int direction : {1, -1}) {
    Vector u(1), p(2);
    u << (direction > 0 ? -1.3 : 1.3);
    p << -direction * 1.0, 1;
    const Branch branch = trace(cusp(), {u, p, 0, direction}, window(-1, 1), {fold_monitor()});
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == direction);
    REQUIRE(branch.events.size() == 2);
    CHECK(std::abs(branch.events[0].point.parameter - direction * fold) < 1e-14);
    CHECK(std::abs(branch.events[1].point.parameter + direction * fold) < 1e-14);
    CHECK(std::abs(branch.events[0].point.u[0] + direction * std::sqrt(1.0 / 3)) < 1e-9);
    CHECK_FALSE(branch.events[0].nonsmooth);
    CHECK(branch.events[0].point.arclength < branch.events[1].point.arclength);
  }
}

TEST_CASE("the folds of Freudenstein and Roth in x3 are those of PITCON") {
  Vector u(2), p(1);
  u << 15, -2;
  p << 0;
  const Branch branch = trace(freudenstein_roth(), {u, p, 0, 1}, window(-1, 1.5), {fold_monitor()});
  REQUIRE(branch.events.size() == 2);
  CHECK(branch.events[0].point.parameter == Approx(0.5875873).margin(1e-7));
  CHECK(branch.events[0].point.u[0] == Approx(20.48586).margin(1e-5));
  CHECK(branch.events[0].point.u[1] == Approx(-0.8968053).margin(1e-7));
  CHECK(branch.events[1].point.parameter == Approx(-0.6863528).margin(1e-7));
  CHECK(branch.events[1].point.u[0] == Approx(61.02031).margin(1e-5));
  CHECK(branch.events[1].point.u[1] == Approx(2.230139).margin(1e-6));
}

TEST_CASE("the folds of Chan's problem with 100 nodes are those of LOCA") {
  const Branch branch =
      trace(chan(100), {Vector::Zero(100), Vector::Zero(1), 0, 1}, window(0, 5), {fold_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 2);
  CHECK(std::abs(branch.events[0].point.parameter - 4.06755724) < 1e-8);
  CHECK(std::abs(branch.events[1].point.parameter - 3.16019522) < 1e-8);
  CHECK(branch.points.back().parameter == 5);
  CHECK(std::abs(branch.points.back().u.norm() - 203.1991024) < 1e-7);
}

TEST_CASE("a smooth branch costs less than 3.5 factorizations a point") {
  for (const auto& [problem, start, p, w] :
       {std::tuple{chan(100), Vector(Vector::Zero(100)), Vector(Vector::Zero(1)), window(0, 5)},
        std::tuple{freudenstein_roth(), Vector{{15.0, -2.0}}, Vector(Vector::Zero(1)), window(-1, 1.5)}}) {
    const Branch branch = trace(problem, {start, p, 0, 1}, w, {fold_monitor()});
    CHECK(static_cast<double>(branch.counts.factorizations) <
          3.5 * static_cast<double>(branch.counts.points));
  }
}

TEST_CASE("unknowns and parameter in units 1e12 larger or smaller make the same branch") {
  const auto fold_of = [](double in_u, double in_p) {
    const auto problem = from_functions(
        1, {parameter("mu", 0, in_p)},
        [=](In u, In p, Out F) { F[0] = p[0] / in_p + u[0] / in_u - std::pow(u[0] / in_u, 3); }, {}, {},
        Vector::Constant(1, in_u));
    const Branch branch = trace(problem, {Vector::Constant(1, -1.3 * in_u), Vector::Constant(1, -in_p), 0, 1},
                                window(-in_p, in_p), {fold_monitor()});
    CAPTURE(in_u, in_p, branch.stop.message, branch.points.size());
    REQUIRE(branch.events.size() == 2);
    return std::pair{branch.events[0].point.parameter / in_p, branch.points.size()};
  };
  const auto [fold, points] = fold_of(1, 1);
  for (double in_u : {1e-12, 1.0, 1e12})
    for (double in_p : {1e-12, 1.0, 1e12}) {
      const auto [other, count] = fold_of(in_u, in_p);
      CHECK(std::abs(other - fold) < 1e-12);
      CHECK(std::abs(static_cast<double>(count) - static_cast<double>(points)) <= 2);
    }
}

TEST_CASE("a fold comes with its null vectors, and with the curvature d2mu/dx2 = 6x of mu = x^3 - x") {
  const Branch branch =
      trace(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1), {fold_monitor()});
  REQUIRE(branch.events.size() == 2);
  for (const Event& event : branch.events) {
    const Fold& fold = std::get<Fold>(event.data);
    CHECK(std::abs(fold.curvature - 6 * event.point.u[0]) < 1e-8);
    CHECK(std::abs(std::abs(fold.right_null[0]) - 1) < 1e-12);
    CHECK(std::abs(std::abs(fold.left_null[0]) - 1) < 1e-12);
  }
}

TEST_CASE("the null vectors at the folds of Chan's problem are those of J, from both sides") {
  const Branch branch =
      trace(chan(100), {Vector::Zero(100), Vector::Zero(1), 0, 1}, window(0, 5), {fold_monitor()});
  REQUIRE(branch.events.size() == 2);
  const auto at = chan(100)->evaluator();
  for (const Event& event : branch.events) {
    const Fold& fold = std::get<Fold>(event.data);
    at->move_to(event.point.u, Vector::Constant(1, event.point.parameter), Needs::jacobian);
    const auto& J = std::get<Matrix>(at->jacobian());
    CHECK((J * fold.right_null).norm() < 1e-9);
    CHECK((J.transpose() * fold.left_null).norm() < 1e-9);
  }
  CHECK(std::get<Fold>(branch.events[0].data).curvature < 0);
  CHECK(std::get<Fold>(branch.events[1].data).curvature > 0);
}

TEST_CASE("the curvature of a fold does not depend on an unknown of a large unit that takes no part in it") {
  for (double size : {1.0, 1e3, 1e6, 1e9}) {
    Functions f;
    f.size = 2;
    f.parameters = {parameter("p", 0)};
    f.scales = Vector{{size, 1.0}};
    f.residual = [=](In u, In p, Out F) {
      F[0] = u[0] / size - 1;
      F[1] = p[0] - 1 + std::cos(u[1]);
    };
    const Start start{Vector{{size, -0.5}}, Vector{{1 - std::cos(0.5)}}, 0, -1};
    const Branch branch = trace(from_functions(f), start, window(-1, 0.5), {fold_monitor()});
    CAPTURE(size, branch.stop.message);
    REQUIRE(branch.events.size() == 1);
    CHECK(std::abs(std::get<Fold>(branch.events[0].data).curvature - 1) < 1e-5);
  }
}

TEST_CASE("the curvature of a fold next to a kink, or between two, is that of its own piece") {
  // p = u^2 + s max(0, u - a) + s max(0, b - u), b < 0 < a: p'' = 2 at the fold u = 0.
  const double s = 0.05, far = 1e3;
  for (const bool second_given : {false, true})
    for (const double d : {1e-4, 5e-6, 1e-7})
      for (const auto& [a, b] : {std::pair{d, -far}, std::pair{far, -d}, std::pair{d, -d}}) {
        Functions f;
        f.size = 1;
        f.parameters = {parameter("p", 0)};
        f.residual = [=](In u, In p, Out F) {
          F[0] = p[0] - u[0] * u[0] - s * std::max(0.0, u[0] - a) - s * std::max(0.0, b - u[0]);
        };
        f.jacobian = [=](In u, In, Eigen::Ref<Matrix> J) {
          J(0, 0) = -2 * u[0] - (u[0] > a ? s : 0) + (u[0] < b ? s : 0);
        };
        f.derivative = [](In, In, int, Out dF) { dF[0] = 1; };
        f.piece = [=](In u, In) { return u[0] > a ? 3 : u[0] < b ? 1 : 2; };
        if (second_given)
          f.second = [](In, In, In w, In v, In, Out du, Out dp) {
            du[0] = -2 * w[0] * v[0];
            dp[0] = 0;
          };
        const double u = -0.91, p = u * u + s * std::max(0.0, b - u);
        const Branch branch =
            trace(from_functions(f), {Vector{{u}}, Vector{{p}}, 0, -1}, window(-1, 1.5), {fold_monitor()});
        CAPTURE(a, b, second_given, branch.stop.message);
        const auto found = events_named(branch, "fold");
        REQUIRE(found.size() == 1);
        REQUIRE(std::holds_alternative<Fold>(found[0].data));
        CHECK(std::abs(found[0].point.u[0]) < 1e-9);
        CHECK(std::abs(std::get<Fold>(found[0].data).curvature - 2) < (second_given ? 1e-12 : 1e-7));
      }
}
