// Reduced structures written to files: read again as matrices, they have the responses of the scene.
#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/model/reduced_scene.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace arcslip;

namespace {

// Twelve masses in two planes, free or held by their first springs, with disks and rotating damping.
Folder rotor_files(bool held) {
  const int n = 12;
  std::string M, K, C, G, N, p = "%%MatrixMarket matrix array real general\n24 2\n";
  int k = 0, g = 0;
  const auto add = [](std::string& to, int& count, int i, int j, double value) {
    to += std::to_string(i) + ' ' + std::to_string(j) + ' ' + std::to_string(value) + '\n';
    ++count;
  };
  int none = 0;
  for (int i = 1; i <= n; ++i)
    for (const int plane : {0, n}) {
      const double own = i > 1 || held ? 1000 + 40.0 * i : 0, next = i < n ? 1040 + 40.0 * i : 0;
      add(M, none, plane + i, plane + i, 1 + 0.1 * i);
      add(K, k, plane + i, plane + i, own + next);
      if (i < n) add(K, k, plane + i + 1, plane + i, -next);
      add(C, none, plane + i, plane + i, 0.3);
    }
  for (const int i : {3, 8}) add(G, g, n + i, i, -0.4);
  int many = 0;
  add(N, many, n + 5, 5, -2.5);
  for (int i = 0; i < 48; ++i) p += std::to_string(std::sin(0.7 * i)) + '\n';
  const auto file = [&](const char* form, int count, const std::string& lines) {
    return std::string("%%MatrixMarket matrix coordinate real ") + form + "\n24 24 " + std::to_string(count) +
           '\n' + lines;
  };
  return {{"mass.mtx", file("symmetric", 24, M)},
          {"stiff.mtx", file("symmetric", k, K)},
          {"damp.mtx", file("general", 26, C + "5 17 0.2\n17 5 -0.05\n")},
          {"K2.mtx", file("symmetric", 24, M)},
          {"gyro.mtx", file("skew-symmetric", g, G)},
          {"rotating.mtx", file("skew-symmetric", many, N)},
          {"p.mtx", p},
          {"nodes.csv", "name,row\nend,12\nunused,9\nend.y,24\nrub,4\n"}};
}

std::string reduced_rotor_scene(const std::string& matrices, const std::string& more,
                                const std::string& excitation) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"matrices": {
      "mass": "mass.mtx", "stiffness": "stiff.mtx", "damping": "damp.mtx", "unsymmetric": ["damping"],
      "highest_frequency": 200)" +
         matrices + R"(}, "names": "nodes.csv", "dofs": ["tuned"],
      "masses": [{"name": "m", "at": "tuned", "value": 0.1}],
      "springs": [{"name": "k", "between": ["tuned", "end"], "value": 30}])" +
         more + R"(}, "elements": [{"name": "d", "type": "jenkins", "at": "rub", "stiffness": 300,
      "friction_coefficient": 0.5, "normal_load": 0.4}], "excitation": [)" +
         excitation + R"(], "response": {"at": "end"}, "harmonics": {"order": 5},
      "studies": [{"kind": "frf", "from": 2, "to": 20}]})";
}

// Written to a folder and read again.
scene::Scene written(const scene::Scene& s, const Folder& folder) {
  const model::ReducedScene reduced = model::reduced_scene(s, folder.path());
  for (const auto& [name, text] : reduced.files) folder.write(name, text);
  return scenes::parse(reduced.scene, folder.path());
}

const std::string push = R"({"name": "f", "at": "end", "cosine": 1})";

}  // namespace

TEST_CASE(
    "a reduced rotor in files has the responses of the scene, at every speed and under loads on all rows") {
  const Folder source = rotor_files(true);
  scene::Scene s = scenes::parse(
      reduced_rotor_scene(
          R"(, "gyroscopic": "gyro.mtx", "circulatory": "rotating.mtx", "stiffness_speed_squared": "K2.mtx")",
          R"(, "rotation": {"name": "rotor", "speed": 4, "highest_speed": 9},
                  "damping": [{"name": "zeta", "type": "modal", "ratio": 0.003}])",
          push + R"(, {"name": "p", "shape": {"file": "p.mtx", "column": 1}, "cosine": 0.3,
                  "imaginary_shape": {"file": "p.mtx", "column": 2}})"),
      source.path());
  const Folder folder;
  scene::Scene again = written(s, folder);
  CHECK(again.matrices->highest_frequency == 0);
  CHECK(again.matrices->size() < 28);
  CHECK(again.matrices->rows.size() == 2);  // the end and where it rubs
  for (const double speed : {0.0, 4.0, 9.0}) {
    scene::set(s, "rotor.speed", speed);
    scene::set(again, "rotor.speed", speed);
    for (const double omega : {3.0, 4.4, 9.0, 33.0}) {
      CAPTURE(speed, omega);
      const auto a = scenes::response_at(s, omega), b = scenes::response_at(again, omega);
      CHECK(b.amplitude == Approx(a.amplitude).epsilon(1e-11));
      CHECK(b.energy_viscous == Approx(a.energy_viscous).epsilon(1e-10));
      CHECK(b.energy_friction == Approx(a.energy_friction).epsilon(1e-10).margin(1e-14));
    }
  }
}

TEST_CASE("a reduced structure that floats, and a beam, are written and read again") {
  const Folder source = rotor_files(false), folder, other;
  const scene::Scene floating = scenes::parse(reduced_rotor_scene("", "", push), source.path());
  const scene::Scene again = written(floating, folder);
  const std::string bar = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "beam": {"elements": 30, "length": 1, "young": 2e11, "density": 7800, "width": 0.05, "height": 0.02,
             "points": {"mid": 0.5, "tip": 1}, "highest_frequency": 5000}},
    "elements": [{"name": "d", "type": "jenkins", "at": "mid", "stiffness": 3e4, "friction_coefficient": 0.5,
                  "normal_load": 4}],
    "excitation": [{"name": "f", "at": "tip", "cosine": 1}], "response": {"at": "tip.slope"},
    "harmonics": {"order": 5}, "studies": [{"kind": "frf", "from": 2, "to": 20}]})";
  const scene::Scene beam = scenes::parse(bar, other.path());
  const scene::Scene beam_again = written(beam, other);
  CHECK(beam_again.matrices->size() < 64);
  for (const double omega : {3.0, 9.0, 33.0}) {
    CHECK(scenes::response_at(again, omega).amplitude ==
          Approx(scenes::response_at(floating, omega).amplitude).epsilon(1e-9));
    CHECK(scenes::response_at(beam_again, omega).amplitude ==
          Approx(scenes::response_at(beam, omega).amplitude).epsilon(1e-10));
  }
}

TEST_CASE("a reduced structure that is reduced again where it is read has the responses of the scene") {
  constexpr int points = 510;
  std::string places, masses;
  for (int i = 1; i <= points; ++i) {
    const std::string name = "p" + std::to_string(i), separator = i < points ? ", " : "";
    places += '"' + name + "\": " + std::to_string(i) + separator;
    masses += R"({"name": "m)" + name + R"(", "at": ")" + name + R"(", "value": 0.01})" + separator;
  }
  const Folder folder;
  const scene::Scene rod =
      scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "rod": {"elements": 600, "length": 600, "young": 2e11, "density": 7800, "area": 5,
             "points": {)" +
                    places + R"(}, "highest_frequency": 5000}, "masses": [)" + masses + R"(]},
    "excitation": [{"name": "f", "at": "p510", "cosine": 1}], "response": {"at": "p400"},
    "harmonics": {"order": 1}, "studies": [{"kind": "frf", "from": 2, "to": 20}]})");
  const scene::Scene again = written(rod, folder);
  CHECK(again.matrices->size() > 500);
  CHECK(again.matrices->reduction.accuracy == 1e-11);
  CHECK(scenes::response_at(again, 3).amplitude ==
        Approx(scenes::response_at(rod, 3).amplitude).epsilon(1e-10));
}

TEST_CASE("what has no reduced files is reported") {
  const Folder source = rotor_files(true);
  const auto refused = [&](const scene::Scene& s) -> std::string {
    try {
      model::reduced_scene(s, source.path());
    } catch (const model::NotReduced& error) {
      return error.what();
    }
    return "written";
  };
  CHECK(contains(
      refused(scenes::chain(3, false)),
      "the structure is not reduced: give its matrices, its beam or its rod a \"highest_frequency\""));
  const scene::Scene moved = scenes::parse(
      reduced_rotor_scene("", "",
                          R"({"name": "quake", "type": "base_acceleration", "cosine": 1, "shape": "p.mtx",
                           "direction": {"tuned": 1}})"),
      source.path());
  CHECK(contains(refused(moved), "the ground moves under all rows by the excitation \"quake\""));
}
