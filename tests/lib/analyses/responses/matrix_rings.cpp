// Full rings of sectors from matrices, next to one sector and next to the same rings of masses and springs.
#include "catch.hpp"
#include "contains.hpp"

#include "lib/scene/format/matrix_rings.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/model/reduction_report.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using namespace matrix_rings;

namespace {

// Unlike each other, and not symmetric about any sector.
const std::vector<double> by_hub{1, 1.3, 0.8, 1.1, 0.9, 1.25}, by_blade{1.02, 0.97, 1.1, 1, 0.91, 1.04},
    by_mass{0.9, 1.2, 1, 1.4, 0.8, 1}, by_load{1, 0.7, 1.2, 0.9, 1.5, 1.1};

// The largest difference of what the points have, relative.
double difference(const observables::ResponsePoint& a, const observables::ResponsePoint& b) {
  double largest = off(a.amplitude, b.amplitude);
  REQUIRE(a.responses.size() == b.responses.size());
  for (std::size_t i = 0; i < a.responses.size(); ++i)
    largest = std::max(largest, off(a.responses[i].amplitude, b.responses[i].amplitude));
  largest = std::max(largest, off(a.energy_input, b.energy_input));
  return std::max(largest, off(a.energy_total(), b.energy_total()));
}

// Along frequencies.
double difference(const scene::Scene& a, const scene::Scene& b) {
  double largest = 0;
  for (const double w : frequencies)
    largest = std::max(largest, difference(scenes::response_at(a, w), scenes::response_at(b, w)));
  return largest;
}

std::vector<observables::ResponsePoint> peaks(const scene::Scene& s, double from, double to) {
  std::vector<observables::ResponsePoint> found;
  const auto branches = observables::frequency_response(s, {from, to});
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].status == observables::Status::complete);
  for (const auto& event : branches[0].events)
    if (event.kind == "peak") found.push_back(event.point);
  return found;
}

}  // namespace

TEST_CASE("each sector of a full ring from matrices moves as the one sector does") {
  const Folder folder = files();
  const std::string rotation = R"(, "rotation": {"name": "disk", "speed": 0.7, "highest_speed": 1})";
  const std::string with_rotation = R"(, "stiffness_speed_squared": "K2.mtx", "gyroscopic": "G.mtx")";
  for (const std::string& elements : {std::string(), friction})
    for (const Given& given : {Given{6, 2, "", "", elements}, Given{6, -1, reduced, "", elements},
                               Given{5, 0, "", "", elements}, Given{6, 2, with_rotation, rotation, elements},
                               Given{5, 6, with_rotation + reduced, rotation, elements}}) {
      CAPTURE(given.keys, given.sectors, given.order, elements);
      const scene::Scene one = from_matrices(given, Ring::sector, folder),
                         all = from_matrices(given, Ring::full, folder);
      double largest = 0;
      for (const double w : frequencies) {
        const auto a = scenes::response_at(one, w), b = scenes::response_at(all, w);
        largest = std::max(largest, off(b.amplitude, a.amplitude));
        const auto n = static_cast<std::size_t>(given.sectors);
        REQUIRE(b.responses.size() == 2 * n);
        for (std::size_t i = 0; i < 2 * n; ++i)
          largest = std::max(largest, off(b.responses[i].amplitude, a.responses[i / n].amplitude));
        largest = std::max(largest, off(b.energy_total(), given.sectors * a.energy_total()));
      }
      CHECK(largest < 1e-10);
      if (given.keys.empty() && given.order == 2) {
        const auto of_one = peaks(one, 0.5, 1.3), of_all = peaks(all, 0.5, 1.3);
        REQUIRE(of_one.size() >= 1);
        REQUIRE(of_all.size() == of_one.size());
        for (std::size_t i = 0; i < of_one.size(); ++i) {
          CHECK(off(of_all[i].amplitude, of_one[i].amplitude) < 1e-10);
          CHECK(off(of_all[i].omega, of_one[i].omega) < 1e-8);
        }
      }
    }
}

TEST_CASE("a wave of the other sense is another motion of a ring from matrices") {
  const Folder folder = files();
  const scene::Scene ring = from_matrices({6, 2}, Ring::full, folder),
                     back = from_matrices({6, -2}, Ring::full, folder);
  CHECK(difference(ring, back) > 1e-3);
}

TEST_CASE("a full ring from matrices with mistuned parts is that of masses and springs") {
  const Folder folder = files();
  const std::string damped =
      R"(, "damping": [{"name": "z", "type": "modal", "ratio": 0.01}, {"name": "r", "type": "rayleigh", "alpha": 0.01, "beta": 0.02}])";
  for (const std::string& elements : {std::string(), friction})
    for (const std::string& keys : {std::string(), reduced})
      for (const std::string& structure : {std::string(), damped}) {
        CAPTURE(elements, keys, structure);
        Given given{6, 2, keys, structure, elements};
        given.link = by_hub;
        given.mass = by_mass;
        if (!elements.empty()) given.load = by_load;
        const scene::Scene ring = from_matrices(given, Ring::full, folder);
        CHECK(difference(ring, by_hand(given)) < 1e-10);
        // What is seen of a neighbour that is taken for another.
        std::rotate(given.link.begin(), given.link.begin() + 1, given.link.end());
        CHECK(difference(ring, by_hand(given)) > 1e-3);
      }
}

TEST_CASE("a full ring with mistuned stiffness matrices has each spring of a sector that much stiffer") {
  const Folder folder = files();
  for (const std::string& elements : {std::string(), friction})
    for (const std::string& keys : {std::string(), reduced}) {
      CAPTURE(elements, keys);
      Given given{6, 1, keys, "", elements};
      given.stiffness = by_blade;
      const scene::Scene ring = from_matrices(given, Ring::full, folder);
      CHECK(difference(ring, by_hand(given)) < 1e-10);
      given.stiffness[4] *= 1.001;
      CHECK(difference(ring, by_hand(given)) > 1e-5);
    }
}

TEST_CASE("a shape acts on each sector of a full ring, later by the engine order") {
  const Folder folder = files();
  for (const std::string& keys : {std::string(), reduced}) {
    CAPTURE(keys);
    Given given{6, 2, keys, "", friction};
    given.stiffness = by_blade;
    given.excitation = R"({"name": "p", "shape": "p.mtx", "imaginary_shape": {"file": "p.mtx", "column": 2},
      "cosine": 0.6, "sine": 0.2, "at": "pad"}, {"name": "q", "shape": {"file": "p.mtx", "column": 2}, "harmonic": 3,
      "cosine": 0.1})";
    // (0.6 - 0.2 i) (S_r + i S_i): cosine 0.6 S_r + 0.2 S_i, sine 0.2 S_r - 0.6 S_i
    std::vector<Push> pushes;
    for (int row = 0; row < 4; ++row) {
      const double re = 0.5 - 0.2 * row, im = 0.5 - 0.2 * (row + 4);
      pushes.push_back({"p" + std::to_string(row) + "_", row, 1, 0.6 * re + 0.2 * im, 0.2 * re - 0.6 * im});
      pushes.push_back({"q" + std::to_string(row) + "_", row, 3, 0.1 * im, 0});
    }
    pushes.push_back({"pad_", 4, 1, 0.6, 0.2});
    const scene::Scene ring = from_matrices(given, Ring::full, folder);
    CHECK(ring.excitation.size() == 12);
    CHECK(difference(ring, by_hand(given, {}, 0, pushes)) < 1e-10);
  }
}

TEST_CASE("a motion of the ground goes around a full ring from matrices") {
  const Folder folder = files();
  for (const std::string& keys : {std::string(), reduced}) {
    CAPTURE(keys);
    Given given{6, 2, keys, "", friction};
    given.link = by_hub;
    given.excitation =
        R"({"name": "g", "type": "base_acceleration", "shape": "r.mtx", "at": "pad", "cosine": 0.5, "sine": 0.1})";
    CHECK(difference(from_matrices(given, Ring::full, folder),
                     by_hand(given, {}, 0, {{"g", -1, 1, 0.5, 0.1}})) < 1e-10);
  }
}

TEST_CASE("a full ring from matrices stiffens with its speed") {
  const Folder folder = files();
  for (const std::string& keys : {std::string(), reduced}) {
    CAPTURE(keys);
    Given given{6, 2, keys + R"(, "stiffness_speed_squared": "K2.mtx")", "", friction};
    given.stiffness = by_blade;
    const scene::Scene parts = by_hand(given, {}, 0.8);
    given.structure = R"(, "rotation": {"name": "disk", "speed": 0.8, "highest_speed": 1})";
    CHECK(difference(from_matrices(given, Ring::full, folder), parts) < 1e-10);
  }
}

namespace {

// A blade of 29 stiff masses on the hub, whose damper alone is not proportional.
Sector long_sector() {
  Sector sector{{2}, {{0, -1, 40}}, {{0, -1, 0.3}}, {}};
  for (int i = 1; i <= 29; ++i) {
    sector.masses.push_back(0.01 + 0.001 * (i % 3));
    sector.springs.push_back({i, i - 1, 3000.0 + 200 * (i % 5)});
  }
  return sector;
}

}  // namespace

TEST_CASE(
    "reduced copies move as whole ones, within the error that is reported, also where each is another") {
  const Folder folder = files(long_sector(), "name,row\ntip.z,30\nhub,1\n");
  for (const bool mistuned : {false, true}) {
    Given given{5, 2, "", "", friction, "", 3};
    given.excitation = R"({"name": "p", "shape": "p.mtx", "cosine": 0.3})";
    if (mistuned) given.stiffness = {1, 1.1, 0.95, 1.02, 1.1};
    const scene::Scene whole = from_matrices(given, Ring::full, folder);
    given.keys = R"(, "highest_frequency": 14)";
    const scene::Scene less = from_matrices(given, Ring::full, folder);
    const model::Model model = model::build(less);
    REQUIRE(model.reduction);
    CAPTURE(mistuned, model.reduction->coordinates, model.reduction->error);
    CHECK(model.reduction->rows == 30);
    CHECK(model.reduction->kept == 2);
    CHECK(model.reduction->coordinates < 20);
    CHECK(model.reduction->error < 1e-9);
    if (!mistuned) CHECK(model.dofs == 5 * (3 + model.reduction->coordinates));
    CHECK(contains(observables::prepare(less, {}), "of 30 rows was reduced to 2 of them and "));
    CHECK(contains(observables::prepare(less, {}), " coordinates in each of 5 copies; error"));
    const auto reported = studies::header(less).reduction;
    CHECK(
        std::any_of(reported.begin(), reported.end(), [](const auto& each) { return each.key == "copies"; }));
    double largest = 0;
    for (const double w : {0.6, 1.4, 2.2, 3.0, 4.5})
      largest = std::max(largest, difference(scenes::response_at(less, w), scenes::response_at(whole, w)));
    CHECK(largest < 100 * std::max(model.reduction->error, 1e-11));
  }
}

TEST_CASE("the motion in time of a full ring from matrices is that of harmonic balance") {
  const Folder folder = files();
  Given given{3, 1, "", "", friction, R"({"name": "f", "at": "tip.z", "cosine": 1})", 31};
  given.stiffness = {1, 1.1, 0.9};
  const scene::Scene ring = from_matrices(given, Ring::full, folder);
  const auto in_time = observables::motion_in_time(ring, {0.9});
  REQUIRE(in_time.status == observables::Status::complete);
  CHECK(off(in_time.amplitude, scenes::response_at(ring, 0.9).amplitude) < 1e-3);
}
