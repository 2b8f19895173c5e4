// Structures with several peaks, in several cases: where the amplitude is read, and levels of the force.

#include "catch.hpp"

#include "optimize/row.hpp"

#include <arcslip/optimize/certificate/multipliers.hpp>
#include <arcslip/optimize/evaluation/load_cases.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace arcslip;
using optimize::Criterion;
using optimize::Optimum;

namespace {

scene::Scene read_at(scene::Scene s, int mass) {
  s.response() = {{mass, 1}};
  return s;
}

scene::Scene forced(scene::Scene s, double force) {
  scene::set(s, "f.cosine", force);
  return s;
}

// In every direction of the loads, 1 % away, the criterion of new frequency responses is higher.
template <class Criterion>
void check_least(const Optimum& found, Criterion criterion) {
  CHECK(criterion(found.design) == Approx(found.amplitude).epsilon(1e-9));
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    const std::vector<double> nearby = {found.design[0] * (1 + 1e-2 * std::cos(angle)),
                                        found.design[1] * (1 + 1e-2 * std::sin(angle))};
    CHECK(criterion(nearby) > found.amplitude);
  }
}

}  // namespace

TEST_CASE("the largest amplitude of any of three blades is least where frequency responses say so") {
  const scene::Scene s = row(3, 2, 5);
  auto problem = over_loads(2, 5, 45);
  for (int blade = 0; blade < 3; ++blade) problem.cases.push_back({{}, 1, scene::Direction{{blade, 1}}});
  const Optimum found = optimize::optimum(s, problem);
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity < 1e-6);
  CHECK(found.certificate->others_lower);
  double sum = 0;
  REQUIRE(found.cases.size() == 3);
  for (int blade = 0; blade < 3; ++blade) {
    const auto& at = found.cases[static_cast<std::size_t>(blade)];
    CHECK(at.amplitude == Approx(highest_peak(read_at(s, blade), found.design, 5, 45)).epsilon(1e-9));
    sum += at.multiplier;
  }
  CHECK(sum == Approx(1));
  check_least(found, [&](const std::vector<double>& loads) {
    double most = 0;
    for (int blade = 0; blade < 3; ++blade)
      most = std::max(most, highest_peak(read_at(s, blade), loads, 5, 45));
    return most;
  });
}

TEST_CASE("a response at several places is optimized as one case for each of them") {
  scene::Scene s = row(3, 2, 5);
  optimize::OptimumSettings settings;
  settings.problem = over_loads(2, 5, 45);
  auto given = settings;
  for (int blade = 0; blade < 3; ++blade)
    given.problem.cases.push_back({{}, 1, scene::Direction{{blade, 1}}});
  s.responses = {{.direction = {{0, 1}}, .others = {{{1, 1}}, {{2, 1}}}}};
  CHECK(optimize::with_places(s, settings).problem.cases == given.problem.cases);
  CHECK(optimize::with_places(row(3, 2, 5), settings) == settings);
  const auto found = optimize::optimum(s, given.problem);
  REQUIRE(found.status == observables::Status::complete);
  CHECK(highest_peak(s, found.design, 5, 45) == Approx(found.amplitude).epsilon(1e-9));

  CHECK_THROWS_WITH(optimize::optimum(s, settings.problem),
                    "the response is the largest of 3 places, each of which needs a load case of its own "
                    "(with_places())");
  settings.problem.criterion = Criterion::mean;
  CHECK_THROWS_WITH(optimize::with_places(s, settings),
                    "the criterion must be worst where the response is the largest of 3 places (\"max_of\")");
  settings.along = optimize::DesignVariable{"f.cosine", 1, 2};
  CHECK_THROWS_WITH(
      optimize::with_places(s, settings),
      "the optimum cannot be continued over \"f.cosine\" where the response is the largest of 3 "
      "places (\"max_of\"); optimize at single values of it");
}

TEST_CASE("the figures of several places show their envelope, for each setting of the other cases") {
  scene::Scene s = row(3, 2, 5);
  s.responses = {{.direction = {{0, 1}}, .others = {{{1, 1}}, {{2, 1}}}}};
  optimize::OptimumSettings settings;
  settings.problem = over_loads(1, 5, 45);
  const auto found = optimize::optimum_study(s, optimize::with_places(s, settings));
  CHECK(found.status == observables::Status::complete);
  REQUIRE(found.optimum.cases.size() == 3);
  REQUIRE(found.curves.size() == 1);
  const auto& curves = found.curves.front();
  CHECK(curves.all_places);
  double highest = 0, lowest = 1;
  for (const auto& event : curves.responses.at(0).events)
    if (event.kind == observables::event_kinds::peak) highest = std::max(highest, event.point.amplitude);
  // The responses are shown at the optimum to four digits.
  CHECK(highest == Approx(found.optimum.amplitude).epsilon(1e-4));
  // The optimum lies on a curve of peaks: there is none where it does not.
  const double load = found.optimum.design[0];
  for (const auto& curve : curves.peaks)
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const auto &a = curve.points[i - 1], &b = curve.points[i];
      if ((a.over - load) * (b.over - load) > 0 || a.over == b.over) continue;
      const double t = (load - a.over) / (b.over - a.over);
      lowest =
          std::min(lowest, std::abs(((1 - t) * a.amplitude + t * b.amplitude) / found.optimum.amplitude - 1));
    }
  CHECK(lowest < 1e-2);
  const auto without = optimize::optimum_study(s, optimize::with_places(s, settings), {}, {.curves = false});
  CHECK(without.curves.empty());
  CHECK(without.status == found.status);
  CHECK(without.optimum.design == found.optimum.design);
  settings.problem.cases = {{{{"f.cosine", 1}}, 1}, {{{"f.cosine", 1.5}}, 1}};
  const auto levels = optimize::optimum_study(s, optimize::with_places(s, settings));
  CHECK(levels.optimum.cases.size() == 6);
  CHECK(levels.curves.size() == 2);
  // A case at one of the places alone shows that place, not the envelope.
  const auto& all = found.optimum.cases;
  const auto lowest_case = std::min_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  REQUIRE(lowest_case->amplitude < 0.99 * found.optimum.amplitude);
  const int mass = static_cast<int>(lowest_case - all.begin());
  settings.problem.cases = {{{}, 1, scene::Direction{{mass, 1}}}};
  const auto one = optimize::optimum_study(s, optimize::with_places(s, settings));
  REQUIRE(one.curves.size() == 1);
  CHECK_FALSE(one.curves.front().all_places);
  double shown = 0;
  for (const auto& event : one.curves.front().responses.at(0).events)
    if (event.kind == observables::event_kinds::peak) shown = std::max(shown, event.point.amplitude);
  CHECK(shown == Approx(one.optimum.amplitude).epsilon(1e-4));
}

TEST_CASE("the mean over cases with several peaks each is least where frequency responses say so") {
  const scene::Scene s = row(2, 2, 5);
  auto problem = over_loads(2, 8, 45);
  problem.criterion = Criterion::mean;
  problem.cases = {{{{"f.cosine", 1}}, 2}, {{{"f.cosine", 1.5}}, 1}};
  const Optimum found = optimize::optimum(s, problem);
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.epigraph);
  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity < 1e-6);
  for (std::size_t c = 0; c < 2; ++c) {
    double share = 0;
    for (const auto& peak : found.certificate->peaks)
      if (peak.in_case == c) share += peak.weight;
    const double part = problem.cases[c].weight * found.cases[c].amplitude / (3 * found.amplitude);
    CHECK(share == Approx(part).epsilon(1e-8));
    CHECK(found.cases[c].multiplier == Approx(part).epsilon(1e-8));
  }
  check_least(found, [&](const std::vector<double>& loads) {
    return (2 * highest_peak(forced(s, 1), loads, 8, 45) + highest_peak(forced(s, 1.5), loads, 8, 45)) / 3;
  });
}

TEST_CASE("a linear limit holds over several cases") {
  const scene::Scene s = row(2, 2, 5);
  auto problem = over_loads(2, 8, 45);
  problem.cases = {{{{"f.cosine", 1}}, 1}, {{{"f.cosine", 1.5}}, 1}};
  const Optimum without = optimize::optimum(s, problem, {.certificate = false});
  REQUIRE(without.design[0] + without.design[1] > 2.5);
  problem.linear_limits = {{.weights = {{"d0.normal_load", 1}, {"d1.normal_load", 1}}, .at_most = 2.5}};
  const Optimum found = optimize::optimum(s, problem);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.feasible);
  CHECK(found.design[0] + found.design[1] == Approx(2.5).epsilon(1e-6));
  CHECK(found.amplitude > without.amplitude);
  // Its multiplier is what looser and tighter limits gain and lose.
  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity < 1e-6);
  REQUIRE(found.certificate->limits.size() == 1);
  double amplitude[2];
  for (const int side : {0, 1}) {
    problem.linear_limits[0].at_most = 2.5 * (side == 0 ? 0.995 : 1.005);
    amplitude[side] = optimize::optimum(s, problem, {.certificate = false}).amplitude;
  }
  CHECK(found.certificate->limits[0].multiplier ==
        Approx(-std::log(amplitude[1] / amplitude[0]) / 0.01).epsilon(1e-3));
}

TEST_CASE("a search that begins outside a linear limit ends within it, lower than other loads on it",
          "[numbers]") {
  const scene::Scene s = row(2, 2, 15);
  auto problem = over_loads(2, 8, 45);
  problem.cases = {{{{"f.cosine", 1}}, 1}, {{{"f.cosine", 2}}, 1}};
  problem.linear_limits = {{.weights = {{"d0.normal_load", 1}, {"d1.normal_load", 1}}, .at_most = 2}};
  const Optimum found = optimize::optimum(s, problem, {.certificate = false});
  CAPTURE(found.stop.message, found.design[0], found.design[1]);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.feasible);
  CHECK(found.design[0] + found.design[1] <= 2 * (1 + 1e-8));
  for (const double first : {0.1, 0.2, 0.4, 0.8, 1.2})
    CHECK(highest_peak(forced(s, 2), {first, 2 - first}, 8, 45) > found.amplitude);
}

TEST_CASE("a case without excitation leaves the optimum of the others as it is") {
  const scene::Scene s = row(2, 2, 5);
  for (const Criterion criterion : {Criterion::worst, Criterion::mean}) {
    auto problem = over_loads(2, 8, 45);
    problem.criterion = criterion;
    problem.cases = {{{{"f.cosine", 0}}, 1}, {{{"f.cosine", 1}}, 1}};
    const Optimum found = optimize::optimum(s, problem);
    CAPTURE(found.stop.message);
    CHECK(found.status == observables::Status::complete);
    REQUIRE(found.certificate);
    CHECK(found.certificate->stationarity < 1e-6);
    CHECK(found.cases[0].amplitude == 0);
    check_least(found, [&](const std::vector<double>& loads) {
      return highest_peak(s, loads, 8, 45) / (criterion == Criterion::mean ? 2 : 1);
    });
  }
}

TEST_CASE("the gradient of both criteria is the difference of new responses") {
  const scene::Scene s = row(2, 2, 5);
  const std::vector<double> loads = {1.3, 2.1};
  const double hertz = scene::to_rad_per_s(s.frequency_unit);
  for (const Criterion criterion : {Criterion::worst, Criterion::mean}) {
    optimize::LoadCases cases(criterion);
    for (const double force : {0.7, 1.4}) {
      const auto model = std::make_shared<const model::Model>(model::build(forced(s, force)));
      const std::vector<int> over = {model::parameter_index(*model, "d0.normal_load"),
                                     model::parameter_index(*model, "d1.normal_load")};
      cases.add(std::make_unique<optimize::PeakAmplitude>(
                    model, over, observables::FrequencyWindow{8 * hertz, 45 * hertz}),
                force < 1 ? 3 : 1);
    }
    const auto value = [&](const std::vector<double>& at) {
      const double low = 3 * highest_peak(forced(s, 0.7), at, 8, 45),
                   high = highest_peak(forced(s, 1.4), at, 8, 45);
      return criterion == Criterion::mean ? (low + high) / 4 : std::max(low, high);
    };
    cases.at(loads);
    CHECK(cases.value() == Approx(value(loads)).epsilon(1e-10));
    for (std::size_t k = 0; k < 2; ++k) {
      auto lower = loads, upper = loads;
      const double h = 1e-4 * loads[k];
      lower[k] -= h;
      upper[k] += h;
      const double difference = (value(upper) - value(lower)) / (2 * h);
      CHECK(cases.gradient()[static_cast<Eigen::Index>(k)] == Approx(difference).epsilon(1e-5));
    }
  }
}

TEST_CASE("the least combination of gradients meets the conditions of a minimum, of full rank or not") {
  // Columns a, b and -(a + b)/2 balance; a fourth next to them is not wanted.
  Eigen::MatrixXd G(2, 4);
  G << 1, 0, -0.5, 1,  //
      0, 1, -0.5, 1;
  const Eigen::VectorXd balanced = optimize::least_combination(G, {0, 0, 0, 0}, {1});
  CHECK((G * balanced).norm() < 1e-14);
  CHECK(balanced.minCoeff() >= 0);
  CHECK(balanced.sum() == Approx(1));
  std::srand(3);  // of Eigen's random matrices
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Index rows = 1 + trial % 4, columns = 2 + trial % 9;
    const Eigen::MatrixXd random = Eigen::MatrixXd::Random(rows, columns) +
                                   Eigen::MatrixXd::Constant(rows, columns, trial % 3 == 0 ? 0.6 : 0.0);
    std::vector<std::size_t> group(static_cast<std::size_t>(columns));
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = i % 2;
    const std::vector<double> shares = {0.7, 0.3};
    const Eigen::VectorXd m = optimize::least_combination(random, group, shares);
    const Eigen::VectorXd slope = random.transpose() * (random * m);
    CHECK(m.minCoeff() >= 0);
    for (const std::size_t g : {0u, 1u}) {
      double sum = 0, least = HUGE_VAL, used = -HUGE_VAL;
      for (std::size_t i = g; i < group.size(); i += 2) {
        const auto k = static_cast<Eigen::Index>(i);
        sum += m[k];
        least = std::min(least, slope[k]);
        if (m[k] > 1e-9) used = std::max(used, slope[k]);
      }
      CHECK(sum == Approx(shares[g]).epsilon(1e-12));
      CHECK(used <= least + 1e-9);
    }
  }
}
