// Ensembles: rows against closed forms, and that nothing is lost or twice whatever ends a run.

#include "catch.hpp"
#include "environment.hpp"
#include "program.hpp"
#include "random.hpp"
#include "size.hpp"
#include "volume.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <thread>

using namespace app_test;
using namespace std::chrono_literals;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinRel;

namespace {

const std::string distributions =
    R"({"distributions": {"k.value": {"uniform": [3000, 4500]}, "d.normal_load": {"normal": [3, 0.3]}}, "count": 200,
        "design": "latin_hypercube"})";

/// One mass and one damper, over samples.
std::string scene_with(const std::string& for_each, double friction_coefficient = 0.5,
                       const std::string& study = R"("name": "load", "kind": "frf", "from": 5, "to": 16)") {
  return R"({"format": "arcslip-scene-1", "structure": {"dofs": ["a"],
    "masses": [{"name": "m", "at": "a", "value": 1}], "springs": [{"name": "k", "at": "a", "value": 4000}],
    "dampers": [{"name": "c", "at": "a", "value": 2}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "a", "stiffness": 1000, "friction_coefficient": )" +
         std::to_string(friction_coefficient) + R"(, "normal_load": 3}],
    "excitation": [{"name": "f", "at": "a", "cosine": 5}], "harmonics": {"order": 3}, "response": {"at": "a"},
    "studies": [{)" +
         study + R"(, "for_each": )" + for_each + "}]}";
}

/// Cells of a table by its title, a row each.
using Row = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> titles = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    REQUIRE(cells.size() == titles.size());
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < titles.size(); ++i) row[titles[i]] = cells[i];
  }
  return rows;
}

std::string csv_of(const Workplace& place, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--csv", "-"});
  const Ended ended = run(place, arguments);
  CAPTURE(ended.err);
  REQUIRE(ended.exit_code == 0);
  return ended.out;
}

/// Returns what a run says that cannot be.
std::string refusal(const Workplace& place, const std::vector<std::string>& arguments) {
  const Ended ended = run(place, arguments);
  CAPTURE(ended.out);
  CHECK(ended.exit_code == 1);
  CHECK(ended.out.empty());
  return ended.err;
}

}  // namespace

TEST_CASE("amplitudes of the samples of a linear oscillator are those of the closed form") {
  const Workplace place;
  place.write("scene.json", scene_with(R"({"distributions": {"k.value": {"uniform": [3000, 4500]},
      "c.value": {"lognormal": [2, 0.4]}}, "count": 60, "design": "sobol"})",
                                       0));
  const std::vector<Row> rows =
      rows_of(csv_of(place, {"ensemble", "scene.json", "--keep", "peak.amplitude,frequency"}));
  REQUIRE(rows.size() == 60);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    CHECK(row.at("sample") == std::to_string(i));
    CHECK(row.at("status") == "complete");
    const double k = std::stod(row.at("k.value (N/m)")), c = std::stod(row.at("c.value (N s/m)"));
    // Of x'' + c x' + k x = 5 cos(omega t), m = 1 kg.
    CHECK_THAT(std::stod(row.at("peak.amplitude (m)")), WithinRel(5 / (c * std::sqrt(k - c * c / 4)), 1e-8));
    CHECK_THAT(std::stod(row.at("frequency (Hz)")), WithinRel(std::sqrt(k - c * c / 2) / (2 * M_PI), 1e-6));
  }
}

TEST_CASE("rows are the same with any number of threads, and those of responses with the same values") {
  const Workplace place;
  place.write("scene.json", scene_with(distributions));
  const std::string one = csv_of(place, {"ensemble", "scene.json", "--threads", "1", "--out", "1.sqlite"});
  for (const std::string threads : {"2", "7"})
    CHECK(csv_of(place, {"ensemble", "scene.json", "--threads", threads, "--out", threads + ".sqlite"}) ==
          one);
  const Row row = rows_of(one)[17];
  const Ended response =
      run(place, {"frf", "scene.json", "--set", "k.value=" + row.at("k.value (N/m)"), "--set",
                  "d.normal_load=" + row.at("d.normal_load (N)"), "--csv", "one.csv"});
  REQUIRE(response.exit_code == 0);
  std::istringstream events(place.read("one.events.csv"));
  std::string titles, event;
  std::getline(events, titles);
  std::getline(events, event);
  const std::vector<std::string> names = cells_of(titles), cells = cells_of(event);
  for (const auto& [title, tolerance] : {std::pair{"amplitude (m)", 1e-8}, {"frequency (Hz)", 1e-6}}) {
    const auto at = std::find(names.begin(), names.end(), title) - names.begin();
    REQUIRE(at < static_cast<std::ptrdiff_t>(cells.size()));
    CHECK_THAT(std::stod(row.at(title)),
               WithinRel(std::stod(cells[static_cast<std::size_t>(at)]), tolerance));
  }
}

TEST_CASE(
    "an ensemble that is killed at any moment goes on where it was, and has the rows of one that is not") {
  const Workplace place;
  place.write("scene.json", scene_with(distributions));
  const std::string whole =
      csv_of(place, {"ensemble", "scene.json", "--out", "whole.sqlite", "--keep", "amplitude,events"});
  const std::vector<std::string> again = {"ensemble", "scene.json",       "--out",  "killed.sqlite",
                                          "--keep",   "amplitude,events", "--quiet"};
  const std::uint64_t kills = Volume{"ARCSLIP_KILLS", 6, 300}.count();
  test_random::Random random(7);
  long killed = 0;
  for (std::uint64_t i = 0; i < kills; ++i) {
    Program program(place, again);
    std::this_thread::sleep_for(random.between(0.0, 0.12) * 1s);
    program.send(SIGKILL);
    killed += program.wait().signal == SIGKILL;
    if (i % 20 == 19) fs::remove(place / "killed.sqlite");  // from the beginning
  }
  CHECK(killed > 0);
  CHECK(csv_of(place, again) == whole);
  CHECK(csv_of(place, again) == whole);  // which computes nothing
}

TEST_CASE("Ctrl-C keeps the samples that are there, and the same command goes on") {
  const Workplace place;
  std::string many = distributions;
  many.replace(many.find("200"), 3, "100000");
  place.write("scene.json", scene_with(many));
  Program program(place, {"ensemble", "scene.json"});
  while (!fs::exists(place / "out/scene.load.sqlite")) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(200ms);
  program.send(SIGINT);
  const Ended ended = program.wait();
  CHECK(ended.exit_code == 3);
  CHECK_THAT(ended.err, Contains("interrupted: ") &&
                            Contains(" of 100000 samples are in out/scene.load.sqlite; run the same "
                                     "command to go on"));
  CHECK(place.files() == std::vector<std::string>{"out", "out/scene.load.sqlite", "scene.json"});
}

TEST_CASE(
    "a file that becomes large is reported, and progress is shown, with samples that are not complete") {
  const Workplace place;
  // Of a constant force on a mass that nothing holds in half of the samples.
  std::string scene =
      scene_with(R"({"c.value": {"from": 2, "to": 3, "count": 100000}, "k.value": [4000, 0]})");
  scene.insert(scene.find(R"({"name": "f")"),
               R"({"name": "weight", "at": "a", "harmonic": 0, "cosine": 1}, )");
  place.write("scene.json", scene);
  Program program(place, {"ensemble", "scene.json", "--keep", "amplitude,points"}, {}, "", true);
  while (!fs::exists(place / "out/scene.load.sqlite-wal")) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(test_size::sized(1500ms, 15000ms));  // some hundred samples
  program.send(SIGINT);
  const Ended ended = program.wait();
  CHECK(ended.exit_code == 3);
  CHECK_THAT(ended.err,
             Contains("arcslip: the file will have about ") && Contains(" GB: Ctrl-C ends it; keep less"));
  CHECK(ended.err.find("GB: Ctrl-C") == ended.err.rfind("GB: Ctrl-C"));
  CHECK_THAT(ended.err, Contains("sample ") && Contains("/200000  0 %  ") && Contains("/s  ") &&
                            Contains(" not complete"));
}

TEST_CASE("a file is not continued by another scene, study or choice of quantities") {
  const Workplace place;
  place.write("scene.json", scene_with(distributions));
  csv_of(place, {"ensemble", "scene.json", "--out", "a.sqlite"});
  place.write("other.json", scene_with(distributions, 0.6));
  CHECK_THAT(refusal(place, {"ensemble", "other.json", "--out", "a.sqlite"}),
             Contains("a.sqlite: the scene has changed since, or an option that stands for one of its keys: "
                      "/elements/0/friction_coefficient was 0.5 (a "
                      "number), is 0.6 (a "
                      "number)"));
  CHECK_THAT(refusal(place, {"ensemble", "scene.json", "--set", "m.value=2", "--out", "a.sqlite"}),
             Contains("/structure/masses/0/value was 1 (a number), is 2 (a number)"));
  CHECK_THAT(
      refusal(place, {"ensemble", "scene.json", "--keep", "amplitude", "--out", "a.sqlite"}),
      Contains("found samples with keep \"frequency,amplitude,d.stick_percent\", must be \"amplitude\""));
  CHECK_THAT(refusal(place, {"ensemble", "scene.json", "--part", "1/2", "--out", "a.sqlite"}),
             Contains("found the samples 0 to 199, must be 0 to 99"));
  place.write("text.sqlite", "no database, but a text that is long enough to be one");
  CHECK_THAT(refusal(place, {"ensemble", "scene.json", "--out", "text.sqlite"}),
             Contains("text.sqlite: found a file that is no SQLite database"));
  CHECK(place.read("text.sqlite") == "no database, but a text that is long enough to be one");
  CHECK_THAT(refusal(place, {"merge", "text.sqlite", "--out", "b.sqlite"}), Contains("no SQLite database"));
  CHECK_THAT(refusal(place, {"merge", "none.sqlite", "--out", "b.sqlite"}),
             Contains("none.sqlite: unable to open"));
}

TEST_CASE("a file that another run writes is left alone") {
  const Workplace place;
  std::string many = distributions;
  many.replace(many.find("200"), 3, "1000000");
  place.write("scene.json", scene_with(many));
  Program program(place, {"ensemble", "scene.json", "--threads", "1"});
  while (!fs::exists(place / "out/scene.load.sqlite-wal")) std::this_thread::sleep_for(1ms);
  CHECK_THAT(refusal(place, {"ensemble", "scene.json"}), Contains("another run writes this file"));
  program.send(SIGINT);
  CHECK(program.wait().exit_code == 3);
}

TEST_CASE("parts make the whole, and nothing else does") {
  const Workplace place;
  place.write("scene.json", scene_with(distributions));
  const std::string whole = csv_of(place, {"ensemble", "scene.json", "--keep", "amplitude,events"});
  const std::string name = "out/scene.load.part-";
  for (const std::string part : {"1", "2", "3"}) {
    const Ended ended =
        run(place, {"ensemble", "scene.json", "--keep", "amplitude,events", "--part", part + "/3"});
    CHECK(ended.exit_code == 0);
    CHECK_THAT(ended.err, Contains("part " + part + "/3 is done: join all parts with arcslip merge"));
  }
  const std::string a = name + "1-of-3.sqlite", b = name + "2-of-3.sqlite", c = name + "3-of-3.sqlite";
  CHECK(csv_of(place, {"merge", c, a, b, "--out", "all.sqlite"}) == whole);
  CHECK_THAT(refusal(place, {"merge", a, b, c, "--out", "all.sqlite"}),
             Contains("all.sqlite: found a file, must be a new one"));
  CHECK_THAT(refusal(place, {"merge", a, c, "--out", "b.sqlite"}),
             Contains("samples 66 to 132 in none of the parts"));
  CHECK_THAT(refusal(place, {"merge", b, c, "--out", "b.sqlite"}),
             Contains("samples 0 to 65 in none of the parts"));
  CHECK_THAT(refusal(place, {"merge", a, b, "--out", "b.sqlite"}),
             Contains("samples 133 to 199 in none of the parts"));
  CHECK_THAT(refusal(place, {"merge", a, b, b, c, "--out", "b.sqlite"}),
             Contains("samples 66 to 132 both in " + b));
  place.write("other.json", scene_with(distributions, 0.6));
  REQUIRE(run(place,
              {"ensemble", "other.json", "--keep", "amplitude,events", "--part", "3/3", "--out", "o.sqlite"})
              .exit_code == 0);
  CHECK_THAT(
      refusal(place, {"merge", a, b, "o.sqlite", "--out", "b.sqlite"}),
      Contains("o.sqlite: not of the same ensemble as " + a + ": /elements/0/friction_coefficient was 0.5"));
  CHECK_FALSE(fs::exists(place / "b.sqlite"));
  CHECK_FALSE(fs::exists(place / "b.sqlite.unfinished"));
}

TEST_CASE("a part that is not whole is not joined") {
  const Workplace place;
  std::string many = distributions;
  many.replace(many.find("200"), 3, "100000");
  place.write("scene.json", scene_with(many));
  Program program(place, {"ensemble", "scene.json", "--out", "half.sqlite"});
  while (!fs::exists(place / "half.sqlite-wal")) std::this_thread::sleep_for(1ms);
  program.send(SIGINT);
  CHECK(program.wait().exit_code == 3);
  CHECK_THAT(refusal(place, {"merge", "half.sqlite", "--out", "b.sqlite"}),
             Contains("not computed yet: run arcslip ensemble for this part again"));
}

TEST_CASE("a sample that fails is a row with its reason") {
  const Workplace place;
  // A constant force on a mass that nothing holds.
  std::string scene = scene_with(R"([{"k.value": 4000}, {"k.value": 0}, {"k.value": 3000}])");
  scene.insert(scene.find(R"({"name": "f")"),
               R"({"name": "weight", "at": "a", "harmonic": 0, "cosine": 1}, )");
  place.write("scene.json", scene);
  const Ended ended =
      run(place, {"ensemble", "scene.json", "--csv", "a.csv", "--report", "page.html", "--quiet"});
  CHECK(ended.exit_code == 0);
  CHECK_THAT(place.read("page.html"), Contains("1 of 3 samples are not complete"));
  CHECK_THAT(ended.err, Contains("1 of 3 samples are not complete: their rows have status and reason"));
  const std::string csv = place.read("a.csv");
  CHECK_THAT(
      csv,
      Contains(
          "\n1,0,failed,\"no periodic response was found at 5 Hz: no spring holds the mean position of"));
  CHECK_THAT(csv, Contains("\n0,4000,complete,") && Contains("\n2,3000,complete,"));
  CHECK_THAT(ended.out,
             Contains("k.value (kN/m)") && Contains("3.5 "));  // the mean of those that are complete
}

TEST_CASE("quantities and tables that there are not have near words") {
  const Workplace place;
  place.write("scene.json", scene_with(distributions));
  for (const auto& [keep, message] : std::vector<std::pair<std::string, std::string>>{
           {"amplitud",
            R"(--keep: found the unknown quantity "amplitud", must be one of "frequency", "amplitude",)"},
           {"amplitud", R"(did you mean "amplitude"?)"},
           {"peak.amplitud", R"(did you mean "peak.amplitude"?)"},
           {"d.stick_percen", R"(did you mean "d.stick_percent"?)"},
           {"event", R"(did you mean "events"?)"},
           {"amplitude,,frequency", "must be names of quantities or tables, parted by commas"},
           {"d.slip_angles",
            R"(found "d.slip_angles", a list, must be a number: keep the table "events")"}}) {
    CAPTURE(keep);
    CHECK_THAT(refusal(place, {"ensemble", "scene.json", "--keep", keep}), Contains(message));
  }
  CHECK_FALSE(fs::exists(place / "out/scene.load.sqlite"));
  CHECK_THAT(refusal(place, {"ensemble", "scene.json", "--study", "lod"}),
             Contains("--study lod: the scene has no study of this name; did you mean load?"));
  for (const std::string part : {"3", "0/3", "4/3", "a/3", "1/"})
    CHECK_THAT(refusal(place, {"ensemble", "scene.json", "--part", part}), Contains("--part " + part));
  place.write("none.json", scene_with("{}"));
  CHECK_THAT(refusal(place, {"ensemble", "none.json"}), Contains("the scene has no study with \"for_each\""));
}

TEST_CASE("of studies without events the facts of a result are quantities") {
  const Workplace place;
  place.write("scene.json",
              scene_with(distributions, 0.5, R"("name": "load", "kind": "point", "frequency": 9)"));
  const std::vector<Row> rows = rows_of(csv_of(
      place, {"ensemble", "scene.json", "--keep", "amplitude,elements.d.stick_percent,energy_friction"}));
  REQUIRE(rows.size() == 200);
  const double load = std::stod(rows[3].at("d.normal_load (N)"));
  CHECK(std::stod(rows[3].at("amplitude (m)")) > 0);
  CHECK(std::stod(rows[3].at("energy_friction (J)")) <
        4 * 0.5 * load * std::stod(rows[3].at("amplitude (m)")));
  CHECK_THAT(refusal(place, {"ensemble", "scene.json", "--keep", "amplitud", "--out", "b.sqlite"}),
             Contains("did you mean \"amplitude\"?"));
}

TEST_CASE("the histogram of a quantity has all samples, and bands between their quantiles") {
  const Workplace place;
  place.write("scene.json", scene_with(distributions, 0));
  std::vector<double> amplitudes;
  for (const Row& row :
       rows_of(csv_of(place, {"ensemble", "scene.json", "--out", "all.sqlite", "--keep", "amplitude"})))
    amplitudes.push_back(std::stod(row.at("amplitude (m)")));
  const Ended ended = run(place, {"plot", "all.sqlite", "--figures", "svg", "--out", "figures"});
  CAPTURE(ended.err);
  REQUIRE(ended.exit_code == 0);
  std::istringstream lines(place.read("figures/all_amplitude.dat"));
  std::vector<std::pair<double, double>> outline;
  for (std::string line; std::getline(lines, line) && (outline.empty() || !line.empty());)
    if (double x = 0, y = 0; std::sscanf(line.c_str(), "%lf %lf", &x, &y) == 2) outline.emplace_back(x, y);
  REQUIRE(outline.size() == 42);  // two for each of 20 bins, and the ends on the axis
  CHECK(outline.front().second == 0);
  CHECK(outline.back().second == 0);
  const auto count_in = [&](double lower, double upper) {
    const bool is_last = upper == outline.back().first;
    double count = 0;
    for (const double a : amplitudes) count += a >= lower && (a < upper || is_last);
    return count;
  };
  for (std::size_t i = 1; i + 1 < outline.size(); i += 2) {
    CHECK(outline[i].second == outline[i + 1].second);
    CHECK(outline[i].second == count_in(outline[i].first, outline[i + 1].first));
  }
  std::sort(amplitudes.begin(), amplitudes.end());
  const std::string data = place.read("figures/all_amplitude.dat"), words = "5 to 95 % of the samples\n";
  REQUIRE(has(data, words));
  double lower = 0, upper = 0;
  REQUIRE(std::sscanf(data.c_str() + data.find(words) + words.size(), "%lf %*f %*f %lf", &lower, &upper) ==
          2);
  // Of 200 values the 5 % quantile is between the tenth and the eleventh, at 0.05 * 199 = 9.95.
  CHECK_THAT(lower, WithinRel(std::lerp(amplitudes[9], amplitudes[10], 0.95), 1e-12));
  CHECK_THAT(upper, WithinRel(std::lerp(amplitudes[189], amplitudes[190], 0.05), 1e-12));
  const std::string script = place.read("figures/all_amplitude.gp");
  CHECK(has(script, "5 to 95 % of the samples"));
  CHECK(has(script, "amplitude (mm)"));
  CHECK(has(refusal(place, {"plot", "all.sqlite", "--x", "frequency"}), "is an ensemble"));
  CHECK(has(refusal(place, {"show", "all.sqlite"}), "all.sqlite is the file of an ensemble: arcslip plot"));
  run(place, {"ensemble", "scene.json", "--part", "1/2", "--out", "part.sqlite"});
  CHECK(has(refusal(place, {"ensemble", "scene.json", "--part", "2/2", "--report", "page.html"}),
            "a part has no statistics"));
  CHECK(has(refusal(place, {"plot", "part.sqlite"}), "found no statistics"));
}

TEST_CASE("the table and the page of an ensemble take the place of no other file") {
  const Workplace place;
  const std::string scene = scene_with(distributions, 0);
  place.write("scene.json", scene);
  for (const std::string option : {"--csv", "--report"}) {
    CHECK(has(refusal(place, {"ensemble", "scene.json", "--out", "a.sqlite", option, "scene.json"}),
              "scene.json is the scene file itself"));
    CHECK(has(refusal(place, {"ensemble", "scene.json", "--out", "a.sqlite", option, "./a.sqlite"}),
              "the samples and " + option + " both go to ./a.sqlite"));
  }
  CHECK(has(refusal(place, {"ensemble", "scene.json", "--csv", "a.txt", "--report", "a.txt"}),
            "--csv and --report both go to a.txt"));
  CHECK(place.read("scene.json") == scene);
  for (const std::string part : {"1", "2"})
    run(place, {"ensemble", "scene.json", "--part", part + "/2", "--out", part + ".sqlite"});
  const std::string before = place.read("2.sqlite");
  CHECK(has(refusal(place, {"merge", "1.sqlite", "2.sqlite", "--out", "all.sqlite", "--csv", "./2.sqlite"}),
            "--csv ./2.sqlite is one of the parts"));
  CHECK(has(refusal(place, {"merge", "1.sqlite", "2.sqlite", "--out", "all.txt", "--csv", "all.txt"}),
            "--out and --csv both go to all.txt"));
  CHECK(place.read("2.sqlite") == before);
}

TEST_CASE("the page of an ensemble has its statistics, histograms and doubts") {
  const Workplace place;
  place.write("scene.json", scene_with(distributions, 0));
  const Ended whole = run(place, {"ensemble", "scene.json", "--out", "all.sqlite", "--keep", "amplitude",
                                  "--report", "all.html", "--quiet"});
  REQUIRE(whole.exit_code == 0);
  const std::string page = place.read("all.html");
  CHECK(has(page, "No doubts"));
  CHECK(has(page, whole.out.substr(0, whole.out.find('\n'))));  // titles of the statistics
  CHECK(has(page, "samples over amplitude"));
  CHECK(has(page, "25 to 75 %"));
}

TEST_CASE("the example of an array of parts has the rows of one run") {
  const Workplace place;
  const fs::path example = fs::path(source_folder()) / "examples/ensemble";
  fs::copy_file(example / "array.sbatch", place / "array.sbatch");
  std::ifstream file(example / "scene.json");
  std::string scene{std::istreambuf_iterator<char>(file), {}};
  scene.replace(scene.find("2048"), 4, "50");
  place.write("scene.json", scene);
  const std::string whole = csv_of(place, {"ensemble", "scene.json"});
  fs::rename(place / "out/scene.frf.sqlite", place / "whole.sqlite");
  const std::string command =
      "cd '" + place.path() + "' && PATH='" + fs::path(arcslip_program()).parent_path().string() +
      "':$PATH SLURM_ARRAY_TASK_COUNT=4 && export PATH SLURM_ARRAY_TASK_COUNT && seq 4 | xargs -P 2 -I{} env "
      "SLURM_ARRAY_TASK_ID={} bash array.sbatch >listed";
  REQUIRE(std::system(command.c_str()) == 0);
  std::vector<std::string> merge = {"merge"};
  for (const std::string& name : place.files())
    if (name.starts_with("out/")) merge.push_back(name);
  REQUIRE(merge.size() == 5);
  merge.insert(merge.end(), {"--out", "out/scene.frf.sqlite"});
  CHECK(csv_of(place, merge) == whole);
}
