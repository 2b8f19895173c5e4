// Forces and motions of the ground on all rows of matrices, and speeds of rotation: next to the same
// structures of masses and springs, and their faults.
#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/model/reduction_report.hpp>
#include <arcslip/scene/format/json_schema.hpp>

#include <algorithm>
#include <sstream>

using namespace arcslip;

namespace {

// A chain of four masses on springs, of which the first holds the first mass. K2: as springs of 2, 3, 4, 5
// N/m s^2 in the same places.
std::string chain_of(double first, double by) {
  std::string text = "%%MatrixMarket matrix coordinate real symmetric\n4 4 7\n";
  for (int i = 1; i <= 4; ++i) {
    const double own = first + by * (i - 1), next = i < 4 ? own + by : 0;
    text += std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(own + next) + "\n";
    if (i < 4) text += std::to_string(i + 1) + " " + std::to_string(i) + " " + std::to_string(-next) + "\n";
  }
  return text;
}

Folder files() {
  return {
      {"M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n4 4 4\n1 1 1\n2 2 1.1\n3 3 1.2\n4 4 1.3\n"},
      {"K.mtx", chain_of(1000, 100)},
      {"K2.mtx", chain_of(2, 1)},
      {"names.csv", "name,row\nend,4\nb,2\n"},
      {"p.mtx", "%%MatrixMarket matrix array real general\n4 2\n1\n-2\n0.5\n0.25\n0.3\n0\n-0.7\n2\n"},
      {"r.mtx", "%%MatrixMarket matrix array real general\n4 1\n1\n1\n1\n1\n"}};
}

const std::string by_files = R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx"}, "names": "names.csv")";
const std::string by_reduced_files =
    R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "highest_frequency": 300}, "names": "names.csv")";
std::string by_parts(double speed = 0) {
  std::string text = R"("dofs": ["a", "b", "c", "end"], "masses": [)";
  const char* names[] = {"a", "b", "c", "end"};
  for (int i = 0; i < 4; ++i)
    text += std::string(i > 0 ? ", " : "") + R"({"name": "m)" + std::to_string(i) + R"(", "at": ")" +
            names[i] + R"(", "value": )" + std::to_string(1 + 0.1 * i) + "}";
  text += R"(], "springs": [)";
  for (int i = 0; i < 4; ++i) {
    std::ostringstream value;
    value.precision(17);
    value << 1000 + 100 * i + speed * speed * (2 + i);
    text += std::string(i > 0 ? ", " : "") + R"({"name": "k)" + std::to_string(i) + R"(", "between": [")" +
            names[i] + R"(", ")" + (i > 0 ? names[i - 1] : "ground") + R"("], "value": )" + value.str() + "}";
  }
  return text + "]";
}
// A mass on the end, next to the structure.
const std::string tuned = R"(, "masses": [{"name": "m_t", "at": "t", "value": 0.2}],
  "springs": [{"name": "k_t", "between": ["t", "end"], "value": 60}])";

std::string scene_of(const std::string& structure, const std::string& excitation,
                     const std::string& frame = "relative") {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {)" + structure + R"(,
      "dampers": [{"name": "c", "between": ["b", "end"], "value": 3}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "b", "stiffness": 300, "friction_coefficient": 0.5,
                  "normal_load": 0.4}],
    "excitation": [)" +
         excitation + R"(], "response": {"at": "end", "frame": ")" + frame + R"("}, "harmonics": {"order": 5},
    "studies": [{"kind": "frf", "from": 2, "to": 20}]})";
}

scene::Scene read(const std::string& whole, const Folder& folder) {
  std::istringstream in(whole);
  return scene::read(in, test_catalogue::whole(), folder.path());
}

std::string fault(const std::string& structure, const std::string& excitation, const Folder& folder) {
  try {
    read(scene_of(structure, excitation), folder);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "none";
}

void check_same(const scene::Scene& one, const scene::Scene& other, double tolerance = 1e-10) {
  for (const double omega : {3.0, 9.0, 14.0, 33.0}) {
    CAPTURE(omega);
    const auto a = scenes::response_at(one, omega), b = scenes::response_at(other, omega);
    CHECK(b.amplitude == Approx(a.amplitude).epsilon(tolerance));
    CHECK(b.energy_input == Approx(a.energy_input).epsilon(10 * tolerance));
    CHECK(b.energy_friction == Approx(a.energy_friction).epsilon(10 * tolerance).margin(1e-14));
    CHECK(b.forces.excitation.in_phase == Approx(a.forces.excitation.in_phase).epsilon(10 * tolerance));
  }
}

}  // namespace

TEST_CASE("a force on all rows from a file is that of forces on each degree of freedom") {
  const Folder folder = files();
  const std::string structure = GENERATE(by_files, by_reduced_files);
  const std::string each = R"({"name": "fa", "at": "a", "cosine": 2, "sine": 0.5},
    {"name": "fb", "at": "b", "cosine": -4, "sine": -1}, {"name": "fc", "at": "c", "cosine": 1, "sine": 0.25},
    {"name": "fe", "at": "end", "cosine": 0.5, "sine": 0.125})";
  const scene::Scene s =
      read(scene_of(structure, R"({"name": "p", "shape": "p.mtx", "cosine": 2, "sine": 0.5})"), folder);
  check_same(read(scene_of(by_parts(), each), folder), s);
}

TEST_CASE("a travelling force from a file has a real and an imaginary part") {
  const Folder folder = files();
  const std::string structure = GENERATE(by_files, by_reduced_files);
  // (2 - 0.5 i) (S_r + i S_i): cosine 2 S_r + 0.5 S_i, sine 0.5 S_r - 2 S_i
  const double re[] = {1, -2, 0.5, 0.25}, im[] = {0.3, 0, -0.7, 2};
  const char* names[] = {"a", "b", "c", "end"};
  std::string each;
  for (int i = 0; i < 4; ++i)
    each += std::string(i > 0 ? ", " : "") + R"({"name": "f)" + std::to_string(i) + R"(", "at": ")" +
            names[i] + R"(", "cosine": )" + std::to_string(2 * re[i] + 0.5 * im[i]) + R"(, "sine": )" +
            std::to_string(0.5 * re[i] - 2 * im[i]) + "}";
  scene::Scene s = read(scene_of(structure, R"({"name": "p", "shape": "p.mtx",
      "imaginary_shape": {"file": "p.mtx", "column": 2}, "cosine": 2, "sine": 0.5})"),
                        folder);
  const scene::Scene parts = read(scene_of(by_parts(), each), folder);
  check_same(parts, s);
  // The amplitude is a parameter of both parts.
  scene::set(s, "p.cosine", 1);
  scene::set(s, "p.sine", 0.25);
  scene::Scene half = parts;
  for (int i = 0; i < 4; ++i)
    for (const char* part : {".cosine", ".sine"}) {
      const std::string name = "f" + std::to_string(i) + part;
      scene::set(half, name, 0.5 * scene::value(parts, name));
    }
  check_same(half, s);
}

TEST_CASE("a motion of the ground under matrices loads all rows with their masses") {
  const Folder folder = files();
  const std::string structure = GENERATE(by_files, by_reduced_files);
  const std::string frame = GENERATE("relative", "absolute");
  const std::string type = GENERATE("base_displacement", "base_acceleration");
  const std::string motion = R"({"name": "g", "type": ")" + type + R"(", "cosine": 0.3, "sine": 0.2)";
  check_same(read(scene_of(by_parts(), motion + "}", frame), folder),
             read(scene_of(structure, motion + R"(, "shape": "r.mtx"})", frame), folder));
}

TEST_CASE("a motion of the ground takes degrees of freedom next to the matrices along") {
  const Folder folder = files();
  const std::string structure = GENERATE(by_files, by_reduced_files) + R"(, "dofs": ["t"])" + tuned;
  std::string parts = by_parts();
  parts.replace(parts.find("\"end\"]"), 6, "\"end\", \"t\"]");
  parts.replace(parts.find("\"masses\": ["), 11, R"("masses": [{"name": "m_t", "at": "t", "value": 0.2}, )");
  parts.replace(parts.find("\"springs\": ["), 12,
                R"("springs": [{"name": "k_t", "between": ["t", "end"], "value": 60}, )");
  const std::string motion = R"({"name": "g", "type": "base_acceleration", "cosine": 0.3)";
  check_same(read(scene_of(parts, motion + "}"), folder),
             read(scene_of(structure, motion + R"(, "shape": "r.mtx", "at": "t"})"), folder));
  CHECK(contains(
      fault(structure, motion + R"(, "shape": "r.mtx"})", folder),
      "/excitation/0: found \"shape\" alone, must have \"direction\" next to it: how the ground moves under "
      "\"t\", which is no row of the matrices"));
}

TEST_CASE("scenes with shapes are written, read, checked and hashed with their files") {
  const Folder folder = files();
  const scene::Scene s = read(scene_of(by_files, R"({"name": "p", "shape": "p.mtx",
        "imaginary_shape": {"file": "p.mtx", "column": 2}, "cosine": 2})"),
                              folder);
  CHECK(read(scene::write(s), folder) == s);
  scene::check(s);
  const std::string hash = scene::hash(s);
  CHECK(scene::hash(scene::from_folder(s, folder / "out")) == hash);
  CHECK(scene::hash(read(scene_of(by_files, R"({"name": "p", "shape": "p.mtx", "imaginary_shape": "p.mtx",
        "cosine": 2})"),
                         folder)) != hash);
  folder.write("p.mtx", "%%MatrixMarket matrix array real general\n4 2\n1\n-2\n0.5\n0.25\n0.3\n0\n-0.7\n3\n");
  CHECK(scene::hash(read(scene::write(s), folder)) != hash);
  for (const char* key : {"\"shape\"", "\"imaginary_shape\"", "\"rotation\"", "\"stiffness_speed_squared\""})
    CHECK(contains(scene::json_schema(test_catalogue::whole()), key));
}

TEST_CASE("what is wrong with shapes is reported") {
  const Folder folder = files();
  const auto of = [&](const std::string& keys, const std::string& structure = by_files) {
    return fault(structure, R"({"name": "p", )" + keys + R"(, "cosine": 1})", folder);
  };
  CHECK(of(R"("shape": "p.mtx")") == "none");
  CHECK(contains(of(R"("shape": "none.mtx")"),
                 "/excitation/0/shape: found \"none.mtx\", which cannot be read"));
  CHECK(contains(of(R"("shape": {"file": "p.mtx", "column": 3})"),
                 "/excitation/0/shape: found a matrix of 2 columns, must have the column 3"));
  CHECK(contains(
      of(R"("shape": {"file": "p.mtx", "variable": "p"})"),
      "/excitation/0/shape/variable: found the variable \"p\" of \"p.mtx\", must stand next to a .mat file"));
  CHECK(contains(of(R"("shape": {"column": 1})"), "/excitation/0/shape"));
  CHECK(
      contains(of(R"("imaginary_shape": "p.mtx")"),
               "/excitation/0/imaginary_shape: found an imaginary part alone, must stand next to \"shape\""));
  CHECK(contains(of(R"("shape": "p.mtx", "imaginary_shape": "p.mtx", "harmonic": 0)"),
                 "/excitation/0/imaginary_shape: found an imaginary part where the harmonic is 0"));
  CHECK(contains(of(R"("shape": "p.mtx", "at": "b")"), "/excitation/0: found \"b\" next to \"shape\""));
  CHECK(contains(
      of(R"("shape": "p.mtx")", by_parts()),
      "/excitation/0/shape: found a vector over the rows of matrices, must stand next to \"matrices\""));
  folder.write("short.mtx", "%%MatrixMarket matrix array real general\n3 1\n1\n1\n1\n");
  CHECK(contains(of(R"("shape": "short.mtx")"),
                 "/excitation/0/shape: found a vector of 3 rows, must have 4 as the matrices"));
  CHECK(contains(
      of(R"("type": "base_acceleration")"),
      "/excitation/0/type: found \"base_acceleration\" without \"shape\", must have it with matrices"));
  const std::string beam =
      R"("beam": {"elements": 4, "length": 1, "young": 2e11, "density": 7800, "width": 0.1,
    "height": 0.1, "points": {"b": 0.5, "end": 1}})";
  CHECK(contains(of(R"("type": "base_acceleration")", beam),
                 "/excitation/0/type: found \"base_acceleration\", must be \"force\" with a beam or a rod"));
}

namespace {

std::string rotating(bool of_reduced, const std::string& keys) {
  return R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "stiffness_speed_squared": "K2.mtx")" +
         std::string(of_reduced ? R"(, "highest_frequency": 300)" : "") +
         R"(}, "names": "names.csv", "rotation": {"name": "rotor", )" + keys + "}";
}
const std::string force = R"({"name": "f", "at": "end", "cosine": 1})";

}  // namespace

TEST_CASE("the stiffness of a rotating structure grows with the square of its speed") {
  const Folder folder = files();
  const bool of_reduced = GENERATE(false, true);
  scene::Scene s = read(scene_of(rotating(of_reduced, R"("speed": 0, "highest_speed": 20)"), force), folder);
  CHECK(read(scene::write(s), folder) == s);
  for (const double speed : {0.0, 7.0, 20.0}) {
    scene::set(s, "rotor.speed", speed);
    check_same(read(scene_of(by_parts(speed), force), folder), s, 1e-9);
  }
  CHECK_THROWS_AS(scene::set(s, "rotor.speed", 20.1), scene::ParameterError);
}

TEST_CASE("a branch over the speed of rotation is that of responses at its speeds") {
  const Folder folder = files();
  const bool of_reduced = GENERATE(false, true);
  const scene::Scene s =
      read(scene_of(rotating(of_reduced, R"("speed": 5, "highest_speed": 20)"), force), folder);
  const auto branches =
      observables::parameter_response(s, {.over = "rotor.speed", .from = 1, .to = 19, .frequency = 14});
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].points.size() > 5);
  for (std::size_t k = 0; k < branches[0].points.size(); k += 3) {
    const auto& point = branches[0].points[k];
    const auto alone = scenes::response_at(read(scene_of(by_parts(point.over), force), folder), 14);
    CHECK(point.amplitude == Approx(alone.amplitude).epsilon(1e-8));
  }
}

TEST_CASE("the speed of rotation may follow the excitation") {
  const Folder folder = files();
  const bool of_reduced = GENERATE(false, true);
  const scene::Scene s = read(scene_of(rotating(of_reduced, R"("engine_order": 2)"), force), folder);
  CHECK(read(scene::write(s), folder) == s);
  for (const double omega : {3.0, 14.0, 33.0}) {
    CAPTURE(omega);
    const auto a = scenes::response_at(read(scene_of(by_parts(omega / 2), force), folder), omega),
               b = scenes::response_at(s, omega);
    CHECK(b.amplitude == Approx(a.amplitude).epsilon(1e-9));
  }
  const auto parameters = scene::parameter_names(s);
  CHECK(std::find(parameters.begin(), parameters.end(), "rotor.speed") == parameters.end());
}

TEST_CASE("what is wrong with a rotation is reported") {
  const Folder folder = files();
  const auto of = [&](const std::string& structure) { return fault(structure, force, folder); };
  CHECK(of(rotating(true, R"("speed": 3, "highest_speed": 5)")) == "none");
  CHECK(contains(of(rotating(true, R"("speed": 3)")),
                 "/structure/rotation: found no \"highest_speed\" next to \"highest_frequency\""));
  CHECK(contains(of(rotating(false, R"("speed": 6, "highest_speed": 5)")), "/structure/rotation/speed"));
  CHECK(contains(of(rotating(false, R"("speed": -1)")), "/structure/rotation/speed"));
  CHECK(contains(of(rotating(false, R"("speed": 1, "engine_order": 2)")), "/structure/rotation/speed"));
  CHECK(contains(of(rotating(false, R"("highest_speed": 1, "engine_order": 2)")),
                 "/structure/rotation/highest_speed: found it next to \"engine_order\""));
  CHECK(
      contains(of(by_files + R"(, "rotation": {"name": "rotor", "speed": 3})"),
               "/structure/rotation: found no \"stiffness_speed_squared\", \"gyroscopic\" or \"circulatory\" "
               "among \"matrices\""));
  std::string alone = rotating(false, R"("speed": 3)");
  alone.erase(alone.find(", \"rotation\""));
  CHECK(contains(of(alone), "/structure/matrices/stiffness_speed_squared: found no \"rotation\""));
  folder.write("K2.mtx", "%%MatrixMarket matrix coordinate real general\n4 4 1\n1 2 1\n");
  CHECK(contains(of(rotating(false, R"("speed": 3)")),
                 "found the stiffness_speed_squared matrix with 1 in row 1, column 2"));
}
