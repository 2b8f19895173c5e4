#include "lib/analyses/responses/extremes_check.hpp"

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>

namespace extremes {

using namespace arcslip;

void check(const Extreme& extreme) {
  CAPTURE(extreme.name);
  scene::Scene s = scenes::paper(15);
  extreme.change(s);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == extreme.reasons.size());
  const observables::ResponsePoint* highest = nullptr;
  int peaks = 0, unbounded = 0;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const auto& branch = branches[b];
    CHECK(branch.stop.reason == extreme.reasons[b]);
    const bool complete = branch.stop.reason == observables::reasons::boundary ||
                          branch.stop.reason == observables::reasons::unbounded;
    CHECK(branch.status == (complete ? observables::Status::complete : observables::Status::failed));
    CHECK(branch.points.size() > 10);
    double last = -1;
    for (const auto& point : branch.points) {
      CHECK(std::isfinite(point.amplitude));
      CHECK(std::isfinite(point.truncation_estimate));
      CHECK(point.amplitude >= 0);
      // None of these branches has a fold: a step back, but for rounding, would be a jump.
      CHECK(point.omega > last * (1 - 1e-15));
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
  CHECK(branches.back().stop.message.find(extreme.message) != std::string::npos);
  if (extreme.peaks >= 0) CHECK(peaks == extreme.peaks);
  CHECK(unbounded ==
        std::count(extreme.reasons.begin(), extreme.reasons.end(), observables::reasons::unbounded));
  if (extreme.amplitude > 0) {
    REQUIRE(highest);
    CHECK(std::abs(highest->amplitude / extreme.amplitude - 1) < extreme.tolerance);
  }
  CHECK((highest ? *highest : branches.front().points.front()).truncation_flagged == extreme.flagged);
}

}  // namespace extremes
