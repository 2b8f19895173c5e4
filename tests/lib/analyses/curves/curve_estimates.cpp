// What harmonics left out do to the events of curves of peaks and folds, next to more harmonics.

#include "catch.hpp"
#include "environment.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/curves/special_curve.hpp>
#include <arcslip/analyses/curves/special_curve_results.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace arcslip;
using observables::CurveRange;
using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponsePoint;

namespace {

std::vector<ResponseEvent> events_of(const std::vector<ResponseBranch>& curves, const std::string& kind) {
  std::vector<ResponseEvent> found;
  for (const ResponseBranch& curve : curves)
    for (const ResponseEvent& event : curve.events)
      if (event.kind == kind) found.push_back(event);
  return found;
}

/// The event next to a value of the parameter.
ResponsePoint near(const std::vector<ResponseBranch>& curves, const std::string& kind, double over) {
  const auto found = events_of(curves, kind);
  REQUIRE_FALSE(found.empty());
  const auto distance = [&](const ResponseEvent& event) { return std::abs(event.point.over - over); };
  return std::min_element(found.begin(), found.end(),
                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); })
      ->point;
}

scene::Scene beam(int order) {
  scene::Scene s =
      scene::read_file(source_folder() + "/examples/cantilever/beam.json", test_catalogue::whole());
  s.harmonics.order = order;
  return s;
}

/// Each estimate is its error times 1/factor to factor.
void check_place(const ResponsePoint& few, const ResponsePoint& many, double factor,
                 double factor_of_frequency) {
  const double parameter = std::abs(few.over - many.over), frequency = std::abs(few.omega - many.omega);
  CAPTURE(few.over, parameter, few.parameter_estimate, frequency, few.location_estimate);
  CHECK(few.parameter_estimate > parameter / factor);
  CHECK(few.parameter_estimate < parameter * factor);
  CHECK(few.location_estimate > frequency / factor_of_frequency);
  CHECK(few.location_estimate < frequency * factor_of_frequency);
}

void check_amplitude(const ResponsePoint& few, const ResponsePoint& many, double factor) {
  const double amplitude = std::abs(few.amplitude - many.amplitude);
  CAPTURE(amplitude, few.truncation_estimate);
  CHECK_FALSE(few.truncation_flagged);
  CHECK(few.truncation_estimate > amplitude / factor);
  CHECK(few.truncation_estimate < amplitude * factor);
}

}  // namespace

TEST_CASE("estimates of the least peak, its load, frequency and share of stick, are their errors") {
  const auto check = [](const ResponsePoint& few, const ResponsePoint& many) {
    check_place(few, many, 1.3, 1.3);
    const double of_stick = std::abs(few.elements[0].stick_percent - many.elements[0].stick_percent);
    CAPTURE(of_stick, few.elements[0].stick_estimate);
    CHECK(few.elements[0].stick_estimate > 0.5 * of_stick);
    CHECK(few.elements[0].stick_estimate < 3 * of_stick);
  };
  const auto of_paper = [](int order) {
    const CurveRange range{"damper.normal_load", 1, 10, 18, 22};
    return near(observables::resonance_peaks(scenes::paper(order), range), "minimum", 3.09);
  };
  const ResponsePoint exact = of_paper(101);
  for (const int order : {3, 7, 15, 27}) {
    CAPTURE(order);
    check(of_paper(order), exact);
  }
  const auto of_beam = [](int order) {
    const CurveRange range{"damper.normal_load", 10, 50, 17, 21};
    return near(observables::resonance_peaks(beam(order), range), "minimum", 17.3);
  };
  const ResponsePoint many = of_beam(45);
  for (const int order : {3, 5}) {
    CAPTURE(order);
    check(of_beam(order), many);
  }
}

TEST_CASE("estimates of turns and cusps of curves of folds are their errors") {
  const auto curves = [](int order) {
    scene::Scene s = scenes::duffing_jenkins();
    s.harmonics.order = order;
    return observables::fold_curves(s, {"d.normal_load", 0.8, 3, 0.5, 4});
  };
  const auto many = curves(41);
  for (const int order : {3, 5, 7}) {
    CAPTURE(order);
    const auto few = curves(order);
    check_place(near(few, "turn", 1.19), near(many, "turn", 1.19), 1.1, 1.1);
    check_place(near(few, "cusp", 1), near(many, "cusp", 1), 1.5, 1.5);
    check_amplitude(near(few, "cusp", 1), near(many, "cusp", 1), 2.5);
  }
}

TEST_CASE("estimates of where a peak meets a minimum are its errors") {
  const auto fold = [](int order) {
    scene::Scene s = beam(order);
    const auto& window = scenes::window(s);
    return near(observables::resonance_peaks(s, {"damper.normal_load", 10, 50, 21, window.to}), "fold", 17.2);
  };
  const ResponsePoint many = fold(31);
  for (const int order : {5, 11}) {
    CAPTURE(order);
    const ResponsePoint few = fold(order);
    check_place(few, many, 1.2, 3);
    check_amplitude(few, many, 1.3);
  }
}

TEST_CASE("where a curve reaches a corner of the response, its place has no estimate") {
  scene::Scene s = scenes::duffing_jenkins();
  s.harmonics.order = 5;
  const auto corners = events_of(observables::fold_curves(s, {"d.normal_load", 0.8, 3, 0.5, 4}), "corner");
  REQUIRE_FALSE(corners.empty());
  for (const ResponseEvent& corner : corners) {
    CHECK(std::isnan(corner.point.location_estimate));
    CHECK(std::isnan(corner.point.parameter_estimate));
  }
}

namespace {

/// A point of a curve with its changes at its value of the parameter.
ResponsePoint made_up(double over, double omega, double amplitude, double d_omega = 0,
                      double d_amplitude = 0) {
  ResponsePoint point;
  point.over = over;
  point.omega = omega;
  point.amplitude = amplitude;
  point.location_change = d_omega;
  point.location_estimate = std::abs(d_omega);
  point.truncation_change = d_amplitude;
  point.truncation_estimate = std::abs(d_amplitude);
  return point;
}

/// estimate_change() of an event between these points of a curve, which have their arclengths.
ResponsePoint estimated(const std::string& kind, const ResponsePoint& at,
                        const std::vector<std::pair<double, ResponsePoint>>& points, bool located = true) {
  observables::SpecialCurve curve;
  for (const auto& [arclength, point] : points) curve.points.push_back({arclength, 0, point});
  ResponseEvent event{kind, false, located, at};
  event.point.truncation_estimate = 0;
  observables::estimate_change(curve, 0, event);
  return event.point;
}

bool is_next_to(double value, double exact) {
  return std::abs(value - exact) < 0.01 * exact;
}

}  // namespace

TEST_CASE("the estimates of a cusp are those of its normal form with terms of higher order") {
  // On the branch omega = f p + mu p s + k s^3 + beta p s^2 + q s^4, and A = alpha s + B s^2 + gamma p. More
  // harmonics add e (d0 + d1 s + d2 s^2) and e (a0 + a1 s).
  const double f = 0.4, mu = 1.3, k = 0.7, beta = 0.9, q = -0.5, alpha = 2, B = 0.6, gamma = -0.8, e = 1e-8,
               d0 = 0.2, d1 = 1.2, d2 = -0.7, a0 = 0.3, a1 = 0.4;
  // bend: of the arclength of the curve, s = sigma + bend sigma^2; unit: of p.
  const double small = std::ldexp(1, -90), large = std::ldexp(1, 90);
  for (const auto& [bend, unit] :
       {std::pair(0.0, 1.0), std::pair(3.0, 1.0), std::pair(3.0, small), std::pair(3.0, large)}) {
    CAPTURE(bend, unit);
    std::vector<std::pair<double, ResponsePoint>> points;
    for (const double sigma : {-4e-3, -2e-3, 1e-3, 3e-3}) {
      const double s = sigma + bend * sigma * sigma;
      const double p = -(3 * k * s * s + 4 * q * s * s * s) / (mu + 2 * beta * s);
      const double omega = f * p + mu * p * s + k * s * s * s + beta * p * s * s + q * s * s * s * s;
      const double moved = -e * (d1 + 2 * d2 * s) / (6 * k * s + 2 * beta * p + 12 * q * s * s);
      points.emplace_back(
          sigma, made_up(unit * p, omega, alpha * s + B * s * s + gamma * p, e * (d0 + d1 * s + d2 * s * s),
                         e * (a0 + a1 * s) + (alpha + 2 * B * s) * moved));
    }
    const ResponsePoint cusp = estimated("cusp", made_up(0, 0, 0), points);
    const double p = -e * d1 / mu, s = -(beta * p + e * d2) / (3 * k);
    CHECK(is_next_to(cusp.parameter_estimate, unit * std::abs(p)));
    CHECK(is_next_to(cusp.location_estimate, std::abs(e * d0 + f * p)));
    CHECK(is_next_to(cusp.truncation_estimate, std::abs(e * a0 + alpha * s + gamma * p)));
    CHECK_FALSE(cusp.truncation_flagged);
  }
}

TEST_CASE("the estimates of a turn are those of a curve that is moved at each frequency") {
  // p = a w^2 + b w^3 and A = c w^2 over w = omega - 1; more harmonics add e (g0 + g1 w) and e (h0 + h1 w).
  const double a = 0.8, b = -1.5, c = 0.9, e = 1e-8, g0 = 0.7, g1 = 1.9, h0 = -0.6, h1 = 0.3;
  std::vector<std::pair<double, ResponsePoint>> points;
  for (const double w : {-4e-3, -2e-3, 1e-3, 3e-3}) {
    const double moved = -e * (g0 + g1 * w) / (2 * a * w + 3 * b * w * w);
    points.emplace_back(w, made_up(a * w * w + b * w * w * w, 1 + w, c * w * w, moved,
                                   e * (h0 + h1 * w) + 2 * c * w * moved));
  }
  const ResponsePoint turn = estimated("fold", made_up(0, 1, 0), points);
  CHECK(is_next_to(turn.parameter_estimate, e * g0));
  CHECK(is_next_to(turn.location_estimate, e * g1 / (2 * a)));
  CHECK(is_next_to(turn.truncation_estimate, std::abs(e * h0)));
  const auto not_located = estimated("fold", made_up(0, 1, 0), points, false);
  CHECK(std::isnan(not_located.parameter_estimate));
  CHECK(std::isnan(not_located.location_estimate));
  points.erase(points.begin() + 2, points.end());  // at an end of a curve
  CHECK(std::isnan(estimated("fold", made_up(0, 1, 0), points).parameter_estimate));
}

TEST_CASE("the estimates of an extremum are those of a curve that is moved at each parameter") {
  // y = a p^2 + b p^3 and z = 1 + c p, amplitude and frequency or the other way round; more harmonics add
  // e (g0 + g1 p) and e h0.
  const double a = 0.8, b = -1.5, c = 0.9, e = 1e-8, g0 = 0.7, g1 = 1.9, h0 = 3;
  for (const bool is_turn : {false, true}) {
    CAPTURE(is_turn);
    const auto point = [&](double p) {
      const double y = a * p * p + b * p * p * p, z = 1 + c * p, dy = e * (g0 + g1 * p), dz = e * h0;
      return is_turn ? made_up(p, y, z, dy, dz) : made_up(p, z, y, dz, dy);
    };
    std::vector<std::pair<double, ResponsePoint>> points;
    for (const double p : {-4e-3, -2e-3, 1e-3, 3e-3}) points.emplace_back(p, point(p));
    const ResponsePoint at = estimated(is_turn ? "turn" : "minimum", point(0), points);
    CHECK(is_next_to(at.parameter_estimate, e * g1 / (2 * a)));
    CHECK(is_next_to(is_turn ? at.location_estimate : at.truncation_estimate, e * g0));
    CHECK(is_next_to(is_turn ? at.truncation_estimate : at.location_estimate, e * (h0 - c * g1 / (2 * a))));
  }
}
