// The setting of least resonance: exact optima, closed forms, and everything that may be asked wrongly.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"
#include "optimize/paper_optimum.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace arcslip;
using optimize::Optimum;
using optimize::OptimumOptions;
using optimize::OptimumProblem;
using paper_optimum::over_load;
using std::numbers::pi;

namespace {

scene::Scene paper(int order, double load, double damping = 0.134) {
  scene::Scene s = scenes::paper(order, load);
  scene::set(s, "c.value", damping);
  return s;
}

std::string optimum_error(const OptimumProblem& problem, const OptimumOptions& options = {}) {
  try {
    optimize::optimum(scenes::paper(1), problem, options);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "no error";
}

void check_exact(const Optimum& found, const nlohmann::json& exact) {
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  REQUIRE(found.design.size() == 1);
  CHECK(std::abs(found.design[0] - exact["normal_load"].get<double>()) < 1e-5);
  CHECK(reference::error(found.amplitude, exact["amplitude"]) < 5e-9);
  CHECK(reference::error(found.point.omega / scenes::hertz, exact["frequency_hz"]) < 1e-7);
  CHECK(std::abs(found.point.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 0.005);
}

}  // namespace

TEST_CASE("the exact optima are found from below and from above") {
  for (const auto& exact : reference::exact("optima"))
    for (const double start : {1.2, 30.0}) {
      CAPTURE(exact["c"].get<double>(), start);
      check_exact(optimize::optimum(paper(101, start, exact["c"]), over_load, {.certificate = false}), exact);
    }
}

TEST_CASE("one harmonic, no damping: Fn = pi f0/(2 mu), from NLopt and directly") {
  const scene::Scene s = paper(1, 10, 0);
  const Optimum found = optimize::optimum(s, over_load);
  CHECK(reference::error(found.design[0], pi) < 1e-6);
  CHECK(reference::error(found.amplitude, pi / 3500) < 1e-12);
  CHECK(found.point.elements[0].stick_percent == Approx(50).epsilon(1e-6));
  const auto direct = optimize::direct_optimum(s, over_load);
  REQUIRE(direct.found);
  CHECK(reference::error(direct.point.over, pi) < 1e-9);
  CHECK(reference::error(direct.point.amplitude, pi / 3500) < 1e-12);
}

TEST_CASE("both ways agree at each order") {
  for (const int order : {1, 3, 7, 15}) {
    const scene::Scene s = paper(order, 3);
    const auto direct = optimize::direct_optimum(s, over_load);
    REQUIRE(direct.found);
    const Optimum found = optimize::optimum(s, over_load, {.certificate = false});
    CHECK(reference::error(found.design[0], direct.point.over) < 1e-6);
    CHECK(reference::error(found.amplitude, direct.point.amplitude) < 1e-11);
  }
}

TEST_CASE("the optimum of the paper's damper takes at most 15 evaluations and two responses") {
  const Optimum found = optimize::optimum(paper(55, 3), over_load, {.certificate = false});
  CHECK(found.evaluations.size() <= 15);
  CHECK(found.work.responses == 2);
  CHECK(found.point.elements[0].stick_percent == Approx(49.6565).margin(1e-3));
}

TEST_CASE("one harmonic, no damping: curvature and tolerance ranges are those of p^2/(p - pi/4)/kd") {
  const Optimum found = optimize::optimum(paper(1, 3, 0), over_load);
  REQUIRE(found.certificate);
  const auto& certificate = *found.certificate;
  // A(p) = p^2/(p - q)/kd with q = pi/4: A'' = 2 q^2/(p - q)^3/kd = 2/(q kd) at p = 2 q, dp = mu dFn.
  const double q = pi / 4;
  REQUIRE(certificate.curvature.size() == 1);
  CHECK(certificate.curvature(0, 0) == Approx(0.25 * 2 / (q * 3500)).epsilon(1e-6));
  CHECK(std::abs(certificate.gradient[0]) * pi < 1e-6 * found.amplitude);
  CHECK(certificate.stationarity < 1e-6);
  REQUIRE(certificate.to_minimum.size() == 1);
  CHECK(std::abs(found.design[0] + certificate.to_minimum[0] - pi) < 1e-9);
  CHECK(certificate.at_bound == std::vector<int>{0});
  REQUIRE(certificate.ranges[0].size() == 2);
  for (const auto& range : certificate.ranges[0]) {
    // p^2/(p - q) = 4 q (1 + share): p = 2 q (1 + share +- sqrt(share^2 + share)) ... with s = 1 + share.
    const double s = 1 + range.share, root = std::sqrt(s * s - s);
    CHECK(range.lower == Approx(4 * q * (s - root)).epsilon(1e-6));
    CHECK(range.upper == Approx(4 * q * (s + root)).epsilon(1e-6));
    CHECK_FALSE(range.lower_is_bound);
    CHECK_FALSE(range.upper_is_bound);
  }
  REQUIRE(certificate.peaks.size() == 1);
  CHECK(certificate.peaks[0].active);
  CHECK(certificate.peaks[0].weight == 1);
  CHECK(certificate.others.empty());
  CHECK(certificate.others_lower);
}

TEST_CASE("a tolerance range that a bound cuts says so") {
  const Optimum found = optimize::optimum(paper(5, 3), {{{"damper.normal_load", 3, 3.2}}, 18, 22});
  REQUIRE(found.certificate);
  const auto& range = found.certificate->ranges[0][1];
  CHECK(range.lower == 3);
  CHECK(range.upper == 3.2);
  CHECK(range.lower_is_bound);
  CHECK(range.upper_is_bound);
}

TEST_CASE("an optimum at a bound is reported, with the gradient that is left") {
  const Optimum found = optimize::optimum(paper(7, 6), {{{"damper.normal_load", 4, 10}}, 18, 22});
  CHECK(found.status == observables::Status::complete);
  CHECK(found.design[0] == 4);
  REQUIRE(found.certificate);
  CHECK(found.certificate->at_bound == std::vector<int>{-1});
  CHECK(found.certificate->gradient[0] > 0);
  CHECK(found.certificate->stationarity == 0);
}

TEST_CASE("a start at which the resonance is unbounded is moved to where it is finite, and that is said") {
  for (const double start : {0.1, 1.0, 1.57}) {
    const Optimum found = optimize::optimum(paper(1, start, 0), over_load, {.certificate = false});
    CHECK(found.status == observables::Status::complete);
    CHECK(reference::error(found.design[0], pi) < 1e-6);
    REQUIRE(found.notes.size() == 1);
    CHECK(contains(found.notes[0], "was moved to damper.normal_load = "));
    CHECK(contains(found.notes[0], "the resonance is unbounded"));
  }
}

TEST_CASE("bounds within the unbounded region leave nothing to be found, and that is said") {
  const Optimum found = optimize::optimum(paper(1, 1, 0), {{{"damper.normal_load", 0.1, 1.5}}, 18, 22});
  CHECK(found.status == observables::Status::failed);
  CHECK(found.stop.reason == optimize::reasons::unbounded);
  CHECK(contains(found.stop.message, "no start was found within the bounds; at damper.normal_load = 1: "));
  CHECK(contains(found.stop.message, "the resonance is unbounded"));
  CHECK_FALSE(found.certificate);
}

TEST_CASE("a start at which nothing slips is moved to where something does, and that is said") {
  const Optimum found = optimize::optimum(paper(7, 90, 1.34), over_load, {.certificate = false});
  CHECK(found.design[0] == Approx(2.74).margin(0.01));
  REQUIRE(found.notes.size() == 1);
  CHECK(contains(found.notes[0], "no friction element slips there"));
}

TEST_CASE("bounds that hold no slip leave the amplitude flat, and that is said") {
  const Optimum found = optimize::optimum(paper(7, 450), {{{"damper.normal_load", 400, 1000}}, 18, 22});
  CHECK(found.status == observables::Status::complete);
  CHECK(found.stop.reason == optimize::reasons::flat);
  CHECK(found.stop.message ==
        "the amplitude does not depend on damper.normal_load within the bounds: no friction element slips at "
        "the peak");
  CHECK(found.design[0] == 450);
}

TEST_CASE("a start outside the bounds is moved onto them") {
  const Optimum found = optimize::optimum(paper(3, 200), over_load, {.certificate = false});
  CHECK(found.design[0] == Approx(3.09).margin(0.05));
  REQUIRE_FALSE(found.notes.empty());
  CHECK(contains(found.notes[0], "the start damper.normal_load = 200 is outside [0.1, 100]"));
}

TEST_CASE("a limit on the energy of friction is kept, and is active where it must be") {
  // E = 4 mu Fn (A - mu Fn/kd) of the wear is 2.74e-3 J at the optimum without it.
  OptimumProblem limited = over_load;
  limited.limits = {{.observable = "damper.stick_percent", .at_least = 60}};
  const Optimum found = optimize::optimum(paper(15, 3), limited, {.certificate = false});
  CHECK(found.status == observables::Status::complete);
  CHECK(found.feasible);
  CHECK(found.point.elements[0].stick_percent == Approx(60).epsilon(1e-6));
  // The amplitude grows with the load beyond the optimum: the least load with 60 % is the best one.
  const double below = optimize::optimum(paper(15, 3), over_load, {.certificate = false}).amplitude;
  CHECK(found.amplitude > below);

  limited.limits = {{.observable = "frequency", .at_least = 18, .at_most = 19.8}};
  const Optimum slow = optimize::optimum(paper(15, 3), limited, {.certificate = false});
  CHECK(slow.feasible);
  CHECK(slow.point.omega / scenes::hertz == Approx(19.8).epsilon(1e-7));
  CHECK(slow.design[0] < 3);

  limited.limits = {{.observable = "energy_friction", .at_most = 1e-3}};
  const Optimum none = optimize::optimum(paper(5, 3), limited, {.evaluations = 60, .certificate = false});
  CHECK((!none.feasible || none.point.energy_friction <= 1e-3 * (1 + 1e-6)));
}

TEST_CASE("limits that no design keeps are no complete answer, and the one nearest to them is reported") {
  OptimumProblem limited = over_load;
  limited.linear_limits = {{.weights = {{"damper.normal_load", 1}}, .at_most = 0.05}};
  const Optimum found = optimize::optimum(paper(3, 3), limited);
  CHECK(found.status == observables::Status::stopped);
  CHECK(found.stop.reason == optimize::reasons::infeasible);
  CHECK(contains(found.stop.message, "no feasible design was found"));
  CHECK_FALSE(found.feasible);
  CHECK_FALSE(found.certificate);
  CHECK(found.design[0] == Approx(0.1).epsilon(1e-6));
}

TEST_CASE("no design is a complete answer if the response of another is far below its own") {
  // Near the lower end of the window the response folds out of it, and comes back to the resonance.
  scene::Scene s = scenes::example("levels");
  scene::set(s, "k.value", 8600);
  const OptimumProblem problem{{{"damper.normal_load", 0.5, 60}}, 15, 60};
  const Optimum found = optimize::optimum(s, problem, {.certificate = false});
  CAPTURE(found.stop.message, found.design[0]);
  scene::set(s, "damper.normal_load", 1);
  double most = 0;
  for (const auto& branch : observables::frequency_response(s, {15, 60}))
    for (const auto& point : branch.points) most = std::max(most, point.amplitude);
  CHECK(most > 0);
  // Below 0.85 N the resonance comes back into the window: the amplitude jumps from 0.52 mm to 1.75 mm.
  CHECK(found.amplitude < most);
  CHECK(found.status == observables::Status::stopped);
  CHECK(found.stop.reason == optimize::reasons::not_stationary);
  CHECK(contains(found.stop.message, "a little beyond, at damper.normal_load = 0.84"));
  CHECK(contains(found.stop.message, "the amplitude jumps to 0.00175"));
  auto notes = found.notes;
  std::sort(notes.begin(), notes.end());
  CHECK(std::adjacent_find(notes.begin(), notes.end()) == notes.end());
}

TEST_CASE("with sampled friction the search ends, and the direct method reports that it is not applicable") {
  scene::Scene s = paper(5, 3);
  s.harmonics.friction = scene::Friction::sampled;
  s.harmonics.samples = 64;
  const Optimum found = optimize::optimum(s, over_load);
  CHECK(found.status == observables::Status::complete);
  const auto direct = optimize::direct_optimum(s, over_load);
  CHECK_FALSE(direct.found);
  CHECK(contains(direct.message, "with exact friction only"));
  CHECK(direct.curves.empty());
}

TEST_CASE("every algorithm that was asked for comes to the same optimum") {
  const scene::Scene s = paper(3, 5);
  const double best = optimize::direct_optimum(s, over_load).point.amplitude;
  for (const char* algorithm : {"LD_SLSQP", "LD_MMA", "LD_CCSAQ", "LD_LBFGS", "LD_VAR2", "LD_TNEWTON",
                                "LN_BOBYQA", "LN_SBPLX", "LN_NELDERMEAD", "GN_DIRECT_L"}) {
    CAPTURE(algorithm);
    const Optimum found =
        optimize::optimum(s, over_load, {.algorithm = algorithm, .evaluations = 150, .certificate = false});
    CHECK(found.algorithm == algorithm);
    CHECK(found.amplitude >= best * (1 - 1e-11));
    CHECK(found.amplitude <= best * (1 + 1e-6));
  }
}

TEST_CASE("a time limit of a millisecond leaves the best so far, and its reason") {
  const Optimum found = optimize::optimum(paper(55, 10), over_load, {.seconds = 1e-3});
  CHECK(found.status == observables::Status::stopped);
  CHECK(found.stop.reason == optimize::reasons::time_limit);
  CHECK(contains(found.stop.message, "the limit of "));
  CHECK(contains(found.stop.message, "; the lowest amplitude is 0.0016858"));
  CHECK(found.design == std::vector<double>{10});
  CHECK_FALSE(found.certificate);
}

TEST_CASE("limits of evaluations and the callback stop the search with the best so far") {
  const Optimum few = optimize::optimum(paper(3, 50), over_load, {.evaluations = 3});
  CHECK(few.status == observables::Status::stopped);
  CHECK(few.stop.reason == optimize::reasons::evaluation_limit);
  CHECK(few.evaluations.size() <= 4);
  CHECK(std::isfinite(few.amplitude));

  int calls = 0;
  OptimumOptions options{.control = control::Control(control::Sources())};
  options.progress = [&](const optimize::OptimumProgress& p) {
    if (++calls == 4 || p.best > p.amplitude) options.control.stop();
  };
  const Optimum stopped = optimize::optimum(paper(3, 3), over_load, options);
  CHECK(stopped.status == observables::Status::stopped);
  CHECK(stopped.stop.reason == optimize::reasons::user);
}

TEST_CASE("an exception in the middle ends the search with its text and the best so far") {
  for (const int last : {1, 4}) {
    int calls = 0;
    OptimumOptions options;
    options.progress = [&](const optimize::OptimumProgress&) {
      if (++calls == last) throw std::runtime_error("disk full");
    };
    const Optimum found = optimize::optimum(paper(3, 50), over_load, options);
    CHECK(found.status == observables::Status::failed);
    CHECK(found.stop.reason == optimize::reasons::objective_failed);
    CHECK(contains(found.stop.message, "threw \"disk full\" after "));
    CHECK(contains(found.stop.message, "; the lowest amplitude is "));
    CHECK(std::isfinite(found.amplitude));
  }
}

TEST_CASE("bad input is answered with what was found and what is allowed") {
  const auto over = [](const std::string& name, double lower, double upper) {
    return OptimumProblem{{{name, lower, upper}}, 18, 22};
  };
  OptimumProblem twice = over_load, window = over_load, empty = over_load, limit = over_load,
                 linear = over_load, crossed = over_load;
  twice.over.push_back(twice.over[0]);
  window.frequency_to = 17;
  empty.over.clear();
  limit.limits = {{.observable = "energy_frictoin", .at_most = 1}};
  linear.linear_limits = {{.weights = {{"c.value", 1}}, .at_most = 1}};
  crossed.limits = {{.observable = "frequency", .at_least = 20, .at_most = 19}};
  struct Row {
    std::string error, expected;
  };
  const Row rows[] = {
      {optimum_error(over("damper.normal_load", 100, 0.1)),
       "bounds of \"damper.normal_load\" are [100, 0.1]: the lower must be below the upper"},
      {optimum_error(over("damper.normal_load", 3, 3)),
       "bounds of \"damper.normal_load\" are [3, 3]: equal bounds leave nothing to vary"},
      {optimum_error(over("damper.normal_load", 3, HUGE_VAL)), "are [3, inf]: must be finite"},
      {optimum_error(over("damper.normal_load", -1, 3)), "parameter \"damper.normal_load\": "},
      {optimum_error(over("damper.normal_laod", 1, 3)), "damper.normal_load"},
      {optimum_error(twice), "parameter \"damper.normal_load\" is named twice"},
      {optimum_error(window), "the frequency window is [18, 17]: 0 < lower < upper"},
      {optimum_error(empty), "there is nothing to vary: no parameter is named"},
      {optimum_error(limit), "no observable \"energy_frictoin\" to limit; did you mean \"energy_friction\"?"},
      {optimum_error(linear),
       "a linear limit names \"c.value\", which is not one of the design parameters: damper.normal_load"},
      {optimum_error(crossed), "limit on \"frequency\" is [20, 19]: the lower must be below the upper"},
      {optimum_error(over_load, {.algorithm = "LD_SLSPQ"}), "did you mean \"LD_SLSQP\"?"},
      {optimum_error(over_load, {.algorithm = "LD_SLSPQ"}), "LN_BOBYQA"},
  };
  for (const Row& row : rows) {
    INFO(row.error);
    CHECK(contains(row.error, row.expected));
  }
}
