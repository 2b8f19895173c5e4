#include "lib/analyses/branches/invariances.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <sstream>

namespace invariances {

using namespace arcslip;
using scene::Part;
using scene::Scene;

namespace {

bool is_friction(const Part& element) {
  return element.type == &elements::jenkins();
}

void shuffle(std::vector<Part>& parts, std::mt19937_64& bits) {
  for (std::size_t i = parts.size(); i > 1; --i) std::swap(parts[i - 1], parts[bits() % i]);
}

Variant of(std::string name, const Scene& s, double factor) {
  Variant variant{std::move(name), s};
  int exponent = 0;
  variant.powers_of_two = std::frexp(factor, &exponent) == 0.5;
  return variant;
}

void add(Response& result, observables::Observer& observer, const continuation::Accepted& now,
         const continuation::Event* event, const Variant& variant) {
  const double amplitude =
      observer.extreme(static_cast<const hbm::HbmEvaluator&>(now.at), now.u).amplitude / variant.amplitude;
  Seen seen{"point", false, true, now.parameter / variant.frequency, amplitude};
  if (event) {
    seen.kind = event->monitor;
    seen.nonsmooth = event->nonsmooth;
    seen.located = event->located;
  }
  (event ? result.events : result.points).push_back(std::move(seen));
}

std::string with(const char* what, double factor) {
  std::ostringstream text;
  text << what << " " << factor;
  return text.str();
}

}  // namespace

Variant larger(const Scene& s, double factor) {
  Variant variant = of(with("larger", factor), s, factor);
  variant.amplitude = factor;
  for (Part& force : variant.scene.excitation)
    for (double& value : force.values) value *= factor;
  for (Part& element : variant.scene.elements)
    if (is_friction(element))
      element.values[2] *= factor;
    else
      element.values[0] /= factor * factor;
  return variant;
}

Variant heavier(const Scene& s, double factor) {
  Variant variant = of(with("heavier", factor), s, factor);
  Scene& v = variant.scene;
  for (auto* parts : {&v.masses, &v.springs, &v.dampers, &v.excitation})
    for (Part& part : *parts)
      for (double& value : part.values) value *= factor;
  for (Part& element : v.elements) {
    element.values[0] *= factor;
    if (is_friction(element)) element.values[2] *= factor;
  }
  return variant;
}

Variant faster(const Scene& s, double factor) {
  Variant variant = of(with("faster", factor), s, factor);
  variant.frequency = factor;
  for (Part& mass : variant.scene.masses) mass.values[0] /= factor * factor;
  for (Part& damper : variant.scene.dampers) damper.values[0] /= factor;
  observables::FrequencyRange& range = scenes::window(variant.scene);
  range = {range.from * factor, range.to * factor};
  return variant;
}

Variant backwards(const Scene& s) {
  Variant variant{"backwards", s};
  variant.backwards = true;
  return variant;
}

Variant reordered(const Scene& s, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  Variant variant{"reordered", s};
  Scene& v = variant.scene;
  std::vector<int> place(s.dofs.size());
  std::iota(place.begin(), place.end(), 0);
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[bits() % i]);
  for (std::size_t i = 0; i < place.size(); ++i)
    v.dofs[static_cast<std::size_t>(place[i])] = "dof " + std::to_string(i);
  int parts_so_far = 0;
  for (auto* parts : {&v.masses, &v.springs, &v.dampers, &v.elements, &v.excitation}) {
    const bool has_sign = parts == &v.excitation;
    for (Part& part : *parts) {
      part.name = "part " + std::to_string(parts_so_far++);
      const bool turned = !has_sign && bits() % 2 == 0;
      auto& direction = part.directions.front();
      for (auto& term : direction) {
        term.dof = place[static_cast<std::size_t>(term.dof)];
        if (turned) term.weight = -term.weight;
      }
      std::reverse(direction.begin(), direction.end());
    }
    shuffle(*parts, bits);
  }
  for (auto& term : v.response()) term.dof = place[static_cast<std::size_t>(term.dof)];
  return variant;
}

Variant split(const Scene& s, std::size_t element) {
  Variant variant{"split " + std::to_string(element), s};
  auto& elements = variant.scene.elements;
  elements[element].values[0] /= 2;
  elements[element].values[2] /= 2;
  Part half = elements[element];
  half.name += " again";
  elements.push_back(std::move(half));
  return variant;
}

std::vector<Variant> all(const Scene& s, std::uint64_t seed) {
  std::vector<Variant> variants;
  for (const double factor : {0x1p-20, 0x1p10, 10.0, 1e3, 1e-6, 0.7}) variants.push_back(larger(s, factor));
  for (const double factor : {0x1p9, 1e-3}) variants.push_back(heavier(s, factor));
  for (const double factor : {0x1p3, 0x1p-5, 10.0, 0.7}) variants.push_back(faster(s, factor));
  variants.push_back(backwards(s));
  variants.push_back(reordered(s, seed));
  variants.push_back(reordered(s, seed + 1));
  for (std::size_t e = 0; e < s.elements.size(); ++e)
    if (is_friction(s.elements[e])) variants.push_back(split(s, e));
  return variants;
}

Response response(const Variant& variant) {
  const auto& range = scenes::window(variant.scene);
  const double unit = scene::to_rad_per_s(variant.scene.frequency_unit);
  const observables::FrequencyWindow window{range.from * unit, range.to * unit};
  Response result;
  const auto record = [&](observables::Observer& observer, const continuation::Accepted& now,
                          const continuation::Event* event) {
    add(result, observer, now, event, variant);
    return true;
  };
  result.stop = observables::frequency_branch(
                    std::make_shared<const model::Model>(model::build(variant.scene)), window,
                    variant.backwards ? window.upper : window.lower, record, variant.backwards ? -1 : 1)
                    .branch.stop;
  if (variant.backwards) {
    std::reverse(result.events.begin(), result.events.end());
    std::reverse(result.points.begin(), result.points.end());
  }
  return result;
}

Response response(const Scene& s) {
  return response(Variant{"as it is", s});
}

Response in_short_steps(const Scene& s) {
  const auto& range = scenes::window(s);
  const double unit = scene::to_rad_per_s(s.frequency_unit);
  const double lower = range.from * unit, upper = range.to * unit, width = upper - lower;
  Response result;
  const auto first =
      observables::first_response(std::make_shared<const model::Model>(model::build(s)), lower, width);
  if (!first.u) {
    result.stop.reason = continuation::StopReason::start_failed;
    return result;
  }
  continuation::Options options;
  options.lower = lower;
  options.upper = upper;
  options.check_jacobian = false;
  options.largest_state = 1e8;
  options.step.largest_parameter = width / 1500;
  options.step.relative_parameter = 0.005;
  options.step.curve_tolerance = 1e-8;
  options.step.angle = 0.05;
  const auto observer = std::make_shared<observables::Observer>(first.problem);
  const Variant as_it_is{"as it is", s};
  result.stop = continuation::trace(
                    first.problem, {*first.u, hbm::parameters_at(*first.problem, lower), model::frequency, 1},
                    options, {observables::peak_monitor(observer), continuation::fold_monitor()},
                    [&](const continuation::Accepted& now, const continuation::Event* event) {
                      add(result, *observer, now, event, as_it_is);
                      return true;
                    })
                    .stop;
  return result;
}

std::string difference(const Response& one, const Response& other, double tolerance) {
  std::ostringstream text;
  text.precision(12);
  if (one.stop.reason != other.stop.reason)
    text << name(one.stop.reason) << " and " << name(other.stop.reason) << "; ";
  const auto tell = [&](const Seen& seen) {
    text << seen.kind << (seen.nonsmooth ? " (nonsmooth)" : "") << (seen.located ? "" : " (not located)")
         << " at " << seen.omega << ": " << seen.amplitude;
  };
  const auto near = [](double a, double b, double by) { return std::abs(a - b) <= by * std::abs(b); };
  std::vector<bool> found(other.events.size());
  for (const Seen& seen : one.events) {
    std::size_t nearest = other.events.size();
    for (std::size_t k = 0; k < other.events.size(); ++k)
      if (!found[k] && other.events[k].kind == seen.kind &&
          (nearest == other.events.size() ||
           std::abs(other.events[k].omega - seen.omega) < std::abs(other.events[nearest].omega - seen.omega)))
        nearest = k;
    if (nearest == other.events.size() || !near(other.events[nearest].omega, seen.omega, 1e-5)) {
      text << "missing: ";
      tell(seen);
      text << "; ";
      continue;
    }
    found[nearest] = true;
    const Seen& same = other.events[nearest];
    if (near(same.omega, seen.omega, tolerance) && near(same.amplitude, seen.amplitude, tolerance) &&
        same.nonsmooth == seen.nonsmooth && same.located && seen.located)
      continue;
    text << "other: ";
    tell(seen);
    text << " is ";
    tell(same);
    text << "; ";
  }
  for (std::size_t k = 0; k < other.events.size(); ++k) {
    if (found[k]) continue;
    text << "only in the variant: ";
    tell(other.events[k]);
    text << "; ";
  }
  return text.str();
}

}  // namespace invariances
