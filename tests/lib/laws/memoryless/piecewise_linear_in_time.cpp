// Structures with piecewise linear springs: free oscillations in closed form, and harmonic balance next to
// the exact motion in time. ARCSLIP_SCENES is how many random structures of each spring; 100 by default.
#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/laws/memoryless/piecewise_linear_laws.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"
#include "random.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>

using namespace arcslip;
using piecewise_linear_laws::bilinear;
using piecewise_linear_laws::gap;
using piecewise_linear_laws::LawPointer;
using std::numbers::pi;
using test_random::Random;

namespace {

// x'' + f(x) = 0 from x = 0 and x' = v, over n periods T.
time::EventDrivenMotion free_motion(const LawPointer& law, std::vector<double> fields, double v, double T,
                                    int n) {
  time::EquationOfMotion equation;
  equation.omega = 2 * pi / T;
  equation.M = time::Matrix::Identity(1, 1);
  equation.C = equation.K = time::Matrix::Zero(1, 1);
  equation.response = time::Vector::Ones(1);
  equation.dof_names = {"x"};
  equation.add("spring", law, std::move(fields), time::Matrix::Identity(1, 1));
  time::MotionState start = time::at_rest(equation);
  start.v[0] = v;
  time::EventDriven march(equation);
  return march.integrate(start, 0, n * T);
}

// m = 1, c, k, one element, and forces.
scene::Scene oscillator(const std::string& element, double damping, double force, int order, double load = 0,
                        double spring = 0) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": )"
       << spring << R"(}], "dampers": [{"name": "c", "at": "x", "value": )" << damping
       << R"(}]}, "elements": [{"name": "s", "at": "x", )" << element
       << R"(}], "excitation": [{"name": "f", "at": "x", "cosine": )" << force
       << R"(}, {"name": "load", "at": "x", "harmonic": 0, "cosine": )" << load << R"(}],
    "harmonics": {"order": )"
       << order << R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 0.4, "to": 2.5}]})";
  scene::Scene s = scenes::parse(text.str());
  if (load == 0) s.excitation.pop_back();
  return s;
}

std::uint64_t count() {
  const char* text = std::getenv("ARCSLIP_SCENES");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 100;
}

// One spring in a random structure, whose corner is met where the motion without it comes to 0.9 to 3 times
// its displacement.
using AddSpring = std::function<scene::Part(Random&, double size)>;

void check_random(const AddSpring& spring) {
  double logarithms = 0, worst = 0;
  int compared = 0, met = 0;
  for (std::uint64_t seed = 0; seed < count(); ++seed) {
    auto s = random_scenes::make(
        seed, seed % 2 == 0 ? random_scenes::Excitation::first : random_scenes::Excitation::first_and_second);
    const auto& window = scenes::window(s);
    const double at = window.from + (seed % 4 < 2 ? 0.3 : 0.7) * (window.to - window.from);
    const auto free = compared_with_exact::balanced(s, at);
    const auto amplitudes = time::dof_coefficients(*free.problem, free.u, free.p);
    Random random(seed);
    const int dof = random.count(0, static_cast<int>(s.dofs.size()) - 1);
    scene::Part part = spring(random, amplitudes.col(dof).norm());
    part.name = "spring";
    part.directions = {{{dof, random.one_in(2) ? 1.0 : -1.0}}};
    s.elements.push_back(std::move(part));
    CAPTURE(seed);
    s.harmonics.order = 41;
    const auto coarse = compared_with_exact::difference(compared_with_exact::balanced(s, at), 500);
    s.harmonics.order = 81;
    const double fine =
        compared_with_exact::difference(compared_with_exact::balanced(s, at), 500).displacement;
    CHECK(std::abs(coarse.exact.period.energy.defect()) < 1e-11 * coarse.exact.period.energy.input);
    CHECK(coarse.displacement < 1e-4);
    CHECK(fine < 5e-6);
    const int last = static_cast<int>(s.elements.size()) - 1;
    for (const auto& event : coarse.exact.period.events)
      if (event.element == last) {
        ++met;
        break;
      }
    if (coarse.displacement < 1e-9) continue;
    worst = std::max(worst, fine);
    logarithms += std::log(coarse.displacement / fine);
    ++compared;
  }
  const double ratio = std::exp(logarithms / compared), third_power = std::pow(81.0 / 41, 3);
  CAPTURE(ratio, third_power, compared, met, worst);
  CHECK(static_cast<std::uint64_t>(met) > count() / 3);
  CHECK(ratio > 0.8 * third_power);
}

scene::Part part_of(const scene::PartType& type, scene::Settings options, std::vector<double> values) {
  scene::Part part;
  part.type = &type;
  part.options = std::move(options);
  part.values = std::move(values);
  return part;
}

}  // namespace

TEST_CASE("a bilinear oscillator with w1 = 1 on one side and w2 = 2 on the other swings freely at 4/3") {
  for (const double v : {1.0, 1e-6, 1e6}) {
    const auto motion = free_motion(bilinear(true), {1, 4, 0}, v, 1.5 * pi, 20);
    CAPTURE(v);
    REQUIRE(motion.reason == time::EndReason::reached);
    CHECK(std::abs(motion.end.x[0]) < 1e-12 * v);
    CHECK(std::abs(motion.end.v[0] / v - 1) < 1e-12);
    CHECK(std::abs(motion.amplitude / v - 1) < 1e-12);
    CHECK(motion.events.size() >= 39);
    CHECK(motion.events.size() <= 41);
  }
}

TEST_CASE(
    "symmetric bilinear oscillators swing freely with the period in closed form, hardening and softening") {
  const double c = 0.3, v = 0.5, w1 = 1, vc = std::sqrt(v * v - c * c), inner = std::asin(c / v) / w1;
  for (const double k2 : {4.0, 0.25, 1e6, -0.25}) {
    const double rest = c * (1 - w1 / k2), w2 = std::sqrt(std::abs(k2));
    const double outer =
        k2 > 0 ? std::atan2(vc / w2, c - rest) / w2 : std::atanh(vc / (w2 * (rest - c))) / w2;
    const double T = 4 * (inner + outer);
    CAPTURE(k2, T);
    const auto motion = free_motion(bilinear(false), {1, k2, c}, v, T, 5);
    CHECK(std::abs(motion.end.x[0]) < 1e-11);
    CHECK(std::abs(motion.end.v[0] / v - 1) < 1e-11);
    CHECK(motion.events.size() == 20);
  }
}

TEST_CASE(
    "a preload swings with the frequency of contact, and beyond it with the free one and the constant "
    "force") {
  // x'' + x + f = 0 has stiffness 1 + 3 in contact; f = -3 * 0.2 beyond.
  time::EquationOfMotion equation;
  equation.omega = 1;
  equation.M = equation.K = time::Matrix::Identity(1, 1);
  equation.C = time::Matrix::Zero(1, 1);
  equation.response = time::Vector::Ones(1);
  equation.dof_names = {"x"};
  equation.add("spring", gap(false), {3, -0.2}, time::Matrix::Identity(1, 1));
  time::EventDriven march(equation);
  time::MotionState start = time::at_rest(equation);
  start.v[0] = 0.39;  // amplitude 0.195 in contact
  const auto small = march.integrate(start, 0, pi);
  CHECK(small.events.empty());
  CHECK(std::abs(small.end.x[0]) < 1e-14);
  CHECK(std::abs(small.end.v[0] - 0.39) < 1e-14);
  start.v[0] = 1;
  // From 0 up and back in pi/2 at w = 2; down to -0.2; about 0.6 at w = 1.
  const double vc = std::sqrt(1 - 4 * 0.04), down = std::asin(0.4) / 2, free = 2 * std::atan2(vc, 0.8);
  const auto large = march.integrate(start, 0, pi / 2 + 2 * down + free);
  CHECK(std::abs(large.end.x[0]) < 1e-13);
  CHECK(std::abs(large.end.v[0] - 1) < 1e-13);
}

TEST_CASE("in harmonic balance the bilinear oscillator resonates at 4/3") {
  for (const double force : {1.0, 1e-6, 1e6}) {
    scene::Scene s = oscillator(
        R"("type": "bilinear_spring", "stiffness": 1, "stiffness_beyond": 4, "corner": 0, "one_sided": true)",
        0.02, force, 21);
    scenes::window(s) = {1.25, 1.42};
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(branches.size() == 1);
    CAPTURE(force, branches[0].stop.message);
    REQUIRE(branches[0].status == observables::Status::complete);
    REQUIRE(branches[0].events.size() == 1);
    CHECK(std::abs(branches[0].events[0].point.omega / (4.0 / 3) - 1) < 1e-4);
  }
}

TEST_CASE("a preload is what a constant force leaves: the motion about the place at rest is the same") {
  // x + 8 (x - 0.1) = 2.6 at rest: x = 0.3778, compressed by 0.2778.
  const double place = (2.6 + 0.8) / 9, compression = place - 0.1;
  for (const double force : {0.5, 3.0}) {
    const auto loaded = observables::point_responses(
        oscillator(R"("type": "gap_spring", "stiffness": 8, "gap": 0.1)", 0.3, force, 9, 2.6, 1),
        {.frequency = 2.2});
    std::ostringstream element;
    element.precision(17);
    element << R"("type": "gap_spring", "stiffness": 8, "gap": )" << -compression;
    const auto preloaded =
        observables::point_responses(oscillator(element.str(), 0.3, force, 9, 0, 1), {.frequency = 2.2});
    REQUIRE(loaded.size() == 1);
    REQUIRE(preloaded.size() == 1);
    const auto &a = loaded[0].point.coefficients, &b = preloaded[0].point.coefficients;
    REQUIRE(a.size() == b.size());
    CHECK(std::abs(a[0] - place - b[0]) < 1e-12);
    for (std::size_t i = 1; i < a.size(); ++i) CHECK(std::abs(a[i] - b[i]) < 1e-12);
  }
}

TEST_CASE("a free mass with backlash that a load presses onto one side moves as on a spring there") {
  const scene::Scene s =
      oscillator(R"("type": "gap_spring", "stiffness": 4, "gap": 0.5, "two_sided": true)", 0.2, 0.3, 7, 3);
  const auto found = observables::point_responses(s, {.frequency = 1});
  REQUIRE_FALSE(found.empty());
  REQUIRE(found[0].status == observables::Status::complete);
  const double amplitude = 0.3 / std::hypot(4 - 1, 0.2);
  CHECK(std::abs(found[0].point.coefficients[0] - (0.5 + 3.0 / 4)) < 1e-12);
  CHECK(std::abs(found[0].point.amplitude - (0.5 + 3.0 / 4) - amplitude) < 1e-12);
}

TEST_CASE("two springs without a gap are a spring, in harmonics and in time, and the branch has no corner") {
  const scene::Scene s =
      oscillator(R"("type": "gap_spring", "stiffness": 3, "gap": 0, "two_sided": true)", 0.1, 1, 5, 0, 1);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].status == observables::Status::complete);
  for (const auto& point : branches[0].points)
    CHECK(std::abs(point.amplitude * std::hypot(4 - point.omega * point.omega, 0.1 * point.omega) - 1) <
          1e-12);
  const auto motion = observables::motion_in_time(s, {.frequency = 1.7});
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(std::abs(motion.amplitude * std::hypot(4 - 1.7 * 1.7, 0.17) - 1) < 1e-9);
}

TEST_CASE("options of springs are written as they were read, and decide which harmonics a motion has") {
  struct Kind {
    const char* element;
    bool odd;
  };
  for (
      const auto& [element, odd] :
      {Kind{R"("type": "gap_spring", "stiffness": 4, "gap": 0.5, "two_sided": true)", true},
       {R"("type": "gap_spring", "stiffness": 4, "gap": -0.5)", false},
       {R"("type": "bilinear_spring", "stiffness": 4, "stiffness_beyond": -1, "corner": 0.5)", true},
       {R"("type": "bilinear_spring", "stiffness": 4, "stiffness_beyond": -1, "corner": 0.5, "one_sided": true)",
        false},
       {R"("type": "piecewise_linear_spring", "table": [[-0.3, -2], [0.1, 0.5], [1e10, 7]])", false},
       {R"("type": "piecewise_linear_spring", "table": [[-2, -3], [-1, -2], [1, 2], [2, 3]], "factor": -2)",
        true}}) {
    const scene::Scene s = oscillator(element, 0.1, 1, 5, 0, 1);
    CAPTURE(element);
    CHECK(scenes::parse(scene::write(s)) == s);
    CHECK(model::build(s).harmonics.odd == odd);
  }
  const auto plain = R"("type": "gap_spring", "stiffness": 4, "gap": 0.5)";
  CHECK(scene::write(oscillator(plain, 0.1, 1, 5, 0, 1)).find("\"two_sided\": false") != std::string::npos);
}

TEST_CASE("random structures with a preloaded spring come to the exact motion at least like N^-3") {
  check_random([](Random& random, double size) {
    return part_of(elements::gap_spring(), {},
                   {random.logarithmic(1e3, 2e4), -size / random.between(0.9, 3)});
  });
}

TEST_CASE("random structures with a two-sided gap or preload come to the exact motion at least like N^-3") {
  check_random([](Random& random, double size) {
    const double sign = random.one_in(3) ? -1 : 1;
    return part_of(elements::gap_spring(), scene::Settings::of(elements::GapSpringOptions{true}),
                   {random.logarithmic(1e3, 1e5), sign * size / random.between(0.9, 3)});
  });
}

TEST_CASE("random structures with a bilinear spring come to the exact motion at least like N^-3") {
  check_random([](Random& random, double size) {
    const double within = random.logarithmic(100, 2e4), beyond = random.logarithmic(100, 5e4);
    return part_of(elements::bilinear_spring(),
                   scene::Settings::of(elements::BilinearSpringOptions{random.one_in(2)}),
                   {within, beyond, size / random.between(0.9, 3)});
  });
}

TEST_CASE("random structures with a spring from a table come to the exact motion at least like N^-3") {
  check_random([](Random& random, double size) {
    elements::PiecewiseLinearTable table;
    double q = -size * random.between(0.5, 2), f = 0;
    const int points = random.count(3, 8);
    for (int i = 0; i < points; ++i) {
      table.points.emplace_back(q, f);
      const double step = size * random.between(0.05, 1);
      q += step;
      f += step * (random.one_in(5) ? -200 : random.logarithmic(100, 3e4));
    }
    for (auto& point : table.points) point.second -= 0.5 * f;
    table.points.back().second += 1e3 * size;
    return part_of(elements::piecewise_linear_spring(), scene::Settings::of(table), {1});
  });
}
