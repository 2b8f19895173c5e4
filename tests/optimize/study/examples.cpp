// The studies of the example scenes.

#include "catch.hpp"
#include "environment.hpp"

#include "lib/hbm/scenes.hpp"
#include "optimize/optima.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

using namespace arcslip;
using optimize::OptimumProblem;
using optimize::OptimumSettings;

namespace {

scene::Scene example(const std::string& file) {
  return scene::read_file(source_folder() + "/examples/" + file, test_catalogue::whole());
}

const OptimumSettings& settings(const scene::Scene& s, std::size_t study) {
  return s.studies.at(study).settings.as<OptimumSettings>();
}

// At the scene's own values, and at half and twice these: every watched peak against responses next to it.
int check_gradients(const scene::Scene& s, const OptimumProblem& problem) {
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const double unit = scene::to_rad_per_s(s.frequency_unit);
  std::vector<int> over;
  std::vector<double> own;
  for (const auto& variable : problem.over) {
    over.push_back(model::parameter_index(*model, variable.name));
    own.push_back(scene::value(s, variable.name));
  }
  int checked = 0;
  for (const double factor : {0.5, 1.0, 2.0}) {
    std::vector<double> design = own;
    for (double& value : design) value *= factor;
    optimize::PeakAmplitude peaks(model, over, {problem.frequency_from * unit, problem.frequency_to * unit});
    const auto here = peaks.trace(design);
    for (std::size_t k = 0; k < design.size(); ++k) {
      const double h = 1e-6 * design[k];
      auto above = design, below = design;
      above[k] += h;
      below[k] -= h;
      const auto more = peaks.trace(above), less = peaks.trace(below);
      CAPTURE(factor, problem.over[k].name);
      REQUIRE(more.peaks.size() == here.peaks.size());
      REQUIRE(less.peaks.size() == here.peaks.size());
      for (std::size_t i = 0; i < here.peaks.size(); ++i) {
        const double difference = (more.peaks[i].amplitude - less.peaks[i].amplitude) / (2 * h);
        CHECK(std::abs(here.peaks[i].gradient[static_cast<Eigen::Index>(k)] - difference) * design[k] <
              1e-6 * here.peaks[i].amplitude);
        ++checked;
      }
    }
  }
  return checked;
}

// The highest peak, or end of the window, in a frequency response of its own.
double highest(scene::Scene at, const OptimumProblem& problem, const std::vector<double>& design) {
  for (std::size_t k = 0; k < design.size(); ++k) scene::set(at, problem.over[k].name, design[k]);
  double most = 0;
  for (const auto& branch :
       observables::frequency_response(at, {problem.frequency_from, problem.frequency_to})) {
    for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
    for (const auto& point : branch.points) most = std::max(most, point.amplitude);
  }
  return most;
}

}  // namespace

TEST_CASE("the examples' optima are certified: gradients cancel, no other response is higher") {
  for (const char* file : {"two_dampers/scene.json", "blade_row/scene.json", "blade_row/mistuned.json"}) {
    const scene::Scene s = example(file);
    for (const scene::Study& study : s.studies) {
      CAPTURE(file, study.name);
      CHECK(study.for_each.empty());
      const auto& settings = study.settings.as<OptimumSettings>();
      const auto found = optimize::optimum_study(s, settings).optimum;
      CAPTURE(found.stop.message);
      CHECK(found.status == observables::Status::complete);
      CHECK(found.feasible);
      REQUIRE(found.certificate);
      CHECK(found.certificate->others_lower);
      if (settings.problem.limits.empty()) CHECK(found.certificate->stationarity < 1e-5);
    }
  }
}

TEST_CASE("less wear costs amplitude: the limit on the energy is met and active") {
  const scene::Scene s = example("two_dampers/scene.json");
  REQUIRE(s.studies.size() == 3);
  const auto free = optimize::optimum_study(s, settings(s, 0)).optimum;
  const auto limited = optimize::optimum_study(s, settings(s, 1)).optimum;
  // At both of the peaks that are equally high, in frequency responses of their own.
  const auto energy = [&](const std::vector<double>& loads) {
    scene::Scene at = s;
    for (std::size_t k = 0; k < loads.size(); ++k)
      scene::set(at, settings(s, 0).problem.over[k].name, loads[k]);
    double highest = 0, most = 0;
    const auto branches = observables::frequency_response(at, {8, 45});
    for (const auto& event : branches.front().events) highest = std::max(highest, event.point.amplitude);
    for (const auto& event : branches.front().events)
      if (event.kind == "peak" && event.point.amplitude > 0.99 * highest)
        most = std::max(most, event.point.energy_friction);
    return most;
  };
  REQUIRE(energy(free.design) > 1e-3);
  CHECK(energy(limited.design) <= 1e-3 * (1 + 1e-6));
  CHECK(limited.amplitude > free.amplitude);
  // The other peak exceeds it, and is as high as a peak may be at which it does not hold.
  REQUIRE(limited.certificate);
  CHECK(limited.certificate->stationarity < 1e-4);
  REQUIRE(limited.certificate->limits.size() == 1);
  CHECK(limited.certificate->limits[0].by_height);
  for (const auto& peak : limited.certificate->peaks)
    CHECK((peak.active || peak.amplitude == Approx(0.75 * limited.amplitude).epsilon(1e-6)));
}

TEST_CASE("the sum of the loads is as large as its limit allows, and no other pair on the limit is better") {
  const scene::Scene s = example("two_dampers/scene.json");
  const OptimumProblem& problem = settings(s, 2).problem;
  REQUIRE(problem.linear_limits.size() == 1);
  const auto limited = optimize::optimum_study(s, settings(s, 2)).optimum;
  REQUIRE(limited.design.size() == 2);
  CHECK(limited.feasible);
  CHECK(limited.design[0] + limited.design[1] == Approx(2).epsilon(1e-7));
  // in responses of their own: at the optimum, along the limit next to it, and with less load
  CHECK(highest(s, problem, limited.design) == Approx(limited.amplitude).epsilon(1e-9));
  for (const double step : {-0.05, -0.01, 0.01, 0.05})
    CHECK(highest(s, problem, {limited.design[0] + step, limited.design[1] - step}) > limited.amplitude);
  for (const auto& less : {std::vector{-0.01, 0.0}, std::vector{0.0, -0.01}})
    CHECK(highest(s, problem, {limited.design[0] + less[0], limited.design[1] + less[1]}) >
          limited.amplitude);
}

TEST_CASE(
    "the amplitude of any blade is least: tuned, that of every blade, and mistuned, that of the third") {
  for (const bool tuned : {true, false}) {
    const scene::Scene s = example(tuned ? "blade_row/scene.json" : "blade_row/mistuned.json");
    const OptimumProblem& problem = settings(s, 1).problem;
    REQUIRE(problem.cases.size() == 3);
    const auto found = optimize::optimum_study(s, settings(s, 1)).optimum;
    REQUIRE(found.cases.size() == 3);
    CAPTURE(tuned, found.stop.message);
    const auto any = [&](const std::vector<double>& loads) {
      double most = 0;
      for (int blade = 0; blade < 3; ++blade) {
        scene::Scene at = s;
        at.response() = {{blade, 1.0}};
        most = std::max(most, highest(at, problem, loads));
      }
      return most;
    };
    CHECK(any(found.design) == Approx(found.amplitude).epsilon(1e-9));
    for (std::size_t k = 0; k < 2; ++k)
      for (const double factor : {0.97, 1.03}) {
        std::vector<double> nearby = found.design;
        nearby[k] *= factor;
        CHECK(any(nearby) > found.amplitude);
      }
    const auto first = optimize::optimum_study(s, settings(s, 0)).optimum;
    if (tuned) {  // by symmetry all blades move alike, a third of a period apart
      for (std::size_t k = 0; k < 2; ++k) CHECK(found.design[k] == Approx(first.design[k]).epsilon(1e-5));
      for (const auto& each : found.cases) CHECK(each.amplitude == Approx(first.amplitude).epsilon(1e-8));
    } else {
      CHECK_FALSE(found.cases[0].active);
      CHECK_FALSE(found.cases[1].active);
      CHECK(found.cases[2].active);
      CHECK(any(first.design) > found.amplitude);
    }
  }
}

TEST_CASE("one load for four levels: the worst and the mean are least, in responses of each level") {
  const scene::Scene s = example("levels/scene.json");
  for (const std::size_t index : {2, 3}) {
    const OptimumProblem& problem = settings(s, index).problem;
    CAPTURE(s.studies[index].name);
    const auto found = optimize::optimum_study(s, settings(s, index)).optimum;
    REQUIRE(found.design.size() == 1);
    REQUIRE(found.certificate);
    const bool mean = problem.criterion == optimize::Criterion::mean;
    const auto value = [&](double load) {
      double worst = 0, sum = 0, weights = 0;
      for (const auto& each : problem.cases) {
        scene::Scene at = s;
        scene::set(at, each.set[0].first, each.set[0].second);
        const double height = each.weight * highest(at, problem, {load});
        worst = std::max(worst, height);
        sum += height;
        weights += each.weight;
      }
      return mean ? sum / weights : worst;
    };
    CHECK(value(found.design[0]) == Approx(found.amplitude).epsilon(1e-9));
    for (const double factor : {0.5, 0.9, 0.99, 1.01, 1.1, 2.0})
      CHECK(value(factor * found.design[0]) > found.amplitude);
    for (const auto& range : found.certificate->ranges[0])
      for (const double end : {range.lower, range.upper})
        CHECK(value(end) == Approx((1 + range.share) * found.amplitude).epsilon(1e-6));
  }
}

TEST_CASE(
    "with a contact that is uncertain, no contact between the bounds is worse than the worst that is "
    "reported") {
  const scene::Scene s = example("levels/scene.json");
  const OptimumProblem& problem = settings(s, 4).problem;
  REQUIRE(problem.scatter.size() == 2);
  const auto found = optimize::optimum_study(s, settings(s, 4)).optimum;
  REQUIRE(found.design.size() == 1);
  const auto worst = [&](double load) {  // on a grid that holds the corners
    double most = 0;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j) {
        scene::Scene at = s;
        const auto between = [](const optimize::DesignVariable& v, int k) {
          return v.lower + k * (v.upper - v.lower) / 4;
        };
        scene::set(at, problem.scatter[0].name, between(problem.scatter[0], i));
        scene::set(at, problem.scatter[1].name, between(problem.scatter[1], j));
        most = std::max(most, highest(at, problem, {load}));
      }
    return most;
  };
  CHECK(worst(found.design[0]) == Approx(found.amplitude).epsilon(1e-9));
  for (const double factor : {0.97, 1.03}) CHECK(worst(factor * found.design[0]) > found.amplitude);
}

TEST_CASE("the examples' gradients are differences of responses") {
  for (const char* file : {"two_dampers/scene.json", "blade_row/scene.json", "blade_row/mistuned.json"}) {
    CAPTURE(file);
    const scene::Scene s = example(file);
    CHECK(check_gradients(s, settings(s, 0).problem) >= 6);
  }
  const scene::Scene one = example("levels/scene.json");  // one parameter, one peak
  CHECK(check_gradients(one, settings(one, 0).problem) == 3);
}

TEST_CASE("the optimal load grows with the force in proportion, and less next to a cubic spring") {
  scene::Scene s = example("levels/scene.json");
  const scene::Study study = s.studies[0];
  const auto load_over_force = [&](double cubic) {
    scene::set(s, "hardening.stiffness", cubic);
    const auto results = optima::of(s, study.settings.as<OptimumSettings>(), study.for_each);
    std::vector<double> ratios;
    for (const auto& result : results) {
      CAPTURE(cubic, result.set[0].second, result.stop.message, result.direct.message);
      CHECK(result.status == observables::Status::complete);
      REQUIRE(result.direct.found);
      CHECK(result.difference_of_design() < 1e-7);
      CHECK(result.difference_of_amplitude() < 1e-12);
      REQUIRE(result.optimum.certificate);
      CHECK(result.optimum.certificate->others_lower);
      ratios.push_back(result.optimum.design[0] / result.set[0].second);
    }
    return ratios;
  };
  // Displacements, forces and the load over the level are the same at every level, for any c and N.
  const auto linear = load_over_force(0);
  REQUIRE(linear.size() == 4);
  for (const double ratio : linear) CHECK(std::abs(ratio / linear[0] - 1) < 1e-7);
  // The spring raises the frequency, so that the viscous damper takes a larger part.
  const auto cubic = load_over_force(1e9);
  REQUIRE(cubic.size() == 4);
  for (std::size_t i = 0; i < cubic.size(); ++i) CHECK(cubic[i] < (i == 0 ? linear[0] : cubic[i - 1]));
  CHECK(cubic.back() < 0.91 * cubic.front());
}

TEST_CASE("with one harmonic the optimal loads next to a cubic spring are those of describing functions") {
  scene::Scene s = example("levels/scene.json");
  s.harmonics.order = 1;
  const double m = 1.24, k = 17890, c = 3, cubic = 1e9, kd = 3500, mu = 0.5;
  // x = A cos(t), cos(b) = 1 - 2 mu Fn / (kd A): the dynamic stiffness D(w) has the real part
  // k + 3/4 cubic A^2 + kd (b - sin(b) cos(b)) / pi - m w^2 and the imaginary part kd sin(b)^2 / pi + c w.
  // At a peak A = f0 / min |D| over w; where A is least over Fn, that min is greatest.
  const auto least_stiffness = [&](double amplitude, double load) {
    const double b = std::acos(1 - 2 * mu * load / (kd * amplitude));
    const double real =
        k + 0.75 * cubic * amplitude * amplitude + kd * (b - std::sin(b) * std::cos(b)) / std::numbers::pi;
    const double imaginary = kd * std::sin(b) * std::sin(b) / std::numbers::pi;
    double w = std::sqrt(real / m);
    for (int i = 0; i < 20; ++i) {  // Newton for d|D|^2/dw = 0
      const double slope = -2 * m * w * (real - m * w * w) + c * (imaginary + c * w);
      w -= slope / (-2 * m * real + 6 * m * m * w * w + c * c);
    }
    return std::hypot(real - m * w * w, imaginary + c * w);
  };
  const auto best_load = [&](double amplitude) {  // by golden section
    const double share = (std::sqrt(5.0) - 1) / 2;
    double lower = 0, upper = kd * amplitude / mu;
    while (upper - lower > 1e-9 * upper) {
      const double a = upper - share * (upper - lower), b = lower + share * (upper - lower);
      if (least_stiffness(amplitude, a) > least_stiffness(amplitude, b))
        upper = b;
      else
        lower = a;
    }
    return (lower + upper) / 2;
  };
  const auto results = optima::of(s, settings(s, 0), s.studies[0].for_each);
  REQUIRE(results.size() == 4);
  for (const auto& result : results) {
    const double force = result.set[0].second;
    double lower = 1e-5, upper = 1e-1;
    for (int i = 0; i < 60; ++i) {
      const double middle = std::sqrt(lower * upper);
      (middle * least_stiffness(middle, best_load(middle)) < force ? lower : upper) = middle;
    }
    CAPTURE(force);
    CHECK(result.optimum.amplitude == Approx(lower).epsilon(1e-12));
    CHECK(result.optimum.design[0] == Approx(best_load(lower)).epsilon(1e-6));
  }
}

TEST_CASE(
    "with one harmonic and no viscous damping the optimal load is pi f0 / (2 mu), cubic spring or not") {
  scene::Scene s = example("levels/scene.json");
  s.harmonics.order = 1;
  scene::set(s, "c.value", 0);
  for (const double cubic : {0.0, 1e9}) {
    scene::set(s, "hardening.stiffness", cubic);
    for (const double force : {1.0, 2.0, 4.0}) {
      scene::set(s, "force.cosine", force);
      // above pi f0 / (4 mu), below which the resonance is unbounded without the spring
      scene::set(s, "damper.normal_load", 3 * force);
      const OptimumProblem problem{{{"damper.normal_load", 1.7 * force, 20 * force}}, 15, 60, {}, {}};
      const auto found = optimize::optimum(s, problem);
      CAPTURE(cubic, force, found.stop.message);
      REQUIRE(found.design.size() == 1);
      // mu = 0.5
      CHECK(found.design[0] == Approx(std::numbers::pi * force).epsilon(1e-6));
    }
  }
}

TEST_CASE("next to a minimum, a lower design on the way to the end of its tolerance range is taken up") {
  scene::Scene s = example("levels/scene.json");
  scene::set(s, "k.value", 9000);  // the resonance reaches the lower end of the window
  const OptimumProblem over_damper{{{"damper.normal_load", 0.5, 60}}, 15, 60};
  const auto found = optimize::optimum(s, over_damper);
  REQUIRE(found.stop.reason == optimize::reasons::end_of_window);
  CHECK(std::any_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
    return note.find("continued from the lower damper.normal_load") != std::string::npos;
  }));
  const auto global = optimize::optimum(
      s, over_damper, {.algorithm = "GN_DIRECT_L", .evaluations = 100, .certificate = false});
  CHECK(found.amplitude <= (1 + 1e-9) * global.amplitude);
  CHECK(found.certificate->at_bound == std::vector<int>{-1});
}

TEST_CASE("the best load of a cantilever is that of a beam of any mesh, and of a solid from matrices") {
  const auto best = [](const scene::Scene& s) {
    const auto result = optimize::optimum_study(s, settings(s, s.studies.size() - 1));
    CAPTURE(result.optimum.stop.message);
    REQUIRE(result.optimum.status == observables::Status::complete);
    REQUIRE(result.direct.found);
    CHECK(result.difference_of_design() < 1e-6);
    return std::pair(result.optimum.design.front(), result.optimum.amplitude);
  };
  const scene::Scene beam = example("cantilever/beam.json");
  const auto [load, amplitude] = best(beam);
  std::string coarse = scene::write(beam);
  coarse.replace(coarse.find("\"elements\": 40"), 14, "\"elements\": 10");
  std::istringstream in(coarse);
  const auto [coarse_load, coarse_amplitude] = best(scene::read(in, test_catalogue::whole()));
  CHECK(coarse_load == Approx(load).epsilon(1e-5));  // its first natural frequency is 1e-6 too high
  CHECK(coarse_amplitude == Approx(amplitude).epsilon(2e-6));
  // Shear and the indentation under the force, which a beam does not have, and bricks as long as high.
  const auto [solid_load, solid_amplitude] = best(example("cantilever/solid.json"));
  CHECK(solid_load == Approx(load).epsilon(5e-3));
  CHECK(solid_amplitude == Approx(amplitude).epsilon(1e-2));
}

TEST_CASE("the blade of a finite-element program has its natural frequencies, and a best load") {
  scene::Scene s = example("blade/scene.json");
  const auto& search = settings(s, 2);
  const auto result = optimize::optimum_study(s, search);
  REQUIRE(result.optimum.status == observables::Status::complete);
  REQUIRE(result.direct.found);
  CHECK(result.difference_of_design() < 1e-6);
  for (const double factor : {0.8, 1.25})
    CHECK(highest(s, search.problem, {factor * result.optimum.design[0]}) > 1.01 * result.optimum.amplitude);

  // CalculiX 2.20, *FREQUENCY, of the same matrices: Hz, as it prints them.
  constexpr double calculix[] = {209.4483, 843.6336, 1285.859, 1419.738, 2182.629, 2578.179};
  scene::set(s, "load", 0);
  scene::set(s, "blade.beta", 1e-9);
  const auto free = observables::frequency_response(s, {150, 3000});
  REQUIRE(free.front().status == observables::Status::complete);
  std::size_t peak = 0;
  for (const auto& event : free.front().events) {
    if (event.kind != "peak") continue;
    REQUIRE(peak < std::size(calculix));
    CHECK(event.point.omega / (2 * std::numbers::pi) == Approx(calculix[peak++]).epsilon(4e-7).margin(0));
  }
  CHECK(peak == std::size(calculix));
}

TEST_CASE(
    "the best load of the damper under platforms is that of the curve of peaks, and of motions in time") {
  const scene::Scene s = example("under_platform_damper/scene.json");
  const auto result = optimize::optimum_study(s, settings(s, 2));
  const auto& found = result.optimum;
  CAPTURE(found.stop.message, result.direct.message);
  REQUIRE(found.status == observables::Status::complete);
  REQUIRE(found.design.size() == 1);
  REQUIRE(found.certificate);
  CHECK(found.certificate->others_lower);
  REQUIRE(result.direct.found);
  CHECK(result.difference_of_design() < 1e-6);
  CHECK(result.difference_of_amplitude() < 1e-10);
  for (const double factor : {0.8, 1.25})
    CHECK(highest(s, settings(s, 2).problem, {factor * found.design[0]}) > 1.01 * found.amplitude);
  // In time there are no harmonics; those left out have less than 5e-5 of the amplitude.
  scene::Scene at = s;
  scene::set(at, "load", found.design[0]);
  const auto motion =
      observables::motion_in_time(at, {.frequency = found.point.omega / (2 * std::numbers::pi)});
  CAPTURE(motion.stop.message);
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(motion.amplitude == Approx(found.amplitude).epsilon(5e-5));
}
