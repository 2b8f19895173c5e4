// Maps of patches of contacts: their tiles are the contacts, and their integrals the totals of the patch.
#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/figures/layout.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/studies/presentation/branches.hpp>
#include <arcslip/studies/presentation/figure_parts.hpp>
#include <arcslip/studies/presentation/selection.hpp>

#include <algorithm>
#include <memory>
#include <sstream>

using namespace arcslip;
using observables::ResponseBranch;
using results::FigureData;
using results::FigureTile;
using results::FigureView;

namespace {

constexpr const char* grid =
    "tangential,normal,area,pressure,x,y\n"
    "t,n - 0.05*r,2e-4,4e4,0,0.02\nt,n,2e-4,6e4,0.02,0.02\nt,n + 0.05*r,2e-4,2e4,0.04,0.02\n"
    "t,n - 0.05*r,2e-4,4e4,0,0.03\nt,n,2e-4,6e4,0.02,0.03\nt,n + 0.05*r,2e-4,2e4,0.04,0.03\n";

scene::Scene plate(const std::string& rows, const char* more = "") {
  const Folder folder = {{"pad.csv", rows}};
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", )" +
                           scenes::uncoupled({{"t", 1, 1e4, 4}, {"n", 1, 2e4, 4}, {"r", 0.01, 200, 0.04}}) +
                           R"(, "patches": [{"name": "pad", "law": "contact_2d", "file": "pad.csv",
      "tangential_stiffness": 3e7, "normal_stiffness": 4.5e7, "friction_coefficient": 0.4)" +
                           more + R"(}],
    "excitation": [{"name": "f", "direction": {"t": 1, "n": 0.6, "r": 0.02}, "cosine": 20}],
    "response": {"at": "t"}, "harmonics": {"order": 3},
    "studies": [{"kind": "frf", "from": 80, "to": 140}]})",
                       folder.path());
}

std::vector<ResponseBranch> response(const scene::Scene& s) {
  return observables::frequency_response(s, scenes::window(s));
}

const FigureView* view(const FigureData& data, const std::string& name) {
  const auto found = std::find_if(data.figures.begin(), data.figures.end(),
                                  [&](const FigureView& each) { return each.name == name; });
  return found == data.figures.end() ? nullptr : &*found;
}

double area(const FigureTile& tile) {
  return (tile.right - tile.left) * (tile.upper - tile.lower);
}

}  // namespace

TEST_CASE(
    "a map has a tile for each contact at the highest peak, and its integral is the total of the patch") {
  const scene::Scene s = plate(grid, R"(, "wear_coefficient": 1e-13)");
  std::vector<ResponseBranch> branches = response(s);
  scene::Scene louder = s;
  louder.excitation[0].values[0] = 25;
  for (ResponseBranch& branch : response(louder)) {
    branch.set = {{"f.cosine", 25}};
    branches.push_back(std::move(branch));
  }
  const auto maps = studies::patch_maps(s, branches);
  REQUIRE(maps.size() == 1);
  const FigureData& data = maps[0];
  CHECK(data.name == "patch_pad");
  const auto& events = branches.back().events;
  const auto peak = std::max_element(events.begin(), events.end(), [](const auto& a, const auto& b) {
    return a.point.amplitude < b.point.amplitude;
  });
  REQUIRE(peak->kind == observables::event_kinds::peak.name);
  const auto& patch = peak->point.patches.at(0);
  std::size_t count = 0;
  for (const auto& [name, total] : {std::pair{"dissipation", patch.energy},
                                    {"wear", patch.wear_rate},
                                    {"stick", 1.2e-3 * patch.stick_percent},
                                    {"separation", 1.2e-3 * patch.open_percent}}) {
    CAPTURE(name);
    const FigureView* map = view(data, name);
    REQUIRE(map);
    REQUIRE(map->tiles.size() == 6);
    double sum = 0;
    for (const FigureTile& tile : map->tiles) sum += tile.value * area(tile);
    CHECK(sum == Approx(total).epsilon(1e-12));
    CHECK(contains(map->note, "pad at the resonance peak at "));
    CHECK(contains(map->note, " rad/s, 25 N"));
    ++count;
  }
  const FigureView* pressure = view(data, "pressure");
  REQUIRE(pressure);
  CHECK(data.figures.size() == count + 1);
  const auto most = std::max_element(pressure->tiles.begin(), pressure->tiles.end(),
                                     [](const auto& a, const auto& b) { return a.value < b.value; });
  CHECK(most->value == patch.extremes.pressure_max);
  // The grid of 20 mm x 10 mm is covered without gaps.
  const FigureTile& second = pressure->tiles[1];
  CHECK(second.left == Approx(0.01).epsilon(1e-12));
  CHECK(second.right == Approx(0.03).epsilon(1e-12));
  CHECK(second.lower == Approx(0.015).epsilon(1e-12));
  CHECK(second.upper == Approx(0.025).epsilon(1e-12));
}

TEST_CASE("contacts in a row are as wide as their distance, and one alone is a square") {
  const auto tile_of = [](const std::string& rows) {
    const scene::Scene s = plate("tangential,normal,area,pressure,x,y\n" + rows);
    return studies::patch_maps(s, response(s)).at(0).figures.at(0).tiles.at(0);
  };
  const FigureTile row = tile_of("t,n,2e-4,4e4,0.1,0\nt,n,2e-4,4e4,0.105,0\nt,n,2e-4,4e4,0.11,0\n"),
                   column = tile_of("t,n,2e-4,4e4,0,0.1\nt,n,2e-4,4e4,0,0.105\n"),
                   alone = tile_of("t,n,4e-4,4e4,3,4\n"),
                   rounded = tile_of("t,n,2e-4,4e4,0.1,0\nt,n,2e-4,4e4,0.105,1e-17\nt,n,2e-4,4e4,0.11,0\n");
  CHECK(rounded.right - rounded.left == Approx(0.005).epsilon(1e-9));
  CHECK(rounded.upper - rounded.lower == Approx(0.04).epsilon(1e-9));
  CHECK(row.right - row.left == Approx(0.005).epsilon(1e-9));
  CHECK(area(row) == Approx(2e-4).epsilon(1e-9));
  CHECK(column.upper - column.lower == Approx(0.005).epsilon(1e-9));
  CHECK(area(column) == Approx(2e-4).epsilon(1e-9));
  CHECK(alone.right - alone.left == Approx(0.02).epsilon(1e-9));
  CHECK(alone.upper - alone.lower == Approx(0.02).epsilon(1e-9));
}

TEST_CASE("tiles are drawn in classes of round values, each tile in the class that has its value") {
  const scene::Scene s = plate(grid);
  const auto maps = studies::patch_maps(s, response(s));
  const auto all = figures::figures_of(maps.at(0));
  REQUIRE(all.size() == maps[0].figures.size());
  for (const results::Figure& figure : all) {
    CAPTURE(figure.name);
    const FigureView& map = *view(maps[0], figure.name);
    CHECK((figure.x.range.upper - figure.x.range.lower) / figure.x.factor ==
          Approx(1.5 * (figure.y.range.upper - figure.y.range.lower) / figure.y.factor).epsilon(1e-12));
    REQUIRE(figure.classes == figure.key.size());
    std::size_t tiles = 0;
    for (const results::FigureFill& fill : figure.fills) {
      const double from = std::stod(fill.name), to = std::stod(fill.name.substr(fill.name.find(" to ") + 4));
      for (const auto& strip : fill.strips) {
        ++tiles;
        const auto tile = std::find_if(map.tiles.begin(), map.tiles.end(), [&](const FigureTile& each) {
          return each.left == strip[0][0] && each.lower == strip[0][1];
        });
        REQUIRE(tile != map.tiles.end());
        const double shown = tile->value * results::prefixed(map.value.unit, map.value.range.upper).factor;
        CHECK(shown >= from * (1 - 1e-9));
        CHECK(shown <= to * (1 + 1e-9));
      }
    }
    CHECK(tiles == 6);
  }
}

TEST_CASE("without places, and without a peak, there is no map") {
  const scene::Scene unplaced = plate("tangential,normal,area,pressure\nt,n,2e-4,4e4\n");
  CHECK(studies::patch_maps(unplaced, response(unplaced)).empty());
  const scene::Scene s = plate(grid);
  std::vector<ResponseBranch> branches = response(s);
  for (ResponseBranch& branch : branches) branch.events.clear();
  CHECK(studies::patch_maps(s, branches).empty());
}

TEST_CASE("tables have the contacts of a patch where they are named, and its totals always") {
  const scene::Scene s = plate(grid);
  const auto branches = response(s);
  const auto header_of = [&](std::vector<std::string> columns) {
    std::ostringstream out;
    studies::Selected to(std::make_unique<results::CsvWriter>(out, "points"), {std::move(columns), {}}, true);
    results::replay(studies::results_of(s, branches), to);
    return out.str().substr(0, out.str().find('\n'));
  };
  const std::string all = header_of({});
  CHECK(contains(all, "patches.pad.stick_percent (%)"));
  CHECK(contains(all, "patches.pad.pressure_max (Pa)"));
  CHECK_FALSE(contains(all, "pad.2"));
  const std::string named = header_of({"frequency", "pad.2.stick_percent"});
  CHECK(contains(named, "pad.2.stick_percent (%)"));
  CHECK_FALSE(contains(named, "pad.1"));
}
