// Curves of folds in two parameters, against closed forms and published points.

#include "catch.hpp"

#include "continuation/linear/users_solvers.hpp"
#include "continuation/suite/cases.hpp"
#include "continuation/suite/problems.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

using namespace suite;
using namespace arcslip::continuation;

namespace {

int index(const ProblemPtr& problem, const char* name) {
  return parameter_index(*problem, name);
}

// The curve through the k-th fold of a case, in its free parameter, over another one.
Branch curve_of(const Case& c, std::size_t k, const char* other, int direction, const Options& options,
                std::vector<Monitor> monitors) {
  const Branch branch = suite::trace(c);
  const auto found = suite::folds(branch);
  REQUIRE(found.size() > k);
  return arcslip::continuation::trace(
      folds(c.problem, c.start.free.in(*c.problem)),
      {with_parameter(found[k].point), c.start.p, index(c.problem, other), direction}, options,
      std::move(monitors));
}

std::vector<Event> named_events(const Branch& branch, const std::string& name) {
  std::vector<Event> found;
  for (const Event& event : branch.events)
    if (event.monitor == name) found.push_back(event);
  return found;
}

}  // namespace

TEST_CASE(
    "the folds of the reaction ab meet in the cusp of AUTO's manual, and pass its Bogdanov-Takens point") {
  const Case c = named("ab");
  for (std::size_t k : {0u, 1u}) {
    const Branch curve = curve_of(c, k, "p3", 1, window(1.5, 3), {cusp_monitor(), bogdanov_takens_monitor()});
    CAPTURE(k, curve.stop.message);
    CHECK(curve.stop.reason == StopReason::boundary);
    const auto cusps = named_events(curve, "cusp"), takens = named_events(curve, "bogdanov_takens");
    REQUIRE(cusps.size() == 1);
    CHECK(std::abs(cusps[0].point.u[2] - 0.1353352832) < 1e-10);
    CHECK(std::abs(cusps[0].point.parameter - 2.5) < 1e-10);
    REQUIRE(takens.size() == 1);
    CHECK(std::abs(takens[0].point.u[2] - 0.10954326764) < 1e-10);
    CHECK(std::abs(takens[0].point.parameter - 2.07318490371) < 1e-10);
  }
}

TEST_CASE("a solver without the sign of the determinant finds the same points on a curve of folds") {
  const Case c = named("ab");
  // On the curve p3 = 14 x (1 - x) - 1 of its folds, y = 1 / (1 - x).
  const double x = 0.08, y = 1 / (1 - x), p3 = 14 * x * (1 - x) - 1;
  Vector p = c.start.p;
  const int over = index(c.problem, "p3");
  p[over] = p3;
  const Branch curve =
      arcslip::continuation::trace(folds(c.problem, c.start.free.in(*c.problem), users::without_sign()),
                                   {Vector{{x, y, x / (1 - x) * std::exp(-y)}}, p, over, 1}, window(0.01, 3),
                                   {cusp_monitor(), bogdanov_takens_monitor()});
  CAPTURE(curve.stop.message);
  CHECK(curve.warnings.empty());
  const auto cusps = named_events(curve, "cusp"), takens = named_events(curve, "bogdanov_takens");
  REQUIRE(cusps.size() == 1);
  CHECK(std::abs(cusps[0].point.parameter - 2.5) < 1e-9);
  REQUIRE(!takens.empty());
  CHECK(std::abs(takens[0].point.parameter - 2.07318490371) < 1e-9);
}

TEST_CASE("the folds of the Duffing oscillator with one harmonic meet in a cusp at omega 1.0903, g 0.0516") {
  const Case c = named("duffing_1harmonic");
  for (std::size_t k : {0u, 1u}) {
    const Branch curve = curve_of(c, k, "g", -1, window(0.01, 0.2), {cusp_monitor()});
    CAPTURE(k, curve.stop.message);
    CHECK(curve.stop.reason == StopReason::boundary);
    const auto cusps = named_events(curve, "cusp");
    REQUIRE(cusps.size() == 1);
    CHECK(std::abs(cusps[0].point.u[2] - 1.090345535) < 1e-9);
    CHECK(std::abs(cusps[0].point.parameter - 0.0515845499) < 1e-10);
  }
}

TEST_CASE("the folds in Fn of the Duffing oscillator with a slider turn in omega at 1.9115, Fn 1.2153") {
  const Case c = named("duffing_jenkins_Fn_low");
  const Branch curve = curve_of(c, 0, "omega", -1, window(1.6, 2.2), {fold_monitor()});
  const auto turns = named_events(curve, "fold");
  REQUIRE(turns.size() >= 1);
  CHECK(std::abs(turns[0].point.parameter - 1.911489205) < 1e-9);
  // dF/dFn lies in the range of J where they turn.
  CHECK(turns[0].located);
  const Vector& u = turns[0].point.u;
  CHECK(std::abs(u[u.size() - 1] - 1.215318824) < 1e-8 * (1 + u.norm()));
}

TEST_CASE("a solver without transposed solves follows the same curve of folds") {
  class Forward final : public LinearSolver {
   public:
    const char* name() const override { return "dense LU, forward"; }
    bool factorize(const Jacobian& J, const Borders& borders) override { return lu_->factorize(J, borders); }
    void solve(Out x) const override { lu_->solve(x); }
    std::optional<int> determinant_sign() const override { return lu_->determinant_sign(); }

   private:
    std::unique_ptr<LinearSolver> lu_ = dense_lu();
  };
  const ProblemPtr problem = cusp();
  const int mu = index(problem, "mu"), lambda = index(problem, "lambda");
  const Vector p = parameter_values(*problem);
  const double x = -std::sqrt(1.0 / 3);
  const Branch curve = arcslip::continuation::trace(
      folds(problem, mu, [] { return std::make_unique<Forward>(); }),
      {Vector{{x, x * x * x - x}}, p, lambda, -1}, window(-1, 2), {cusp_monitor()});
  CHECK(curve.stop.reason == StopReason::boundary);
  for (const Point& point : curve.points) {
    CHECK(std::abs(point.parameter - 3 * point.u[0] * point.u[0]) < 1e-10);
    CHECK(std::abs(point.u[1] + 2 * std::pow(point.u[0], 3)) < 1e-10);
  }
  REQUIRE(named_events(curve, "cusp").size() == 1);
}

TEST_CASE("the augmented system of folds has the derivatives of its residual") {
  const Case c = named("ab");
  const auto augmented = folds(c.problem, c.start.free.in(*c.problem));
  for (const Vector& x : {Vector{{0.3, 0.6, 0.1}}, Vector{{0.7, 1.2, 0.09}}}) {
    const JacobianError worst = check_jacobian(*augmented, x, c.start.p);
    CAPTURE(worst.message);
    CHECK(worst.relative < 1e-4);
  }
}

TEST_CASE("monitors of fold curves are refused on other branches") {
  const Case c = named("ab");
  const Branch branch =
      arcslip::continuation::trace(c.problem, c.start, window(c.lower, c.upper), {cusp_monitor()});
  CHECK(branch.stop.reason == arcslip::continuation::StopReason::monitor_failed);
  CHECK(branch.stop.message.ends_with("this monitor is for curves of folds and of stationary points"));
  CHECK_THROWS_AS(folds(c.problem, 17), std::out_of_range);
}
