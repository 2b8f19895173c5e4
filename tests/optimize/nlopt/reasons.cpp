// Every way in which a minimisation ends, and every input that it refuses.
#include "catch.hpp"
#include "contains.hpp"
#include "optimize/problems.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <nlopt.h>

using namespace arcslip::optimize;

namespace {

// The objective of `problem` that does something else in its n-th call.
NonlinearProgram interfere(NonlinearProgram problem, long n, std::function<double()> instead) {
  auto calls = std::make_shared<long>(0);
  problem.objective = [f = problem.objective, n, instead, calls](auto x, auto g) {
    const double value = f(x, g);
    return ++*calls == n ? instead() : value;
  };
  return problem;
}

std::string minimize_error(const NonlinearProgram& problem, const std::vector<double>& start,
                           const MinimizeOptions& options = {}) {
  try {
    minimize(problem, start, options);
  } catch (const OptionsError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("every return code of NLopt has a reason of its own") {
  const std::vector<std::pair<int, MinimizeReason>> codes{
      {NLOPT_SUCCESS, MinimizeReason::converged},
      {NLOPT_STOPVAL_REACHED, MinimizeReason::target},
      {NLOPT_FTOL_REACHED, MinimizeReason::converged_value},
      {NLOPT_XTOL_REACHED, MinimizeReason::converged_step},
      {NLOPT_MAXEVAL_REACHED, MinimizeReason::evaluation_limit},
      {NLOPT_MAXTIME_REACHED, MinimizeReason::time_limit},
      {NLOPT_FAILURE, MinimizeReason::failed},
      {NLOPT_INVALID_ARGS, MinimizeReason::invalid_arguments},
      {NLOPT_OUT_OF_MEMORY, MinimizeReason::out_of_memory},
      {NLOPT_ROUNDOFF_LIMITED, MinimizeReason::rounding},
      {NLOPT_FORCED_STOP, MinimizeReason::user},
  };
  for (const auto& [code, reason] : codes) {
    INFO(code);
    CHECK(std::string(name(reason_of(code))) == name(reason));
  }
  CHECK(reason_of(99) == MinimizeReason::failed);
  CHECK(reason_of(-99) == MinimizeReason::failed);
}

TEST_CASE("a run ends as converged_value where the value stands still") {
  MinimizeOptions options;
  options.tolerances = {.x_relative = 0, .f_relative = 1e-3};
  const MinimizeResult r = minimize(friction_damper(0.8, 50), {3}, options);
  CHECK(std::string(name(r.reason)) == "converged_value");
  CHECK(is_converged(r.reason));
  CHECK(contains(r.message, "a step changed the value by less than 0.001 relative after "));
}

TEST_CASE("a run ends as converged_step where the variables stand still") {
  MinimizeOptions options{.algorithm = "LN_BOBYQA"};
  options.tolerances = {.x_relative = 1e-4, .x_absolute = 1e-5, .f_relative = 0};
  const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, options);
  CHECK(std::string(name(r.reason)) == "converged_step");
  CHECK(contains(r.message, "the variables by less than 0.0001 relative or 1e-05 absolute after "));
}

TEST_CASE("a run ends as converged where the algorithm's own test holds") {
  // The gradient vanishes at the start.
  const MinimizeResult r = minimize(rosenbrock(), {1, 1}, {.algorithm = "LD_LBFGS"});
  CHECK(is_converged(r.reason));
  CHECK(r.value == 0);
}

TEST_CASE("a run ends at its target") {
  const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, {.target = 0.5});
  CHECK(std::string(name(r.reason)) == "target");
  CHECK(r.value <= 0.5);
  CHECK(contains(r.message, "the value reached the target 0.5 after "));
}

TEST_CASE("no algorithm passes its limit of evaluations") {
  for (const Algorithm& a : algorithms()) {
    for (int limit : {1, 2, 7}) {
      INFO(a.name << " " << limit);
      MinimizeOptions options{.algorithm = a.name, .evaluations = limit};
      options.tolerances = {.x_relative = 0, .f_relative = 0};
      if (a.needs_local) options.local = LocalOptions{.algorithm = "LN_BOBYQA"};
      const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, options);
      CHECK(std::string(name(r.reason)) == "evaluation_limit");
      CHECK(r.evaluations <= limit);
      CHECK(r.value < 1e4);
      CHECK(contains(r.message, " was reached; the best value is "));
    }
  }
}

TEST_CASE("every algorithm stops at the limit of time with the best so far") {
  for (const Algorithm& a : algorithms()) {
    INFO(a.name);
    NonlinearProgram slow = rosenbrock();
    slow.objective = [f = slow.objective](auto x, auto g) {
      std::this_thread::sleep_for(std::chrono::microseconds(400));
      return f(x, g);
    };
    MinimizeOptions options{.algorithm = a.name, .seconds = 0.001};
    options.tolerances = {.x_relative = 0, .f_relative = 0};
    if (a.needs_local) options.local = LocalOptions{.algorithm = "LN_BOBYQA"};
    const MinimizeResult r = minimize(slow, {-1.2, 1}, options);
    CHECK(std::string(name(r.reason)) == "time_limit");
    CHECK(r.evaluations <= 3);
    CHECK(r.value < 1e4);
    CHECK(r.seconds >= 0.001);
    CHECK(contains(r.message, "the limit of 0.001 s was reached at 0.0"));
  }
}

TEST_CASE("every algorithm stops when the callback says so") {
  for (const Algorithm& a : algorithms()) {
    for (long last : {1, 2, 4}) {
      INFO(a.name << " " << last);
      MinimizeOptions options{.algorithm = a.name};
      options.progress = [last](const MinimizeProgress& p) { return p.evaluations < last; };
      if (a.needs_local) options.local = LocalOptions{.algorithm = "LN_BOBYQA"};
      const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, options);
      CHECK(std::string(name(r.reason)) == "user");
      CHECK(r.evaluations == last);
      CHECK(contains(r.message, "the progress callback stopped the run after "));
    }
  }
}

TEST_CASE("an exception in the objective ends every algorithm with its text and the best so far") {
  for (const Algorithm& a : algorithms()) {
    INFO(a.name);
    MinimizeOptions options{.algorithm = a.name};
    if (a.needs_local) options.local = LocalOptions{.algorithm = "LN_BOBYQA"};
    const NonlinearProgram throws =
        interfere(rosenbrock(), 4, []() -> double { throw std::runtime_error("no peak"); });
    const MinimizeResult r = minimize(throws, {-1.2, 1}, options);
    CHECK(std::string(name(r.reason)) == "objective_failed");
    CHECK(r.evaluations == 4);
    CHECK(r.value < 1e4);
    CHECK(contains(r.message, "the objective threw \"no peak\" after 4 evaluations; the best value is "));
  }
}

TEST_CASE("an exception at the start leaves no value, and says so") {
  const NonlinearProgram throws = interfere(rosenbrock(), 1, []() -> double { throw 42; });
  const MinimizeResult r = minimize(throws, {-1.2, 1});
  CHECK(std::string(name(r.reason)) == "objective_failed");
  CHECK(r.x.empty());
  CHECK(std::isinf(r.value));
  CHECK_FALSE(r.feasible);
  CHECK(r.message ==
        "the objective threw \"something other than a std::exception\" after 1 evaluation; no evaluation "
        "succeeded");
}

TEST_CASE("an exception in a constraint or in the progress callback is distinguished") {
  NonlinearProgram problem = hock_schittkowski_71();
  problem.constraints[1].function = [](auto, auto) -> double { throw std::runtime_error("wear"); };
  CHECK(contains(minimize(problem, {1, 5, 5, 1}).message, "constraint \"square\" threw \"wear\""));

  MinimizeOptions options;
  options.progress = [](const MinimizeProgress&) -> bool { throw std::runtime_error("disk full"); };
  const MinimizeResult r = minimize(rosenbrock(), {-1.2, 1}, options);
  CHECK(contains(r.message,
                 "the progress callback threw \"disk full\" after 1 evaluation; the best value is 24.2"));
  CHECK(r.value == Approx(24.2));
}

TEST_CASE("a value that is no number ends every algorithm, and is not the best") {
  for (const Algorithm& a : algorithms()) {
    INFO(a.name);
    MinimizeOptions options{.algorithm = a.name};
    if (a.needs_local) options.local = LocalOptions{.algorithm = "LN_BOBYQA"};
    const NonlinearProgram odd = interfere(rosenbrock(), 3, [] { return std::nan(""); });
    const MinimizeResult r = minimize(odd, {-1.2, 1}, options);
    CHECK(std::string(name(r.reason)) == "not_finite");
    CHECK(r.value < 1e4);
    CHECK(contains(r.message, "the objective is not a number after 3 evaluations; the best value is "));
  }
}

TEST_CASE("infinity is refused at the start, at minus infinity and in gradients and constraints") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(
      contains(minimize(friction_damper(0.1, 50), {0.5}).message, "the objective is inf after 1 evaluation"));
  const MinimizeResult below = minimize(interfere(rosenbrock(), 2, [=] { return -infinity; }), {-1.2, 1});
  CHECK(below.reason == MinimizeReason::not_finite);
  CHECK(below.value == Approx(24.2));

  NonlinearProgram forgotten = rosenbrock();
  forgotten.objective = [](std::span<const double> x, std::span<double> g) {
    if (!g.empty()) g[0] = 2 * x[0];
    return x[0] * x[0] + x[1];
  };
  CHECK(contains(minimize(forgotten, {1, 1}).message,
                 "entry 1 of the gradient of the objective is not a number"));

  NonlinearProgram constrained = hock_schittkowski_71();
  constrained.constraints[0].function = [=](auto, auto) { return infinity; };
  CHECK(contains(minimize(constrained, {1, 5, 5, 1}).message, "constraint \"product\" is inf"));
}

TEST_CASE("rounding errors end a run that asks for more than there is") {
  MinimizeOptions options{.algorithm = "LN_COBYLA", .evaluations = 100000};
  options.tolerances = {.x_relative = 0, .f_relative = 0};
  const MinimizeResult r = minimize(friction_damper(0.8, 50), {3}, options);
  CHECK(std::string(name(r.reason)) == "rounding");
  CHECK(contains(r.message, "rounding errors prevented further progress after "));
  CHECK(r.value == Approx(std::numbers::pi));
}

TEST_CASE("what NLopt itself refuses is reported with its own message") {
  const MinimizeResult r = minimize(friction_damper(0.8, 50), {3}, {.algorithm = "LN_NEWUOA"});
  CHECK(std::string(name(r.reason)) == "invalid_arguments");
  CHECK(contains(r.message, "NLopt refused to run LN_NEWUOA: "));
}

TEST_CASE("constraints that exclude each other leave the point of least excess") {
  NonlinearProgram problem = friction_damper(0.8, 50);
  auto below = [](double bound) {
    return [bound](std::span<const double> x, std::span<double> g) {
      if (!g.empty()) g[0] = 1;
      return x[0] - bound;
    };
  };
  auto above = [](std::span<const double> x, std::span<double> g) {
    if (!g.empty()) g[0] = -1;
    return 3 - x[0];
  };
  problem.constraints = {{"wear", below(2)}, {"lift", above}};
  const MinimizeResult r = minimize(problem, {4}, {.algorithm = "LN_COBYLA", .evaluations = 1000});
  CHECK_FALSE(r.feasible);
  CHECK(r.x[0] == Approx(2.5).margin(1e-3));
  CHECK(contains(r.message, "where a constraint is exceeded by 0.5"));
}

TEST_CASE("an unknown algorithm is answered with the nearest and the known names") {
  const std::vector<std::pair<const char*, const char*>> words{{"LD_SLSPQ", "LD_SLSQP"},
                                                               {"slsqp", "LD_SLSQP"},
                                                               {"ln_bobyqa", "LN_BOBYQA"},
                                                               {"LN_COBILA", "LN_COBYLA"}};
  for (const auto& [word, meant] : words) {
    const std::string error = minimize_error(rosenbrock(), {0, 0}, {.algorithm = word});
    INFO(error);
    CHECK(contains(
        error, std::string("no algorithm \"") + word + "\" in this NLopt; did you mean \"" + meant + "\"?"));
    for (const Algorithm& a : algorithms()) CHECK(contains(error, a.name));
  }
  CHECK_FALSE(
      contains(minimize_error(rosenbrock(), {0, 0}, {.algorithm = "gradient descent"}), "did you mean"));
  CHECK(contains(
      minimize_error(rosenbrock(), {0, 0}, {.algorithm = "AUGLAG", .local = LocalOptions{.algorithm = "LN"}}),
      "no algorithm \"LN\""));
}

TEST_CASE("bad input is answered with its numbers") {
  const double infinity = std::numeric_limits<double>::infinity();
  NonlinearProgram reversed = rosenbrock(), equal = rosenbrock(), open = rosenbrock(), empty = rosenbrock();
  reversed.lower[1] = 3;
  equal.lower[0] = equal.upper[0];
  open.upper[1] = infinity;
  empty.objective = nullptr;
  NonlinearProgram nan_bound = rosenbrock(), negative = hock_schittkowski_71(),
                   nameless = hock_schittkowski_71();
  nan_bound.lower[0] = std::nan("");
  negative.constraints[0].tolerance = -1;
  nameless.constraints[1].function = nullptr;

  struct Row {
    std::string error, expected;
  };
  const std::vector<double> x{0, 0}, y{1, 5, 5, 1};
  const Row rows[] = {
      {minimize_error(reversed, x), "bounds of variable 1 are [3, 2]: the lower must be below the upper"},
      {minimize_error(nan_bound, x),
       "bounds of variable 0 are [not a number, 2]: the lower must be below the upper"},
      {minimize_error(equal, x), "bounds of variable 0 are [2, 2]: equal bounds leave nothing to vary"},
      {minimize_error(open, x, {.algorithm = "GN_DIRECT"}),
       "bounds of variable 1 are [-2, inf]: GN_DIRECT is a global algorithm and needs finite bounds"},
      {minimize_error(empty, x), "the problem has no objective"},
      {minimize_error(rosenbrock(), {}), "the start has 0 variables"},
      {minimize_error(rosenbrock(), {0, 0, 0}),
       "the start has 3 variables, but there are 2 lower and 2 upper bounds"},
      {minimize_error(rosenbrock(), {0, std::nan("")}), "the start has variable 1 = not a number"},
      {minimize_error(hock_schittkowski_71(), y, {.algorithm = "LN_BOBYQA"}),
       "LN_BOBYQA does not support constraints, but there are 2; algorithms that do: "},
      {minimize_error(negative, y), "tolerance of constraint \"product\" is -1, must be finite and >= 0"},
      {minimize_error(nameless, y), "constraint \"square\" has no function"},
      {minimize_error(rosenbrock(), x, {.tolerances = {.x_relative = -1e-3}}),
       "tolerances.x_relative is -0.001, must be finite and >= 0"},
      {minimize_error(rosenbrock(), x, {.tolerances = {.f_absolute = infinity}}),
       "tolerances.f_absolute is inf"},
      {minimize_error(rosenbrock(), x, {.evaluations = 0}), "evaluations is 0, must be >= 1"},
      {minimize_error(rosenbrock(), x, {.seconds = -1}), "seconds is -1, must be finite and >= 0"},
      {minimize_error(rosenbrock(), x, {.target = std::nan("")}), "target is not a number, must be a number"},
      {minimize_error(rosenbrock(), x, {.population = -5}), "population is -5, must be >= 0"},
      {minimize_error(rosenbrock(), x, {.algorithm = "G_MLSL"}), "G_MLSL needs a local algorithm"},
      {minimize_error(rosenbrock(), x, {.local = LocalOptions{.algorithm = "LN_BOBYQA"}}),
       "a local algorithm is only for AUGLAG and MLSL, not for LD_SLSQP"},
      {minimize_error(
           rosenbrock(), x,
           {.algorithm = "G_MLSL", .local = LocalOptions{.algorithm = "LN_BOBYQA", .evaluations = -1}}),
       "local.evaluations is -1, must be >= 0"},
      {minimize_error(rosenbrock(), x,
                      {.algorithm = "G_MLSL",
                       .local = LocalOptions{.algorithm = "LN_BOBYQA", .tolerances = {.f_relative = -1}}}),
       "local.tolerances.f_relative is -1, must be finite and >= 0"},
  };
  for (const Row& row : rows) {
    INFO(row.error);
    CHECK(contains(row.error, row.expected));
  }
}

TEST_CASE("two threads do not disturb each other's random numbers") {
  auto run = [] {
    return minimize(six_hump_camel(), {1, 1}, {.algorithm = "GN_CRS2_LM", .evaluations = 2000});
  };
  const MinimizeResult alone = run();
  MinimizeResult first, second;
  std::thread a([&] { first = run(); }), b([&] { second = run(); });
  a.join();
  b.join();
  CHECK(first.x == alone.x);
  CHECK(second.x == alone.x);
}
