// The optimum followed over another parameter: closed forms, scaling, searches at single values, and every
// way in which the curve may change.

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "optimize/curve/optimum_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace optimum_curves {

using std::numbers::pi;

TEST_CASE("one harmonic, no damping: the best load is pi f0/(2 mu) at every level") {
  const OptimumCurve curve = optimum_curve(paper(1, 0), paper_load, {"force.cosine", 0.1, 10});
  check_complete(curve);
  CHECK(curve.points.front().along == Approx(0.1).epsilon(1e-15));
  CHECK(curve.points.back().along == Approx(10).epsilon(1e-15));
  for (const OptimumPoint& at : curve.points) {
    CHECK(reference::error(at.design[0], pi * at.along) < 1e-12);
    CHECK(reference::error(at.amplitude, pi * at.along / 3500) < 1e-12);
    CHECK(at.response.elements[0].stick_percent == Approx(50).epsilon(1e-10));
    CHECK(at.minimum);
    REQUIRE(at.peaks.size() == 1);
    CHECK(at.peaks[0].weight == 1);
    CHECK(at.at_bound == std::vector<int>{0});
  }
  CHECK(curve.events.empty());
}

TEST_CASE("without another nonlinearity the best load grows in proportion, and the stick share stays") {
  for (const int order : {1, 7})
    for (const double damping : {0.0, 0.134}) {
      CAPTURE(order, damping);
      const OptimumCurve curve = optimum_curve(paper(order, damping), paper_load, {"force.cosine", 0.1, 10});
      check_complete(curve);
      const OptimumPoint& first = curve.points.front();
      for (const OptimumPoint& at : curve.points) {
        CHECK(reference::error(at.design[0] / at.along, first.design[0] / first.along) < 1e-12);
        CHECK(reference::error(at.amplitude / at.along, first.amplitude / first.along) < 1e-12);
        CHECK(reference::error(at.response.elements[0].stick_percent,
                               first.response.elements[0].stick_percent) < 1e-9);
      }
      const Optimum found = search(paper(order, damping), paper_load, "force.cosine", curve.points.back());
      CHECK(reference::error(curve.points.back().design[0], found.design[0]) < 1e-6);
      CHECK(reference::error(curve.points.back().amplitude, found.amplitude) < 1e-11);
    }
}

TEST_CASE("next to a cubic spring the curve goes through the optima that are searched level by level") {
  const OptimumProblem problem{{{"damper.normal_load", 0.5, 60}}, 15, 60};
  for (const double level : {2.0, 4.0, 8.0}) {
    CAPTURE(level);
    const OptimumCurve curve = optimum_curve(levels(), problem, {"force.cosine", 1, level});
    check_complete(curve);
    const OptimumPoint& last = curve.points.back();
    scene::Scene s = levels();
    scene::set(s, "force.cosine", level);
    const Optimum found = optimum(s, problem, {.certificate = false});
    CHECK(reference::error(last.design[0], found.design[0]) < 1e-6);
    CHECK(reference::error(last.amplitude, found.amplitude) < 1e-11);
    CHECK(curve.work.hessians < 5 * static_cast<long>(curve.points.size()));
  }
}

TEST_CASE("two equally high peaks are followed with their weights") {
  const OptimumProblem problem{both_loads, 8, 45};
  const OptimumCurve curve = optimum_curve(two_dampers(), problem, {"force.cosine", 0.5, 2});
  check_complete(curve);
  const OptimumPoint& first = curve.points.front();
  for (const OptimumPoint& at : curve.points) {
    REQUIRE(at.peaks.size() == 2);
    CHECK(at.peaks[0].weight + at.peaks[1].weight == Approx(1).epsilon(1e-14));
    CHECK(at.peaks[0].weight == Approx(first.peaks[0].weight).epsilon(1e-8));
    CHECK(reference::error(at.peaks[1].omega, first.peaks[1].omega) < 1e-9);
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(reference::error(at.design[k] / at.along, first.design[k] / first.along) < 1e-8);
    CHECK(reference::error(at.amplitude / at.along, first.amplitude / first.along) < 1e-10);
    CHECK(at.minimum);
  }
  const Optimum found = search(two_dampers(), problem, "force.cosine", curve.points.back());
  CHECK(reference::error(curve.points.back().amplitude, found.amplitude) < 1e-9);
}

TEST_CASE("a bound is left where the optimum comes inside, and reached where it goes out") {
  const OptimumProblem bounded{{{"damper.normal_load", 5, 10}}, 15, 60};
  const OptimumProblem wide{{{"damper.normal_load", 0.5, 60}}, 15, 60};
  const OptimumCurve curve = optimum_curve(levels(), bounded, {"force.cosine", 1, 8});
  check_complete(curve);
  REQUIRE(curve.events.size() == 2);
  CHECK(curve.events[0].kind == "bound_left");
  CHECK(curve.events[1].kind == "bound_reached");
  for (const auto& [event, load] : {std::pair{curve.events[0], 5.0}, {curve.events[1], 10.0}}) {
    CHECK(event.parameter == "damper.normal_load");
    CHECK(event.point.design[0] == Approx(load).epsilon(1e-12));
    CHECK(reference::error(search(levels(), wide, "force.cosine", event.point).design[0], load) < 1e-6);
  }
  for (const OptimumPoint& at : curve.points) {
    const bool before = at.along < curve.events[0].point.along;
    const bool beyond = at.along > curve.events[1].point.along;
    if (before || beyond) CHECK(at.design[0] == (before ? 5 : 10));
    if (before || beyond) CHECK(at.at_bound[0] == (before ? -1 : 1));
    CHECK(at.minimum);
  }
  CHECK(reference::error(curve.points.back().amplitude,
                         search(levels(), bounded, "force.cosine", curve.points.back()).amplitude) < 1e-12);
}

TEST_CASE("one parameter, two peaks: one joins, holds the optimum where they cross, and the other leaves") {
  const OptimumProblem problem{{{"d2.normal_load", 0.05, 50}}, 8, 45};
  const OptimumCurve curve = optimum_curve(two_dampers(), problem, {"d1.normal_load", 0.5, 1.5});
  check_complete(curve);
  const auto joins = events(curve, "peak_joins"), leaves = events(curve, "peak_leaves");
  REQUIRE(joins.size() == 1);
  REQUIRE(leaves.size() == 1);
  CHECK(joins[0]->omega == Approx(99.93).epsilon(1e-3));
  CHECK(leaves[0]->omega == Approx(231.33).epsilon(1e-3));
  CHECK(std::abs(leaves[0]->point.peaks[0].weight) < 1e-9);
  // Where the dampers' loads are best together, the amplitude is least over d1 as well.
  const auto least = events(curve, "minimum");
  REQUIRE(least.size() == 1);
  scene::Scene s = two_dampers();
  const Optimum best = optimum(s, {both_loads, 8, 45}, {.certificate = false});
  CHECK(reference::error(least[0]->point.amplitude, best.amplitude) < 1e-7);
  CHECK(least[0]->point.peaks.size() == 2);
  for (const double s1 : {1.0, 1.5}) {
    const OptimumCurve part = optimum_curve(two_dampers(), problem, {"d1.normal_load", 0.5, s1});
    const Optimum found = search(two_dampers(), problem, "d1.normal_load", part.points.back());
    CHECK(reference::error(part.points.back().amplitude, found.amplitude) < 1e-10);
  }
}

TEST_CASE("the optimum is followed onto a corner, where a damper begins to slip, and off it again") {
  const OptimumProblem problem{{{"d2.normal_load", 0.05, 50}}, 8, 45};
  const OptimumCurve curve = optimum_curve(two_dampers(), problem, {"d1.normal_load", 1.3, 2.5});
  check_complete(curve);
  const auto changes = events(curve, "peak_changes");
  REQUIRE(changes.size() == 2);
  CHECK(changes[0]->point.peaks[0].kind == PeakKind::corner);
  CHECK(changes[1]->point.peaks[0].kind == PeakKind::resonance);
  CHECK(std::is_sorted(curve.points.begin(), curve.points.end(),
                       [](const auto& a, const auto& b) { return a.along < b.along; }));
  for (const double s1 : {2.165, 2.5}) {
    const OptimumCurve part = optimum_curve(two_dampers(), problem, {"d1.normal_load", 1.3, s1});
    REQUIRE(part.status == observables::Status::complete);
    CHECK(part.points.back().peaks[0].kind == (s1 < 2.17 ? PeakKind::corner : PeakKind::resonance));
    const Optimum found = search(two_dampers(), problem, "d1.normal_load", part.points.back());
    CHECK(reference::error(part.points.back().design[0], found.design[0]) < 1e-5);
    CHECK(reference::error(part.points.back().amplitude, found.amplitude) < 1e-10);
  }
}

TEST_CASE("where a resonance and a corner meet in a fold the curve goes on, and not back over itself") {
  // A damper begins to slip: the resonance turns round within 1e-6 of the stiffness, the corner next to it
  // goes on. Farther on another resonance comes up.
  const OptimumProblem problem{{{"d2.normal_load", 0.05, 50}}, 8, 45};
  const OptimumCurve curve = optimum_curve(two_dampers(2), problem, {"d2.stiffness", 200, 8000});
  check_complete(curve);
  std::vector<std::string> kinds;
  for (const OptimumEvent& event : curve.events) kinds.push_back(event.kind);
  CHECK(kinds == std::vector<std::string>{"peak_changes", "peak_changes", "peak_joins", "peak_leaves"});
  CHECK(std::is_sorted(curve.points.begin(), curve.points.end(),
                       [](const auto& a, const auto& b) { return a.along < b.along; }));
  int nearby[3] = {0, 0, 0};
  for (const OptimumPoint& at : curve.points) {
    CHECK(at.minimum);
    const int piece = at.along < 4346 ? 0 : at.along < 4392 ? 1 : 2;
    if (nearby[piece]++ % 10 != 5) continue;
    CAPTURE(at.along, at.design[0], at.amplitude);
    const Optimum found = search(two_dampers(2), problem, "d2.stiffness", at);
    CHECK(reference::error(at.amplitude, found.amplitude) < 1e-9);
    CHECK(reference::error(at.design[0], found.design[0]) < 1e-4);
  }
  for (const int count : nearby) CHECK(count > 5);
}

TEST_CASE("bounds and peaks: as many as there are conditions, one has to leave for another", "[numbers]") {
  const OptimumProblem problem{{{"d1.normal_load", 0.05, 4}, {"d2.normal_load", 0.05, 8}}, 8, 45};
  const OptimumCurve curve = optimum_curve(two_dampers(), problem, {"force.cosine", 2, 20});
  check_complete(curve);
  std::vector<std::string> kinds;
  for (const OptimumEvent& event : curve.events) kinds.push_back(event.kind);
  CHECK(kinds == std::vector<std::string>{"bound_reached", "peak_leaves", "bound_reached", "peak_joins"});
  for (const double level : {4.0, 6.0, 20.0}) {
    CAPTURE(level);
    const OptimumCurve part = optimum_curve(two_dampers(), problem, {"force.cosine", 2, level});
    REQUIRE(part.status == observables::Status::complete);
    const Optimum found = search(two_dampers(), problem, "force.cosine", part.points.back());
    CHECK(reference::error(part.points.back().amplitude, found.amplitude) < 1e-9);
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(reference::error(part.points.back().design[k], found.design[k]) < 1e-4);
  }
}

TEST_CASE("the curve passes turning points, and is no minimum between them") {
  const OptimumCurve curve = optimum_curve(two_dampers(), {both_loads, 8, 45}, {"m2.value", 0.1, 0.13});
  check_complete(curve);
  const auto turns = events(curve, "turning_point");
  REQUIRE(turns.size() == 2);
  CHECK(turns[1]->point.along < turns[0]->point.along);
  CHECK_FALSE(turns[0]->nonsmooth);
  CHECK(turns[1]->nonsmooth);  // where another peak joins
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const bool between = i > turns[0]->after && i <= turns[1]->after;
    if (i != turns[0]->after + 1 && i != turns[1]->after + 1)
      CHECK((curve.points[i].along < curve.points[i - 1].along) == between);
    CHECK(curve.points[i].minimum == !between);
  }
  // Over m2 the amplitude neither falls nor rises to an extreme at a turning point.
  for (const OptimumEvent* turn : turns)
    for (const OptimumEvent& event : curve.events)
      if (event.kind == "minimum" || event.kind == "maximum")
        CHECK(std::abs(event.point.along - turn->point.along) > 1e-6);
  // Between them two designs are best for their surroundings at one m2; both are found by searching.
  const double between = 0.5 * (turns[0]->point.along + turns[1]->point.along);
  int minima = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const OptimumPoint &a = curve.points[i - 1], &b = curve.points[i];
    if ((a.along - between) * (b.along - between) > 0 || !b.minimum) continue;
    const Optimum found = search(two_dampers(), {both_loads, 8, 45}, "m2.value", b);
    CHECK(reference::error(found.amplitude, b.amplitude) < 1e-9);
    CHECK(reference::error(found.design[0], b.design[0]) < 1e-3);
    ++minima;
  }
  CHECK(minima == 2);
}

TEST_CASE("an optimum at the end of the window becomes a resonance where that comes into the window") {
  // Stuck, the resonance is above 20.03 Hz for small masses: the load of least amplitude is its bound. With
  // the mass that becomes worse than letting go; between the two is a saddle, at the end of the window.
  const OptimumProblem problem{{{"damper.normal_load", 0.3, 10}}, 18, 20.03};
  const OptimumCurve curve = optimum_curve(paper(7, 0.134), problem, {"m.value", 1.2, 1.5});
  INFO(curve.stop.message);
  CHECK(curve.status == observables::Status::stopped);
  CHECK(curve.stop.reason == reasons::end_of_window);
  CHECK(curve.stop.message.find("from m.value = 1.2 to ") != std::string::npos);
  const auto turns = events(curve, "turning_point"), changes = events(curve, "peak_changes");
  REQUIRE(turns.size() == 2);
  CHECK(turns[0]->nonsmooth);
  CHECK(turns[1]->nonsmooth);
  CHECK(events(curve, "bound_left").size() == 1);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0]->point.peaks[0].kind == PeakKind::resonance);
  CHECK(changes[0]->omega / scenes::hertz == Approx(20.03).epsilon(1e-4));
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const bool between = i > turns[0]->after && i <= turns[1]->after;
    CHECK(curve.points[i].minimum == !between);
    CHECK(curve.points[i].peaks[0].kind ==
          (i <= turns[1]->after ? PeakKind::upper_end : PeakKind::resonance));
  }
  for (const OptimumPoint* at : {&curve.points.front(), &curve.points.back()})
    CHECK(reference::error(search(paper(7, 0.134), problem, "m.value", *at).amplitude, at->amplitude) <
          1e-10);
}

}  // namespace optimum_curves
