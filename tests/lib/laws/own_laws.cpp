// Laws that stand in no file of the library work in scenes, studies, time and optimisation.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/coupled_spring.hpp"
#include "lib/laws/polynomial.hpp"
#include "lib/laws/table_spring.hpp"
#include "lib/laws/two_sliders.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/scene/format/scene_file.hpp>
#include <arcslip/time/newmark/newmark_periods.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <memory>

using namespace arcslip;
using continuation::Vector;

namespace {

const own_laws::CoupledSpring coupled_spring;
const own_laws::PolynomialType polynomial_type;
const own_laws::TableType table_spring;
const own_laws::TwoSliders two_sliders;

scene::Catalogue catalogue() {
  auto all = test_catalogue::whole();
  for (const scene::PartType* law : std::initializer_list<const scene::PartType*>{
           &coupled_spring, &polynomial_type, &table_spring, &two_sliders})
    all.elements.push_back(scene::lasting(*law));
  return all;
}

scene::Scene read_with_own_laws(const std::string& text) {
  std::istringstream in(text);
  return scene::read(in, catalogue());
}

// Two masses alike, each on its spring, with a coupled spring over both.
std::string plane(const std::string& forces, const std::string& response) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 1}],
      "springs": [{"name": "kx", "at": "x", "value": 1}, {"name": "ky", "at": "y", "value": 1}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.1}, {"name": "cy", "at": "y", "value": 0.1}]},
    "elements": [{"name": "spring", "type": "coupled_spring", "first": {"at": "x"}, "second": {"at": "y"},
                  "stiffness": 0.7}],
    "excitation": [)" +
         forces + R"(],
    "harmonics": {"order": 5}, "response": )" +
         response + R"(,
    "studies": [{"name": "frf", "kind": "frf", "from": 0.4, "to": 2.5}]})";
}

const std::string circular =
    R"({"name": "fx", "at": "x", "cosine": 0.3}, {"name": "fy", "at": "y", "sine": 0.3})";

void check_jacobian(const scene::Scene& s, double omega, double size, unsigned seed) {
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  std::srand(seed);
  const Vector u = size * Vector::Random(problem.size());
  const auto check = continuation::check_jacobian(problem, u, hbm::parameters_at(problem, omega));
  CHECK(check.message == "");
}

}  // namespace

TEST_CASE(
    "scenes and models share the laws of a catalogue that is gone, and nothing holds them after these") {
  std::weak_ptr<const scene::PartType> law;
  scene::Scene first;
  {
    const auto own = std::make_shared<const own_laws::CoupledSpring>();
    law = own;
    scene::Catalogue all = test_catalogue::whole();
    all.elements.push_back(own);
    std::istringstream in(plane(circular, R"({"at": "x"})"));
    first = scene::read(in, all);
  }
  scene::check(first);
  scene::Scene second = scene::with_keys(first, 0, {{"to", {1.5}}});
  CHECK(scenes::window(second).to == 1.5);
  first = {};
  auto model = std::make_shared<const model::Model>(model::build(second));
  second = {};
  REQUIRE_FALSE(law.expired());
  CHECK(model->elements[0].law->directions() == 2);
  model.reset();
  CHECK(law.expired());
}

TEST_CASE("a law of two directions follows its closed form: in a circle its stiffness is k a^2") {
  const scene::Scene s = read_with_own_laws(plane(circular, R"({"at": "x"})"));
  check_jacobian(s, 0.9, 1, 1);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].status == observables::Status::complete);
  double most = 0;
  for (const auto& point : branches[0].points) {
    const double a = point.amplitude, w = point.omega;
    const double force = a * std::hypot(1 + 0.7 * a * a - w * w, 0.1 * w);
    CHECK(std::abs(force - 0.3) < 1e-11);
    most = std::max(most, a);
  }
  CHECK(most > 1);
  // and the peak, where d/dw of the squared force vanishes at constant a
  for (const auto& event : branches[0].events)
    if (event.kind == "peak") {
      const double a = event.point.amplitude, w = event.point.omega;
      CHECK(std::abs(-2 * (1 + 0.7 * a * a - w * w) + 0.01) < 1e-9);
    }
}

TEST_CASE("along one line of the plane the coupled spring is a cubic spring") {
  const double angle = 0.7, c = std::cos(angle), n = std::sin(angle);
  const auto number = [](double value) { return nlohmann::json(value).dump(); };
  const std::string force =
      R"({"name": "f", "direction": {"x": )" + number(c) + R"(, "y": )" + number(n) + R"(}, "cosine": 0.3})";
  const scene::Scene s = read_with_own_laws(
      plane(force, R"({"direction": {"x": )" + number(c) + R"(, "y": )" + number(n) + "}}"));
  const scene::Scene duffing = read_with_own_laws(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "h", "type": "cubic_spring", "at": "x", "stiffness": 0.7}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3}], "harmonics": {"order": 5}})");
  for (const double w : {0.7, 1.1, 1.3}) {
    const auto plane_responses = observables::point_responses(s, {.frequency = w});
    const auto responses = observables::point_responses(duffing, {.frequency = w});
    // In the plane there may be others, out of that line.
    REQUIRE(plane_responses.size() >= responses.size());
    for (const auto& response : responses)
      CHECK(std::any_of(plane_responses.begin(), plane_responses.end(), [&](const auto& other) {
        return other.status == observables::Status::complete &&
               std::abs(other.point.amplitude - response.point.amplitude) < 1e-10 &&
               std::abs(other.point.energy_viscous - response.point.energy_viscous) < 1e-10;
      }));
  }
}

TEST_CASE("in time a law of two directions comes to the same circle at second order, and keeps its energy") {
  const scene::Scene s = read_with_own_laws(plane(circular, R"({"at": "x"})"));
  const double w = 0.8;
  const auto responses = observables::point_responses(s, {.frequency = w});
  REQUIRE(responses.size() == 1);
  double last = 0;
  for (const int steps : {100, 200, 400}) {
    const auto motion = observables::motion_in_time(
        s, {.frequency = w, .method = observables::TimeMethod::newmark_shooting, .steps = steps});
    REQUIRE(motion.status == observables::Status::complete);
    const double error = std::abs(motion.amplitude / responses[0].point.amplitude - 1);
    if (last > 0) CHECK(error < 0.3 * last);
    last = error;
    CHECK(std::abs(motion.energy.defect()) < 1e-12);
  }
  CHECK(last < 1e-4);
  const auto exact =
      observables::motion_in_time(s, {.frequency = w, .method = observables::TimeMethod::event_driven});
  CHECK(exact.status == observables::Status::failed);
  CHECK(exact.stop.message.find("\"spring\"") != std::string::npos);
}

TEST_CASE(
    "the derivatives of a period in steps are those of its differences, with a memory that is no slider") {
  const scene::Scene s = read_with_own_laws(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 0.5}],
      "springs": [{"name": "kx", "at": "x", "value": 1}, {"name": "ky", "between": ["x", "y"], "value": 0.7}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.05}]},
    "elements": [{"name": "h", "type": "bouc_wen", "between": ["x", "y"], "stiffness": 0.8, "elastic_share": 0.2,
                  "yield_displacement": 0.4, "shape": 0.8},
                 {"name": "c", "type": "coupled_spring", "first": {"at": "x"}, "second": {"at": "y"}, "stiffness": 0.4},
                 {"name": "d", "type": "jenkins", "at": "y", "stiffness": 0.5, "friction_coefficient": 0.5,
                  "normal_load": 0.3}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.4}], "response": {"at": "x"}})");
  const auto model = model::build(s);
  Vector p = model::defaults(model);
  p[model::frequency] = 0.9;
  time::Newmark newmark(time::equation_of_motion(model, p), 60);
  Vector start(6);
  start << 0.3, -0.2, 0.1, 0.4, 0.05, -0.02;
  const auto state = [](const Vector& y) { return time::MotionState{y.head(2), y.segment(2, 2), y.tail(2)}; };
  const time::PeriodMap map = time::newmark_map(newmark, state(start));
  REQUIRE(map.done);
  const double h = 1e-6;
  for (Eigen::Index i = 0; i < 6; ++i) {
    Vector ends[2];
    for (const int side : {0, 1}) {
      const auto end =
          time::newmark_map(newmark, state(start + (side == 0 ? -h : h) * Vector::Unit(6, i))).end;
      ends[side].resize(6);
      ends[side] << end.x, end.v, end.z;
    }
    CAPTURE(i);
    CHECK(((ends[1] - ends[0]) / (2 * h) - map.monodromy.col(i)).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE("two sliders in one element are two elements with one slider each, in harmonics and in time") {
  const auto with = [](const std::string& elements) {
    return read_with_own_laws(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
        "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
      "elements": [)" + elements +
                              R"(], "excitation": [{"name": "f", "at": "x", "cosine": 0.4}],
      "harmonics": {"order": 21}, "response": {"at": "x"}})");
  };
  const scene::Scene one =
      with(R"({"name": "d", "type": "two_sliders", "at": "x", "k1": 0.5, "mu1": 1, "load1": 0.2,
    "k2": 0.3, "mu2": 0.5, "load2": 1.1})");
  const scene::Scene two = with(R"({"name": "d1", "type": "jenkins", "at": "x", "stiffness": 0.5,
      "friction_coefficient": 1, "normal_load": 0.2},
    {"name": "d2", "type": "jenkins", "at": "x", "stiffness": 0.3, "friction_coefficient": 0.5, "normal_load": 1.1})");
  const double w = 1.2;
  const auto ours = observables::point_responses(one, {.frequency = w});
  const auto theirs = observables::point_responses(two, {.frequency = w});
  REQUIRE(ours.size() == 1);
  CHECK(std::abs(ours[0].point.amplitude - theirs[0].point.amplitude) < 1e-12);
  CHECK(std::abs(ours[0].point.energy_friction - theirs[0].point.energy_friction) < 1e-12);
  for (const auto method : {observables::TimeMethod::shooting, observables::TimeMethod::newmark_shooting}) {
    const auto a = observables::motion_in_time(one, {.frequency = w, .method = method});
    const auto b = observables::motion_in_time(two, {.frequency = w, .method = method});
    REQUIRE(a.status == observables::Status::complete);
    CHECK(a.integrator == b.integrator);
    CHECK(std::abs(a.amplitude - b.amplitude) < 1e-9);
    CHECK(std::abs(a.energy.friction - b.energy.friction) < 1e-9);
    CHECK(std::abs(a.energy.defect()) < 1e-9);
    REQUIRE(a.multipliers.size() == b.multipliers.size());
    CHECK(std::abs(a.multipliers[0] - b.multipliers[0]) < 1e-6);
    REQUIRE(a.elements.size() == 1);
    CHECK(std::abs(a.elements[0].stick_percent -
                   0.5 * (b.elements[0].stick_percent + b.elements[1].stick_percent)) < 1e-6);
  }
}

TEST_CASE("options decide which fields a law has, and are read, written and reported in the schema") {
  const std::string text = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "s", "type": "polynomial", "at": "x", "degree": DEGREE}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3}], "harmonics": {"order": 5},
    "studies": [{"name": "best", "kind": "optimum", "over": ["s.c3"], "bounds": [[0.01, 1]], "frequency": [0.4, 2.5]}]})";
  const auto with = [&](const std::string& degree) {
    std::string copy = text;
    return copy.replace(copy.find("DEGREE"), 6, degree);
  };
  const scene::Scene s = read_with_own_laws(with(R"(3, "c1": 0.1, "c2": 0, "c3": 0.7)"));
  CHECK(scene::value(s, "s.c3") == 0.7);
  CHECK(scene::parameter_names(s).size() == 3 + 3 + 2);
  std::istringstream again(scene::write(s));
  CHECK(scene::read(again, catalogue()) == s);
  scene::check(s);
  const auto cubic = read_with_own_laws(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1.1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.7}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3}], "harmonics": {"order": 5}})");
  const auto ours = observables::point_responses(s, {.frequency = 0.9});
  const auto theirs = observables::point_responses(cubic, {.frequency = 0.9});
  REQUIRE(ours.size() == 1);
  CHECK(std::abs(ours[0].point.amplitude - theirs[0].point.amplitude) < 1e-10);
  // The law is not antisymmetric: the response has all harmonics, and a mean where a square is in it.
  CHECK_FALSE(model::build(s).harmonics.odd);
  const auto squared = observables::point_responses(
      read_with_own_laws(with(R"(3, "c1": 0.1, "c2": 0.4, "c3": 0.7)")), {.frequency = 0.9});
  REQUIRE_FALSE(squared.empty());
  CHECK(squared[0].point.coefficients[0] < -0.01);

  for (const auto& [degree, fault] :
       {std::pair{std::string("0"), "/elements/0/degree: found 0, must be an integer from 1 to 9"},
        {R"("two")", "/elements/0/degree: found \"two\" (a string), must be an integer from 1 to 9"},
        {R"(2, "c1": 1, "c2": 1, "c3": 1)", "/elements/0/c3: found the unknown key \"c3\""},
        {R"(2, "c1": 1)", "/elements/0/c2: found no key \"c2\""}}) {
    CAPTURE(degree);
    CHECK_THROWS_WITH(read_with_own_laws(with(degree)), Catch::Matchers::Contains(fault));
  }
  CHECK(scene::json_schema(catalogue()).find("\"degree\"") != std::string::npos);
  CHECK(scene::json_schema(catalogue()).find("\"second\"") != std::string::npos);
}

TEST_CASE("directions that are lacking or not as they must be are reported where they should stand") {
  std::string text = plane(circular, R"({"at": "x"})");
  const auto with = [&](const std::string& second) {
    std::string copy = text;
    const std::string there = R"("second": {"at": "y"})";
    return copy.replace(copy.find(there), there.size(), second);
  };
  for (const auto& [second, fault] :
       {std::pair{std::string(R"("at": "y")"), "/elements/0/second: found no key \"second\""},
        {R"("second": {"at": "z"})", "/elements/0/second/at: found \"z\""},
        {R"("second": "y")", "/elements/0/second: found \"y\" (a string), must be an object"}}) {
    CAPTURE(second);
    CHECK_THROWS_WITH(read_with_own_laws(with(second)), Catch::Matchers::Contains(fault));
  }
  scene::Scene s = read_with_own_laws(text);
  s.elements[0].directions.pop_back();
  CHECK_THROWS_WITH(scene::check(s),
                    "/elements/0: found 1 directions, must be 2 for the type \"coupled_spring\"");
  s = read_with_own_laws(text);
  s.elements[0].values.clear();
  CHECK_THROWS_WITH(scene::check(s),
                    "/elements/0: found 0 values, must be 1 for the type \"coupled_spring\"");
  s.elements[0].type = nullptr;
  CHECK_THROWS_WITH(scene::check(s), "/elements/0: found no type, must be a law of force");
  scene::Part mass = s.masses[0];
  CHECK_THROWS_AS(elements::law_of(mass), std::invalid_argument);
}

TEST_CASE("a table in a file that the scene names is read from the scene's folder, and its hash covers it") {
  const std::string table = "-1,-0.5\n0,0\n1,0.5\n";
  const Folder folder = {{"tables/k.csv", table}, {"out/scene.json", ""}};
  const std::string text = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "s", "type": "table_spring", "at": "x", "table": "tables/k.csv"}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3}], "harmonics": {"order": 3},
    "studies": [{"name": "best", "kind": "optimum", "over": ["s.factor"], "bounds": [[0.5, 2]], "frequency": [0.4, 2.5]}]})";
  const auto from = [&](const std::string& scene_text, const std::string& at) {
    std::istringstream in(scene_text);
    return scene::read(in, catalogue(), at);
  };
  const scene::Scene s = from(text, folder.path());
  const auto found = observables::point_responses(s, {.frequency = 0.9});
  REQUIRE(found.size() == 1);
  CHECK(found[0].point.amplitude ==
        Approx(0.3 / std::hypot(1.5 - 0.81, 0.1 * 0.9)).epsilon(1e-12));  // the table is a spring of 0.5 N/m

  // The same in a file, written again, checked, and from another folder.
  folder.write("scene.json", text);
  CHECK(scene::read_file(folder / "scene.json", catalogue()) == s);
  CHECK(from(scene::write(s), folder.path()) == s);
  scene::check(s);
  const scene::Scene moved = scene::from_folder(s, folder / "out");
  CHECK(scene::write(moved).find("\"../tables/k.csv\"") != std::string::npos);
  const scene::Scene again = from(scene::write(moved), folder / "out");
  CHECK(observables::point_responses(again, {.frequency = 0.9})[0].point.amplitude ==
        found[0].point.amplitude);

  const scene::Scene here = scene::from_folder(s, "");
  CHECK(observables::point_responses(from(scene::write(here), ""), {.frequency = 0.9})[0].point.amplitude ==
        found[0].point.amplitude);

  // What the file holds counts, wherever it is, as it was when the scene was read.
  const std::string before = scene::hash(s);
  CHECK(scene::hash(moved) == before);
  CHECK(scene::hash(from(text, folder.path())) == before);
  folder.write("tables/k.csv", "-1,-0.5\n0,0\n1,0.6\n");
  const scene::Scene other = from(text, folder.path());
  CHECK(scene::hash(other) != before);
  CHECK(scene::hash(s) == before);
  CHECK_FALSE(other == s);
  std::filesystem::remove(folder / "tables/k.csv");
  scene::check(s);
  CHECK(scene::hash(s) == before);

  const auto fault = [&](const std::string& path) {
    std::string copy = text;
    copy.replace(copy.find("tables/k.csv"), 12, path);
    try {
      from(copy, folder.path());
    } catch (const scene::SceneError& error) {
      REQUIRE(error.faults().size() == 1);
      CHECK(error.faults()[0].pointer == "/elements/0/table");
      return error.faults()[0].message;
    }
    return std::string();
  };
  const std::string at = folder.path() + "/";
  CHECK(fault("nowhere.csv") == "found \"nowhere.csv\", which cannot be read: cannot open " + at +
                                    "nowhere.csv: No such file or directory");
  CHECK(fault("tables") ==
        "found \"tables\", which cannot be read: " + at + "tables is a directory, must be a file");
  CHECK(fault("scene.json") == "found a table of fewer than 2 rows, must be lines \"q,f\"");
  folder.write("big", "");
  std::filesystem::resize_file(folder / "big", scene::largest_size + 1);
  CHECK(fault("big") ==
        "found \"big\", which cannot be read: found a file of 67108865 bytes, a file must be at most 64 MB");
}
