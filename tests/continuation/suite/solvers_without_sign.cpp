// Linear solvers of the user's that know no determinant and solve with J alone: their events are those of the
// library's own solvers, and those of closed forms.

#include "catch.hpp"

#include "continuation/linear/users_solvers.hpp"
#include "continuation/suite/cases.hpp"
#include "continuation/suite/known_points.hpp"

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace solvers_without_sign {

using namespace suite;
using namespace users;
using namespace known_points;
using arcslip::continuation::trace;

namespace {

Branch traced(const Job& job, const MakeLinearSolver& solver) {
  Options options = job.options;
  options.linear_solver = solver;
  return trace(job.problem, job.start, options, {fold_monitor(), branch_point_monitor()});
}

void check_known(const Job& job, const Branch& branch) {
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.warnings.empty());
  REQUIRE(branch.events.size() == job.known.size());
  for (std::size_t i = 0; i < job.known.size(); ++i) {
    const Event& event = branch.events[i];
    CAPTURE(i, event.point.parameter);
    CHECK(event.monitor == job.known[i].monitor);
    CHECK(event.located);
    const double size = std::max(1.0, std::abs(job.known[i].parameter));
    CHECK(std::abs(event.point.parameter - job.known[i].parameter) <= job.digits * size);
  }
}

double angle_between_lines(const Vector& a, const Vector& b) {
  return std::sqrt(std::max(0.0, 1 - std::pow(a.normalized().dot(b.normalized()), 2)));
}

void check_same_data(const Event& one, const Event& other) {
  REQUIRE(one.data.index() == other.data.index());
  if (const auto* fold = std::get_if<Fold>(&one.data)) {
    const Fold& second = std::get<Fold>(other.data);
    CHECK(angle_between_lines(fold->right_null, second.right_null) < 1e-7);
    CHECK(fold->curvature == Approx(second.curvature).epsilon(1e-5));
  }
  if (const auto* crossing = std::get_if<BranchPoint>(&one.data)) {
    const BranchPoint& second = std::get<BranchPoint>(other.data);
    CHECK(crossing->type == second.type);
    REQUIRE(crossing->tangents.size() == second.tangents.size());
    for (const Vector& t : crossing->tangents)
      CHECK(std::any_of(second.tangents.begin(), second.tangents.end(),
                        [&](const Vector& s) { return angle_between_lines(s, t) < 1e-6; }));
  }
}

void check_same(const Branch& branch, const Branch& own) {
  CHECK(branch.stop.reason == own.stop.reason);
  CHECK(branch.warnings.empty());
  REQUIRE(branch.events.size() == own.events.size());
  for (std::size_t i = 0; i < own.events.size(); ++i) {
    const Event &event = branch.events[i], &same = own.events[i];
    CAPTURE(i, event.point.parameter, same.point.parameter);
    CHECK(event.monitor == same.monitor);
    CHECK(event.located);
    const double p = std::max(1.0, std::abs(same.point.parameter)), u = 1 + same.point.u.norm();
    CHECK(std::abs(event.point.parameter - same.point.parameter) < 1e-12 * p);
    CHECK((event.point.u - same.point.u).norm() < 1e-9 * u);
    check_same_data(event, same);
  }
}

}  // namespace

TEST_CASE("folds and branch points of ten problems are those known, with a user's sparse LU as well") {
  for (const Job& job : jobs()) {
    CAPTURE(job.name);
    const Branch own = traced(job, {});
    check_known(job, own);
    for (const bool transposed : {true, false}) {
      CAPTURE(transposed);
      const Branch branch = traced(job, sparse_lu(Manner::refuses, transposed));
      CHECK(branch.linear_solver == "block elimination around Eigen::SparseLU");
      check_known(job, branch);
      check_same(branch, own);
    }
  }
}

TEST_CASE("and with solvers that throw at a singular J, refuse what is nearly one, or solve it as they can") {
  for (const Job& job : jobs()) {
    const Branch own = traced(job, {});
    for (const Manner manner : {Manner::throws, Manner::refuses_nearly_singular, Manner::says_nothing}) {
      CAPTURE(job.name, static_cast<int>(manner));
      check_same(traced(job, sparse_lu(manner)), own);
    }
    CAPTURE(job.name);
    check_same(traced(job, least_squares()), own);
  }
}

TEST_CASE("the folds of cubic cells are passed although J is singular to the last bit on the way") {
  const Job job = cubic_cells();
  SparseLu::refused() = 0;
  Options options = job.options;
  options.linear_solver = sparse_lu();
  for (int k = 0; k < 50; ++k) {  // which places are looked at depends on the steps
    options.step.largest = 0.2 + 0.004 * k;
    const Branch branch = trace(job.problem, job.start, options, {fold_monitor()});
    CAPTURE(k);
    REQUIRE(branch.events.size() == 2);
    for (std::size_t i : {0u, 1u}) {
      CHECK(branch.events[i].located);
      const double fold = (i == 0 ? 1 : -1) * 2 / (3 * std::sqrt(3.0));
      CHECK(std::abs(branch.events[i].point.parameter - fold) < 1e-14);
      CHECK(std::abs(std::abs(branch.events[i].point.u[3]) - std::sqrt(1.0 / 3)) < 1e-10);
    }
  }
  CHECK(SparseLu::refused() > 0);
}

TEST_CASE("every fold of the suite is found with a user's sparse LU, and its branch ends in the same way") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    Options options = window(c.lower, c.upper);
    options.points = 2000;
    const ProblemPtr problem = sparse(c.problem);
    const Branch own = trace(problem, c.start, options, {fold_monitor()});
    if (own.stop.reason == StopReason::start_failed) continue;  // on a fold, which rounding may hide
    options.linear_solver = sparse_lu();
    const Branch branch = trace(problem, c.start, options, {fold_monitor()});
    CAPTURE(own.stop.message, branch.stop.message);
    CHECK(branch.stop.reason == own.stop.reason);
    REQUIRE(branch.events.size() == own.events.size());
    for (std::size_t i = 0; i < own.events.size(); ++i) {
      const double p = own.events[i].point.parameter;
      CHECK(std::abs(branch.events[i].point.parameter - p) < 1e-10 * std::max(1.0, std::abs(p)));
      CHECK(branch.events[i].located);
    }
  }
}

TEST_CASE("a trace starts on a fold with a tangent, whatever a user's solver makes of the singular J there") {
  Functions f;
  f.size = 1;
  f.parameters = {{"p", "", 0}};
  f.residual = [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0]; };
  f.sparse_jacobian = [](In u, In, SparseMatrix& J) {
    if (J.nonZeros() == 0) J.insert(0, 0) = 1;
    J.coeffRef(0, 0) = -2 * u[0];
  };
  const auto fold = from_functions(std::move(f));
  for (const MakeLinearSolver& solver : {MakeLinearSolver(), sparse_lu(), sparse_lu(Manner::throws),
                                         sparse_lu(Manner::says_nothing), least_squares()}) {
    Options options = window(-1, 1);
    options.linear_solver = solver;
    const Branch branch =
        trace(fold, {.u = Vector{{0.0}}, .p = Vector{{0.0}}, .tangent = Vector{{1.0, 0.0}}}, options);
    CAPTURE(branch.linear_solver, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    REQUIRE(!branch.points.empty());
    CHECK(std::abs(branch.points.back().u[0] - 1) < 1e-12);
  }
}

TEST_CASE("a double branch point has its branches without transposed solves, too") {
  // p u_i - u_i^2 + d (differences) in a ring of three: u = 0 is crossed at 0, and at 3 d by the three
  // branches on which two cells are equal.
  const double d = 0.2;
  const ProblemPtr dense = from_functions(
      3, {parameter("p", -0.5)},
      [=](In u, In p, Out F) {
        for (int i = 0; i < 3; ++i) F[i] = p[0] * u[i] - u[i] * u[i] + d * (u.sum() - 3 * u[i]);
      },
      [=](In u, In p, MatrixOut J) {
        J.setConstant(d);
        for (int i = 0; i < 3; ++i) J(i, i) = p[0] - 2 * u[i] - 2 * d;
      },
      [](In u, In, int, Out dF) { dF = u; });
  const Job job{"a ring",
                sparse(dense),
                {Vector::Zero(3), Vector{{-0.5}}, 0, 1},
                window(-0.5, 1),
                {{"branch_point", 0}, {"branch_point", 3 * d}},
                1e-11};
  const Branch own = traced(job, {});
  check_known(job, own);
  for (const bool transposed : {true, false}) {
    const Branch branch = traced(job, sparse_lu(Manner::refuses, transposed));
    check_known(job, branch);
    check_same(branch, own);
    CHECK(std::get<BranchPoint>(branch.events[1].data).type == BranchPoint::Type::multiple);
    CHECK(std::get<BranchPoint>(branch.events[1].data).tangents.size() == 4);
  }
}

TEST_CASE("the diagram of two coupled pitchforks is complete with a user's sparse LU") {
  // p u_i - u_i^3 + d (u_j - u_i): equal cells are born at 0 and opposite ones at 2 d, where p - 2 d = u^2;
  // on these, unequal ones at p - 2 d = u^2 = d, and nowhere else.
  const double d = 0.2;
  const Cell cell{[](double u, double p) { return p * u - u * u * u; },
                  [](double u, double p) { return p - 3 * u * u; }, [](double u, double) { return u; }};
  const ProblemPtr problem = from_functions(chain(2, d, cell, parameter("p", -0.5)));
  Options options = window(-0.5, 1);
  for (const MakeLinearSolver& solver : {MakeLinearSolver{}, sparse_lu(Manner::refuses, false)}) {
    options.linear_solver = solver;
    const auto diagram = trace_diagram(problem, on_equal(2, 0, -0.5), options, {.depth = 3});
    CAPTURE(diagram.message);
    CHECK(diagram.complete);
    std::vector<double> at;
    for (const auto& junction : diagram.branch_points) at.push_back(junction.parameter);
    std::sort(at.begin(), at.end());
    REQUIRE(at.size() == 4);
    CHECK(std::abs(at[0]) < 1e-12);
    for (std::size_t k : {2u, 3u}) CHECK(std::abs(at[k] - 3 * d) < 1e-12);
    CHECK(std::abs(at[1] - 2 * d) < 1e-12);
  }
}

TEST_CASE("without the sign of the determinant no branch jumps to another one close by") {
  // p u - u^3 + d (differences) + eps: on equal cells the branch from the left goes up to u = 1 at p = 1.
  // Patterns cross it at 100 times the eigenvalues of the coupling: in no step together with it.
  for (const int n : {1, 2, 40})
    for (double eps = 1e-2; eps > 0.5e-8; eps /= 10)
      for (const double largest : {0.0, 0.3}) {
        const Cell cell{[=](double u, double p) { return p * u - u * u * u + eps; },
                        [](double u, double p) { return p - 3 * u * u; }, [](double u, double) { return u; }};
        const ProblemPtr problem = from_functions(chain(n, 100, cell, parameter("p", -1)));
        for (const bool wants_branch_points : {false, true}) {
          CAPTURE(n, eps, largest, wants_branch_points);
          Options options = window(-1, 1);
          if (largest > 0) options.step.largest_parameter = largest;
          options.linear_solver = without_sign();
          std::vector<Monitor> monitors{fold_monitor()};
          if (wants_branch_points) monitors.push_back(branch_point_monitor());
          const Branch branch = trace(problem, on_equal(n, eps, -1), options, monitors);
          CHECK(branch.stop.reason == StopReason::boundary);
          CHECK(branch.points.back().u[0] > 0.99);
          bool above = true;
          for (const auto& point : branch.points) above = above && point.u.minCoeff() > 0;
          CHECK(above);
        }
      }
}

TEST_CASE("a trace without the sign of the determinant is resumed bit for bit") {
  const Job job = pitchfork_cells();
  Options options = job.options;
  options.linear_solver = without_sign();
  const std::vector<Monitor> monitors{fold_monitor()};
  Tracer plain(job.problem, job.start, options, monitors);
  auto resumed = std::make_unique<Tracer>(job.problem, job.start, options, monitors);
  while (plain.step()) {
  }
  while (resumed->step())
    resumed =
        std::make_unique<Tracer>(job.problem, state_from_json(to_json(resumed->save())), options, monitors);
  CHECK(plain.branch().points.size() > 20);
  CHECK(to_json(resumed->save()) == to_json(plain.save()));
}

namespace {

// J by its product alone, and a solver that refuses it where it is singular to a bound: nothing next to such
// a J is known to the library.
class OfOneEntry final : public PlainSolver {
 public:
  explicit OfOneEntry(double smallest) : smallest_(smallest) {}
  const char* name() const override { return "of one entry"; }
  bool prepare(const Jacobian& J) override {
    Vector y(1);
    apply(J, Vector::Ones(1), y);
    entry_ = y[0];
    return std::abs(entry_) > smallest_;
  }
  bool solve(In b, Out x) const override {
    x = b / entry_;
    return true;
  }

 private:
  double smallest_, entry_ = 1;
};

ProblemPtr cubic_by_products() {
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", -1)};
  f.residual = [](In u, In p, Out F) { F[0] = p[0] + u[0] - std::pow(u[0], 3); };
  f.apply_jacobian = [](In u, In, In x, Out y) { y = (1 - 3 * u[0] * u[0]) * x; };
  f.derivative = [](In, In, int, Out dF) { dF[0] = 1; };
  return from_functions(std::move(f));
}

}  // namespace

TEST_CASE("a fold is located from both sides where a matrix-free J is refused on it") {
  Options options = window(-1, 1);
  options.linear_solver = [] { return block_elimination(std::make_unique<OfOneEntry>(1e-9)); };
  const Branch branch = trace(cubic_by_products(), on_equal(1, -1.32, -1), options, {fold_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.warnings.empty());
  REQUIRE(branch.events.size() == 2);
  for (std::size_t i : {0u, 1u}) {
    const double sign = i == 0 ? 1 : -1;
    CHECK(branch.events[i].located);
    CHECK(std::abs(branch.events[i].point.parameter - sign * 2 / (3 * std::sqrt(3.0))) < 1e-13);
    CHECK(std::abs(branch.events[i].point.u[0] + sign * std::sqrt(1.0 / 3)) < 1e-9);
    // p'' = -w . F_uu v v = 6 u along |v| = 1, with w = 1
    const Fold& fold = std::get<Fold>(branch.events[i].data);
    CHECK(fold.curvature == Approx(-sign * 6 / std::sqrt(3.0)).epsilon(1e-5));
  }
}

TEST_CASE("an event that cannot be located is a warning of the branch") {
  Options options = window(-1, 1);
  options.linear_solver = [] { return block_elimination(std::make_unique<OfOneEntry>(1e-3)); };
  const Branch branch = trace(cubic_by_products(), on_equal(1, -1.32, -1), options, {fold_monitor()});
  REQUIRE(branch.events.size() == 2);
  CHECK_FALSE(branch.events[0].located);
  REQUIRE(branch.warnings.size() == 1);
  CAPTURE(branch.warnings[0]);
  CHECK(branch.warnings[0].starts_with("the event \"fold\" is not located near 0.38"));
}

}  // namespace solvers_without_sign
