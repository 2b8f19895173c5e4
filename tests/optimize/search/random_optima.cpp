// Optima of random structures with friction next to responses of their own: the amplitude, the ends of
// tolerance ranges, and what is reported of windows and bounds that miss the resonances.

#include "catch.hpp"
#include "random.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "optimize/search/random_optima.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

using namespace arcslip;
using observables::Status;
using optimize::Optimum;
using optimize::OptimumProblem;
using test_random::Random;

namespace {

constexpr double accurate = 1e-6;  // of amplitudes, relative

struct Search {
  scene::Scene scene;
  OptimumProblem problem;
};

/// One or two loads, or stiffnesses, of the friction dampers of a random structure, over a factor of 100 to
/// both sides, in the window around its resonances.
Search any_search(std::uint64_t seed, Random& random) {
  Search search{random_scenes::make(seed, static_cast<random_scenes::Excitation>(seed % 3)), {}};
  scene::Scene& s = search.scene;
  search.problem.frequency_from = scenes::window(s).from;
  search.problem.frequency_to = scenes::window(s).to;
  std::vector<std::string> names;
  for (const auto& element : s.elements)
    names.push_back(element.name + (random.one_in(5) ? ".stiffness" : ".normal_load"));
  const int wanted = std::min(random.count(1, 2), static_cast<int>(names.size()));
  for (int k = 0; k < wanted; ++k) {
    const auto pick = static_cast<std::size_t>(random.count(0, static_cast<int>(names.size()) - 1));
    const double own = scene::value(s, names[pick]);
    search.problem.over.push_back({names[pick], 0.01 * own, 100 * own});
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(pick));
  }
  return search;
}

struct Place {
  double omega = 0, amplitude = 0;
  bool is_peak = false;
};

/// The places of a frequency response: its points and events.
std::vector<Place> response(scene::Scene s, const OptimumProblem& problem, const std::vector<double>& design,
                            double from, double to) {
  for (std::size_t k = 0; k < design.size(); ++k) scene::set(s, problem.over[k].name, design[k]);
  std::vector<Place> all;
  for (const auto& branch : observables::frequency_response(s, {from, to})) {
    CHECK(branch.status == Status::complete);
    for (const auto& event : branch.events)
      all.push_back({event.point.omega, event.point.amplitude, event.kind == "peak"});
    for (const auto& point : branch.points) all.push_back({point.omega, point.amplitude});
  }
  return all;
}

Place highest(const std::vector<Place>& all) {
  return *std::max_element(all.begin(), all.end(), [](const Place& a, const Place& b) {
    return a.amplitude != b.amplitude ? a.amplitude < b.amplitude : a.is_peak < b.is_peak;
  });
}

/// Within the range the amplitude is at most (1 + share) times that of the optimum, and at ends that are not
/// bounds it is that high.
void check_range(const Search& search, const Optimum& found, std::size_t k,
                 const optimize::ToleranceRange& range) {
  const auto& [from, to] = std::pair(search.problem.frequency_from, search.problem.frequency_to);
  const double most = (1 + range.share) * found.amplitude;
  const auto amplitude_at = [&](double value) {
    std::vector<double> design = found.design;
    design[k] = value;
    return highest(response(search.scene, search.problem, design, from, to)).amplitude;
  };
  for (const bool upper : {false, true}) {
    const double end = upper ? range.upper : range.lower;
    const bool is_bound = upper ? range.upper_is_bound : range.lower_is_bound;
    CAPTURE(search.problem.over[k].name, range.share, upper, end, is_bound);
    for (const double share : {0.25, 0.5, 0.75, 1.0})
      CHECK(amplitude_at(found.design[k] * std::pow(end / found.design[k], share)) <= most * (1 + accurate));
    if (!is_bound) CHECK(std::abs(amplitude_at(end) / most - 1) < accurate);
  }
}

/// How many ends of tolerance ranges were looked at; nothing: the search is not complete.
std::optional<int> check_optimum(std::uint64_t seed) {
  Random random(seed);
  const Search search = any_search(seed, random);
  const Optimum found = optimize::optimum(search.scene, search.problem);
  std::cout << "seed " << seed << ": " << search.problem.over.size() << " parameters, " << found.stop.reason
            << ", " << found.seconds << " s" << std::endl;
  CAPTURE(seed, found.design, found.stop.message);
  if (found.status != Status::complete || found.stop.reason == optimize::reasons::flat) return {};
  const Place peak = highest(response(search.scene, search.problem, found.design,
                                      search.problem.frequency_from, search.problem.frequency_to));
  CHECK(std::abs(found.amplitude / peak.amplitude - 1) < accurate);
  REQUIRE(found.certificate);
  if (found.starts) CHECK(found.starts->to_optimum > 0);
  int ends = 0;
  for (std::size_t k = 0; k < found.certificate->ranges.size(); ++k)
    for (const optimize::ToleranceRange& range : found.certificate->ranges[k]) {
      check_range(search, found, k, range);
      ends += 2;
    }
  return ends;
}

}  // namespace

// A line for each, so that a long run that is cut short is not lost.
TEST_CASE(
    "random optima have the amplitude of a response of their own, and tolerance ranges end where it is "
    "too high") {
  const std::uint64_t end = random_optima::first() + random_optima::with_ranges.count();
  int complete = 0, ends = 0;
  for (std::uint64_t seed = random_optima::first(); seed < end; ++seed)
    if (const auto looked_at = check_optimum(seed)) {
      ++complete;
      ends += *looked_at;
    }
  std::cout << complete << " complete, " << ends << " ends of ranges" << std::endl;
  CHECK(2 * complete >= static_cast<int>(random_optima::with_ranges.count()));  // of 500, 327
}

// d3.stiffness may fall by four decades, to its bound, where the amplitude is within 5 % again.
TEST_CASE("a tolerance range ends before a part in which the amplitude is too high") {
  CHECK(check_optimum(89) == 8);
}

// Windows of a tenth to all of the width, somewhere within four times the width; bounds over a factor of 1.5
// to 100.
TEST_CASE(
    "random optima in windows and bounds that may miss are complete only at a peak, or where there is "
    "none beyond") {
  const std::uint64_t end = random_optima::first() + random_optima::with_other_windows.count();
  int complete = 0, at_end = 0;
  for (std::uint64_t seed = random_optima::first(); seed < end; ++seed) {
    Random random(seed);
    Search search = any_search(seed, random);
    OptimumProblem& problem = search.problem;
    const double from = problem.frequency_from, to = problem.frequency_to, width = to - from;
    const double other_width = width * random.logarithmic(0.1, 1);
    problem.frequency_from = std::max(0.2 * from, from + width * random.between(-0.5, 1.5));
    problem.frequency_to = problem.frequency_from + other_width;
    for (auto& variable : problem.over) {
      const double middle = std::sqrt(variable.lower * variable.upper) * random.logarithmic(0.1, 10);
      const double factor = random.logarithmic(1.2, 10);
      variable.lower = middle / factor;
      variable.upper = middle * factor;
      scene::set(search.scene, variable.name, middle);
    }
    const Optimum found = optimize::optimum(search.scene, problem, {.certificate = false});
    std::cout << "seed " << seed << ": " << found.stop.reason << ", " << found.seconds << " s" << std::endl;
    CAPTURE(seed, found.design, problem.frequency_from, problem.frequency_to, found.stop.message);
    if (found.design.empty() || !std::isfinite(found.amplitude)) continue;
    const double lower = problem.frequency_from * scenes::hertz, upper = problem.frequency_to * scenes::hertz;
    const auto within =
        response(search.scene, problem, found.design, problem.frequency_from, problem.frequency_to);
    CHECK(std::abs(found.amplitude / highest(within).amplitude - 1) < accurate);
    // The highest peak may be as high as the end.
    const auto is_highest_at = [&](double omega) {
      return std::any_of(within.begin(), within.end(), [&](const Place& place) {
        return std::abs(place.omega / omega - 1) < 1e-9 && place.amplitude > (1 - accurate) * found.amplitude;
      });
    };
    const bool is_at_lower = is_highest_at(lower), is_at_upper = is_highest_at(upper);
    const auto beyond = response(search.scene, problem, found.design, 0.1 * from, to + 3 * width);
    const auto is_higher_beyond = [&](double by) {
      return std::any_of(beyond.begin(), beyond.end(), [&](const Place& place) {
        return place.is_peak && place.amplitude > found.amplitude * (1 + by) &&
               ((is_at_lower && place.omega < lower) || (is_at_upper && place.omega > upper));
      });
    };
    if (found.stop.reason == optimize::reasons::end_of_window) {
      ++at_end;
      CHECK((is_at_lower || is_at_upper));
      CHECK(is_higher_beyond(-accurate));
    } else if (found.status == Status::complete) {
      ++complete;
      CHECK(!is_higher_beyond(1e-4));
    }
  }
  std::cout << complete << " complete, " << at_end << " at an end of the window" << std::endl;
  CHECK(complete > 0);
  CHECK(at_end > 0);
}
