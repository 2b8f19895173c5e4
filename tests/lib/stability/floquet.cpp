// Floquet multipliers along Fourier series: closed forms, and next to the exact march in time.
// ARCSLIP_SCENES is the number of random structures of each kind; by default 8.
#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/laws/two_sliders.hpp"
#include "lib/stability/along_harmonics.hpp"
#include "lib/stability/cosine.hpp"
#include "lib/stability/multiplier_distance.hpp"
#include "lib/time/equation/systems.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"
#include "lib/time/periodic/random_contacts.hpp"

#include <arcslip/laws/memoryless/polynomial_spring.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/stability/floquet.hpp>

#include <Eigen/LU>

#include <cmath>
#include <cstdlib>
#include <numbers>

using namespace arcslip;
using multiplier_distance::distance, multiplier_distance::difference;
using namespace arcslip::time;
using random_scenes::Excitation;
using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

std::uint64_t scene_count() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return 8;
}

std::vector<Complex> exact_multipliers(const compared_with_exact::Pair& pair) {
  EventDriven integrator(pair.equation);
  const auto motion = periodic_motion(integrator, state_of(*pair.problem, pair.u, pair.p));
  REQUIRE(motion.converged());
  return motion.shooting.multipliers;
}

// The courses of an exact periodic motion: its events, and coefficients of samples of it.
std::vector<ElementCourse> exact_courses(EventDriven& integrator, const MotionState& start, int order) {
  const auto& equation = integrator.equation();
  const int count = 2 * order + 2;
  const elements::Harmonics harmonics{order};
  std::vector<ElementCourse> courses;
  for (const auto& element : equation.elements)
    courses.push_back({Matrix::Zero(harmonics.size(), element.directions.cols()), {}});
  std::vector<std::vector<ContactEvent>> events(courses.size());
  MotionState state = start;
  Vector phi(harmonics.size());
  for (int i = 0; i < count; ++i) {
    const double from = equation.period() * i / count, to = equation.period() * (i + 1) / count;
    elements::series_basis(harmonics, equation.omega * from, phi);
    phi *= 2.0 / count;
    phi[0] = 1.0 / count;
    for (std::size_t e = 0; e < courses.size(); ++e)
      courses[e].q += phi * (equation.elements[e].directions.transpose() * state.x).transpose();
    const auto motion = integrator.integrate(state, from, to);
    for (const auto& event : motion.events) events[static_cast<std::size_t>(event.element)].push_back(event);
    state = motion.end;
  }
  for (std::size_t e = 0; e < courses.size(); ++e) {
    auto& intervals = courses[e].contact;
    const auto& all = events[e];
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double end = k + 1 < all.size() ? all[k + 1].time : all.front().time + equation.period();
      intervals.push_back({all[k].to, equation.omega * all[k].time, equation.omega * end});
    }
    elements::put_in_order(intervals);
  }
  return courses;
}

std::vector<Complex> given_the_orbit(const compared_with_exact::Pair& pair, int order) {
  EventDriven integrator(pair.equation);
  const auto motion = periodic_motion(integrator, state_of(*pair.problem, pair.u, pair.p));
  REQUIRE(motion.converged());
  Floquet floquet(pair.equation);
  REQUIRE(
      floquet.compute(pair.equation.omega, {order}, exact_courses(integrator, motion.shooting.start, order)));
  CHECK(floquet.half_multipliers().empty());
  return floquet.multipliers();
}

constexpr Excitation kinds[] = {Excitation::first, Excitation::first_and_third, Excitation::first_and_second};

double middle(const scene::Scene& s) {
  const auto& window = scenes::window(s);
  return 0.5 * (window.from + window.to);
}

}  // namespace

TEST_CASE("the paper's oscillator has its multipliers, and their error falls with the harmonics") {
  const std::vector<Complex> exact{0.8476668, 0.8115364, 0};
  const struct {
    int order;
    double error;
  } cases[] = {{3, 2e-3}, {15, 1.5e-5}, {55, 2e-6}, {201, 1e-7}};
  for (const auto& [order, error] : cases) {
    CAPTURE(order);
    const auto pair = compared_with_exact::balanced(scenes::paper(order), 20);
    CHECK(pair.problem->harmonics().odd);
    const auto found = along_harmonics::multipliers(pair);
    REQUIRE(found.size() == 3);
    CHECK(difference(found, exact) < error);
    CHECK(difference(found, exact_multipliers(pair)) < error);
    CHECK(found[2] == 0.0);
  }
}

TEST_CASE("a stuck slider has no multiplier, and one that always slips has 0: closed forms") {
  const double m = 1.24, c = 0.134, hertz = 20;
  for (const auto& [load, stiffness] : {std::pair{100.0, 17890.0 + 3500}, {1e-9, 17890.0}}) {
    CAPTURE(load);
    const auto pair = compared_with_exact::balanced(scenes::paper(7, load), hertz);
    const auto found = along_harmonics::multipliers(pair);
    const double decay = std::exp(-c / (2 * m) / hertz);
    const double rate = std::sqrt(stiffness / m - std::pow(c / (2 * m), 2)) / hertz;
    REQUIRE(found.size() == (load > 1 ? 2 : 3));
    // At next to no load slip pauses for a short while.
    const double tolerance = load > 1 ? 1e-13 : 1e-7;
    for (const double sign : {1.0, -1.0})
      CHECK(distance({decay * std::polar(1.0, sign * rate)}, found) < tolerance);
  }
}

TEST_CASE("on the boundaries of Mathieu's stability the trace of the map is 2 or -2") {
  // x'' + (a - 2 q cos 2t) x = 0: along x = A cos t a cubic spring k_3 has 3 k_3 A^2 (1 + cos 2t)/2. To shift
  // the time by a quarter period exchanges the sign of q.
  const double q = 5, by_cubic = 1.5, A = std::sqrt(2 * q / by_cubic);
  const struct {
    double a, trace;
  } cases[] = {
      {-5.80004602085, 2}, {-5.79008059864, -2}, {1.85818754155, -2}, {2.09946044549, 2}, {7.44910973953, 2}};
  for (const bool odd : {false, true})
    for (const auto& [a, trace] : cases) {
      CAPTURE(a, odd);
      auto equation = systems::oscillator(1, 0, a - by_cubic * A * A);
      equation.add("cubic", elements::cubic_spring().law({}), {1.0}, Matrix::Ones(1, 1));
      const elements::Harmonics harmonics{1, odd};
      // Over pi the trace is 2 or -2, the map of half a period has a sign of its own; over 2 pi it is 2. The
      // stored digits move it by 1e-11 times its slope.
      CHECK(std::abs(cosine::trace(equation, harmonics, A) - (odd ? -trace : 2)) < (odd ? 1e-8 : 1e-7));
    }
}

TEST_CASE("the trace of Meissner's equation is the closed form") {
  // A stop without a gap along x = cos t: stiffness 1.5 where it is positive, else 0.5.
  auto equation = systems::oscillator(1, 0, 0.5);
  equation.add("stop", elements::gap_spring().law({}), {1.0, 0.0}, Matrix::Ones(1, 1));
  const double a = std::sqrt(1.5), b = std::sqrt(0.5);
  const double exact =
      2 * std::cos(pi * a) * std::cos(pi * b) - (a / b + b / a) * std::sin(pi * a) * std::sin(pi * b);
  CHECK(std::abs(exact - 2.11407486035) < 1e-11);
  for (const double amplitude : {1.0, 1e-9})
    CHECK(std::abs(cosine::trace(equation, {3}, amplitude) - exact) < 1e-13);
  // Stiff modes: long pieces in many halvings.
  equation.K(0, 0) = 0.5e4;
  equation.elements[0].fields[0] = 1e4;
  const double A = 100 * a, B = 100 * b;
  CHECK(std::abs(cosine::trace(equation, {3}, 1) - (2 * std::cos(pi * A) * std::cos(pi * B) -
                                                    (A / B + B / A) * std::sin(pi * A) * std::sin(pi * B))) <
        1e-10);
}

TEST_CASE(
    "the product of the multipliers is what damping leaves of a volume, also through the motion's velocity") {
  auto equation = systems::masses(Vector{{1.0, 0.7}});
  equation.K << 2.0, -0.6, -0.6, 1.3;
  equation.C << 0.1, -0.03, -0.03, 0.05;
  equation.omega = 0.7;
  equation.add("cubic", elements::cubic_spring().law({}), {0.8}, Matrix{{1.0}, {-1.0}});
  const elements::Harmonics harmonics{3};
  Matrix q = Matrix::Zero(harmonics.size(), 1);
  q.col(0) << 0.1, 0.9, -0.3, 0.2, 0.1, 0.4, -0.1;
  {
    Floquet floquet(equation);
    REQUIRE(floquet.compute(0.7, harmonics, {{q, {}}}));
    const double lost = (0.1 + 0.05 / 0.7) * 2 * pi / 0.7;
    CHECK(std::abs(floquet.map().determinant() * std::exp(lost) - 1) < 1e-9);
    REQUIRE(floquet.multipliers().size() == 4);
  }
  // van der Pol's force c (x^2/a^2 - 1) x' along x = A cos theta: its mean damping is c (A^2/(2 a^2) - 1).
  auto self = systems::oscillator(1, 0, 1);
  self.add("vdp", elements::van_der_pol().law({}), {0.3, 0.5}, Matrix::Ones(1, 1));
  Floquet floquet(self);
  REQUIRE(floquet.compute(1.1, {1}, cosine::along(self, {1}, 0.9)));
  const double damping = 0.3 * (0.9 * 0.9 / (2 * 0.25) - 1);
  CHECK(std::abs(floquet.map().determinant() * std::exp(damping * 2 * pi / 1.1) - 1) < 1e-9);
}

TEST_CASE("given the same orbit the multipliers are those of the exact march") {
  double worst = 0;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed)
    for (const Excitation kind : kinds) {
      auto s = random_scenes::make(seed, kind);
      s.harmonics.order = 21;
      const double at = middle(s);
      CAPTURE(seed, static_cast<int>(kind));
      for (const bool stops : {false, true}) {
        const auto pair =
            compared_with_exact::balanced(stops ? random_contacts::with_stops(s, seed, at) : s, at);
        const double error = difference(given_the_orbit(pair, 50), exact_multipliers(pair));
        CHECK(error < 1e-8);
        worst = std::max(worst, error);
      }
    }
  INFO(worst);
  CHECK(worst < 1e-8);
}

TEST_CASE("given the same orbit with contacts that open, so are they, to the error of its velocities") {
  int opens = 0;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    auto s = random_scenes::make(seed, Excitation::first);
    s.harmonics.order = 21;
    const double at = middle(s);
    CAPTURE(seed);
    const auto pair = compared_with_exact::balanced(random_contacts::with_contacts(s, seed, at), at);
    CHECK(difference(given_the_orbit(pair, 800), exact_multipliers(pair)) < 1e-6);
    EventDriven integrator(pair.equation);
    const auto motion = periodic_motion(integrator, state_of(*pair.problem, pair.u, pair.p));
    opens += std::any_of(motion.period.events.begin(), motion.period.events.end(),
                         [](const auto& event) { return event.from == "open"; });
  }
  CHECK(opens > static_cast<int>(scene_count()) / 4);
}

TEST_CASE("along harmonic balance the error of the multipliers falls at least like N^-2.5") {
  double logarithms = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed)
    for (const Excitation kind : kinds) {
      auto s = random_scenes::make(seed, kind);
      const double at = middle(s);
      CAPTURE(seed, static_cast<int>(kind));
      double errors[2];
      for (int i = 0; i < 2; ++i) {
        s.harmonics.order = i == 0 ? 21 : 61;
        const auto pair = compared_with_exact::balanced(s, at);
        errors[i] = difference(along_harmonics::multipliers(pair), exact_multipliers(pair));
      }
      CHECK(errors[1] < 1e-3);
      if (errors[0] < 1e-9) continue;
      logarithms += std::log(errors[0] / errors[1]);
      ++count;
    }
  const double power = logarithms / count / std::log(61.0 / 21);
  CAPTURE(power, count);
  CHECK(count > static_cast<int>(scene_count()));
  CHECK(power > 2.5);
}

TEST_CASE("modes found by the guards give the multipliers of those that the elements tell") {
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    auto s = random_scenes::make(seed, kinds[seed % 3]);
    s.harmonics.order = 9;
    const double at = middle(s);
    CAPTURE(seed);
    const auto pair =
        compared_with_exact::balanced(seed % 2 == 0 ? random_contacts::with_contacts(s, seed, at)
                                                    : random_contacts::with_stops(s, seed, at),
                                      at);
    Floquet floquet(pair.equation);
    const auto reported = along_harmonics::multipliers(pair, floquet);
    auto courses = along_harmonics::courses(pair);
    for (auto& course : courses) course.contact.clear();
    REQUIRE(floquet.compute(pair.equation.omega, pair.problem->harmonics(), courses));
    CHECK(difference(reported, floquet.multipliers()) < 1e-9);
  }
}

TEST_CASE("a memory of an unknown kind is named, and so is a missing mass") {
  const struct : own_laws::TwoSliders {
    std::optional<std::vector<elements::Automaton>> automata(elements::Fields) const override { return {}; }
  } secret;
  auto equation = systems::masses(Vector::Ones(1));
  equation.add("pad", secret.law({}), {1.0, 0.5, 1.0, 1.0, 0.5, 2.0}, Matrix::Identity(1, 1));
  CHECK_THROWS_WITH(Floquet(equation), "the memory of \"pad\" is of an unknown kind");
  auto massless = systems::oscillator(0, 0.1, 1);
  massless.dof_names = {"tip"};
  CHECK_THROWS_AS(Floquet(massless), SingularMass);
}

TEST_CASE("there are no multipliers along a motion that is not finite") {
  auto equation = systems::oscillator(1, 0.1, 1);
  equation.add("cubic", elements::cubic_spring().law({}), {1.0}, Matrix::Ones(1, 1));
  Floquet floquet(equation);
  for (const double amplitude : {double(NAN), 1e200, double(INFINITY)})
    CHECK_FALSE(floquet.compute(1, {1}, cosine::along(equation, {1}, amplitude)));
  CHECK(floquet.compute(1, {1}, cosine::along(equation, {1}, 0.5)));
  // Nor where the phase of the fastest motion has no digits, or takes more pieces than anyone waits for.
  CHECK(floquet.compute(1, {1}, cosine::along(equation, {1}, 1e3)));
  CHECK_FALSE(floquet.compute(1, {1}, cosine::along(equation, {1}, 1e9)));
  CHECK_FALSE(Floquet(systems::oscillator(1, 0.1, 1e30)).compute(1, {1}, {}));
}
