// The truncation estimate of structures with the law of Bouc and Wen, whose internal variable has an equation
// of its own, against the error that a much higher order tells.

#include "catch.hpp"
#include "random.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/observables/in_more_harmonics.hpp"
#include "lib/observables/same_event.hpp"
#include "lib/observables/truncation.hpp"

#include <string>

using namespace arcslip;

namespace {

constexpr double least_error = 1e-7;  // of amplitudes: errors below are not looked at

/// An oscillator, or two, one of which is on a Bouc-Wen element.
scene::Scene of_bouc_wen(std::uint64_t seed) {
  test_random::Random random(seed);
  const auto number = [](double value) { return std::to_string(value); };
  const bool two = random.one_in(2);
  scene::Scene s = scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["x")" +
      std::string(two ? R"(, "y")" : "") + R"(], "masses": [{"name": "m", "at": "x", "value": 1})" +
      (two ? R"(, {"name": "m2", "at": "y", "value": )" + number(random.logarithmic(0.2, 5)) + "}" : "") +
      R"(], "springs": [{"name": "k", "at": "x", "value": )" + number(random.logarithmic(0.1, 2)) + "}" +
      (two ? R"(, {"name": "k2", "between": ["x", "y"], "value": )" + number(random.logarithmic(0.1, 2)) + "}"
           : "") +
      R"(], "dampers": [{"name": "c", "at": "x", "value": )" + number(random.logarithmic(0.005, 0.05)) + "}" +
      (two ? R"(, {"name": "c2", "at": "y", "value": )" + number(random.logarithmic(0.005, 0.05)) + "}"
           : "") +
      R"(]}, "elements": [{"name": "b", "type": "bouc_wen", "at": "x", "stiffness": )" +
      number(random.logarithmic(0.1, 2)) + R"(, "elastic_share": )" + number(random.between(0, 0.5)) +
      R"(, "yield_displacement": )" + number(random.logarithmic(0.2, 2)) + R"(, "exponent": )" +
      number(random.between(1, 4)) + R"(, "shape": )" + number(random.between(0.5, 1)) +
      R"(}], "excitation": [{"name": "f", "at": "x", "cosine": )" + number(random.logarithmic(0.1, 1)) +
      R"(}], "response": {"at": "x"}, "studies": [{"kind": "frf", "from": 0.4, "to": 1.8}]})");
  s.harmonics.order = 3 + 2 * random.count(0, 4);
  return s;
}

}  // namespace

TEST_CASE("truncation estimates of Bouc-Wen elements are above half of the error, at points and at peaks") {
  const std::uint64_t count = truncation::bouc_wen.count();
  in_more_harmonics::Compared between;
  int peaks = 0, low = 0, far_too_low = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    scene::Scene s = of_bouc_wen(seed);
    const auto branch = same_event::response(s);
    if (branch.status == observables::Status::failed) continue;
    const elements::Harmonics kept = model::build(s).harmonics;
    s.harmonics.order = 4 * s.harmonics.order + 19;
    in_more_harmonics::compare(std::make_shared<const model::Model>(model::build(s)), kept, branch, 20,
                               least_error, between);
    const auto higher = same_event::response(s);
    for (const auto& event : branch.events) {
      if (event.kind != "peak" || event.point.truncation_flagged) continue;
      const auto* exact = same_event::find(event, higher);
      if (!exact) continue;
      const double error = std::abs(event.point.amplitude - exact->amplitude);
      ++peaks;
      if (!(error > least_error * exact->amplitude)) continue;
      if (error > 2 * event.point.truncation_estimate) ++low;
      if (error > 10 * event.point.truncation_estimate) ++far_too_low;
    }
  }
  CAPTURE(between.points, between.flagged, between.above_twice, peaks, low);
  CHECK(1000 * (between.above_twice + low) <= between.points + peaks);
  CHECK(between.above_ten_times + far_too_low == 0);
}
