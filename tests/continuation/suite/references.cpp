#include "catch.hpp"

#include "continuation/suite/cases.hpp"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

using namespace suite;
using arcslip::continuation::Needs;
using arcslip::continuation::StopReason;

namespace {

constexpr bool known_to_fail(std::string_view name) {
  return name == "cell_kinetics";  // stops at a branch point: see branch_points.cpp
}

// The unknowns at the end of the branch of that case when unknown i is the parameter, from `from` to `to`.
arcslip::continuation::Point at_unknown(const ProblemPtr& problem, const Vector& u, int i, double to,
                                        int direction) {
  Vector start = u;
  Vector p = arcslip::continuation::parameter_values(*problem);
  std::swap(start[i], p[0]);
  const Branch branch = arcslip::continuation::trace(exchanged(problem, i, 0), {start, p, 0, direction},
                                                     window(std::min(u[i], to), std::max(u[i], to)));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  return branch.points.back();
}

}  // namespace

TEST_CASE("every fold of the suite that is known is found to the digits given, and no other") {
  for (const Case& c : cases()) {
    if (!c.folds || known_to_fail(c.name)) continue;
    CAPTURE(c.name);
    const Branch branch = trace(c);
    CHECK(branch.stop.reason == StopReason::boundary);
    const auto found = folds(branch);
    REQUIRE(found.size() == c.folds->size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(std::abs(found[i].point.parameter - (*c.folds)[i]) <= c.digits);
      CHECK(found[i].located);
      CHECK_FALSE(found[i].nonsmooth);
    }
  }
}

TEST_CASE("at every fold the Jacobian is singular and dF/dp is not in its range, by singular values") {
  for (const Case& c : cases()) {
    if (c.name == "circle") continue;  // turns on: see closed_forms.cpp
    for (const Event& fold : folds(trace(c))) {
      CAPTURE(c.name, fold.point.parameter);
      const auto at = c.problem->evaluator();
      Vector p = c.start.p;
      p[c.start.free.in(*c.problem)] = fold.point.parameter;
      at->move_to(fold.point.u, p, Needs::jacobian);
      const int n = c.problem->size();
      Eigen::MatrixXd J = std::get<Eigen::MatrixXd>(at->jacobian()) * c.problem->scales().asDiagonal();
      Vector by_p(n);
      at->parameter_derivative(c.start.free.in(*c.problem), by_p);
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const double largest = std::max(svd.singularValues()[0], by_p.norm());
      // u is found to 1e-10, and J changes at most so fast:
      CHECK(svd.singularValues()[n - 1] < 1e-7 * largest);
      CHECK(std::abs(svd.matrixU().col(n - 1).dot(by_p)) > 1e-6 * by_p.norm());
    }
  }
}

TEST_CASE(
    "the amplitudes at the folds of the Duffing oscillator in one harmonic are those of the closed form") {
  const auto found = folds(trace(named("duffing_1harmonic")));
  REQUIRE(found.size() == 2);
  CHECK(std::abs(found[0].point.u.norm() - 0.808418576) < 5e-10);
  CHECK(std::abs(found[1].point.u.norm() - 0.424611125) < 5e-10);
}

TEST_CASE("Chan's solution at alpha = 5 has LOCA's norm") {
  const Branch branch = trace(named("chan"));
  CHECK(branch.points.back().parameter == 5);
  CHECK(std::abs(branch.points.back().u.norm() - 203.1991024) < 1e-7);
}

TEST_CASE("the limit points of Freudenstein and Roth in x1 and in x3 are PITCON's in all components") {
  const auto in_x3 = folds(trace(named("freudenstein_roth")));
  REQUIRE(in_x3.size() == 2);
  CHECK(std::abs(in_x3[0].point.u[0] - 20.48586) < 5e-6);
  CHECK(std::abs(in_x3[0].point.u[1] + 0.8968053) < 5e-8);
  CHECK(std::abs(in_x3[1].point.u[0] - 61.02031) < 1e-5);
  CHECK(std::abs(in_x3[1].point.u[1] - 2.230139) < 5e-7);
  const auto in_x1 = folds(trace(named("freudenstein_roth_x1")));
  REQUIRE(in_x1.size() == 2);
  CHECK(std::abs(in_x1[0].point.u[0] - 0.2585779) < 5e-8);
  CHECK(std::abs(in_x1[0].point.u[1] + 1.741377) < 5e-7);
  CHECK(std::abs(in_x1[1].point.u[0] + 0.6638797) < 5e-8);
  CHECK(std::abs(in_x1[1].point.u[1] - 1.983801) < 5e-7);
}

TEST_CASE("the homotopies of Boggs and Broyden end at the solutions known") {
  for (const char* name : {"boggs_1", "boggs_3"}) {
    CAPTURE(name);
    const auto end = trace(named(name)).points.back();
    CHECK(end.parameter == 1);
    CHECK((end.u - Vector{{0.0, 1.0}}).norm() < 1e-10);
  }
  // a root of G, solved for directly to 30 digits; next to it lies (1/2, pi)
  const auto end = trace(named("broyden")).points.back();
  CHECK(end.parameter == 1);
  CHECK((end.u - Vector{{0.2994486924909, 2.836927770459}}).norm() < 1e-8);
}

TEST_CASE("Wacker's solutions with x3 = 1, and his limit point for A = 1, are those of TEST_CON") {
  const auto weak = at_unknown(wacker(0.1), Vector::Zero(3), 2, 1, 1);
  CHECK(std::abs(weak.u[0] - 1.147009) < 5e-7);
  CHECK(std::abs(weak.u[1] - 1.431931) < 5e-7);
  CHECK(std::abs(weak.u[2] - 1.084425) < 5e-7);
  const auto medium = at_unknown(wacker(0.5), Vector::Zero(3), 2, 1, 1);
  CHECK(std::abs(medium.u[0] - 0.2412182) < 5e-8);
  CHECK(std::abs(medium.u[1] - 0.4558247) < 5e-8);
  CHECK(std::abs(medium.u[2] - 0.4534797) < 5e-8);
  const auto found = folds(trace(named("wacker_1")));
  REQUIRE(found.size() == 1);
  CHECK(std::abs(found[0].point.u[0] + 0.07109918) < 5e-9);
  CHECK(std::abs(found[0].point.u[1] - 0.06921115) < 5e-9);
  CHECK(std::abs(found[0].point.u[2] - 0.5009694) < 5e-8);
}

TEST_CASE("the state at the limit points of Simpson's problem and of the trigger circuit is Melhem's") {
  CHECK(std::abs(folds(trace(named("simpson_exp"))).at(0).point.u[24] - 1.391598) < 1e-6);
  CHECK(std::abs(folds(trace(named("simpson_rational"))).at(0).point.u[24] - 2.272364) < 1e-6);
  const auto circuit = folds(trace(named("trigger_circuit")));
  const Vector first{{0.04936, 0.54735, 0.04944, 0.04944, 0.12920, 1.16602}};
  const Vector second{{0.23577, 0.66296, 0.23759, 0.23760, 0.62083, 9.60913}};
  REQUIRE(circuit.size() == 2);
  CHECK((circuit[0].point.u - first).cwiseAbs().maxCoeff() < 1e-4);
  CHECK((circuit[1].point.u - second).cwiseAbs().maxCoeff() < 2e-4);
}

TEST_CASE(
    "the limit points of Oden's frame in x1 and in x2 under a skew load are those solved for directly") {
  // F = 0 and the determinant of dF without that column = 0, to 40 digits, from TEST_CON's values.
  struct Known {
    double angle;
    int unknown;
    double value, other, load;
  };
  for (const Known& known : {Known{0.25, 0, 2.816912622064, 0.7396444295258, -2.348587258741},
                             Known{0.5, 0, 2.520899896677, 0.859852262663, -1.77434600925},
                             Known{1.0, 0, 2.210746869085, 0.9241649127631, -1.209753234497},
                             Known{0.25, 1, 1.424861300254, 1.83116620651, 0.3382671112122},
                             Known{0.5, 1, 1.453502911582, 1.697060647965, 0.6198218929464},
                             Known{1.0, 1, 1.555364020724, 1.534292587007, 1.175649228297}}) {
    CAPTURE(known.angle, known.unknown);
    const Branch branch = arcslip::continuation::trace(
        exchanged(oden(known.angle), known.unknown, 0), {Vector::Zero(2), Vector{{0.0, known.angle}}, 0, 1},
        window(-6, 6), {arcslip::continuation::fold_monitor()});
    const auto found = folds(branch);
    CHECK(std::any_of(found.begin(), found.end(), [&](const Event& fold) {
      return std::abs(fold.point.parameter - known.value) < 1e-11 &&
             std::abs(fold.point.u[1 - known.unknown] - known.other) < 1e-8 &&
             std::abs(fold.point.u[known.unknown] - known.load) < 1e-8;
    }));
  }
}

TEST_CASE("every branch of the suite costs less than 3.5 factorizations a point, its folds included") {
  for (const Case& c : cases()) {
    if (c.name == "powell_4") continue;  // no branch
    CAPTURE(c.name);
    const Branch branch = trace(c);
    CHECK(static_cast<double>(branch.counts.factorizations) <
          3.5 * static_cast<double>(branch.counts.points));
  }
}
