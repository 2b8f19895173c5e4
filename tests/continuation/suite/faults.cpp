// Problems that are wrong: what is said, and that no point is given which is no solution.

#include "catch.hpp"

#include "continuation/suite/cases.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

using namespace suite;
using arcslip::continuation::Evaluator;
using arcslip::continuation::from_functions;
using arcslip::continuation::Needs;
using arcslip::continuation::Point;
using arcslip::continuation::StopReason;
using arcslip::continuation::Tracer;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// u - p, whose residual, Jacobian and dF/dp are multiplied by functions of p.
using Factor = std::function<double(double)>;
ProblemPtr line(Factor F_by, Factor J_by = {}, Factor p_by = {}) {
  const auto at = [](const Factor& f, double p) { return f ? f(p) : 1.0; };
  return from_functions(
      1, {parameter("p", 0)}, [=](In u, In p, Out F) { F[0] = (u[0] - p[0]) * at(F_by, p[0]); },
      [=](In, In p, MatrixOut J) { J(0, 0) = at(J_by, p[0]); },
      [=](In, In p, int, Out dF) { dF[0] = -at(p_by, p[0]); });
}

Start at_zero() {
  return {Vector::Zero(1), Vector::Zero(1), 0, 1};
}

Factor beyond_half(double value) {
  return [value](double p) { return p > 0.5 ? value : 1.0; };
}

// The Duffing oscillator with spoilt derivatives.
ProblemPtr spoilt(std::function<void(MatrixOut)> J_by, double p_by) {
  const ProblemPtr good = duffing_1harmonic(0.1);
  const std::shared_ptr<Evaluator> at = good->evaluator();
  const auto all = good->parameters();
  return from_functions(
      2, {all.begin(), all.end()},
      [=](In u, In p, Out F) {
        at->move_to(u, p, Needs::residual);
        F = at->residual();
      },
      [=](In u, In p, MatrixOut J) {
        at->move_to(u, p, Needs::jacobian);
        J = std::get<Eigen::MatrixXd>(at->jacobian());
        J_by(J);
      },
      [=](In u, In p, int k, Out dF) {
        at->move_to(u, p, Needs::residual);
        at->parameter_derivative(k, dF);
        dF *= p_by;
      });
}

}  // namespace

TEST_CASE("an exception of the residual ends the branch with its words, and the points before it are kept") {
  const auto problem = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) {
    if (p[0] > 0.5) throw std::runtime_error("no such pressure");
    F[0] = u[0] - p[0];
  });
  Tracer tracer(problem, at_zero(), window(0, 1));
  while (tracer.step()) {
  }
  CHECK(tracer.branch().stop.reason == StopReason::not_evaluated);
  CHECK(tracer.branch().stop.message.find("no such pressure") != std::string::npos);
  CHECK(tracer.branch().points.size() > 10);
  CHECK(tracer.branch().points.back().parameter <= 0.5);
}

TEST_CASE("not_evaluated: NaN or infinity in the residual, the Jacobian or dF/dp ends the branch before it") {
  for (double bad : {not_a_number, infinity})
    for (const ProblemPtr& problem :
         {line(beyond_half(bad)), line({}, beyond_half(bad)), line({}, {}, beyond_half(bad))}) {
      const Branch branch = arcslip::continuation::trace(problem, at_zero(), window(0, 1));
      CHECK(branch.stop.reason == StopReason::not_evaluated);
      CHECK(branch.points.size() > 10);
      CHECK(branch.points.back().parameter <= 0.5);
      CHECK(branch.points.back().parameter > 0.499);
    }
}

TEST_CASE("one failed evaluation costs a shorter step and no more") {
  for (int bad : {10, 37, 100}) {
    auto calls = std::make_shared<int>(0);
    const auto problem = line([=](double) { return ++*calls == bad ? not_a_number : 1; });
    const Branch branch = arcslip::continuation::trace(problem, at_zero(), window(0, 1));
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.counts.rejected_steps <= 1);
  }
}

TEST_CASE("a problem without unknowns is refused where it is made") {
  CHECK_THROWS_AS(from_functions(0, {parameter("p", 0)}, [](In, In, Out) {}), std::invalid_argument);
}

TEST_CASE("a start far from all solutions leads to the branch") {
  const auto from = [](double guess) {
    return arcslip::continuation::trace(duffing_1harmonic(0.1),
                                        {Vector::Constant(2, guess), Vector{{1.2, 0.1, 0.1, 1.0}}, 0, 1},
                                        window(0.5, 1.6));
  };
  const Branch near = from(0.1), far = from(1e8);
  CHECK(far.stop.reason == StopReason::boundary);
  REQUIRE(!far.points.empty());
  CHECK((far.points.back().u - near.points.back().u).norm() < 1e-12);
}

TEST_CASE("a wrong derivative may end the branch, but every point and every fold given is a solution") {
  struct Wrong {
    const char* what;
    std::function<void(MatrixOut)> J_by;
    double p_by;
  };
  const auto right = [](MatrixOut) {};
  for (const Wrong& wrong :
       {Wrong{"sign of J", [](MatrixOut J) { J *= -1; }, 1}, Wrong{"2 J", [](MatrixOut J) { J *= 2; }, 1},
        Wrong{"J / 2", [](MatrixOut J) { J /= 2; }, 1}, Wrong{"1.01 J", [](MatrixOut J) { J *= 1.01; }, 1},
        Wrong{"an entry missing", [](MatrixOut J) { J(0, 1) = 0; }, 1},
        Wrong{"sign of an entry", [](MatrixOut J) { J(0, 1) *= -1; }, 1}, Wrong{"sign of dF/dp", right, -1},
        Wrong{"2 dF/dp", right, 2}, Wrong{"dF/dp / 2", right, 0.5}, Wrong{"no dF/dp", right, 0}}) {
    CAPTURE(wrong.what);
    Case c = named("duffing_1harmonic");
    c.problem = spoilt(wrong.J_by, wrong.p_by);
    const Branch branch = trace(c);
    const auto good = duffing_1harmonic(0.1)->evaluator();
    const auto residual = [&](const Point& point) {
      Vector p = c.start.p;
      p[0] = point.parameter;
      good->move_to(point.u, p, Needs::residual);
      return good->residual().norm();
    };
    double worst = 0;
    for (const Point& point : branch.points) worst = std::max(worst, residual(point));
    for (const Event& event : branch.events) worst = std::max(worst, residual(event.point));
    CHECK(worst < 1e-8);
    for (const Event& event : folds(branch)) {
      const double w = event.point.parameter;
      CHECK(std::min(std::abs(w - 1.227095772), std::abs(w - 1.157717746)) < 1e-8);
    }
    if (branch.stop.reason == StopReason::boundary) CHECK(folds(branch).size() == 2);
  }
}
