// The worst case of uncertain parameters between bounds.

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"
#include "optimize/paper_optimum.hpp"
#include "optimize/row.hpp"

#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace arcslip;
using optimize::Optimum;
using optimize::OptimumProblem;
using paper_optimum::closed_form;
using paper_optimum::over_load;
using paper_optimum::peak;
using std::numbers::pi;

namespace {

// Where the peaks of two friction coefficients are equally high: a^2/(a F - q) = b^2/(b F - q).
double equal(double a, double b, double q) {
  return q * (a + b) / (a * b);
}

OptimumProblem with(const std::vector<optimize::DesignVariable>& scatter) {
  OptimumProblem problem = over_load;
  problem.scatter = scatter;
  return problem;
}

// A blade of 1 kg and 20 kN/m with a friction damper, and a small mass on it whose spring scatters around
// what is in tune with the blade, where its amplitude is largest.
scene::Scene tuned() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz", "structure": {
    "dofs": ["blade", "small"],
    "masses": [{"name": "m", "at": "blade", "value": 1}, {"name": "ms", "at": "small", "value": 0.05}],
    "springs": [{"name": "k", "at": "blade", "value": 20000},
                {"name": "ks", "between": ["small", "blade"], "value": 1000}],
    "dampers": [{"name": "c", "at": "blade", "value": 5},
                {"name": "cs", "between": ["small", "blade"], "value": 0.5}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "blade", "stiffness": 4000,
                  "friction_coefficient": 0.5, "normal_load": 3}],
    "excitation": [{"name": "f", "at": "blade", "cosine": 1}], "harmonics": {"order": 3},
    "response": {"at": "small"}, "studies": [{"kind": "frf", "from": 14, "to": 34}]})");
}

double highest_of_small(double load, double stiffness) {
  scene::Scene s = tuned();
  scene::set(s, "d.normal_load", load);
  scene::set(s, "ks.value", stiffness);
  double most = 0;
  for (const auto& branch : observables::frequency_response(s, scenes::window(s)))
    for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
  return most;
}

double highest_in_box(double load) {
  double most = 0;
  for (int k = 0; k <= 70; ++k) most = std::max(most, highest_of_small(load, 700 + 10 * k));
  return most;
}

}  // namespace

TEST_CASE("a friction coefficient anywhere between 0.4 and 0.6: both ends are active, and none between") {
  const Optimum found = optimize::optimum(closed_form(), with({{"damper.friction_coefficient", 0.4, 0.6}}));
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  const double load = equal(0.4, 0.6, pi / 4);
  CHECK(reference::error(found.design[0], load) < 1e-8);
  CHECK(reference::error(found.amplitude, peak(0.4 * load, pi / 4)) < 1e-8);
  CHECK(found.scatter_rounds == 1);
  REQUIRE(found.cases.size() == 2);
  CHECK(found.cases[0].scatter ==
        std::vector<std::pair<std::string, double>>{{"damper.friction_coefficient", 0.4}});
  CHECK(found.cases[1].scatter[0].second == 0.6);
  CHECK(found.cases[0].active);
  CHECK(found.cases[1].active);
  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity < 1e-6);
}

TEST_CASE("scatter at each of two levels: the higher one decides") {
  auto problem = with({{"damper.friction_coefficient", 0.4, 0.6}});
  problem.cases = {{{{"force.cosine", 0.5}}, 1}, {{{"force.cosine", 1}}, 1}};
  const Optimum found = optimize::optimum(closed_form(), problem, {.certificate = false});
  CHECK(reference::error(found.design[0], equal(0.4, 0.6, pi / 4)) < 1e-8);
  REQUIRE(found.cases.size() == 4);
  for (const auto& each : found.cases) CHECK(each.active == (each.of == 1));
}

TEST_CASE("a corner that is not looked at first is found: four parameters that scatter") {
  const auto problem = with({{"force.cosine", 0.9, 1.1},
                             {"damper.friction_coefficient", 0.4, 0.6},
                             {"damper.stiffness", 3000, 4000},
                             {"m.value", 1.23, 1.25}});
  const Optimum found = optimize::optimum(closed_form(), problem);
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  const double q = 1.1 * pi / 4, load = equal(0.4, 0.6, q);
  CHECK(reference::error(found.design[0], load) < 1e-7);
  CHECK(reference::error(found.amplitude, peak(0.4 * load, q, 3000)) < 1e-8);
  CHECK(found.cases.size() > 9);
  CHECK(found.scatter_rounds > 1);
  CHECK_FALSE(found.cases[0].active);

  const Optimum one = optimize::optimum(closed_form(), problem, {.scatter_rounds = 1});
  CHECK(one.status == observables::Status::stopped);
  CHECK(one.stop.reason == optimize::reasons::scatter_limit);
  CHECK(one.stop.message.find("the worst case of the uncertain parameters still increased after 1 rounds") ==
        0);
  CHECK_FALSE(one.certificate);
  // Its amplitude is the worst at its own design all the same.
  const double p = one.design[0];
  CHECK(reference::error(one.amplitude, std::max(peak(0.4 * p, q, 3000), peak(0.6 * p, q, 3000))) < 1e-8);
}

TEST_CASE("a corner to which no local search leads, with another resonance the highest, is found") {
  scene::Scene s = row(3, 2, 3);
  s.response() = {{0, 1}};
  OptimumProblem problem = over_loads(2, 5, 45);
  problem.scatter = {{"m1.value", 0.94, 1.06},
                     {"d1.stiffness", 3600, 4400},
                     {"k0.value", 17400, 22600},
                     {"m0.value", 0.83, 1.17}};
  const Optimum found = optimize::optimum(s, problem, {.certificate = false});
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  double most = 0;
  for (unsigned corner = 0; corner < 16; ++corner) {
    scene::Scene at = s;
    for (std::size_t k = 0; k < 4; ++k)
      scene::set(at, problem.scatter[k].name,
                 (corner >> k & 1) != 0 ? problem.scatter[k].upper : problem.scatter[k].lower);
    most = std::max(most, highest_peak(at, found.design, 5, 45));
  }
  CHECK(most <= found.amplitude * (1 + 1e-7));
}

TEST_CASE("the worst within a box, not at its ends, is found, as a grid of frequency responses says") {
  OptimumProblem problem{{{"d.normal_load", 0.3, 50}}, 14, 34};
  problem.scatter = {{"ks.value", 700, 1400}};
  const Optimum found = optimize::optimum(tuned(), problem);
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  double worst = 0;
  for (const auto& each : found.cases)
    if (each.active) worst = each.scatter[0].second;
  CHECK(worst > 705);
  CHECK(worst < 1395);
  // No point of the grid is higher, and one is nearly as high: A falls by (dk/k)^2 next to the worst.
  const double grid = highest_in_box(found.design[0]);
  CHECK(grid <= found.amplitude * (1 + 1e-8));
  CHECK(grid >= found.amplitude * (1 - 1e-3));
  for (const double factor : {0.9, 1.1}) CHECK(highest_in_box(factor * found.design[0]) > grid);
}

TEST_CASE("a start at which a corner of the scatter is unbounded is moved") {
  // mu Fn = 0.3 at the lowest coefficient is below pi/4.
  const Optimum found = optimize::optimum(closed_form(3), with({{"damper.friction_coefficient", 0.1, 0.6}}));
  CHECK(found.status == observables::Status::complete);
  CHECK(reference::error(found.design[0], equal(0.1, 0.6, pi / 4)) < 1e-7);
  REQUIRE(found.notes.size() == 1);
  CHECK(found.notes[0].find("with damper.friction_coefficient = 0.1: the resonance is unbounded") !=
        std::string::npos);
}

TEST_CASE("the user and what is thrown end the search for the worst, too") {
  OptimumProblem problem{{{"d.normal_load", 0.3, 50}}, 14, 34};
  problem.scatter = {{"ks.value", 700, 1400}};
  int calls = 0;
  optimize::OptimumOptions options{.certificate = false};
  options.progress = [&](const optimize::OptimumProgress&) { ++calls; };
  const Optimum whole = optimize::optimum(tuned(), problem, options);
  REQUIRE(whole.scatter_rounds > 1);
  const int all = calls;
  for (const bool throws : {false, true}) {
    options.control = control::Control(control::Sources());
    calls = 0;  // the last calls are those of the last search for the worst
    options.progress = [&](const optimize::OptimumProgress&) {
      if (++calls < all) return;
      if (throws) throw std::runtime_error("disk full");
      options.control.stop();
    };
    const Optimum found = optimize::optimum(tuned(), problem, options);
    CHECK(found.stop.reason == (throws ? optimize::reasons::objective_failed : optimize::reasons::user));
    CHECK(found.status == (throws ? observables::Status::failed : observables::Status::stopped));
    CHECK(found.design == whole.design);
    if (throws) CHECK(found.stop.message.find("disk full") != std::string::npos);
  }
}

TEST_CASE("invalid scatter is rejected") {
  const auto error_of = [](const OptimumProblem& problem) {
    try {
      optimize::optimum(closed_form(), problem);
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(error_of(with({{"damper.normal_load", 1, 2}})) ==
        "\"damper.normal_load\" is both a design parameter and in the scatter");
  CHECK(error_of(with({{"k.value", 2, 1}})) ==
        "bounds of \"k.value\" are [2, 1]: the lower must be below the upper");
  CHECK(error_of(with({{"k.valeu", 1, 2}})).find("k.value") != std::string::npos);
  auto mean = with({{"k.value", 1, 2}});
  mean.criterion = optimize::Criterion::mean;
  CHECK(error_of(mean) == "scatter requires the criterion worst");
  auto both = with({{"k.value", 1, 2}});
  both.cases = {{{{"k.value", 1}}}};
  CHECK(error_of(both) == "a case sets \"k.value\", which is in the scatter");
  CHECK_THROWS_AS(optimize::direct_optimum(closed_form(), with({{"k.value", 1, 2}})), optimize::OptionsError);
}

TEST_CASE("an excitation that may be missing altogether counts with its largest value") {
  const Optimum found = optimize::optimum(closed_form(), with({{"force.cosine", 0, 1}}));
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.design[0] == Approx(pi).epsilon(1e-6));  // p = 2 q
  CHECK(found.amplitude == Approx(peak(pi / 2, pi / 4)).epsilon(1e-9));
}
