// Sectors from matrices with rows on both faces, next to the same rings of masses and springs.
#include "catch.hpp"
#include "contains.hpp"
#include "environment.hpp"

#include "lib/scene/format/matrix_rings.hpp"
#include "lib/scene/format/only_fault.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/model/reduced_scene.hpp>
#include <arcslip/model/reduction_report.hpp>
#include <arcslip/scene/format/json_schema.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <sstream>

using namespace arcslip;
using namespace matrix_rings;

namespace {

using Complex = std::complex<double>;

std::string without(std::string whole, const std::string& from, const std::string& to) {
  const std::size_t begin = whole.find(from), end = whole.find(to, begin);
  REQUIRE(begin != std::string::npos);
  REQUIRE(end != std::string::npos);
  return whole.erase(begin, end - begin);
}

// The sector of by_hand(), with what links it to the next hub in its matrices: the hub of this sector, that
// of the next one with a share of what is at a hub, and the blade.
Sector two_faces() {
  Sector sector;
  sector.masses = {1.2, 0.8, 0.5, 0.4, 0.3};
  sector.springs = {{0, -1, 0.9}, {1, -1, 0.6}, {2, 0, 3},   {3, 2, 1.2},
                    {4, 3, 0.8},  {1, 0, 0.9},  {4, 1, 0.07}};
  sector.dampers = {{0, -1, 0.01}, {1, -1, 0.02}, {4, 3, 0.02}, {1, 0, 0.01}};
  sector.stiffening = {{2, 0, 0.2}, {3, 2, 0.15}, {4, 3, 0.1}};
  return sector;
}

constexpr const char* names = "name,row\ntip.z,5\nhub,1\n";
constexpr const char* pair = "own,next\n1,2\n";

std::string with_faces(Given given, Ring ring) {
  given.keys += R"(, "faces": "faces.csv")";
  std::string whole = scene_text(given, ring);
  whole = without(whole, R"(,
                {"name": "link")",
                  R"(],
    "dampers")");
  return without(whole, R"({"name": "cl")", R"({"name": "cp")");
}

std::string read_file(const std::string& path) {
  std::ifstream in(path);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Of the first sectors, and the energies of one.
double sector_difference(const scene::Scene& a, const scene::Scene& b) {
  double largest = 0;
  for (const double w : frequencies) {
    const auto x = scenes::response_at(a, w), y = scenes::response_at(b, w);
    const std::size_t n = x.responses.size() / 2, m = y.responses.size() / 2;
    REQUIRE(n * m > 0);
    largest =
        std::max({largest, off(x.responses[0].amplitude, y.responses[0].amplitude),
                  off(x.responses[n].amplitude, y.responses[m].amplitude),
                  off(x.energy_input / static_cast<double>(n), y.energy_input / static_cast<double>(m)),
                  off(x.energy_total() / static_cast<double>(n), y.energy_total() / static_cast<double>(m))});
  }
  return largest;
}

}  // namespace

TEST_CASE("a sector whose faces meet the next one is one of a ring of masses and springs") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  const std::string damping =
      R"(, "damping": [{"name": "r", "type": "rayleigh", "alpha": 0.01, "beta": 0.02}, {"name": "l", "type": "loss_factor", "loss_factor": 0.01}])";
  for (const std::string& elements : {std::string(), friction})
    for (const std::string& keys : {std::string(), reduced})
      for (const auto& [sectors, order] : {std::pair(6, 2), {6, -1}, {6, 3}, {5, 0}, {5, 9}, {2, 1}})
        for (const std::string& structure : {std::string(), damping}) {
          CAPTURE(elements, keys, sectors, order, structure);
          const Given given{sectors, order, keys, structure, elements};
          const scene::Scene whole = by_hand(given);
          CHECK(sector_difference(read(with_faces(given, Ring::sector), folder), whole) < 1e-10);
          CHECK(sector_difference(read(with_faces(given, Ring::full), folder), whole) < 1e-10);
          if (sectors == 6 && order < 3)  // the wave the other way round
            CHECK(sector_difference(
                      read(with_faces({6, -order, keys, structure, elements}, Ring::sector), folder), whole) >
                  1e-3);
        }
}

TEST_CASE("forces on the second face of a sector act on the next one") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  for (const std::string& keys : {std::string(), reduced})
    for (const auto& [sectors, order] : {std::pair(6, 2), {6, -1}, {5, 9}}) {
      CAPTURE(keys, sectors, order);
      Given given{sectors, order, keys, "", friction};
      given.excitation = R"({"name": "p", "shape": "p.mtx", "imaginary_shape": {"file": "p.mtx", "column": 2},
        "cosine": 0.6, "sine": 0.2, "at": "pad"}, {"name": "q", "shape": {"file": "p.mtx", "column": 2}, "harmonic": 3,
        "cosine": 0.1})";
      std::vector<Push> pushes{{"pad_", 4, 1, 0.6, 0.2}};
      const auto push = [&](const std::string& name, int row, int harmonic, Complex amplitude) {
        // Of the sector before on this one.
        if (row == 1) amplitude *= std::polar(1.0, 2 * std::numbers::pi * harmonic * order / sectors);
        pushes.push_back({name + std::to_string(row) + "_", std::max(row - 1, 0), harmonic, amplitude.real(),
                          -amplitude.imag()});
      };
      for (int row = 0; row < 5; ++row) {
        const Complex shape(0.5 - 0.2 * row, 0.5 - 0.2 * (row + 5));
        push("p", row, 1, Complex(0.6, -0.2) * shape);
        push("q", row, 3, 0.1 * shape.imag());
      }
      const scene::Scene whole = by_hand(given, {}, 0, pushes);
      CHECK(sector_difference(read(with_faces(given, Ring::sector), folder), whole) < 1e-10);
      CHECK(sector_difference(read(with_faces(given, Ring::full), folder), whole) < 1e-10);
    }
}

TEST_CASE("a motion of the ground goes around a ring of sectors with faces") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  for (const std::string& keys : {std::string(), reduced}) {
    CAPTURE(keys);
    Given given{6, 2, keys, "", friction};
    given.excitation =
        R"({"name": "g", "type": "base_acceleration", "shape": "r.mtx", "at": "pad", "cosine": 0.5, "sine": 0.1})";
    CHECK(sector_difference(read(with_faces(given, Ring::full), folder),
                            by_hand(given, {}, 0, {{"g", -1, 1, 0.5, 0.1}})) < 1e-10);
  }
}

TEST_CASE("a rotor of sectors with faces stiffens with its speed, and has gyroscopic forces") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  const std::string rotation = R"(, "rotation": {"name": "disk", "speed": 0.8, "highest_speed": 1})";
  for (const std::string& elements : {std::string(), friction})
    for (const std::string& keys : {std::string(), reduced}) {
      CAPTURE(elements, keys);
      Given given{6, 2, keys + R"(, "stiffness_speed_squared": "K2.mtx")", rotation, elements};
      Given plain = given;
      plain.structure = {};
      const scene::Scene whole = by_hand(plain, {}, 0.8);
      CHECK(sector_difference(read(with_faces(given, Ring::sector), folder), whole) < 1e-10);
      CHECK(sector_difference(read(with_faces(given, Ring::full), folder), whole) < 1e-10);
      given.keys += R"(, "gyroscopic": "G.mtx")";  // between the second face and the blade
      CHECK(sector_difference(read(with_faces(given, Ring::sector), folder),
                              read(with_faces(given, Ring::full), folder)) < 1e-10);
    }
}

TEST_CASE("the sectors of a ring with faces are mistuned each by its own matrix") {
  Sector sector = two_faces();
  sector.springs = {{0, -1, 1.5}, {2, 0, 3}, {3, 2, 1.2}, {4, 3, 0.8}, {1, 0, 0.9}};
  const Folder folder = files(sector, names);
  folder.write("faces.csv", pair);
  for (const std::string& keys : {std::string(), reduced}) {
    CAPTURE(keys);
    Given given{6, 2, keys, "", friction};
    given.stiffness = {1.02, 0.97, 1.1, 1, 0.91, 1.04};
    std::string whole = with_faces(given, Ring::full);
    const std::string kp = R"({"name": "kp", "between": ["pad", "tip.z"], "value": 0.3})";
    whole.insert(whole.find(kp) + kp.size(),
                 R"(, {"name": "skew", "between": ["tip.z", {"next": "hub"}], "value": 0.07})");
    given.link = given.stiffness;
    CHECK(sector_difference(read(whole, folder), by_hand(given)) < 1e-10);
    given.link[3] *= 1.001;
    CHECK(sector_difference(read(whole, folder), by_hand(given)) > 1e-6);
  }
}

TEST_CASE("peaks of a sector with faces are those of its ring") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  const Given given{6, 2, reduced, "", friction};
  const auto peaks = [](const scene::Scene& s) {
    const auto branches = observables::frequency_response(s, {0.5, 1.6});
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].status == observables::Status::complete);
    std::vector<observables::ResponsePoint> found;
    for (const auto& event : branches[0].events)
      if (event.kind == "peak") found.push_back(event.point);
    return found;
  };
  const auto one = peaks(read(with_faces(given, Ring::sector), folder)), all = peaks(by_hand(given));
  REQUIRE(!one.empty());
  REQUIRE(one.size() == all.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(off(one[i].amplitude, all[i].amplitude) < 1e-10);
    CHECK(off(one[i].omega, all[i].omega) < 1e-8);
  }
}

// CalculiX 2.20 with *CYCLIC SYMMETRY MODEL, of the mesh of examples/disk_sector (mesh.awk, cyclic=1).
TEST_CASE("natural frequencies of a bladed disk by nodal diameters are those of a finite-element program") {
  const std::string path = source_folder() + "/examples/disk_sector/scene.json";
  const std::vector<double> first{548.2099, 538.1251, 570.4716, 671.3459, 735.3208, 762.2713, 769.6992};
  for (const bool full : {false, true})
    for (int diameter = 0; diameter <= 6; ++diameter) {
      CAPTURE(full, diameter);
      std::string text = read_file(path);
      const auto replace = [&](const std::string& piece, const std::string& by) {
        const std::size_t at = text.find(piece);
        REQUIRE(at != std::string::npos);
        text.replace(at, piece.size(), by);
      };
      replace("\"engine_order\": 4",
              "\"engine_order\": " + std::to_string(diameter) + (full ? ", \"full\": true" : ""));
      replace("\"beta\": 1e-6", "\"beta\": 1e-9");
      replace("\"normal_load\": 100", "\"normal_load\": 0");
      replace("\"highest_frequency\": 8000", "\"highest_frequency\": 1200");
      replace("\"order\": 7", "\"order\": 1");
      std::istringstream in(text);
      const scene::Scene s =
          scene::read(in, test_catalogue::whole(), source_folder() + "/examples/disk_sector");
      const auto branches = observables::frequency_response(s, {500, 800});
      REQUIRE(branches.size() == 1);
      double highest = 0, at = 0;
      for (const auto& event : branches[0].events)
        if (event.kind == "peak" && event.point.amplitude > highest) {
          highest = event.point.amplitude;
          at = event.point.omega / (2 * std::numbers::pi);
        }
      CHECK(off(at, first[static_cast<std::size_t>(diameter)]) < 1e-7);
    }
}

TEST_CASE("a scene with faces is written so that it is read again") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  for (const Ring ring : {Ring::sector, Ring::full}) {
    const scene::Scene s = read(with_faces({}, ring), folder);
    CHECK(s.matrices->faces == std::vector<scene::FacePair>{{0, 1}});
    CHECK(read(scene::write(s), folder) == s);
    scene::check(s);
    CHECK(contains(scene::write(s), R"("faces": "faces.csv")"));
    const std::string hash = scene::hash(s);
    CHECK(scene::hash(scene::from_folder(s, folder / "out")) == hash);
    folder.write("faces.csv", "# another text\nown,next\n1,2\n");
    CHECK(scene::hash(read(with_faces({}, ring), folder)) != hash);
    folder.write("faces.csv", pair);
  }
  CHECK(contains(scene::json_schema(test_catalogue::whole()), "\"faces\""));
  const scene::Scene s = read(with_faces({6, 2, reduced}, Ring::sector), folder);
  CHECK(contains(observables::prepare(s, {}), "of 5 rows was reduced to 2 of them and "));
  CHECK_THROWS_WITH(model::reduced_scene(s, folder.path(), {}),
                    Catch::Contains("it is reduced for each nodal diameter of a scene"));
}

TEST_CASE("what is kept of a closed ring goes with its scene") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  std::weak_ptr<scene::Derived> kept;
  {
    const scene::Scene s = read(with_faces({6, 2, reduced}, Ring::full), folder);
    CHECK(model::build(s).dofs > 18);
    kept = s.matrices->derived;
  }
  CHECK(kept.expired());
}

TEST_CASE("what is wrong with the faces of a sector is reported") {
  const Folder folder = files(two_faces(), names);
  folder.write("faces.csv", pair);
  const std::string faces = "/structure/matrices/faces";
  const auto fault = [&](const std::string& whole, const std::string& pointer, const std::string& part) {
    CAPTURE(whole);
    scene::test::check_only_fault([&] { observables::prepare(read(whole, folder), {}); }, pointer, part);
  };
  const auto of = [&](const std::string& text, const std::string& part) {
    folder.write("faces.csv", text);
    for (const Ring ring : {Ring::sector, Ring::full}) fault(with_faces({}, ring), faces, part);
    folder.write("faces.csv", pair);
  };
  of("", "found no rows in \"faces.csv\", must have at least one line own,next");
  of("own,next\n", "found no rows in \"faces.csv\", must have at least one line own,next");
  of("name,row\n1,2\n", "line 1 of \"faces.csv\": found \"name,row\", must be the header own,next");
  of("own,next\n1,2,3\n", "line 2 of \"faces.csv\": found 3 values, must be 2: a row of each face");
  of("own,next\n1,6\n", "line 2 of \"faces.csv\": found the row \"6\", must be an integer from 1 to 5");
  of("own,next\n0,2\n", "line 2 of \"faces.csv\": found the row \"0\", must be an integer from 1 to 5");
  of("own,next\n1,x\n", "line 2 of \"faces.csv\": found the row \"x\", must be an integer from 1 to 5");
  of("own,next\n3,3\n",
     "line 2 of \"faces.csv\": found the row 3 on both faces, must be two rows; rows on the axis of the "
     "ring");
  of("own,next\n1,2\n1,3\n",
     "line 3 of \"faces.csv\": found the row 1 again, which stands in line 2; a row must stand once");
  of("own,next\n1,2\n3,2\n",
     "line 3 of \"faces.csv\": found the row 2 again, which stands in line 2; a row must stand once");
  of("own,next\n1,2\n2,3\n",
     "line 3 of \"faces.csv\": found the row 2 again, which stands in line 2; a row must be of one face");
  of("own,next\n1,2\n3,1\n",
     "line 3 of \"faces.csv\": found the row 1 again, which stands in line 2; a row must be of one face");

  const std::string named = with_faces({}, Ring::sector);
  folder.write("names.csv", "name,row\ntip.z,5\nhub,1\nfar,2\n");
  fault(named, "/structure/names",
        "line 4 of \"names.csv\": found the row 2, which is row 1 of the next sector by \"faces\", must be a "
        "row of this one: name that row, and say {\"next\": name}");
  folder.write("names.csv", names);
  fault(
      with_faces({6, 2, "", R"(, "damping": [{"name": "z", "type": "modal", "ratio": 0.01}])"}, Ring::sector),
      "/structure/damping/0/type", "where masses, springs or matrices reach into the next sector");
  fault(with_faces({201, 2}, Ring::sector), "/structure/cyclic/sectors",
        "found 201, must be at most 200 where the matrices have \"faces\"");
  Given ground{6, 2};
  ground.excitation =
      R"({"name": "g", "type": "base_acceleration", "shape": "r.mtx", "at": "pad", "cosine": 1})";
  fault(with_faces(ground, Ring::sector), "/excitation/0/shape",
        "found a motion of the ground under a sector with \"faces\", must be the forces M r");
  std::string alone = with_faces({}, Ring::sector);
  alone.erase(alone.find("\"cyclic\""), alone.find("\"matrices\"") - alone.find("\"cyclic\""));
  fault(alone, faces, "found the faces of a sector without \"cyclic\", must be next to it");
  std::string wrong = with_faces({}, Ring::sector);
  wrong.replace(wrong.find("\"faces.csv\""), 11, "3");
  fault(wrong, faces, "found 3 (a number), must be a string, the path of a CSV file of own,next");
}
