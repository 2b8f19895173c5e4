// How a curve of optima ends, and what is refused.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "optimize/curve/optimum_curves.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace optimum_curves {

using std::numbers::pi;

namespace {

std::string curve_error(const scene::Scene& s, const OptimumProblem& problem, const DesignVariable& along) {
  try {
    optimum_curve(s, problem, along);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

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
  int reported = 0;
  OptimumCurveOptions options{.search = {.control = control::Control(control::Sources())}};
  options.progress = [&](const OptimumPoint&) {
    if (++reported == 5) options.search.control.stop();
  };
  const OptimumCurve by_user = optimum_curve(paper(1, 0), paper_load, {"force.cosine", 0.1, 10}, options);
  CHECK(by_user.status == observables::Status::stopped);
  CHECK(by_user.stop.reason == reasons::user);
  CHECK(reported == 5);
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
  int reported = 0;
  options.progress = [&](const OptimumPoint&) {
    if (++reported == 4) throw std::runtime_error("enough");
  };
  const OptimumCurve curve = optimum_curve(paper(1, 0), paper_load, {"force.cosine", 0.1, 10}, options);
  CHECK(curve.status == observables::Status::failed);
  CHECK(curve.stop.reason == reasons::objective_failed);
  CHECK(contains(curve.stop.message, "an evaluation threw \"enough\""));
  CHECK(curve.points.size() == 4);
}

TEST_CASE("what cannot be continued is refused before anything is computed") {
  const DesignVariable force{"force.cosine", 1, 2};
  CHECK(contains(curve_error(paper(1, 0), paper_load, {"force.cosin", 1, 2}), "force.cosine"));
  CHECK(contains(curve_error(paper(1, 0), paper_load, {"damper.normal_load", 1, 2}), "named twice"));
  CHECK(contains(curve_error(paper(1, 0), paper_load, {"force.cosine", 2, 1}), "must be below"));
  OptimumProblem limited = paper_load;
  limited.limits.push_back({"energy_friction", -HUGE_VAL, 1e-3});
  CHECK(contains(curve_error(paper(1, 0), limited, force), "with limits cannot be continued"));
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
  CHECK(contains(curve_error(paper(1, 0), cases, force), "over several cases cannot be continued"));
}

TEST_CASE("a peak without weight next to one that does not depend on the design holds no optimum") {
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

}  // namespace optimum_curves
