// What harmonics left out do to the events of curves of peaks and folds, beside more harmonics.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/observables/curves.hpp>

#include <algorithm>
#include <cmath>
#include <string>
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
      scene::read_file(ARCSLIP_SOURCE_DIR "/examples/cantilever/beam.json", test_catalogue::whole());
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
