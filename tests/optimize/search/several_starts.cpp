// Local searches from several designs, where there are several parameters.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "optimize/row.hpp"

#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/optimize/study/optimum_results.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/optimize/study/optimum_text.hpp>

#include <arcslip/results/json_writer.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

using namespace arcslip;
using optimize::Optimum;
using optimize::OptimumProblem;

namespace {

// Three masses with four friction dampers.
scene::Scene three_masses() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["d0", "d1", "d2"],
      "masses": [{"name": "m0", "at": "d0", "value": 0.8618901078542716},
                 {"name": "m1", "at": "d1", "value": 0.7415790626419932},
                 {"name": "m2", "at": "d2", "value": 0.31643399826282803}],
      "springs": [{"name": "k0", "between": ["d0", "ground"], "value": 17542.697444042522},
                  {"name": "k1", "between": ["d1", "d0"], "value": 47426.85195207146},
                  {"name": "k2", "between": ["d2", "d1"], "value": 8171.962494880198},
                  {"name": "kg1", "at": "d1", "value": 3471.8242186960792},
                  {"name": "kg2", "at": "d2", "value": 6042.384778802185}],
      "dampers": [{"name": "c0", "between": ["d0", "ground"], "value": 9.665661805811723},
                  {"name": "c1", "between": ["d1", "d0"], "value": 37.12916675341299},
                  {"name": "c2", "between": ["d2", "d1"], "value": 3.5723899160780452}]},
    "elements": [
      {"type": "jenkins", "name": "e0", "direction": {"d1": -0.694, "d2": -0.778},
       "stiffness": 3783.7811658519627, "friction_coefficient": 0.24, "normal_load": 0.0034132765940722274},
      {"type": "jenkins", "name": "e1", "at": "d2", "stiffness": 13096.46372711818,
       "friction_coefficient": 0.16, "normal_load": 0.0019605256234560306},
      {"type": "jenkins", "name": "e2", "direction": {"d0": 1.287, "d1": 0.213},
       "stiffness": 13465.178765465002, "friction_coefficient": 0.84, "normal_load": 0.0017199553337524415},
      {"type": "jenkins", "name": "e3", "at": "d1", "stiffness": 2835.4200144215015,
       "friction_coefficient": 0.85, "normal_load": 0.00046995343661394894},
      {"name": "q", "type": "cubic_spring", "at": "d0", "stiffness": 1614516844061669.0}],
    "excitation": [{"name": "f0", "at": "d1", "harmonic": 1, "cosine": 0.01578939990049097}],
    "harmonics": {"order": 3}, "response": {"at": "d1"},
    "studies": [{"kind": "frf", "from": 73.6, "to": 195.8}]})");
}

const OptimumProblem three_loads{
    {{"e0.normal_load", 3.4132765940722276e-05, 0.34132765940722276},
     {"e1.normal_load", 1.9605256234560306e-05, 0.19605256234560306},
     {"e2.normal_load", 1.7199553337524417e-05, 0.17199553337524415}},
    73.60964343633495,
    195.76661058532088,
    {},
    {},
    {{{{"f0.cosine", 0.01578939990049097}}, 1}, {{{"f0.cosine", 0.06197809500168649}}, 0.30274710440615976}},
    optimize::Criterion::mean};

// The weighted mean of the highest amplitudes in frequency responses of their own.
double mean_of_peaks(const OptimumProblem& problem, const std::vector<double>& design) {
  double sum = 0, weights = 0;
  for (const auto& load_case : problem.cases) {
    scene::Scene s = three_masses();
    for (std::size_t k = 0; k < design.size(); ++k) scene::set(s, problem.over[k].name, design[k]);
    for (const auto& [name, value] : load_case.set) scene::set(s, name, value);
    double most = 0;
    for (const auto& branch :
         observables::frequency_response(s, {problem.frequency_from, problem.frequency_to}))
      for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
    sum += load_case.weight * most;
    weights += load_case.weight;
  }
  return sum / weights;
}

}  // namespace

TEST_CASE("three loads under two forces: of several starts one leads below the minimum next to the scene's",
          "[numbers]") {
  const scene::Scene s = three_masses();
  const Optimum own = optimize::optimum(s, three_loads, {.certificate = false, .starts = 1});
  CHECK(own.amplitude == Approx(2.95264e-6).epsilon(1e-5));
  CHECK_FALSE(own.starts);
  const Optimum found = optimize::optimum(s, three_loads, {.certificate = false});
  CAPTURE(found.stop.message, found.design);
  CHECK(found.status == observables::Status::complete);
  // A design that another search came to.
  const double known = mean_of_peaks(
      three_loads,
      {1505 * 3.4132765940722276e-05, 4276 * 1.9605256234560306e-05, 1122 * 1.7199553337524417e-05});
  CHECK(known < 0.989 * own.amplitude);
  CHECK(found.amplitude <= known * (1 + 1e-6));
  CHECK(mean_of_peaks(three_loads, found.design) == Approx(found.amplitude).epsilon(1e-7));
  REQUIRE(found.starts);
  CHECK(found.starts->count == optimize::default_starts);
  CHECK(found.starts->to_optimum >= 1);
  CHECK(found.starts->to_optimum < found.starts->count);
  CHECK(found.starts->highest >= own.amplitude * (1 - 1e-6));
}

TEST_CASE("several starts lead to the same bits with one thread and with three") {
  const scene::Scene s = three_masses();
  const Optimum one = optimize::optimum(s, three_loads, {.certificate = false});
  const Optimum three = optimize::optimum(s, three_loads, {.threads = 3, .certificate = false});
  CHECK(one.design == three.design);
  CHECK(one.amplitude == three.amplitude);
  CHECK(one.evaluations.size() == three.evaluations.size());
  CHECK(one.work.factorizations == three.work.factorizations);
  REQUIRE(one.starts);
  REQUIRE(three.starts);
  CHECK(one.starts->to_optimum == three.starts->to_optimum);
  CHECK(one.starts->highest == three.starts->highest);
}

TEST_CASE("two dampers on two masses: all starts lead to the one minimum, and soon end next to it") {
  const scene::Scene s = row(2, 2, 5);
  const auto problem = over_loads(2, 8, 45);
  const Optimum own = optimize::optimum(s, problem, {.certificate = false, .starts = 1});
  const Optimum found = optimize::optimum(s, problem, {.certificate = false});
  REQUIRE(found.starts);
  CHECK(found.starts->count > 1);
  CHECK(found.starts->to_optimum == found.starts->count);
  CHECK(found.starts->to_none == 0);
  CHECK(found.starts->highest <= found.amplitude * (1 + optimize::same_minimum));
  CHECK(found.amplitude == Approx(own.amplitude).epsilon(1e-9));
  CHECK(found.evaluations.size() < 250);  // 174; 391 if none of them ended next to it
}

TEST_CASE("over one parameter there is one start, and with a time limit the account is of those that ended") {
  CHECK_FALSE(optimize::optimum(scenes::paper(7), {{{"damper.normal_load", 0.1, 100}}, 18, 22}).starts);
  int calls = 0;
  const control::Control control{control::Sources()};
  const Optimum stopped =
      optimize::optimum(row(2, 2, 5), over_loads(2, 8, 45),
                        {.certificate = false,
                         .progress =
                             [&](const optimize::OptimumProgress& now) {
                               if (std::string(now.phase) == "the search elsewhere" && ++calls == 60)
                                 control.stop();
                             },
                         .control = control});
  CHECK(stopped.status == observables::Status::stopped);
  CHECK(std::isfinite(stopped.amplitude));
  if (stopped.starts) CHECK(stopped.starts->count < optimize::default_starts);
}

TEST_CASE("results tell how many starts led to the optimum, and how high the other minima are") {
  optimize::OptimumResult result;
  result.problem = three_loads;
  result.optimum.design = {1, 2, 3};
  result.optimum.amplitude = 2e-3;
  result.optimum.feasible = true;
  result.optimum.starts = optimize::Starts{.count = 9, .to_optimum = 6, .to_none = 1, .highest = 2.5e-3};
  const scene::Scene s = three_masses();
  const auto text = [&] { return optimize::text_of(s, result); };
  CHECK(text().find("  6 of 9 starts led to it, within 1e-06 of the amplitude, the others to minima of up to "
                    "2.500000 mm; 1 ended at no minimum\n") != std::string::npos);
  std::ostringstream json;
  results::write_json(json, studies::collected<optimize::OptimumResult>(
                                s, optimize::described_optima(s, result.problem), {&result, 1}));
  CHECK(nlohmann::json::parse(json.str())["optima"][0]["starts"] ==
        nlohmann::json{{"count", 9}, {"to_optimum", 6}, {"to_none", 1}, {"highest", 2.5e-3}});
  result.optimum.starts = optimize::Starts{.count = 9, .to_optimum = 9, .to_none = 0, .highest = 2e-3};
  CHECK(text().find("  9 of 9 starts led to it, within 1e-06 of the amplitude\n") != std::string::npos);
}
