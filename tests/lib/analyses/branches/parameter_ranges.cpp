#include "lib/analyses/branches/parameter_ranges.hpp"

#include "lib/hbm/scenes.hpp"
#include "random.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace parameter_ranges {

using namespace arcslip;
using scene::Scene;
using test_random::Random;

namespace {

const std::string window_name = "window";  // next to the parameters of the scene: a factor of both ends

// One value of a parameter, and of the window its factor.
struct Value {
  std::string parameter;
  double value;
};

void apply(Scene& s, const Value& v) {
  if (v.parameter != window_name) {
    scene::set(s, v.parameter, v.value);
    return;
  }
  auto& range = scenes::window(s);
  range = {range.from * v.value, range.to * v.value};
}

constexpr double roughest = 1e3;  // friction coefficient that still means something

bool allowed(const scene::Field& field, double value) {
  if (field.name == "friction_coefficient" && value > roughest) return false;
  return (field.lower_open ? value > field.lower : value >= field.lower) && value <= field.upper;
}

// Those with a value of their own, which a factor changes.
std::vector<std::string> parameters(const Scene& s) {
  std::vector<std::string> names;
  for (const std::string& each : scene::parameter_names(s))
    if (scene::value(s, each) != 0) names.push_back(each);
  return names;
}

std::vector<std::vector<Value>> values(const Scene& s) {
  constexpr double factors[] = {1e-30, 1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12, 1e30};
  std::vector<std::vector<Value>> all;
  for (const std::string& each : parameters(s)) {
    const scene::Field field = scene::parameter_field(s, each);
    const double own = scene::value(s, each);
    std::vector<Value> of_one;
    if (allowed(field, 0)) of_one.push_back({each, 0});
    for (const double factor : factors)
      if (allowed(field, own * factor)) of_one.push_back({each, own * factor});
    if (allowed(field, -own))
      for (const double factor : {1e-12, 1e-3, 1.0, 1e3, 1e12}) of_one.push_back({each, -own * factor});
    all.push_back(std::move(of_one));
  }
  std::vector<Value> windows;
  for (const double factor : {1e-6, 1e-3, 0.1, 10.0, 1e3, 1e6}) windows.push_back({window_name, factor});
  all.push_back(std::move(windows));
  return all;
}

Named with(const Scene& s, const std::vector<Value>& changes) {
  Named result{"", s};
  std::ostringstream text;
  text.precision(17);
  for (const Value& each : changes) {
    text << (text.tellp() > 0 ? ", " : "") << each.parameter << " = " << each.value;
    apply(result.scene, each);
  }
  result.name = text.str();
  return result;
}

}  // namespace

const char* name(Family family) {
  switch (family) {
    case Family::oscillator:
      return "oscillator";
    case Family::chain:
      return "chain";
    default:
      return "pad";
  }
}

Scene base(Family family) {
  Scene s = family == Family::oscillator ? scenes::paper(7)
            : family == Family::chain    ? scenes::example("unilateral_oscillator")
                                         : scenes::example("rubbing_pad");
  const auto is_response = [](const auto& study) { return study.type->name() == "frf"; };
  const auto study = std::find_if(s.studies.begin(), s.studies.end(), is_response);
  s.studies = {scene::Study(*study)};
  s.studies.front().for_each.clear();
  scenes::window(s).stability = false;
  s.harmonics.order = family == Family::pad ? 5 : 7;
  return s;
}

std::vector<Named> pairs(Family family) {
  const Scene s = base(family);
  const auto all = values(s);
  std::vector<Named> scenes;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const Value& a : all[i]) {
      scenes.push_back(with(s, {a}));
      for (std::size_t j = i + 1; j < all.size(); ++j)
        for (const Value& b : all[j]) scenes.push_back(with(s, {a, b}));
    }
  return scenes;
}

std::vector<Limit> limits() {
  constexpr double huge = 1e90;
  return {{Family::oscillator, "damper.normal_load", 0, "open"},
          {Family::oscillator, "damper.friction_coefficient", 0, "slip"},
          {Family::oscillator, "damper.normal_load", huge, "stick"},
          {Family::chain, "stop.gap", huge, "open"},
          {Family::chain, "stop.gap", -huge, "closed"},
          {Family::pad, "pad.normal_load", -huge, "open"}};
}

std::vector<Named> scenes_of(const Limit& limit) {
  const Scene s = base(limit.family);
  const auto part = [](const std::string& parameter) { return parameter.substr(0, parameter.find('.')); };
  std::vector<Named> scenes;
  for (const auto& of_one : values(s))
    for (const Value& each : of_one) {
      const bool another_limit = each.value == 0 && part(each.parameter) == part(limit.parameter);
      if (each.parameter != limit.parameter && !another_limit)
        scenes.push_back(with(s, {{limit.parameter, limit.value}, each}));
    }
  return scenes;
}

Named random(std::uint64_t seed) {
  Random random(seed);
  const Family family = families[seed % std::size(families)];
  Scene s = base(family);
  for (const std::string& each : parameters(s)) {
    const scene::Field field = scene::parameter_field(s, each);
    const double own = scene::value(s, each);
    const bool vanishes = random.one_in(30) && field.unit != "kg", far = random.one_in(12),
               reversed = random.one_in(2);
    double value = own * (far ? random.logarithmic(1e-12, 1e12) : random.logarithmic(1e-4, 1e4));
    if (!allowed(field, value)) value = own;
    if (vanishes && allowed(field, 0)) value = 0;
    if (reversed && allowed(field, -value)) value = -value;
    scene::set(s, each, value);
  }
  s.harmonics.order = random.count(1, 9);
  auto& range = scenes::window(s);
  const auto& mass = random.of(s.masses);
  const auto& spring = random.of(s.springs);
  const double natural = std::sqrt(spring.values[0] / mass.values[0]) / scene::to_rad_per_s(s.frequency_unit);
  const double middle = random.logarithmic(1e-4, 1e4), width = random.logarithmic(1.1, 10);
  if (random.one_in(2) && natural > 0 && std::isfinite(natural))
    range = {0.3 * natural, 3 * natural};
  else
    range = {range.from * middle, range.from * middle * width};
  scene::check(s);
  return {std::string(name(family)) + ", seed " + std::to_string(seed), std::move(s)};
}

Scene in_units(const Scene& s, double length, double mass, double time) {
  Scene scaled = s;
  const auto factor = [&](std::string_view unit) {
    if (unit == "kg") return mass;
    if (unit == "m") return length;
    if (unit == "N") return mass * length / (time * time);
    if (unit == "N/m") return mass / (time * time);
    if (unit == "N s/m") return mass / time;
    if (unit == "-") return 1.0;
    throw std::invalid_argument("no factor for the unit " + std::string(unit));
  };
  for (auto* parts : {&scaled.masses, &scaled.springs, &scaled.dampers, &scaled.elements, &scaled.excitation})
    for (auto& part : *parts)
      for (std::size_t i = 0; i < part.values.size(); ++i) part.values[i] *= factor(part.fields()[i].unit);
  auto& range = scenes::window(scaled);
  range = {range.from / time, range.to / time};
  return scaled;
}

}  // namespace parameter_ranges
