// The multipliers along harmonic balance with 15 harmonics, at random points of the branches of random
// structures with friction, stops, contacts, cubic springs and hysteresis, next to those of the exact motion
// there: by shooting or, with cubic springs or hysteresis, of a motion of 121 harmonics. ARCSLIP_SCENES is
// the number of structures, 10 points each; by default 10.
#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/observables/refined.hpp"
#include "lib/time/periodic/random_contacts.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/stability/stability.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

using namespace arcslip;
using observables::Multipliers;

namespace {

constexpr int points_each = 10;
constexpr double sharp_error = 0.1, rounding = 1e-8;
constexpr double another = 0.03;  // motion: relative distance

std::uint64_t scene_count(std::uint64_t reduced = 10) {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return reduced;
}

enum Kind { friction, stops, contacts, cubic, light, kinds };

// 1 to 6 masses.
scene::Scene random_scene(std::uint64_t seed) {
  using random_scenes::Excitation;
  const auto kind = static_cast<Kind>(seed % kinds);
  scene::Scene s = kind == cubic   ? random_scenes::make_hardening(seed)
                   : kind == light ? random_scenes::hard(seed)
                                   : random_scenes::make(seed, static_cast<Excitation>(seed / kinds % 3));
  s.harmonics.order = 15;
  const double middle = 0.5 * (scenes::window(s).from + scenes::window(s).to);
  if (kind == stops) s = random_contacts::with_stops(s, seed, middle);
  if (kind == contacts) s = random_contacts::with_contacts(s, seed, middle);
  return s;
}

struct Exact {
  Multipliers multipliers;
  double error = 0;
};

// By shooting; nothing where it finds no motion next to this one.
std::optional<Exact> by_shooting(const hbm::HbmProblem& problem, const continuation::Vector& u,
                                 const continuation::Vector& p) {
  const auto equation = time::equation_of_motion(problem.model(), p);
  time::EventDriven integrator(equation);
  const auto start = time::state_of(problem, u, p);
  time::ShootingOptions options;
  options.transients = 0;
  const auto found = time::periodic_motion(integrator, start, options);
  if (!found.converged()) return {};
  const auto size = [&](const time::Vector& x, const time::Vector& v) {
    return std::hypot(x.norm(), v.norm() / p[model::frequency]);
  };
  const auto& there = found.shooting.start;
  if (size(there.x - start.x, there.v - start.v) > another * size(there.x, there.v)) return {};
  return Exact{found.shooting.multipliers};
}

// Those along the motions of 61 and 121 harmonics: their difference is the error of the second.
std::optional<Exact> by_more_harmonics(const hbm::HbmProblem& problem, const continuation::Vector& u,
                                       const continuation::Vector& p) {
  std::optional<Exact> exact;
  for (const auto orders : {refined::orders, {21, 31, 61, 121}}) {
    const auto wide = refined::motion(problem, u, p, orders);
    if (!wide) return {};
    const auto at = wide->problem->hbm_evaluator();
    observables::StabilityAnalysis stability;
    if (at->move_to(wide->u, p, continuation::Needs::jacobian) != continuation::Evaluated::ok ||
        !stability.move_to(*wide->problem, *at, p))
      return {};
    const Multipliers& all = stability.multipliers();
    exact = Exact{all, exact ? observables::distance(all, exact->multipliers) : 0};
  }
  return exact;
}

double difference(const Multipliers& a, const Multipliers& b) {
  return std::max(observables::distance(a, b), observables::distance(b, a));
}

struct Count {
  int points = 0, missing = 0;  // missing: no exact motion was found
  int unstable = 0;             // exact ones
  int sharp = 0, within = 0;    // with an error below 0.1; of these, those within five times of it
  int verdicts = 0, wrong = 0;  // where the largest modulus is further from 1 than its error

  void add(const observables::Stability& found, const std::optional<Exact>& exact) {
    ++points;
    if (!exact) {
      ++missing;
      return;
    }
    const double largest = std::abs(exact->multipliers.front());
    unstable += largest > 1;
    sharp += found.error < sharp_error;
    within += found.error < sharp_error && is_within(found, *exact);
    verdicts += has_verdict(found, *exact);
    wrong += is_wrong(found, *exact);
  }

  static bool is_within(const observables::Stability& found, const Exact& exact) {
    return difference(found.multipliers, exact.multipliers) <= 5 * found.error + exact.error + rounding;
  }
  static bool has_verdict(const observables::Stability& found, const Exact& exact) {
    return std::abs(std::abs(found.multipliers.front()) - 1) > found.error + exact.error + rounding;
  }
  static bool is_wrong(const observables::Stability& found, const Exact& exact) {
    return has_verdict(found, exact) && (found.unstable > 0) != (std::abs(exact.multipliers.front()) > 1);
  }
};

// A motion next to the point, from that of 15 harmonics. Where its multipliers are others, that may be one on
// the other side of a fold: then from the motion of 61 harmonics.
std::optional<Exact> exact_nearby(Kind kind, const hbm::HbmProblem& problem,
                                  const observables::ResponsePoint& point) {
  const auto p = hbm::parameters_at(problem, point.omega);
  const auto u = refined::solution_of(point);
  if (kind == cubic) return by_more_harmonics(problem, u, p);
  const auto exact = by_shooting(problem, u, p);
  const auto& found = *point.stability;
  if (exact && Count::is_within(found, *exact) && !Count::is_wrong(found, *exact)) return exact;
  const auto wide = refined::motion(problem, u, p, refined::orders);
  return wide ? by_shooting(*wide->problem, wide->u, p) : std::nullopt;
}

}  // namespace

TEST_CASE("multipliers with 15 harmonics are as near to the exact ones as their error says", "[numbers]") {
  std::map<Kind, Count> counts;
  std::ostringstream beyond;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    const auto kind = static_cast<Kind>(seed % kinds);
    const scene::Scene s = random_scene(seed);
    auto window = scenes::window(s);
    window.stability = true;
    const auto branch = observables::frequency_response(s, window).front();
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    test_random::Random random(seed);
    // Every other one unstable, where there are any.
    std::vector<const observables::ResponsePoint*> known, unstable;
    for (const auto& point : branch.points) {
      if (!point.stability || !(point.stability->error < HUGE_VAL)) continue;
      known.push_back(&point);
      if (point.stability->unstable > 0) unstable.push_back(&point);
    }
    for (int i = 0; i < points_each && !known.empty(); ++i) {
      const auto& point = *random.of(i % 2 == 1 && !unstable.empty() ? unstable : known);
      const auto exact = exact_nearby(kind, problem, point);
      const auto& found = *point.stability;
      for (const Kind sum : {kind, kinds}) counts[sum].add(found, exact);
      if (!exact || (Count::is_within(found, *exact) && !Count::is_wrong(found, *exact))) continue;
      beyond << "seed " << seed << ", " << point.omega << " rad/s: error "
             << difference(found.multipliers, exact->multipliers) << " next to " << found.error
             << ", modulus " << std::abs(found.multipliers.front()) << " next to "
             << std::abs(exact->multipliers.front()) << (point.truncation_flagged ? ", flagged" : "")
             << (Count::is_wrong(found, *exact) ? ", WRONG\n" : "\n");
    }
  }
  for (const auto& [kind, c] : counts)
    beyond << "kind " << kind << ": " << c.points << " points, " << c.missing << " missing, " << c.unstable
           << " unstable, " << c.sharp << " sharp, " << c.within << " within, " << c.verdicts << " verdicts, "
           << c.wrong << " wrong\n";
  INFO(beyond.str());
  const Count& all = counts[kinds];
  CHECK(all.points == points_each * static_cast<int>(scene_count()));
  CHECK(all.unstable > all.points / 10);
  CHECK(all.missing <= all.points / 50);
  CHECK(all.sharp - all.within <= all.sharp / 500);
  CHECK(all.wrong <= all.verdicts / 1000);
}

namespace {

// A chain of 1 to 3 masses with a wire at the first one, and by chance another one, a damper and a cubic
// spring.
scene::Scene hysteretic_scene(std::uint64_t seed) {
  test_random::Random random(seed);
  const char* const names[] = {"x", "y", "z"};
  const int n = 1 + static_cast<int>(seed % 3);
  std::ostringstream dofs, masses, springs, dampers, elements;
  for (std::ostringstream* text : {&dofs, &masses, &springs, &dampers, &elements}) text->precision(17);
  const auto value = [](std::ostringstream& into, const std::string& name, const std::string& place,
                        double number) {
    into << (into.str().empty() ? "" : ", ") << R"({"name": ")" << name << R"(", )" << place
         << R"(, "value": )" << number << "}";
  };
  for (int i = 0; i < n; ++i) {
    const std::string name = names[i], at = R"("at": ")" + name + R"(")";
    dofs << (i > 0 ? ", " : "") << '"' << name << '"';
    value(masses, "m" + name, at, random.between(0.5, 1.5));
    value(springs, "k" + name, at, random.between(0.2, 1.2));
    value(dampers, "c" + name, at, random.logarithmic(0.01, 0.1));
    if (i > 0)
      value(springs, "l" + name, R"("between": [")" + std::string(names[i - 1]) + R"(", ")" + name + R"("])",
            random.between(0.3, 1));
    if (i == 0 || random.one_in(2))
      elements << (i > 0 ? ", " : "") << R"({"name": "w)" << name << R"(", "type": "bouc_wen", )" << at
               << R"(, "stiffness": )" << random.logarithmic(0.2, 1) << R"(, "elastic_share": )"
               << random.between(0, 0.5) << R"(, "yield_displacement": )" << random.logarithmic(0.1, 1)
               << R"(, "exponent": )" << random.between(1, 4) << R"(, "shape": )" << random.between(0.5, 1)
               << "}";
  }
  if (random.one_in(2))
    elements << R"(, {"name": "cubic", "type": "cubic_spring", "at": "x", "stiffness": )"
             << random.logarithmic(0.05, 0.5) << "}";
  if (random.one_in(3))
    elements << R"(, {"name": "damper", "type": "jenkins", "at": "x", "stiffness": )"
             << random.between(0.1, 0.6) << R"(, "friction_coefficient": 1, "normal_load": )"
             << random.between(0.05, 0.3) << "}";
  auto s =
      scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)" +
                    dofs.str() + R"(], "masses": [)" + masses.str() + R"(], "springs": [)" + springs.str() +
                    R"(], "dampers": [)" + dampers.str() + R"(]}, "elements": [)" + elements.str() +
                    R"(], "excitation": [{"name": "f", "at": "x", "cosine": 0.3}], "response": {"at": "x"},
                         "studies": [{"name": "frf", "kind": "frf", "from": 0.6, "to": 1.8, "stability": true}]})");
  s.harmonics.order = 15;
  return s;
}

}  // namespace

TEST_CASE("with hysteresis, too, multipliers are as near to the exact ones as their error says",
          "[numbers]") {
  Count count;
  std::ostringstream beyond;
  for (std::uint64_t seed = 0; seed < scene_count(3); ++seed) {
    const scene::Scene s = hysteretic_scene(seed);
    const auto branch = observables::frequency_response(s, scenes::window(s)).front();
    CHECK(branch.unknown_stability.empty());
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    test_random::Random random(seed);
    std::vector<const observables::ResponsePoint*> known;
    for (const auto& point : branch.points)
      if (point.stability && point.stability->error < HUGE_VAL) known.push_back(&point);
    REQUIRE(!known.empty());
    for (int i = 0; i < 4; ++i) {
      const auto& point = *random.of(known);
      const auto exact = exact_nearby(cubic, problem, point);
      const auto& found = *point.stability;
      count.add(found, exact);
      if (!exact || (Count::is_within(found, *exact) && !Count::is_wrong(found, *exact))) continue;
      beyond << "seed " << seed << ", " << point.omega << " rad/s: error "
             << difference(found.multipliers, exact->multipliers) << " next to " << found.error << "\n";
    }
  }
  INFO(beyond.str());
  CHECK(count.missing <= count.points / 50);
  CHECK(count.sharp == count.within);
  CHECK(count.sharp > count.points / 2);
  CHECK(count.wrong == 0);
}
