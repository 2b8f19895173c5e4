// Ends of tolerance ranges of linear absorbers, two peaks of which are equally high at the optimum, next to
// the closed form of the response.

#include "catch.hpp"
#include "random.hpp"

#include "lib/hbm/scenes.hpp"
#include "optimize/certificate/tolerance_ranges.hpp"

#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <sstream>
#include <vector>

using namespace arcslip;
using optimize::Optimum;
using test_random::Random;

namespace {

/// A host of mass, stiffness and force 1 with a damper cp; an absorber of mass mu with ka and ca.
struct Absorber {
  double mu, cp, ka, ca;
};

double amplitude(const Absorber& of, double w) {
  const std::complex<double> d(of.ka, w * of.ca), host(1 - w * w, w * of.cp);
  return std::abs((d - of.mu * w * w) / ((host + d) * (d - of.mu * w * w) - d * d));
}

constexpr double window_from = 0.5, window_to = 1.6;

/// The highest of all maxima over the window, each by golden sections.
double highest_peak(const Absorber& of) {
  constexpr int count = 4400;
  const auto at = [](int i) { return window_from + (window_to - window_from) * i / count; };
  std::vector<double> a(count + 1);
  for (int i = 0; i <= count; ++i) a[static_cast<std::size_t>(i)] = amplitude(of, at(i));
  double most = std::max(a.front(), a.back());
  for (int i = 1; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (a[k] < a[k - 1] || a[k] < a[k + 1]) continue;
    double lower = at(i - 1), upper = at(i + 1);
    for (int step = 0; step < 60; ++step) {
      const double third = 0.381966 * (upper - lower);
      if (amplitude(of, lower + third) < amplitude(of, upper - third))
        lower += third;
      else
        upper -= third;
    }
    most = std::max(most, amplitude(of, 0.5 * (lower + upper)));
  }
  return most;
}

scene::Scene scene_of(const Absorber& of) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["p", "d"],
    "masses": [{"name": "mp", "at": "p", "value": 1}, {"name": "md", "at": "d", "value": )"
       << of.mu << R"(}], "springs": [{"name": "kp", "at": "p", "value": 1},
    {"name": "ka", "between": ["p", "d"], "value": )"
       << of.ka << R"(}], "dampers": [{"name": "cp", "at": "p", "value": )" << of.cp
       << R"(}, {"name": "ca", "between": ["p", "d"], "value": )" << of.ca
       << R"(}]}, "excitation": [{"name": "f", "at": "p", "cosine": 1}], "response": {"at": "p"},
    "harmonics": {"order": 1}})";
  return scenes::parse(text.str());
}

/// Within the range the highest peak is at most (1 + share) times that of the optimum, and at its ends,
/// unless they are bounds, as high.
void check_range(const optimize::ToleranceRange& range, double best, double at,
                 const std::function<double(double)>& peak) {
  for (const bool upper : {false, true}) {
    const double end = upper ? range.upper : range.lower;
    const bool bound = upper ? range.upper_is_bound : range.lower_is_bound;
    CAPTURE(range.share, upper, end, bound);
    if (!bound) CHECK(std::abs(peak(end) / ((1 + range.share) * best) - 1) < 1e-6 * range.share + 1e-9);
    for (int i = 1; i < 20; ++i)
      CHECK(peak(at + (end - at) * i / 20) <= (1 + range.share) * best * (1 + 1e-9));
  }
}

void check(const Absorber& start, const optimize::OptimumProblem& problem) {
  const Optimum found = optimize::optimum(scene_of(start), problem);
  CAPTURE(start.mu, start.cp, start.ka, start.ca, found.stop.message);
  REQUIRE(found.status == observables::Status::complete);
  Absorber best = start;
  const auto field = [](Absorber& of, const std::string& name) -> double& {
    return name == "ka.value" ? of.ka : of.ca;
  };
  for (std::size_t k = 0; k < problem.over.size(); ++k) field(best, problem.over[k].name) = found.design[k];
  CHECK(std::abs(found.amplitude / highest_peak(best) - 1) < 1e-9);
  REQUIRE(found.certificate);
  REQUIRE(found.certificate->ranges.size() == problem.over.size());
  for (std::size_t k = 0; k < problem.over.size(); ++k)
    for (const optimize::ToleranceRange& range : found.certificate->ranges[k]) {
      CAPTURE(problem.over[k].name);
      check_range(range, found.amplitude, found.design[k], [&](double value) {
        Absorber moved = best;
        field(moved, problem.over[k].name) = value;
        return highest_peak(moved);
      });
    }
}

}  // namespace

TEST_CASE("the tolerance range of an absorber ends where either of its peaks is too high") {
  const double ka = 0.04988568809570706;
  check({0.05, 0, ka, 0.0127558}, {{{"ka.value", 0.03, 0.07}}, window_from, window_to});
  check({0.05, 0, ka, 0.010204683713231502}, {{{"ka.value", 0.022675312770775932, 0.09070125108310373},
                                               {"ca.value", 0.003826756392461813, 0.038267563924618136}},
                                              window_from,
                                              window_to});
}

TEST_CASE("tolerance ranges of random absorbers end where the closed form does") {
  const std::uint64_t count = tolerance_ranges::absorbers.count();
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double mu = random.logarithmic(0.01, 0.4), cp = random.one_in(3) ? 0 : random.between(0, 0.03);
    const double ka = mu / ((1 + mu) * (1 + mu)), ca = 2 * mu * std::sqrt(3 * mu / 8 / std::pow(1 + mu, 3));
    const Absorber start{mu, cp, random.logarithmic(0.8, 1.25) * ka, random.logarithmic(0.7, 1.4) * ca};
    optimize::OptimumProblem problem{{}, window_from, window_to};
    const int over = random.count(1, 3);
    if (over != 2) problem.over.push_back({"ka.value", 0.5 * ka, 2 * ka});
    if (over != 1) problem.over.push_back({"ca.value", 0.3 * ca, 3 * ca});
    check(start, problem);
  }
}

TEST_CASE(
    "a tolerance range of an optimum at a bound of 0 begins there, and ends where the peak is too high") {
  // A mass of 1 + m2 on a spring of 1 N/m with a damper: a peak of 1/(2 zeta sqrt(1 - zeta^2)), which rises
  // with the mass m2.
  const double c = 0.1;
  const auto peak = [&](double m2) {
    const double zeta = c / (2 * std::sqrt(1 + m2));
    return 1 / (2 * zeta * std::sqrt(1 - zeta * zeta));
  };
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}, {"name": "m2", "at": "x", "value": 0.5}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}, "harmonics": {"order": 1}})");
  const Optimum found = optimize::optimum(s, {{{"m2.value", 0, 1}}, 0.5, 1.5});
  CAPTURE(found.stop.message);
  REQUIRE(found.status == observables::Status::complete);
  REQUIRE(found.design.size() == 1);
  CHECK(found.design[0] >= 0);
  CHECK(found.design[0] < 1e-12);
  CHECK(found.amplitude == Approx(peak(0)).epsilon(1e-9));
  REQUIRE(found.certificate);
  REQUIRE(found.certificate->ranges.size() == 1);
  REQUIRE_FALSE(found.certificate->ranges[0].empty());
  for (const optimize::ToleranceRange& range : found.certificate->ranges[0]) {
    CAPTURE(range.share, range.upper);
    CHECK(range.lower == 0);
    CHECK(range.lower_is_bound);
    CHECK_FALSE(range.upper_is_bound);
    CHECK(peak(range.upper) / ((1 + range.share) * peak(0)) == Approx(1).epsilon(1e-6));
  }
}
