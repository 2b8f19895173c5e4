// The figures of Al Sayed et al. (2011) by examples/al_sayed_2011/figures.json: each is made, drawn and shown
// in docs/al_sayed_2011.md, and its checks hold. A check takes one number of a data file:
//   block, column   which curve (0 is the first), and which of its columns
//   where           only the rows from .. to of a column; or, with "at", where that column `is` a value
//   take            first, last, min, max, largest (absolute), range (max - min), at (interpolated),
//                   top and bottom (of the parabola through the extreme row and its neighbours, over the
//                   column `over`; its place is checked too)
// and compares it: `is` to `within`, or `at_least` and `at_most`.

#include "catch.hpp"
#include "environment.hpp"

#include <arcslip/output/process.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const fs::path source = source_folder();
const fs::path scenes = source / "examples/al_sayed_2011";

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Json all_figures() {
  return Json::parse(text_of(scenes / "figures.json")).at("figures");
}

/// A folder of its own, with the scripts and the data of the figures.
class Made {
 public:
  Made() : folder(fs::temp_directory_path() / ("arcslip_figures_" + std::to_string(::getpid()))) {
    fs::create_directories(folder);
    for (const auto& file : fs::directory_iterator(scenes / "figures"))
      if (file.path().extension() == ".gp") fs::copy(file, folder);
    ended = arcslip::output::run_program(program_named("ARCSLIP_FIGURES"), {scenes.string(), folder.string()},
                                         ".");
  }
  Made(const Made&) = delete;
  Made& operator=(const Made&) = delete;
  ~Made() { fs::remove_all(folder); }

  const fs::path folder;
  arcslip::output::ProcessResult ended;
};

using Rows = std::vector<std::vector<double>>;

struct Table {
  std::vector<std::string> columns;
  std::vector<Rows> blocks;

  std::size_t column(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) throw std::runtime_error("no column " + name);
    return static_cast<std::size_t>(found - columns.begin());
  }
};

Table read_table(const fs::path& path) {
  Table table;
  std::ifstream in(path);
  if (!in) throw std::runtime_error("no data file " + path.string());
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (line[0] == '#') {
      const std::string number = "# " + std::to_string(table.columns.size() + 1) + " ";
      if (line.rfind(number, 0) == 0) table.columns.push_back(line.substr(number.size()));
    } else if (line[0] == '"') {
      table.blocks.emplace_back();
    } else {
      std::istringstream values(line);
      std::vector<double> row;
      for (std::string value; values >> value;) row.push_back(std::stod(value));
      if (row.size() != table.columns.size()) throw std::runtime_error("a row of another length");
      table.blocks.back().push_back(row);
    }
  }
  return table;
}

struct Reading {
  double value, place;
};

/// Extreme of the parabola through the rows around the extreme one.
Reading extreme(const Rows& rows, std::size_t y, std::size_t x, double sign) {
  std::size_t k = 1;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i)
    if (sign * rows[i][y] > sign * rows[k][y]) k = i;
  const double a = rows[k - 1][x] - rows[k][x], b = rows[k + 1][x] - rows[k][x];
  const double left = (rows[k - 1][y] - rows[k][y]) / a, right = (rows[k + 1][y] - rows[k][y]) / b;
  const double curvature = (right - left) / (b - a), slope = left - curvature * a;
  const double step = -slope / (2 * curvature);
  return {rows[k][y] + step * (slope + curvature * step), rows[k][x] + step};
}

double interpolated(const Rows& rows, std::size_t y, std::size_t x, double where) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i][x] == where) return rows[i][y];
    if (i + 1 == rows.size() || (rows[i][x] - where) * (rows[i + 1][x] - where) > 0) continue;
    const double share = (where - rows[i][x]) / (rows[i + 1][x] - rows[i][x]);
    return (1 - share) * rows[i][y] + share * rows[i + 1][y];
  }
  throw std::runtime_error("no row there");
}

Reading take(const Table& table, const Json& check) {
  Rows rows = table.blocks.at(check.value("block", 0));
  const std::size_t y = table.column(check.at("column"));
  const std::string what = check.at("take");
  if (what == "at") {
    const Json& where = check.at("where");
    return {interpolated(rows, y, table.column(where.at("column")), where.at("is")), 0};
  }
  if (check.contains("where")) {
    const Json& where = check.at("where");
    const std::size_t x = table.column(where.at("column"));
    const double from = where.at("from"), to = where.at("to");
    std::erase_if(rows, [&](const auto& row) { return row[x] < from || row[x] > to; });
  }
  if (rows.empty()) throw std::runtime_error("no rows");
  if (what == "top" || what == "bottom") {
    if (rows.size() < 3) throw std::runtime_error("too few rows");
    return extreme(rows, y, table.column(check.at("over")), what == "top" ? 1 : -1);
  }
  double least = rows[0][y], most = rows[0][y];
  for (const auto& row : rows) {
    least = std::min(least, row[y]);
    most = std::max(most, row[y]);
  }
  const std::map<std::string, double> values{
      {"first", rows.front()[y]}, {"last", rows.back()[y]},           {"min", least}, {"max", most},
      {"range", most - least},    {"largest", std::max(-least, most)}};
  return {values.at(what), 0};
}

bool holds(const Json& check, const Reading& taken) {
  bool held = std::isfinite(taken.value);
  if (check.contains("is"))
    held = held && std::abs(taken.value - check.at("is").get<double>()) <= check.at("within").get<double>();
  if (check.contains("at_least"))
    held = held && taken.value >= check.at("at_least").get<double>() &&
           taken.value <= check.at("at_most").get<double>();
  if (check.contains("place"))
    held = held &&
           std::abs(taken.place - check.at("place").get<double>()) <= check.at("place_within").get<double>();
  return held && (check.contains("is") || check.contains("at_least") || check.contains("place"));
}

}  // namespace

TEST_CASE("figures.json has every figure of the paper from 3 to 19, each with a scene, a script and checks") {
  std::set<std::string> wanted{"6a", "6b", "6c", "10a", "10b"}, found;
  for (int k = 3; k <= 19; ++k)
    if (k != 6 && k != 10) wanted.insert(std::to_string(k));
  for (const Json& figure : all_figures()) {
    const std::string name = figure.at("figure");
    CAPTURE(name);
    CHECK(found.insert(name).second);
    CHECK(fs::exists(scenes / figure.at("scene")));
    CHECK(fs::exists(scenes / figure.at("script")));
    CHECK(figure.at("checks").size() >= 2);
  }
  CHECK(found == wanted);
}

TEST_CASE("docs/al_sayed_2011.md shows every figure") {
  const std::string page = text_of(source / "docs/al_sayed_2011.md");
  for (const Json& figure : all_figures()) {
    const std::string image =
        "figures/al_sayed_2011/" + fs::path(figure.at("data").get<std::string>()).stem().string() + ".png";
    CAPTURE(image);
    CHECK(page.find("](" + image + ")") != std::string::npos);
    CHECK(fs::exists(source / "docs" / image));
  }
}

TEST_CASE("every figure has its data, and what figures.json says of it holds") {
  const Made made;
  REQUIRE(made.ended.exit_code == 0);
  for (const Json& figure : all_figures()) {
    const Table table = read_table(made.folder / figure.at("data"));
    CHECK(
        text_of(made.folder / figure.at("data")).find("# scene: " + figure.at("scene").get<std::string>()) !=
        std::string::npos);
    for (const Json& check : figure.at("checks")) {
      const Reading taken = take(table, check);
      CAPTURE(figure.at("figure").get<std::string>(), check.at("says").get<std::string>(), taken.value,
              taken.place);
      CHECK(holds(check, taken));
    }
  }
}

TEST_CASE("each script draws its figure from its data without a word") {
  const Made made;
  REQUIRE(made.ended.exit_code == 0);
  if (arcslip::output::run_program("gnuplot", {"--version"}, ".").end ==
      arcslip::output::ProcessEnd::not_found) {
    WARN("gnuplot is not there");
    return;
  }
  for (const Json& figure : all_figures()) {
    const fs::path script = fs::path(figure.at("script").get<std::string>()).filename();
    for (const std::string format : {"svg", "png"}) {
      const auto drawn = arcslip::output::run_program(
          "env", {"LC_ALL=C.UTF-8", "gnuplot", "-e", "format='" + format + "'", script},
          made.folder.string());
      CAPTURE(script.string(), format);
      CHECK(drawn.exit_code == 0);
      CHECK(drawn.text == "");
      CHECK(fs::file_size((made.folder / script).replace_extension(format)) > 5000);
    }
  }
}

TEST_CASE("a missing scene, study or friction element is named, and no figure is made") {
  const fs::path folder = fs::temp_directory_path() / ("arcslip_no_figures_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto message = [&](const std::string& scene) {
    if (!scene.empty()) std::ofstream(folder / "contact.scene.json") << scene;
    const auto ended = arcslip::output::run_program(program_named("ARCSLIP_FIGURES"),
                                                    {folder.string(), folder.string()}, ".");
    CHECK(ended.exit_code == 1);
    CHECK(!fs::exists(folder / "figure_03.dat"));
    return ended.text;
  };
  CHECK(message("").find("contact.scene.json") != std::string::npos);
  Json scene = Json::parse(text_of(scenes / "contact.scene.json"));
  scene["studies"].erase(0);
  CHECK(message(scene.dump()).find("no study history") != std::string::npos);
  scene["elements"][0] = {
      {"name", "damper"}, {"type", "cubic_spring"}, {"between", {"blade", "ground"}}, {"stiffness", 1}};
  scene["studies"] = Json::array();
  CHECK(message(scene.dump()).find("friction element") != std::string::npos);
  fs::remove_all(folder);
}
