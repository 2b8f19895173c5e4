#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/hysteresis/bouc_wen.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/observables/energies.hpp>

#include <Eigen/LU>

#include <cmath>

using namespace arcslip;
using namespace arcslip::elements;
using Eigen::VectorXd;

namespace {

// Exponent 1 and shape 1/2: z unloads along a line, and loads as z_y (1 - exp(-s/z_y)) from 0.
struct ClosedForm {
  ClosedForm(double A, double z_y) {
    largest = 0;
    for (int i = 0; i < 200; ++i) largest = z_y * (1 - std::exp(-(2 * A - largest) / z_y));
    work = 2 * (z_y * (2 * A - 2 * largest) - largest * largest / 2);  // of z in a loop of q from -A to A
  }
  double largest, work;
};

// The coefficients of z for q = A cos theta.
VectorXd prescribed(const Harmonics& h, const Sampling& sampling, std::span<const double> fields, double A) {
  const auto element = bouc_wen().element(h, sampling);
  VectorXd u = VectorXd::Zero(2 * h.size());
  u[h.cosine_index(1)] = A;
  const double start = std::min(A, 0.7 * fields[2]);
  u[h.size() + h.cosine_index(1)] = 0.8 * start;
  u[h.size() + h.sine_index(1)] = -0.6 * start;
  for (int i = 0; i < 60; ++i) {
    element->move_to(u, fields, true);
    const VectorXd r = element->force().tail(h.size());
    if (r.norm() < 1e-14 * A) break;
    u.tail(h.size()) -= element->jacobian().bottomRightCorner(h.size(), h.size()).partialPivLu().solve(r);
  }
  CHECK(element->force().tail(h.size()).norm() < 1e-12 * A);
  return u;
}

double loop(const Harmonics& h, const VectorXd& u) {
  return observables::element_energy(h, u.head(h.size()), u.tail(h.size()));
}

const std::string one_mass = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "elements": [{"name": "h", "type": "bouc_wen", "at": "x", "stiffness": 0.8, "elastic_share": 0.2,
                  "yield_displacement": 0.4, "shape": 0.8}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.4}], "harmonics": {"order": 31},
    "studies": [{"name": "frf", "kind": "frf", "from": 0.5, "to": 2}]})";

}  // namespace

TEST_CASE(
    "the loop of exponent 1 and elastic unloading is that of its closed form, more closely with order") {
  const double z_y = 0.4;
  const std::array fields{1.0, 0.0, z_y, 1.0, 0.5};
  for (const double A : {0.1, 0.7, 3.0}) {
    const ClosedForm exact(A, z_y);
    for (const int order : {3, 7, 15, 31, 63}) {
      const Harmonics h{order, true};
      const double error = std::abs(loop(h, prescribed(h, {}, fields, A)) / exact.work - 1);
      CAPTURE(A, order, error);
      CHECK(error < 1.0 / (order * order * order));
    }
    // In time, with dq = A/500.
    StepEnd end(1, 1);
    VectorXd z = VectorXd::Zero(1), q = VectorXd::Zero(1), f = VectorXd::Zero(1);
    const int steps = 1000;
    double work = 0, largest = 0;
    for (int period = 0; period < 5 + static_cast<int>(12 * z_y / A); ++period) {
      work = largest = 0;
      for (int s = 0; s < 4 * steps; ++s) {
        const bool rises = s < steps || s >= 3 * steps;
        const VectorXd dq = VectorXd::Constant(1, (rises ? A : -A) / steps);
        bouc_wen().in_time(fields)->step({q, z, f}, dq, end);
        q += dq;
        z += end.dz;
        f = end.f;
        work += end.dissipated;
        largest = std::max(largest, z[0]);
      }
    }
    CHECK(work == Approx(exact.work).epsilon(2e-6));
    CHECK(largest == Approx(exact.largest).epsilon(2e-6));
  }
}

TEST_CASE("the error of the samples is below that of the harmonics left out") {
  const std::array fields{1.0, 0.0, 0.4, 1.0, 0.5};
  const double A = 0.7;
  const ClosedForm exact(A, 0.4);
  for (const int order : {1, 3, 7, 15, 31}) {
    const Harmonics h{order, true};
    const double ours = loop(h, prescribed(h, {}, fields, A));
    const double dense = loop(h, prescribed(h, {false, 40000}, fields, A));
    CAPTURE(order, ours / dense - 1, dense / exact.work - 1);
    CHECK(std::abs(ours - dense) < 0.5 * std::abs(dense - exact.work));
  }
}

TEST_CASE("with a large exponent smooth hysteresis becomes a friction damper next to a spring") {
  // |z| < z_y is reached to within about z_y/n.
  const Harmonics h{31, true};
  const double A = 0.9, z_y = 0.4;
  const auto damper = jenkins().element(h, {});
  VectorXd u = VectorXd::Zero(h.size());
  u[h.cosine_index(1)] = A;
  damper->move_to(u, std::array{1.0, 1.0, z_y}, false);
  double last = 1;
  for (const double n : {2.0, 8.0, 32.0}) {
    const VectorXd w = prescribed(h, {}, std::array{1.0, 0.0, z_y, n, 0.5}, A);
    const double error = (w.tail(h.size()) - damper->force()).norm() / damper->force().norm();
    CHECK(error < 0.4 * last);
    last = error;
  }
  CHECK(last < 0.02);
}

TEST_CASE("smooth hysteresis follows its state equation in harmonics as it does in time") {
  const scene::Scene s = scenes::parse(one_mass);
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  std::srand(3);
  const VectorXd u = 0.2 * VectorXd::Random(problem.size());
  CHECK(continuation::check_jacobian(problem, u, hbm::parameters_at(problem, 0.9)).message == "");
  const auto at_rest = observables::frequency_response(s, scenes::window(s));
  REQUIRE(at_rest.size() == 1);
  REQUIRE(at_rest[0].status == observables::Status::complete);
  for (const double w : {0.8, 1.1, 1.4}) {
    const auto responses = observables::point_responses(s, {.frequency = w});
    REQUIRE(responses.size() == 1);
    REQUIRE(responses[0].status == observables::Status::complete);
    const auto motion = observables::motion_in_time(
        s, {.frequency = w, .method = observables::TimeMethod::newmark_shooting, .steps = 2000});
    CAPTURE(w, motion.stop.message);
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(std::abs(motion.amplitude / responses[0].point.amplitude - 1) < 2e-5);
    const double dissipated = responses[0].point.energy_input - responses[0].point.energy_viscous;
    CHECK(std::abs(motion.energy.friction / dissipated - 1) < 1e-3);
    CHECK(std::abs(responses[0].point.energy_friction / dissipated - 1) < 1e-10);
    CHECK(responses[0].point.elements[0].energy == responses[0].point.energy_friction);
    // The series of the force's harmonics next to the law's own force, at each angle of the history.
    const auto& history = responses[0].history.elements[0];
    for (std::size_t i = 0; i < history.force.size(); ++i)
      CHECK(std::abs(history.series[i] - history.force[i]) < 1e-3);
  }
}

TEST_CASE("the truncation estimate of smooth hysteresis is near the error, samples included") {
  const auto amplitude = [](int order) {
    scene::Scene s = scenes::parse(one_mass);
    s.harmonics.order = order;
    return observables::point_responses(s, {.frequency = 1.1})[0].point;
  };
  const double exact = amplitude(63).amplitude;
  for (const int order : {3, 5, 9, 15}) {
    const auto point = amplitude(order);
    const double error = std::abs(point.amplitude - exact);
    CAPTURE(order, error, point.truncation_estimate);
    if (point.truncation_flagged) continue;
    CHECK(point.truncation_estimate > 0.3 * error);
    CHECK(point.truncation_estimate < 10 * error);
  }
}

TEST_CASE("with an even harmonic of the force smooth hysteresis has a mean, as it has in time") {
  scene::Scene s = scenes::parse(one_mass);
  s.excitation.push_back(s.excitation[0]);
  s.excitation.back().name = "g";
  s.excitation.back().harmonic = 2;
  s.excitation.back().values = {0.1, 0.2};
  const auto responses = observables::point_responses(s, {.frequency = 0.8});
  REQUIRE(responses.size() == 1);
  REQUIRE(responses[0].status == observables::Status::complete);
  const auto motion = observables::motion_in_time(
      s, {.frequency = 0.8, .method = observables::TimeMethod::newmark_shooting, .steps = 2000});
  CAPTURE(motion.stop.message);
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(std::abs(motion.amplitude / responses[0].point.amplitude - 1) < 1e-4);
}

TEST_CASE("two hystereses with a mean have a response at every order, where rest leaves their means open") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 0.7}],
      "springs": [{"name": "k", "at": "x", "value": 1.6}], "dampers": [{"name": "c", "at": "x", "value": 0.04}]},
    "elements": [
      {"name": "a", "type": "bouc_wen", "at": "x", "stiffness": 1, "yield_displacement": 0.18, "exponent": 2.2,
       "shape": 0.62},
      {"name": "b", "type": "bouc_wen", "at": "x", "stiffness": 1.4, "yield_displacement": 0.47, "exponent": 3.9,
       "shape": 0.73}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1},
                   {"name": "g", "at": "x", "harmonic": 2, "cosine": 0.22, "sine": 0.22}]})");
  const auto motion = observables::motion_in_time(
      s, {.frequency = 1.06, .method = observables::TimeMethod::newmark_shooting, .steps = 4000});
  REQUIRE(motion.status == observables::Status::complete);
  const std::pair<int, double> errors[] = {{5, 2e-2}, {9, 2e-3}, {15, 5e-4}, {25, 5e-5}, {51, 1e-5}};
  for (const auto& [order, error] : errors) {
    s.harmonics.order = order;
    const auto found = observables::point_responses(s, {.frequency = 1.06});
    CAPTURE(order);
    REQUIRE(found.size() == 1);
    REQUIRE(found[0].status == observables::Status::complete);
    CHECK(found[0].point.amplitude == Approx(motion.amplitude).epsilon(error));
  }
}

TEST_CASE("smooth hysteresis keeps numbers and bounds at all amplitudes, in steps of any size") {
  for (const double n : {1.0, 3.7, 100.0})
    for (const double shape : {0.5, 0.9, 3.0}) {
      const std::array fields{2.0, 0.1, 0.4, n, shape};
      for (const double dq : {0.0, 1e-300, 1e-20, 1e-3, 0.4, 7.0, 1e12, -1e12, -0.3})
        for (const double z : {-0.4, -0.1, 0.0, 0.3, 0.4}) {
          StepEnd end(1, 1);
          const VectorXd q = VectorXd::Zero(1), f = q, at = VectorXd::Constant(1, z);
          bouc_wen().in_time(fields)->step({q, at, f}, VectorXd::Constant(1, dq), end);
          CAPTURE(n, shape, dq, z);
          CHECK(std::isfinite(end.f[0]));
          CHECK(std::isfinite(end.f_q(0, 0)));
          CHECK(std::abs(z + end.dz[0]) <= 0.4 * (1 + 1e-14));
          CHECK(end.dissipated >= -1e-16);
          if (std::abs(dq) > 1e6) CHECK(z + end.dz[0] == Approx(dq > 0 ? 0.4 : -0.4).epsilon(1e-12));
        }
      const Harmonics h{5, false};
      const auto element = bouc_wen().element(h, {});
      for (const double size : {0.0, 1e-300, 1e-9, 1.0}) {
        element->move_to(size * VectorXd::Ones(2 * h.size()), fields, true);
        CHECK(element->force().allFinite());
        CHECK(element->jacobian().allFinite());
      }
    }
}

TEST_CASE("the gradient of the response has no entry for the memory of an element, whatever stood there") {
  const scene::Scene s = scenes::parse(one_mass);
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const auto at = problem.hbm_evaluator();
  const VectorXd u = VectorXd::LinSpaced(problem.size(), 0.1, 0.7);
  REQUIRE(at->move_to(u, hbm::parameters_at(problem, 0.9), continuation::Needs::jacobian) ==
          continuation::Evaluated::ok);
  const VectorXd a = VectorXd::LinSpaced(problem.harmonics().size(), -1, 2);
  VectorXd g = VectorXd::Constant(problem.size(), std::nan("")), x(a.size());
  at->stiffness().response_transposed(a, g);
  REQUIRE(g.allFinite());
  at->stiffness().response(u, 0, x);  // L u
  CHECK(g.dot(u) == Approx(a.dot(x)).epsilon(1e-13));
}
