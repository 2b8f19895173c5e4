// Branch points of even multiplicity, and several in one step: found, switched at, or named as missing.

#include "continuation/diagrams/diagram_problems.hpp"

#include <arcslip/continuation/special_points/multiple_point.hpp>

#include <Eigen/Dense>

using namespace problems;

namespace {

// y_i (lambda - a_i - y_i^2 - c sum of the other y_j^2) = 0 in the coordinates u = T y, its equations mixed
// by S.
struct Pitchforks {
  Vector at;  // a_i
  double c = 0;
  Matrix T, S;

  Pitchforks(Vector a, double coupling, bool mixed) : at(std::move(a)), c(coupling) {
    const Eigen::Index n = at.size();
    T = S = Matrix::Identity(n, n);
    for (Eigen::Index i = 0; mixed && i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        T(i, j) += 0.3 * std::sin(1.0 + 3.0 * static_cast<double>(i) + 5.0 * static_cast<double>(j));
        S(i, j) += 0.3 * std::cos(2.0 + 7.0 * static_cast<double>(i) + 4.0 * static_cast<double>(j));
      }
  }
  int size() const { return static_cast<int>(at.size()); }
  Vector y(In u) const { return T.partialPivLu().solve(Vector(u)); }
  Functions functions(bool exact = true) const {
    const Pitchforks f = *this;
    Functions result{
        .size = size(), .parameters = {parameter("lambda", 0)}, .residual = [=](In u, In p, Out F) {
          const Vector y = f.y(u);
          Vector g(f.size());
          for (int i = 0; i < f.size(); ++i)
            g[i] = y[i] * (p[0] - f.at[i] - y[i] * y[i] - f.c * (y.squaredNorm() - y[i] * y[i]));
          F = f.S * g;
        }};
    if (!exact) return result;
    result.jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) {
      const Vector y = f.y(u);
      Matrix D = -2 * f.c * y * y.transpose();
      for (int i = 0; i < f.size(); ++i)
        D(i, i) = p[0] - f.at[i] - 3 * y[i] * y[i] - f.c * (y.squaredNorm() - y[i] * y[i]);
      J = f.S * D * f.T.inverse();
    };
    result.derivative = [=](In u, In, int, Out dF) { dF = f.S * f.y(u); };
    return result;
  }
};

Diagram diagram_of(const Functions& f, double from, int depth) {
  return trace_diagram(from_functions(f), {Vector::Zero(f.size), Vector{{from}}, 0, 1}, window(-1, 1),
                       {.depth = depth}, {fold_monitor()});
}

// What the y_i are at the ends of a branch, as signs.
std::vector<std::vector<int>> ends(const Diagram& diagram, const Pitchforks& f) {
  std::vector<std::vector<int>> all;
  for (const DiagramBranch& each : diagram.branches)
    for (const Point* end : {&each.branch.points.front(), &each.branch.points.back()}) {
      if (end->parameter != 1) continue;
      std::vector<int> signs;
      for (const double y : f.y(end->u)) signs.push_back(std::abs(y) < 1e-9 ? 0 : y > 0 ? 1 : -1);
      all.push_back(std::move(signs));
    }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

TEST_CASE("two and three pitchforks at one place are switched at: each of the 3^n - 1 solutions, once") {
  for (const int n : {2, 3})
    for (const double c : {0.0, 0.3, 2.0})  // 2: the order of stability is another one
      for (const bool mixed : {false, true})
        for (const double from : {-0.93, -1.0, -0.777}) {
          if (n == 3 && from != -0.93) continue;
          const Pitchforks f(Vector::Zero(n), c, mixed);
          const Diagram diagram = diagram_of(f.functions(), from, 1);
          CAPTURE(n, c, mixed, from, diagram.message);
          CHECK(diagram.complete);
          REQUIRE(diagram.branch_points.size() == 1);
          CHECK(std::abs(diagram.branch_points[0].parameter) < 1e-12);
          CHECK(diagram.branch_points[0].u.norm() < 1e-12);
          CHECK(all_traced(diagram.branch_points[0]));
          check_order(diagram);
          auto found = ends(diagram, f);
          CHECK(found.size() == static_cast<std::size_t>(std::pow(3, n)));
          CHECK(std::unique(found.begin(), found.end()) == found.end());
        }
}

TEST_CASE("the directions of the branches at a double point are those of its amplitudes") {
  // y_1 = y_2 on the diagonals, as the square's symmetry asks for
  for (const double c : {0.3, 2.0})
    for (const bool exact : {true, false}) {
      const Pitchforks f(Vector::Zero(2), c, true);
      const auto problem = from_functions(f.functions(exact));
      const auto point =
          locate_multiple_point(*problem, Vector::Zero(1), 0, Vector{{0.01, -0.02, 0.015}}, 2, 1);
      REQUIRE(point);
      CHECK(point->x.norm() < (exact ? 1e-12 : 1e-9));
      REQUIRE(point->tangents.size() == 5);
      for (const Vector& y :
           {Vector{{1.0, 0.0}}, Vector{{0.0, 1.0}}, Vector{{1.0, 1.0}}, Vector{{1.0, -1.0}}}) {
        Vector t(3);
        t << f.T * y, 0;
        t.normalize();
        double best = 0;
        for (const Vector& each : point->tangents) best = std::max(best, std::abs(each.dot(t)));
        CHECK(best > 1 - 1e-12);
      }
    }
}

TEST_CASE("branch points of two modes in one step are distinguished, down to 1e-6") {
  for (const double d : {0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
    for (const bool mixed : {false, true})
      for (const double from : {-0.93, -1.0}) {
        const Pitchforks f(Vector{{0.0, d}}, 0.3, mixed);
        const Diagram diagram = diagram_of(f.functions(), from, 1);
        CAPTURE(d, mixed, from, diagram.message);
        CHECK(diagram.complete);
        // at 0 and d on u = 0, and where y_2 is born on the branches of y_1, lambda - d - 0.3 lambda = 0
        REQUIRE(diagram.branch_points.size() == 4);
        std::vector<double> at;
        for (const Junction& each : diagram.branch_points) at.push_back(each.parameter);
        std::sort(at.begin(), at.end());
        CHECK(std::abs(at[0]) < 1e-12);
        CHECK(std::abs(at[1] - d) < 1e-12);
        CHECK(std::abs(at[2] - d / 0.7) < 1e-12);
        CHECK(std::abs(at[3] - d / 0.7) < 1e-12);
        CHECK(diagram.branches.size() == 3);
      }
}

TEST_CASE("two branch points of one mode in one step, of opposite direction, are reported") {
  for (const double d : {0.1, 1e-2, 1e-3, 1e-4}) {
    const auto problem = from_functions(
        1, {parameter("lambda", 0)},
        [=](In u, In p, Out F) { F[0] = u[0] * (u[0] * u[0] - (p[0] - 0.3) * (p[0] - 0.3 - d)); },
        [=](In u, In p, Eigen::Ref<Matrix> J) {
          J(0, 0) = 3 * u[0] * u[0] - (p[0] - 0.3) * (p[0] - 0.3 - d);
        },
        [=](In u, In p, int, Out dF) { dF[0] = -u[0] * (2 * p[0] - 0.6 - d); });
    for (const double from : {-0.93, -1.0, 0.11}) {
      const Diagram diagram = trace_diagram(problem, at(0, from), window(-1, 1), {.depth = 1});
      CAPTURE(d, from, diagram.message);
      CHECK(diagram.complete);
      REQUIRE(diagram.branch_points.size() == 2);
      CHECK(std::abs(diagram.branch_points[0].parameter - 0.3) < 1e-12);
      CHECK(std::abs(diagram.branch_points[1].parameter - 0.3 - d) < 1e-12);
      CHECK(diagram.branches.size() == 3);
    }
  }
}

TEST_CASE("a square membrane has double branch points, at which four branches leave next to the flat one") {
  // Delta u + lambda sin u on a square: the modes (j, k) and (k, j) have one eigenvalue.
  const int n = GENERATE(7, 24);
  const double h2 = 1.0 / ((n + 1.0) * (n + 1.0));
  CAPTURE(n);
  const auto index = [=](int i, int j) { return i * n + j; };
  Functions f{.size = n * n, .parameters = {parameter("lambda", 0, 10)}};
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        double sum = -4 * u[index(i, j)];
        if (i > 0) sum += u[index(i - 1, j)];
        if (j > 0) sum += u[index(i, j - 1)];
        if (i + 1 < n) sum += u[index(i + 1, j)];
        if (j + 1 < n) sum += u[index(i, j + 1)];
        F[index(i, j)] = sum + h2 * p[0] * std::sin(u[index(i, j)]);
      }
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        entries.emplace_back(index(i, j), index(i, j), -4 + h2 * p[0] * std::cos(u[index(i, j)]));
        if (i > 0) entries.emplace_back(index(i, j), index(i - 1, j), 1);
        if (j > 0) entries.emplace_back(index(i, j), index(i, j - 1), 1);
        if (i + 1 < n) entries.emplace_back(index(i, j), index(i + 1, j), 1);
        if (j + 1 < n) entries.emplace_back(index(i, j), index(i, j + 1), 1);
      }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int, Out dF) { dF = h2 * u.array().sin(); };
  const auto eigenvalue = [&](int j, int k) {
    const double a = std::sin(j * std::acos(-1.0) / (2 * n + 2)),
                 b = std::sin(k * std::acos(-1.0) / (2 * n + 2));
    return 4 / h2 * (a * a + b * b);
  };
  const Branch flat = trace(from_functions(f), {Vector::Zero(n * n), Vector{{1.0}}, 0, 1}, window(0, 130),
                            {branch_point_monitor()});
  CHECK(flat.stop.reason == StopReason::boundary);
  struct Expected {
    double lambda;
    std::size_t branches;
  };
  // u = 0 and, of a double point, the two modes and their sum and difference
  const std::vector<Expected> expected{{eigenvalue(1, 1), 2},
                                       {eigenvalue(1, 2), 5},
                                       {eigenvalue(2, 2), 2},
                                       {eigenvalue(1, 3), 5},
                                       {eigenvalue(2, 3), 5}};
  REQUIRE(flat.events.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Event& event = flat.events[i];
    CHECK(event.located);
    CHECK(event.point.parameter == Approx(expected[i].lambda).epsilon(1e-10));
    const BranchPoint& crossing = std::get<BranchPoint>(event.data);
    CHECK(crossing.tangents.size() == expected[i].branches);
    CHECK((crossing.type == BranchPoint::Type::multiple) == (expected[i].branches > 2));
  }
}
