#include "catch.hpp"

#include "lib/analyses/responses/extremes_check.hpp"
#include "lib/hbm/scenes.hpp"

using namespace arcslip;

TEST_CASE("every extreme of the paper's oscillator ends as it should") {
  for (const auto& extreme : extremes::all())
    if (!extreme.takes_long) check(extreme);
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

TEST_CASE("a cubic spring bounds what is undamped") {
  scene::Scene s = scenes::example("duffing");
  scene::set(s, "c.value", 0);
  scenes::window(s).to = 3;
  s.harmonics.order = 1;
  const auto branches = observables::frequency_response(s, scenes::window(s));
  for (const auto& event : branches.front().events) CHECK_FALSE(event.point.unbounded);
  for (const auto& point : branches.front().points) CHECK(std::isfinite(point.amplitude));
}
