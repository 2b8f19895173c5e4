// Laws whose force depends on the velocity.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/memoryless/quadratic_damper.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/observables/energies.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/time/newmark/newmark_periods.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;
using namespace arcslip::elements;
using Eigen::VectorXd;
using std::numbers::pi;

namespace {

scene::Scene oscillator(const std::string& element, double damping = 0, int order = 9, int period = 1,
                        double force = 0.5) {
  const auto number = [](double value) { return scene::file::json_text(scene::file::node(value)); };
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": )" +
                       number(damping) + R"(}]},
    "elements": [{"name": "e", "at": "x", )" +
                       element + R"(}], "excitation": [{"name": "f", "at": "x", "cosine": )" + number(force) +
                       R"(}], "harmonics": {"order": )" + std::to_string(order) + R"(, "period": )" +
                       std::to_string(period) +
                       R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 0.5, "to": 2}]})");
}

const std::string quadratic = R"("type": "quadratic_damper", "coefficient": 0.3)";
const std::string cycle = R"("type": "van_der_pol", "coefficient": 0.1, "amplitude": 0.5)";
const std::string friction =
    R"("type": "tanh_friction", "friction_coefficient": 0.5, "normal_load": 0.4, "reference_velocity": 0.2)";

VectorXd cosine(const Harmonics& h, double A) {
  VectorXd u = VectorXd::Zero(h.size());
  u[h.cosine_index(1)] = A;
  return u;
}

}  // namespace

TEST_CASE("a quadratic damper dissipates (8/3) c A^3 w^2 in a period of a cosine, at every order") {
  const double c = 0.7, A = 1.3, w = 2.1;
  for (const int order : {1, 2, 7, 40})
    for (const bool odd : {false, true}) {
      const Harmonics h{order, odd};
      const auto element = quadratic_damper().element(h, {});
      element->set_frequency(w);
      const VectorXd u = cosine(h, A);
      element->move_to(u, std::array{c}, true);
      CHECK(observables::element_energy(h, u, element->force()) ==
            Approx(8.0 / 3 * c * A * A * A * w * w).epsilon(1e-13));
      // |sin| sin = -sum over odd n of 8/(pi n (n^2 - 4)) sin n theta, and v = -A w sin theta
      for (int n = 1; n <= order; n += 2)
        CHECK(element->force()[h.sine_index(n)] ==
              Approx(c * A * A * w * w * 8 / (pi * n * (n * n - 4.0))).epsilon(1e-12));
      CHECK((element->jacobian() * u - 2 * element->force()).norm() < 1e-12 * element->force().norm());
    }
}

TEST_CASE("a quadratic damper is exact for any motion: between reversals it is a polynomial") {
  const Harmonics h{6, false};
  std::srand(4);
  const VectorXd u = VectorXd::Random(h.size());
  const auto element = quadratic_damper().element(h, {});
  element->set_frequency(1.3);
  element->move_to(u, std::array{0.9}, true);
  std::vector<double> angles;
  const int count = 200000;
  for (int s = 0; s < count; ++s) angles.push_back(2 * pi * s / count);
  const Eigen::MatrixXd f = quadratic_damper().moving_force_at(h, u, 1.3, std::array{0.9}, angles);
  VectorXd sum = VectorXd::Zero(h.size()), phi(h.size());
  for (int s = 0; s < count; ++s) {
    series_basis(h, angles[static_cast<std::size_t>(s)], phi);
    sum += 2.0 / count * f(s, 0) * phi;
  }
  sum[0] *= 0.5;
  CHECK((sum - element->force()).norm() < 1e-10 * sum.norm());
}

TEST_CASE("van der Pol's damper has the work pi c w A^2 (A^2/(4 q0^2) - 1): negative below 2 q0") {
  const double c = 0.7, q0 = 0.4, w = 1.9;
  const Harmonics h{3, true};
  const auto element = van_der_pol().element(h, {});
  element->set_frequency(w);
  for (const double A : {0.1, 0.8, 1.7}) {
    const VectorXd u = cosine(h, A);
    element->move_to(u, std::array{c, q0}, false);
    CHECK(observables::element_energy(h, u, element->force()) ==
          Approx(pi * c * w * A * A * (A * A / (4 * q0 * q0) - 1)).margin(1e-14));
    CHECK(element->force()[h.sine_index(3)] == Approx(-c * w * A * A * A / (4 * q0 * q0)).epsilon(1e-12));
  }
}

TEST_CASE(
    "Jacobians and derivatives by all parameters are those of differences, at fractions of the frequency, "
    "too") {
  for (const std::string& law : {quadratic, cycle, friction})
    for (const int period : {1, 3}) {
      const auto model = std::make_shared<const model::Model>(
          model::build(oscillator(law, 0.1, period == 1 ? 5 : 9, period)));
      const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
      std::srand(5);
      const VectorXd u = VectorXd::Random(problem.size());
      const VectorXd p = hbm::parameters_at(problem, 1.1);
      CHECK(continuation::check_jacobian(problem, u, p).message == "");
      const auto at = problem.evaluator();
      VectorXd derivative(u.size());
      for (int k = 0; k < p.size(); ++k) {
        at->move_to(u, p, continuation::Needs::jacobian);
        at->parameter_derivative(k, derivative);
        const double step = 1e-6;
        at->move_to(u, p + step * VectorXd::Unit(p.size(), k), continuation::Needs::residual);
        const VectorXd plus = at->residual();
        at->move_to(u, p - step * VectorXd::Unit(p.size(), k), continuation::Needs::residual);
        CAPTURE(law, period, k);
        CHECK((derivative - (plus - at->residual()) / (2 * step)).norm() < 1e-8 * (1 + derivative.norm()));
      }
    }
}

TEST_CASE("at order 1 a quadratic damper is a damper of (8/(3 pi)) c A w, the classical equivalent") {
  const scene::Scene s = oscillator(quadratic, 0.02, 1);
  for (const double w : {0.7, 1.0, 1.6}) {
    const auto found = observables::point_responses(s, {.frequency = w});
    REQUIRE(found.size() == 1);
    const double A = found[0].point.amplitude;
    CHECK(A * std::hypot(1 - w * w, w * (0.02 + 8 / (3 * pi) * 0.3 * A * w)) == Approx(0.5).epsilon(1e-10));
    CHECK(found[0].point.energy_friction == Approx(8.0 / 3 * 0.3 * A * A * A * w * w).epsilon(1e-10));
    CHECK(found[0].point.energy_input - found[0].point.energy_friction - found[0].point.energy_viscous ==
          Approx(0).margin(1e-10));
    CHECK(found[0].point.elements[0].equivalent_damping == Approx(8 / (3 * pi) * 0.3 * A * w).epsilon(1e-10));
  }
}

TEST_CASE("frequency responses with laws of velocity follow their closed forms at order 1, peaks included") {
  const double F = 0.5;
  {
    const double c = 0.02, e = 8 / (3 * pi) * 0.3;
    const scene::Scene s = oscillator(quadratic, c, 1);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].status == observables::Status::complete);
    for (const auto& point : branches[0].points) {
      const double A = point.amplitude, w = point.omega;
      CHECK(A * std::hypot(1 - w * w, w * (c + e * A * w)) == Approx(F).epsilon(1e-9));
    }
    int peaks = 0;
    for (const auto& event : branches[0].events) {
      if (event.kind != "peak") continue;
      ++peaks;
      const double A = event.point.amplitude, w = event.point.omega, b = c + e * A * w;
      CHECK(-2 * (1 - w * w) + b * b + w * b * e * A == Approx(0).margin(1e-7));
    }
    CHECK(peaks == 1);
  }
  {  // entrained: A^2 ((1 - w^2)^2 + (c w)^2 (A^2/(4 q0^2) - 1)^2) = F^2
    const double c = 0.1, q0 = 0.5, small = 0.02;
    const scene::Scene s = oscillator(cycle, 0, 1, 1, small);
    for (const double w : {0.97, 0.99, 1.0, 1.02}) {
      const auto found = observables::point_responses(s, {.frequency = w});
      for (const auto& each : found) {
        REQUIRE(each.status == observables::Status::complete);
        const double A = each.point.amplitude;
        CHECK(A * std::hypot(1 - w * w, c * w * (A * A / (4 * q0 * q0) - 1)) == Approx(small).epsilon(1e-8));
        CHECK((each.point.energy_friction < 0) == (A < 2 * q0));
        CHECK(std::isnan(each.point.friction_percent()) == (A < 2 * q0));
      }
    }
  }
}

TEST_CASE("a quadratic damper bounds the resonance that it takes part in, and no other") {
  const scene::Scene alone = oscillator(quadratic, 0, 5);
  const auto bounded = observables::frequency_response(alone, scenes::window(alone));
  REQUIRE(bounded.size() == 1);
  CHECK(bounded[0].status == observables::Status::complete);
  // Next to a second mass with a slider too weak for its force.
  const scene::Scene two = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 1}],
      "springs": [{"name": "kx", "at": "x", "value": 1}, {"name": "ky", "at": "y", "value": 2}]},
    "elements": [{"name": "e", "type": "quadratic_damper", "at": "x", "coefficient": 0.3},
      {"name": "d", "type": "jenkins", "at": "y", "stiffness": 0.5, "friction_coefficient": 1, "normal_load": 0.1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.5}, {"name": "g", "at": "y", "cosine": 0.5}],
    "response": {"at": "y"}, "harmonics": {"order": 1},
    "studies": [{"name": "frf", "kind": "frf", "from": 1.1, "to": 2}]})");
  const auto unbounded = observables::frequency_response(two, scenes::window(two));
  REQUIRE(!unbounded.empty());
  CHECK(unbounded[0].stop.reason == observables::reasons::unbounded);
}

TEST_CASE("laws of velocity have the same response in Newmark's steps, at second order, energies included") {
  struct Case {
    std::string law;
    double damping, frequency;
    int order;
  };
  for (const Case& each : {Case{quadratic, 0, 0.8, 41}, {cycle, 0.3, 0.8, 21}, {friction, 0.05, 0.8, 61}}) {
    const scene::Scene s = oscillator(each.law, each.damping, each.order);
    const auto responses = observables::point_responses(s, {.frequency = each.frequency});
    REQUIRE(responses.size() == 1);
    REQUIRE(responses[0].status == observables::Status::complete);
    double last = 0, last_energy = 0;
    for (const int steps : {200, 400, 800}) {
      const auto motion = observables::motion_in_time(
          s,
          {.frequency = each.frequency, .method = observables::TimeMethod::newmark_shooting, .steps = steps});
      CAPTURE(each.law, steps, motion.stop.message);
      REQUIRE(motion.status == observables::Status::complete);
      const double error = std::abs(motion.amplitude / responses[0].point.amplitude - 1);
      const double energy = std::abs(motion.energy.friction / responses[0].point.energy_friction - 1);
      if (last > 0) CHECK(error == Approx(0.25 * last).epsilon(0.2));
      if (last > 0) CHECK(energy == Approx(0.25 * last_energy).epsilon(0.2));
      CHECK(std::abs(motion.energy.defect()) < 1e-10);
      last = error;
      last_energy = energy;
    }
    CHECK(last < 1e-4);
    CHECK(last_energy < 1e-3);
    const auto& history = responses[0].history.elements[0];
    for (std::size_t i = 0; i < history.force.size(); ++i)
      CHECK(std::abs(history.series[i] - history.force[i]) < 1e-3);
  }
}

TEST_CASE(
    "derivatives of a period with laws of velocity are those of its differences, without mass as well") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y", "w"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 0.5}],
      "springs": [{"name": "kx", "at": "x", "value": 1}, {"name": "ky", "between": ["x", "y"], "value": 0.7},
                  {"name": "kw", "between": ["y", "w"], "value": 0.9}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.05}]},
    "elements": [{"name": "a", "type": "quadratic_damper", "between": ["x", "y"], "coefficient": 0.8},
                 {"name": "b", "type": "van_der_pol", "at": "y", "coefficient": 0.2, "amplitude": 0.5},
                 {"name": "d", "type": "tanh_friction", "between": ["w", "x"], "friction_coefficient": 0.5,
                  "normal_load": 0.4, "reference_velocity": 0.3}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.4}], "response": {"at": "x"}})");
  const auto model = model::build(s);
  VectorXd p = model::defaults(model);
  p[model::frequency] = 0.9;
  time::Newmark newmark(time::equation_of_motion(model, p), 60);
  VectorXd start(6);
  start << 0.3, -0.2, 0.1, 0.4, 0.05, -0.02;
  const auto state = [](const VectorXd& y) { return time::MotionState{y.head(3), y.tail(3), VectorXd()}; };
  const time::PeriodMap map = time::newmark_map(newmark, state(start));
  REQUIRE(map.done);
  const double h = 1e-6;
  for (Eigen::Index i = 0; i < 6; ++i) {
    VectorXd ends[2];
    for (const int side : {0, 1}) {
      const auto end =
          time::newmark_map(newmark, state(start + (side == 0 ? -h : h) * VectorXd::Unit(6, i))).end;
      ends[side].resize(6);
      ends[side] << end.x, end.v;
    }
    CAPTURE(i);
    CHECK(((ends[1] - ends[0]) / (2 * h) - map.monodromy.col(i)).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE("van der Pol's oscillator, hardly forced, grows to nearly twice q0 in time") {
  // m = k = 1: the limit cycle has the amplitude 2 q0 (1 + O((c/m w)^2)).
  const scene::Scene s =
      oscillator(R"("type": "van_der_pol", "coefficient": 0.05, "amplitude": 0.5)", 0, 5, 1, 1e-3);
  const auto motion = observables::motion_in_time(s, {.frequency = 1,
                                                      .method = observables::TimeMethod::newmark,
                                                      .steps = 400,
                                                      .periods = 100,
                                                      .recorded = 3,
                                                      .tolerance = 0});
  CAPTURE(motion.stop.message);
  CHECK(motion.amplitude == Approx(1).epsilon(0.02));
}

TEST_CASE("regularized friction comes to Coulomb's friction without stops, linearly in its velocity") {
  // Den Hartog 1931, F_f/F = 0.3 at r = 0.8.
  const auto at = [](double v0, int order) {
    const scene::Scene s = oscillator(
        R"("type": "tanh_friction", "friction_coefficient": 0.3, "normal_load": 1, "reference_velocity": )" +
            scene::file::json_text(scene::file::node(v0)),
        0, order, 1, 1);
    const auto found = observables::point_responses(s, {.frequency = 0.8});
    REQUIRE(found.size() == 1);
    REQUIRE(found[0].status == observables::Status::complete);
    return found[0].point;
  };
  const double coarse = at(0.1, 101).amplitude, fine = at(0.03, 201).amplitude;
  CHECK(std::abs(fine - 2.62610487572) < 2.4e-3);
  CHECK(fine + (fine - coarse) * 0.03 / 0.07 == Approx(2.62610487572).epsilon(1e-4));
  // The truncation estimate is of what few harmonics, and the samples that go with them, lack.
  const auto few = at(0.03, 51);
  CHECK(few.truncation_estimate == Approx(std::abs(few.amplitude - fine)).epsilon(0.2));
}

TEST_CASE("where samples do not resolve regularized friction the truncation estimate is flagged") {
  const auto at = [](double v0, int order) {
    const scene::Scene s = oscillator(
        R"("type": "tanh_friction", "friction_coefficient": 0.3, "normal_load": 1, "reference_velocity": )" +
            scene::file::json_text(scene::file::node(v0)),
        0, order, 1, 1);
    const auto found = observables::point_responses(s, {.frequency = 0.8});
    REQUIRE(found.size() == 1);
    REQUIRE(found[0].status == observables::Status::complete);
    return found[0].point;
  };
  for (const int order : {9, 25, 51}) {
    for (const double v0 : {1e-3, 1e-6}) {  // as rigid: Den Hartog 1931
      const auto point = at(v0, order);
      CAPTURE(order, v0, point.amplitude - 2.62610487572, point.truncation_estimate);
      CHECK(point.truncation_flagged);
    }
    for (const double v0 : {0.3, 0.1, 0.03}) {
      const auto point = at(v0, order);
      const double error = std::abs(point.amplitude - at(v0, 401).amplitude);
      CAPTURE(order, v0, error, point.truncation_estimate);
      CHECK_FALSE(point.truncation_flagged);
      CHECK(point.truncation_estimate > 0.7 * error);
    }
  }
}

TEST_CASE("laws of velocity keep numbers at all amplitudes") {
  const Harmonics h{5, false};
  const struct {
    const PlainLaw& law;
    std::vector<double> fields;
  } all[] = {{quadratic_damper(), {1e6}}, {van_der_pol(), {1, 1e-6}}, {tanh_friction(), {0.5, 2, 1e-12}}};
  for (const auto& each : all) {
    const auto element = each.law.element(h, {});
    element->set_frequency(1e3);
    for (const double size : {0.0, 1e-300, 1e-30, 1.0, 1e30}) {
      for (const VectorXd& shape : {VectorXd::Ones(h.size()).eval(), cosine(h, 1)}) {
        element->move_to(size * shape, each.fields, true);
        CAPTURE(each.law.name(), size);
        CHECK(element->force().allFinite());
        CHECK(element->jacobian().allFinite());
        VectorXd dF(h.size());
        element->frequency_derivative(dF);
        CHECK(dF.allFinite());
        for (std::size_t k = 0; k < each.fields.size(); ++k) {
          element->field_derivative(static_cast<int>(k), dF);
          CHECK(dF.allFinite());
        }
      }
    }
  }
}
