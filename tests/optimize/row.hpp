#pragma once
// A row of equal masses with a damper of friction to the ground at some of them.

#include "lib/hbm/scenes.hpp"

#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>

/// 1 kg each, springs of 20 kN/m and dampers of 0.3 N s/m from the ground on, forced with 1 N at the first,
/// observed at the last; Jenkins elements d0, d1 ... of 4 kN/m and mu = 0.5 with 2 N, spread over the masses.
inline arcslip::scene::Scene row(int masses, int dampers, int order) {
  const auto list = [](int count, auto part) {
    std::string text;
    for (int i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + part(i);
    return text;
  };
  const auto at = [](int i) { return "\"x" + std::to_string(i) + "\""; };
  const auto link = [&](const std::string& name, const std::string& value) {
    return list(masses, [&, name, value](int i) {
      return "{\"name\": \"" + name + std::to_string(i) + "\", \"between\": [" + at(i) + ", " +
             (i > 0 ? at(i - 1) : "\"ground\"") + "], \"value\": " + value + "}";
    });
  };
  const auto mass = [&](int i) {
    return "{\"name\": \"m" + std::to_string(i) + "\", \"at\": " + at(i) + ", \"value\": 1}";
  };
  const auto element = [&](int i) {
    const int place = std::min(masses - 1, i * masses / dampers + (masses > dampers ? 1 : 0));
    return "{\"name\": \"d" + std::to_string(i) + "\", \"type\": \"jenkins\", \"at\": " + at(place) +
           ", \"stiffness\": 4000, \"friction_coefficient\": 0.5, \"normal_load\": 2}";
  };
  return scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": "Hz", "structure": {"dofs": [)" + list(masses, at) +
      "], \"masses\": [" + list(masses, mass) + "], \"springs\": [" + link("k", "20000") +
      "], \"dampers\": [" + link("c", "0.3") + "]}, \"elements\": [" + list(dampers, element) +
      R"(], "excitation": [{"name": "f", "at": "x0", "cosine": 1}], "harmonics": {"order": )" +
      std::to_string(order) + R"(}, "response": {"at": "x)" + std::to_string(masses - 1) +
      R"("}, "studies": [{"kind": "frf", "from": 2, "to": 60}]})");
}

/// Over the loads of all dampers, in a window of the frequency.
inline arcslip::optimize::OptimumProblem over_loads(int dampers, double from, double to) {
  arcslip::optimize::OptimumProblem problem{{}, from, to};
  for (int i = 0; i < dampers; ++i)
    problem.over.push_back({"d" + std::to_string(i) + ".normal_load", 0.05, 50});
  return problem;
}

/// The highest peak in a frequency response of its own.
inline double highest_peak(arcslip::scene::Scene s, const std::vector<double>& loads, double from,
                           double to) {
  for (std::size_t i = 0; i < loads.size(); ++i)
    arcslip::scene::set(s, "d" + std::to_string(i) + ".normal_load", loads[i]);
  scenes::window(s).from = from;
  scenes::window(s).to = to;
  double most = 0;
  for (const auto& branch : arcslip::observables::frequency_response(s, scenes::window(s)))
    for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
  return most;
}
