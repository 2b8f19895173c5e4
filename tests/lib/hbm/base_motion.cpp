// A moving ground: displacements are relative to it, and its acceleration loads every mass.
#include "catch.hpp"

#include "contains.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/observables/observe.hpp>

#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <numbers>

using namespace arcslip;
using continuation::Vector;
using Complex = std::complex<double>;
using std::numbers::pi;

namespace {

constexpr double m = 1.3, c = 0.11, k = 2.1;

// One mass on a spring and a damper.
scene::Scene oscillator(const std::string& excitation, const std::string& response,
                        const std::string& elements = "", int order = 3) {
  return scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1.3}],
      "springs": [{"name": "k", "at": "x", "value": 2.1}], "dampers": [{"name": "c", "at": "x", "value": 0.11}]},
    "elements": [)" +
      elements + R"(], "excitation": [)" + excitation + R"(], "harmonics": {"order": )" +
      std::to_string(order) + R"(}, "response": )" + response + "}");
}

const std::string displaced = R"({"name": "base", "type": "base_displacement", "cosine": 0.3, "sine": 0.4})";
const std::string accelerated =
    R"({"name": "base", "type": "base_acceleration", "cosine": 0.3, "sine": 0.4})";
const std::string both =
    R"([{"name": "relative", "at": "x"}, {"name": "absolute", "at": "x", "frame": "absolute"}])";
const std::string absolute = R"({"at": "x", "frame": "absolute"})";
const std::string slider =
    R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 1.7, "friction_coefficient": 0.5, "normal_load": 0.6},
       {"name": "g", "type": "gap_spring", "at": "x", "stiffness": 3, "gap": 0.4})";

observables::ResponsePoint at(const scene::Scene& s, double w) {
  const auto found = observables::point_responses(s, {.frequency = w});
  REQUIRE(found.size() == 1);
  return found[0].point;
}

// Three masses, of which the motion of the last is condensed; two of them on the ground, which moves c
// backwards.
const std::string chain = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "c"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1.5},
                 {"name": "mc", "at": "c", "value": 0.7}, {"name": "inerter", "between": ["a", "b"], "value": 0.4}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8},
                  {"name": "kbc", "direction": {"b": 1, "c": 2}, "value": 1.2}, {"name": "kc", "at": "c", "value": 0.5}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.03}, {"name": "cc", "at": "c", "value": 0.05}]},
    "elements": [ELEMENTS],
    "excitation": [{"name": "base", "type": "base_displacement", "direction": {"a": 1, "b": 1, "c": -0.5},
                    "cosine": 0.2, "sine": -0.1},
                   {"name": "shake", "type": "base_acceleration", "at": "b", "harmonic": 2, "cosine": 0.3},
                   {"name": "f", "at": "c", "harmonic": 1, "sine": 0.2}],
    "harmonics": {"order": 4},
    "response": [{"name": "a", "at": "a", "frame": "absolute"}, {"name": "b", "at": "b", "frame": "absolute"},
                 {"name": "c", "at": "c", "frame": "absolute"}]})";

scene::Scene chain_with(const std::string& elements) {
  std::string text = chain;
  return scenes::parse(text.replace(text.find("ELEMENTS"), 8, elements));
}

const std::string cubic = R"({"name": "s", "type": "cubic_spring", "at": "a", "stiffness": 0.3})";

}  // namespace

TEST_CASE("one mass on a moving ground has the transmissibility of the textbooks, relative and absolute") {
  for (const double w : {0.2, 1.0, 1.27, 2.0, 15.0}) {
    CAPTURE(w);
    const double r = w / std::sqrt(k / m), zeta = c / (2 * std::sqrt(k * m));
    const double size = 1 / std::hypot(1 - r * r, 2 * zeta * r);
    const Complex H = 1.0 / Complex(1 - r * r, 2 * zeta * r);
    const auto point = at(oscillator(displaced, both), w);
    CHECK(std::abs(point.amplitude / (0.5 * r * r * size) - 1) < 1e-13);
    REQUIRE(point.responses.size() == 2);
    CHECK(std::abs(point.responses[0].amplitude / (0.5 * r * r * size) - 1) < 1e-13);
    CHECK(std::abs(point.responses[1].amplitude / (0.5 * std::hypot(1, 2 * zeta * r) * size) - 1) < 1e-13);
    CHECK(std::abs(point.responses[0].phase + std::arg(H)) < 1e-12);
    CHECK(std::abs(point.responses[1].phase + std::arg(Complex(1, 2 * zeta * r) * H)) < 1e-12);
    const auto alone = at(oscillator(displaced, absolute), w);
    CHECK(std::abs(alone.amplitude / point.responses[1].amplitude - 1) < 1e-14);
    const auto by_acceleration = at(oscillator(accelerated, both), w);
    CHECK(std::abs(by_acceleration.amplitude / (0.5 * m / k * size) - 1) < 1e-13);
    CHECK(std::abs(by_acceleration.responses[1].amplitude /
                       (0.5 / (w * w) * std::hypot(1, 2 * zeta * r) * size) -
                   1) < 1e-13);
    CHECK(std::abs(point.energy_input / point.energy_total() - 1) < 1e-12);
    CHECK(std::abs(point.energy_viscous / (pi * c * w * std::pow(point.amplitude, 2)) - 1) < 1e-12);
  }
}

TEST_CASE("the peaks over the frequency are those of the relative and of the absolute transmissibility") {
  const double zeta = c / (2 * std::sqrt(k * m)), w_0 = std::sqrt(k / m);
  for (const bool is_absolute : {false, true}) {
    const auto s = oscillator(displaced, is_absolute ? absolute : R"({"at": "x"})");
    const auto branches = observables::frequency_response(s, {0.5, 3});
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].events.size() == 1);
    const double r = is_absolute ? std::sqrt((std::sqrt(1 + 8 * zeta * zeta) - 1)) / (2 * zeta)
                                 : 1 / std::sqrt(1 - 2 * zeta * zeta);
    const double of_ground = is_absolute ? std::hypot(1, 2 * zeta * r) : r * r;
    CAPTURE(is_absolute);
    CHECK(std::abs(branches[0].events[0].point.omega / (r * w_0) - 1) < 1e-9);
    CHECK(std::abs(branches[0].events[0].point.amplitude /
                       (0.5 * of_ground / std::hypot(1 - r * r, 2 * zeta * r)) -
                   1) < 1e-12);
  }
}

TEST_CASE("a structure on a moving ground moves as in coordinates of a frame at rest") {
  // M x'' + C (x - r X)' + K (x - r X) = f of the absolute x
  const scene::Scene s = chain_with("");
  const auto model = model::build(s);
  const Vector p0 = model::defaults(model);
  const Eigen::MatrixXd M = model::mass_matrix(model, p0), C = model::damping_matrix(model, p0),
                        K = model::stiffness_matrix(model, p0);
  const Eigen::Vector3d r(1, 1, -0.5), b(0, 1, 0);
  for (const double w : {0.4, 0.9, 1.7, 6.0}) {
    CAPTURE(w);
    const auto Z = [&](double at) -> Eigen::MatrixXcd {
      return (K - at * at * M).cast<Complex>() + Complex(0, at) * C.cast<Complex>();
    };
    const auto held = [&](double at) -> Eigen::MatrixXcd {
      return K.cast<Complex>() + Complex(0, at) * C.cast<Complex>();
    };
    const Complex X(0.2, 0.1);
    const Eigen::VectorXcd f = Complex(0, -0.2) * Eigen::Vector3d(0, 0, 1).cast<Complex>();
    const Eigen::VectorXcd first = Z(w).partialPivLu().solve(held(w) * r.cast<Complex>() * X + f);
    const Complex X2 = -0.3 / (4 * w * w);
    const Eigen::VectorXcd second = Z(2 * w).partialPivLu().solve(held(2 * w) * b.cast<Complex>() * X2);
    const auto point = at(s, w);
    REQUIRE(point.responses.size() == 3);
    for (int i = 0; i < 3; ++i) {
      double largest = 0;
      for (int j = 0; j < 200000; ++j) {
        const double theta = 2 * pi * j / 200000;
        largest = std::max(
            largest,
            std::abs((first[i] * std::polar(1.0, theta) + second[i] * std::polar(1.0, 2 * theta)).real()));
      }
      CHECK(std::abs(point.responses[static_cast<std::size_t>(i)].amplitude / largest - 1) < 2e-9);
    }
    REQUIRE(point.coefficients.size() == 10);  // of harmonics 0 to 4 of a
    CHECK(std::abs(Complex(point.coefficients[2], -point.coefficients[3]) - first[0]) < 1e-13);
    CHECK(std::abs(Complex(point.coefficients[4], -point.coefficients[5]) - second[0]) < 1e-13);
    CHECK(std::abs(point.energy_input / point.energy_total() - 1) < 1e-11);
  }
}

TEST_CASE("a contact with the ground moves as under the force that the acceleration of the ground makes") {
  const double w = 0.9;
  auto moved = oscillator(displaced, R"({"at": "x"})", slider, 15);
  const std::string force = R"({"name": "f", "at": "x"})";
  auto pushed = oscillator(force, R"({"at": "x"})", slider, 15);
  scene::set(pushed, "f.cosine", m * w * w * 0.3);
  scene::set(pushed, "f.sine", m * w * w * 0.4);
  const auto a = at(moved, w), b = at(pushed, w);
  CHECK(a.elements[0].stick_percent < 90);
  CHECK(std::abs(a.amplitude / b.amplitude - 1) < 1e-12);
  CHECK((Eigen::Map<const Vector>(a.unknowns.data(), 31) - Eigen::Map<const Vector>(b.unknowns.data(), 31))
            .norm() < 1e-12);
  CHECK(std::abs(a.energy_input / a.energy_total() - 1) < 1e-9);
  for (const auto method : {observables::TimeMethod::shooting, observables::TimeMethod::newmark_shooting,
                            observables::TimeMethod::event_driven}) {
    const auto of_moved = observables::motion_in_time(moved, {.frequency = w, .method = method});
    const auto of_pushed = observables::motion_in_time(pushed, {.frequency = w, .method = method});
    REQUIRE(of_moved.status == observables::Status::complete);
    CHECK(std::abs(of_moved.amplitude / of_pushed.amplitude - 1) < 1e-12);
    CHECK(std::abs(of_moved.energy.defect()) < 1e-5 * of_moved.energy.input);
    CHECK(std::abs(of_moved.amplitude / a.amplitude - 1) < 2e-3);  // of harmonic balance with 15 harmonics
  }
}

TEST_CASE("in time a moving ground gives the motion of harmonic balance, absolute and relative") {
  for (const bool is_absolute : {false, true})
    for (const std::string& excitation : {displaced, accelerated}) {
      CAPTURE(is_absolute, excitation);
      const auto s = oscillator(excitation, is_absolute ? absolute : R"({"at": "x"})");
      const double exact = at(s, 1.1).amplitude;
      const auto marched = observables::motion_in_time(s, {.frequency = 1.1});
      REQUIRE(marched.status == observables::Status::complete);
      CHECK(marched.integrator == "event-driven");
      CHECK(std::abs(marched.amplitude / exact - 1) < 1e-12);
      REQUIRE(marched.history.displacement.size() > 700);
      const auto point = at(s, 1.1);  // its coefficients
      for (const std::size_t i : {0, 123, 700}) {
        const double angle = 1.1 * marched.history.time[i];
        const double x = point.coefficients[0] * std::cos(angle) + point.coefficients[1] * std::sin(angle);
        const double v =
            1.1 * (point.coefficients[1] * std::cos(angle) - point.coefficients[0] * std::sin(angle));
        CHECK(std::abs(marched.history.displacement[i] - x) < 1e-12);
        CHECK(std::abs(marched.history.velocity[i] - v) < 1e-12);
      }
      const auto stepped = observables::motion_in_time(
          s, {.frequency = 1.1, .method = observables::TimeMethod::newmark_shooting});
      REQUIRE(stepped.status == observables::Status::complete);
      CHECK(std::abs(stepped.amplitude / exact - 1) < 1e-4);
    }
}

TEST_CASE(
    "the equations and the absolute response change with frequency, masses and motion as differences do") {
  scene::Scene s = chain_with(cubic);
  s.responses[0].direction = {{1, 1.0}, {2, 1.0}};  // of the condensed motion
  s.responses[0].others = {{{0, 1.0}}, {{2, -0.5}}};
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  const Vector p = hbm::parameters_at(problem, 1.3);
  const auto evaluator = problem.hbm_evaluator();
  REQUIRE(evaluator->stiffness().places() == 3);
  const Eigen::Index size = problem.harmonics().size();
  int seen = 0;
  for (const Vector& u : {Vector(Vector::Random(problem.size())), Vector(Vector::Zero(problem.size()))})
    for (int j = 0; j < p.size() - 1; ++j) {
      CAPTURE(u.norm(), model->parameters[static_cast<std::size_t>(j)].name);
      const auto moved = [&](double step) {
        Vector q = p;
        q[j] += step;
        REQUIRE(evaluator->move_to(u, q, continuation::Needs::residual) == continuation::Evaluated::ok);
        Vector all(problem.size() + 3 * size);
        for (int place = 0; place < 3; ++place)
          evaluator->stiffness().response(u, evaluator->force_factor(),
                                          all.segment(problem.size() + place * size, size), place);
        all.head(problem.size()) = evaluator->residual();
        return all;
      };
      const Vector difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
      moved(0);
      Vector derivative(difference.size());
      evaluator->parameter_derivative(j, derivative.head(problem.size()));
      for (int place = 0; place < 3; ++place)
        evaluator->stiffness().response_derivative(
            j, u, evaluator->force_factor(), derivative.segment(problem.size() + place * size, size), place);
      CHECK((difference - derivative).norm() < 1e-8 * (1 + derivative.norm()));
      if (derivative.segment(problem.size(), size).norm() > 0.01) ++seen;
    }
  CHECK(seen > 10);
  for (int place = 0; place < 3; ++place) {  // a . x changes as L^T a . u
    const Vector weights = Vector::Random(size), du = Vector::Random(problem.size());
    Vector dx(size), by(problem.size());
    evaluator->stiffness().response(du, 0, dx, place);
    evaluator->stiffness().response_transposed(weights, by, place);
    CHECK(std::abs(weights.dot(dx) - by.dot(du)) < 1e-12 * (1 + dx.norm()));
  }
}

TEST_CASE("a constant acceleration of the ground is a weight, in harmonics and in time") {
  const std::string weight =
      displaced + R"(, {"name": "g", "type": "base_acceleration", "harmonic": 0, "cosine": 9.81})";
  const auto s = oscillator(weight, R"({"at": "x"})");
  const auto point = at(s, 0.7);
  REQUIRE(point.coefficients.size() == 8);
  CHECK(std::abs(point.coefficients[0] + 9.81 * m / k) < 1e-13);
  const auto motion = observables::motion_in_time(s, {.frequency = 0.7});
  CHECK(std::abs(motion.amplitude / point.amplitude - 1) < 1e-12);
}

TEST_CASE("a motion of the ground is a parameter: over it, the response of a linear structure is a line") {
  auto s = oscillator(R"({"name": "base", "type": "base_displacement", "cosine": 0.3})", absolute);
  const auto branches =
      observables::parameter_response(s, {.over = "base.cosine", .from = 0.1, .to = 2, .frequency = 1.1});
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  const double slope = branches[0].points.back().amplitude / 2;
  for (const auto& point : branches[0].points) CHECK(std::abs(point.amplitude - slope * point.over) < 1e-12);
}

TEST_CASE("motions of the ground are written as they are read, with the degrees of freedom that they move") {
  const scene::Scene s = chain_with(cubic);
  CHECK(scenes::parse(scene::write(s)) == s);
  const scene::Scene all = oscillator(displaced, both);
  CHECK(all.excitation[0].directions[0] == scene::Direction{{0, 1.0}});
  CHECK(scenes::parse(scene::write(all)) == all);
  const auto fault = [](const std::string& excitation, const std::string& response = R"({"at": "x"})") {
    try {
      oscillator(excitation, response);
    } catch (const scene::SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string constant = R"({"name": "b", "type": "base_acceleration", "harmonic": 0, "cosine": 1})";
  CHECK(contains(
      fault(displaced + R"(, {"name": "b", "type": "base_displacement", "harmonic": 0, "cosine": 1})"),
      "a constant one moves nothing relative to it"));
  CHECK(contains(fault(R"({"name": "b", "type": "base_velocity", "cosine": 1})"), "must be one of"));
  CHECK(contains(fault(constant), "found constant forces alone"));
  CHECK(contains(fault(displaced + "," + constant, absolute),
                 "must be \"relative\" where the ground has a constant acceleration"));
  CHECK(contains(fault(displaced, R"({"at": "x", "frame": "moving"})"), "must be"));
}

TEST_CASE("the absolute peaks over the amplitude of the ground are those of its frequency responses") {
  auto s = oscillator(
      R"({"name": "base", "type": "base_displacement", "cosine": 0.3})", absolute,
      R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 1.7, "friction_coefficient": 0.5, "normal_load": 0.6})");
  const auto curves = observables::resonance_peaks(s, {"base.cosine", 0.3, 0.6, 0.5, 3});
  REQUIRE(curves.size() == 1);
  CHECK(curves[0].status == observables::Status::complete);
  for (const double ground : {0.3, 0.6}) {
    scene::set(s, "base.cosine", ground);
    const auto branches = observables::frequency_response(s, {0.5, 3});
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].events.size() == 1);
    const auto& peak = branches[0].events[0].point;
    const auto& end = ground == 0.3 ? curves[0].points.front() : curves[0].points.back();
    CHECK(std::abs(end.over - ground) < 1e-12);
    CHECK(std::abs(end.amplitude / peak.amplitude - 1) < 1e-10);
    CHECK(std::abs(end.omega / peak.omega - 1) < 1e-7);
  }
}
