#include "catch.hpp"

#include "lib/laws/contact/contacts.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/fourier/series_maximum.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

using namespace arcslip;

TEST_CASE("the error of harmonic balance with slip in a plane falls as the third power of the order") {
  for (const double f : {8.0, 25.0}) {
    CAPTURE(f);
    const auto fine = compared_with_exact::balanced(contacts::plane_pad(61, f, 8), 95);
    elements::LargestValue finest(fine.problem->harmonics());
    const double exact = finest.of(fine.u.head(fine.problem->harmonics().size()));
    std::array<double, 2> stepped;
    for (int i = 0; i < 2; ++i) {
      const auto motion = observables::motion_in_time(
          contacts::plane_pad(5, f, 8),
          {.frequency = 95, .method = observables::TimeMethod::newmark_shooting, .steps = 1000 << i});
      REQUIRE(motion.status == observables::Status::complete);
      stepped[static_cast<std::size_t>(i)] = motion.amplitude;
      CHECK(motion.elements[0].stick_percent > 0);
    }
    // Of second order in the steps.
    CHECK(std::abs((4 * stepped[1] - stepped[0]) / 3 / exact - 1) < 1e-5);
    for (const int order : {5, 9, 17, 31}) {
      const auto balanced = compared_with_exact::balanced(contacts::plane_pad(order, f, 8), 95);
      elements::LargestValue largest(balanced.problem->harmonics());
      CAPTURE(order);
      CHECK(std::abs(largest.of(balanced.u.head(2 * order + 1)) / exact - 1) < 0.5 * std::pow(order, -3.0));
    }
  }
}

TEST_CASE("a frequency response with slip in a plane and separation is traced to its end") {
  const scene::Scene s = contacts::plane_pad(7, 25, 8);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  CHECK(branches[0].points.back().omega == 180);
  int opened = 0, stuck = 0;
  for (const auto& point : branches[0].points) {
    opened += point.elements[0].open_percent > 0;
    stuck += point.elements[0].stick_percent > 0 && point.elements[0].stick_percent < 100;
  }
  CHECK(opened > 0);
  CHECK(stuck > 0);
}

TEST_CASE("a contact in a plane that sticks responds in proportion, also at forces far below its load") {
  const auto peak = [](double factor) {
    scene::Scene s = scenes::example("orbiting_pad");
    for (const char* force : {"unbalance_x.cosine", "unbalance_y.sine", "lift.cosine"})
      scene::set(s, force, factor * scene::value(s, force));
    const auto branches = observables::frequency_response(s, {35, 60});
    REQUIRE(branches.size() == 1);
    CHECK(branches[0].status == observables::Status::complete);
    double largest = 0;
    for (const auto& event : branches[0].events) largest = std::max(largest, event.point.amplitude);
    return largest / factor;
  };
  const double one = peak(1e-3);
  REQUIRE(one > 0);
  for (const double factor : {1e-4, 1e-5, 1e-6, 1e-8, 1e-12}) {
    CAPTURE(factor);
    CHECK(std::abs(peak(factor) / one - 1) < 1e-9);
  }
}

namespace {

// The example of an orbiting pad without lift: in full stick two oscillators, of 0.5 kg, 2 N s/m and 40 and
// 46 kN/m, under forces of 10 N in quadrature.
scene::Scene level_pad(double normal_load) {
  scene::Scene s = scenes::example("orbiting_pad");
  scene::set(s, "lift.cosine", 0);
  scene::set(s, "pad.normal_load", normal_load);
  return s;
}

// Half the long axis of the ellipse that the stuck pad describes, m. It sticks while that is below mu N/k_t.
double stuck_orbit(double omega) {
  const std::complex<double> x = 10.0 / std::complex<double>(40e3 - 0.5 * omega * omega, 2 * omega);
  const std::complex<double> y =
      std::complex<double>(0, -10) / std::complex<double>(46e3 - 0.5 * omega * omega, 2 * omega);
  return std::sqrt(0.5 * (std::norm(x) + std::norm(y) + std::abs(x * x + y * y)));
}

}  // namespace

TEST_CASE("a frequency response passes from slip in a plane to full stick where the orbit fits the disc") {
  for (const double load : {60.0, 120.0}) {
    const scene::Scene s = level_pad(load);
    const auto branches = observables::frequency_response(s, {30, 70});
    REQUIRE(branches.size() == 1);
    CHECK(branches[0].status == observables::Status::complete);
    double low = 305, high = 70 * scenes::hertz;  // beyond both resonances
    while (high - low > 1e-12 * high) {
      const double middle = 0.5 * (low + high);
      (stuck_orbit(middle) > 0.3 * load / 20e3 ? low : high) = middle;
    }
    double nearest = 1;
    for (const auto& point : branches[0].points) {
      nearest = std::min(nearest, std::abs(point.omega / low - 1));
      if (point.omega > low * (1 + 1e-9)) CHECK(point.elements[0].stick_percent == 100);
    }
    CAPTURE(load, low);
    CHECK(nearest < 1e-10);
  }
}

TEST_CASE(
    "over a load the resonance of an orbiting pad is one curve, up to full stick where its orbit fits") {
  // In full stick the peak of |x| is that of 10 N on the stuck oscillator, at any load.
  const double omega = std::sqrt(40e3 / 0.5 - 0.5 * 4 / 0.25);
  const double amplitude = 10 / std::hypot(40e3 - 0.5 * omega * omega, 2 * omega);
  const double fits = stuck_orbit(omega) * 20e3 / 0.3;
  CHECK(fits == Approx(1183.6621).epsilon(1e-7));
  for (const double upper : {45.0, 70.0}) {
    const auto curves = observables::resonance_peaks(
        level_pad(600), {"pad.normal_load", 473.465, 1420.4, upper < 70 ? 25.0 : 30.0, upper});
    CAPTURE(upper);
    REQUIRE(curves.size() == 1);
    CAPTURE(curves[0].stop.message);
    CHECK(curves[0].status == observables::Status::complete);
    CHECK(curves[0].points.front().over == Approx(473.465));
    double last = 0;
    for (const auto& point : curves[0].points) {
      const double load = point.over;
      CHECK(load > last);
      last = load;
      const bool sticks = point.elements[0].stick_percent == 100;
      // Below, the peak sits for some loads where slip begins.
      if (sticks && load < fits) CHECK(stuck_orbit(point.omega) * 20e3 / 0.3 == Approx(load).epsilon(1e-8));
      if (load < fits) continue;
      CHECK(sticks);
      CHECK(point.omega == Approx(omega).epsilon(1e-8));
      CHECK(point.amplitude == Approx(amplitude).epsilon(1e-10));
    }
  }
}

TEST_CASE("the example of an orbiting pad has the amplitude and the stick of its motion in time") {
  scene::Scene s = scenes::example("orbiting_pad");
  // The table of its README, at 34 Hz.
  const struct {
    double lift, amplitude, stick;
  } rows[] = {{0, 3.52170e-3, 12.551}, {15, 3.59921e-3, 11.006}};
  for (const auto& row : rows) {
    CAPTURE(row.lift);
    scene::set(s, "lift.cosine", row.lift);
    std::array<double, 2> stepped;
    for (int i = 0; i < 2; ++i) {
      const auto motion = observables::motion_in_time(
          s, {.frequency = 34, .method = observables::TimeMethod::newmark_shooting, .steps = 1000 << i});
      REQUIRE(motion.status == observables::Status::complete);
      stepped[static_cast<std::size_t>(i)] = motion.amplitude;
      CHECK(std::abs(motion.elements[0].stick_percent - row.stick) < 0.2);
    }
    CHECK(std::abs((4 * stepped[1] - stepped[0]) / 3 / row.amplitude - 1) < 3e-4);
  }
}
