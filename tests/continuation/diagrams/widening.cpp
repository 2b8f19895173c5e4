// Problems that widen: F(u, p) = u^3 + u - p in u alone, and G in further unknowns v with D(u) v + ... = 0.
#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/diagrams/agenda.hpp>
#include <arcslip/continuation/diagrams/widening.hpp>

#include <functional>
#include <limits>

using namespace problems;

namespace {

// u at p = u^3 + u.
std::shared_ptr<const Problem> narrow() {
  return from_functions(1, {parameter("p", 0)},
                        [](In u, In p, Out F) { F[0] = u[0] * u[0] * u[0] + u[0] - p[0]; });
}

// (u, v) with G = (F, D(u) v + |v|^2 v).
using BlockOf = std::function<Matrix(double u)>;
Functions widened(const BlockOf& D, int added) {
  return {.size = 1 + added, .parameters = {parameter("p", 0)}, .residual = [D](In u, In p, Out G) {
            const auto v = u.tail(u.size() - 1);
            G[0] = u[0] * u[0] * u[0] + u[0] - p[0];
            G.tail(v.size()) = D(u[0]) * v + v.squaredNorm() * v;
          }};
}

Widening widening(const std::shared_ptr<const Problem>& wide) {
  Widening of;
  of.narrow = narrow();
  of.wide = wide;
  of.embed = [](In u, Vector& all) {
    all.setZero();
    all[0] = u[0];
  };
  for (int i = 1; i < wide->size(); ++i) of.added.push_back(i);
  return of;
}

// (u, p) of the branch of F, in steps of u.
std::vector<Vector> branch(double from, double to, int steps) {
  std::vector<Vector> all;
  for (int i = 0; i <= steps; ++i) {
    const double u = from + (to - from) * i / steps;
    all.push_back(Vector{{u, u * u * u + u}});
  }
  return all;
}

Matrix one_null_vector(double u) {
  return Matrix{{1, u}, {1, 1}};
}

NotWidened reason(const BlockOf& D, int added) {
  WiderBranchPoints points(widening(from_functions(widened(D, added))));
  return std::get<NotWidened>(points.locate(branch(0.13, 1.83, 10), 4));
}

}  // namespace

TEST_CASE(
    "a branch of more unknowns leaves where the determinant of their block is zero, along its null vector") {
  // det D = 1 - u and D (1, -1) = 0 at u = 1, p = 2.
  Functions sparse = widened(one_null_vector, 2);
  sparse.sparse_jacobian = [](In u, In, SparseMatrix& J) {
    const double v1 = u[1], v2 = u[2], square = v1 * v1 + v2 * v2;
    Matrix all{{3 * u[0] * u[0] + 1, 0, 0},
               {v2, 1 + square + 2 * v1 * v1, u[0] + 2 * v1 * v2},
               {0, 1 + 2 * v1 * v2, 1 + square + 2 * v2 * v2}};
    J = all.sparseView();
    J.makeCompressed();
  };
  for (const auto& wide : {from_functions(widened(one_null_vector, 2)), from_functions(sparse)})
    for (const std::size_t after : {1, 4, 5, 8}) {  // of an event that is next to it
      WiderBranchPoints points(widening(wide));
      const auto found = points.locate(branch(0.13, 1.83, 10), after);
      REQUIRE(std::holds_alternative<Junction>(found));
      const Junction& junction = std::get<Junction>(found);
      CHECK(junction.problem == wide);
      CHECK(std::abs(junction.parameter - 2) < 1e-9);  // of the Jacobian's differences
      CHECK((junction.u - Vector{{1.0, 0.0, 0.0}}).norm() < 1e-9);
      CHECK(junction.images);
      REQUIRE(junction.half_branches.size() == 1);
      const Vector& t = junction.half_branches[0].direction;
      CHECK((t * (t[1] > 0 ? 1 : -1) - Vector{{0, std::sqrt(0.5), -std::sqrt(0.5), 0}}).norm() < 1e-8);
      CHECK(std::get<NotWidened>(points.locate(branch(0.13, 1.83, 10), after)) == NotWidened::no_crossing);
    }
}

TEST_CASE(
    "no branch of more unknowns leaves where their block stays regular, loses ranks at once, or jumps") {
  CHECK(reason([](double u) { return Matrix{{u + 1}}; }, 1) == NotWidened::no_crossing);
  CHECK(reason([](double u) { return Matrix{(u - 1) * Matrix::Identity(2, 2)}; }, 2) ==
        NotWidened::no_crossing);  // an even number, without a change of sign
  CHECK(reason([](double u) { return Matrix{(u - 1) * Matrix::Identity(3, 3)}; }, 3) ==
        NotWidened::several_cross);
  CHECK(reason([](double u) { return Matrix{{u < 1 ? -1.0 : 2.0}}; }, 1) == NotWidened::jumps);
}

TEST_CASE("where the wider problem cannot be evaluated between two points, that is why no branch leaves") {
  const double hole = std::numeric_limits<double>::quiet_NaN();
  CHECK(reason([=](double u) { return Matrix{{std::abs(u - 1) < 0.015 ? hole : u - 1}}; }, 1) ==
        NotWidened::not_evaluated);
}

TEST_CASE("a problem that widens to one whose Jacobian is no matrix is refused") {
  Functions f = widened([](double u) { return Matrix{{u - 1}}; }, 1);
  f.apply_jacobian = [](In, In, In x, Out y) { y = x; };
  WiderBranchPoints points(widening(from_functions(f)));
  CHECK_THROWS_WITH(points.locate(branch(0.13, 1.83, 10), 4),
                    "a problem that widens needs a Jacobian that is a matrix");
}

TEST_CASE(
    "the branch between two points at which a problem widens is traced once, and ends at the other one") {
  // v^2 = (u - 1)(2 - u): from p = 2 to p = 10, with its image at -v.
  const auto wide = from_functions(widened([](double u) { return Matrix{{(u - 1) * (u - 2)}}; }, 1));
  WiderBranchPoints points(widening(wide));
  Agenda agenda({});
  for (const std::size_t after : {4, 14}) {
    auto found = points.locate(branch(0.13, 2.83, 20), after);
    REQUIRE(std::holds_alternative<Junction>(found));
    agenda.points.push_back(std::get<Junction>(std::move(found)));
  }
  CHECK(std::abs(agenda.points[0].parameter - 2) < 1e-9);
  CHECK(std::abs(agenda.points[1].parameter - 10) < 1e-8);
  const auto way = agenda.next();
  REQUIRE(way);
  CHECK(way->point == 0);
  Counts counts;
  Corrector with(*wide, Vector{{2.0}}, 0, {}, counts);
  const auto entry = agenda.enter(*way, with, 0, 20);
  REQUIRE(entry);
  agenda.at(*way).branch = 0;
  std::optional<Agenda::Place> end;
  const Branch traced = trace_until(wide, start_at(*entry, Vector{{2.0}}, 0), window(0, 20),
                                    {branch_point_monitor()}, {}, [&](const Event& event) {
                                      end = agenda.arrival(wide, event, with);
                                      if (end) agenda.at(*end).branch = 0;
                                      return end.has_value();
                                    });
  REQUIRE(end);
  CHECK(end->point == 1);
  REQUIRE(traced.events.size() == 1);
  for (const Point& point : traced.points) {
    const double u = point.u[0], v = point.u[1];
    CHECK(std::abs(v * v + (u - 1) * (u - 2)) < 1e-8);
    CHECK(std::abs(u * u * u + u - point.parameter) < 1e-8);
  }
  CHECK(!agenda.next());  // neither the other half, which is its image, nor the way back
}
