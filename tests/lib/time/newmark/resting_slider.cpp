// Contacts in a plane that stick throughout: where shooting puts their sliders.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/time/newmark/newmark_periods.hpp>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace arcslip;

namespace {

using observables::TimeMethod;

const char* const along_a_line = R"("type": "contact_2d", "tangential": {"direction": {"x": 0.6, "y": 0.8}},
  "offset": "centred")";
const char* const in_the_plane =
    R"("type": "contact_3d", "tangential_1": {"at": "x"}, "tangential_2": {"at": "y"})";

// 1 kg in each direction on 100 N/m with 2 N s/m, and a contact that no motion of the tests lets slip. The
// normal load varies by about half of its size.
scene::Scene pad(const std::string& contact, const std::string& forces) {
  return scenes::parse(R"({
    "format": "arcslip-scene-1", "frequency_unit": "rad/s",
    )" + scenes::uncoupled({{"x", 1, 100, 2}, {"y", 1, 100, 2}, {"n", 1, 100, 2}}) +
                       R"(,
    "elements": [{"name": "pad", )" +
                       contact + R"(, "normal": {"at": "n"},
      "tangential_stiffness": 80, "normal_stiffness": 60, "friction_coefficient": 0.5, "normal_load": 4}],
    "excitation": [)" + forces +
                       R"(],
    "harmonics": {"order": 5},
    "response": {"direction": {"x": 0.6, "y": 0.8}}})");
}

// The amplitudes by Newmark's method in 1000 and in 2000 steps, of a motion that sticks throughout.
std::array<double, 2> stepped(const scene::Scene& s, double w) {
  std::array<double, 2> amplitudes{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto motion = observables::motion_in_time(
        s, {.frequency = w, .method = TimeMethod::newmark_shooting, .steps = 1000 << i});
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(motion.elements[0].stick_percent == 100);
    amplitudes[i] = motion.amplitude;
  }
  return amplitudes;
}

}  // namespace

TEST_CASE("a slider that sticks along a line of the plane stands as that of the contact in one direction") {
  // The load falls and rises with the motion, so that the place between the bounds is not their mean.
  const std::string forces = R"({"name": "f", "direction": {"x": 0.6, "y": 0.8}, "cosine": 2},
    {"name": "g", "at": "n", "cosine": 1.6})";
  for (const double w : {3.0, 8.0}) {
    CAPTURE(w);
    const auto exact = observables::motion_in_time(pad(along_a_line, forces), {.frequency = w});
    REQUIRE(exact.status == observables::Status::complete);
    REQUIRE(exact.elements[0].stick_percent == 100);
    const auto [coarse, fine] = stepped(pad(in_the_plane, forces), w);
    CHECK(std::abs(coarse / exact.amplitude - 1) < 2e-5);
    CHECK(std::abs((4 * fine - coarse) / 3 / exact.amplitude - 1) < 1e-8);
  }
}

TEST_CASE("a slider that sticks in an orbit stands at the centre of the places that the contact allows") {
  // Stuck, the contact is a spring, and x oscillates as in a linear structure about the mean m, with
  // 100 m + 80 (m - w) = 0 and w = m + c. c minimizes the largest |x - c| - mu N/k_t of the oscillation.
  const std::string forces =
      R"({"name": "f", "at": "x", "cosine": 2}, {"name": "g", "at": "y", "cosine": 0.3, "sine": 1.5},
    {"name": "second", "at": "y", "cosine": 0.8, "harmonic": 2}, {"name": "lift", "at": "n", "cosine": 1.2, "sine": -0.8})";
  constexpr int instants = 4000;
  for (const double w : {3.0, 8.0}) {
    CAPTURE(w);
    const auto oscillation = [&](std::complex<double> force, double k, double frequency) {
      return force / std::complex<double>(k - frequency * frequency, 2 * frequency);
    };
    const auto X = oscillation(2, 180, w), Y = oscillation({0.3, -1.5}, 180, w),
               Y2 = oscillation(0.8, 180, 2 * w), Z = oscillation({1.2, 0.8}, 160, w);
    std::vector<std::array<double, 3>> path;  // x, y and the radius of the disc
    for (int k = 0; k < instants; ++k) {
      const auto turn = std::polar(1.0, 2 * std::numbers::pi * k / instants);
      path.push_back(
          {(X * turn).real(), (Y * turn + Y2 * turn * turn).real(), 0.5 / 80 * (4 + 60 * (Z * turn).real())});
    }
    const auto least = [](auto&& f) {  // by the golden section: where, and the value
      const double part = (std::sqrt(5.0) - 1) / 2;
      double low = -0.02, high = 0.02;
      while (high - low > 1e-9) {
        const double a = high - part * (high - low), b = low + part * (high - low);
        (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
      }
      return std::pair(0.5 * (low + high), f(0.5 * (low + high)));
    };
    const auto excess = [&](double a, double b) {
      double largest = -1;
      for (const auto& [x, y, h] : path) largest = std::max(largest, std::hypot(x - a, y - b) - h);
      return largest;
    };
    const auto over_b = [&](double a) { return least([&](double b) { return excess(a, b); }); };
    const double a = least([&](double at) { return over_b(at).second; }).first, b = over_b(a).first;
    REQUIRE(excess(a, b) < 0);
    double amplitude = 0;
    for (const auto& [x, y, h] : path)
      amplitude = std::max(amplitude, std::abs(0.6 * (x + 0.8 * a) + 0.8 * (y + 0.8 * b)));
    const auto [coarse, fine] = stepped(pad(in_the_plane, forces), w);
    CHECK(std::abs((4 * fine - coarse) / 3 / amplitude - 1) < 2e-5);
  }
}

TEST_CASE("the derivative of the place of a slider in a plane is that of differences") {
  const std::string forces = R"({"name": "f", "at": "x", "cosine": 2}, {"name": "g", "at": "y", "sine": 1.5},
    {"name": "lift", "at": "n", "cosine": 1.2, "sine": -0.8})";
  const auto model = model::build(pad(in_the_plane, forces));
  continuation::Vector p = model::defaults(model);
  p[model::frequency] = 3;
  const time::EquationOfMotion equation = time::equation_of_motion(model, p);
  time::Newmark newmark(equation, 200);
  const time::MotionState start =
      time::newmark_periods(newmark, time::at_rest(equation), 20, false, true).end;
  const time::PeriodMap map = time::newmark_map(newmark, start);
  REQUIRE(map.resting.size() == 2);
  const double step = 1e-7;  // the place has kinks, where other angles decide it
  for (Eigen::Index i = 0; i < 8; ++i) {
    const auto changed = [&](double by) {
      time::MotionState state = start;
      (i < 3 ? state.x[i] : i < 6 ? state.v[i - 3] : state.z[i - 6]) += by;
      return time::newmark_map(newmark, state);
    };
    const time::PeriodMap above = changed(step), below = changed(-step);
    for (std::size_t k = 0; k < 2; ++k) {
      CAPTURE(i, k);
      CHECK(map.resting[k].slider == static_cast<int>(k));
      CHECK(std::abs((above.resting[k].offset - below.resting[k].offset) / (2 * step) -
                     map.resting[k].derivative[i]) < 1e-6);
    }
  }
}
