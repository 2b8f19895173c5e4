// Limits: what a search reports to be least is least among the designs that keep them.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "optimize/search/random_limits.hpp"

#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;

namespace {

// The highest peak of a frequency response of its own.
double highest_peak_of(scene::Scene s, const optimize::OptimumProblem& problem,
                       const std::vector<double>& design) {
  for (std::size_t k = 0; k < design.size(); ++k) scene::set(s, problem.over[k].name, design[k]);
  double most = 0;
  for (const auto& branch :
       observables::frequency_response(s, {problem.frequency_from, problem.frequency_to}))
    for (const auto& event : branch.events)
      if (event.kind == "peak") most = std::max(most, event.point.amplitude);
  return most;
}

// Four masses with three dampers. Without a limit the least amplitude is at 265 N.
scene::Scene beyond_the_limit() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["d0", "d1", "d2", "d3"],
    "masses": [{"name": "m0", "at": "d0", "value": 0.009080666466133484},
      {"name": "m1", "at": "d1", "value": 0.024606568779417852},
      {"name": "m2", "at": "d2", "value": 0.006481573158675282},
      {"name": "m3", "at": "d3", "value": 0.032738884191987346}],
    "springs": [{"name": "k0", "at": "d0", "value": 5825.333241475204},
      {"name": "k1", "between": ["d1", "d0"], "value": 4519.85429173067},
      {"name": "k2", "between": ["d2", "d1"], "value": 17595.645988177683},
      {"name": "k3", "between": ["d3", "d2"], "value": 18695.139452636467}],
    "dampers": [{"name": "c0", "at": "d0", "value": 0.011937098158187697},
      {"name": "c1", "between": ["d1", "d0"], "value": 0.006709983280877862},
      {"name": "c2", "between": ["d2", "d1"], "value": 0.040162989274122124},
      {"name": "c3", "between": ["d3", "d2"], "value": 0.021476583174727646}]},
    "elements": [{"name": "j0", "type": "jenkins", "direction": {"d3": 1.22, "d1": 0.162, "d0": -1.481},
        "stiffness": 10378.336279615089, "friction_coefficient": 0.37, "normal_load": 25.71877920887347},
      {"name": "j1", "type": "jenkins", "at": "d0", "stiffness": 2522.244430624866,
        "friction_coefficient": 0.36, "normal_load": 1.4762664206668485},
      {"name": "j2", "type": "jenkins", "at": "d1", "stiffness": 5702.977117658664,
        "friction_coefficient": 0.57, "normal_load": 6.525254555425639}],
    "excitation": [{"name": "f0", "at": "d0", "cosine": 7.851910291846936, "sine": -0.15942405601798834}],
    "harmonics": {"order": 5}, "response": {"at": "d1"}, "studies": []})");
}

// Two dampers, whose sum is limited.
scene::Scene two_loads() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["d0", "d1", "d2", "d3"],
    "masses": [{"name": "m0", "at": "d0", "value": 0.054675451761274335},
      {"name": "m1", "at": "d1", "value": 0.021864748560994896},
      {"name": "m2", "at": "d2", "value": 0.023009120510070452},
      {"name": "m3", "at": "d3", "value": 0.026876878639523073}],
    "springs": [{"name": "k0", "at": "d0", "value": 1830.0115908835144},
      {"name": "k1", "between": ["d1", "d0"], "value": 6891.621626238909},
      {"name": "k2", "between": ["d2", "d1"], "value": 4569.089541067508},
      {"name": "k3", "between": ["d3", "d2"], "value": 2388.5630288445095}],
    "dampers": [{"name": "c0", "at": "d0", "value": 0.0047529035437501805},
      {"name": "c1", "between": ["d1", "d0"], "value": 0.02725549656783224},
      {"name": "c2", "between": ["d2", "d1"], "value": 0.009196575019557366},
      {"name": "c3", "between": ["d3", "d2"], "value": 0.00861836612153333}]},
    "elements": [{"name": "j0", "type": "jenkins", "between": ["d1", "d2"], "stiffness": 1113.2887442728763,
        "friction_coefficient": 0.5, "normal_load": 3.359313204121562},
      {"name": "j1", "type": "jenkins", "direction": {"d0": -0.532, "d2": 0.76, "d3": -1.198, "d1": -1.002},
        "stiffness": 3117.5008594897818, "friction_coefficient": 0.59, "normal_load": 0.001}],
    "excitation": [{"name": "f0", "at": "d2", "cosine": 0.12510411458903353, "sine": 0.02363175289468158},
      {"name": "f1", "at": "d1", "harmonic": 3, "cosine": -0.03734013177613091, "sine": 0.014896434202919912},
      {"name": "f2", "at": "d1", "harmonic": 5, "cosine": -0.0037426990885463004,
        "sine": -0.009543547585975549}],
    "harmonics": {"order": 5}, "response": {"at": "d3"}, "studies": []})");
}

}  // namespace

TEST_CASE("a search that comes from beyond a limit ends on it, where no load within is better", "[numbers]") {
  const scene::Scene s = beyond_the_limit();
  const double weight = 3.8882094359089208, most = 10.631852594787354;
  const optimize::OptimumProblem problem{{{"j0.normal_load", 0.2571877920887347, 2571.877920887347}},
                                         145.1296141076351,
                                         2334.1892002942623,
                                         {},
                                         {{.weights = {{"j0.normal_load", weight}}, .at_most = most}}};
  const auto found = optimize::optimum(s, problem);
  CAPTURE(found.stop.message);
  REQUIRE(found.status == observables::Status::complete);
  // The amplitude falls up to the limit: on its whole way it is higher.
  const double load = most / weight;
  // What complementarity leaves: the limit's multiplier, 0.44, times the distance from it.
  CHECK(found.design[0] == Approx(load).epsilon(optimize::most_complementarity / 0.44));
  CHECK(found.amplitude ==
        Approx(highest_peak_of(s, problem, {load})).epsilon(optimize::most_complementarity));
  for (int i = 0; i < 10; ++i) {
    const double below = 0.2572 * std::pow(load / 0.2572, i / 10.0);
    CAPTURE(below);
    CHECK(highest_peak_of(s, problem, {below}) > found.amplitude);
  }
  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity <= optimize::most_stationarity);
  CHECK(found.certificate->complementarity <= optimize::most_complementarity);
  // Where the sum is loosened by a share, the load grows by it.
  REQUIRE(found.certificate->limits.size() == 1);
  const double share = 1e-4;
  const double slope = std::log(highest_peak_of(s, problem, {load * (1 - share)}) /
                                highest_peak_of(s, problem, {load * (1 + share)})) /
                       (2 * share);
  CHECK(found.certificate->limits[0].multiplier == Approx(slope).epsilon(1e-4));
  for (const auto& range : found.certificate->ranges[0]) {
    CHECK(range.upper == Approx(load).epsilon(2e-8));
    CHECK(range.upper_is_limit);
    CHECK_FALSE(range.upper_is_bound);
    CHECK_FALSE(range.lower_is_limit);
    CHECK(highest_peak_of(s, problem, {range.lower}) ==
          Approx((1 + range.share) * found.amplitude).epsilon(1e-6));
  }
}

TEST_CASE("a limit on the frequency holds at the peak, not at an end of the window below it") {
  const scene::Scene s = scenes::paper(5);
  optimize::OptimumProblem problem{{{"damper.normal_load", 0.5, 500}}, 18, 22};
  const auto free = optimize::optimum(s, problem, {.certificate = false});
  REQUIRE(free.status == observables::Status::complete);
  const double frequency = free.point.omega / scenes::hertz;
  for (const double share : {0.999, 1.001}) {  // the end of the window is nearly as high as the peak
    optimize::OptimumProblem limited = problem;
    optimize::ObservableLimit limit{.observable = "frequency"};
    if (share < 1) {
      limited.frequency_from = share * share * frequency;
      limit.at_least = share * frequency;
    } else {
      limited.frequency_to = share * share * frequency;
      limit.at_most = share * frequency;
    }
    limited.limits.push_back(limit);
    const auto found = optimize::optimum(s, limited, {.certificate = false});
    CAPTURE(share, found.stop.message);
    REQUIRE(found.status == observables::Status::complete);
    CHECK(found.amplitude == Approx(free.amplitude).epsilon(1e-9));
  }
}

TEST_CASE("a peak that comes up during a search, at which a limit is exceeded, is within no limit") {
  const auto search = random_limits::make(35);
  const auto found = optimize::optimum(search.scene, search.problem,
                                       {.algorithm = "LD_MMA", .certificate = false, .starts = 1});
  CAPTURE(found.stop.message);
  REQUIRE(found.feasible);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
}

TEST_CASE("a search with limits goes on from the lowest design over the bounds, and does not end there") {
  const auto search = random_limits::make(75);  // sticks where it begins; the limit leaves loads below 0.03 N
  const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
  CAPTURE(found.stop.message);
  REQUIRE(found.status == observables::Status::complete);
  CHECK(std::abs(random_limits::excess(search, found.design)) <= 1e-6);
  CHECK(found.amplitude < random_limits::grid(search, 75, 40).amplitude);
}

TEST_CASE("a damper that sticks is let slip no farther than a limit on the energy allows", "[numbers]") {
  for (const std::uint64_t seed : {131, 302}) {  // stuck no energy is lost; half way to it, too much
    const auto search = random_limits::make(seed);
    const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
    CAPTURE(seed, found.stop.message);
    REQUIRE(found.status == observables::Status::complete);
    CHECK(std::abs(random_limits::excess(search, found.design)) <= 2e-6);
    CHECK(found.amplitude <= random_limits::from_grid(search, seed, 40).amplitude * (1 + 1e-6));
  }
}

TEST_CASE("with limits the best design may be next to the upper bounds, where nothing slips") {
  const auto search = random_limits::make(433);
  const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
  CAPTURE(found.stop.message);
  REQUIRE(found.feasible);
  CHECK(found.amplitude < 4.4e-6);  // 9.16e-5 within the bounds
}

TEST_CASE("where no sample keeps the limits, another algorithm may come to a design that does") {
  const auto search = random_limits::make(182);
  const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
  CAPTURE(found.stop.message);
  REQUIRE(found.status == observables::Status::complete);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
}

TEST_CASE("where an algorithm asks for a design that is no number, the search goes on with others") {
  const auto search = random_limits::make(366);  // SLSQP does: a limit is exceeded where nothing moves it
  const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
  CHECK(found.stop.reason == optimize::reasons::infeasible);
  CHECK(found.evaluations.size() > 50);
  for (const optimize::Evaluation& each : found.evaluations) CHECK(std::isfinite(each.design[0]));
}

TEST_CASE("an algorithm that gains nothing over many designs is ended, and others go on", "[numbers]") {
  const auto search = random_limits::make(257);  // SLSQP crawls along outside the limits
  const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false, .starts = 1});
  CAPTURE(found.stop.message);
  CHECK(found.stop.reason != optimize::reasons::evaluation_limit);
  CHECK(found.evaluations.size() < 1000);
  REQUIRE(found.feasible);
  CHECK(found.amplitude < 1.7e-4);
}

TEST_CASE("two loads with a limit on their sum: no pair on the limit is better, however loose it is",
          "[numbers]") {
  const scene::Scene s = two_loads();
  const double a = 29.767989444184423, b = 99999.99999999999;
  for (const double most : {2000.0, 8000.0}) {
    const optimize::OptimumProblem problem{
        {{"j0.normal_load", 0.03359313204121562, 335.9313204121562}, {"j1.normal_load", 1e-5, 0.1}},
        61.635003206579064,
        318.3633434309565,
        {},
        {{.weights = {{"j0.normal_load", a}, {"j1.normal_load", b}}, .at_most = most}}};
    const auto found = optimize::optimum(s, problem);
    CAPTURE(most, found.stop.message);
    REQUIRE(found.status == observables::Status::complete);
    CHECK(found.feasible);
    double least = HUGE_VAL;
    for (int i = 0; i < 20; ++i) {
      const double first = 0.05 * std::pow(most / a / 0.06, i / 19.0);
      least = std::min(least, highest_peak_of(s, problem, {first, (most - a * first) / b}));
    }
    CHECK(found.amplitude <= least * (1 + 1e-8));
    for (std::size_t k = 0; k < 2; ++k)
      for (const auto& range : found.certificate->ranges[k]) {
        auto end = found.design;
        end[k] = range.upper;
        CHECK(a * end[0] + b * end[1] <= most * (1 + 2e-8));
      }
  }
}

TEST_CASE("equivalent stiffness can be limited from both sides, and the optimum comes to the limit") {
  const scene::Scene s = scenes::paper(7, 3);
  optimize::OptimumProblem problem{{{"damper.normal_load", 0.1, 100}}, 18, 22};
  const auto free = optimize::optimum(s, problem);
  REQUIRE(free.status == observables::Status::complete);
  const double stiffness = free.point.elements[0].equivalent_stiffness;
  for (const double factor : {0.8, 1.25}) {
    problem.limits = {{"damper.equivalent_stiffness"}};
    (factor < 1 ? problem.limits[0].at_most : problem.limits[0].at_least) = factor * stiffness;
    const auto found = optimize::optimum(s, problem);
    CAPTURE(factor, found.stop.message);
    CHECK(found.status == observables::Status::complete);
    CHECK(found.feasible);
    CHECK(found.amplitude > free.amplitude);
    CHECK(std::abs(found.point.elements[0].equivalent_stiffness / (factor * stiffness) - 1) < 1e-6);
  }
}

TEST_CASE("the mean force that a contact may hold can be limited, against the closed form of one mass") {
  // Stuck at its peak, X = f/(c w_n sqrt(1 - z^2)), the damper may hold a mean force of up to p - k_d X. A
  // stiffer one has a lower peak, but may hold less.
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "x", "stiffness": 1, "friction_coefficient": 0.5,
                  "normal_load": 100}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "harmonics": {"order": 3},
    "studies": [{"kind": "frf", "from": 0.5, "to": 4}]})");
  const double c = 0.1, p = 50;
  const auto amplitude = [&](double k_d) {
    const double w = std::sqrt(1 + k_d), z = c / (2 * w);
    return 1 / (c * w * std::sqrt(1 - z * z));
  };
  for (const bool even : {false, true}) {
    if (even)
      s.excitation.push_back(s.excitation[0]), s.excitation.back().name = "g",
                                               s.excitation.back().harmonic = 2;
    if (even) scene::set(s, "g.cosine", 0);
    for (const double least : {45.0, 40.0}) {
      CAPTURE(even, least);
      double low = 0, high = 10;  // where p - k_d X = least
      for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (p - middle * amplitude(middle) > least ? low : high) = middle;
      }
      optimize::OptimumProblem problem{{{"d.stiffness", 0.1, 8}}, 0.5, 4};
      problem.limits = {{.observable = "d.mean_force_max", .at_least = least}};
      const auto found = optimize::optimum(s, problem);
      CAPTURE(found.stop.message);
      REQUIRE(found.status == observables::Status::complete);
      CHECK(std::abs(found.design[0] / low - 1) < 1e-6);
      CHECK(std::abs(found.amplitude / amplitude(low) - 1) < 1e-6);
      problem.limits = {{.observable = "d.mean_force_min", .at_most = -least}};
      const auto other = optimize::optimum(s, problem);
      CHECK(std::abs(other.design[0] / low - 1) < 1e-6);
    }
  }
}

TEST_CASE("of an element that does not tell its mean force none can be limited") {
  auto s = scenes::paper(3, 3);
  s.harmonics.friction = scene::Friction::sampled;
  optimize::OptimumProblem problem{{{"damper.normal_load", 0.1, 100}}, 18, 22};
  problem.limits = {{.observable = "damper.mean_force_max", .at_least = 1}};
  CHECK_THROWS_AS(optimize::optimum(s, problem), optimize::OptionsError);
}

TEST_CASE("where a search cannot keep a limit from its start, designs elsewhere are looked at") {
  scene::Scene s = scenes::paper(15, 3);
  scene::set(s, "c.value", 3);
  optimize::OptimumProblem problem{{{"damper.normal_load", 0.1, 100}}, 15, 24};
  problem.limits.push_back({.observable = "energy_friction", .at_most = 1e-4});  // stuck, or nearly free
  const auto found = optimize::optimum(s, problem);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.feasible);
  CHECK(found.point.energy_friction <= 1e-4 * (1 + 1e-6));
  CHECK(found.amplitude == Approx(highest_peak_of(s, problem, found.design)).epsilon(1e-8));
}
