// A contact that feeds the motion: friction under a load that varies couples two modes into flutter.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/studies/presentation/motions.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <Eigen/LU>

using namespace arcslip;
using observables::TimeMethod;

namespace {

// While the pad slips forwards T = mu (N0 + k_n y), and
//   M = 1,  K = [2  -s + mu k_n; -s  2],  s = 0.4, mu = 0.8, k_n = 1
// has (w^2 - 2)^2 = -s (mu k_n - s) = -0.16: flutter, that grows as exp(0.14 t). Backwards it is stable.
scene::Scene pad(int order, double friction_coefficient = 0.8) {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 1}],
      "springs": [{"name": "kx", "at": "x", "value": 1.6}, {"name": "ky", "at": "y", "value": 0.6},
                  {"name": "s", "direction": {"x": 1, "y": -1}, "value": 0.4}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.02}, {"name": "cy", "at": "y", "value": 0.02}]},
    "elements": [{"name": "pad", "type": "contact_2d", "tangential": {"at": "x"}, "normal": {"at": "y"},
      "tangential_stiffness": 10, "normal_stiffness": 1, "friction_coefficient": 0.8, "normal_load": 1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 5}], "response": {"at": "x"},
    "harmonics": {"order": 63}, "studies": [{"name": "t", "kind": "time", "frequency": 0.45}]})");
  s.harmonics.order = order;
  scene::set(s, "pad.friction_coefficient", friction_coefficient);
  return s;
}

constexpr double frequency = 0.45;

}  // namespace

TEST_CASE("slip under a load that varies makes the stiffness unsymmetric, and two modes flutter") {
  const double growth = [](double mu) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A.topRightCorner<2, 2>().setIdentity();
    A.bottomLeftCorner<2, 2>() << -2, 0.4 - mu, 0.4, -2;
    A.bottomRightCorner<2, 2>().diagonal().setConstant(-0.02);
    return continuation::eigenvalues(A).real().maxCoeff();
  }(0.8);
  CHECK(growth > 0.12);

  // The same in the exact march, from a state within slip forwards.
  const auto model = model::build(pad(5));
  Eigen::VectorXd p = model::defaults(model);
  p[model::frequency] = frequency;
  time::EquationOfMotion equation = time::equation_of_motion(model, p);
  for (auto& force : equation.forces) force.cosine = 0;
  time::EventDriven march(equation);
  auto start = time::at_rest(equation);
  start.x << -40, 3;
  start.v << 5, 0;
  start.z << -100;  // far behind: drawn to the bound
  const auto slip = march.integrate(start, 0, 0.5);
  CHECK(slip.events.size() <= 1);
  Eigen::Matrix2d K;
  K << 2, -0.4 + 0.8, -0.4, 2;
  const Eigen::Vector2d rest = -K.inverse() * Eigen::Vector2d(0.8, 0);
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A.topRightCorner<2, 2>().setIdentity();
  A.bottomLeftCorner<2, 2>() = -K;
  A.bottomRightCorner<2, 2>().diagonal().setConstant(-0.02);
  Eigen::Vector4d state;
  state << start.x - rest, start.v;
  const auto modes = continuation::modes(A);
  const Eigen::VectorXcd scaled =
      continuation::solve_complex(modes.V, state.cast<std::complex<double>>()).array() *
      (0.5 * modes.values.array()).exp();
  const Eigen::Vector4d expected = (modes.V * scaled).real();
  CHECK((slip.end.x - rest - expected.head(2)).norm() < 1e-10 * expected.norm());
  CHECK((slip.end.v - expected.tail(2)).norm() < 1e-10 * expected.norm());
}

TEST_CASE(
    "an unstable periodic motion is reported as unstable, by the multiplier with which the march leaves it") {
  const scene::Scene s = pad(5);
  const auto motion = observables::motion_in_time(s, {.frequency = frequency});
  CAPTURE(motion.stop.message);
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(motion.integrator == "event-driven");
  REQUIRE(motion.stable);
  CHECK_FALSE(*motion.stable);
  CHECK(motion.elements[0].open_percent > 1);  // it separates
  const double multiplier = std::abs(motion.multipliers[0]);
  CHECK(multiplier > 1.5);
  REQUIRE(motion.multipliers[1] == std::conj(motion.multipliers[0]));

  const auto model = model::build(s);
  Eigen::VectorXd p = model::defaults(model);
  p[model::frequency] = frequency;
  const time::EquationOfMotion equation = time::equation_of_motion(model, p);
  time::EventDriven march(equation);
  const auto periodic = time::periodic_motion(march, time::at_rest(equation));
  REQUIRE(periodic.converged());
  CHECK(periodic.period.amplitude == Approx(motion.amplitude).epsilon(1e-9));
  time::MotionState state = periodic.shooting.start;
  state.x[0] += 1e-8;
  // What is left of a disturbance obeys d'' = 2 Re(m) d' - |m|^2 d from one period to the next.
  std::vector<Eigen::VectorXd> away;
  for (int period = 1; period <= 11; ++period) {
    state = march.integrate(state, 0, equation.period()).end;
    away.push_back(state.x - periodic.shooting.start.x);
  }
  CHECK(away.back().norm() > 100 * away.front().norm());
  for (std::size_t k = 8; k < away.size(); ++k) {
    const Eigen::VectorXd expected =
        2 * motion.multipliers[0].real() * away[k - 1] - multiplier * multiplier * away[k - 2];
    CAPTURE(k, away[k], expected);
    CHECK((away[k] - expected).norm() < 1e-3 * away[k].norm());
  }

  const auto results = studies::results_of(s, std::vector{motion}, {});
  CHECK(results.results[0].end.doubt.find("unstable, with a multiplier of modulus 2.01") == 0);
  const auto steps = observables::motion_in_time(
      s, {.frequency = frequency, .method = TimeMethod::newmark_shooting, .steps = 2000});
  REQUIRE(steps.stable);
  CHECK_FALSE(*steps.stable);
  CHECK(std::abs(steps.multipliers[0]) == Approx(multiplier).epsilon(0.02));
}

TEST_CASE("a march that does not contract ends at its limit of periods, and names shooting") {
  for (const auto method : {TimeMethod::event_driven, TimeMethod::newmark}) {
    const auto motion = observables::motion_in_time(
        pad(5), {.frequency = frequency, .method = method, .steps = 500, .periods = 200});
    CHECK(motion.status == observables::Status::stopped);
    CHECK(motion.stop.reason == observables::reasons::period_limit);
    CHECK(motion.stop.value > 0.1);
    CHECK(motion.stop.message.find("shooting, which says whether it is stable") != std::string::npos);
    // Bounded all the same: the contact opens, or sticks.
    CHECK(motion.amplitude < 10);
  }
  // With little friction the same march contracts.
  const auto quiet = observables::motion_in_time(
      pad(5, 0.2), {.frequency = frequency, .method = TimeMethod::event_driven, .periods = 2000});
  CHECK(quiet.stop.reason == observables::reasons::steady);
  const auto shot = observables::motion_in_time(pad(5, 0.2), {.frequency = frequency});
  REQUIRE(shot.stable);
  CHECK(*shot.stable);
  CHECK(shot.amplitude == Approx(quiet.amplitude).epsilon(1e-6));
  CHECK(studies::results_of(pad(5), std::vector{shot}, {}).results[0].end.doubt == "");
}

TEST_CASE("where shooting does not find the motion that flutter breaks up, it says so") {
  const auto motion = [] {
    scene::Scene s = pad(5);
    scene::set(s, "f.cosine", 10);
    return observables::motion_in_time(s, {.frequency = 0.05});
  }();
  CHECK(motion.status == observables::Status::failed);
  CHECK(motion.stop.reason == observables::reasons::no_periodic_motion);
  CHECK(motion.multipliers.empty());
}

TEST_CASE("harmonic balance finds the periodic motion whether it is stable or not") {
  const auto model = std::make_shared<const model::Model>(model::build(pad(63)));
  const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1, 1);
  const Eigen::VectorXd p = hbm::parameters_at(*problem, frequency);
  const auto u = hbm::steady_state(problem, p).u;
  REQUIRE(u);
  const time::MotionState found = time::state_of(*problem, *u, p);
  const time::EquationOfMotion equation = time::equation_of_motion(*model, p);
  time::EventDriven march(equation);
  const auto exact = time::periodic_motion(march, time::at_rest(equation));
  REQUIRE(exact.converged());
  CHECK((found.x - exact.shooting.start.x).norm() < 1e-5 * exact.period.amplitude);
}
