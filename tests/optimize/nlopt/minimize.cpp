// The NLopt layer against minima that are known in closed form or from the literature.
#include "catch.hpp"
#include "optimize/problems.hpp"

#include <cmath>
#include <numbers>

using namespace arcslip::optimize;

TEST_CASE("the minimum of Rosenbrock's function is found at (1, 1) with its gradient") {
  for (const char* name :
       {"LD_SLSQP", "LD_LBFGS", "LD_MMA", "LD_CCSAQ", "LD_TNEWTON_PRECOND_RESTART", "LD_VAR2"}) {
    INFO(name);
    MinimizeOptions options{.algorithm = name};
    options.tolerances = {.x_relative = 1e-10, .f_relative = 0};
    const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, options);
    INFO(r.message);
    REQUIRE((is_converged(r.reason) || r.reason == MinimizeReason::rounding));
    CHECK(r.x[0] == Approx(1).margin(1e-5));
    CHECK(r.x[1] == Approx(1).margin(1e-5));
    CHECK(r.value < 1e-10);
    CHECK(r.feasible);
  }
}

TEST_CASE("the minimum of Rosenbrock's function is found at (1, 1) without its gradient") {
  for (const char* name :
       {"LN_BOBYQA", "LN_COBYLA", "LN_SBPLX", "LN_NELDERMEAD", "LN_PRAXIS", "LN_NEWUOA_BOUND"}) {
    INFO(name);
    MinimizeOptions options{.algorithm = name, .evaluations = 50000};
    options.tolerances = {.x_relative = 1e-9, .f_relative = 0};
    const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, options);
    INFO(r.message);
    CHECK(r.x[0] == Approx(1).margin(1e-3));
    CHECK(r.x[1] == Approx(1).margin(2e-3));
    CHECK(r.value < 1e-6);
  }
}

TEST_CASE("global algorithms find the lowest of the six humps of the camel") {
  // Dixon & Szego 1978: f = -1.0316284535 at +-(0.0898420131, -0.7126564030).
  for (const char* name : {"GN_DIRECT", "GN_DIRECT_L", "GN_ORIG_DIRECT_L", "GN_CRS2_LM", "GN_ISRES",
                           "GN_ESCH", "GN_MLSL", "GD_MLSL_LDS", "G_MLSL_LDS"}) {
    INFO(name);
    MinimizeOptions options{.algorithm = name, .evaluations = 5000};
    if (options.algorithm.find("MLSL") != std::string::npos)
      options.local = LocalOptions{.algorithm = "LD_LBFGS"};
    const MinimizeResult r = minimize(six_hump_camel(), {2.5, 1.7}, options);
    INFO(r.message);
    CHECK(r.value == Approx(-1.0316284535).margin(options.algorithm == "GN_ESCH" ? 1e-3 : 1e-6));
    CHECK(r.evaluations <= 5000);
  }
}

TEST_CASE("the optimum of Hock and Schittkowski's problem 71 is found where both constraints are active") {
  // Hock & Schittkowski 1981; its equation as an inequality, which is active at the optimum. At every
  // algorithm that takes constraints.
  const std::vector<double> x{1, 4.74299963, 3.82114998, 1.37940829};
  for (const char* name :
       {"LD_SLSQP", "LD_MMA", "LD_CCSAQ", "LN_COBYLA", "LD_AUGLAG", "AUGLAG", "AUGLAG_EQ"}) {
    INFO(name);
    MinimizeOptions options{.algorithm = name, .evaluations = 100000};
    options.tolerances = {.x_relative = 1e-10, .f_relative = 1e-13};
    if (options.algorithm.starts_with("AUGLAG"))
      options.local = LocalOptions{.algorithm = options.algorithm == "AUGLAG" ? "LD_LBFGS" : "LD_SLSQP"};
    const MinimizeResult r = minimize(hock_schittkowski_71(), {1.1, 4.5, 3.7, 1.5}, options);
    INFO(r.message);
    CHECK(r.feasible);
    CHECK(r.value == Approx(17.0140173).margin(2e-6));
    for (std::size_t i = 0; i < 4; ++i) CHECK(r.x[i] == Approx(x[i]).margin(1e-3));
  }
}

TEST_CASE("the best normal load of a friction damper is p = pi f0 / 2 in one harmonic") {
  // Al Sayed et al. 2011 with c = 0 and N = 1: kd A = p / (1 - pi f0 / (4 p)), p = mu Fn, has its minimum pi
  // f0 there. The objective is flat to rounding within 1e-8 of the minimum.
  const double pi = std::numbers::pi;
  for (const char* name :
       {"LD_SLSQP", "LD_LBFGS", "LD_MMA", "LN_BOBYQA", "LN_COBYLA", "LN_SBPLX", "GN_DIRECT_L"}) {
    for (double start : {0.8, 1.0, 3.0, 50.0}) {
      INFO(name << " from " << start);
      MinimizeOptions options{.algorithm = name};
      options.tolerances = {.x_relative = 1e-9, .f_relative = 0, .f_absolute = 1e-16};
      const MinimizeResult r = minimize(friction_damper(0.1, 50), {start}, options);
      INFO(r.message);
      CHECK(r.x[0] == Approx(pi / 2).margin(1e-6));
      CHECK(r.value == Approx(pi).epsilon(1e-12));
    }
  }
}

TEST_CASE("the same seed gives the same run, another seed another one") {
  auto run = [](unsigned long seed) {
    MinimizeOptions options{.algorithm = "GN_ISRES", .evaluations = 300, .population = 30, .seed = seed};
    return minimize(six_hump_camel(), {1, 1}, options);
  };
  CHECK(run(7).x == run(7).x);
  CHECK(run(7).x != run(8).x);
}

TEST_CASE("a start outside the bounds is moved onto them, and that is said") {
  std::vector<double> first;
  NonlinearProgram problem = rosenbrock();
  problem.objective = [f = problem.objective, &first](auto x, auto g) {
    if (first.empty()) first.assign(x.begin(), x.end());
    return f(x, g);
  };
  const MinimizeResult r = minimize(problem, {-3, 0.5});
  CHECK(first == std::vector<double>{-2, 0.5});
  REQUIRE(r.notes.size() == 1);
  CHECK(r.notes[0] == "the start of variable 0 was -3, outside [-2, 2], and was moved to -2");
}

TEST_CASE("the gradient is asked for by gradient-based algorithms only") {
  for (const Algorithm& a : algorithms()) {
    if (a.needs_local) continue;
    INFO(a.name);
    bool asked = false;
    NonlinearProgram problem = rosenbrock();
    problem.objective = [f = problem.objective, &asked](auto x, auto g) {
      asked = asked || !g.empty();
      return f(x, g);
    };
    minimize(problem, {0, 0}, {.algorithm = a.name, .evaluations = 30});
    CHECK(asked == (a.name[1] == 'D'));
  }
}

TEST_CASE("progress is reported after every evaluation") {
  std::vector<long> counts;
  double best = 0;
  MinimizeOptions options;
  options.progress = [&](const MinimizeProgress& p) {
    counts.push_back(p.evaluations);
    CHECK(p.x.size() == 2);
    CHECK(p.best <= p.value);
    best = p.best;
    return true;
  };
  const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, options);
  REQUIRE(counts.size() == static_cast<std::size_t>(r.evaluations));
  for (std::size_t i = 0; i < counts.size(); ++i) CHECK(counts[i] == static_cast<long>(i + 1));
  CHECK(best == r.value);
}
