// The first point of a branch from guesses that may be far from it.
#include "catch.hpp"
#include "controls.hpp"
#include "random.hpp"
#include "textbook_systems.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <Eigen/LU>

#include <stdexcept>

using namespace arcslip::continuation;

namespace {

constexpr int guesses = 1000;

Matrix differences(const textbook::System& of, const Vector& u, const Vector& p) {
  Matrix J(of.size, of.size);
  Vector above(of.size), below(of.size), at = u;
  for (int j = 0; j < of.size; ++j) {
    const double step = 6e-6 * std::max(of.scale()[j], std::abs(u[j]));
    at[j] = u[j] + step;
    of.residual(at, p, above);
    at[j] = u[j] - step;
    of.residual(at, p, below);
    at[j] = u[j];
    J.col(j) = (above - below) / (2 * step);
  }
  return J;
}

double norm(const textbook::System& of, const Vector& u) {
  return u.cwiseQuotient(of.scale()).norm();
}

// The next correction of Newton's method.
Vector correction(const textbook::System& of, const Vector& u, const Vector& p) {
  Vector F(of.size);
  of.residual(u, p, F);
  return -differences(of, u, p).partialPivLu().solve(F);
}

bool undamped(const textbook::System& of, Vector u, const Vector& p) {
  for (int k = 0; k < 30; ++k) {
    const Vector du = correction(of, u, p);
    if (!du.allFinite() || du.norm() > 1e12) return false;
    if (norm(of, du) < 1e-9 * std::max(1e-6, norm(of, u))) return true;
    u += du;
  }
  return false;
}

Branch first_point(const std::shared_ptr<const Problem>& problem, const Vector& u, double p) {
  Options options{.lower = p - 1, .upper = p + 1};
  options.points = 1;
  options.check_jacobian = false;
  return trace(problem, {.u = u, .p = Vector{{p}}}, options);
}

}  // namespace

TEST_CASE("guesses of 24 textbook systems lead to a solution at least as often as Newton's method") {
  for (const textbook::System& system : textbook::systems()) {
    CAPTURE(system.name);
    const auto problem = system.problem();
    const Vector p = Vector{{system.p}};
    test_random::Random random(1);
    int by_newton = 0, found = 0, only_newton = 0;
    double worst = 0;
    for (int k = 0; k < guesses; ++k) {
      Vector u(system.size);
      for (double& each : u) each = random.between(system.lower, system.upper);
      u = u.cwiseProduct(system.scale());
      const bool newton = undamped(system, u, p);
      const Branch branch = first_point(problem, u, system.p);
      by_newton += newton;
      only_newton += newton && branch.points.empty();
      if (branch.points.empty()) continue;
      ++found;
      const Vector& solution = branch.points.front().u;
      worst = std::max(worst, norm(system, correction(system, solution, p)) / (1 + norm(system, solution)));
    }
    CHECK(only_newton == 0);
    CHECK(found >= by_newton);
    CHECK(found >= system.damped);
    CHECK(worst < 1e-8);
  }
}

TEST_CASE("a guess of a solution u = 0 leads to it, however far the unknowns have to fall") {
  for (const double scale : {1.0, 1e-3, 1e3})
    for (const double guess : {2.0, 1.0, 0.5, 0.1, 0.01, 1e-3, 1e-5}) {
      CAPTURE(scale, guess);
      Functions functions;
      functions.size = 1;
      functions.parameters = {{"p", "", 2}};
      functions.residual = [](In u, In p, Out F) { F[0] = p[0] * std::sinh(u[0]); };
      functions.scales = Vector{{scale}};
      const Branch branch = first_point(from_functions(std::move(functions)), Vector{{guess}}, 2);
      REQUIRE(branch.points.size() == 1);
      CHECK(std::abs(branch.points[0].u[0]) <= 1e-14 * scale);
    }
}

TEST_CASE("a start with a singular Jacobian that is no solution leads to one") {
  const auto problem =
      from_functions(1, {{"p", "", 1}}, [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0]; });
  const Branch branch = first_point(problem, Vector{{0.0}}, 1);
  REQUIRE(branch.points.size() == 1);
  CHECK(std::abs(std::abs(branch.points[0].u[0]) - 1) < 1e-12);
}

TEST_CASE("a start on a fold or a branch point, and one without a solution, are still refused") {
  const auto fold = from_functions(1, {{"p", "", 0}}, [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0]; });
  CHECK(first_point(fold, Vector{{0.0}}, 0).stop.reason == StopReason::start_failed);
  CHECK(first_point(fold, Vector{{0.5}}, 0).stop.reason == StopReason::start_failed);
  const auto pitchfork = from_functions(
      2, {{"p", "", 0}}, [](In u, In p, Out F) { F << p[0] * u[0] - std::pow(u[0], 3), u[1]; },
      [](In u, In p, Eigen::Ref<Matrix> J) { J << p[0] - 3 * u[0] * u[0], 0, 0, 1; });
  CHECK(first_point(pitchfork, Vector{{0.0, 0.0}}, 0).stop.reason == StopReason::start_failed);
  CHECK(first_point(fold, Vector{{0.5}}, -1).stop.reason == StopReason::start_failed);
}

TEST_CASE("a caller or a time limit ends the search for a first point, and the branch says which") {
  const auto none = from_functions(1, {{"p", "", 0}}, [](In u, In, Out F) { F[0] = 1 + u[0] * u[0]; });
  const Start start{.u = Vector{{0.3}}, .p = Vector{{0.0}}};
  Options options{.lower = -1, .upper = 1};
  long asked = 0, last = 5;
  const auto ask = [&] { return ++asked != last; };
  options.control = controls::polled(ask);
  const Branch stopped = trace(none, start, options);
  CHECK(stopped.stop.reason == StopReason::user);
  CHECK(asked == last);
  asked = 0, last = -1;
  options.control = controls::polled(ask);
  const Branch failed = trace(none, start, options);
  CHECK(failed.stop.reason == StopReason::start_failed);
  CHECK(asked > 5);
  options.newton.transient_steps = 0;
  CHECK(trace(none, start, options).counts.jacobians < failed.counts.jacobians);
  options.seconds = 1e-9;
  CHECK(trace(none, start, options).stop.reason == StopReason::time_limit);
}

TEST_CASE("a Jacobian that is wrong away from the guess is named where Newton's method failed") {
  const auto problem = from_functions(
      1, {{"p", "", 2}}, [](In u, In p, Out F) { F[0] = u[0] + std::pow(u[0], 3) - p[0]; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1 - 2 * u[0] * u[0]; }, {}, Vector{{10.0}});
  const Branch branch = trace(problem, {.u = Vector{{0.0}}, .p = Vector{{2.0}}}, {.lower = 0, .upper = 4});
  REQUIRE(branch.points.empty());
  CHECK(branch.stop.message.find("dF[0]/du[0] is given as") != std::string::npos);
}

TEST_CASE("a user's linear solver is used for the motions as well, and may throw there") {
  class Throws final : public PlainSolver {
   public:
    const char* name() const override { return "throws"; }
    bool prepare(const Jacobian&) override { throw std::runtime_error("no memory"); }
    bool solve(In, Out) const override { return false; }
  };
  const auto none = from_functions(1, {{"p", "", 0}}, [](In u, In, Out F) { F[0] = 1 + u[0] * u[0]; });
  Options options{.lower = -1, .upper = 1};
  options.linear_solver = [] { return block_elimination(std::make_unique<Throws>()); };
  const Branch branch = trace(none, {.u = Vector{{0.3}}, .p = Vector{{0.0}}}, options);
  CHECK(branch.stop.reason == StopReason::start_failed);
  CHECK(branch.stop.message.find("no memory") != std::string::npos);
}
