// Choices of a piecewise smooth F, and problems made of functions that make them.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/problem/choices.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace problems;

TEST_CASE("choices have the values of max, min, abs, limits and switches, everywhere and at the corners") {
  Choices choose;
  for (int k = -8; k <= 8; ++k) {
    const double x = 0.25 * k;
    CHECK(choose.max(x, 0.5) == std::max(x, 0.5));
    CHECK(choose.min(x, 0.5) == std::min(x, 0.5));
    CHECK(choose.abs(x) == std::abs(x));
    CHECK(choose.positive(x) == std::max(x, 0.0));
    CHECK(choose.clamp(x, -1, 0.5) == std::clamp(x, -1.0, 0.5));
    CHECK(choose.above(x) == (x >= 0));
    CHECK(choose.above(x, 0.5) == (x >= 0.5));
    CHECK(choose.part(x, {-1, 0, 1.5}) == std::size_t(x < -1 ? 0 : x < 0 ? 1 : x < 1.5 ? 2 : 3));
  }
}

TEST_CASE("choices that are kept continue each function of a piece beyond its end") {
  Choices choose;
  const auto all = [&](double x) {
    return std::array{choose.max(x, 1),   choose.min(x, 1),      choose.abs(x),
                      choose.positive(x), choose.clamp(x, 0, 1), choose.above(x) ? 5.0 : 7.0};
  };
  const auto continued = [&](double from, double to) {
    choose.anew();
    all(from);
    choose.keep();
    return all(to);
  };
  CHECK(continued(2, -3) == std::array{-3.0, 1.0, -3.0, -3.0, 1.0, 5.0});
  CHECK(continued(-3, 2) == std::array{1.0, 2.0, -2.0, 0.0, 0.0, 7.0});
  CHECK(continued(0.5, 9) == std::array{1.0, 9.0, 9.0, 9.0, 9.0, 5.0});
}

TEST_CASE("pieces are the same for the same choices alone, also of hundreds of contacts") {
  const int n = 500;
  Choices choose;
  const auto piece = [&](int changed) {
    choose.anew();
    for (int i = 0; i < n; ++i) choose.positive(i == changed ? -1 : 1);
    return choose.piece();
  };
  std::vector<std::uint64_t> pieces;
  for (int i = -1; i < n; ++i) pieces.push_back(piece(i));
  CHECK(piece(3) == pieces[4]);
  std::sort(pieces.begin(), pieces.end());
  CHECK(std::adjacent_find(pieces.begin(), pieces.end()) == pieces.end());
}

TEST_CASE("each choice says which way it went") {
  Choices choose;
  choose.anew();
  choose.max(1, 2);
  choose.abs(3);
  choose.clamp(9, 0, 1);
  choose.clamp(-9, 0, 1);
  choose.part(2.5, {1, 2, 3});
  REQUIRE(choose.size() == 5);
  CHECK(choose[0] == 1);
  CHECK(choose[1] == 0);
  CHECK(choose[2] == 2);
  CHECK(choose[3] == 1);
  CHECK(choose[4] == 2);
  choose.keep();
  CHECK(choose.max(2, 1) == 1);
  CHECK(choose.size() == 5);
  choose.anew();
  CHECK(choose.size() == 0);
}

TEST_CASE("differences with choices are those of the piece at any distance from the corner, to 1e-9") {
  // Of e^x - 1 below x = u + p = 0, and 3 sin x above.
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", 0)};
  f.choosing.residual = [](In u, In p, Choices& choose, Out F) {
    const double x = u[0] + p[0];
    F[0] = choose.above(x) ? 3 * std::sin(x) : std::exp(x) - 1;
  };
  const auto at = from_functions(f)->evaluator();
  Vector dF(1);
  for (const int side : {1, -1})
    for (const double distance : {0.0, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
      const double x = side * distance;
      REQUIRE(at->move_to(Vector{{x - 2}}, Vector{{2.0}}, Needs::jacobian) == Evaluated::ok);
      const double known = x - 2 + 2 >= 0 ? 3 * std::cos(x) : std::exp(x);
      CAPTURE(side, distance);
      CHECK(std::abs(std::get<Matrix>(at->jacobian())(0, 0) - known) < 1e-9 * known);
      at->parameter_derivative(0, dF);
      CHECK(std::abs(dF[0] - known) < 1e-9 * known);
    }
}

TEST_CASE("derivatives are handed the choices of the residual at their point") {
  for (const bool sparse : {false, true}) {
    Functions f;
    f.size = 1;
    f.parameters = {parameter("p", 0)};
    f.choosing.residual = [](In u, In p, Choices& choose, Out F) {
      F[0] = choose.abs(u[0]) + 2 * choose.max(p[0], 0);
    };
    if (sparse)
      f.choosing.sparse_jacobian = [](In u, In, Choices& made, SparseMatrix& J) {
        J.coeffRef(0, 0) = made.abs(u[0]) < 0 ? 99 : made[0] == 0 ? 1 : -1;
      };
    else
      f.choosing.jacobian = [](In, In, Choices& made, Eigen::Ref<Matrix> J) {
        J(0, 0) = made[0] == 0 ? 1 : -1;
      };
    f.choosing.derivative = [](In, In, Choices& made, int, Out dF) { dF[0] = made[1] == 0 ? 2 : 0; };
    const auto at = from_functions(f)->evaluator();
    for (const double u : {-2.0, 0.0, 1.0})
      for (const double p : {-1.0, 0.0, 1.0}) {
        REQUIRE(at->move_to(Vector{{u}}, Vector{{p}}, Needs::jacobian) == Evaluated::ok);
        Vector y(1);
        apply(at->jacobian(), Vector{{1.0}}, y);
        CHECK(y[0] == (u < 0 ? -1 : 1));
        at->parameter_derivative(0, y);
        CHECK(y[0] == (p < 0 ? 0 : 2));
      }
  }
}

TEST_CASE("a piece that ends where the domain does, beyond its corner, has one-sided differences") {
  // sqrt(max(0, 1 - u)): continued beyond u = 1 there is no root.
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", 0)};
  f.choosing.residual = [](In u, In p, Choices& choose, Out F) {
    F[0] = u[0] + std::pow(choose.positive(1 - u[0]), 2.5) - p[0];
  };
  const auto at = from_functions(f)->evaluator();
  for (const double distance : {0.0, 1e-12, 1e-7}) {
    REQUIRE(at->move_to(Vector{{1 - distance}}, Vector{{0.0}}, Needs::jacobian) == Evaluated::ok);
    CHECK(std::abs(std::get<Matrix>(at->jacobian())(0, 0) - 1) < 1e-7);
  }
}

TEST_CASE("a limited force meets a stop: both kinks are those of the closed form, with their slopes") {
  // x + stop max(0, x - 1) = f, f = clamp(gain (p - x), -2, 2).
  const double stop = 4;
  for (const double gain : {4.0, 0.5, 40.0})
    for (const double from : {0.0, 0.1}) {
      Functions f;
      f.size = 2;
      f.parameters = {{"p", "", 0}};
      f.choosing.residual = [=](In u, In p, Choices& choose, Out F) {
        F[0] = u[0] + stop * choose.positive(u[0] - 1) - u[1];
        F[1] = u[1] - choose.clamp(gain * (p[0] - u[0]), -2, 2);
      };
      const double at_stop = 1 + 1 / gain, at_limit = 1.2 + 2 / gain;
      const Branch branch = trace(from_functions(f), {.u = Vector{{0.0, 0.0}}, .p = Vector{{from}}},
                                  {.lower = 0, .upper = at_limit + 1}, {kink_monitor()});
      CAPTURE(gain, from, branch.stop.message);
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(branch.warnings.empty());
      REQUIRE(branch.events.size() == 2);
      CHECK(std::abs(branch.events[0].point.parameter - at_stop) < 1e-9 * at_stop);
      CHECK(std::abs(branch.events[1].point.parameter - at_limit) < 1e-9 * at_limit);
      const Kink& first = std::get<Kink>(branch.events[0].data);
      const Kink& second = std::get<Kink>(branch.events[1].data);
      CHECK(first.before[0] / first.before[2] == Approx(gain / (1 + gain)).epsilon(1e-8));
      CHECK(first.after[0] / first.after[2] == Approx(gain / (5 + gain)).epsilon(1e-8));
      CHECK(second.before[0] / second.before[2] == Approx(gain / (5 + gain)).epsilon(1e-8));
      CHECK(std::abs(second.after[0] / second.after[2]) < 1e-9);
    }
}

TEST_CASE("functions with choices and without that contradict each other are refused") {
  const auto choosing = [](In u, In, Choices& choose, Out F) { F[0] = choose.abs(u[0]); };
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", 0)};
  f.choosing.residual = choosing;
  Functions two = f, pieces = f, jacobians = f, derivatives = f, without = f;
  two.residual = [](In u, In, Out F) { F = u; };
  CHECK_THROWS_WITH(from_functions(two), "a problem has one residual function: with choices or without");
  pieces.piece = [](In, In) { return 0; };
  CHECK_THROWS_WITH(from_functions(pieces),
                    "a residual with choices has its pieces by them: no `piece` besides");
  jacobians.jacobian = [](In, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1; };
  CHECK_NOTHROW(from_functions(jacobians));
  jacobians.choosing.jacobian = [](In, In, Choices&, Eigen::Ref<Matrix> J) { J(0, 0) = 1; };
  CHECK_THROWS_WITH(from_functions(jacobians),
                    "a problem has at most one Jacobian: dense, sparse or matrix-free");
  derivatives.derivative = [](In, In, int, Out dF) { dF[0] = -1; };
  derivatives.choosing.derivative = [](In, In, Choices&, int, Out dF) { dF[0] = -1; };
  CHECK_THROWS_WITH(from_functions(derivatives), "a problem has at most one dF/dp: with choices or without");
  without.choosing.residual = {};
  without.residual = [](In u, In, Out F) { F = u; };
  without.choosing.derivative = derivatives.choosing.derivative;
  CHECK_THROWS_WITH(from_functions(without), "derivatives with choices require a residual that makes them");
}
