// Elements of type "formula" in scenes: reading and writing, and responses against closed forms and other
// methods.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/scene/format/json_schema.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

using namespace arcslip;

namespace {

// One mass with elements and forces.
scene::Scene oscillator(const std::string& elements, double k, double c, const std::string& harmonics,
                        double force = 0.5, const std::string& unit = "rad/s") {
  const auto number = [](double x) { return scene::file::number_text(x); };
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": ")" + unit + R"(",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": )" +
                       number(k) + R"(}],
      "dampers": [{"name": "c", "at": "x", "value": )" +
                       number(c) + R"(}]},
    "elements": [)" + elements +
                       R"(], "excitation": [{"name": "f", "at": "x", "cosine": )" + number(force) +
                       R"(}], "harmonics": )" + harmonics + R"(,
    "studies": [{"name": "frf", "kind": "frf", "from": 0.5, "to": 2}]})");
}

std::string own_force(const std::string& force, const std::string& parameters = "{}") {
  return R"({"name": "e", "type": "formula", "at": "x", "force": ")" + force + R"(", "parameters": )" +
         parameters + "}";
}

std::string faults(const std::string& element) {
  try {
    oscillator(element, 1, 0.1, R"({"order": 3})");
  } catch (const scene::SceneError& error) {
    std::string all;
    for (const auto& fault : error.faults()) all += fault.pointer + ": " + fault.message + "\n";
    return all;
  }
  return "";
}

observables::ResponsePoint at(const scene::Scene& s, double frequency) {
  const auto found = observables::point_responses(s, {.frequency = frequency});
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].status == observables::Status::complete);
  return found[0].point;
}

}  // namespace

TEST_CASE("a formula has its parameters as fields, and is written as it was read") {
  const scene::Scene s =
      oscillator(own_force("k*sin(q) + c*v^3", R"({"k": {"value": 4, "unit": "N"}, "c": 0.1})"), 1, 0.1,
                 R"({"order": 3})");
  REQUIRE(s.elements.size() == 1);
  CHECK(s.elements[0].values == std::vector<double>{4, 0.1});
  CHECK(scene::value(s, "e.k") == 4);
  CHECK(scene::parameter_field(s, "e.k").unit == "N");
  CHECK(scene::parameter_field(s, "e.c").unit == "-");
  const std::string text = scene::write(s);
  CHECK(text.find(R"("force": "k*sin(q) + c*v^3")") != std::string::npos);
  CHECK(text.find(R"("parameters": {"k": {"value": 4, "unit": "N"}, "c": 0.1})") != std::string::npos);
  CHECK(scene::write(scenes::parse(text)) == text);
}

TEST_CASE("over several displacements places are keys, or degrees of freedom of these names") {
  const scene::Scene s = scenes::parse(R"json({"format": "arcslip-scene-1", "structure": {"dofs": ["q1", "y"],
      "masses": [{"name": "m", "at": "q1", "value": 1}, {"name": "n", "at": "y", "value": 1}]},
    "elements": [{"name": "e", "type": "formula", "q2": {"between": ["q1", "y"]},
      "forces": ["k*q1", "k*(q1 - v2)"], "parameters": {"k": 2}}],
    "excitation": [{"name": "f", "at": "y", "cosine": 1}], "response": {"at": "y"}})json");
  REQUIRE(s.elements[0].directions.size() == 2);
  CHECK(s.elements[0].directions[0] == scene::Direction{{0, 1.0}});
  CHECK(s.elements[0].directions[1].size() == 2);
  CHECK(scene::write(scenes::parse(scene::write(s))) == scene::write(s));
}

TEST_CASE("faults of formulas have the column and what is meant") {
  CHECK(faults(own_force("k*q")) ==
        "/elements/0/force: column 1: found the unknown name \"k\", must be one of \"q\", \"v\", \"phase\", "
        "\"pi\"\n");
  CHECK(faults(own_force("stifness*q", R"({"stiffness": 1})")) ==
        "/elements/0/force: column 1: found the unknown name \"stifness\", must be one of \"q\", \"v\", "
        "\"phase\", "
        "\"stiffness\", \"pi\"; did you mean \"stiffness\"?\n");
  CHECK(faults(own_force("sinn(q)")).find("found the unknown function \"sinn\", must be one of \"sqrt\"") !=
        std::string::npos);
  CHECK(faults(own_force("q +")) ==
        "/elements/0/force: column 4: ends, must be a number, a name, a function or \"(\"\n");
  CHECK(faults(own_force("k*q", R"({"k": 1, "c": 2})")) ==
        "/elements/0/parameters/c: found a parameter that no force uses, must be in a formula\n");
  CHECK(faults(own_force("q", R"({"v": 1})")) ==
        "/elements/0/parameters/v: found the parameter \"v\", which is a name of the motion or pi, must be "
        "another "
        "name\n");
  CHECK(faults(own_force("q", R"({"a b": 1})")).find("must have letters, digits and _ alone") !=
        std::string::npos);
  CHECK(faults(own_force("k*q", R"({"k": "x"})"))
            .find("/elements/0/parameters/k: column 1: found the unknown name \"x\"") == 0);
  CHECK(faults(own_force("k*q", R"({"k": {"value": 1}})")).find("/elements/0/parameters/k") == 0);
  CHECK(
      faults(own_force("k*q", R"({"k": {"value": 1, "unit": ""}})")).find("/elements/0/parameters/k/unit") ==
      0);
  // Displacements may be angles; what is added must have one dimension all the same.
  CHECK(faults(own_force("(k + c)*q",
                         R"({"k": {"value": 1, "unit": "N/m"}, "c": {"value": 1, "unit": "N"}})")) ==
        "/elements/0/force: found \"(k + c)*q\", which adds or compares N/m and N\n");
  CHECK(faults(own_force("k*sin(q) + c", R"({"k": {"value": 1, "unit": "N"}, "c": 1})")).empty());
  CHECK(faults(R"({"name": "e", "type": "formula", "at": "x"})").find("\"force\"") != std::string::npos);
  CHECK(faults(R"({"name": "e", "type": "formula", "at": "x", "force": "q", "forces": ["q1", "q2"]})")
            .find("found \"force\" next to \"forces\"") != std::string::npos);
  CHECK(
      faults(
          R"({"name": "e", "type": "formula", "q1": {"at": "x"}, "q2": {"at": "x"}, "forces": ["q1", "q3"]})") ==
      "/elements/0/forces/1: column 1: found the unknown name \"q3\", must be one of \"q1\", \"q2\", \"v1\", "
      "\"v2\", \"phase\", \"pi\"; did you mean \"q1\"?\n");
  CHECK(
      faults(R"({"name": "e", "type": "formula", "at": "x", "forces": ["q1"]})").find("found a list of 1") !=
      std::string::npos);
}

TEST_CASE("at order 1 dampers of powers of the velocity are those of their equivalent damping") {
  // c v^3: 3/4 c (w A)^2; c v^5: 5/8 c (w A)^4
  for (const int power : {3, 5}) {
    const scene::Scene s =
        oscillator(own_force("c*v^" + std::to_string(power), R"({"c": 0.3})"), 1, 0.02, R"({"order": 1})");
    for (const double w : {0.7, 1.0, 1.6}) {
      const double A = at(s, w).amplitude;
      const double equivalent = 0.3 * (power == 3 ? 0.75 : 0.625) * std::pow(w * A, power - 1);
      CHECK(A * std::hypot(1 - w * w, w * (0.02 + equivalent)) == Approx(0.5).epsilon(1e-10));
    }
  }
}

TEST_CASE("a force without a potential is that of the linear equations") {
  const std::string text = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["q1", "q2"],
      "masses": [{"name": "m", "at": "q1", "value": 1}, {"name": "n", "at": "q2", "value": 2}],
      "springs": [{"name": "a", "at": "q1", "value": 3}, {"name": "b", "at": "q2", "value": 5}],
      "dampers": [{"name": "c", "at": "q1", "value": 0.1}, {"name": "d", "at": "q2", "value": 0.2}]},
    "elements": [{"name": "e", "type": "formula", "forces": ["p*q2", "-0.4*p*q1 + g*v1"],
                  "parameters": {"p": 1.5, "g": 0.3}}],
    "excitation": [{"name": "f", "at": "q1", "cosine": 1}], "response": {"at": "q2"}, "harmonics": {"order": 1}})";
  const scene::Scene s = scenes::parse(text);
  for (const double w : {0.8, 1.7, 2.3}) {
    using C = std::complex<double>;
    const C a(3 - w * w, 0.1 * w), b = 1.5, c(-0.6, 0.3 * w), d(5 - 2 * w * w, 0.2 * w);
    CHECK(at(s, w).amplitude == Approx(std::abs(c / (a * d - b * c))).epsilon(1e-10));
  }
}

TEST_CASE("the mode of a pendulum has the frequency of elliptic integrals") {
  const scene::Scene s = oscillator(own_force("sin(q)"), 0, 0, R"({"order": 31})");
  const auto branches = observables::nonlinear_modes(s, {.mode = 1, .from = 0.1, .to = 3});
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].status == observables::Status::complete);
  for (const auto& point : branches[0].points) {
    const double k = std::sin(0.5 * point.amplitude);
    const double exact = std::numbers::pi / (2 * std::comp_ellint_1(k));
    CAPTURE(point.amplitude);
    CHECK(point.omega == Approx(exact).epsilon(point.amplitude < 2.5 ? 1e-8 : 1e-5));
  }
}

TEST_CASE("a formula that pushes away from rest, or couples displacements, is in the modes at rest") {
  const scene::Scene s = oscillator(own_force("-a*q + q^3", R"({"a": 1.5})"), 2, 0, R"({"order": 5})");
  const auto branches = observables::nonlinear_modes(s, {.mode = 1, .from = 1e-4, .to = 1e-2});
  REQUIRE(!branches.empty());
  REQUIRE(!branches[0].points.empty());
  CHECK(branches[0].points.front().omega == Approx(std::sqrt(0.5)).epsilon(1e-6));
  const scene::Scene pair = scenes::parse(R"json({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["q1", "q2"],
      "masses": [{"name": "m", "at": "q1", "value": 1}, {"name": "n", "at": "q2", "value": 1}],
      "springs": [{"name": "a", "at": "q1", "value": 1}, {"name": "b", "at": "q2", "value": 1}]},
    "elements": [{"name": "e", "type": "formula", "forces": ["k*(q1 - q2)", "k*(q2 - q1) + q2^3"],
                  "parameters": {"k": 0.7}}],
    "excitation": [{"name": "f", "at": "q1", "cosine": 1}], "response": {"at": "q2"}})json");
  for (const int mode : {1, 2}) {
    const auto found = observables::nonlinear_modes(pair, {.mode = mode, .from = 1e-4, .to = 1e-2});
    REQUIRE(!found.empty());
    REQUIRE(!found[0].points.empty());
    CHECK(found[0].points.front().omega == Approx(mode == 1 ? 1 : std::sqrt(2.4)).epsilon(1e-6));
  }
}

TEST_CASE("at Mathieu's characteristic values a multiplier is 1 or -1") {
  // x'' + (a - 2 q cos 2t) x = 0 at q = 5; the excitation has the frequency 2, and no amplitude.
  const double q = 5;
  const struct {
    double a, multiplier;
  } all[] = {{-5.800046020851508, 1},
             {-5.790080598637771, -1},
             {1.858187541547804, -1},
             {2.099460445486665, 1},
             {7.449109739523360, 1}};
  for (const auto& each : all) {
    const scene::Scene s = oscillator(
        own_force("k*(1 - l*cos(phase))*q", R"({"k": )" + scene::file::number_text(each.a) + R"(, "l": )" +
                                                scene::file::number_text(2 * q / each.a) + "}"),
        0, 0, R"({"order": 5})", 0);
    const auto found = observables::point_responses(s, {.frequency = 2, .stability = true});
    REQUIRE(found.size() == 1);
    CAPTURE(each.a, found[0].stop.message);
    REQUIRE(found[0].point.stability);
    const auto& multipliers = found[0].point.stability->multipliers;
    REQUIRE(multipliers.size() == 2);
    // A double one: to the root of its error.
    for (const auto& multiplier : multipliers)
      CHECK(std::abs(multiplier - each.multiplier) < 1e-4 * std::abs(multipliers[0]));
    CHECK(0.5 * (multipliers[0] + multipliers[1]).real() == Approx(each.multiplier).epsilon(1e-8));
  }
}

TEST_CASE("a parametric spring has the same response in Newmark's steps, over one and two periods") {
  for (const int period : {1, 2}) {
    const scene::Scene s = oscillator(own_force("k*(1 - l*cos(2*phase + 0.3))*q + c*v + n*q^3",
                                                R"({"k": 1, "l": 0.4, "c": 0.05, "n": 0.1})"),
                                      1, 0.1, R"({"order": 11, "period": )" + std::to_string(period) + "}");
    const auto point = at(s, 0.9);
    double last = 0;
    for (const int steps : {400, 800}) {
      const auto motion = observables::motion_in_time(
          s, {.frequency = 0.9, .method = observables::TimeMethod::newmark_shooting, .steps = steps});
      CAPTURE(steps, motion.stop.message);
      REQUIRE(motion.status == observables::Status::complete);
      const double error = std::abs(motion.amplitude / point.amplitude - 1);
      if (last > 0) CHECK(error == Approx(0.25 * last).epsilon(0.2));
      last = error;
    }
    CHECK(last < 1e-4);
  }
}

TEST_CASE("a Stribeck curve with its jump is within its estimate of integration from jump to jump") {
  constexpr double n = 0.2, m = 0.6, top = 0.9, w = 0.4, c = 0.05, frequency = 0.8;
  // x'' + c x' + x + n (m + (top - m) exp(-|v|/w)) sign(v) = cos(0.8 t), in steps of the Runge-Kutta method
  // that end where v = 0. The excitation is strong enough for a motion without stops.
  using State = std::array<double, 2>;
  const auto rate = [&](double t, const State& y, double way) {
    const double friction = way * n * (m + (top - m) * std::exp(-way * y[1] / w));
    return State{y[1], std::cos(frequency * t) - c * y[1] - y[0] - friction};
  };
  const auto step = [&](double t, const State& y, double h, double way) {
    const auto moved = [&](const State& k, double by) { return State{y[0] + by * k[0], y[1] + by * k[1]}; };
    const State k1 = rate(t, y, way), k2 = rate(t + h / 2, moved(k1, h / 2), way),
                k3 = rate(t + h / 2, moved(k2, h / 2), way), k4 = rate(t + h, moved(k3, h), way);
    return State{y[0] + h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]),
                 y[1] + h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])};
  };
  const double period = 2 * std::numbers::pi / frequency, h = period / 2000;
  State y{1, 0.1};
  double t = 0, way = 1, largest = 0;
  long stops = 0;
  while (t < 300 * period) {
    const double pull = std::cos(frequency * t) - y[0];
    if (y[1] == 0 && std::abs(pull) <= n * top) {  // held, as in the transient
      ++stops;
      t += h;
      continue;
    }
    if (y[1] == 0) way = pull > 0 ? 1 : -1;
    State next = step(t, y, h, way);
    double taken = h;
    if (next[1] * way < 0) {
      double low = 0, high = h;
      for (int k = 0; k < 60; ++k) {
        taken = 0.5 * (low + high);
        next = step(t, y, taken, way);
        (next[1] * way < 0 ? high : low) = taken;
      }
      next[1] = 0;
      if (t > 295 * period) largest = std::max(largest, std::abs(next[0]));
    }
    y = next;
    t += taken;
    if (t < 100 * period) stops = 0;
  }
  REQUIRE(stops == 0);
  for (const int order : {9, 25, 61}) {
    const scene::Scene s = oscillator(
        own_force("n*(m + (s - m)*exp(-abs(v)/w))*sign(v)", R"({"n": 0.2, "m": 0.6, "s": 0.9, "w": 0.4})"), 1,
        c, R"({"order": )" + std::to_string(order) + "}", 1);
    const auto point = at(s, frequency);
    const double error = std::abs(point.amplitude - largest);
    CAPTURE(order, largest, error, point.truncation_estimate);
    CHECK(error < 2 * point.truncation_estimate);
    CHECK(error < 0.01 * largest);
  }
}

TEST_CASE("Jacobians and derivatives by parameters of formulas are those of differences") {
  for (const int period : {1, 3}) {
    const scene::Scene s =
        oscillator(own_force("a*exp(b*q)*(1 + 0.2*sin(phase)) + c*v*abs(v) + d*tanh(q*v)",
                             R"({"a": 0.3, "b": 0.7, "c": {"value": 0.2, "unit": "N s^2/m^2"}, "d": 0.4})"),
                   1, 0.1, R"({"order": 7, "period": )" + std::to_string(period) + "}");
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    std::srand(5);
    const Eigen::VectorXd u = 0.2 * Eigen::VectorXd::Random(problem.size());
    const Eigen::VectorXd p = hbm::parameters_at(problem, 1.1);
    CHECK(continuation::check_jacobian(problem, u, p).message == "");
    const auto evaluator = problem.evaluator();
    Eigen::VectorXd derivative(u.size());
    for (int k = 0; k < p.size(); ++k) {
      evaluator->move_to(u, p, continuation::Needs::jacobian);
      evaluator->parameter_derivative(k, derivative);
      const double step = 1e-6;
      evaluator->move_to(u, p + step * Eigen::VectorXd::Unit(p.size(), k), continuation::Needs::residual);
      const Eigen::VectorXd plus = evaluator->residual();
      evaluator->move_to(u, p - step * Eigen::VectorXd::Unit(p.size(), k), continuation::Needs::residual);
      CAPTURE(period, k);
      CHECK((derivative - (plus - evaluator->residual()) / (2 * step)).norm() <
            1e-7 * (1 + derivative.norm()));
    }
  }
}

TEST_CASE("by the phase no mode is followed, and no sector of a ring is read") {
  const scene::Scene s = oscillator(own_force("cos(phase)*q"), 1, 0, R"({"order": 3})");
  const auto branches = observables::nonlinear_modes(s, {.mode = 1, .from = 0.1, .to = 3});
  REQUIRE(!branches.empty());
  CHECK(branches[0].stop.message.find("the force of \"e\" depends on the phase of the excitation") !=
        std::string::npos);
  const std::string ring = R"({"format": "arcslip-scene-1", "structure": {"dofs": ["x"],
      "cyclic": {"sectors": 4, "engine_order": 1FULL},
      "masses": [{"name": "m", "at": "x", "value": 1}], "springs": [{"name": "k", "at": "x", "value": 1}]},
    "elements": [{"name": "e", "type": "formula", "at": "x", "force": "cos(phase)*q"}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "RESPONSE"}})";
  const auto with = [&](const std::string& full, const std::string& response) {
    std::string text = ring;
    text.replace(text.find("FULL"), 4, full);
    text.replace(text.find("RESPONSE"), 8, response);
    return text;
  };
  try {
    scenes::parse(with("", "x"));
    CHECK(false);
  } catch (const scene::SceneError& error) {
    CHECK(std::string(error.what()).find("depends on the phase of the excitation") != std::string::npos);
  }
  CHECK(scenes::parse(with(R"(, "full": true)", "x1")).elements.size() == 4);
}

TEST_CASE("a force that has no number ends a branch with a reason") {
  for (const std::string force : {"sqrt(q)", "(q - 1)^0.5", "acosh(q)"}) {
    const scene::Scene s = oscillator(own_force(force), 1, 0.1, R"({"order": 3})");
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(!branches.empty());
    CAPTURE(force);
    CHECK(branches[0].status == observables::Status::failed);
    CHECK(branches[0].stop.message.find("no periodic response was found") != std::string::npos);
  }
}

TEST_CASE("the JSON Schema has formulas") {
  CHECK(scene::json_schema(test_catalogue::whole()).find(R"("formula")") != std::string::npos);
}
