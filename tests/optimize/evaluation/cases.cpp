// One design for several cases.

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"
#include "optimize/optima.hpp"
#include "optimize/paper_optimum.hpp"

#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;
using optimize::Criterion;
using paper_optimum::closed_form;
using paper_optimum::over_load;
using std::numbers::pi;

namespace {

double peak_at(double p, double f0) {
  return paper_optimum::peak(p, pi * f0 / 4);
}

optimize::OptimumProblem over_load_in(const std::vector<optimize::LoadCase>& cases,
                                      Criterion criterion = Criterion::worst) {
  optimize::OptimumProblem problem = over_load;
  problem.cases = cases;
  problem.criterion = criterion;
  return problem;
}

}  // namespace

TEST_CASE("a friction coefficient between 0.4 and 0.6: both ends have the same peak at the best load") {
  const auto found = optimize::optimum(closed_form(), over_load_in({{{{"damper.friction_coefficient", 0.4}}},
                                                                    {{{"damper.friction_coefficient", 0.6}}}},
                                                                   Criterion::worst));
  CHECK(found.status == observables::Status::complete);
  // 0.16/(0.4 F - q) = 0.36/(0.6 F - q) at F = q/0.24.
  const double load = pi / 4 / 0.24;
  CHECK(reference::error(found.design[0], load) < 1e-7);
  CHECK(reference::error(found.amplitude, peak_at(0.4 * load, 1)) < 1e-8);
  CHECK(reference::error(found.cases[0].amplitude, found.cases[1].amplitude) < 1e-7);
}

TEST_CASE("the best load for the worst of several levels of excitation is that of the highest") {
  const auto found = optimize::optimum(
      closed_form(), over_load_in({{{{"force.cosine", 0.5}}}, {{{"force.cosine", 1}}}}, Criterion::worst));
  CHECK(reference::error(found.design[0], pi) < 1e-6);
  CHECK(reference::error(found.amplitude, peak_at(pi / 2, 1)) < 1e-10);
}

TEST_CASE("a start of a robust search outside the bounds is moved, and that is said") {
  scene::Scene s = closed_form();
  scene::set(s, "damper.normal_load", 200);
  const auto found = optimize::optimum(s, over_load_in({{{{"force.cosine", 1}}}}, Criterion::worst));
  CHECK(reference::error(found.design[0], pi) < 1e-6);
  REQUIRE(found.notes.size() == 1);
  CHECK(found.notes[0].find("was moved to 100") != std::string::npos);
}

TEST_CASE("the best load for the weighted mean over levels is where the mean's derivative vanishes") {
  const auto found = optimize::optimum(
      closed_form(),
      over_load_in({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}, Criterion::mean));
  CHECK(found.status == observables::Status::complete);
  const auto mean = [](double p) { return (3 * peak_at(p, 0.5) + peak_at(p, 1)) / 4; };
  CHECK(reference::error(found.amplitude, mean(0.5 * found.design[0])) < 1e-10);
  const double p = 0.5 * found.design[0];
  const auto slope = [&](double f0) {
    const double q = pi * f0 / 4;
    return p * (p - 2 * q) / ((p - q) * (p - q));
  };
  CHECK(std::abs(3 * slope(0.5) + slope(1)) < 1e-6);
}

TEST_CASE("levels with weights: where their weighted peaks cross, the multipliers balance their slopes") {
  // 3 A(p; 1/2) rises beyond p = q, A(p; 1) falls up to p = 2 q: they cross between, by bisection.
  double below = pi / 4, above = pi / 2;
  while (above - below > 1e-15) {
    const double p = 0.5 * (below + above);
    (3 * peak_at(p, 0.5) < peak_at(p, 1) ? below : above) = p;
    if (p == 0.5 * (below + above)) break;
  }
  const double load = below / 0.5;
  const auto found = optimize::optimum(
      closed_form(), over_load_in({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}));
  CHECK(found.status == observables::Status::complete);
  CHECK(found.epigraph);
  CHECK(reference::error(found.design[0], load) < 1e-8);
  CHECK(reference::error(found.amplitude, peak_at(below, 1)) < 1e-8);
  REQUIRE(found.cases.size() == 2);
  // p A'/A = 2 - p/(p - q): 1/3 and -3 at p = 5 q/4.
  CHECK(found.cases[0].multiplier == Approx(0.9).epsilon(1e-7));
  CHECK(found.cases[1].multiplier == Approx(0.1).epsilon(1e-7));
  CHECK(found.cases[0].active);
  CHECK(found.cases[0].amplitude == Approx(peak_at(below, 0.5)).epsilon(1e-8));
  CHECK(found.cases[0].set == std::vector<std::pair<std::string, double>>{{"force.cosine", 0.5}});
  CHECK(found.cases[0].weight == 3);
  CHECK(found.cases[1].point.amplitude == Approx(found.amplitude).epsilon(1e-12));

  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity < 1e-7);
  CHECK(found.certificate->curvature.size() == 0);
  REQUIRE(found.certificate->peaks.size() == 2);
  CHECK(found.certificate->peaks[1].in_case == 1);
  CHECK(found.certificate->peaks[1].weight == Approx(0.1).epsilon(1e-7));
  // Within 5 %: below, the higher level's curve; above, the lower one's.
  const auto& range = found.certificate->ranges[0][1];
  CHECK(peak_at(0.5 * range.lower, 1) == Approx(1.05 * found.amplitude).epsilon(1e-7));
  CHECK(3 * peak_at(0.5 * range.upper, 0.5) == Approx(1.05 * found.amplitude).epsilon(1e-7));
}

TEST_CASE("algorithms of every kind come to the crossing of two levels") {
  for (const char* algorithm :
       {"LD_SLSQP", "LD_MMA", "LD_CCSAQ", "LN_COBYLA", "LN_BOBYQA", "LN_SBPLX", "GN_DIRECT_L"}) {
    CAPTURE(algorithm);
    const auto found = optimize::optimum(
        closed_form(), over_load_in({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}),
        {.algorithm = algorithm, .evaluations = 300, .certificate = false});
    CHECK(found.epigraph == (algorithm[1] == 'D'));
    CHECK(reference::error(found.design[0], 2.5 * pi / 4) < 1e-4);
    CHECK(found.amplitude >= peak_at(1.25 * pi / 4, 1) * (1 - 1e-9));
  }
}

TEST_CASE("the certificate of a weighted mean has the curvature and the ranges of the mean") {
  const auto found = optimize::optimum(
      closed_form(),
      over_load_in({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}, Criterion::mean));
  REQUIRE(found.certificate);
  const double p = 0.5 * found.design[0];
  const auto second = [&](double f0) {  // A'' = 2 q^2/(p - q)^3/kd
    const double q = pi * f0 / 4;
    return 2 * q * q / std::pow(p - q, 3) / 3500;
  };
  REQUIRE(found.certificate->curvature.size() == 1);
  CHECK(found.certificate->curvature(0, 0) == Approx(0.25 * (3 * second(0.5) + second(1)) / 4).epsilon(1e-6));
  const auto mean = [](double at) { return (3 * peak_at(at, 0.5) + peak_at(at, 1)) / 4; };
  for (const auto& range : found.certificate->ranges[0])
    for (const double end : {range.lower, range.upper})
      CHECK(mean(0.5 * end) == Approx((1 + range.share) * mean(p)).epsilon(2e-6 * range.share));
  CHECK(found.certificate->stationarity < 1e-7);
  // Every case is active, with its share of the mean.
  REQUIRE(found.cases.size() == 2);
  CHECK(found.cases[0].active);
  CHECK(found.cases[1].active);
  CHECK(found.cases[0].multiplier == Approx(3 * peak_at(p, 0.5) / 4 / mean(p)).epsilon(1e-8));
  CHECK(found.cases[1].multiplier == Approx(peak_at(p, 1) / 4 / mean(p)).epsilon(1e-8));
}

TEST_CASE("a limit holds in every case, in one that is not the highest too") {
  // stick = acos(2 q/p - 1)/pi of the period: 60 % of it at the higher level is more at the lower one.
  auto problem = over_load_in({{{{"force.cosine", 0.5}}, 4}, {{{"force.cosine", 1}}, 1}});
  problem.limits = {{.observable = "damper.stick_percent", .at_least = 60}};
  const auto found = optimize::optimum(closed_form(), problem);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.feasible);
  const double p = pi / 2 / (1 + std::cos(0.6 * pi));
  CHECK(reference::error(0.5 * found.design[0], p) < 1e-7);
  CHECK(reference::error(found.amplitude, 4 * peak_at(p, 0.5)) < 1e-7);
  REQUIRE(found.cases.size() == 2);
  CHECK(found.cases[0].active);
  CHECK_FALSE(found.cases[1].active);
  CHECK(found.cases[1].point.elements[0].stick_percent == Approx(60).epsilon(1e-6));
  // Of 1 % less stick the amplitude falls by 1 % of the ratio of the slopes over ln p.
  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity < 1e-9);
  CHECK(found.certificate->to_minimum.empty());
  REQUIRE(found.certificate->limits.size() == 1);
  const auto& limit = found.certificate->limits[0];
  CHECK(limit.limit == "damper.stick_percent");
  CHECK(limit.in_case == 1);
  const double stick = 100 / pi * (pi / 2 / p) / std::sin(0.6 * pi), amplitude = 2 - p / (p - pi / 8);
  CHECK(limit.multiplier == Approx(60 * amplitude / stick).epsilon(1e-6));
  CHECK(found.cases[0].multiplier == Approx(1));
}

TEST_CASE("one case of weight 1 is the scene with what the case sets") {
  scene::Scene s = scenes::paper(7, 5);
  const auto in_a_case = optimize::optimum(s, over_load_in({{{{"force.cosine", 1.5}}}}));
  scene::set(s, "force.cosine", 1.5);
  const auto plain = optimize::optimum(s, over_load);
  CHECK(in_a_case.design == plain.design);
  CHECK(in_a_case.amplitude == plain.amplitude);
  CHECK(in_a_case.stop.message == plain.stop.message);
  REQUIRE(plain.cases.size() == 1);
  CHECK(plain.cases[0].set.empty());
  CHECK(plain.cases[0].amplitude == Approx(plain.amplitude).epsilon(1e-10));
  CHECK(plain.cases[0].multiplier == 1);
  const auto twice = optimize::optimum(s, over_load_in({{{}, 2}}));
  CHECK(twice.amplitude == Approx(2 * plain.amplitude).epsilon(1e-12));
  const auto mean = optimize::optimum(s, over_load_in({{{}, 2}}, Criterion::mean));
  CHECK(mean.amplitude == Approx(plain.amplitude).epsilon(1e-12));
}

TEST_CASE(
    "limits of time and evaluations, the user and what is thrown end a search over cases as one over none") {
  const scene::Scene s = scenes::paper(7, 50);
  for (const Criterion criterion : {Criterion::worst, Criterion::mean}) {
    const auto problem = over_load_in({{{{"force.cosine", 0.5}}, 3}, {{{"force.cosine", 1}}, 1}}, criterion);
    const auto few = optimize::optimum(s, problem, {.evaluations = 3});
    CHECK(few.status == observables::Status::stopped);
    CHECK(few.stop.reason == optimize::reasons::evaluation_limit);
    CHECK(few.evaluations.size() <= 4);
    CHECK(few.cases.size() == 2);
    CHECK_FALSE(few.certificate);
    const auto late = optimize::optimum(s, problem, {.seconds = 1e-6});
    CHECK(late.status == observables::Status::stopped);
    CHECK(late.stop.reason == optimize::reasons::time_limit);
    REQUIRE(late.design.size() == 1);
    CHECK(late.design[0] == Approx(50).epsilon(1e-12));
    for (const bool throws : {false, true}) {
      int calls = 0;
      optimize::OptimumOptions options{.control = control::Control(control::Sources())};
      options.progress = [&](const optimize::OptimumProgress&) {
        if (++calls < 4) return;
        if (throws) throw std::runtime_error("disk full");
        options.control.stop();
      };
      const auto found = optimize::optimum(s, problem, options);
      CHECK(found.stop.reason == (throws ? optimize::reasons::objective_failed : optimize::reasons::user));
      CHECK(found.status == (throws ? observables::Status::failed : observables::Status::stopped));
      CHECK(found.cases.size() == 2);
    }
  }
}

TEST_CASE("where nothing slips in the highest case the criterion is flat, and that is said") {
  const scene::Scene s = scenes::paper(7, 450);
  optimize::OptimumProblem problem = over_load_in({{{{"force.cosine", 0.5}}}, {}});
  problem.over = {{"damper.normal_load", 400, 1000}};
  const auto found = optimize::optimum(s, problem);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.stop.reason == optimize::reasons::flat);
}

TEST_CASE("a start that is unbounded in one case is moved to where it is finite in all, and that is said") {
  scene::Scene s = closed_form();
  scene::set(s, "damper.normal_load", 2);  // mu Fn = 1 is above pi/4, and below pi/2
  const auto found = optimize::optimum(s, over_load_in({{{{"force.cosine", 1}}}, {{{"force.cosine", 2}}}}));
  CHECK(found.status == observables::Status::complete);
  CHECK(reference::error(found.design[0], 2 * pi) < 1e-6);
  REQUIRE(found.notes.size() == 1);
  CHECK(found.notes[0].find("the start damper.normal_load = 2 was moved to damper.normal_load = ") == 0);
  CHECK(found.notes[0].find(": in case 2: the resonance is unbounded") != std::string::npos);
}

TEST_CASE("bounds within which a case is unbounded everywhere leave nothing to be found, and that is said") {
  const auto found =
      optimize::optimum(closed_form(), over_load_in({{{{"force.cosine", 1}}}, {{{"force.cosine", 100}}}}));
  CHECK(found.status == observables::Status::failed);
  CHECK(found.stop.reason == optimize::reasons::unbounded);
  CHECK(found.stop.message.find("no start was found within the bounds") == 0);
  CHECK(found.cases.empty());
}

TEST_CASE("cases that make no sense are reported") {
  const scene::Scene s = closed_form();
  const auto error_of = [&](const optimize::LoadCase& one) {
    try {
      optimize::optimum(s, over_load_in({{}, one}));
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(error_of({{}, 0}) == "the weight of a case is 0, must be above 0");
  CHECK(error_of({{}, -1}) == "the weight of a case is -1, must be above 0");
  CHECK(error_of({{}, HUGE_VAL}) == "the weight of a case is inf, must be above 0");
  CHECK(error_of({{{"damper.normal_load", 3}}}) ==
        "a case sets \"damper.normal_load\", which is a design parameter");
  CHECK(error_of({{{"damper.normal_laod", 3}}}).find("damper.normal_load") != std::string::npos);
  CHECK(error_of({{{"damper.stiffness", -1}}}).find("damper.stiffness") != std::string::npos);
  CHECK(error_of({{}, 1, scene::Direction{}}) == "the response of a case is at no degree of freedom");
  CHECK(error_of({{}, 1, scene::Direction{{0, 0}}}) == "the response of a case is at no degree of freedom");
  CHECK(error_of({{}, 1, scene::Direction{{1, 1}}}) ==
        "the response of a case is at degree of freedom 1 of 1");
  auto direct = over_load_in({{}});
  CHECK_THROWS_WITH(optimize::direct_optimum(s, direct),
                    "the direct method supports neither cases nor scatter");
}

TEST_CASE("the optimum of one combination depends on no other, to the last bit") {
  const scene::Scene s = scenes::paper(3);
  const auto of = [&](const std::vector<double>& forces) {
    return optima::of(s, {.problem = over_load}, {{"force.cosine", forces}});
  };
  const auto rising = of({1, 3}), falling = of({3, 1}), alone = of({3});
  REQUIRE(rising.size() == 2);
  REQUIRE(falling.size() == 2);
  for (const auto* other : {&falling[0], &alone[0]}) {
    CHECK(other->optimum.design == rising[1].optimum.design);
    CHECK(other->optimum.amplitude == rising[1].optimum.amplitude);
    CHECK(other->optimum.evaluations.size() == rising[1].optimum.evaluations.size());
  }
  CHECK(falling[1].optimum.design == rising[0].optimum.design);
}

TEST_CASE("the optimal load grows in proportion to the excitation, and not where a spring hardens") {
  const auto loads = [&](const scene::Scene& s) {
    std::vector<double> all;
    for (const auto& result : optima::of(s, {.problem = over_load}, {{"force.cosine", {1, 2, 4}}})) {
      CHECK(result.status == observables::Status::complete);
      if (result.direct.found) CHECK(result.difference_of_design() < 1e-6);
      all.push_back(result.optimum.design[0]);
    }
    return all;
  };
  const scene::Scene s = scenes::paper(5);
  const auto linear = loads(s);
  REQUIRE(linear.size() == 3);
  CHECK(reference::error(linear[1], 2 * linear[0]) < 1e-7);
  CHECK(reference::error(linear[2], 4 * linear[0]) < 1e-7);
  scene::Scene hardening = s;
  hardening.elements.push_back({"spring", &elements::cubic_spring(), s.elements[0].directions, {5e7}, 1});
  const auto bent = loads(hardening);
  REQUIRE(bent.size() == 3);
  const auto highest = [&](double load) {  // of a new response
    scene::Scene at = hardening;
    scene::set(at, "force.cosine", 4);
    scene::set(at, "damper.normal_load", load);
    double most = 0;
    for (const auto& branch : observables::frequency_response(at, scenes::window(at)))
      for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
    return most;
  };
  CHECK(highest(0.99 * bent[2]) > highest(bent[2]));
  CHECK(highest(1.01 * bent[2]) > highest(bent[2]));
  CHECK(reference::error(bent[2], 4 * bent[0]) > 1e-3);
}
