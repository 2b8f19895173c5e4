// One test for each StopReason.

#include "catch.hpp"
#include "controls.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include "continuation/problems.hpp"

#include <cstring>
#include <limits>

using namespace problems;

namespace {

std::shared_ptr<const Problem> one_equation(ResidualFunction f) {
  return from_functions(1, {parameter("p", 0)}, f);
}

}  // namespace

TEST_CASE("boundary: a branch that reaches the window's end stops exactly there") {
  const Branch branch =
      trace(one_equation([](In u, In p, Out F) { F[0] = u[0] - p[0] * p[0]; }), at(0, 0), window(0, 2));
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.points.back().parameter == 2);
  CHECK(std::abs(branch.points.back().u[0] - 4) < 1e-14);
  CHECK(branch.stop.message == "reached the end of the window at 2");
}

TEST_CASE("boundary: nor does a branch go beyond the bounds of its parameter") {
  const auto problem =
      from_functions(1, {{"p", "", 0, 1, -0.5, 0.75}}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  for (int direction : {-1, 1}) {
    const Branch branch = trace(problem, {Vector::Zero(1), Vector::Zero(1), 0, direction}, window(-2, 2));
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == (direction < 0 ? -0.5 : 0.75));
  }
}

TEST_CASE("event: a bound of an unknown ends the branch exactly there") {
  const Branch branch = trace(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1),
                              {bound_monitor("x = 0.25", 0, 0.25)});
  CHECK(branch.stop.reason == StopReason::event);
  CHECK(std::abs(branch.points.back().u[0] - 0.25) < 1e-12);
  CHECK(branch.stop.message.find("reached the terminal event \"x = 0.25\"") == 0);
}

TEST_CASE("start_failed: no solution near the start is said, and there are no points") {
  const Branch branch =
      trace(one_equation([](In u, In, Out F) { F[0] = 1 + u[0] * u[0]; }), at(0.5, 0), window(0, 1));
  CHECK(branch.stop.reason == StopReason::start_failed);
  CHECK(branch.stop.value > branch.stop.limit);
  CHECK(branch.points.empty());
}

TEST_CASE("start_failed: a singular start is said") {
  const Branch branch =
      trace(one_equation([](In u, In, Out F) { F[0] = 0 * u[0]; }), at(0.5, 0), window(0, 1));
  CHECK(branch.stop.reason == StopReason::start_failed);
  CHECK(branch.stop.message.starts_with(
      "the linearization at the start is singular; the solutions here are not"));
  CHECK(branch.points.empty());
}

TEST_CASE("wrong_jacobian: a Jacobian that becomes wrong ends the branch and keeps what there is") {
  const auto problem = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - std::sin(3 * p[0]); },
      [](In, In p, Eigen::Ref<Eigen::MatrixXd> J) { J(0, 0) = p[0] > 0.5 ? -0.4 : 1; });
  const Branch branch = trace(problem, at(0, 0), window(0, 1));
  CHECK(branch.stop.reason == StopReason::wrong_jacobian);
  CHECK(branch.stop.value > branch.stop.limit);
  CHECK(branch.points.size() > 10);
  CHECK(branch.stop.message.find(
            "the Jacobian is wrong: dF[0]/du[0] is given as -0.4, finite differences give 1") !=
        std::string::npos);
}

TEST_CASE("step_too_small: a corner that reports no pieces ends the branch") {
  const Branch branch =
      trace(from_functions(
                1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = p[0] + std::abs(u[0]) - 0.5; },
                [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = u[0] < 0 ? -1 : 1; }),
            at(-0.5, 0), window(-1, 1));
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason == StopReason::step_too_small);
  CHECK(branch.stop.value < branch.stop.limit);
  CHECK(branch.points.size() > 10);
  CHECK(branch.warnings.empty());
}

TEST_CASE("state_too_large: a pole is followed to the limit of the state and no further") {
  Options options = window(0, 2);
  options.largest_state = 1e9;
  const Branch branch =
      trace(one_equation([](In u, In p, Out F) { F[0] = u[0] * (1 - p[0]) - 1; }), at(1, 0), options);
  CHECK(branch.stop.reason == StopReason::state_too_large);
  CHECK(branch.stop.value > 1e9);
  CHECK(std::abs(branch.points.back().parameter - 1) < 1e-8);
  for (const Point& point : branch.points) CHECK(point.parameter < 1);
}

TEST_CASE("point_limit: as many points as asked for") {
  Options options = window(0, 2);
  options.points = 7;
  const Branch branch = trace(one_equation([](In u, In p, Out F) { F[0] = u[0] - p[0]; }), at(0, 0), options);
  CHECK(branch.stop.reason == StopReason::point_limit);
  CHECK(branch.points.size() == 7);
}

TEST_CASE("time_limit: a trace that takes longer stops with the points that it has") {
  Options options = window(0, 2);
  options.seconds = 1e-9;
  const Branch branch = trace(one_equation([](In u, In p, Out F) { F[0] = u[0] - p[0]; }), at(0, 0), options);
  CHECK(branch.stop.reason == StopReason::time_limit);
  CHECK(branch.stop.value >= branch.stop.limit);
  CHECK(branch.points.size() == 1);
}

TEST_CASE("memory_limit: points fill the memory allowed, and without their unknowns ten times as many do") {
  const auto problem = chan(200);
  Options options = window(0, 5);
  options.memory = 20000;
  const Start start{Vector::Zero(200), Vector::Zero(1), 0, 1};
  const Branch full = trace(problem, start, options);
  CHECK(full.stop.reason == StopReason::memory_limit);
  options.keep_points = false;
  const Branch thin = trace(problem, start, options);
  CHECK(thin.points.size() > 10 * full.points.size());
  CHECK(thin.points[3].u.size() == 0);
  CHECK(thin.points[3].parameter == full.points[3].parameter);
}

TEST_CASE("event: a terminal monitor ends the branch at its first zero") {
  Monitor fold = fold_monitor();
  fold.terminal = true;
  const Monitor zero{"x = -0.9", [](const Accepted& now) { return now.u[0] + 0.9; }};
  const Branch branch =
      trace(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1), {zero, fold});
  CHECK(branch.stop.reason == StopReason::event);
  CHECK(branch.stop.message == "reached the terminal event \"fold\" at 0.3849001795");
  REQUIRE(branch.events.size() == 2);
  CHECK(branch.events[0].monitor == "x = -0.9");
  CHECK(branch.points.back().parameter == branch.events[1].point.parameter);
}

TEST_CASE("not_evaluated: what a residual throws ends the branch, which keeps its points, and is said") {
  const auto problem = one_equation([](In u, In p, Out F) {
    if (p[0] > 0.5) throw std::runtime_error("no material beyond 0.5");
    F[0] = u[0] - p[0];
  });
  const Branch branch = trace(problem, at(0, 0), window(0, 2));
  CHECK(branch.stop.reason == StopReason::not_evaluated);
  CHECK(branch.points.size() > 10);
  CHECK(branch.stop.message ==
        "the problem could not be evaluated at the next point, even with the smallest step: no material "
        "beyond 0.5");
  const Branch nothing = trace(problem, at(0.7, 0.7), window(0, 2));
  CHECK(nothing.stop.message == "the problem could not be evaluated at the start: no material beyond 0.5");
}

TEST_CASE("not_evaluated: what the piece or the linear solver throws ends the branch and is said") {
  class Weary final : public LinearSolver {
   public:
    explicit Weary(bool when_solving) : when_solving_(when_solving) {}
    const char* name() const override { return "weary"; }
    bool factorize(const Jacobian& J, const Borders& borders) override {
      if (!when_solving_ && std::get<Matrix>(J)(0, 0) > 1.5) throw std::runtime_error("out of licences");
      steep_ = std::get<Matrix>(J)(0, 0) > 1.5;
      return lu_->factorize(J, borders);
    }
    void solve(Out x) const override {
      if (when_solving_ && steep_) throw std::runtime_error("out of licences");
      lu_->solve(x);
    }

   private:
    std::unique_ptr<LinearSolver> lu_ = dense_lu();
    bool when_solving_, steep_ = false;
  };
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", 0)};
  f.residual = [](In u, In p, Out F) { F[0] = u[0] + u[0] * u[0] / 2 - p[0]; };  // J = 1.5 at p = 5/8
  f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1 + u[0]; };
  for (const bool when_solving : {false, true}) {
    Options options = window(0, 2);
    options.linear_solver = [=] { return std::make_unique<Weary>(when_solving); };
    const Branch branch = trace(from_functions(f), at(0, 0), options, {fold_monitor()});
    CHECK(branch.stop.reason == StopReason::not_evaluated);
    CHECK(branch.stop.message.find("out of licences") != std::string::npos);
    CHECK(branch.points.back().parameter == Approx(0.625).margin(1e-6));
  }
  f.piece = [](In, In p) {
    return p[0] > 0.5 ? throw std::runtime_error("no contact law beyond 0.5") : std::uint64_t{1};
  };
  const Branch branch = trace(from_functions(f), at(0, 0), window(0, 2), {kink_monitor()});
  CHECK(branch.stop.reason == StopReason::not_evaluated);
  CHECK(branch.stop.message.find("no contact law beyond 0.5") != std::string::npos);
  CHECK(branch.points.back().parameter == Approx(0.5).margin(1e-6));
  const Branch nothing = trace(from_functions(f), at(0.7, 0.7), window(0, 2));
  CHECK(nothing.stop.message == "the problem could not be evaluated at the start: no contact law beyond 0.5");
}

TEST_CASE("monitor_failed: what any function of a monitor throws ends the branch, which keeps its points") {
  const auto line = one_equation([](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  const auto value = [](const Accepted& now) { return now.u[0] - 0.25; };
  const auto beyond = [](double p) {
    return [=](const Accepted& now) {
      if (now.parameter > p) throw std::runtime_error("no such temperature");
      return now.u[0];
    };
  };
  const Monitor by_value{"heat", beyond(0.5)};
  Monitor by_quantity{"heat", [=](const Accepted& now) { return value(now) * now.tangent[0]; }};
  Monitor by_data{"heat", value}, by_look{"heat", value};
  by_quantity.quantity = [=](const Accepted& now) { return beyond(0.5)(now) * (now.u[0] / 2 - 0.25); };
  by_data.describe = [=](const Accepted& now) { return static_cast<void>(beyond(0.2)(now)), EventData{}; };
  by_look.is_event = [=](const Accepted& now) { return beyond(0.2)(now) > 0; };
  for (const Monitor& monitor : {by_value, by_quantity, by_data, by_look}) {
    const Branch branch = trace(line, at(0, 0), window(0, 1), {fold_monitor(), monitor});
    CAPTURE(branch.stop.message);
    CHECK(branch.stop.reason == StopReason::monitor_failed);
    CHECK(branch.stop.message.starts_with("the monitor \"heat\" threw at 0."));
    CHECK(branch.stop.message.ends_with(": no such temperature"));
    CHECK(branch.stop.value >= 0.2);
    CHECK(branch.points.size() > 10);
    CHECK(branch.points.back().parameter <= 0.5);
  }
  const Branch at_start = trace(line, at(0.75, 0.75), window(0, 1), {by_value});
  CHECK(at_start.stop.message == "the monitor \"heat\" threw at 0.75: no such temperature");
  CHECK(at_start.points.size() == 1);
}

TEST_CASE("a monitor that is not a number somewhere is named once, and the branch goes on") {
  const auto line = one_equation([](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  const Monitor root{"root", [](const Accepted& now) { return std::sqrt(0.5 - now.u[0]) - 0.5; }};
  const Monitor slope{
      "slope", [](const Accepted& now) { return 0.1 - now.u[0]; }, Crossing::any,
      [](const Accepted& now) { return now.u[0] > 0.9 ? std::nan("") : (0.1 - now.u[0] / 2) * now.u[0]; }};
  const Branch branch = trace(line, at(0, 0), window(0, 1), {root, fold_monitor(), slope});
  CHECK(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 2);
  CHECK(std::abs(branch.events[0].point.u[0] - 0.1) < 1e-9);
  CHECK(std::abs(branch.events[1].point.u[0] - 0.25) < 1e-12);
  REQUIRE(branch.warnings.size() == 2);
  CHECK(branch.warnings[0].starts_with("the monitor \"root\" is not a number at 0.5"));
  CHECK(branch.warnings[1].starts_with("the monitor \"slope\" is not a number at 0.9"));

  // Its zero at 1/2, where it is no number within 1e-3, is not located; what stands for it says so.
  const Monitor gap{"gap", [](const Accepted& now) {
                      return std::abs(now.u[0] - 0.5) < 1e-3 ? std::nan("") : now.u[0] - 0.5;
                    }};
  const Branch across = trace(line, at(0.013, 0.013), window(0, 1), {gap});
  REQUIRE(across.events.size() == 1);
  CHECK_FALSE(across.events[0].located);
  REQUIRE(across.warnings.size() == 1);
  CHECK(across.warnings[0].starts_with("the event \"gap\" is not located near 0."));
  CHECK(trace(line, at(0, 0), window(0, 1), {fold_monitor()}).warnings.empty());
}

TEST_CASE("user: the observer stops the branch, at a point or at an event") {
  int calls = 0;
  const Branch at_point = trace(one_equation([](In u, In p, Out F) { F[0] = u[0] - p[0]; }), at(0, 0),
                                window(0, 2), {}, [&](const Accepted&, const Event*) { return ++calls < 5; });
  CHECK(at_point.stop.reason == StopReason::user);
  CHECK(at_point.points.size() == 5);
  const Branch at_event = trace(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1),
                                {fold_monitor()}, [](const Accepted&, const Event* event) { return !event; });
  CHECK(at_event.stop.reason == StopReason::user);
  CHECK(at_event.events.size() == 1);
}

TEST_CASE("user: a trace is asked whether to go on before each attempt, where all are rejected, too") {
  // No residual beyond 0.7: steps are rejected until they are too small.
  const auto problem = one_equation([](In u, In p, Out F) { F[0] = u[0] - std::sqrt(0.7 - p[0]); });
  Options options = window(0, 2);
  long asked = 0;
  options.control = controls::polled([&] { return ++asked > 0; });
  const Branch whole = trace(problem, at(std::sqrt(0.7), 0), options);
  CHECK(asked >= whole.counts.points - 1 + whole.counts.rejected_steps);
  const long last = asked;
  asked = 0;
  options.control = controls::polled([&] { return ++asked < last; });
  const Branch stopped = trace(problem, at(std::sqrt(0.7), 0), options);
  CHECK(stopped.stop.reason == StopReason::user);
  CHECK(stopped.points.size() == whole.points.size());
  CHECK(asked == last);
  options.control = controls::stopped();
  CHECK(trace(problem, at(std::sqrt(0.7), 0), options).points.size() == 1);
}

TEST_CASE("not_evaluated: a residual that cannot be evaluated ahead ends the branch where it can") {
  const Branch branch = trace(one_equation([](In u, In p, Out F) { F[0] = u[0] - std::sqrt(0.7 - p[0]); }),
                              at(std::sqrt(0.7), 0), window(0, 2));
  CHECK(
      (branch.stop.reason == StopReason::not_evaluated || branch.stop.reason == StopReason::step_too_small));
  CHECK(branch.points.size() > 10);
  CHECK(branch.points.back().parameter <= 0.7);
  CHECK(std::abs(branch.points.back().parameter - 0.7) < 1e-3);
}

TEST_CASE("not_evaluated: nor can a start outside the domain") {
  const Branch branch =
      trace(one_equation([](In u, In, Out F) { F[0] = std::log(u[0]); }), at(-1, 0), window(0, 2));
  CHECK(branch.stop.reason == StopReason::not_evaluated);
  CHECK(branch.points.empty());
}

TEST_CASE("every stop reason has a name of its own") {
  const StopReason all[] = {
      StopReason::boundary,      StopReason::closed,         StopReason::event,
      StopReason::start_failed,  StopReason::step_too_small, StopReason::state_too_large,
      StopReason::point_limit,   StopReason::time_limit,     StopReason::memory_limit,
      StopReason::user,          StopReason::not_evaluated,  StopReason::monitor_failed,
      StopReason::wrong_jacobian};
  for (StopReason a : all) {
    CHECK(std::strcmp(name(a), "unknown") != 0);
    for (StopReason b : all) CHECK((a == b) == (std::strcmp(name(a), name(b)) == 0));
  }
}

namespace {

// u - p = 0 for one unknown, said by a problem of `size` unknowns whose residual has as many entries as it
// likes.
class Odd final : public Problem {
 public:
  Odd(int size, double grows_beyond) : size_(size), grows_beyond_(grows_beyond) {}
  int size() const override { return size_; }
  std::span<const Parameter> parameters() const override { return parameters_; }
  Vector scales() const override { return Vector::Ones(size_); }
  std::unique_ptr<Evaluator> evaluator() const override { return std::make_unique<At>(grows_beyond_); }

 private:
  class At final : public Evaluator {
   public:
    explicit At(double grows_beyond) : grows_beyond_(grows_beyond) {}
    Evaluated move_to(In u, In p, Needs) override {
      F_ = Vector::Constant(p[0] > grows_beyond_ ? 2 : 1, u[0] - p[0]);
      return Evaluated::ok;
    }
    const Vector& residual() const override { return F_; }
    const Jacobian& jacobian() const override { return J_; }
    void parameter_derivative(int, Out dF) const override { dF[0] = -1; }

   private:
    double grows_beyond_;
    Vector F_;
    Jacobian J_ = Matrix(Matrix::Ones(1, 1));
  };
  int size_;
  double grows_beyond_;
  std::vector<Parameter> parameters_{parameter("p", 0)};
};

}  // namespace

TEST_CASE("not_evaluated: a residual of another size ends the branch and is said") {
  const Branch branch = trace(std::make_shared<Odd>(1, 0.5), at(0, 0), window(0, 1));
  CHECK(branch.stop.reason == StopReason::not_evaluated);
  CHECK(branch.stop.message.find("the residual has 2 entries for 1 unknowns") != std::string::npos);
  CHECK(branch.points.size() > 10);
}

TEST_CASE("a problem without unknowns, and a free parameter that there is none, are refused") {
  CHECK_THROWS_WITH(trace(std::make_shared<Odd>(0, 1), {Vector(), Vector::Zero(1), 0, 1}, window(0, 1)),
                    "the problem has no unknowns");
  CHECK_THROWS_WITH(
      trace(std::make_shared<Odd>(1, 1), {Vector::Zero(1), Vector::Zero(1), 3, 1}, window(0, 1)),
      "the free parameter has index 3, but the problem has 1 parameter, with index 0");
}

TEST_CASE("scales that are not positive are refused before anything is traced") {
  const auto line = [](double scale) {
    return from_functions(1, {parameter("p", 0, scale)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  };
  CHECK_NOTHROW(trace(line(1), at(0, 0), window(0, 1)));
  CHECK_NOTHROW(trace(line(0), at(0, 0), window(0, 1)));
  CHECK_THROWS_WITH(trace(line(-2), at(0, 0), window(0, 1)),
                    "the scale of the parameter \"p\" is -2, must be positive and finite, or 0 for the width "
                    "of its window");
  for (double scale : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(trace(line(scale), at(0, 0), window(0, 1)), std::invalid_argument);
}
