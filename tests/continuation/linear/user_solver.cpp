// A linear solver of the user's that solves with J alone, forward: what its branches still have.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

#include <Eigen/LU>

using namespace problems;

namespace {

class ForwardOnly final : public PlainSolver {
 public:
  const char* name() const override { return "the user's"; }
  bool prepare(const Jacobian& J) override {
    lu_.compute(std::get<Matrix>(J));
    return true;
  }
  bool solve(In b, Out x) const override {
    x = lu_.solve(b);
    return x.allFinite();
  }

 private:
  Eigen::PartialPivLU<Matrix> lu_;
};

std::unique_ptr<LinearSolver> around_forward_only() {
  return block_elimination(std::make_unique<ForwardOnly>());
}

}  // namespace

TEST_CASE(
    "a solver of J alone, without a transpose, gives Chan's folds with right null vector and curvature") {
  const Start start{Vector::Zero(100), Vector::Zero(1), 0, 1};
  const Branch dense = trace(chan(100), start, window(0, 5), {fold_monitor()});
  Options options = window(0, 5);
  options.linear_solver = around_forward_only;
  const Branch branch = trace(chan(100), start, options, {fold_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.linear_solver.find("the user's") != std::string::npos);
  REQUIRE(branch.events.size() == 2);
  REQUIRE(dense.events.size() == 2);
  CHECK(std::abs(branch.events[0].point.parameter - 4.06755724) < 1e-8);
  CHECK(std::abs(branch.events[1].point.parameter - 3.16019522) < 1e-8);
  for (std::size_t k : {0u, 1u}) {
    const Fold& fold = std::get<Fold>(branch.events[k].data);
    const Fold& with_transpose = std::get<Fold>(dense.events[k].data);
    CHECK(fold.left_null.size() == 0);
    CHECK(with_transpose.left_null.size() == 100);
    CHECK((fold.right_null - with_transpose.right_null).norm() < 1e-7);
    CHECK(fold.curvature == Approx(with_transpose.curvature).epsilon(1e-6));
  }
}

TEST_CASE("and curves of folds too, by Newton's steps in the directions of forward solves") {
  const Vector p{{0.0, 1.0}};
  const double x = -std::sqrt(1.0 / 3);
  const Branch curve = trace(folds(cusp(), 0, around_forward_only), {Vector{{x, x * x * x - x}}, p, 1, -1},
                             window(-1, 2), {cusp_monitor()});
  CHECK(curve.stop.reason == StopReason::boundary);
  REQUIRE(curve.events.size() == 1);
  for (const Point& point : curve.points) CHECK(std::abs(point.u[1] + 2 * std::pow(point.u[0], 3)) < 1e-10);
}
