// Derivatives that are not those of F: reported at the start, or where Newton's method shows it, with the
// entry; and what only looks like it.

#include "catch.hpp"

#include "continuation/events/hopf_problems.hpp"

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

using namespace problems;

namespace {

// The Duffing oscillator by one harmonic. entry: of J by rows, 4 and 5: of dF/dw.
std::shared_ptr<const Problem> duffing_with_wrong_entry(int entry, double factor) {
  const double z = 0.05, a = 0.5, f = 0.3;
  const auto k_of = [=](In u, In p) { return 1 - p[0] * p[0] + 0.75 * a * u.squaredNorm(); };
  return from_functions(
      2, {parameter("w", 0.5)},
      [=](In u, In p, Out F) {
        const double k = k_of(u, p);
        F << k * u[0] + 2 * z * p[0] * u[1] - f, k * u[1] - 2 * z * p[0] * u[0];
      },
      [=](In u, In p, Eigen::Ref<Matrix> J) {
        J = k_of(u, p) * Matrix::Identity(2, 2) + 1.5 * a * u * u.transpose();
        J(0, 1) += 2 * z * p[0];
        J(1, 0) -= 2 * z * p[0];
        if (entry < 4) J(entry / 2, entry % 2) *= factor;
      },
      [=](In u, In p, int, Out dF) {
        dF << -2 * p[0] * u[0] + 2 * z * u[1], -2 * p[0] * u[1] - 2 * z * u[0];
        if (entry >= 4) dF[entry - 4] *= factor;
      });
}

const Start duffing_start{.u = Vector{{0.4, 0.0}}, .p = Vector{{0.5}}, .free = 0};

std::string entry_name(int entry) {
  if (entry >= 4) return "dF[" + std::to_string(entry - 4) + "]/d(w)";
  return "dF[" + std::to_string(entry / 2) + "]/du[" + std::to_string(entry % 2) + "]";
}

}  // namespace

TEST_CASE("a wrong entry of J or dF/dp is named, from 0.1 %, and no trace runs on for nothing") {
  for (const double factor : {1.001, 1.01, 0.9, 1.1, 1.5, 0.5, -1.0})
    for (int entry = 0; entry < 6; ++entry) {
      const Branch branch =
          trace(duffing_with_wrong_entry(entry, factor), duffing_start, window(0.5, 2), {fold_monitor()});
      CAPTURE(factor, entry, branch.stop.message, branch.counts.points, branch.counts.rejected_steps);
      REQUIRE(branch.warnings.size() == 1);
      CHECK(branch.warnings[0].find("the Jacobian is wrong: " + entry_name(entry)) == 0);
      CHECK(branch.counts.points < 500);
      CHECK(branch.counts.rejected_steps < 100);
      if (branch.stop.reason == StopReason::boundary) continue;
      CHECK(branch.stop.message.find("the Jacobian is wrong: " + entry_name(entry)) != std::string::npos);
    }
}

TEST_CASE("a Jacobian that is right is not doubted") {
  const Branch branch =
      trace(duffing_with_wrong_entry(0, 1), duffing_start, window(0.5, 2), {fold_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.warnings.empty());
}

TEST_CASE("wrong_jacobian: a branch that gets no further for its Jacobian says so, with the numbers") {
  const Branch branch = trace(duffing_with_wrong_entry(2, 1.5), duffing_start, window(0.5, 2));
  CHECK(branch.stop.reason == StopReason::wrong_jacobian);
  CHECK(branch.stop.limit == largest_jacobian_error);
  CHECK(branch.stop.value == Approx(1.0 / 3).epsilon(1e-3));
}

TEST_CASE("a Jacobian that is wrong only where the branch comes later is found there") {
  // u = sin 3p: at u = 0 the wrong term is none.
  const auto problem = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] + u[0] * u[0] * u[0] - 2 * p[0]; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1 + 2.9 * u[0] * u[0]; },
      [](In, In, int, Out dF) { dF[0] = -2; });
  const Branch branch = trace(problem, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, window(0, 1));
  REQUIRE(branch.warnings.size() == 1);
  CHECK(branch.warnings[0].find("the Jacobian is wrong: dF[0]/du[0]") == 0);
}

TEST_CASE("a Hopf point of a Jacobian that is wrong by 0.1 % comes with a warning") {
  const auto problem = from_functions(
      2, {parameter("B", 1)},
      [](In u, In p, Out F) {
        const double x2y = u[0] * u[0] * u[1];
        F << 1 - (p[0] + 1) * u[0] + x2y, p[0] * u[0] - x2y;
      },
      [](In u, In p, Eigen::Ref<Matrix> J) {
        const double xy = 2 * u[0] * u[1], x2 = u[0] * u[0];
        J << xy - p[0] - 1, x2, p[0] - xy, -1.001 * x2;
      });
  const Branch branch =
      trace(problem, {Vector{{1.0, 1.0}}, Vector{{1.0}}, 0, 1}, window(1, 3), hopf_monitors(*problem));
  REQUIRE(branch.events.size() == 1);
  CHECK(std::abs(branch.events[0].point.parameter - 2) > 5e-4);
  REQUIRE(branch.warnings.size() == 1);
  CHECK(branch.warnings[0].find("dF[1]/du[1] is given as -1.001, finite differences give -1 (at 1)") !=
        std::string::npos);
}

TEST_CASE("in 5000 unknowns the wrong entry is found with some 30 residuals") {
  const int n = 5000;
  Functions f = rod(n);
  const auto pattern = f.sparse_jacobian;
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    pattern(u, p, J);
    J.coeffRef(3141, 3142) *= 1.01;
  };
  auto residuals = std::make_shared<int>(0);
  f.residual = [residuals, F = f.residual](In u, In p, Out out) { ++*residuals, F(u, p, out); };
  const auto problem = from_functions(f);
  Vector u(n);
  for (int i = 0; i < n; ++i) u[i] = std::sin(0.01 * i);
  const JacobianError found = doubt_jacobian(*problem, u, Vector{{3.0}}, 0);
  CHECK(found.row == 3141);
  CHECK(found.column == 3142);
  CHECK(found.given == Approx(1.01));
  CHECK(found.difference == Approx(1).epsilon(1e-8));
  CHECK(*residuals < 80);
}

TEST_CASE("noise in F, as of single precision, accuses no right Jacobian, and hides no wrong one") {
  for (const double noise : {1e-12, 1e-9, 1e-7})
    for (const double factor : {1.0, 1.3}) {
      int accused = 0;
      for (int k = 0; k < 200; ++k) {
        const double u0 = 0.3 + 0.002 * k;
        const auto rough = [=](double x) {  // between -1 and 1, without a pattern
          return std::fmod(std::abs(std::sin(x * 1e9) * 43758.5453), 2.0) - 1;
        };
        const auto problem = from_functions(
            2, {parameter("p", 1)},
            [=](In u, In p, Out F) {
              F << u[0] * u[0] + u[1] - p[0] + noise * rough(u[0] + 2 * u[1]),
                  u[1] - std::sin(u[0]) * p[0] + noise * rough(u[0] - u[1]);
            },
            [=](In u, In p, Eigen::Ref<Matrix> J) { J << 2 * u[0] * factor, 1, -std::cos(u[0]) * p[0], 1; },
            [](In u, In, int, Out dF) { dF << -1, -std::sin(u[0]); });
        const JacobianError found = doubt_jacobian(*problem, Vector{{u0, 0.7}}, Vector{{1.0}}, 0);
        if (!found.message.empty()) ++accused;
        if (!found.message.empty() && factor != 1) CHECK((found.row == 0 && found.column == 0));
      }
      CAPTURE(noise, factor);
      CHECK(accused == (factor == 1 ? 0 : 200));
    }
}

TEST_CASE("a kink, with its pieces reported or not, accuses no right Jacobian") {
  for (const bool reported : {true, false})
    for (int k = -40; k <= 40; ++k) {
      const double at = k == 0 ? 0 : std::copysign(std::pow(10.0, -12 + 0.3 * std::abs(k)), k);
      Functions f;
      f.size = 1;
      f.parameters = {parameter("p", 0)};
      f.residual = [](In u, In p, Out F) { F[0] = (u[0] < 0 ? 1 : 3) * u[0] - p[0]; };
      f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = u[0] < 0 ? 1 : 3; };
      f.derivative = [](In, In, int, Out dF) { dF[0] = -1; };
      if (reported) f.piece = [](In u, In) { return u[0] < 0 ? 1 : 2; };
      CAPTURE(reported, at);
      CHECK(doubt_jacobian(*from_functions(f), Vector{{at}}, Vector{{0.0}}, 0).message.empty());
    }
}

TEST_CASE("unknowns and equations of extreme sizes accuse no right Jacobian, and hide no wrong one") {
  // F_i = e_i [c (x_i / s)^3 + x_i / s + (x_j / s) - p], x_i of size s, with a scale that is reported or left
  // at 1.
  for (const double s : {1e-12, 1e-6, 1.0, 1e6, 1e12})
    for (const bool reported : {true, false})
      for (const double factor : {1.0, 1.05}) {
        Functions f;
        f.size = 2;
        f.parameters = {parameter("p", 1)};
        if (reported) f.scales = Vector::Constant(2, s);
        f.residual = [=](In u, In p, Out F) {
          const double x = u[0] / s, y = u[1] / s;
          F << 1e9 * (x * x * x + y - p[0]), 1e-9 * (y - x - p[0]);
        };
        f.jacobian = [=](In u, In, Eigen::Ref<Matrix> J) {
          const double x = u[0] / s;
          J << 3e9 * x * x / s * factor, 1e9 / s, -1e-9 / s, 1e-9 / s;
        };
        f.derivative = [](In, In, int, Out dF) { dF << -1e9, -1e-9; };
        const JacobianError found =
            doubt_jacobian(*from_functions(f), Vector{{0.9 * s, 1.7 * s}}, Vector{{1.0}}, 0);
        CAPTURE(s, reported, factor, found.message);
        CHECK(found.message.empty() == (factor == 1));
        if (factor != 1) CHECK((found.row == 0 && found.column == 0));
      }
}

TEST_CASE("terms of p that cancel in F accuse no dF/dp by differences, which is their rounding") {
  // The voltage that a generator holds between its limits, Q - (Q + 1 - V) = 0, over the load.
  for (const bool is_sparse : {false, true})
    for (int k = 0; k < 200; ++k) {
      Functions f;
      f.size = 2;
      f.parameters = {parameter("load", 0, 4)};
      f.residual = [](In u, In p, Out F) {
        const double Q = 0.3 * u[1] + 0.7 * p[0];
        F << Q - (Q + 1 - u[0]), u[1] - 2;
      };
      if (is_sparse)
        f.sparse_jacobian = [](In, In, SparseMatrix& J) { J.setIdentity(); };
      else
        f.jacobian = [](In, In, Eigen::Ref<Matrix> J) { J.setIdentity(); };
      const JacobianError found =
          doubt_jacobian(*from_functions(f), Vector{{1.0, 2.0}}, Vector{{0.005 * k}}, 0);
      CAPTURE(is_sparse, k, found.message);
      CHECK(found.message.empty());
    }
}

TEST_CASE("curves of folds, whose Jacobians come from differences, are not doubted") {
  const Branch curve = trace(folds(cusp(), 0), {Vector{{-0.6, 0.4}}, Vector{{0.0, 1.0}}, 1, -1},
                             window(-1, 2), {cusp_monitor()});
  CHECK(curve.warnings.empty());
}

TEST_CASE("derivatives that are known to be right are not looked at where that is said") {
  Options options = window(0.5, 2);
  options.check_jacobian = false;
  const Branch branch = trace(duffing_with_wrong_entry(2, 1.001), duffing_start, options);
  CHECK(branch.warnings.empty());
}
