// Responses at one frequency.
#include "catch.hpp"
#include "controls.hpp"
#include "random.hpp"

#include "lib/analyses/responses/responses_at.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
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
    CHECK(each.doubt.find("other responses may be missing, since the branch could not be continued: ") == 0);
  // Of branches over a parameter that begin there as well.
  const auto traced = [](double cubic, double force, double frequency) {
    return observables::parameter_response(
               duffing_scene(cubic, force),
               {.over = "f.cosine", .from = force, .to = 1.01 * force, .frequency = frequency})
        .front();
  };
  CHECK(traced(0.1, 0.2, 1.2).doubt.empty());
  const auto doubtful = traced(-0.5, 0.3, 0.5);
  CHECK(doubtful.doubt.starts_with("other responses may be missing, since the branch"));
  CHECK(studies::doubt_of(doubtful) == doubtful.doubt);
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
  const auto stopped = observables::point_responses(scenes::paper(5, 3), {20}, controls::stopped());
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

namespace {

/// One mass, m = k = 1, with one harmonic: f(y) = 0 of y = A^2, f = (9/16) b^2 y^3 + (3/2) b (1 - w^2) y^2 +
/// ((1 - w^2)^2 + c^2 w^2) y - F^2.
struct Duffing {
  double c, b, force;

  long double f(long double w, long double y) const {
    const long double along = 1 - w * w + 0.75L * b * y;
    return (along * along + c * c * w * w) * y - force * force;
  }
  /// Where df/dy = 0, rising; nothing: f rises throughout.
  std::optional<std::pair<long double, long double>> turns(long double w) const {
    const long double d = 1 - w * w, p = 27.0L / 16 * b * b, q = 3.0L * b * d, r = d * d + c * c * w * w;
    const long double discriminant = q * q - 4 * p * r;
    if (!(discriminant > 0) || q > 0) return {};
    const long double root = std::sqrt(discriminant);
    return std::pair((-q - root) / (2 * p), (-q + root) / (2 * p));
  }
  int responses(long double w) const {
    const auto at = turns(w);
    return at && f(w, at->first) > 0 && f(w, at->second) < 0 ? 3 : 1;
  }
  /// The frequency between two where the number of responses changes.
  long double fold(long double a, long double b_) const {
    const int at_a = responses(a);
    for (int k = 0; k < 70; ++k) {
      const long double w = 0.5L * (a + b_);
      (responses(w) == at_a ? a : b_) = w;
    }
    return 0.5L * (a + b_);
  }
};

Duffing any_duffing(test_random::Random& random) {
  const double c = random.logarithmic(0.01, 0.2), b = random.logarithmic(1e-3, 10);
  return {c, b, random.logarithmic(0.05, 1)};
}

scene::Scene scene_of(const Duffing& of) {
  scene::Scene s = duffing_scene(of.b, of.force);
  scene::set(s, "c.value", of.c);
  scene::set(s, "s.stiffness", of.b);
  scene::set(s, "f.cosine", of.force);
  return s;
}

/// The folds between two frequencies, from a grid.
std::vector<double> folds(const Duffing& of, double from, double to) {
  std::vector<double> all;
  constexpr int grid = 4000;
  for (int i = 0; i < grid; ++i) {
    const double a = from + (to - from) * i / grid, b = from + (to - from) * (i + 1) / grid;
    if (of.responses(a) != of.responses(b)) all.push_back(static_cast<double>(of.fold(a, b)));
  }
  return all;
}

}  // namespace

TEST_CASE("next to a fold as many responses are found as the closed form has") {
  const std::uint64_t count = responses_at::near_folds.count();
  std::uint64_t tried = 0;
  for (std::uint64_t seed = 0; tried < count; ++seed) {
    test_random::Random random(seed);
    const Duffing of = any_duffing(random);
    for (const double fold : folds(of, 1.0, 6.0)) {
      const double nearby = random.logarithmic(1e-8, 1e-2) * (random.one_in(2) ? 1 : -1),
                   w = fold * (1 + nearby);
      CAPTURE(seed, of.c, of.b, of.force, fold, nearby);
      const auto found = at(scene_of(of), w);
      CHECK(static_cast<int>(found.size()) == of.responses(w));
      std::set<long> distinct;
      for (const PointResponse& each : found) {
        REQUIRE(each.status == Status::complete);
        const long double y = static_cast<long double>(each.point.amplitude) * each.point.amplitude;
        CHECK(std::abs(static_cast<double>(of.f(w, y))) < 1e-8 * of.force * of.force);
        distinct.insert(std::lround(each.point.amplitude * 1e7));
      }
      CHECK(distinct.size() == found.size());
      ++tried;
    }
  }
}

TEST_CASE("next to a fold of several masses both responses of the fold are found") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "c"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1}, {"name": "mc", "at": "c", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "at": "b", "value": 1}, {"name": "kc", "at": "c", "value": 1}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.0005}, {"name": "cb", "at": "b", "value": 0.001},
                  {"name": "cc", "at": "c", "value": 0.0015}]},
    "elements": [{"name": "n1", "type": "cubic_spring", "between": ["a", "b"], "stiffness": 0.001},
                 {"name": "n2", "type": "cubic_spring", "between": ["b", "c"], "stiffness": 0.001}],
    "excitation": [{"name": "f", "at": "a", "cosine": 0.005}], "response": {"at": "a"}, "harmonics": {"order": 5}})");
  CHECK(at(s, 1.00251174).size() == 3);  // 3e-7 next to the fold
}

TEST_CASE("a response in which a contact sticks throughout is found once, and reports no C++") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
    "structure": {"dofs": ["x1", "y1", "x2", "y2", "xd", "yd"],
      "masses": [{"name": "m_x1", "at": "x1", "value": 1}, {"name": "m_y1", "at": "y1", "value": 1},
        {"name": "m_x2", "at": "x2", "value": 1}, {"name": "m_y2", "at": "y2", "value": 1},
        {"name": "m_xd", "at": "xd", "value": 0.1}, {"name": "m_yd", "at": "yd", "value": 0.1}],
      "springs": [{"name": "k_x1", "at": "x1", "value": 3e5}, {"name": "k_y1", "at": "y1", "value": 3e5},
        {"name": "k_x2", "at": "x2", "value": 3e5}, {"name": "k_y2", "at": "y2", "value": 3e5},
        {"name": "k12x", "between": ["x1", "x2"], "value": 7e5}, {"name": "k12y", "between": ["y1", "y2"], "value": 7e5},
        {"name": "kxy1", "between": ["x1", "y1"], "value": 3e5}, {"name": "kxy2", "between": ["x2", "y2"], "value": 3e5},
        {"name": "kd", "between": ["xd", "yd"], "value": 3e5}],
      "dampers": [{"name": "c_x1", "at": "x1", "value": 20}, {"name": "c_y1", "at": "y1", "value": 20},
        {"name": "c_x2", "at": "x2", "value": 20}, {"name": "c_y2", "at": "y2", "value": 20}]},
    "elements": [
      {"name": "left", "type": "contact_2d",
       "tangential": {"direction": {"xd": 0.8660254037844387, "yd": 0.5, "x1": -0.8660254037844387, "y1": -0.5}},
       "normal": {"direction": {"xd": -0.5, "yd": 0.8660254037844387, "x1": 0.5, "y1": -0.8660254037844387}},
       "tangential_stiffness": 3e5, "normal_stiffness": 3e5, "friction_coefficient": 0.5, "normal_load": 0.001},
      {"name": "right", "type": "contact_2d",
       "tangential": {"direction": {"xd": 0.8660254037844387, "yd": -0.5, "x2": -0.8660254037844387, "y2": 0.5}},
       "normal": {"direction": {"xd": 0.5, "yd": 0.8660254037844387, "x2": -0.5, "y2": -0.8660254037844387}},
       "tangential_stiffness": 3e5, "normal_stiffness": 3e5, "friction_coefficient": 0.5, "normal_load": 0.001}],
    "excitation": [{"name": "f1", "at": "y1", "sine": -20}, {"name": "f2", "at": "x2", "sine": 5},
                   {"name": "press", "at": "yd", "cosine": 120, "harmonic": 0}],
    "response": {"at": "y2"}, "harmonics": {"order": 7}})");
  for (const auto& [hz, amplitude] : {std::pair(162.7, 3.7330e-4), std::pair(217.54, 1.8957e-4)}) {
    CAPTURE(hz);
    const auto found = at(s, hz);
    REQUIRE(found.size() == 1);
    CHECK(found[0].status == Status::complete);
    CHECK(found[0].point.amplitude == Approx(amplitude).epsilon(1e-4));
    CHECK(found[0].stop.message.find("::") == std::string::npos);
    CHECK(found[0].doubt.find("::") == std::string::npos);
  }
}

TEST_CASE("responses that few harmonics do not have are found with more, and none is lost in between") {
  const scene::Scene given = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["d0", "d1", "d2"],
      "masses": [{"name": "m0", "at": "d0", "value": 0.7345615272649901}, {"name": "m1", "at": "d1", "value": 0.26991161055057394},
                 {"name": "m2", "at": "d2", "value": 1.0437999915296694}],
      "springs": [{"name": "k0", "at": "d0", "value": 4.815675419830977}, {"name": "k1", "between": ["d1", "d0"], "value": 2.2534158963189888},
                  {"name": "k2", "between": ["d2", "d1"], "value": 2.43883329812492}, {"name": "kx", "between": ["d0", "d2"], "value": 0.9840162014504937}],
      "dampers": [{"name": "c0", "at": "d0", "value": 0.0022460125365875885}, {"name": "c1", "between": ["d1", "d0"], "value": 0.0011367983510955349},
                  {"name": "c2", "between": ["d2", "d1"], "value": 0.0006003229077337025}]},
    "elements": [{"type": "cubic_spring", "name": "e0", "at": "d0", "stiffness": 0.0007520768894053637},
                 {"type": "jenkins", "name": "e1", "at": "d0", "stiffness": 0.6842262887847775, "friction_coefficient": 0.7,
                  "normal_load": 0.150181392118574}],
    "excitation": [{"name": "f0", "type": "base_acceleration", "cosine": 2.6306004343221225}], "response": {"at": "d1"}})");
  scene::Scene s = given;
  s.harmonics.accuracy = 1e-4;
  s.harmonics.order = 55;
  s.studies = {
      {"point", &studies::point(), scene::Settings::of(observables::PointSettings{.frequency = 1.3}), {}}};
  std::ostringstream text;
  results::write_json(text, studies::run(s));
  const auto found = nlohmann::json::parse(text.str())["responses"];
  // By integration in time 353.5 and 354.1 m besides.
  for (const double amplitude : {4.46396, 353.509, 354.121}) {
    CAPTURE(amplitude);
    CHECK(std::any_of(found.begin(), found.end(), [&](const auto& each) {
      return std::abs(each["amplitude"].template get<double>() / amplitude - 1) < 1e-4;
    }));
  }
  CHECK(found[0]["accuracy"]["orders"].size() > 1);
}

namespace {

/// How many branches begin or end at a frequency.
int ends(const std::vector<observables::ResponseBranch>& branches, double w) {
  int count = 0;
  for (const auto& branch : branches)
    for (const auto* point : {&branch.points.front(), &branch.points.back()})
      if (point->omega == w) ++count;
  return count;
}

}  // namespace

TEST_CASE("a frequency response has all responses at the ends of its window, also within a hysteresis") {
  const std::uint64_t count = responses_at::within_hystereses.count();
  std::uint64_t tried = 0;
  for (std::uint64_t seed = 0; tried < count; ++seed) {
    test_random::Random random(seed);
    const Duffing of = any_duffing(random);
    const auto all = folds(of, 0.3, 6.0);
    if (all.size() != 2) continue;
    const double width = all[1] - all[0], inside = all[0] + width * random.between(0.05, 0.95);
    const bool begins = random.one_in(2);
    scene::Scene s = scene_of(of);
    // More harmonics move the folds by less than a twentieth of a wide hysteresis, and add none within it.
    if (begins && width > 0.1 && random.one_in(3)) s.harmonics.order = 9;
    const observables::FrequencyRange range{.from = begins ? inside : 0.3, .to = begins ? 7.0 : inside};
    const auto branches = observables::frequency_response(s, range);
    CAPTURE(seed, of.c, of.b, of.force, all[0], all[1], inside, begins, s.harmonics.order);
    for (const auto& branch : branches) CHECK(branch.status == Status::complete);
    for (const double w : {range.from, range.to}) CHECK(ends(branches, w) == of.responses(w));
    ++tried;
  }
}

// By integration in time.
TEST_CASE("a window that begins within a hysteresis has both stable motions there") {
  scene::Scene s = scene_of({.c = 0.1, .b = 1, .force = 0.5});
  s.harmonics.order = 9;
  const auto branches = observables::frequency_response(s, {.from = 1.6, .to = 4});
  REQUIRE(branches.size() == 2);
  CHECK(branches[0].points.front().amplitude == Approx(0.337518).epsilon(1e-5));
  CHECK(branches[0].points.back().omega == 4);
  CHECK(branches[1].points.front().omega == 1.6);
  CHECK(branches[1].points.back().omega == 1.6);
  CHECK(std::max(branches[1].points.front().amplitude, branches[1].points.back().amplitude) ==
        Approx(1.591910).epsilon(1e-5));
}

TEST_CASE("a trace over the force has all responses at both ends of its range") {
  int tried = 0;
  for (std::uint64_t seed = 0; tried < 10; ++seed) {
    test_random::Random random(seed);
    const Duffing of = any_duffing(random);
    const auto all = folds(of, 0.3, 6.0);
    if (all.size() != 2) continue;
    const double inside = random.between(all[0], all[1]);
    const observables::ParameterRange range{
        .over = "f.cosine", .from = 1e-3 * of.force, .to = of.force, .frequency = inside};
    const auto branches = observables::parameter_response(scene_of(of), range);
    CAPTURE(seed, of.c, of.b, of.force, inside);
    REQUIRE(branches.size() == 2);  // that from rest, and the fold within the range that is apart from it
    for (const auto& branch : branches) CHECK(branch.status == Status::complete);
    CHECK(branches[1].points.front().over == of.force);
    CHECK(branches[1].points.back().over == of.force);
    CHECK(branches[1].stop.message.starts_with("from another response at f.cosine = "));
    ++tried;
  }
}
