// The optimum followed over another parameter: closed forms, scaling, searches at single values, and every
// way in which the curve may change or end.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/observables/reference.hpp"

#include <arcslip/optimize/optimum_figures.hpp>
#include <arcslip/optimize/optimum_results.hpp>
#include <arcslip/optimize/reasons.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace arcslip;
using namespace arcslip::optimize;
using Variables = std::vector<DesignVariable>;
constexpr double pi = std::numbers::pi;

namespace {

const OptimumProblem paper_load{{{"damper.normal_load", 0.01, 1000}}, 18, 22};
const Variables both_loads = {{"d1.normal_load", 0.05, 50}, {"d2.normal_load", 0.05, 50}};

scene::Scene paper(int order, double damping) {
  scene::Scene s = scenes::paper(order, 3);
  scene::set(s, "c.value", damping);
  return s;
}

scene::Scene levels() {
  return scenes::example("levels");
}

scene::Scene two_dampers(double start = 0.6) {
  scene::Scene s = scenes::example("two_dampers");
  scene::set(s, "d1.normal_load", start);
  scene::set(s, "d2.normal_load", start);
  return s;
}

std::vector<const OptimumEvent*> events(const OptimumCurve& curve, const std::string& kind) {
  std::vector<const OptimumEvent*> all;
  for (const OptimumEvent& event : curve.events)
    if (event.kind == kind) all.push_back(&event);
  return all;
}

// A search at one value, from the design that was followed there.
Optimum search(scene::Scene s, const OptimumProblem& problem, const std::string& along,
               const OptimumPoint& at) {
  scene::set(s, along, at.along);
  for (std::size_t k = 0; k < problem.over.size(); ++k) scene::set(s, problem.over[k].name, at.design[k]);
  return optimum(s, problem, {.certificate = false});
}

void check_complete(const OptimumCurve& curve) {
  INFO(curve.stop.message);
  CHECK(curve.status == observables::Status::complete);
  CHECK(curve.stop.reason == reasons::boundary);
  REQUIRE(curve.points.size() >= 2);
}

std::string error_of(const scene::Scene& s, const OptimumProblem& problem, const DesignVariable& along) {
  try {
    optimum_curve(s, problem, along);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

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

TEST_CASE("beside a cubic spring the curve goes through the optima that are searched level by level") {
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
  // A damper begins to slip: the resonance turns round within 1e-6 of the stiffness, the corner beside it
  // goes on. Farther on another resonance comes up.
  const OptimumProblem problem{{{"d2.normal_load", 0.05, 50}}, 8, 45};
  const OptimumCurve curve = optimum_curve(two_dampers(2), problem, {"d2.stiffness", 200, 8000});
  check_complete(curve);
  std::vector<std::string> kinds;
  for (const OptimumEvent& event : curve.events) kinds.push_back(event.kind);
  CHECK(kinds == std::vector<std::string>{"peak_changes", "peak_changes", "peak_joins", "peak_leaves"});
  CHECK(std::is_sorted(curve.points.begin(), curve.points.end(),
                       [](const auto& a, const auto& b) { return a.along < b.along; }));
  int beside[3] = {0, 0, 0};
  for (const OptimumPoint& at : curve.points) {
    CHECK(at.minimum);
    const int piece = at.along < 4346 ? 0 : at.along < 4392 ? 1 : 2;
    if (beside[piece]++ % 10 != 5) continue;
    CAPTURE(at.along, at.design[0], at.amplitude);
    const Optimum found = search(two_dampers(2), problem, "d2.stiffness", at);
    CHECK(reference::error(at.amplitude, found.amplitude) < 1e-9);
    CHECK(reference::error(at.design[0], found.design[0]) < 1e-4);
  }
  for (const int count : beside) CHECK(count > 5);
}

TEST_CASE("bounds and peaks: as many as there are conditions, one has to leave for another") {
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
  check_complete(curve);
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

TEST_CASE("a start that is flat, unbounded or without response says so") {
  const OptimumCurve flat =
      optimum_curve(paper(7, 0.134), {{{"damper.normal_load", 200, 300}}, 18, 22}, {"force.cosine", 0.1, 1});
  CHECK(flat.status == observables::Status::failed);
  CHECK(flat.stop.reason == reasons::flat);
  CHECK(flat.points.empty());
  CHECK(contains(flat.stop.message, "at force.cosine = 0.1"));
  const OptimumCurve infinite =
      optimum_curve(paper(1, 0), {{{"damper.normal_load", 0.1, 1}}, 18, 22}, {"force.cosine", 1, 10});
  CHECK(infinite.status == observables::Status::failed);
  CHECK(infinite.stop.reason == reasons::unbounded);
}

TEST_CASE("the curve ends where the response becomes unbounded, and says where") {
  const OptimumCurve curve =
      optimum_curve(paper(1, 0), {{{"damper.normal_load", 0.1, 5}}, 18, 22}, {"force.cosine", 1, 10});
  CHECK(curve.status == observables::Status::stopped);
  CAPTURE(curve.stop.reason, curve.stop.message);
  REQUIRE_FALSE(curve.points.empty());
  CHECK(events(curve, "bound_reached").size() == 1);
  CHECK(events(curve, "bound_reached")[0]->point.along == Approx(5 / pi).epsilon(1e-9));
  const double limit = 4 * 0.5 * 5 / pi;  // Fn = pi f0/(4 mu)
  CHECK(curve.points.back().along < limit);
  CHECK(curve.points.back().along > 0.9 * limit);
}

TEST_CASE("a bound that is left where everything comes to stick is no end without a reason") {
  const OptimumProblem wide{{{"damper.normal_load", 0.5, 60}}, 15, 60};
  const OptimumCurve curve = optimum_curve(levels(), wide, {"damper.friction_coefficient", 0.01, 50});
  INFO(curve.stop.message);
  CHECK(curve.stop.reason != reasons::objective_failed);
  // Only mu Fn counts: its optimum within the bounds, and what is nearest to it elsewhere.
  const Optimum best = optimum(levels(), wide, {.certificate = false});
  const double slip = 0.5 * best.design[0];
  for (const OptimumPoint& at : curve.points)
    if (at.along > slip / 60 && at.along < slip / 0.5)
      CHECK(at.along * at.design[0] == Approx(slip).epsilon(1e-5));
  REQUIRE_FALSE(events(curve, "bound_reached").empty());
  CHECK(events(curve, "bound_reached")[0]->point.along == Approx(slip / 0.5).epsilon(1e-5));
}

TEST_CASE("a progress callback, a number of points and a time limit stop the curve") {
  int told = 0;
  OptimumCurveOptions options;
  options.progress = [&](const OptimumPoint&) { return ++told < 5; };
  const OptimumCurve by_user = optimum_curve(paper(1, 0), paper_load, {"force.cosine", 0.1, 10}, options);
  CHECK(by_user.status == observables::Status::stopped);
  CHECK(by_user.stop.reason == reasons::user);
  CHECK(told == 5);
  OptimumCurveOptions few;
  few.points = 7;
  const OptimumCurve by_points = optimum_curve(paper(1, 0), paper_load, {"force.cosine", 0.1, 10}, few);
  CHECK(by_points.stop.reason == reasons::point_limit);
  CHECK(by_points.points.size() == 7);
  OptimumCurveOptions brief;
  brief.seconds = 1e-3;
  const OptimumCurve by_time = optimum_curve(paper(55, 0.134), paper_load, {"force.cosine", 0.1, 10}, brief);
  CHECK(by_time.stop.reason == reasons::time_limit);
  CHECK(by_time.status == observables::Status::stopped);
}

TEST_CASE("what the progress callback throws ends the curve with what there is") {
  OptimumCurveOptions options;
  int told = 0;
  options.progress = [&](const OptimumPoint&) {
    if (++told == 4) throw std::runtime_error("enough");
    return true;
  };
  const OptimumCurve curve = optimum_curve(paper(1, 0), paper_load, {"force.cosine", 0.1, 10}, options);
  CHECK(curve.status == observables::Status::failed);
  CHECK(curve.stop.reason == reasons::objective_failed);
  CHECK(contains(curve.stop.message, "it threw \"enough\""));
  CHECK(curve.points.size() == 4);
}

TEST_CASE("what cannot be followed is refused before anything is computed") {
  const DesignVariable force{"force.cosine", 1, 2};
  CHECK(contains(error_of(paper(1, 0), paper_load, {"force.cosin", 1, 2}), "force.cosine"));
  CHECK(contains(error_of(paper(1, 0), paper_load, {"damper.normal_load", 1, 2}), "named twice"));
  CHECK(contains(error_of(paper(1, 0), paper_load, {"force.cosine", 2, 1}), "must be below"));
  OptimumProblem limited = paper_load;
  limited.limits.push_back({"energy_friction", -HUGE_VAL, 1e-3});
  CHECK(contains(error_of(paper(1, 0), limited, force), "with limits is not followed"));
  OptimumCurveOptions options;
  options.step = 0;
  CHECK_THROWS_AS(optimum_curve(paper(1, 0), paper_load, force, options), OptionsError);
  options = {};
  options.points = 0;
  CHECK_THROWS_AS(optimum_curve(paper(1, 0), paper_load, force, options), OptionsError);
  options = {};
  options.seconds = -1;
  CHECK_THROWS_AS(optimum_curve(paper(1, 0), paper_load, force, options), OptionsError);
  OptimumProblem cases = paper_load;
  cases.cases.push_back({{{"damper.stiffness", 3000}}});
  CHECK(contains(error_of(paper(1, 0), cases, force), "over several cases is not followed"));
}

TEST_CASE("result files tell every point of the curve and every event") {
  const scene::Scene s = levels();
  OptimumCurveResult result;
  result.study = "levels";
  result.problem = {{{"damper.normal_load", 5, 10}}, 15, 60};
  result.curve = optimum_curve(s, result.problem, {"force.cosine", 1, 8});
  const std::vector<OptimumCurveResult> results = {result};
  std::ostringstream text;
  const results::Results all =
      studies::collected<OptimumCurveResult>(s, described_curves(s, result.problem, "force.cosine"), results);
  results::write_json(text, all);
  const auto document = nlohmann::json::parse(text.str());
  CHECK(document["format"] == "arcslip-optimum-curves-1");
  const auto& curve = document["optimum_curves"][0];
  CHECK(curve["along"] == "force.cosine");
  CHECK(curve["status"] == "complete");
  REQUIRE(curve["points"].size() == result.curve.points.size());
  const OptimumPoint& last = result.curve.points.back();
  CHECK(curve["points"].back()["force.cosine"] == last.along);
  CHECK(curve["points"].back()["damper.normal_load"] == last.design[0]);
  CHECK(curve["points"].back()["amplitude"] == last.amplitude);
  CHECK(curve["points"].back()["at_bound"]["damper.normal_load"] == "upper");
  CHECK(curve["points"].back()["peaks"][0]["weight"] == 1);
  REQUIRE(curve["events"].size() == 2);
  CHECK(curve["events"][0]["kind"] == "bound_left");
  CHECK(curve["events"][0]["parameter"] == "damper.normal_load");
  CHECK(curve["events"][0]["point"]["at_bound"]["damper.normal_load"] == "lower");

  std::ostringstream csv;
  results::write_csv(csv, all, "points");
  std::istringstream lines(csv.str());
  std::string line;
  std::vector<std::string> rows;
  while (std::getline(lines, line)) rows.push_back(line);
  CHECK(rows.size() == 1 + result.curve.points.size());
  CHECK(rows[0].starts_with("study,curve,force.cosine (N),damper.normal_load (N),amplitude (m),peaks,"));
  CHECK(rows[1].starts_with("levels,1,1,5,"));
  std::ostringstream events;
  results::write_csv(events, all, "events");
  CHECK(contains(events.str(), "\r\nlevels,1,bound_left,damper.normal_load,"));

  const auto folder = std::filesystem::temp_directory_path() / "arcslip_optimum_curve";
  std::filesystem::create_directories(folder);
  const auto figures = output::draw_figures(figures_of(s, results), folder.string(), "best");
  std::ifstream script(folder / "best.gp");
  const std::string commands{std::istreambuf_iterator<char>(script), {}};
  for (const char* figure : {"best_damper.normal_load.svg", "best_amplitude.svg", "best_stick.svg"})
    CHECK(contains(commands, figure));
  CHECK((figures.images.size() == 6 || !figures.problem.empty()));
  std::filesystem::remove_all(folder);
}

TEST_CASE("a peak without weight beside one that does not depend on the design holds no optimum") {
  // The lower resonance comes to where d1 sticks: from there on it alone decides, over a range of loads.
  const OptimumProblem problem{{{"d1.normal_load", 0.05, 50}}, 8, 45};
  const OptimumCurve curve = optimum_curve(two_dampers(2), problem, {"d2.stiffness", 200, 8000});
  INFO(curve.stop.message);
  CHECK(curve.stop.reason == reasons::flat);
  REQUIRE_FALSE(curve.points.empty());
  const OptimumPoint& last = curve.points.back();
  REQUIRE(last.peaks.size() == 2);
  CHECK(last.peaks[0].weight == Approx(1).margin(1e-4));
  CHECK(std::is_sorted(curve.points.begin(), curve.points.end(),
                       [](const auto& a, const auto& b) { return a.along < b.along; }));
  double amplitude[2] = {0, 0};
  for (const int i : {0, 1}) {
    OptimumPoint beyond = last;
    beyond.along *= 1.005;
    beyond.design[0] *= i == 0 ? 1.1 : 1.3;
    scene::Scene s = two_dampers(2);
    scene::set(s, "d2.stiffness", beyond.along);
    scene::set(s, "d1.normal_load", beyond.design[0]);
    amplitude[i] = optimum(s, problem, {.evaluations = 1, .certificate = false}).evaluations[0].amplitude;
  }
  CHECK(reference::error(amplitude[0], amplitude[1]) < 1e-10);
  for (std::size_t i = 5; i < curve.points.size(); i += 30) {
    const OptimumPoint& at = curve.points[i];
    CAPTURE(at.along);
    CHECK(reference::error(search(two_dampers(2), problem, "d2.stiffness", at).amplitude, at.amplitude) <
          1e-9);
  }
}

TEST_CASE("a curve of optima ends, and says so, where the highest peak ceases to depend on the design") {
  const scene::Scene s = two_dampers(2);
  const auto curve = optimum_curve(s, {{{"d1.normal_load", 0.05, 50}}, 8, 45}, {"d1.stiffness", 200, 8000});
  CHECK(curve.status == observables::Status::stopped);
  INFO(curve.stop.message);
  CHECK(curve.stop.reason == reasons::flat);
  CHECK(curve.stop.message.find("does not depend on d1.normal_load") != std::string::npos);
  REQUIRE_FALSE(curve.points.empty());
  const OptimumPoint& last = curve.points.back();
  // Beyond, two loads give the same largest amplitude, at the resonance at which d1 sticks.
  const auto highest = [&](double load) {
    scene::Scene beyond = s;
    scene::set(beyond, "d1.stiffness", 1.1 * last.along);
    scene::set(beyond, "d1.normal_load", load);
    observables::ResponsePoint most;
    const auto branches = observables::frequency_response(beyond, {8, 45});
    for (const auto& event : branches.front().events)
      if (event.kind == "peak" && event.point.amplitude > most.amplitude) most = event.point;
    return most;
  };
  const auto one = highest(1.05 * last.design[0]), other = highest(1.15 * last.design[0]);
  REQUIRE_FALSE(one.elements.empty());
  CHECK(one.elements[0].stick_percent == 100);
  CHECK(reference::error(one.amplitude, other.amplitude) < 1e-10);
}
