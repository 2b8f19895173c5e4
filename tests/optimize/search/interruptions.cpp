// A search obeys at once, whatever it is doing, and says so.

#include "catch.hpp"
#include "contains.hpp"
#include "controls.hpp"
#include "size.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

using namespace arcslip;

namespace {

const optimize::OptimumSettings one_load{.problem = {{{"damper.normal_load", 0.1, 100}}, 18, 22}};

using Asked = std::function<bool(const std::string& phase)>;

// Polled with the phase that was reported last: false stops.
control::Control polled(const Asked& asked) {
  const auto phase = std::make_shared<std::string>();
  const auto see = [phase](const control::Progress& now) {
    *phase = now.phase;
    return true;
  };
  return controls::reporting(see, controls::polled([=] { return asked(*phase); }));
}

// How often each phase asks, where nothing stops it.
std::map<std::string, long> asked(const scene::Scene& s, const optimize::OptimumSettings& settings) {
  std::map<std::string, long> asked;
  optimize::optimum_study(s, settings, polled([&](const std::string& phase) { return ++asked[phase] > 0; }));
  return asked;
}

}  // namespace

TEST_CASE("every phase of a search asks at every step of a response, and a stop in any of them is reported") {
  const scene::Scene s = scenes::paper(7, 3);
  const auto times = asked(s, one_load);
  std::set<std::string> phases;
  for (const auto& [phase, count] : times) {
    phases.insert(phase);
    CAPTURE(phase, count);
    if (phase != "the search") CHECK(count >= 30);  // the peaks of the search are followed, without responses
    for (const long last : {1L, count / 2, count}) {
      long here = 0, after = 0;
      const auto result =
          optimize::optimum_study(s, one_load, polled([&, name = phase](const std::string& now) {
                                    if (here >= last) ++after;
                                    if (now == name) ++here;
                                    return here < last;
                                  }));
      CAPTURE(last);
      CHECK(after == 0);  // never asked again
      CHECK(result.status == observables::Status::stopped);
      CHECK(result.stop.reason == optimize::reasons::user);
      CHECK(contains(result.stop.message, "interrupted in " + phase));
    }
  }
  CHECK(phases == std::set<std::string>{"the initial design", "the search", "the verification",
                                        "the certificate", "the direct method",
                                        "the responses at the optimum"});
}

TEST_CASE(
    "the progress of a search reports its phases in turn, all evaluations and the least amplitude so far") {
  scene::Scene s = scenes::example("two_dampers");
  s.harmonics.order = 7;
  const auto& limited = s.studies[1].settings.as<optimize::OptimumSettings>();
  std::vector<std::string> phases;
  long evaluations = 0, fewer = 0;
  double best = HUGE_VAL, rise = 0;
  const auto result =
      optimize::optimum_study(s, limited, controls::reporting([&](const control::Progress& now) {
                                if (phases.empty() || phases.back() != now.phase)
                                  phases.emplace_back(now.phase);
                                fewer += now.points < evaluations;
                                evaluations = now.points;
                                if (!std::isnan(now.best)) {
                                  rise = std::max(rise, now.best / best - 1);
                                  best = now.best;
                                }
                                return true;
                              }));
  CHECK(fewer == 0);
  CHECK(rise < 1e-7);  // as much as the tolerance of a limit gains
  CHECK(phases == std::vector<std::string>{"the initial design", "the search", "the verification",
                                           "the search elsewhere", "the certificate",
                                           "the responses at the optimum"});
  CHECK(evaluations == static_cast<long>(result.optimum.evaluations.size()));
  CHECK(best == result.optimum.amplitude);
}

TEST_CASE("a search over cases asks in its curves, and is not complete without them") {
  scene::Scene s = scenes::paper(3, 3);
  optimize::OptimumSettings settings = one_load;
  settings.problem.cases = {{{{"force.cosine", 0.5}}}, {{{"force.cosine", 1}}}};
  const auto times = asked(s, settings);
  REQUIRE(times.contains("the curves of the cases"));
  long here = 0;
  const auto result = optimize::optimum_study(s, settings, polled([&](const std::string& phase) {
                                                return phase != "the curves of the cases" || ++here < 40;
                                              }));
  CHECK(result.status == observables::Status::stopped);
  CHECK(result.optimum.status == observables::Status::complete);
  CHECK(contains(result.stop.message, "interrupted in the curves of the cases; of the search: "));
}

TEST_CASE("a search that is interrupted far from its best design reports the best, as it was seen there") {
  const scene::Scene s = scenes::paper(7, 3);
  const optimize::OptimumProblem problem{{{"damper.normal_load", 0.1, 100}}, 18, 22};
  bool certifying = false;
  int asked = 0;
  optimize::OptimumOptions options;
  options.progress = [&](const optimize::OptimumProgress& now) {
    certifying = now.phase == std::string("the certificate");
  };
  options.control = controls::polled([&] { return !certifying || ++asked < 200; });
  const auto cut = optimize::optimum(s, problem, options);
  const auto whole = optimize::optimum(s, problem);
  CHECK(cut.status == observables::Status::stopped);
  CHECK(cut.design == whole.design);
  CHECK(cut.amplitude == whole.amplitude);
  REQUIRE(cut.cases.size() == 1);
  CHECK(cut.point.omega == Approx(whole.point.omega).epsilon(1e-12));
  CHECK(cut.point.amplitude == Approx(whole.amplitude).epsilon(1e-9));
}

TEST_CASE("a stop before the first design leaves no design, and the reason") {
  const auto found = optimize::optimum(scenes::paper(7, 3), {{{"damper.normal_load", 0.1, 100}}, 18, 22},
                                       {.control = controls::stopped()});
  CHECK(found.status == observables::Status::stopped);
  CHECK(found.stop.reason == optimize::reasons::user);
}

TEST_CASE("curves of peaks ask while they look for their beginnings, and are stopped there") {
  const scene::Scene s = scenes::paper(7, 3);
  int asked = 0;
  const auto branches = observables::resonance_peaks(s, {"damper.normal_load", 0.1, 100, 18, 22},
                                                     controls::polled([&] { return ++asked < 5; }));
  REQUIRE(branches.size() == 1);
  CHECK(asked == 5);
  CHECK(branches[0].status == observables::Status::stopped);
  CHECK(branches[0].stop.reason == optimize::reasons::user);
}

TEST_CASE("a curve of optima asks in the search for its first point, and along it") {
  const scene::Scene s = scenes::paper(3, 3);
  for (const bool along : {false, true}) {
    optimize::OptimumCurveOptions options;
    int points = 0, asked = 0;
    options.progress = [&](const optimize::OptimumPoint&) { ++points; };
    options.search.control = controls::polled([&] { return along ? points < 3 : ++asked < 20; });
    const auto curve = optimize::optimum_curve(s, {{{"damper.normal_load", 0.1, 100}}, 18, 22},
                                               {"force.cosine", 0.5, 2}, options);
    CAPTURE(along, curve.stop.message);
    CHECK(curve.status == observables::Status::stopped);
    CHECK(curve.stop.reason == optimize::reasons::user);
    CHECK(points == (along ? 3 : 0));
  }
}

TEST_CASE("what a callback throws while other starts are looked at ends the search with its text") {
  scene::Scene s = scenes::paper(5, 3);
  scene::set(s, "c.value", 3);
  optimize::OptimumProblem problem{{{"damper.normal_load", 0.1, 100}}, 15, 24};
  problem.limits.push_back({.observable = "energy_friction", .at_most = 1e-4});
  const auto whole = optimize::optimum(s, problem);
  for (std::size_t last = 1; last <= whole.evaluations.size(); last += test_size::sized(1u, 8u)) {
    optimize::OptimumOptions throws;
    throws.progress = [&](const optimize::OptimumProgress& now) {
      if (now.evaluations == static_cast<int>(last)) throw std::runtime_error("enough");
    };
    const auto found = optimize::optimum(s, problem, throws);
    CAPTURE(last, found.stop.message);
    CHECK(found.status == observables::Status::failed);
    CHECK(found.stop.message.find("enough") != std::string::npos);
    optimize::OptimumOptions stops{.control = control::Control(control::Sources())};
    stops.progress = [&](const optimize::OptimumProgress& now) {
      if (now.evaluations >= static_cast<int>(last)) stops.control.stop();
    };
    CHECK(optimize::optimum(s, problem, stops).stop.reason == optimize::reasons::user);
  }
}
