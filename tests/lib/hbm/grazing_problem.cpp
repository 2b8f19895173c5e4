#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/grazing_problem.hpp>

using namespace arcslip;
using continuation::Vector;

namespace {

// Of the paper's oscillator, stuck, in steady state at omega.
Vector stuck_response(const hbm::HbmProblem& problem, double omega) {
  const std::complex<double> X = 1.0 / std::complex<double>(21390 - 1.24 * omega * omega, 0.134 * omega);
  Vector u = Vector::Zero(problem.size());
  u[problem.harmonics().cosine_index(1)] = X.real();
  u[problem.harmonics().sine_index(1)] = -X.imag();
  return u;
}

}  // namespace

TEST_CASE("the paper's oscillator is at the slip limit where the stuck oscillator's amplitude is mu Fn/kd") {
  // h = kd A - mu Fn with A = f0/|k + kd - m w^2 + i c w|.
  const auto model = std::make_shared<const model::Model>(model::build(scenes::paper(7, 3)));
  const hbm::HbmProblem problem(model, model->harmonics, 1e-3, 1);
  for (const double w : {110.0, 125.0, 140.0}) {
    const Vector p = hbm::parameters_at(problem, w);
    const Vector stuck = stuck_response(problem, w);
    const auto near = hbm::corners_near(problem, stuck, p, 1e3);
    const double exact = 3500 * stuck.norm() - 1.5;
    REQUIRE_FALSE(near.empty());
    for (hbm::Corner corner : near) {
      const auto h = hbm::corner_excess(problem, corner, stuck, p);
      REQUIRE(h);
      CHECK(std::abs(*h - exact) < 1e-12);
    }
    CHECK(hbm::corners_near(problem, stuck, p, 0.99 * std::abs(exact) / 1.5).empty());
    CHECK_FALSE(hbm::corners_near(problem, stuck, p, 1.01 * std::abs(exact) / 1.5).empty());
  }
}

TEST_CASE("a corner is where a slip phase is born, whichever reversals it lies between") {
  // On one side a phase of zero length is there, on the other none: the piece changes from h < 0 to h > 0.
  for (const bool even : {false, true}) {
    const auto model = std::make_shared<const model::Model>(model::build(scenes::chain(4, even)));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    const int n = problem.size();
    std::srand(3);
    int crossed = 0;
    for (int trial = 0; trial < 40; ++trial) {
      const Vector u = 2 * Vector::Random(n), p = hbm::parameters_at(problem, 0.8);
      for (hbm::Corner corner : hbm::corners_near(problem, u, p, 0.2)) {
        Vector dh(n), at = u;
        for (int k = 0; k < 8; ++k) {  // onto h = 0
          const auto h = hbm::corner_excess(problem, corner, at, p);
          if (!h) break;
          hbm::corner_gradient(problem, corner, at, p, dh);
          at -= *h / dh.squaredNorm() * dh;
        }
        const auto h = hbm::corner_excess(problem, corner, at, p);
        if (!h || std::abs(*h) > 1e-13) continue;
        const auto evaluator = problem.hbm_evaluator();
        const auto slip_phases = [&](double side) {
          evaluator->move_to(at + side * 1e-7 / dh.norm() * dh, p, continuation::Needs::jacobian);
          elements::FrictionState state;
          evaluator->element(static_cast<std::size_t>(corner.element)).friction(state);
          return state.slip_onsets.size();
        };
        CAPTURE(even, trial, corner.element, corner.angles);
        CHECK(slip_phases(1) > slip_phases(-1));
        ++crossed;
      }
    }
    CHECK(crossed > 10);
  }
}

TEST_CASE("the derivatives of the equations of a corner are those of differences") {
  for (const bool even : {false, true}) {
    const auto model = std::make_shared<const model::Model>(model::build(scenes::chain(4, even)));
    const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1, 1);
    const int n = problem->size();
    std::srand(5);
    const Vector u = Vector::Random(n), p = hbm::parameters_at(*problem, 0.8);
    for (const hbm::Corner& corner : hbm::corners_near(*problem, u, p, 1e3)) {
      CAPTURE(even, corner.element, corner.angles);
      Vector x(n + 3);
      x << u, 0.8, corner.angles[0] + 0.1, corner.angles[1] - 0.1;
      const auto check = continuation::check_jacobian(*hbm::corner_points(problem, corner), x, p);
      CHECK(check.message == "");
      Vector dh(n);
      hbm::corner_gradient(*problem, corner, u, p, dh);
      hbm::Corner moved = corner;
      for (int i = 0; i < n; ++i) {
        const auto excess = [&](double step) {
          moved = corner;
          return *hbm::corner_excess(*problem, moved, u + step * Vector::Unit(n, i), p);
        };
        CHECK(std::abs(dh[i] - (excess(1e-6) - excess(-1e-6)) / 2e-6) < 1e-8);
      }
      const int load =
          model::parameter_index(*model, (corner.element == 0 ? "d1.normal_load" : "d2.normal_load"));
      moved = corner;
      const double by_load = hbm::corner_derivative(*problem, corner, u, p, load);
      const Vector dp = 1e-3 * Vector::Unit(p.size(), load);
      CHECK(std::abs(by_load - (*hbm::corner_excess(*problem, moved, u, p + dp) -
                                *hbm::corner_excess(*problem, moved, u, p - dp)) /
                                   2e-3) < 1e-10);
    }
  }
}

TEST_CASE("a motion without the reversals of a corner has no excess there") {
  const auto model = std::make_shared<const model::Model>(model::build(scenes::paper(7, 3)));
  const hbm::HbmProblem problem(model, model->harmonics, 1e-3, 1);
  const Vector p = hbm::parameters_at(problem, 125);
  const Vector stuck = stuck_response(problem, 125);
  auto corner = hbm::corners_near(problem, stuck, p, 1e3).front();
  corner.angles[1] += 1.5;
  CHECK_FALSE(hbm::corner_excess(problem, corner, stuck, p));
}

TEST_CASE("next to a corner of a motion of half the period its image begins to slip with it") {
  const auto model = std::make_shared<const model::Model>(model::build(scenes::chain(4, true)));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const auto& harmonics = problem.harmonics();
  const Vector p = hbm::parameters_at(problem, 0.8);
  std::srand(7);
  Vector u = 2 * Vector::Random(problem.size()), dh(problem.size()), d(problem.size());
  Eigen::Map<Eigen::MatrixXd> motion(u.data(), harmonics.size(), u.size() / harmonics.size());
  for (const int n : {1, 3}) {
    motion.row(harmonics.cosine_index(n)).setZero();
    motion.row(harmonics.sine_index(n)).setZero();
  }
  const auto corners = hbm::corners_near(problem, u, p, 1e3);
  REQUIRE_FALSE(corners.empty());
  for (const hbm::Corner& corner : corners) {
    hbm::Corner image = corner;
    for (double& angle : image.angles) angle += std::numbers::pi;
    hbm::corner_gradient(problem, corner, u, p, dh);
    hbm::corner_direction(problem, corner, u, p, d);
    CHECK(std::abs(d.dot(dh) - d.squaredNorm()) < 1e-14 * d.squaredNorm());
    hbm::corner_gradient(problem, image, u, p, dh);
    CHECK(std::abs(d.dot(dh) - d.squaredNorm()) < 1e-14 * d.squaredNorm());
  }
  CHECK(elements::is_image(harmonics, motion.col(0), std::numbers::pi, 1));
  CHECK_FALSE(elements::is_image(harmonics, motion.col(0), std::numbers::pi, -1));
  CHECK_FALSE(elements::is_image(harmonics, motion.col(0), 1, 1));
}
