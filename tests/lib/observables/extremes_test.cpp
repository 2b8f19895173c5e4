#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/observables/extremes.hpp"

using namespace arcslip;

namespace {

void check(const extremes::Extreme& extreme) {
  CAPTURE(extreme.name);
  scene::Scene s = scenes::paper(15);
  extreme.change(s);
  const auto branches = observables::frequency_response(s, s.studies.front());
  REQUIRE(branches.size() == extreme.reasons.size());
  const observables::ResponsePoint* highest = nullptr;
  int peaks = 0, unbounded = 0;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const auto& branch = branches[b];
    CHECK(branch.stop.reason == extreme.reasons[b]);
    CHECK(branch.status == observables::Status::complete);
    CHECK(branch.points.size() > 10);
    double last = -1;
    for (const auto& point : branch.points) {
      CHECK(std::isfinite(point.amplitude));
      CHECK(std::isfinite(point.truncation_estimate));
      CHECK(point.amplitude >= 0);
      // None of these branches has a fold: a step back would be a jump.
      CHECK(point.omega > last);
      last = point.omega;
      // What the force puts in, friction and dampers take out.
      const double input = std::numbers::pi * point.coefficients[1] * scene::value(s, "force.cosine");
      CHECK(std::abs(point.energy_friction + point.energy_viscous - input) <=
            1e-6 * std::abs(point.energy_friction + point.energy_viscous) +
                1e-9 * point.amplitude * std::abs(scene::value(s, "force.cosine")));
    }
    for (const auto& event : branch.events) {
      CHECK(event.kind == "peak");
      if (event.point.unbounded) {
        ++unbounded;
        continue;
      }
      ++peaks;
      if (!highest || event.point.amplitude > highest->amplitude) highest = &event.point;
    }
  }
  if (extreme.peaks >= 0) CHECK(peaks == extreme.peaks);
  CHECK(unbounded == std::count(extreme.reasons.begin(), extreme.reasons.end(), "unbounded"));
  if (extreme.amplitude > 0) {
    REQUIRE(highest);
    CHECK(std::abs(highest->amplitude / extreme.amplitude - 1) < extreme.tolerance);
  }
  CHECK((highest ? *highest : branches.front().points.front()).truncation_flagged == extreme.flagged);
}

}  // namespace

TEST_CASE("every extreme of the paper's oscillator ends as it should") {
  for (const auto& extreme : extremes::all()) check(extreme);
}

TEST_CASE("f0 and Fn scaled together scale the response and nothing else") {
  const auto one = scenes::response_at(scenes::paper(15, 2), 19.6);
  for (double scale : {1e-12, 1e-6, 1e6}) {
    scene::Scene s = scenes::paper(15, 2 * scale);
    scene::set(s, "force.cosine", scale);
    const auto point = scenes::response_at(s, 19.6);
    CHECK(std::abs(point.amplitude / (scale * one.amplitude) - 1) < 1e-10);
    CHECK(std::abs(point.elements[0].stick_percent - one.elements[0].stick_percent) < 1e-7);
  }
}

TEST_CASE(
    "a bounded response beyond what doubles resolve is said to be bounded, and the branch so far is kept") {
  scene::Scene s = scenes::paper(15, 1e9);
  scene::set(s, "c.value", 0);
  const auto branches = observables::frequency_response(s, s.studies.front());
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::failed);
  CHECK_THAT(branches[0].stop.message, Catch::Contains("the response is bounded by friction"));
  CHECK(branches[0].points.size() > 50);
}

TEST_CASE("a cubic spring bounds what is undamped") {
  scene::Scene s = scene::read_file(ARCSLIP_SOURCE_DIR "/examples/duffing/scene.json");
  scene::set(s, "c.value", 0);
  s.studies.front().to = 3;
  s.harmonics.order = 1;
  const auto branches = observables::frequency_response(s, s.studies.front());
  for (const auto& event : branches.front().events) CHECK_FALSE(event.point.unbounded);
  for (const auto& point : branches.front().points) CHECK(std::isfinite(point.amplitude));
}
