// Truncation estimates of points between those at which they are computed.

#include "catch.hpp"

#include "lib/analyses/branches/same_event.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/observables/truncation.hpp>

#include <cmath>
#include <functional>
#include <vector>

using namespace arcslip;
using observables::ResponsePoint;

namespace {

// Points at the arclengths 0, 1, 2, ... with the parameter 1000 and an estimate where it is due.
struct Passed {
  std::vector<ResponsePoint> points;
  std::vector<int> computed;
};
Passed along(
    int count, const std::function<double(int)>& estimate,
    const std::function<double(int)>& parameter = [](int) { return 1000.0; }) {
  observables::SpacedEstimates spaced;
  Passed all;
  for (int s = 0; s < count; ++s) {
    ResponsePoint point;
    if (spaced.is_due(s, parameter(s))) {
      point.truncation_estimate = estimate(s);
      point.truncation_change = -estimate(s);
      spaced.take(s, parameter(s), point, all.points);
      all.computed.push_back(s);
    } else {
      spaced.pass(s, point);
    }
    all.points.push_back(point);
  }
  return all;
}

// Eighteen masses in a row, each with a slider to the ground; every second one has a stiffer spring.
scene::Scene row_of_sliders() {
  constexpr int masses = 18;
  std::ostringstream dofs, mass, springs, dampers, elements;
  for (int i = 0; i < masses; ++i) {
    const char* comma = i > 0 ? ", " : "";
    dofs << comma << "\"x" << i << '"';
    mass << comma << R"({"name": "m)" << i << R"(", "at": "x)" << i << R"(", "value": 1})";
    springs << comma << R"({"name": "k)" << i << '"';
    if (i == 0) springs << R"(, "at": "x0")";
    if (i > 0) springs << R"(, "between": ["x)" << i - 1 << R"(", "x)" << i << R"("])";
    springs << R"(, "value": )" << (i % 2 == 0 ? 9000 : 12000) << "}";
    dampers << comma << R"({"name": "c)" << i << R"(", "at": "x)" << i << R"(", "value": 0.4})";
    elements << comma << R"({"name": "f)" << i << R"(", "type": "jenkins", "at": "x)" << i
             << R"(", "stiffness": 400, "friction_coefficient": 0.5, "normal_load": )" << 0.04 + 0.008 * i
             << "}";
  }
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": [)" +
                       dofs.str() + R"(], "masses": [)" + mass.str() + R"(], "springs": [)" + springs.str() +
                       R"(], "dampers": [)" + dampers.str() + R"(]},
    "elements": [)" + elements.str() +
                       R"(],
    "excitation": [{"name": "force", "at": "x17", "cosine": 1.5}], "response": {"at": "x17"},
    "harmonics": {"order": 3},
    "studies": [{"name": "frf", "kind": "frf", "from": 8, "to": 9.2}]})");
}

}  // namespace

TEST_CASE("an estimate that varies along a line is computed at 0, 1, 2, 4, 8 and every eighth point") {
  const Passed all = along(40, [](int s) { return 1 + 0.01 * s; });
  CHECK(all.computed == std::vector<int>{0, 1, 2, 4, 8, 16, 24, 32});
  for (int s = 0; s <= 32; ++s) {
    const ResponsePoint& point = all.points[static_cast<std::size_t>(s)];
    CHECK(point.truncation_estimate == Approx(1 + 0.01 * s).epsilon(1e-14));
    CHECK(point.truncation_change == Approx(-1 - 0.01 * s).epsilon(1e-14));
    CHECK(!point.truncation_flagged);
  }
  for (int s = 33; s < 40; ++s)  // not known by a later one
    CHECK(all.points[static_cast<std::size_t>(s)].truncation_estimate == Approx(1.32).epsilon(1e-14));
}

TEST_CASE("points between estimates that differ by more than half have the larger one and are flagged") {
  const Passed all = along(30, [](int s) { return s < 20 ? 1.0 : 1.6; });
  CHECK(all.computed == std::vector<int>{0, 1, 2, 4, 8, 16, 24, 25, 27});
  for (int s = 17; s < 24; ++s) {
    CHECK(all.points[static_cast<std::size_t>(s)].truncation_estimate == 1.6);
    CHECK(all.points[static_cast<std::size_t>(s)].truncation_flagged);
  }
  CHECK(!all.points[16].truncation_flagged);
  CHECK(!all.points[24].truncation_flagged);
}

TEST_CASE("flagged estimates are computed further apart") {
  const auto flagged = [](int s) { return s % 3 == 0 ? 1.0 : 100; };
  // At 2 % of the parameter, 32 points at most.
  for (const auto& [step, most] : {std::pair{2.0, 40}, {0.01, 18}}) {
    observables::SpacedEstimates spaced;
    std::vector<ResponsePoint> points;
    int computed = 0;
    for (int s = 0; s < 400; ++s) {
      const double parameter = 1000 + step * s;
      ResponsePoint point;
      if (spaced.is_due(s, parameter)) {
        point.truncation_estimate = flagged(s);
        point.truncation_flagged = true;
        spaced.take(s, parameter, point, points);
        ++computed;
      } else {
        spaced.pass(s, point);
      }
      points.push_back(point);
      CHECK(points.back().truncation_flagged);
    }
    CAPTURE(step, computed);
    CHECK(computed > 400 / 33);
    CHECK(computed <= most);
  }
}

TEST_CASE("estimates are computed at least every half percent of the parameter") {
  const Passed all = along(30, [](int) { return 1.0; }, [](int s) { return 1000 + 2.0 * s; });
  REQUIRE(all.computed.size() > 5);
  for (std::size_t k = 1; k < all.computed.size(); ++k) CHECK(all.computed[k] - all.computed[k - 1] <= 3);
}

TEST_CASE("spaced truncation estimates of a row of sliders are those of every point, or flagged") {
  scene::Scene s = row_of_sliders();
  const auto spaced = same_event::response(s);
  s.harmonics.chosen = true;  // every point
  const auto each = same_event::response(s);
  REQUIRE(spaced.points.size() == each.points.size());
  REQUIRE(spaced.events.size() == each.events.size());
  for (std::size_t k = 0; k < each.events.size(); ++k) {
    CHECK(spaced.events[k].point.truncation_estimate == each.events[k].point.truncation_estimate);
    CHECK(spaced.events[k].point.truncation_flagged == each.events[k].point.truncation_flagged);
  }
  long same = 0, apart = 0, unflagged = 0;
  for (std::size_t k = 0; k < each.points.size(); ++k) {
    const auto &point = spaced.points[k], &of_its_own = each.points[k];
    REQUIRE(point.amplitude == of_its_own.amplitude);
    if (point.truncation_estimate == of_its_own.truncation_estimate) ++same;
    if (point.truncation_flagged) continue;
    ++unflagged;
    if (point.truncation_estimate < 0.5 * of_its_own.truncation_estimate) ++apart;
  }
  CAPTURE(each.points.size(), same, unflagged, apart);
  CHECK(3 * same < static_cast<long>(each.points.size()));
  CHECK(2 * unflagged > static_cast<long>(each.points.size()));
  CHECK(100 * apart <= unflagged);
}
