#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/every_law.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/grazing_problem.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;
using continuation::Vector;
using std::numbers::pi;

namespace {

std::shared_ptr<const elements::Law> one_sided() {
  return elements::gap_spring().law({});
}

// m = 1, k = 1, c, a stop at the gap, f cos wt.
scene::Scene stop(int order, double gap, double stiffness, double force, double damping = 0.1) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": )"
       << damping << R"(}]}, "elements": [{"name": "stop", "type": "gap_spring", "at": "x", "stiffness": )"
       << stiffness << R"(, "gap": )" << gap << R"(}], "excitation": [{"name": "f", "at": "x", "cosine": )"
       << force << R"(}], "harmonics": {"order": )" << order
       << R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 0.4, "to": 2.5}]})";
  return scenes::parse(text.str());
}

}  // namespace

TEST_CASE("a stop at zero halves the force of a cosine: coefficients of the half wave") {
  // max(cos, 0) = 1/pi + cos/2 + (2/pi) sum (-1)^(n+1) cos 2n theta/(4 n^2 - 1)
  const elements::Harmonics h{6, false};
  const auto element = one_sided()->element(h, {});
  Vector u = Vector::Zero(h.size());
  u[h.cosine_index(1)] = 3;
  element->move_to(u, std::vector<double>{2, 0}, true);
  const Vector& F = element->force();
  CHECK(std::abs(F[0] - 6 / pi) < 1e-14);
  CHECK(std::abs(F[1] - 3) < 1e-14);
  for (int n = 1; n <= 3; ++n)
    CHECK(std::abs(F[2 * n] - 6 * 2 / pi * (n % 2 == 1 ? 1 : -1) / (4.0 * n * n - 1)) < 1e-14);
  CHECK(F.tail(h.sines()).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("a gap spring keeps what every law promises, with many contacts in a period") {
  for (const double gap : {-0.3, 0.01, 0.2, 1.0})
    for (unsigned seed = 1; seed < 20; ++seed) {
      CAPTURE(gap, seed);
      every_law::check_element(*one_sided(), {3, gap}, 1, false, 1e-6, 1e-6, 1e-6, seed);
      every_law::check_element(*one_sided(), {3, gap}, 1, true, 1e-6, 1e-6, 1e-6, seed);
    }
  every_law::check_step(*one_sided(), {3, 0.2}, 1, 1e-7, 1e-6, 3);
  every_law::check_energy(*one_sided(), {3, 0.2}, 1, 1e-5, 3);
}

TEST_CASE(
    "out of reach a stop changes nothing, and always in contact it is a spring that is drawn by its gap") {
  const auto free = observables::point_responses(stop(5, 100, 50, 1), {.frequency = 0.8});
  REQUIRE(free.size() == 1);
  CHECK(std::abs(free[0].point.amplitude - 1 / std::hypot(1 - 0.64, 0.08)) < 1e-13);
  const elements::Harmonics h{4, false};
  const auto element = one_sided()->element(h, {});
  Vector u = Vector::Zero(h.size());
  u[0] = 5;
  u[h.cosine_index(2)] = 0.7;
  element->move_to(u, std::vector<double>{2, 1}, true);
  const auto always = element->piece();
  Vector expected = 2 * u;
  expected[0] -= 2;
  CHECK((element->force() - expected).norm() < 1e-14);
  CHECK((element->jacobian() - 2 * Eigen::MatrixXd::Identity(h.size(), h.size())).norm() < 1e-13);
  u[h.cosine_index(1)] = 5;  // leaves the stop once in a period
  element->move_to(u, std::vector<double>{2, 1}, true);
  CHECK(element->piece() != always);
  u.tail(h.size() - 1).setZero();
  element->move_to(u, std::vector<double>{2, 1}, true);
  CHECK(std::abs(element->force()[0] - 8) < 1e-14);
  u[0] = 0.5;
  element->move_to(u, std::vector<double>{2, 1}, true);
  CHECK(element->force().norm() == 0);
}

TEST_CASE(
    "pressed onto its stop by a constant force a mass moves about its place at rest as on two springs") {
  scene::Scene s = stop(5, 0.5, 8, 0.2);
  scene::Part load = s.excitation.front();
  load.name = "load";
  load.harmonic = 0;
  load.values = {6, 0};
  s.excitation.push_back(load);
  scene::check(s);
  const double place = (6 + 8 * 0.5) / 9;
  for (const double w : {0.5, 2.0, 4.0}) {
    const auto found = observables::point_responses(s, {.frequency = w});
    const double amplitude = 0.2 / std::hypot(9 - w * w, 0.1 * w);
    REQUIRE(place - amplitude > 0.5);
    REQUIRE_FALSE(found.empty());
    const auto& point = found.front().point;
    CHECK(std::abs(point.coefficients[0] - place) < 1e-13);
    CHECK(std::abs(point.amplitude - place - amplitude) < 1e-13);
    const auto motion = observables::motion_in_time(s, {.frequency = w});
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(std::abs(motion.amplitude - place - amplitude) < 1e-9);
  }
}

TEST_CASE("a response with contact comes to the exact motion as N^-3") {
  double last = 0;
  for (const int order : {15, 31, 63, 101}) {
    const scene::Scene s = stop(order, 0.3, 20, 1);
    const auto found = observables::point_responses(s, {.frequency = 1.7});
    REQUIRE(found.size() == 1);
    const auto model = model::build(s);
    Vector p = model::defaults(model);
    p[model::frequency] = 1.7;
    time::EventDriven march(time::equation_of_motion(model, p));
    const auto exact = time::periodic_motion(march, time::at_rest(march.equation()));
    REQUIRE(exact.converged());
    REQUIRE(exact.period.events.size() == 2);
    CHECK(exact.period.events[0].to != exact.period.events[1].to);
    const double error = std::abs(found[0].point.amplitude / exact.period.amplitude - 1);
    CAPTURE(order, error, found[0].point.amplitude);
    CHECK(error < 40 * std::pow(order, -3.0));
    last = error;
    CHECK(std::abs(exact.period.energy.defect()) < 1e-13);
  }
  CHECK(last < 1e-6);
}

TEST_CASE("without a gap the oscillator is bilinear at any force, and resonates at 2 w1 w2/(w1 + w2)") {
  // Rest is a kink there, and no branch leads from it: the response is found by elements that come in
  // gradually.
  const double w2 = std::sqrt(3.0), resonance = 2 * w2 / (1 + w2);
  for (const double force : {1.0, 1e-6, 1e6}) {
    scene::Scene s = stop(15, 0, 2, force, 0.02);
    scenes::window(s) = {1.2, 1.35};
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].status == observables::Status::complete);
    REQUIRE(branches[0].events.size() == 1);
    CHECK(std::abs(branches[0].events[0].point.omega / resonance - 1) < 1e-4);
  }
  for (const double stiffness : {2.0, 20.0, 200.0}) {
    const auto found = observables::point_responses(stop(31, 0, stiffness, 1), {.frequency = 1.7});
    const auto motion = observables::motion_in_time(stop(5, 0, stiffness, 1), {.frequency = 1.7});
    REQUIRE(motion.status == observables::Status::complete);
    REQUIRE_FALSE(found.empty());
    double nearest = 1;
    for (const auto& response : found)
      nearest = std::min(nearest, std::abs(response.point.amplitude / motion.amplitude - 1));
    CHECK(nearest < 2e-4);
  }
}

TEST_CASE("in time a stop is met at exact instants, and Newmark's steps come to the same at second order") {
  const scene::Scene s = stop(5, 0.3, 20, 1);
  const auto exact = observables::motion_in_time(s, {.frequency = 1.7});
  REQUIRE(exact.status == observables::Status::complete);
  CHECK(exact.integrator == "event-driven");
  double last = 0;
  for (const int steps : {500, 1000, 2000}) {
    const auto motion = observables::motion_in_time(
        s, {.frequency = 1.7, .method = observables::TimeMethod::newmark_shooting, .steps = steps});
    REQUIRE(motion.status == observables::Status::complete);
    const double error = std::abs(motion.amplitude / exact.amplitude - 1);
    if (last > 0) CHECK(error < 0.4 * last);
    last = error;
    // Multipliers at first order only: contact begins within a step, and its tangent counts for all of it.
    CHECK(std::abs(std::abs(motion.multipliers[0]) - std::abs(exact.multipliers[0])) < 10.0 / steps);
  }
  CHECK(last < 1e-4);
}

TEST_CASE("the branch bends where the stop is met, and grazing is a corner of the response") {
  // The linear response reaches the gap at |x| = 0.3: f/|Z| = gap.
  const scene::Scene s = stop(9, 0.3, 5, 0.1, 0.05);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].status == observables::Status::complete);
  std::size_t touching = 0;
  for (const auto& point : branches[0].points) {
    const double linear = 0.1 / std::hypot(1 - point.omega * point.omega, 0.05 * point.omega);
    if (point.amplitude < 0.3) CHECK(std::abs(point.amplitude - linear) < 1e-12);
    touching += point.amplitude > 0.3 ? 1 : 0;
  }
  CHECK(touching > 10);
  // 0.1/|Z(w)| = 0.3 below resonance
  const double w2 = [] {
    double low = 0.5, high = 1;
    for (int i = 0; i < 100; ++i) {
      const double w = 0.5 * (low + high);
      (0.1 / std::hypot(1 - w * w, 0.05 * w) < 0.3 ? low : high) = w;
    }
    return low;
  }();
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const Vector p = hbm::parameters_at(problem, w2);
  const Vector u = hbm::linear_response(problem, p);
  auto corners = hbm::corners_near(problem, u, p, 1e-8);
  REQUIRE(corners.size() == 1);
  const auto h = hbm::corner_excess(problem, corners[0], u, p);
  REQUIRE(h);
  CHECK(std::abs(*h) < 1e-12);
  Vector x(u.size() + 1);
  x << u, w2;
  const auto equations = hbm::corner_points(std::make_shared<const hbm::HbmProblem>(problem), corners[0]);
  const auto check = continuation::check_jacobian(*equations, hbm::with_angles(x, corners[0]), p);
  CHECK(check.message == "");
}

TEST_CASE("of two contacts that touch together by a symmetry of the motion one is listed") {
  const elements::Harmonics h{4, false};
  const auto corners = one_sided()->corners(h);
  Vector w = Vector::Zero(h.size());
  w[h.cosine_index(2)] = 1;
  CHECK(corners->near(w, std::vector<double>{3, 1 + 1e-9}, 1e-6).size() == 1);
  w[h.cosine_index(1)] = 1e-7;  // no image any more
  CHECK(corners->near(w, std::vector<double>{3, 1 + 1e-9}, 1e-6).size() == 2);
}

TEST_CASE("a mass that only a gap spring holds is refused, since nothing holds its mean") {
  scene::Scene s = stop(5, 0.3, 20, 1);
  scene::set(s, "k.value", 0);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::failed);
  CHECK(branches[0].stop.message.find("\"x\"") != std::string::npos);
}

TEST_CASE(
    "the example of two masses and a stop grazes in closed form, and folds where the motion in time does") {
  scene::Scene s = scenes::example("unilateral_oscillator");
  // |x1| of the linear structure is the gap of 1 m at this frequency.
  const auto grazing = observables::point_responses(s, {.frequency = 0.58189963904});
  REQUIRE(grazing.size() == 1);
  CHECK(std::abs(grazing[0].point.amplitude - 1) < 1e-10);

  s.harmonics.order = 63;
  const auto branches = observables::frequency_response(s, {0.5, 1});
  REQUIRE(branches.size() == 1);
  CAPTURE(branches[0].stop.message);
  CHECK(branches[0].status == observables::Status::complete);
  std::vector<double> folds;
  for (const auto& event : branches[0].events)
    if (event.kind == "fold") folds.push_back(event.point.omega);
  REQUIRE(folds.size() == 2);
  CHECK(std::abs(folds[0] - 0.75562735) < 5e-8);  // shooting with Runge-Kutta steps from contact to contact
  CHECK(std::abs(folds[0] - 0.7556255) < 3e-6);   // another program

  // The motion loses its stability at 0.6186069 rad/s, by shooting of another program.
  for (const double omega : {0.618605, 0.618609}) {
    const auto motion = observables::motion_in_time(s, {.frequency = omega});
    CAPTURE(omega, motion.stop.message);
    REQUIRE(motion.status == observables::Status::complete);
    REQUIRE(motion.stable);
    CHECK(*motion.stable == (omega > 0.6186069));
  }
}
