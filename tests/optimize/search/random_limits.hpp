#pragma once
// Random searches with limits, the same ones on every machine, and what else says how low they could be.

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/optimize/evaluation/design_evaluations.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace random_limits {

using namespace arcslip;

struct Search {
  scene::Scene scene;
  optimize::OptimumProblem problem;
};

/// Evenly between 0 and 1, by splitmix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double share() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return std::ldexp(static_cast<double>((z ^ (z >> 31)) >> 11), -53);
  }
  double between(double lower, double upper) { return lower + (upper - lower) * share(); }
  int count(int lower, int upper) {
    return lower + static_cast<int>(share() * static_cast<double>(upper - lower + 1));
  }

 private:
  std::uint64_t state_;
};

inline std::vector<double> design_of(const Search& search, const scene::Scene& scene) {
  std::vector<double> design;
  for (const auto& variable : search.problem.over) design.push_back(scene::value(scene, variable.name));
  return design;
}

/// What the search sees of one design; nothing is searched.
inline optimize::Optimum look(const Search& search, const std::vector<double>& design) {
  scene::Scene there = search.scene;
  for (std::size_t k = 0; k < design.size(); ++k) scene::set(there, search.problem.over[k].name, design[k]);
  return optimize::optimum(there, search.problem, {.evaluations = 1, .certificate = false, .starts = 1});
}

/// One to four loads or stiffnesses of the dampers of a random structure, over a factor of 100 to both sides,
/// with one or two limits: on a sum, on the energy of friction, on the frequency of the peak, on the share of
/// stick.
inline Search make(std::uint64_t seed) {
  Random random(seed);
  Search search{random_scenes::make(seed, static_cast<random_scenes::Excitation>(seed % 3)), {}};
  scene::Scene& s = search.scene;
  auto& problem = search.problem;
  problem.frequency_from = scenes::window(s).from;
  problem.frequency_to = scenes::window(s).to;
  std::vector<std::string> names;
  for (const auto& element : s.elements)
    for (const char* field : {".normal_load", ".stiffness"})
      if (std::string(field) == ".normal_load" || random.share() < 0.2) names.push_back(element.name + field);
  const std::size_t most = std::min<std::size_t>(names.size(), 4);
  const auto wanted = static_cast<std::size_t>(random.count(1, static_cast<int>(most)));
  for (std::size_t k = 0; k < wanted; ++k) {
    const auto pick = static_cast<std::size_t>(random.count(0, static_cast<int>(names.size()) - 1));
    const double own = scene::value(s, names[pick]);
    problem.over.push_back({names[pick], 0.01 * own, 100 * own});
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(pick));
  }
  const auto here = look(search, design_of(search, s));
  const int limits = random.count(1, 2);
  for (int i = 0; i < limits; ++i) {
    const double factor = std::exp(random.between(std::log(0.05), std::log(5.0)));
    const bool above = random.share() < 0.3;
    const int kind = random.count(0, 5);
    if (kind <= 2 || here.cases.empty()) {
      optimize::LinearLimit sum;
      double value = 0;
      for (const auto& variable : problem.over) {
        sum.weights.emplace_back(variable.name, random.between(0.3, 3) / scene::value(s, variable.name));
        value += sum.weights.back().second * scene::value(s, variable.name);
      }
      (above ? sum.at_least : sum.at_most) = factor * value;
      problem.linear_limits.push_back(sum);
    } else if (kind == 3) {
      if (here.point.energy_friction > 0)
        problem.limits.push_back(
            {.observable = "energy_friction", .at_most = factor * here.point.energy_friction});
    } else if (kind == 4) {
      const double frequency = here.point.omega / scene::to_rad_per_s(s.frequency_unit);
      optimize::ObservableLimit limit{.observable = "frequency"};
      (above ? limit.at_least : limit.at_most) = frequency * (1 + random.between(-0.1, 0.1));
      problem.limits.push_back(limit);
    } else {
      optimize::ObservableLimit limit{.observable = s.elements[0].name + ".stick_percent"};
      (above ? limit.at_least : limit.at_most) = random.between(5, 95);
      problem.limits.push_back(limit);
    }
  }
  return search;
}

/// By how much a limit is exceeded at a design, relative, in a frequency response of its own: at its peaks
/// and at the ends of the window, where it falls from them inwards, that are three quarters as high as the
/// highest.
inline double excess(const Search& search, const std::vector<double>& design) {
  scene::Scene there = search.scene;
  for (std::size_t k = 0; k < design.size(); ++k) scene::set(there, search.problem.over[k].name, design[k]);
  std::vector<observables::ResponsePoint> peaks;
  for (const auto& branch :
       observables::frequency_response(there, {search.problem.frequency_from, search.problem.frequency_to})) {
    for (const auto& event : branch.events)
      if (event.kind == "peak") peaks.push_back(event.point);
    const auto& points = branch.points;
    if (points.size() < 2) continue;
    if (points[0].amplitude > points[1].amplitude) peaks.push_back(points[0]);
    if (points.back().amplitude > points[points.size() - 2].amplitude) peaks.push_back(points.back());
  }
  double highest = 0, excess = -std::numeric_limits<double>::infinity();
  for (const auto& peak : peaks) highest = std::max(highest, peak.amplitude);
  const auto take = [&](double value, double at_least, double at_most) {
    if (std::isfinite(at_most)) excess = std::max(excess, (value - at_most) / std::abs(at_most));
    if (std::isfinite(at_least)) excess = std::max(excess, (at_least - value) / std::abs(at_least));
  };
  for (const auto& peak : peaks)
    for (const auto& limit : search.problem.limits)
      if (peak.amplitude > 0.75 * (1 + 1e-7) * highest)
        take(limit.observable == "frequency"         ? peak.omega / scene::to_rad_per_s(there.frequency_unit)
             : limit.observable == "energy_friction" ? peak.energy_friction
                                                     : peak.elements[0].stick_percent,
             limit.at_least, limit.at_most);
  for (const auto& limit : search.problem.linear_limits) {
    double sum = 0;
    for (const auto& [name, weight] : limit.weights) sum += weight * scene::value(there, name);
    take(sum, limit.at_least, limit.at_most);
  }
  return excess;
}

/// The lowest design that another way comes to where all limits hold.
struct Lowest {
  double amplitude = std::numeric_limits<double>::infinity();
  std::string by;
  std::vector<double> design;
  void take(double other, const std::string& name, const std::vector<double>& at) {
    if (!(other < amplitude)) return;
    amplitude = other;
    by = name;
    design = at;
  }
  void take(const optimize::Optimum& found, const std::string& name) {
    if (found.feasible && !found.design.empty()) take(found.amplitude, name, found.design);
  }
};

/// designs: of each search; evenly over the logarithm where there is one parameter, at random where there are
/// more.
inline Lowest grid(const Search& search, std::uint64_t seed, int designs) {
  Random random(seed + 1000000);
  Lowest lowest;
  optimize::DesignEvaluations evaluations(search.scene, search.problem, {}, false);
  for (int i = 0; i < designs; ++i) {
    std::vector<double> design;
    for (const auto& variable : search.problem.over) {
      const double share =
          search.problem.over.size() == 1 ? static_cast<double>(i) / (designs - 1) : random.share();
      design.push_back(variable.lower * std::pow(variable.upper / variable.lower, share));
    }
    evaluations.evaluate(design, true);
    if (evaluations.formulation().excess() == 0) lowest.take(evaluations.cases().value(), "grid", design);
  }
  return lowest;
}

/// LN_COBYLA and LD_MMA from the lowest of them, too.
inline Lowest from_grid(const Search& search, std::uint64_t seed, int designs) {
  Lowest lowest = grid(search, seed, designs);
  if (lowest.design.empty()) return lowest;
  scene::Scene there = search.scene;
  for (std::size_t k = 0; k < lowest.design.size(); ++k)
    scene::set(there, search.problem.over[k].name, lowest.design[k]);
  for (const std::string algorithm : {"LN_COBYLA", "LD_MMA"})
    lowest.take(
        optimize::optimum(there, search.problem, {.algorithm = algorithm, .certificate = false, .starts = 1}),
        algorithm + " from the grid");
  return lowest;
}

}  // namespace random_limits
