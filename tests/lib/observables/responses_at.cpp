// Responses at one frequency.
#include "catch.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/observables/reasons.hpp>
#include <arcslip/observables/responses_at.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

using namespace arcslip;
using observables::PointResponse;
using observables::Status;

namespace {

std::vector<PointResponse> at(const scene::Scene& s, double frequency) {
  return observables::point_responses(s, {frequency});
}

scene::Scene duffing_scene(double cubic, double force) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": )" +
                       std::to_string(cubic) + R"(}],
    "excitation": [{"name": "f", "at": "x", "cosine": )" +
                       std::to_string(force) + R"(}], "harmonics": {"order": 1}, "response": {"at": "x"}})");
}

}  // namespace

TEST_CASE("a linear response is that of the closed form") {
  const scene::Scene s = duffing_scene(0, 0.3);
  for (const double w : {0.01, 0.9, 1.0, 1.1, 100.0}) {
    const auto found = at(s, w);
    REQUIRE(found.size() == 1);
    CHECK(found[0].status == Status::complete);
    CHECK(found[0].point.omega == w);
    const double amplitude = 0.3 / std::hypot(1 - w * w, 0.05 * w);
    CHECK(std::abs(found[0].point.amplitude / amplitude - 1) < 1e-12);
    CHECK(std::abs(found[0].point.maxima.velocity / (w * amplitude) - 1) < 1e-9);
  }
}

TEST_CASE("where a spring is cubic all three responses are found, each once") {
  const double w = 1.2, c = 0.05, cubic = 0.1, force = 0.2;
  const auto found = at(duffing_scene(cubic, force), w);
  REQUIRE(found.size() == 3);
  std::set<int> sizes;
  for (const PointResponse& each : found) {
    const double a = each.point.amplitude;
    // One harmonic: ((1 - w^2 + 3/4 cubic a^2)^2 + (c w)^2) a^2 = force^2.
    const double along = 1 - w * w + 0.75 * cubic * a * a;
    CHECK(std::abs(std::hypot(along * a, c * w * a) / force - 1) < 1e-9);
    sizes.insert(static_cast<int>(std::lround(10 * a)));
  }
  CHECK(sizes.size() == 3);
  CHECK(at(duffing_scene(cubic, force), 3).size() == 1);
}

TEST_CASE(
    "where the branch through the frequency cannot be followed, responses may be missing, and it is said") {
  for (const PointResponse& each : at(duffing_scene(0.1, 0.2), 1.2)) CHECK(each.doubt.empty());
  const auto found = at(duffing_scene(-0.5, 0.3), 0.5);  // the spring pulls apart beyond x = 1.4
  REQUIRE_FALSE(found.empty());
  for (const PointResponse& each : found)
    CHECK(each.doubt.find("other responses may be missing, since the branch from a quarter") == 0);
}

TEST_CASE("between folds at kinks a response is found for each passage of the frequency response") {
  const scene::Scene s = scenes::example("gap_limited_chain");
  const auto& window = scenes::window(s);
  const auto branch = observables::frequency_response(s, {window.from, window.to}).at(0);
  REQUIRE(branch.status == Status::complete);
  for (const double omega : {1.3, 1.55, 1.6, 1.627, 1.65}) {
    // Over the folds, too, which lie between points.
    std::size_t passages = 0, event = 0;
    double last = branch.points.front().omega;
    const auto go_to = [&](double next) {
      passages += (last < omega) != (next < omega);
      last = next;
    };
    for (std::size_t k = 0; k < branch.points.size(); ++k) {
      go_to(branch.points[k].omega);
      for (; event < branch.events.size() && branch.events[event].after == k; ++event)
        go_to(branch.events[event].point.omega);
    }
    const auto found = at(s, omega);
    CAPTURE(omega);
    CHECK(found.size() == passages);
    CHECK(found[0].doubt.empty());
  }
}

TEST_CASE("a response at one frequency is the point of the frequency response there") {
  const scene::Scene s = scenes::paper(31, 3);
  const auto found = at(s, 20);
  REQUIRE(found.size() == 1);
  const observables::ResponsePoint& point = found[0].point;
  const auto branches = observables::frequency_response(s, {20, 20.5});
  const observables::ResponsePoint& first = branches.at(0).points.at(0);
  CHECK(first.omega == point.omega);
  CHECK(std::abs(point.amplitude / first.amplitude - 1) < 1e-10);
  CHECK(std::abs(point.elements[0].stick_percent - first.elements[0].stick_percent) < 1e-7);
  CHECK(std::abs(point.energy_input / point.energy_total() - 1) < 1e-9);
  CHECK(std::isnan(first.maxima.velocity));
  CHECK(point.maxima.velocity > 0);
  CHECK(found[0].harmonics.size() * 2 == point.coefficients.size());
  CHECK(found[0].parameters.size() == branches[0].parameters.size());
}

TEST_CASE(
    "the history of a response is closed, as high as its amplitude, and its loop is what friction takes") {
  const auto found = observables::point_responses(scenes::paper(31, 3), {20, 4000});
  const PointResponse& response = found.at(0);
  const observables::History& history = response.history;
  REQUIRE(history.angle.size() > 4000);
  CHECK(std::is_sorted(history.angle.begin(), history.angle.end()));
  const double amplitude = response.point.amplitude;
  CHECK(std::abs(history.displacement.back() - history.displacement.front()) < 1e-12 * amplitude);
  double highest = 0, loop = 0;
  for (const double x : history.displacement) highest = std::max(highest, std::abs(x));
  CHECK(highest <= amplitude * (1 + 1e-12));
  CHECK(highest > amplitude * (1 - 1e-6));
  const auto& damper = history.elements.at(0);
  for (std::size_t i = 1; i < damper.force.size(); ++i)
    loop +=
        (damper.force[i] + damper.force[i - 1]) / 2 * (damper.displacement[i] - damper.displacement[i - 1]);
  CHECK(std::abs(loop / response.point.energy_friction - 1) < 1e-6);
}

TEST_CASE("no response, and why: it is unbounded, or nobody wanted it") {
  scene::Scene undamped = scenes::paper(5, 3);
  scene::set(undamped, "c.value", 0);
  scene::set(undamped, "damper.normal_load", 0);
  const double resonance = std::sqrt(17890 / 1.24) / (2 * 3.14159265358979323846);
  const auto none = at(undamped, resonance);
  REQUIRE(none.size() == 1);
  CHECK(none[0].status == Status::failed);
  CHECK(none[0].stop.reason == observables::reasons::unbounded);
  CHECK(none[0].stop.message.find("no response is bounded at ") == 0);
  const auto stopped =
      observables::point_responses(scenes::paper(5, 3), {20}, [](const auto&) { return false; });
  REQUIRE(stopped.size() == 1);
  CHECK(stopped[0].status == Status::stopped);
  CHECK(stopped[0].stop.reason == observables::reasons::user);
  CHECK(stopped[0].history.angle.empty());
}

TEST_CASE("a study of kind point gives all of each response in JSON, and none of one that is not there") {
  scene::Scene s = scenes::paper(5, 3);
  s.studies = {{"at 20",
                &studies::point(),
                scene::Settings::of(observables::PointSettings{20, 10}),
                {{"damper.normal_load", {1, 3}}}}};
  std::ostringstream text;
  results::write_json(text, studies::run(s));
  const auto json = nlohmann::json::parse(text.str());
  CHECK(json["format"] == "arcslip-responses-1");
  REQUIRE(json["responses"].size() == 2);
  const auto& one = json["responses"][1];
  CHECK(one["study"] == "at 20");
  CHECK(one["set"]["damper.normal_load"] == 3);
  CHECK_FALSE(one["parameters"].contains("damper.normal_load"));
  CHECK(one["stop"]["reason"] == "solved");
  for (const char* key : {"amplitude", "phase", "energy_friction", "maxima", "force_per_displacement",
                          "coefficients", "harmonics", "truncation_estimate", "solver"})
    CHECK(one.contains(key));
  CHECK(one["elements"]["damper"].contains("theta_0"));
  const auto& history = one["history"];
  for (const char* key : {"time", "angle", "displacement", "velocity"})
    CHECK(history[key].size() == history["elements"]["damper"]["force"].size());
  CHECK(history["angle"].size() > 10);

  scene::set(s, "c.value", 0);
  s.studies[0].for_each.clear();
  scene::set(s, "damper.normal_load", 0);
  s.studies[0].settings.as<observables::PointSettings>().frequency =
      std::sqrt(17890 / 1.24) / (2 * 3.14159265358979323846);
  std::ostringstream other;
  results::write_json(other, studies::run(s));
  const auto none = nlohmann::json::parse(other.str())["responses"][0];
  CHECK(none["status"] == "failed");
  CHECK_FALSE(none.contains("amplitude"));
  CHECK(none["history"]["time"].empty());
}
