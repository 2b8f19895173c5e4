// Motions that repeat after several periods of the excitation, by harmonics of a fraction of its frequency.

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/newmark/newmark_periods.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;
using continuation::Vector;
using elements::Harmonics;

namespace {

// m x'' + c x' + k x + gamma x^3 = force cos(omega t), at 1 rad/s.
scene::Scene duffing(double k, double c, double gamma, double force) {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}]})");
  scene::set(s, "k.value", k);
  scene::set(s, "c.value", c);
  scene::set(s, "s.stiffness", gamma);
  scene::set(s, "f.cosine", force);
  return s;
}

std::shared_ptr<const hbm::HbmProblem> problem_of(const scene::Scene& s, const Harmonics& harmonics) {
  return std::make_shared<const hbm::HbmProblem>(std::make_shared<const model::Model>(model::build(s)),
                                                 harmonics, 1, 1);
}

double residual_of(const hbm::HbmProblem& problem, const Vector& u, const Vector& p) {
  const auto at = problem.hbm_evaluator();
  REQUIRE(at->move_to(u, p, continuation::Needs::residual) == continuation::Evaluated::ok);
  return at->residual().norm();
}

}  // namespace

TEST_CASE("harmonics that two sets share go from one to the other, at their frequencies") {
  const Harmonics odd{7, true}, third{18, false, 3}, half{6, false, 2};
  Vector u(2 * odd.size()), v(2 * third.size()), back(u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = static_cast<double>(i + 1);
  elements::transfer(odd, u, third, v);
  for (int block : {0, 1})
    for (int n = 0; n <= third.order; ++n) {
      const bool kept = n % 3 == 0 && odd.has(n / 3);
      CAPTURE(block, n);
      CHECK(v[block * third.size() + third.cosine_index(n)] ==
            (kept ? u[block * odd.size() + odd.cosine_index(n / 3)] : 0));
      if (n > 0)
        CHECK(v[block * third.size() + third.sine_index(n)] ==
              (kept ? u[block * odd.size() + odd.sine_index(n / 3)] : 0));
    }
  elements::transfer(third, v, odd, back);  // without the seventh, which is above 18/3
  for (int block : {0, 1}) CHECK(back[block * odd.size() + odd.cosine_index(7)] == 0);
  CHECK((back - u).head(odd.cosines() - 1).isZero());
  // From halves of the frequency to thirds: only the orders of the excitation itself are in both.
  const Vector w = Vector::Ones(half.size());
  Vector z(third.size());
  elements::transfer(half, w, third, z);
  CHECK(z.sum() == 7);  // the mean, and orders 1, 2 and 3 of the excitation
  CHECK(z[third.cosine_index(9)] == 1);
  CHECK(z[third.cosine_index(2)] == 0);
}

TEST_CASE("an undamped Duffing oscillator answers with a third of the frequency as in closed form") {
  // x = A cos(omega t/3): omega^2/9 = k + 3/4 gamma A^2 and f = gamma A^3/4.
  for (double A : {0.1, 1.0, 7.0}) {
    const double k = 2, gamma = 0.3, base = std::sqrt(k + 0.75 * gamma * A * A);
    for (const Harmonics h : {Harmonics{3, true, 3}, Harmonics{5, false, 3}, Harmonics{12, false, 6}}) {
      const auto problem = problem_of(duffing(k, 0, gamma, gamma * A * A * A / 4), h);
      const Vector p = hbm::parameters_at(*problem, 3 * base);
      Vector u = Vector::Zero(problem->size());
      u[h.cosine_index(h.period / 3)] = A;
      CAPTURE(A, h.order, h.period);
      CHECK(residual_of(*problem, u, p) < 1e-14 * base * base * A);
      const auto at = problem->hbm_evaluator();
      REQUIRE(at->move_to(u, p, continuation::Needs::jacobian) == continuation::Evaluated::ok);
      Vector by_frequency(u.size());
      at->parameter_derivative(model::frequency, by_frequency);
      by_frequency[h.cosine_index(h.period / 3)] += 2 * base * A / 3;
      CHECK(by_frequency.norm() < 1e-14 * base * A);
    }
  }
}

TEST_CASE("a response is the same by harmonics of a fraction of the frequency") {
  // Jenkins elements, whose reversals then repeat in the period, a cubic spring and forces in two harmonics.
  for (const bool even : {false, true})
    for (const int period : {2, 3}) {
      scene::Scene s = scenes::chain(7, even);
      const auto once = scenes::response_at(s, 0.9);
      s.harmonics.order = 7 * period;
      s.harmonics.period = period;
      const auto found = scenes::response_at(s, 0.9);
      CAPTURE(even, period);
      CHECK(reference::error(found.amplitude, once.amplitude) < 1e-10);
      CHECK(std::abs(found.phase - once.phase) < 1e-10);
      CHECK(reference::error(found.truncation_estimate, once.truncation_estimate) < 1e-6);
      CHECK(reference::error(found.energy_input, period * once.energy_input) < 1e-10);
      CHECK(reference::error(found.energy_viscous, period * once.energy_viscous) < 1e-10);
      CHECK(reference::error(found.forces.total().in_phase, once.forces.total().in_phase) < 1e-9);
      CHECK(reference::error(found.forces.inertia, once.forces.inertia) < 1e-10);
      CHECK(reference::error(found.forces.viscous, once.forces.viscous) < 1e-10);
      for (std::size_t e = 0; e < once.elements.size(); ++e) {
        CHECK(std::abs(found.elements[e].energy - period * once.elements[e].energy) <
              1e-10 * once.energy_input);
        CHECK(std::abs(found.elements[e].stick_percent - once.elements[e].stick_percent) < 1e-7);
        CHECK(std::abs(found.elements[e].equivalent_damping - once.elements[e].equivalent_damping) < 1e-9);
      }
    }
}

TEST_CASE("a period doubling is a branch point by harmonics of half the frequency") {
  // x'' + 0.3 x' - x + x^3 = g cos 1.2 t: the small orbit about 1 doubles its period at g = 0.265581786056,
  // where (x, x')(0) = (0.4075754662, 0.3226140050) (shooting by another program).
  const scene::Scene s = duffing(-1, 0.3, 1, 0.05);
  const auto single = problem_of(s, {20, false});
  Vector p = hbm::parameters_at(*single, 1.2), guess = Vector::Zero(single->size());
  guess[0] = 1;
  guess[1] = 0.05 / (2 - 1.44);  // linearized
  const auto small = hbm::response_near(*single, p, guess);
  REQUIRE(small);
  const auto doubled = problem_of(s, {40, false, 2});
  Vector u(doubled->size());
  elements::transfer(single->harmonics(), *small, doubled->harmonics(), u);
  CHECK(residual_of(*doubled, u, p) < 1e-10);

  continuation::Options options;
  options.lower = 0.05;
  options.upper = 0.27;
  const int force = model::parameter_index(doubled->model(), "f.cosine");
  const auto branch =
      continuation::trace(doubled, {u, p, force, 1}, options, {continuation::branch_point_monitor()});
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason == continuation::StopReason::boundary);
  REQUIRE(branch.events.size() == 1);
  CHECK(std::abs(branch.events[0].point.parameter - 0.265581786056) < 1e-12);
  const auto x = elements::series_values(doubled->harmonics(), branch.events[0].point.u, 0);
  CHECK(std::abs(x.x - 0.4075754662) < 1e-10);
  CHECK(std::abs(0.6 * x.d1 - 0.3226140050) < 1e-10);
}

TEST_CASE("a motion in time repeats after the period of the harmonics") {
  // The subharmonic of the third order with damping, from that without.
  const double A = 2, k = 1, gamma = 0.5, base = std::sqrt(k + 0.75 * gamma * A * A);
  scene::Scene s = duffing(k, 1e-3, gamma, gamma * A * A * A / 4);
  s.harmonics = {.order = 15, .period = 3};
  const auto model = std::make_shared<const model::Model>(model::build(s));
  CHECK(model->harmonics == Harmonics{15, true, 3});
  const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1, 1);
  const Vector p = hbm::parameters_at(*problem, 3 * base + 0.01);
  Vector guess = Vector::Zero(problem->size());
  guess[0] = A;
  const auto u = hbm::response_near(*problem, p, guess);
  REQUIRE(u);
  CHECK(std::abs((*u)[0]) > 0.5 * A);
  const auto equation = time::equation_of_motion(*model, p.head(p.size() - 1));
  CHECK(equation.period() == Approx(3 * 2 * std::numbers::pi / p[model::frequency]).epsilon(1e-14));
  const time::MotionState start = time::state_of(*problem, *u, p);
  double error[2];
  for (int i : {0, 1}) {
    time::Newmark newmark(equation, 1000 * (i + 1));
    newmark.begin(start);
    for (long step = 0; step < newmark.steps_per_period(); ++step) newmark.step();
    error[i] = std::abs(newmark.state().x[0] - start.x[0]);
  }
  CHECK(error[0] < 1e-3 * A);
  CHECK(error[0] / error[1] == Approx(4).epsilon(0.02));  // of second order: no other error is left
}

TEST_CASE("studies at one frequency, by harmonics and in time, know the period") {
  std::vector<observables::MotionMaxima> maxima;
  for (const int period : {1, 3}) {
    scene::Scene s = scenes::paper(7 * period, 3);
    s.harmonics.period = period;
    const auto in_harmonics = observables::point_responses(s, {.frequency = 20});
    const auto in_time =
        observables::motion_in_time(s, {.frequency = 20, .method = observables::TimeMethod::shooting});
    CAPTURE(period);
    REQUIRE(in_harmonics.size() == 1);
    CHECK(in_time.status == observables::Status::complete);
    REQUIRE(in_time.multipliers.size() >= 2);
    CHECK(std::abs(in_time.multipliers[0]) == Approx(std::pow(0.8476668, period)).epsilon(2e-7));
    CHECK(std::abs(in_time.multipliers[1]) == Approx(std::pow(0.8115364, period)).epsilon(2e-7));
    CHECK(in_time.history.time.back() == Approx(period / 20.0).epsilon(1e-9));
    const observables::ResponsePoint& point = in_harmonics[0].point;
    CHECK(point.amplitude == Approx(in_time.amplitude).epsilon(1e-3));  // N = 7
    CHECK(point.energy_friction == Approx(in_time.energy.friction).epsilon(1e-3));
    CHECK(in_harmonics[0].history.base_frequency == Approx(20 * scenes::hertz / period).epsilon(1e-14));
    maxima.push_back(point.maxima);
  }
  CHECK(maxima[1].velocity == Approx(maxima[0].velocity).epsilon(1e-9));
  CHECK(maxima[1].acceleration == Approx(maxima[0].acceleration).epsilon(1e-9));
}

TEST_CASE("a response with sampled friction is the same by harmonics of a fraction of the frequency") {
  scene::Scene s = scenes::chain(7, true);
  s.harmonics.friction = scene::Friction::sampled;
  s.harmonics.samples = 128;
  const auto once = scenes::response_at(s, 0.9);
  s.harmonics.order = 21;
  s.harmonics.period = 3;
  s.harmonics.samples = 3 * 128;
  const auto found = scenes::response_at(s, 0.9);
  CHECK(reference::error(found.amplitude, once.amplitude) < 1e-9);
}
