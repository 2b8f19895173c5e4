// Random structures with each law that is not piecewise linear: harmonic balance next to Newmark's method
// with shooting. ARCSLIP_SCENES is how many for each law; by default 10, or 100 with ARCSLIP_FULL=1.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"
#include "random.hpp"

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/time/newmark/newmark_periods.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace arcslip;
using continuation::Vector;
using test_random::Random;

namespace {

std::uint64_t scene_count() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return std::getenv("ARCSLIP_FULL") ? 100 : 10;
}

std::string number(double value) {
  return scene::file::json_text(scene::file::node(value));
}
std::string part(const std::string& name, const std::string& place, const std::string& rest) {
  return R"({"name": ")" + name + R"(", )" + place + (place.empty() ? "" : ", ") + rest + "}";
}
std::string value(double v) {
  return R"("value": )" + number(v);
}
std::string at(int mass) {
  return R"("at": "x)" + std::to_string(mass) + '"';
}
// A mass and the one before it, or the ground.
std::string link(int mass, bool to_ground) {
  if (mass == 0 || to_ground) return at(mass);
  return R"("between": ["x)" + std::to_string(mass) + R"(", "x)" + std::to_string(mass - 1) + R"("])";
}

struct Structure {
  int masses = 1;
  double frequency = 1;  // rad/s
  std::string before, after;

  scene::Scene with(const std::string& elements, int order) const {
    return scenes::parse(before + elements + after + R"(, "harmonics": {"order": )" + std::to_string(order) +
                         "}}");
  }
};

enum class Forces { first, all };

// A chain of one to four masses of about 1 kg on springs of about 1 N/m, forced in the first harmonic, of
// all forces one in two also in the second and by a constant force.
Structure structure(std::uint64_t seed, Forces kind) {
  Random random(seed);
  Structure s;
  s.masses = random.count(1, 4);
  s.frequency = random.between(0.3, 1.8);
  std::string dofs, masses, springs, dampers;
  for (int i = 0; i < s.masses; ++i) {
    const std::string comma = i > 0 ? ", " : "", n = std::to_string(i);
    dofs += comma + R"("x)" + n + '"';
    masses += comma + part("m" + n, at(i), value(random.between(0.7, 1.4)));
    springs += comma + part("k" + n, link(i, false), value(random.logarithmic(0.5, 2)));
    if (i > 0 && random.one_in(3)) springs += ", " + part("g" + n, at(i), value(random.logarithmic(0.5, 2)));
    dampers += comma + part("c" + n, at(i), value(random.logarithmic(0.03, 0.2)));
  }
  std::string forces = part("f1", at(random.count(0, s.masses - 1)), R"("cosine": 1)");
  if (kind == Forces::all && random.one_in(2)) {
    forces += ", " + part("f2", at(random.count(0, s.masses - 1)),
                          R"("harmonic": 2, "cosine": )" + number(random.between(-0.5, 0.5)) +
                              R"(, "sine": )" + number(random.between(-0.5, 0.5)));
    forces += ", " + part("f0", at(random.count(0, s.masses - 1)),
                          R"("harmonic": 0, "cosine": )" + number(random.between(-0.3, 0.3)));
  }
  s.before = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)" + dofs +
             R"(], "masses": [)" + masses + R"(], "springs": [)" + springs + R"(], "dampers": [)" + dampers +
             R"(]}, "elements": [)";
  s.after = R"(], "excitation": [)" + forces + R"(], "response": {"at": "x0"})";
  return s;
}

// About how large the motion of the element is without it: displacement and velocity.
struct Size {
  double q, v;
  int mass, masses;
};

// The keys of an element behind its name and place.
using Element = std::function<std::string(Random&, const Size&)>;

// One or two elements, each between neighbours or to the ground.
std::string random_elements(const Structure& s, const Element& element, std::uint64_t seed,
                            const time::Matrix& motions) {
  Random random(seed);
  std::string all;
  for (int k = random.count(1, 2); k > 0; --k) {
    const int mass = random.count(0, s.masses - 1);
    const bool to_ground = random.one_in(2);
    Vector q = motions.col(mass);
    if (mass > 0 && !to_ground) q -= motions.col(mass - 1);
    const double reach = std::max(q.norm(), 0.3 * motions.colwise().norm().maxCoeff());
    const std::string keys = element(random, {reach, s.frequency * reach, mass, s.masses});
    if (!all.empty()) all += ", ";
    all += part("e" + std::to_string(k),
                keys.find("potential") == std::string::npos ? link(mass, to_ground) : "", keys);
  }
  return all;
}

compared_with_exact::Pair balanced(const scene::Scene& scene, double omega) {
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  const auto first = observables::first_response(model, omega, omega);
  REQUIRE(first.u);
  const Vector p = hbm::parameters_at(*first.problem, omega);
  return {first.problem, p, *first.u, time::equation_of_motion(*model, p)};
}

compared_with_exact::Pair in_more_harmonics(const compared_with_exact::Pair& from, int order) {
  elements::Harmonics many = from.problem->harmonics();
  const elements::Harmonics few = many;
  many.order = order;
  compared_with_exact::Pair to = from;
  to.problem = std::make_shared<const hbm::HbmProblem>(*from.problem, many, from.problem->sampling());
  Vector u = Vector::Zero(to.problem->size());
  for (int i = 0; i < to.problem->blocks(); ++i)
    elements::transfer(few, from.u.segment(i * few.size(), few.size()), many,
                       u.segment(i * many.size(), many.size()));
  const auto found = hbm::response_near(*to.problem, to.p, u);
  REQUIRE(found);
  to.u = *found;
  return to;
}

// All displacements and, over the frequency, all velocities, at some instants of the period: a row for each.
constexpr int instants = 32;

time::Matrix balanced_states(const compared_with_exact::Pair& pair) {
  const auto coefficients = time::dof_coefficients(*pair.problem, pair.u, pair.p);
  const Eigen::Index dofs = coefficients.cols();
  time::Matrix all(instants, 2 * dofs);
  for (int k = 0; k < instants; ++k)
    for (Eigen::Index i = 0; i < dofs; ++i) {
      const auto at = elements::series_values(pair.problem->harmonics(), coefficients.col(i),
                                              2 * std::numbers::pi * k / instants);
      all(k, i) = at.x;
      all(k, dofs + i) = at.d1;
    }
  return all;
}

// The same by Newmark's method, from the motion of harmonic balance on.
time::Matrix stepped_states(const compared_with_exact::Pair& near, long steps) {
  time::Newmark newmark(near.equation, steps);
  time::ShootingOptions options;
  options.transients = 0;
  const auto found =
      time::shoot([&](const time::MotionState& from) { return time::newmark_map(newmark, from); },
                  time::state_of(*near.problem, near.u, near.p), near.equation.omega, options);
  CAPTURE(found.message, steps);
  REQUIRE(found.converged());
  time::Matrix all(instants, 2 * found.start.x.size());
  newmark.begin(found.start);
  bool solved = true;
  for (int k = 0; k < instants; ++k) {
    all.row(k) << newmark.state().x.transpose(), newmark.state().v.transpose() / near.equation.omega;
    for (long step = 0; step < steps / instants && solved; ++step)
      solved = newmark.step() == time::Solved::yes;
  }
  REQUIRE(solved);
  return all;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::string random_elements(const Structure& s, const Element& element, std::uint64_t seed) {
  const auto free = balanced(s.with("", 5), s.frequency);
  return random_elements(s, element, seed, time::dof_coefficients(*free.problem, free.u, free.p));
}

// Harmonic balance has an error that falls with the order, and steps in time one that falls with the square
// of their number: each comes to the motion of the other within what its last refinement changed.
void check_law(const Element& element, int order, double typical_error) {
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= scene_count(); ++seed) {
    const Structure s = structure(seed, Forces::all);
    const std::string elements = random_elements(s, element, seed + 1000);
    CAPTURE(seed, elements);
    const auto few = balanced(s.with(elements, order), s.frequency);
    const auto many = in_more_harmonics(few, 2 * order);
    const time::Matrix balanced = balanced_states(many), of_few = balanced_states(few);
    const double size = balanced.cwiseAbs().maxCoeff();
    std::array<time::Matrix, 3> stepped;
    for (int k = 0; k < 3; ++k) stepped[static_cast<std::size_t>(k)] = stepped_states(many, 1024 << k);
    const time::Matrix coarse = (4 * stepped[1] - stepped[0]) / 3, fine = (4 * stepped[2] - stepped[1]) / 3;
    const double error = (balanced - fine).cwiseAbs().maxCoeff() / size;
    const double by_steps = (fine - coarse).cwiseAbs().maxCoeff() / size,
                 by_order = (balanced - of_few).cwiseAbs().maxCoeff() / size;
    CHECK(error <= by_steps + by_order + 1e-10);
    errors.push_back(error);
  }
  CHECK(median(errors) < typical_error);
}

std::string type(const std::string& name) {
  return R"("type": ")" + name + '"';
}
std::string field(const std::string& name, double v) {
  return R"(, ")" + name + R"(": )" + number(v);
}

}  // namespace

TEST_CASE("random structures with cubic springs have the periodic motion of small steps in time") {
  check_law(
      [](Random& random, const Size& size) {
        const double k = random.one_in(4) ? -random.logarithmic(0.01, 0.1) : random.logarithmic(0.02, 1);
        return type("cubic_spring") + field("stiffness", k / (size.q * size.q));
      },
      25, 1e-10);
}

TEST_CASE("random structures with polynomial springs have the periodic motion of small steps in time") {
  check_law(
      [](Random& random, const Size& size) {
        const double q = size.q, sign = random.one_in(2) ? 1 : -1;
        std::string powers = R"("2": )" + number(sign * random.logarithmic(0.02, 0.2) / q) + R"(, "3": )" +
                             number(random.logarithmic(0.05, 0.5) / (q * q));
        if (random.one_in(2)) powers += R"(, "7": )" + number(random.logarithmic(0.01, 0.2) / std::pow(q, 6));
        return type("polynomial_spring") + R"(, "coefficients": {)" + powers + "}";
      },
      25, 1e-10);
}

TEST_CASE("random structures with polynomial couplings have the periodic motion of small steps in time") {
  check_law(
      [](Random& random, const Size& size) {
        const double q = size.q;
        const std::string own = "x" + std::to_string(size.mass),
                          other = "x" + std::to_string((size.mass + 1) % size.masses);
        const auto term = [](const std::string& powers, double v) {
          return R"({"powers": {)" + powers + R"(}, "value": )" + number(v) + "}";
        };
        std::string terms = term('"' + own + R"(": 4)", random.logarithmic(0.02, 0.3) / (q * q));
        if (size.masses > 1)
          terms += ", " + term('"' + own + R"(": 2, ")" + other + R"(": 2)",
                               random.logarithmic(0.02, 0.3) / (q * q));
        if (size.masses > 1 && random.one_in(2))
          terms += ", " + term('"' + own + R"(": 2, ")" + other + R"(": 1)", random.between(-0.05, 0.05) / q);
        return R"("type": "polynomial_coupling", "potential": [)" + terms + "]";
      },
      25, 1e-10);
}

TEST_CASE("random structures with quadratic dampers have the periodic motion of small steps in time") {
  check_law(
      [](Random& random, const Size& size) {
        return type("quadratic_damper") + field("coefficient", random.logarithmic(0.02, 2) / size.q);
      },
      41, 1e-5);
}

TEST_CASE("random structures with dampers of van der Pol have the periodic motion of small steps in time") {
  check_law(
      [](Random& random, const Size& size) {
        return type("van_der_pol") + field("coefficient", random.logarithmic(0.02, 0.5)) +
               field("amplitude", size.q * random.logarithmic(0.3, 2));
      },
      25, 1e-10);
}

TEST_CASE("random structures with regularized friction have the periodic motion of small steps in time") {
  check_law(
      [](Random& random, const Size& size) {
        return type("tanh_friction") + field("friction_coefficient", 0.5) +
               field("normal_load", random.logarithmic(0.05, 1.5)) +
               field("reference_velocity", size.v * random.logarithmic(0.1, 1));
      },
      41, 1e-5);
}

TEST_CASE(
    "random structures with hysteresis of Bouc and Wen have the periodic motion of small steps in time") {
  check_law(
      [](Random& random, const Size& size) {
        return type("bouc_wen") + field("stiffness", random.logarithmic(0.2, 3)) +
               field("elastic_share", random.one_in(3) ? 0 : random.between(0, 0.5)) +
               field("yield_displacement", size.q * random.logarithmic(0.1, 1)) +
               field("exponent", random.between(1, 4)) + field("shape", random.between(0.5, 1));
      },
      25, 1e-4);
}

TEST_CASE(
    "random structures with joints of Iwan come to their motion in time with the square of the sliders") {
  const Element joint = [](Random& random, const Size& size) {
    const double stiffness = random.logarithmic(0.2, 3);
    std::string keys = type("iwan") + field("stiffness", stiffness) +
                       field("slip_force", stiffness * size.q * random.logarithmic(0.1, 2));
    if (random.one_in(2))
      keys += R"(, "distribution": "four-parameter")" + field("exponent", random.between(-0.8, 0)) +
              field("beta", random.between(0, 2));
    return keys + R"(, "sliders": 15)";
  };
  std::vector<double> errors, ratios;
  for (std::uint64_t seed = 1; seed <= scene_count(); ++seed) {
    const Structure s = structure(seed, Forces::first);
    std::string elements = random_elements(s, joint, seed + 1000);
    CAPTURE(seed, elements);
    const auto found = observables::point_responses(s.with(elements, 41), {.frequency = s.frequency});
    REQUIRE(found.size() == 1);
    double error[2];
    for (const int k : {0, 1}) {
      const auto motion = observables::motion_in_time(s.with(elements, 41), {.frequency = s.frequency});
      REQUIRE(motion.status == observables::Status::complete);
      CHECK(motion.integrator == "event-driven");
      error[k] = std::abs(motion.amplitude / found[0].point.amplitude - 1);
      for (std::size_t at = 0; (at = elements.find("15", at)) != std::string::npos && k == 0; ++at)
        if (elements.compare(at - 11, 11, R"("sliders": )") == 0) elements.replace(at, 2, "60");
    }
    errors.push_back(error[1]);
    ratios.push_back(error[0] / error[1]);
  }
  CHECK(*std::max_element(errors.begin(), errors.end()) < 1e-3);
  CHECK(median(errors) < 1e-4);
  CHECK(median(ratios) > 12);  // 16 if all sliders had the same share of it
}

TEST_CASE("random structures with rigid friction that does not stop them come to stiff sliders in time") {
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= scene_count(); ++seed) {
    const Structure s = structure(seed, Forces::first);
    double stiffness = 0;
    const Element slider = [&](Random& random, const Size&) {
      const double load = random.logarithmic(0.005, 0.2);
      return (stiffness > 0 ? type("jenkins") + field("stiffness", stiffness) : type("coulomb")) +
             field("friction_coefficient", 1) + field("normal_load", load);
    };
    CAPTURE(seed);
    double balanced[2], marched[2];
    bool stops = false;
    for (const int k : {0, 1}) {
      stiffness = 0;
      const auto found = observables::point_responses(
          s.with(random_elements(s, slider, seed + 1000), 50 << k), {.frequency = s.frequency});
      REQUIRE(found.size() == 1);
      stops = stops || found[0].status != observables::Status::complete || found[0].point.stops != "";
      balanced[k] = found[0].point.amplitude;
      stiffness = k == 0 ? 1e6 : 4e6;
      const auto motion = observables::motion_in_time(s.with(random_elements(s, slider, seed + 1000), 5),
                                                      {.frequency = s.frequency});
      REQUIRE(motion.status == observables::Status::complete);
      marched[k] = motion.amplitude;
    }
    // Errors of the first order in 1/N, and in the root of 1/stiffness.
    const double limit = 2 * balanced[1] - balanced[0], stiff = 2 * marched[1] - marched[0];
    if (stops) continue;
    errors.push_back(std::abs(limit / stiff - 1));
    const double by_order = std::abs(balanced[1] / balanced[0] - 1),
                 by_stiffness = std::abs(marched[1] / marched[0] - 1);
    CAPTURE(by_order, by_stiffness);
    CHECK(errors.back() <= by_order + by_stiffness + 1e-10);
  }
  CHECK(2 * errors.size() > scene_count());
  CHECK(median(errors) < 1e-6);
}
