// A response at several places: the envelope of their amplitudes, whose peaks are peaks.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/frequency_sweep.hpp>
#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using observables::ResponseBranch;
using observables::ResponseEvent;

namespace {

const scene::Direction a = {{0, 1.0}}, b = {{1, 1.0}}, c = {{2, 1.0}}, between = {{0, 1.0}, {1, -1.0}};

// Of the masses a, b and c, of which c is seen by no element.
scene::Scene chain(std::vector<scene::Direction> places, bool even = false) {
  scene::Scene s = scenes::chain(5, even);
  s.responses.resize(1);
  s.responses[0].direction = places.front();
  s.responses[0].others.assign(places.begin() + 1, places.end());
  return s;
}

ResponseBranch response(const scene::Scene& s) {
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].status == observables::Status::complete);
  return branches[0];
}

std::vector<ResponseEvent> peaks(const ResponseBranch& branch) {
  std::vector<ResponseEvent> found;
  std::copy_if(branch.events.begin(), branch.events.end(), std::back_inserter(found),
               [](const ResponseEvent& event) { return event.kind == "peak"; });
  return found;
}

}  // namespace

TEST_CASE("the amplitude of several places is the largest of theirs") {
  for (const bool even : {false, true}) {
    scene::Scene s = chain({a, b, c, between}, even);
    s.responses[0].name = "any";
    s.responses.push_back({"a", a});
    s.responses.push_back({"b", b});
    s.responses.push_back({"c", c});
    s.responses.push_back({"between", between});
    s.responses.push_back({"worst", between, {c, b, a}});
    const ResponseBranch branch = response(s);
    std::vector<int> largest(4);
    for (const auto& point : branch.points) {
      REQUIRE(point.responses.size() == 6);
      const auto begin = point.responses.begin() + 1;
      const auto most = std::max_element(begin, begin + 4, [](const auto& one, const auto& other) {
        return one.amplitude < other.amplitude;
      });
      ++largest[static_cast<std::size_t>(most - begin)];
      for (const auto& all : {point.responses.front(), point.responses.back()}) {
        CHECK(std::abs(all.amplitude / most->amplitude - 1) < 1e-13);
        CHECK(std::abs(all.phase - most->phase) < 1e-11);
        CHECK(std::abs(all.rms / most->rms - 1) < 1e-13);
      }
      CHECK(std::abs(point.amplitude / most->amplitude - 1) < 1e-13);
      CHECK(std::abs(point.rms / most->rms - 1) < 1e-13);
    }
    CHECK(std::count_if(largest.begin(), largest.end(), [](int count) { return count > 5; }) >= 3);
  }
}

TEST_CASE("the peaks of several places are those of each that no other exceeds") {
  const std::vector<scene::Direction> places = {a, b, c};
  const ResponseBranch together = response(chain(places));
  std::vector<ResponseEvent> wanted;
  for (const scene::Direction& place : places) {
    scene::Scene s = chain({place});
    s.responses = {{"followed", place}, {"a", a}, {"b", b}, {"c", c}};
    for (ResponseEvent& peak : peaks(response(s))) {
      const auto& all = peak.point.responses;
      if (std::none_of(all.begin() + 1, all.end(), [&](const auto& other) {
            return other.amplitude > (1 + 1e-9) * peak.point.amplitude;
          }))
        wanted.push_back(std::move(peak));
    }
  }
  auto found = peaks(together);
  REQUIRE(wanted.size() >= 2);
  REQUIRE(found.size() == wanted.size());
  const auto earlier = [](const ResponseEvent& one, const ResponseEvent& other) {
    return one.point.omega < other.point.omega;
  };
  std::sort(wanted.begin(), wanted.end(), earlier);
  std::sort(found.begin(), found.end(), earlier);
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].located);
    CHECK(std::abs(found[i].point.omega / wanted[i].point.omega - 1) < 1e-9);
    CHECK(std::abs(found[i].point.amplitude / wanted[i].point.amplitude - 1) < 1e-12);
    CHECK(std::abs(found[i].point.truncation_change / wanted[i].point.truncation_change - 1) < 1e-6);
    CHECK(std::abs(found[i].point.maxima.velocity / wanted[i].point.maxima.velocity - 1) < 1e-10);
  }
}

TEST_CASE("curves of peaks of several places go through the peaks of their responses") {
  scene::Scene s = chain({c, a, b});
  s.responses.front().name = "any";
  for (const auto& [name, place] : {std::pair("a", a), std::pair("b", b), std::pair("c", c)})
    s.responses.push_back({name, place});
  const observables::CurveRange range{"d1.normal_load", 0.5, 1.2, scenes::window(s).from,
                                      scenes::window(s).to};
  int points = 0, compared = 0;
  for (const auto& curve : observables::resonance_peaks(s, range))
    for (const auto& point : curve.points) {
      if (points++ % 10 != 3) continue;
      // Where two places are equally high, one may exceed the other for less than a step of the response.
      if (std::count_if(point.responses.begin() + 1, point.responses.end(),
                        [&](const auto& each) { return each.amplitude > 0.999 * point.amplitude; }) > 1)
        continue;
      ++compared;
      scene::Scene at = s;
      scene::set(at, range.over, point.over);
      const auto found = peaks(response(at));
      CAPTURE(point.over, point.omega, point.amplitude);
      CHECK(std::any_of(found.begin(), found.end(), [&](const ResponseEvent& peak) {
        return std::abs(peak.point.omega / point.omega - 1) < 1e-6 &&
               std::abs(peak.point.amplitude / point.amplitude - 1) < 1e-9;
      }));
    }
  CHECK(compared > 3);
}

TEST_CASE("the root mean square, velocity and acceleration of a response are those of its history") {
  scene::Scene s = chain({between}, true);
  s.responses[0].name = "stretch";
  s.responses.push_back({"worst", a, {b, c}});
  const ResponseBranch branch = response(s);
  const auto found = peaks(branch);
  REQUIRE_FALSE(found.empty());
  const auto& point = found.front().point;
  const auto history = observables::history(s, branch, point, observables::even_angles(4096));
  double sum = 0, velocity = 0;
  for (std::size_t i = 0; i < history.angle.size(); ++i) {
    sum += history.displacement[i] * history.displacement[i];
    velocity = std::max(velocity, std::abs(history.velocity[i]));
  }
  const double rms = std::sqrt(sum / static_cast<double>(history.angle.size()));
  CHECK(std::abs(point.rms / rms - 1) < 1e-12);
  CHECK(std::abs(point.responses[0].rms / rms - 1) < 1e-12);
  CHECK(std::abs(point.responses[0].velocity / velocity - 1) < 1e-4);  // of samples
  CHECK(std::abs(point.responses[0].velocity / point.maxima.velocity - 1) < 1e-12);
  CHECK(std::abs(point.responses[0].acceleration / point.maxima.acceleration - 1) < 1e-12);
}

TEST_CASE("a linear response has the velocity and acceleration of its sine") {
  scene::Scene s = chain({a, b, c});
  s.responses[0].name = "any";
  s.elements.clear();
  s.excitation.resize(1);
  const ResponseBranch branch = response(s);
  for (const ResponseEvent& peak : peaks(branch)) {
    const auto& any = peak.point.responses[0];
    CHECK(std::abs(any.rms * std::sqrt(2.0) / any.amplitude - 1) < 1e-12);
    CHECK(std::abs(any.velocity / (peak.point.omega * any.amplitude) - 1) < 1e-12);
    CHECK(std::abs(any.acceleration / (std::pow(peak.point.omega, 2) * any.amplitude) - 1) < 1e-12);
  }
}

TEST_CASE("any blade of a mistuned ring is the one with the largest amplitude") {
  const auto ring = [](const std::string& response) {
    return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"cyclic": {"sectors": 5, "engine_order": 1, "full": true,
                               "mistuning": {"k.value": [1, 1.02, 0.97, 1.01, 0.99]}},
        "dofs": ["d", "b"],
        "masses": [{"name": "md", "at": "d", "value": 2}, {"name": "m", "at": "b", "value": 1}],
        "springs": [{"name": "kd", "between": ["d", {"next": "d"}], "value": 3}, {"name": "kg", "at": "d", "value": 1},
                    {"name": "k", "between": ["b", "d"], "value": 1}],
        "dampers": [{"name": "c", "between": ["b", "d"], "value": 0.02}]},
      "elements": [{"name": "s", "type": "jenkins", "between": ["b", {"next": "b"}], "stiffness": 0.2,
                    "friction_coefficient": 0.3, "normal_load": 1}],
      "excitation": [{"name": "f", "at": "b", "cosine": 1}],
      "harmonics": {"order": 3}, "response": )" +
                         response +
                         R"(, "studies": [{"name": "s", "kind": "frf", "from": 0.7, "to": 1.1}]})");
  };
  const auto any = response(ring(R"({"max_of": [{"repeat": 5, "at": "b{i}"}]})"));
  const auto each = response(ring(R"([{"name": "blade", "at": "b"}])"));
  // Both branches at the first frequency, where they begin.
  double most = 0;
  REQUIRE(each.points.front().responses.size() == 5);
  for (const auto& blade : each.points.front().responses) most = std::max(most, blade.amplitude);
  CHECK(std::abs(any.points.front().amplitude / most - 1) < 1e-10);
  double highest = 0;
  for (const auto& event : any.events)
    if (event.kind == "peak") highest = std::max(highest, event.point.amplitude);
  for (int blade = 1; blade <= 5; ++blade) {
    const auto alone = response(ring(R"({"at": "b)" + std::to_string(blade) + "\"}"));
    for (const auto& event : alone.events)
      if (event.kind == "peak") CHECK(event.point.amplitude < (1 + 1e-9) * highest);
  }
  CHECK(highest > 0);
}

TEST_CASE("motions in time and modes are followed at one place, and say so") {
  const scene::Scene s = chain({a, b});
  const auto motion = observables::motion_in_time(s, {.frequency = 1.1});
  CHECK(motion.status == observables::Status::failed);
  CHECK(motion.stop.reason == observables::reasons::several_places);
  CHECK(motion.stop.message ==
        "the response is the largest of 2 places, and a motion in time is followed at one: name one of them");
  for (const auto& sweep : observables::frequency_sweep(s, {.from = 1, .to = 1.1})) {
    CHECK(sweep.status == observables::Status::failed);
    CHECK(sweep.stop.reason == observables::reasons::several_places);
  }
  auto window = scenes::window(s);
  window.method = observables::ResponseMethod::shooting;
  for (const auto& branch : observables::frequency_response(s, window)) {
    CHECK(branch.status == observables::Status::failed);
    CHECK(branch.stop.reason == observables::reasons::several_places);
  }
  for (const auto& mode : observables::nonlinear_modes(s, {.mode = 1, .from = 0.1, .to = 1})) {
    CHECK(mode.stop.reason == observables::reasons::no_mode);
    CHECK(mode.stop.message.find("the response is the largest of several") != std::string::npos);
  }
}
