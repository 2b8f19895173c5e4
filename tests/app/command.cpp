#include "catch.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace app_test;
using Json = nlohmann::json;

namespace {

const std::vector<std::string> quick{"frf",         "scene.json", "--set", "damper.normal_load=3",
                                     "--harmonics", "7"};

std::vector<std::string> quick_with(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = quick;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

bool have_gnuplot() {
  return std::system("gnuplot --version >/dev/null 2>&1") == 0;
}

}  // namespace

TEST_CASE("frf --json - prints one object and nothing else") {
  const Workplace place;
  const Ended ended = run(place, quick_with({"--json", "-"}));
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.empty());
  const Json json = Json::parse(ended.out);
  CHECK(json["format"] == "arcslip-branches-1");
  REQUIRE(json["branches"].size() == 1);
  const Json& branch = json["branches"][0];
  CHECK(branch["status"] == "complete");
  CHECK(branch["parameters"]["damper.normal_load"] == 3.0);
  REQUIRE(branch["events"].size() == 1);
  CHECK(branch["events"][0]["kind"] == "peak");
  // exact: 8.8497001e-4 m; seven harmonics leave some 1e-5 of it
  CHECK(branch["events"][0]["amplitude"].get<double>() == Approx(8.8497e-4).epsilon(1e-4));
  CHECK(branch["points"][0]["frequency"].get<double>() == Approx(18));
  CHECK(branch["points"].back()["frequency"].get<double>() == Approx(22));
  CHECK(place.files() == std::vector<std::string>{"scene.json"});
}

TEST_CASE("an accuracy chooses the harmonics, and the order is reported") {
  const Workplace place;
  const std::vector<std::string> accurate{"frf",        "scene.json", "--set", "damper.normal_load=3",
                                          "--accuracy", "1e-6"};
  const Ended text = run(place, accurate);
  CHECK(text.exit_code == 0);
  CHECK(text.err.find("with harmonics up to ") != std::string::npos);
  std::vector<std::string> to_json = accurate;
  to_json.insert(to_json.end(), {"--json", "-"});
  const Json branch = Json::parse(run(place, to_json).out)["branches"][0];
  CHECK(branch["accuracy"]["error"] <= 1e-6);
  CHECK(std::abs(branch["events"][0]["amplitude"].get<double>() / 8.84970009333055e-4 - 1) <= 1e-6);
  // The highest order that may be taken.
  std::vector<std::string> few = accurate;
  few.insert(few.end(), {"--harmonics", "9"});
  const Ended missed = run(place, few);
  CHECK(missed.exit_code == 0);
  CHECK(missed.err.find("the accuracy 1e-06 is not reached: ") != std::string::npos);
}

TEST_CASE("without harmonics in the scene an accuracy of 1e-4 chooses them") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene.erase("harmonics");
  place.write("silent.json", scene.dump());
  const Ended ended = run(place, {"frf", "silent.json", "--set", "damper.normal_load=3", "--json", "-"});
  CHECK(ended.exit_code == 0);
  const Json branch = Json::parse(ended.out)["branches"][0];
  CHECK(branch["accuracy"]["wanted"] == 1e-4);
  CHECK(branch["accuracy"]["error"] <= 1e-4);
  CHECK(branch["accuracy"]["order"] < 20);
  CHECK(std::abs(branch["events"][0]["amplitude"].get<double>() / 8.84970009333055e-4 - 1) <= 1e-4);
}

TEST_CASE("frf --csv - prints the table and nothing else") {
  const Workplace place;
  const Ended ended = run(place, {"frf", "scene.json", "--harmonics", "1", "--csv", "-"});
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.empty());
  CHECK(ended.out.find("study,damper.normal_load (N),branch,omega (rad/s),frequency (Hz),amplitude (m)") ==
        0);
  CHECK(ended.out.find("\r\nfrf,3,5,") != std::string::npos);
}

TEST_CASE("frf prints a table of peaks, and writes what it is asked to") {
  const Workplace place;
  const Ended ended =
      run(place,
          quick_with({"--json", "a.json", "--csv", "a.csv", "--from", "19", "--to", "21", "--coefficients"}));
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.empty());
  CHECK(ended.out.find("frequency (Hz)") != std::string::npos);
  CHECK(ended.out.find(" peak  ") != std::string::npos);
  CHECK(ended.out.find("complete") != std::string::npos);
  CHECK(place.files() ==
        std::vector<std::string>{"a.csv", "a.events.csv", "a.json", "a.summary.csv", "scene.json"});
  const Json branch = Json::parse(place.read("a.json"))["branches"][0];
  CHECK(branch["points"][0]["frequency"].get<double>() == Approx(19));
  CHECK(branch["harmonics"] == Json{1, 3, 5, 7});
  CHECK(branch["points"][0]["coefficients"].size() == 8);
}

TEST_CASE("frf takes its range from the command where the scene has no study") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene["studies"] = Json::array();
  place.write("bare.json", scene.dump());
  const Ended ended =
      run(place, {"frf", "bare.json", "--harmonics", "1", "--from", "19", "--to", "21", "--json", "-"});
  CHECK(ended.exit_code == 0);
  CHECK(Json::parse(ended.out)["branches"].size() == 1);
}

TEST_CASE("the resolved scene that run leaves gives the same results again, with the same hash") {
  const Workplace place;
  const std::vector<std::string> changes{"--set", "damper.normal_load=3", "--harmonics", "7"};
  std::vector<std::string> arguments{"run", "scene.json", "--out", "first", "--quiet"};
  arguments.insert(arguments.end(), changes.begin(), changes.end());
  CHECK(run(place, arguments).exit_code == 0);
  CHECK(run(place, {"run", "first/frf.scene.json", "--out", "second", "--quiet"}).exit_code == 0);
  const Json first = Json::parse(place.read("first/frf.json"));
  const Json second = Json::parse(place.read("second/frf.json"));
  CHECK(first["scene_hash"] == second["scene_hash"]);
  CHECK(first["branches"][0]["points"] == second["branches"][0]["points"]);
  CHECK(place.read("first/frf.csv") == place.read("second/frf.csv"));
}

TEST_CASE("run writes every study into out/NAME and reports the places of the files") {
  if (!have_gnuplot()) {
    WARN("gnuplot is not there");
    return;
  }
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene["studies"].push_back({{"name", "near the peak"}, {"kind", "frf"}, {"from", 19.5}, {"to", 20.5}});
  place.write("two.json", scene.dump());
  const Ended ended = run(place, {"run", "two.json", "--harmonics", "1"});
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.empty());
  for (const std::string name : {"frf", "near_the_peak"}) {
    for (const char* extension : {".scene.json", ".json", ".csv", ".events.csv", ".summary.csv", ".dat",
                                  ".gp", "_amplitude.svg", "_amplitude.png", "_stick.svg", "_stick.png"}) {
      const std::string path = "out/two/" + name + extension;
      CAPTURE(path);
      CHECK(std::filesystem::exists(place / path));
      CHECK(ended.out.find("\n" + path + "\n") != std::string::npos);
    }
  }
  for (const char* figure : {"_amplitude", "_frequency", "_amplitude_over_stick"}) {
    CAPTURE(figure);
    CHECK(std::filesystem::exists(place / ("out/two/peaks" + std::string(figure) + ".svg")));
  }
  CHECK(place.files().size() == 2 + 2 + 24 + 15 + 20 + 2);  // scenes, folders, results, manifest, report
  CHECK(Json::parse(place.read("out/two/frf.json"))["branches"].size() == 12);
}

TEST_CASE("run reports each branch in one file which study it is of") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene["studies"].erase(2);  // an optimum has a table of its own
  place.write("two.json", scene.dump());
  const Ended ended =
      run(place,
          {"run", "two.json", "--harmonics", "1", "--json", "a.json", "--csv", "a.csv", "--out", "results"},
          {{"PATH", "/nonexistent"}});
  CHECK(ended.exit_code == 0);
  const Json branches = Json::parse(place.read("a.json"))["branches"];
  REQUIRE(branches.size() == 13);
  CHECK(branches[0]["study"] == "frf");
  CHECK(branches[0]["kind"] == "frf");
  CHECK(branches[12]["study"] == "peaks");
  CHECK(branches[12]["kind"] == "peaks");
  const std::string csv = place.read("a.csv");
  CHECK(csv.find("study,branch,omega (rad/s),") == 0);
  CHECK(csv.find("\r\nfrf,1,") != std::string::npos);
  CHECK(csv.find("\r\npeaks,13,") != std::string::npos);
  CHECK(place.read("results/peaks.csv").find("study,branch,damper.normal_load (N),") == 0);
}

TEST_CASE("without gnuplot run says so, writes the data all the same, and is done") {
  const Workplace place;
  const Ended ended = run(place, {"run", "scene.json", "--harmonics", "1"}, {{"PATH", "/nonexistent"}});
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.find("arcslip: figures need gnuplot (Debian package gnuplot-nox)") == 0);
  std::vector<std::string> expected{"out", "out/scene", "out/scene/arcslip-manifest.json",
                                    "out/scene/report.html", "scene.json"};
  for (const std::string study : {"best_load", "frf", "peaks"})
    for (const char* extension : {".csv", ".dat", ".gp", ".json", ".scene.json"})
      expected.push_back("out/scene/" + study + extension);
  for (const char* extension : {".events.csv", ".summary.csv"})
    for (const std::string study : {"frf", "peaks"}) expected.push_back("out/scene/" + study + extension);
  expected.push_back("out/scene/best_load.summary.csv");
  for (const char* extension : {".dat", ".gp"})
    expected.push_back("out/scene/best_load_responses" + std::string(extension));
  std::sort(expected.begin(), expected.end());
  CHECK(place.files() == expected);
}

TEST_CASE("check prints the resolved scene, which is a fixed point") {
  const Workplace place;
  const Ended first =
      run(place, {"check", "scene.json", "--set", "damper.normal_load=7", "--harmonics", "3"});
  CHECK(first.exit_code == 0);
  // sqrt(k/m) and sqrt((k + k_d)/m); c/(2 m omega); F/k and F/(k + k_d)
  CHECK(first.err ==
        "arcslip: mass: 1.24 kg at \"blade\"\n"
        "arcslip: natural frequencies with all contacts free: 19.117 Hz; stuck: 20.903 Hz\n"
        "arcslip: damping ratios of these modes, without friction, free: 0.045 %; stuck: 0.0411 %\n"
        "arcslip: static deflection of the response under the amplitude of the forces: 55.9 \u00b5m with all "
        "contacts free, 46.75 \u00b5m stuck\n");
  const Json scene = Json::parse(first.out);
  CHECK(scene["harmonics"]["order"] == 3);
  CHECK(scene["elements"][0]["normal_load"] == 7.0);
  CHECK_FALSE(scene["studies"][0].contains("/for_each/damper.normal_load"_json_pointer));
  place.write("resolved.json", first.out);
  CHECK(run(place, {"check", "resolved.json"}).out == first.out);
  const Ended quiet = run(place, {"check", "resolved.json", "--quiet"});
  CHECK((quiet.out + quiet.err).empty());
}

TEST_CASE("check reports what is likely wrong with a scene") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene["studies"] = {{{"name", "far"}, {"kind", "frf"}, {"from", 100}, {"to", 200}}};
  place.write("far.json", scene.dump());
  const Ended ended = run(place, {"check", "far.json"});
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.find(
            "arcslip: check this: the window of the study \"far\", 100 Hz to 200 Hz, has no resonance "
            "of small motions: ") != std::string::npos);
  CHECK(Json::parse(ended.out)["studies"][0]["from"] == 100.0);
}

TEST_CASE(
    "windows that a scene leaves out are proposed, reported, in the resolved scene and in the results") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  for (const char* key : {"from", "to"}) scene["studies"][0].erase(key);
  for (const int study : {1, 2}) scene["studies"][study].erase("frequency");
  place.write("open.json", scene.dump());
  // kappa = 3500/17890: margins of 3 kappa/(2 pi) = 9.34 % around 19.117 Hz and 20.903 Hz.
  const std::string proposed =
      "was proposed: 17.3 Hz to 22.9 Hz, around the first resonance, 19.117 Hz with all contacts free and "
      "20.903 "
      "Hz stuck, with margins of 9.3 %";
  const Ended checked = run(place, {"check", "open.json"});
  CHECK(checked.exit_code == 0);
  for (const char* study : {"frf", "peaks", "best load"})
    CHECK(checked.err.find("arcslip: the window of the study \"" + std::string(study) + "\" " + proposed) !=
          std::string::npos);
  const Json resolved = Json::parse(checked.out)["studies"];
  CHECK(resolved[0]["from"] == 17.3);
  CHECK(resolved[0]["to"] == 22.9);
  for (const int study : {1, 2}) CHECK(resolved[study]["frequency"] == Json{17.3, 22.9});
  const Ended quiet = run(place, {"optimize", "open.json", "--json", "-", "--harmonics", "7", "--quiet"});
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.err.empty());
  const Json results = Json::parse(quiet.out);
  CHECK(results["notes"] == Json{"the window of the study \"best load\" " + proposed});
  const Ended ran = run(place, {"run", "open.json", "--harmonics", "1", "--out", "out"});
  CHECK(ran.err.find(proposed) != std::string::npos);
  CHECK(Json::parse(place.read("out/frf.scene.json"))["studies"][0]["to"] == 22.9);
  CHECK(place.read("out/report.html").find("Note: the window of the study &quot;frf&quot; was proposed") !=
        std::string::npos);
}

TEST_CASE("where no resonance is known a window has to be given") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene["studies"] = {{{"kind", "frf"}}};
  scene["excitation"][0]["cosine"] = 0;
  place.write("still.json", scene.dump());
  for (const char* verb : {"check", "run", "frf"}) {
    const Ended ended = run(place, {verb, "still.json"});
    CHECK(ended.exit_code == 2);
    CHECK(
        ended.err.find("still.json: /studies/0: found no window of frequencies, and none can be proposed") !=
        std::string::npos);
  }
}

TEST_CASE("harmonics beyond a reduction are reported with the scene, with its results and in them") {
  const Workplace place;
  place.write("beam.json",
              R"({"format": "arcslip-scene-1", "structure": {"beam": {"elements": 20, "length": 1,
      "young": 2.1e11, "density": 7850, "width": 0.04, "height": 0.02, "points": {"tip": 1}, "highest_frequency": 80},
      "damping": [{"name": "steel", "type": "rayleigh", "beta": 1e-4}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "tip", "stiffness": 1e4, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "f", "at": "tip", "cosine": 10}], "response": {"at": "tip"}, "harmonics": {"order": 5},
    "studies": [{"name": "frf", "kind": "frf", "from": 15, "to": 20}]})");
  const std::string doubt =
      "harmonics beyond highest_frequency of the reduction: 5 times 20 Hz is 100 Hz, above 80 Hz";
  const auto reports = [](const Ended& ended, const std::string& what) {
    return ended.err.find(what) != std::string::npos;
  };
  CHECK(reports(run(place, {"check", "beam.json"}), "the study \"frf\" has " + doubt));
  const Ended beyond = run(place, {"frf", "beam.json", "--json", "-"});
  CHECK(beyond.exit_code == 0);
  CHECK(reports(beyond, "the study \"frf\" has " + doubt));
  CHECK(reports(beyond, "branch 1 complete, but " + doubt));
  const Json json = Json::parse(beyond.out);
  CHECK(json["branches"][0]["doubt"] == doubt);
  CHECK(json["reduction"]["rows"] == 40);
  CHECK(json["reduction"]["kept"] == 1);
  CHECK(json["reduction"]["coordinates"].get<int>() < 39);
  CHECK(json["reduction"]["error"].get<double>() < 1e-7);
  CHECK(json["reduction"]["highest_frequency"] == 80.0);
  const Ended within = run(place, {"frf", "beam.json", "--to", "16", "--json", "-"});
  CHECK_FALSE(reports(within, "harmonics beyond"));
  CHECK_FALSE(Json::parse(within.out)["branches"][0].contains("doubt"));
}

TEST_CASE("help and version stand on standard output") {
  const Workplace place;
  const Ended version = run(place, {"--version"});
  CHECK(version.exit_code == 0);
  CHECK(version.out.find("arcslip ") == 0);
  CHECK(version.err.empty());
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"run", "--help"},
                                                    {"frf", "-h"},
                                                    {"trace", "-h"},
                                                    {"peaks", "-h"},
                                                    {"folds", "-h"},
                                                    {"bifurcations", "-h"},
                                                    {"time", "-h"},
                                                    {"modes", "-h"},
                                                    {"check", "--help"}}) {
    const Ended help = run(place, arguments);
    CHECK(help.exit_code == 0);
    CHECK(help.out.find("Usage: arcslip") != std::string::npos);
    CHECK(help.out.find("3 stopped early") != std::string::npos);
    CHECK(help.err.empty());
  }
}

TEST_CASE(
    "a complete branch dominated by rounding is reported on standard error, also with --quiet, and in the "
    "results") {
  const Workplace place;
  for (const std::string quiet : {"", "--quiet"}) {
    std::vector<std::string> arguments{"frf",         "scene.json",
                                       "--harmonics", "1",
                                       "--set",       "damper.normal_load=1",
                                       "--set",       "damper.stiffness=1.789e18",
                                       "--json",      "a.json"};
    if (!quiet.empty()) arguments.push_back(quiet);
    const Ended ended = run(place, arguments);
    CAPTURE(ended.err);
    CHECK(ended.exit_code == 0);
    const std::string why = "damper.stiffness = 1.789e+18 N/m is 1e+14 times k.value = 1.789e+04 N/m";
    CHECK(ended.err.find("arcslip: branch 1 complete, but dominated by rounding errors, "
                         "so that its results lose digits: " +
                         why) != std::string::npos);
    const Json branch = Json::parse(place.read("a.json"))["branches"][0];
    CHECK(branch["status"] == "complete");
    CHECK(branch["stop"]["message"].get<std::string>().find(why) != std::string::npos);
  }
}
