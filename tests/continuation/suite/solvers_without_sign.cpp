// Linear solvers of the user's that know no determinant and solve with J alone: their events are those of the
// library's own solvers, and those of closed forms.

#include "catch.hpp"

#include "continuation/suite/cases.hpp"
#include "continuation/users_solvers.hpp"

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace solvers_without_sign {

using namespace suite;
using namespace users;
using arcslip::continuation::trace;

namespace {

constexpr double pi = std::numbers::pi;

struct Known {
  std::string monitor;
  double parameter;
};

// A problem whose folds and branch points are known, in the order of its branch.
struct Job {
  std::string name;
  ProblemPtr problem;
  Start start;
  Options options;
  std::vector<Known> known;
  double digits;  // of what is known: relative
};

// Cells in a row with free ends, coupled by their differences: cell i has the equations f(u_i) + d (u_(i-1) -
// 2 u_i + u_(i+1)), and on equal cells the coupling has the eigenvalues -d 4 sin^2(k pi / 2 n).
double coupling_eigenvalue(int k, int n) {
  return 4 * std::pow(std::sin(k * pi / (2.0 * n)), 2);
}

struct Cell {
  std::function<double(double u, double p)> f, f_u, f_p;
};

Functions chain(int n, double d, const Cell& cell, Parameter p) {
  Functions f;
  f.size = n;
  f.parameters = {std::move(p)};
  f.scales = Vector::Constant(n, std::sqrt(n));
  f.residual = [=](In u, In q, Out F) {
    for (int i = 0; i < n; ++i)
      F[i] = cell.f(u[i], q[0]) + d * ((i > 0 ? u[i - 1] - u[i] : 0) + (i + 1 < n ? u[i + 1] - u[i] : 0));
  };
  f.sparse_jacobian = [=](In u, In q, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, cell.f_u(u[i], q[0]) - d * ((i > 0) + (i + 1 < n)));
      if (i > 0) entries.emplace_back(i, i - 1, d), entries.emplace_back(i - 1, i, d);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In q, int, Out dF) {
    for (int i = 0; i < n; ++i) dF[i] = cell.f_p(u[i], q[0]);
  };
  return f;
}

Start on_equal(int n, double u, double p) {
  return {Vector::Constant(n, u), Vector{{p}}, 0, 1};
}

// p + u - u^3: folds at u = -+1/sqrt 3 where p = +-2 / (3 sqrt 3); other branches cross where 1 - 3 u^2 = d
// mu_k.
Job cubic_cells() {
  const int n = 10;
  const double d = 10, fold = 2 / (3 * std::sqrt(3.0));
  const Cell cell{[](double u, double p) { return p + u - u * u * u; },
                  [](double u, double) { return 1 - 3 * u * u; }, [](double, double) { return 1.0; }};
  std::vector<Known> known{{"fold", fold}};
  const double mu = d * coupling_eigenvalue(1, n);
  if (mu < 1) {
    const double u = std::sqrt((1 - mu) / 3);
    known.push_back({"branch_point", u - u * u * u});
    known.push_back({"branch_point", -(u - u * u * u)});
  }
  known.push_back({"fold", -fold});
  Options options = window(-1, 1);
  options.step.largest_parameter = 1;
  const ProblemPtr problem = from_functions(chain(n, d, cell, parameter("p", -1)));
  return {"cubic cells", problem, on_equal(n, -1.32, -1), options, known, 1e-11};
}

// Semenov's p e^u - u: a fold at u = 1, p = 1/e; others cross where u - 1 = d mu_k, p = u e^-u.
Job bratu_cells() {
  const int n = 12;
  const double d = 2;
  const Cell cell{[](double u, double p) { return p * std::exp(u) - u; },
                  [](double u, double p) { return p * std::exp(u) - 1; },
                  [](double u, double) { return std::exp(u); }};
  std::vector<Known> known{{"fold", std::exp(-1.0)}};
  for (int k = 1; k < n; ++k) {
    const double u = 1 + d * coupling_eigenvalue(k, n);
    const double p = u * std::exp(-u);
    if (p > 0.02) known.push_back({"branch_point", p});
  }
  Options options = window(0.02, 1);
  options.step.largest_parameter = 0.01;
  return {"cells of Bratu's reaction",
          from_functions(chain(n, d, cell, parameter("p", 0.02))),
          on_equal(n, 0.02, 0.02),
          options,
          known,
          1e-10};
}

// p u - u^3 in a row: u = 0 is crossed where p = d mu_k.
Job pitchfork_cells() {
  const int n = 40;
  const double d = 3;
  const Cell cell{[](double u, double p) { return p * u - u * u * u; },
                  [](double u, double p) { return p - 3 * u * u; }, [](double u, double) { return u; }};
  std::vector<Known> known;
  for (int k = 0; d * coupling_eigenvalue(k, n) < 2; ++k)
    known.push_back({"branch_point", d * coupling_eigenvalue(k, n)});
  return {"coupled pitchforks",
          from_functions(chain(n, d, cell, parameter("p", -1))),
          on_equal(n, 0, -1),
          window(-1, 2),
          known,
          1e-10};
}

// Bratu's problem by Numerov's method, of fourth order: its fold is 3.513830719125 (tests/reference).
Job bratu() {
  const int n = 399;
  const double h = 1.0 / (n + 1), c = h * h / 12;
  Functions f;
  f.size = n;
  f.parameters = {parameter("lambda", 0.1)};
  f.scales = Vector::Constant(n, std::sqrt(n));
  const auto reaction = [](In u, int i, int n_) { return i < 0 || i >= n_ ? 1.0 : std::exp(u[i]); };
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? u[i - 1] - u[i] : -u[i], right = i + 1 < n ? u[i + 1] - u[i] : -u[i];
      F[i] =
          left + right + c * p[0] * (reaction(u, i - 1, n) + 10 * reaction(u, i, n) + reaction(u, i + 1, n));
    }
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < n; ++j) {
      const double slope = c * p[0] * std::exp(u[j]);
      entries.emplace_back(j, j, 10 * slope - 2);
      if (j > 0) entries.emplace_back(j - 1, j, 1 + slope);
      if (j + 1 < n) entries.emplace_back(j + 1, j, 1 + slope);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int, Out dF) {
    for (int i = 0; i < n; ++i)
      dF[i] = c * (reaction(u, i - 1, n) + 10 * reaction(u, i, n) + reaction(u, i + 1, n));
  };
  return {"Bratu's problem", from_functions(std::move(f)), {Vector::Zero(n), Vector{{0.1}}, 0, 1},
          window(0.1, 5),    {{"fold", 3.513830719125}},   1e-9};
}

// u'' + lambda (u - u^3), u(0) = u(1) = 0: u = 0 is crossed at (2/h)^2 sin^2(k pi h/2) (Chafee and Infante
// 1974).
Job chafee_infante() {
  const int n = 60;
  const double h2 = 1.0 / ((n + 1.0) * (n + 1.0));
  Functions f;
  f.size = n;
  f.parameters = {parameter("lambda", 1, 10)};
  f.scales = Vector::Constant(n, std::sqrt(n));
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < n; ++i)
      F[i] = (i > 0 ? u[i - 1] : 0) - 2 * u[i] + (i + 1 < n ? u[i + 1] : 0) +
             h2 * p[0] * (u[i] - u[i] * u[i] * u[i]);
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, -2 + h2 * p[0] * (1 - 3 * u[i] * u[i]));
      if (i > 0) entries.emplace_back(i, i - 1, 1), entries.emplace_back(i - 1, i, 1);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int, Out dF) { dF = h2 * (u.array() - u.array().cube()); };
  std::vector<Known> known;
  for (int k = 1; k <= 4; ++k)
    known.push_back({"branch_point", 4 / h2 * std::pow(std::sin(k * pi / (2.0 * (n + 1))), 2)});
  const Start start{Vector::Zero(n), Vector{{1.0}}, 0, 1};
  return {"Chafee and Infante's problem", from_functions(std::move(f)), start, window(1, 170), known, 1e-10};
}

// A shallow arch of two bars, load p = u (u - 1) (u - 2) / 2, loaded by a spring: its folds, at u = 1 -+
// 1/sqrt 3, are at p = +-1 / (3 sqrt 3), whatever the spring.
Job snapping_arch() {
  const double k = 2, fold = 1 / (3 * std::sqrt(3.0));
  const ProblemPtr dense = from_functions(
      2, {parameter("p", -0.3)},
      [=](In u, In p, Out F) {
        F[0] = k * (u[1] - u[0]) - u[0] * (u[0] - 1) * (u[0] - 2) / 2;
        F[1] = p[0] - k * (u[1] - u[0]);
      },
      [=](In u, In, MatrixOut J) { J << -k - (3 * u[0] * u[0] - 6 * u[0] + 2) / 2, k, k, -k; },
      [](In, In, int, Out dF) { dF << 0, 1; });
  return {"a snapping arch",
          sparse(dense),
          {Vector{{-0.3, -0.5}}, Vector{{-0.3}}, 0, 1},
          window(-0.3, 0.4),
          {{"fold", fold}, {"fold", -fold}},
          1e-11};
}

// The Brusselator in a row of cells: equal ones x = A, y = B/A are left by patterns (Turing) where
// (B - 1 - D mu) (-A^2 - E mu) + A^2 B = 0, so that B = (1 + D mu) (A^2 + E mu) / (E mu), mu = mu_k.
Job brusselator_cells() {
  const int cells = 15;
  const double A = 2, D = 1, E = 10;
  Functions f;
  f.size = 2 * cells;
  f.parameters = {parameter("B", 1)};
  f.scales = Vector::Constant(2 * cells, std::sqrt(2 * cells));
  f.residual = [=](In u, In p, Out F) {
    const auto flow = [&](int i, int of) {
      return (i > 0 ? u[2 * i - 2 + of] - u[2 * i + of] : 0) +
             (i + 1 < cells ? u[2 * i + 2 + of] - u[2 * i + of] : 0);
    };
    for (int i = 0; i < cells; ++i) {
      const double x = u[2 * i], y = u[2 * i + 1];
      F[2 * i] = A - (p[0] + 1) * x + x * x * y + D * flow(i, 0);
      F[2 * i + 1] = p[0] * x - x * x * y + E * flow(i, 1);
    }
  };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < cells; ++i) {
      const double x = u[2 * i], y = u[2 * i + 1];
      const int neighbours = (i > 0) + (i + 1 < cells);
      entries.emplace_back(2 * i, 2 * i, -(p[0] + 1) + 2 * x * y - D * neighbours);
      entries.emplace_back(2 * i, 2 * i + 1, x * x);
      entries.emplace_back(2 * i + 1, 2 * i, p[0] - 2 * x * y);
      entries.emplace_back(2 * i + 1, 2 * i + 1, -x * x - E * neighbours);
      for (const int other : {i - 1, i + 1}) {
        if (other < 0 || other >= cells) continue;
        entries.emplace_back(2 * i, 2 * other, D);
        entries.emplace_back(2 * i + 1, 2 * other + 1, E);
      }
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [=](In u, In, int, Out dF) {
    for (int i = 0; i < cells; ++i) dF[2 * i] = -u[2 * i], dF[2 * i + 1] = u[2 * i];
  };
  std::vector<Known> known;
  for (int k = 1; k < cells; ++k) {
    const double mu = coupling_eigenvalue(k, cells), B = (1 + D * mu) * (A * A + E * mu) / (E * mu);
    if (B < 4) known.push_back({"branch_point", B});
  }
  std::sort(known.begin(), known.end(),
            [](const Known& a, const Known& b) { return a.parameter < b.parameter; });
  Vector start(2 * cells);
  for (int i = 0; i < cells; ++i) start[2 * i] = A, start[2 * i + 1] = 1 / A;
  return {"a row of Brusselators",
          from_functions(std::move(f)),
          {start, Vector{{1.0}}, 0, 1},
          window(1, 4),
          known,
          1e-10};
}

// A problem of the suite, with the folds that are known of it.
Job of_suite(const std::string& name) {
  const Case c = named(name);
  std::vector<Known> known;
  for (const double fold : c.folds.value_or(std::vector<double>{})) known.push_back({"fold", fold});
  return {name, sparse(c.problem), c.start, window(c.lower, c.upper), known, std::max(c.digits, 1e-11)};
}

Job normal_form(const std::string& name) {
  Job job = of_suite(name);
  job.known = {{"branch_point", 0}};
  return job;
}

std::vector<Job> jobs() {
  return {cubic_cells(),
          bratu(),
          normal_form("pitchfork"),
          normal_form("transcritical"),
          of_suite("duffing_1harmonic"),
          bratu_cells(),
          chafee_infante(),
          snapping_arch(),
          brusselator_cells(),
          pitchfork_cells()};
}

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
  const Branch branch = trace(job.problem, job.start, options, {fold_monitor()});
  CHECK(SparseLu::refused() > 0);
  REQUIRE(branch.events.size() == 2);
  for (std::size_t i : {0u, 1u}) {
    CHECK(branch.events[i].located);
    const double fold = (i == 0 ? 1 : -1) * 2 / (3 * std::sqrt(3.0));
    CHECK(std::abs(branch.events[i].point.parameter - fold) < 1e-14);
    CHECK(std::abs(std::abs(branch.events[i].point.u[3]) - std::sqrt(1.0 / 3)) < 1e-10);
  }
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
