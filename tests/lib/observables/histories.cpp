// Motion and forces over one period.

#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/observables/histories.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace arcslip;
using observables::History;
using observables::ResponseBranch;
using observables::ResponsePoint;
using std::numbers::pi;

namespace {

ResponseBranch beginning_at(const scene::Scene& s, double frequency) {
  return observables::frequency_response(
             s, {frequency, 1.001 * frequency},
             controls::reporting([](const control::Progress& progress) { return progress.points < 1; }))
      .front();
}

// Area of the polygon through a loop, against the clock as friction goes round it.
double area(const observables::ElementHistory& loop) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < loop.force.size(); ++k)
    sum += 0.5 * (loop.force[k] + loop.force[k + 1]) * (loop.displacement[k + 1] - loop.displacement[k]);
  return sum;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

TEST_CASE("the force stays within mu Fn, reaches it where slip begins and ends, and its loop is the energy") {
  for (const auto& [s, frequency] : std::vector<std::pair<scene::Scene, double>>{
           {scenes::paper(55, 3), 20.0}, {scenes::paper(401, 0.1), 0.2}, {scenes::chain(8, true), 0.8}}) {
    const auto branch = beginning_at(s, frequency);
    const ResponsePoint& point = branch.points.front();
    const History history = observables::history(s, branch, point, observables::loop_angles(point, 20000));
    for (std::size_t e = 0; e < point.elements.size(); ++e) {
      const auto& element = point.elements[e];
      if (!element.has_stick) continue;
      CAPTURE(frequency, element.name);
      const double p = scene::value(s, element.name + ".friction_coefficient") *
                       scene::value(s, element.name + ".normal_load");
      CHECK(largest(history.elements[e].force) <= p * (1 + 1e-13));
      CHECK(std::abs(area(history.elements[e]) - element.energy) <= 1e-6 * element.energy + 1e-15);
      for (const auto* angles : {&element.slip_angles, &element.reversal_angles}) {
        const History corners = observables::history(s, branch, point, *angles);
        for (double f : corners.elements[e].force) CHECK(std::abs(std::abs(f) - p) < 1e-9 * p);
      }
    }
  }
}

TEST_CASE("the series of the force is that of the force itself") {
  for (const auto& [s, frequency] : std::vector<std::pair<scene::Scene, double>>{
           {scenes::paper(9, 3), 20.0}, {scenes::paper(3, 3), 18.5}, {scenes::chain(6, true), 0.8}}) {
    const auto branch = beginning_at(s, frequency);
    const History history =
        observables::history(s, branch, branch.points.front(), observables::even_angles(8192));
    const double M = 8192;
    for (const auto& element : history.elements)
      for (int n = 0; n <= s.harmonics.order; ++n) {
        double c = 0, sn = 0;
        for (std::size_t k = 0; k < history.angle.size(); ++k) {
          const double apart = element.force[k] - element.series[k];
          c += 2 / M * apart * std::cos(n * history.angle[k]);
          sn += 2 / M * apart * std::sin(n * history.angle[k]);
        }
        CAPTURE(frequency, element.name, n);
        CHECK(std::abs(c) + std::abs(sn) < 1e-6 * largest(element.force));
      }
  }
}

TEST_CASE("motion and series fulfil the equation of motion at every instant") {
  const scene::Scene s = scenes::paper(15, 3);
  const auto branch = beginning_at(s, 20);
  const int M = 64;
  const History history = observables::history(s, branch, branch.points.front(), observables::even_angles(M));
  // x'' by the discrete Fourier series, which has all harmonics up to 15.
  for (int k = 0; k < M; ++k) {
    double acceleration = 0;
    for (int n = 1; n <= 15; ++n)
      for (int j = 0; j < M; ++j)
        acceleration -= 2.0 / M * n * n * history.displacement[static_cast<std::size_t>(j)] *
                        std::cos(2 * pi * n * (k - j) / M);
    const auto i = static_cast<std::size_t>(k);
    const double residual = 1.24 * history.base_frequency * history.base_frequency * acceleration +
                            0.134 * history.velocity[i] + 17890 * history.displacement[i] +
                            history.elements[0].series[i] - std::cos(history.angle[i]);
    CHECK(std::abs(residual) < 1e-10);
  }
}

TEST_CASE("cosine and sine parts make the series, and the first is even in the angle") {
  const scene::Scene s = scenes::chain(6, true);
  const auto branch = beginning_at(s, 0.8);
  const History history =
      observables::history(s, branch, branch.points.front(), std::vector<double>{-1.1, 1.1});
  for (const auto& element : history.elements) {
    CHECK(std::abs(element.cosine[0] - element.cosine[1]) < 1e-14);
    CHECK(std::abs(element.sine[0] + element.sine[1]) < 1e-14);
    for (std::size_t k : {0u, 1u})
      CHECK(std::abs(element.cosine[k] + element.sine[k] - element.series[k]) < 1e-14);
  }
}

TEST_CASE("a history follows what its branch sets and is over") {
  scene::Scene s = scenes::paper(15);
  scenes::window(s) = {20, 20.01};
  for (const auto& branch : scenes::frequency_responses(s, {{"damper.normal_load", {1, 2}}})) {
    const History history =
        observables::history(s, branch, branch.points.front(), observables::even_angles(360));
    CHECK(reference::error(largest(history.elements[0].force), 0.5 * branch.set[0].second) < 1e-12);
  }
}

TEST_CASE("on a curve of peaks over the load each history has its own load") {
  const scene::Scene s = scenes::paper(15);
  const auto curve = observables::resonance_peaks(s, {"damper.normal_load", 2, 6, 18, 22}).front();
  REQUIRE(curve.events.size() == 1);
  for (const ResponsePoint* point :
       {&curve.points.front(), &curve.events.front().point, &curve.points.back()}) {
    const History history = observables::history(s, curve, *point, observables::loop_angles(*point, 5000));
    CHECK(reference::error(largest(history.elements[0].force), 0.5 * point->over) < 1e-12);
    CHECK(std::abs(largest(history.displacement) / point->amplitude - 1) < 1e-12);
    CHECK(reference::error(area(history.elements[0]), point->energy_friction) < 1e-6);
  }
}

TEST_CASE("the displacement of a history is the series of the response, masses without elements included") {
  const scene::Scene s = scenes::chain(5, true);
  const auto branch = beginning_at(s, 0.7);
  const ResponsePoint& point = branch.points.front();
  const History history = observables::history(s, branch, point, std::vector<double>{0.3, 4.0});
  for (std::size_t k : {0u, 1u}) {
    double x = 0, v = 0;
    for (std::size_t i = 0; i < branch.harmonics.size(); ++i) {
      const double n = branch.harmonics[i], a = point.coefficients[2 * i], b = point.coefficients[2 * i + 1];
      x += a * std::cos(n * history.angle[k]) + b * std::sin(n * history.angle[k]);
      v += 0.7 * n * (b * std::cos(n * history.angle[k]) - a * std::sin(n * history.angle[k]));
    }
    CHECK(std::abs(history.displacement[k] - x) < 1e-13);
    CHECK(std::abs(history.velocity[k] - v) < 1e-13);
  }
}

TEST_CASE("sampled friction: the history's force is that of the exact law, near the sampled series") {
  scene::Scene s = scenes::paper(55, 3);
  s.harmonics.friction = scene::Friction::sampled;
  s.harmonics.samples = 4096;
  const auto branch = beginning_at(s, 20);
  const History history =
      observables::history(s, branch, branch.points.front(), observables::even_angles(1000));
  CHECK(reference::error(largest(history.elements[0].force), 1.5) < 1e-12);
  CHECK(observables::force_difference(history.elements[0].series, history.elements[0].force).rms < 2e-3);
}

TEST_CASE("no history is made of an unbounded response, nor of a point of another scene") {
  const scene::Scene s = scenes::paper(5, 3);
  auto branch = beginning_at(s, 20);
  const auto angles = observables::even_angles(10);
  CHECK_THROWS_AS(observables::history(scenes::chain(8, true), branch, branch.points.front(), angles),
                  std::invalid_argument);
  branch.points.front().unbounded = true;
  CHECK_THROWS_AS(observables::history(s, branch, branch.points.front(), angles), std::invalid_argument);
}

TEST_CASE("the point nearest in frequency is chosen, and none of an empty branch") {
  const scene::Scene s = scenes::paper(3, 3);
  const auto branch = observables::frequency_response(s, scenes::window(s)).front();
  const auto* point = observables::point_at_frequency(branch, 20 * scenes::hertz);
  REQUIRE(point);
  for (const auto& other : branch.points)
    CHECK(std::abs(point->omega - 20 * scenes::hertz) <= std::abs(other.omega - 20 * scenes::hertz));
  CHECK(observables::point_at_frequency({}, 1) == nullptr);
}

TEST_CASE("forces differ by what is stated, and only forces at the same angles are compared") {
  const std::vector<double> f{3, 0, -1}, g{2, 0, -2};
  const auto difference = observables::force_difference(f, g);
  CHECK(difference.amplitude == 0.5);
  CHECK(difference.maximum == 0.5);
  CHECK(std::abs(difference.rms - 0.5) < 1e-15);
  CHECK_THROWS_AS(observables::force_difference(f, std::vector<double>{1}), std::invalid_argument);
  CHECK_THROWS_AS(observables::force_difference({}, {}), std::invalid_argument);
}

namespace {

struct AtPeak {
  ResponsePoint point;
  History history;
};

AtPeak at_peak(int order, double load) {
  const scene::Scene s = scenes::paper(order, load);
  const auto branch = observables::frequency_response(s, scenes::window(s)).front();
  if (branch.events.size() != 1) throw std::runtime_error("not one peak");
  const ResponsePoint& peak = branch.events.front().point;
  return {peak, observables::history(s, branch, peak, observables::even_angles(7200))};
}

observables::ForceDifference one_harmonic_error(double load) {
  return observables::force_difference(at_peak(1, load).history.elements[0].series,
                                       at_peak(55, load).history.elements[0].series);
}

}  // namespace

// Fig. 5 of Al Sayed et al. (2011), which does not say what its error is. Their numbers hold for the largest
// value of the force over the period, both forces as series of their harmonics, at the peak of each load.
TEST_CASE("the largest force of one harmonic is 10 % off near slip, 25 % at most, and right near stick") {
  CHECK(std::abs(one_harmonic_error(0.1).amplitude - 0.10) < 0.01);
  double greatest = 0;
  for (double load : {1.0, 1.3, 1.5, 1.6, 1.7, 2.0, 3.0})
    greatest = std::max(greatest, one_harmonic_error(load).amplitude);
  CHECK(std::abs(greatest - 0.25) < 0.01);
  CHECK(one_harmonic_error(100).amplitude < 0.01);
  CHECK(one_harmonic_error(390).amplitude < 1e-4);
  // In full slip the force is a square wave, whose 28 odd harmonics up to 55 overshoot at pi/56 (Gibbs).
  double overshoot = 0;
  for (int n = 1; n <= 55; n += 2) overshoot += 4 / pi * std::sin(n * pi / 56) / n;
  CHECK(std::abs(one_harmonic_error(1e-5).amplitude - (4 / pi / overshoot - 1)) < 1e-3);
}

TEST_CASE("next to full slip one harmonic is 4/pi of the square wave it stands for: 43.5 % off in the rms") {
  // A square wave has the fundamental 4/pi, 8/pi^2 of its mean square.
  const double rms = std::sqrt(1 - 8 / (pi * pi));
  const auto one = at_peak(1, 0.01), many = at_peak(55, 0.01);
  const auto difference =
      observables::force_difference(one.history.elements[0].series, many.history.elements[0].force);
  CHECK(std::abs(difference.amplitude - (4 / pi - 1)) < 1e-3);
  CHECK(std::abs(difference.rms - rms) < 5e-3);
  // And yet the fundamental, which alone acts at resonance, is right.
  const auto size = [](const AtPeak& at) {
    const auto& force = at.point.elements[0].fundamental;
    return std::hypot(force.in_phase, force.out_of_phase);
  };
  CHECK(reference::error(size(one), size(many)) < 1e-11);
}
