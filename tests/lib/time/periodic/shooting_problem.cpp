// Derivatives of the equations of shooting, by differences.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/periodicity_conditions.hpp>
#include <arcslip/time/periodic/shooting.hpp>
#include <arcslip/time/periodic/shooting_problem.hpp>

#include <memory>

using namespace arcslip;
using continuation::Needs;
using continuation::Vector;

namespace {

// Next to a periodic motion, so that no term of the residual vanishes.
struct Place {
  std::shared_ptr<const time::ShootingProblem> problem;
  Vector X, p;
};

Place place(const scene::Scene& s, double omega, double nearby = 1e-3) {
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem unscaled(model, model->harmonics, 1, omega);
  const Vector of_series = hbm::parameters_at(unscaled, omega);
  const auto series =
      std::make_shared<const hbm::HbmProblem>(unscaled, hbm::linear_response(unscaled, of_series).norm());
  const auto u = hbm::steady_state(series, of_series).u;
  REQUIRE(u);
  Place found;
  found.X = time::stacked(time::state_of(*series, *u, of_series));
  found.p = of_series.head(of_series.size() - 1);
  const double size = found.X.head(model->dofs).norm();
  found.problem = std::make_shared<const time::ShootingProblem>(model, size, omega, omega);
  const Vector scales = found.problem->scales();
  for (Eigen::Index i = 0; i < found.X.size(); ++i)
    found.X[i] += nearby * scales[i] * std::cos(1.0 + static_cast<double>(i));
  return found;
}

void check_derivatives(const scene::Scene& s, double omega, double near_it = 1e-3) {
  const Place at = place(s, omega, near_it);
  const auto wrong = continuation::check_jacobian(*at.problem, at.X, at.p);
  CAPTURE(wrong.message, wrong.row, wrong.column, wrong.given, wrong.difference);
  CHECK(wrong.relative < 1e-6);  // of differences; columns have entries in m and in m/s

  // Of the amplitude.
  time::ShootingEvaluator here(*at.problem), nearby(*at.problem);
  REQUIRE(here.move_to(at.X, at.p, Needs::jacobian) == continuation::Evaluated::ok);
  const Eigen::RowVectorXd by = here.orbit().amplitude_by;
  const auto difference = [&](double& varied, const Vector& X, const Vector& p, double h) {
    double A[2];
    const double middle = varied;
    for (const int side : {0, 1}) {
      varied = middle + (side == 0 ? -h : h);
      REQUIRE(nearby.move_to(X, p, Needs::residual) == continuation::Evaluated::ok);
      A[side] = nearby.amplitude();
    }
    varied = middle;
    return (A[1] - A[0]) / (2 * h);
  };
  const Vector scales = at.problem->scales();
  const double size = at.problem->displacement();
  Vector X = at.X, p = at.p;
  for (Eigen::Index i = 0; i < X.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(by[i] - difference(X[i], X, p, 1e-5 * scales[i])) < 1e-7 * size / scales[i]);
  }
  for (int k = 0; k < static_cast<int>(p.size()); ++k) {
    const double scale = p[k] != 0 ? std::abs(p[k]) : 1;
    CAPTURE(at.problem->parameters()[static_cast<std::size_t>(k)].name);
    CHECK(std::abs(here.amplitude_derivative(k) - difference(p[k], X, p, 1e-5 * scale)) <
          1e-7 * size / scale);
  }
}

std::string two_dampers(const std::string& excitation, const std::string& frame = "relative") {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 0.6}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.05}, {"name": "cab", "between": ["a", "b"], "value": 0.02}]},
    "elements": [
      {"name": "d1", "type": "jenkins", "at": "a", "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 0.9},
      {"name": "d2", "type": "jenkins", "between": ["a", "b"], "stiffness": 0.3, "friction_coefficient": 0.5,
       "normal_load": 0.5},
      {"name": "stop", "type": "gap_spring", "at": "b", "stiffness": 3, "gap": 0.8}],
    "excitation": [)" +
         excitation + R"(], "harmonics": {"order": 15}, "response": {"at": "b", "frame": ")" + frame +
         R"("}})";
}

}  // namespace

TEST_CASE("derivatives of shooting are those of differences, by the state and by every parameter") {
  check_derivatives(scenes::paper(15), 20 * scenes::hertz);       // slips
  check_derivatives(scenes::paper(15, 300), 20 * scenes::hertz);  // sticks throughout
  const auto s = scenes::parse(two_dampers(
      R"({"name": "f", "at": "b", "cosine": 1, "sine": 0.3}, {"name": "g", "at": "a", "harmonic": 2,
                      "cosine": 0.2, "sine": 0.1})"));
  for (const double omega : {0.5, 0.9, 1.6}) check_derivatives(s, omega);
}

TEST_CASE("derivatives of shooting with every law that has pieces") {
  const std::string some = R"({"name": "f", "at": "b", "cosine": 0.5, "sine": 0.2},
                              {"name": "g", "at": "a", "harmonic": 0, "cosine": 0.1})";
  const std::string much = R"({"name": "f", "at": "b", "cosine": 2, "sine": 0.2},
                              {"name": "g", "at": "a", "cosine": 1})";
  const std::string mostly_static = R"({"name": "f", "at": "b", "cosine": 0.25, "sine": 0.1},
                                       {"name": "g", "at": "a", "harmonic": 0, "cosine": 1.5})";
  const std::string contact = R"("type": "contact_2d", "tangential": {"at": "a"}, "normal": {"at": "b"},
                                 "tangential_stiffness": 0.7, "normal_stiffness": 0.5)";
  for (const auto& [element, excitation] :
       {std::pair{contact + R"(, "friction_coefficient": 0.4, "normal_load": 0.3)", some},
        {contact + R"(, "friction_coefficient": 0.4, "normal_load": 0.3)", much},  // opens
        {contact + R"(, "friction_coefficient": 0.2, "normal_load": 9)", some},
        {contact + R"(, "friction_coefficient": 0.7, "normal_load": 0.3)", much},  // and sticks again
        {R"("type": "iwan", "at": "a", "stiffness": 0.8, "slip_force": 0.5, "sliders": 4)", some},
        {R"("type": "jenkins", "at": "a", "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 1,
               "offset": "static")",
         mostly_static},  // held at its limit
        {R"("type": "jenkins", "direction": {"a": -1}, "stiffness": 0.6, "friction_coefficient": 0.4,
               "normal_load": 1, "offset": "static")",
         mostly_static},  // at the other one
        {R"("type": "jenkins", "at": "a", "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 8,
               "offset": "static")",
         some},
        {R"("type": "bilinear_spring", "at": "b", "stiffness": 0.2, "stiffness_beyond": 1.5, "corner": 0.4)",
         some},
        {R"("type": "piecewise_linear_spring", "at": "b", "factor": 1.2,
               "table": [[-0.5, -0.3], [0, 0], [0.4, 0.5], [0.9, 2]])",
         some}}) {
    CAPTURE(element, excitation);
    const auto s =
        scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["a", "b"],
        "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 0.6}],
        "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8}],
        "dampers": [{"name": "ca", "at": "a", "value": 0.05}, {"name": "cab", "between": ["a", "b"], "value": 0.02}]},
      "elements": [{"name": "e", )" +
                      element + R"(}], "excitation": [)" + excitation + R"(], "harmonics": {"order": 15},
      "response": {"at": "b"}})");
    // A slider that is held at its limit is next to slip: farther from that kink.
    const double near_it = excitation == mostly_static ? 0.1 : 1e-3;
    for (const double omega : {0.6, 1.1}) check_derivatives(s, omega, near_it);
  }
}

TEST_CASE("the instant at which a contact lands and sticks moves with its load") {
  const auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 0.6}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.05}, {"name": "cab", "between": ["a", "b"], "value": 0.02}]},
    "elements": [{"name": "e", "type": "contact_2d", "tangential": {"at": "a"}, "normal": {"at": "b"},
      "tangential_stiffness": 0.7, "normal_stiffness": 0.5, "friction_coefficient": 1.2, "normal_load": 0.3}],
    "excitation": [{"name": "f", "at": "b", "cosine": 2, "sine": 0.2}, {"name": "g", "at": "a", "cosine": 1}],
    "harmonics": {"order": 15}, "response": {"at": "b"}})");
  for (const double omega : {0.6, 1.1}) {
    CAPTURE(omega);
    const Place at = place(s, omega);
    const int load = model::parameter_index(at.problem->model(), "e.normal_load");
    time::ShootingEvaluator evaluator(*at.problem);
    REQUIRE(evaluator.move_to(at.X, at.p, Needs::jacobian) == continuation::Evaluated::ok);
    Vector dF(at.X.size()), p = at.p, difference = Vector::Zero(at.X.size());
    evaluator.parameter_derivative(load, dF);
    const double h = 1e-6;
    for (const double side : {1.0, -1.0}) {
      p[load] = at.p[load] + side * h;
      REQUIRE(evaluator.move_to(at.X, p, Needs::residual) == continuation::Evaluated::ok);
      difference += side / (2 * h) * evaluator.residual();
    }
    CHECK((dF - difference).norm() < 1e-6 * dF.norm());
  }
}

TEST_CASE("at a normal load of 0, where a damper has other modes, the derivatives are those next to it") {
  Place at = place(scenes::paper(15, 0), 20 * scenes::hertz);
  at.X[0] *= 0.5;  // so that the largest displacement is not that of the start
  const int load = model::parameter_index(at.problem->model(), "damper.normal_load");
  time::ShootingEvaluator here(*at.problem), nearby(*at.problem);
  REQUIRE(here.move_to(at.X, at.p, Needs::jacobian) == continuation::Evaluated::ok);
  Vector dF(at.X.size()), p = at.p;
  here.parameter_derivative(load, dF);
  REQUIRE(std::abs(here.amplitude_derivative(load)) > 0);
  const double h = 1e-8;  // each reversal sticks for a time that grows with its root
  p[load] = h;
  REQUIRE(nearby.move_to(at.X, p, Needs::residual) == continuation::Evaluated::ok);
  const Vector difference = (nearby.residual() - here.residual()) / h;
  CHECK((dF - difference).norm() < 2e-3 * difference.norm());
  CHECK(std::abs(here.amplitude_derivative(load) - (nearby.amplitude() - here.amplitude()) / h) <
        2e-3 * std::abs(here.amplitude_derivative(load)));
}

TEST_CASE("derivatives of shooting with a period of two of the excitation") {
  auto s = scenes::parse(two_dampers(R"({"name": "f", "at": "b", "cosine": 1, "sine": 0.3})"));
  s.harmonics.period = 2;
  check_derivatives(s, 1.1);
}

TEST_CASE("derivatives of shooting where the ground moves, whose forces depend on the frequency") {
  const auto s =
      scenes::parse(two_dampers(R"({"name": "u", "type": "base_displacement", "cosine": 0.8, "sine": 0.4},
                     {"name": "g", "type": "base_acceleration", "harmonic": 2, "cosine": 0.2, "sine": 0.1})",
                                "absolute"));
  for (const double omega : {0.6, 1.3}) check_derivatives(s, omega);
}

TEST_CASE("a slider at its limit to rounding where the period begins leaves the piece as it is") {
  const double omega = 20 * scenes::hertz;
  const auto s = scenes::paper(15);
  const Place at = place(s, omega, 0);
  time::EventDriven integrator(time::equation_of_motion(at.problem->model(), at.p));
  const auto motion = time::periodic_motion(integrator, time::unstacked(at.X, 1), {.transients = 0});
  REQUIRE(motion.converged());
  REQUIRE(motion.period.events.front().from.starts_with("slip"));
  time::ShootingEvaluator evaluator(*at.problem);
  const auto piece = [&](double share, const Vector& p) {
    Vector X = time::stacked(motion.shooting.start);
    X[2] += share * at.problem->displacement();
    REQUIRE(evaluator.move_to(X, p, Needs::residual) == continuation::Evaluated::ok);
    return evaluator.piece();
  };
  const auto here = piece(0, at.p);
  for (const double share : {1e-8, -1e-8, 1e-12, -1e-12}) CHECK(piece(share, at.p) == here);
  REQUIRE(evaluator.move_to(time::stacked(motion.shooting.start), at.p, Needs::jacobian) ==
          continuation::Evaluated::ok);
  CHECK(evaluator.piece() == here);
  Vector stuck = at.p;
  stuck[model::parameter_index(at.problem->model(), "damper.normal_load")] = 3000;
  CHECK(piece(0, stuck) != here);
}

TEST_CASE("a branch by shooting with too many events ends with their number") {
  const Place at = place(scenes::paper(15), 20 * scenes::hertz, 0);
  const double omega = at.p[model::frequency];
  const auto model = std::make_shared<const model::Model>(at.problem->model());
  const auto limited = std::make_shared<const time::ShootingProblem>(model, at.problem->displacement(), omega,
                                                                     omega, time::EventLimits{.events = 2});
  const auto branch = continuation::trace(limited, {at.X, at.p, model::frequency, 1},
                                          {.lower = 0.9 * omega, .upper = 1.1 * omega});
  CHECK(branch.points.empty());
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason == continuation::StopReason::not_evaluated);
  CHECK(branch.stop.message.find("2 events (the limit)") != std::string::npos);
}
