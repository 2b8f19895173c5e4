#pragma once
// Scenes of the folder reports, their studies, and what is looked up in their results.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace reports {

using namespace arcslip;
using Json = nlohmann::json;
using Parts = std::vector<std::pair<double, double>>;

/// A number of another method, in the digits that are right.
struct Right {
  Right(const char* digits) : value(std::strtod(digits, nullptr)) {
    const std::string text = digits;
    const std::size_t e = std::min(text.find('e'), text.size()), point = std::min(text.find('.'), e);
    const int exponent = e < text.size() ? std::stoi(text.substr(e + 1)) : 0;
    const int decimals = point < e ? static_cast<int>(e - point) - 1 : 0;
    half_digit = 0.5 * std::pow(10.0, exponent - decimals);
  }
  double value, half_digit = 0;
};

/// estimate: of the error by the harmonics left out; null: there is none.
inline void check(const Json& value, const Right& right, const Json& estimate = {}) {
  const double error = estimate.is_number() ? estimate.get<double>() : 0;
  REQUIRE(value.is_number());
  const double found = value;
  REQUIRE(error <= 0.01 * std::abs(right.value) + right.half_digit);
  CAPTURE(found, right.value, right.half_digit, error);
  CHECK(std::abs(found - right.value) <= 1.0001 * right.half_digit + 2 * error);
}

inline scene::Scene scene_of(const std::string& name) {
  return scene::read_file(source_folder() + "/tests/lib/studies/reports/" + name + ".json",
                          test_catalogue::whole());
}

/// With its studies of one kind.
inline scene::Scene scene_of(const std::string& name, const scene::StudyType& kind) {
  scene::Scene s = scene_of(name);
  std::erase_if(s.studies, [&](const scene::Study& study) { return study.type != &kind; });
  REQUIRE(!s.studies.empty());
  return s;
}

template <class S>
scene::Scene with_study(scene::Scene s, const scene::StudyType& type, S settings) {
  s.studies = {{"study", &type, scene::Settings::of(std::move(settings)), {}}};
  return s;
}

inline scene::Scene at_frequency(const std::string& name, double frequency) {
  return with_study(scene_of(name), studies::point(), observables::PointSettings{.frequency = frequency});
}

inline scene::Scene mode_of(const std::string& name, double from, double to) {
  return with_study(scene_of(name), studies::modes(), observables::ModeRange{1, from, to});
}

inline Json all_of(const results::Results& found) {
  std::ostringstream text;
  results::write_json(text, found);
  return Json::parse(text.str());
}
inline Json branches_of(const scene::Scene& s) {
  return all_of(studies::run(s))["branches"];
}
inline Json responses_at(const scene::Scene& s) {
  return all_of(studies::run(s))["responses"];
}

/// Complete, to the end of the window or of the range.
inline void check_complete(const Json& branch) {
  CAPTURE(branch["stop"].dump());
  CHECK(branch["status"] == "complete");
  CHECK(branch["stop"]["reason"] == observables::reasons::boundary.code);
}

inline long count(const Json& branch, const std::string& kind) {
  const Json& events = branch["events"];
  return std::count_if(events.begin(), events.end(), [&](const Json& each) { return each["kind"] == kind; });
}

/// The event of a kind, or the point, next to a value of a column.
inline const Json& nearest(const Json& list, const std::string& column, double value,
                           const std::string& kind = {}) {
  const Json* found = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Json& each : list) {
    const auto at = each.find(column);
    if ((!kind.empty() && each["kind"] != kind) || at == each.end() || !at->is_number()) continue;
    const double away = std::abs(at->get<double>() - value);
    if (away < least) least = away, found = &each;
  }
  REQUIRE(found);
  return *found;
}

inline Json highest_peak(const Json& branch) {
  Json highest;
  for (const Json& event : branch["events"])
    if (event["kind"] == "peak" && (highest.is_null() || event["amplitude"] > highest["amplitude"]))
      highest = event;
  REQUIRE(highest.is_object());
  return highest;
}

/// "unstable from 0.89 to 0.86, from ... rad/s" of what is reported about a branch.
inline Parts unstable_parts(const std::string& remark) {
  Parts parts;
  const std::string::size_type at = remark.find("unstable ");
  if (at == std::string::npos) return parts;
  const std::string reported = remark.substr(at, remark.find(" rad/s", at) - at);
  const std::regex part("from ([0-9.e-]+) to ([0-9.e-]+)");
  for (auto each = std::sregex_iterator(reported.begin(), reported.end(), part);
       each != std::sregex_iterator(); ++each)
    parts.emplace_back(std::stod((*each)[1]), std::stod((*each)[2]));
  return parts;
}

inline std::vector<double> moduli(const Json& multipliers) {
  std::vector<double> all;
  for (const Json& each : multipliers)
    all.push_back(std::hypot(each[0].get<double>(), each[1].get<double>()));
  std::sort(all.begin(), all.end());
  return all;
}

/// Where a function that changes its sign between two places is zero.
template <class F>
double zero_of(const F& f, double lower, double upper) {
  const bool rises = f(upper) > 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (lower + upper);
    ((f(middle) > 0) == rises ? upper : lower) = middle;
  }
  return 0.5 * (lower + upper);
}

struct Event {
  const char* kind;
  Right frequency;
  const char* amplitude = nullptr;
};

/// Events of a branch: all of these kinds, but for peaks, of which some are listed.
struct Response {
  const char* scene;
  std::size_t branch;
  std::vector<Event> events;
  double force = 0;  // if not 0: the first branch from `branch` on at this force
};

inline void check_events(const Json& branch, const std::vector<Event>& events) {
  for (const Event& event : events) {
    CAPTURE(event.kind, event.frequency.value);
    const Json& found = nearest(branch["events"], "frequency", event.frequency.value, event.kind);
    check(found["frequency"], event.frequency, found.value("location_estimate", Json()));
    if (event.amplitude) check(found["amplitude"], event.amplitude, found["truncation_estimate"]);
    if (std::string(event.kind) == "peak") continue;
    CHECK(count(branch, event.kind) == std::count_if(events.begin(), events.end(), [&](const Event& each) {
            return std::string(each.kind) == event.kind;
          }));
  }
}

}  // namespace reports
