// Folders of results: no input is replaced, nothing of others is removed, and files that do not belong
// together are reported.

#include "results_folder.hpp"

#include "catch.hpp"
#include "program.hpp"
#include "random.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/file.h>
#include <sys/stat.h>

#include <fcntl.h>
#include <unistd.h>

using namespace app_test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* manifest = "arcslip-manifest.json";

Json one_mass(double mass) {
  return Json::parse(R"({"format": "arcslip-scene-1", "structure": {"dofs": ["a"],
    "masses": [{"name": "m", "at": "a", "value": 1}], "springs": [{"name": "k", "at": "a", "value": 4000}],
    "dampers": [{"name": "c", "at": "a", "value": 1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "a", "stiffness": 1000, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "f", "at": "a", "cosine": 5}], "harmonics": {"order": 1}, "response": {"at": "a"},
    "studies": [{"name": "one", "kind": "frf", "from": 5, "to": 16}]})")
      .patch(Json::parse(R"([{"op": "replace", "path": "/structure/masses/0/value", "value": )" +
                         std::to_string(mass) + "}]"));
}

// Two rows of a beam, its matrices and names in files.
void write_matrices(const Workplace& place, double stiffness) {
  fs::create_directory(place / "mesh");
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n";
  place.write("mesh/K.mtx", head + "1 1 " + std::to_string(stiffness) + "\n2 2 9000\n2 1 -3000\n");
  place.write("mesh/M.mtx", head + "1 1 1\n2 2 2\n2 1 0.1\n");
  place.write("mesh/names.csv", "name,row\ntip,1\nroot,2\n");
  place.write("solid.json", R"({"format": "arcslip-scene-1", "structure": {
    "matrices": {"mass": "mesh/M.mtx", "stiffness": "mesh/K.mtx", "highest_frequency": 30}, "names": "mesh/names.csv",
    "dampers": [{"name": "c", "at": "tip", "value": 1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "tip", "stiffness": 1000, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "f", "at": "tip", "cosine": 5}], "harmonics": {"order": 1}, "response": {"at": "tip"},
    "studies": [{"name": "K", "kind": "frf", "from": 5, "to": 16}]})");
}

std::string fnv(const std::string& text) {
  std::uint64_t state = 14695981039346656037u;
  for (const char c : text) state = (state ^ static_cast<unsigned char>(c)) * 1099511628211u;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state));
  return digits;
}

Json sets_of(const Workplace& place, const std::string& folder) {
  return Json::parse(place.read(folder + "/" + manifest))["sets"];
}

// A file of a set that is not what the manifest says; "" if there is none.
std::string wrong_file(const Workplace& place, const std::string& folder, const Json& set) {
  for (const auto& [name, hash] : set["files"].items())
    if (!fs::exists(place / (folder + "/" + name)) || fnv(place.read(folder + "/" + name)) != hash)
      return name;
  return "";
}

const std::map<std::string, std::string> no_gnuplot{{"PATH", "/nonexistent"}};

}  // namespace

TEST_CASE("no output replaces a file that the scene reads, in any verb and by any name") {
  const Workplace place;
  write_matrices(place, 4000);
  fs::create_hard_link(place / "mesh/M.mtx", place / "hard.csv");
  fs::create_symlink("mesh/names.csv", place / "soft.json");
  fs::create_symlink("mesh", place / "other");
  std::map<std::string, std::string> before;
  for (const char* file : {"solid.json", "mesh/K.mtx", "mesh/M.mtx", "mesh/names.csv"})
    before[file] = place.read(file);
  std::vector<std::vector<std::string>> outputs{
      {"--json", "soft.json"}, {"--csv", "hard.csv"}, {"--json", "other/M.mtx"}, {"--csv", "other/K.mtx"}};
  for (const auto& [file, text] : before)
    for (const char* option : {"--json", "--csv"})
      for (const std::string& name : {file, "./mesh/../" + file, (place / file).string()})
        outputs.push_back({option, name});
  const std::vector<std::vector<std::string>> verbs{
      {"run"},
      {"frf"},
      {"trace", "--over", "d.normal_load", "--from", "1", "--to", "9", "--frequency", "9"},
      {"peaks", "--over", "d.normal_load", "--from", "1", "--to", "9", "--frequency", "5", "16"},
      {"folds", "--over", "d.normal_load", "--from", "1", "--to", "9", "--frequency", "5", "16"},
      {"point", "--frequency", "9"},
      {"time", "--frequency", "9"},
      {"optimize", "--over", "d.normal_load=1:9", "--frequency", "5", "16"}};
  for (const std::vector<std::string>& verb : verbs)
    for (const std::vector<std::string>& output : outputs) {
      std::vector<std::string> arguments = verb;
      arguments.insert(arguments.begin() + 1, "solid.json");
      arguments.insert(arguments.end(), output.begin(), output.end());
      const Ended ended = run(place, arguments, no_gnuplot);
      CAPTURE(verb.front(), output.back(), ended.err);
      CHECK(ended.exit_code == 1);
      CHECK((ended.err.find("is the scene file itself") != std::string::npos ||
             ended.err.find("is a file that the scene reads") != std::string::npos));
      for (const auto& [file, text] : before) CHECK(place.read(file) == text);
    }

  // Names that a folder of results has by itself.
  fs::copy(place / "mesh", place / "inside");
  Json scene = Json::parse(place.read("solid.json"));
  scene["structure"]["matrices"]["stiffness"] = "K.csv";
  scene["structure"]["matrices"]["mass"] = "M.mtx";
  scene["structure"]["names"] = "names.csv";
  fs::rename(place / "inside/K.mtx", place / "inside/K.csv");
  place.write("inside/scene.json", scene.dump());
  const Ended table = run(place, {"run", "inside/scene.json", "--out", "inside"}, no_gnuplot);
  CHECK(table.exit_code == 1);
  CHECK(table.err.find("K.csv is a file that the scene reads: choose another path") != std::string::npos);
  scene["structure"]["matrices"]["stiffness"] = "K_amplitude.svg";
  fs::rename(place / "inside/K.csv", place / "inside/K_amplitude.svg");
  place.write("inside/scene.json", scene.dump());
  const Ended figure = run(place, {"run", "inside/scene.json", "--out", "inside"}, no_gnuplot);
  CHECK(figure.exit_code == 0);
  CHECK(figure.err.find("were not drawn: K_amplitude.svg is a file that the scene reads") !=
        std::string::npos);
  CHECK(place.read("inside/K_amplitude.svg") == before["mesh/K.mtx"]);
}

TEST_CASE("only files that the manifest names, unchanged, are removed") {
  const Workplace place;
  place.write("scene.json", one_mass(1).dump());
  const auto run_it = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"run", "scene.json", "--out", "o"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(place, arguments, no_gnuplot);
  };
  fs::create_directory(place / "o");
  const std::map<std::string, std::string> mine{{"one_mine.gp", "set output 'scene.json'.suffix\n"},
                                                {"one_mine.dat", "1 2\n"},
                                                {"photo.png.1234.tmp", ""},
                                                {"one_amplitude.svg", "my own"},
                                                {"scene.json", "{}"},
                                                {"one.cases.csv", "study,1\n"}};
  for (const auto& [name, text] : mine) place.write("o/" + name, text);
  REQUIRE(run_it().exit_code == 0);
  REQUIRE(run_it().exit_code == 0);
  for (const auto& [name, text] : mine) CHECK(place.read("o/" + name) == text);
  const Json set = sets_of(place, "o")[0];
  CHECK(set["name"] == "one");
  CHECK(set["complete"] == true);
  CHECK(set["scene_hash"] == Json::parse(place.read("o/one.json"))["scene_hash"]);
  CHECK(wrong_file(place, "o", set) == "");
  CHECK(set["files"].contains("one.scene.json"));
  CHECK(set["files"].contains("one.gp"));

  // Files that a later run has no counterpart of go; those that were changed meanwhile stay.
  const auto has = [&](const char* name) { return fs::exists(place / name); };
  REQUIRE(has("o/one.events.csv"));
  Json other = one_mass(1);
  other["studies"] = {{{"name", "one"}, {"kind", "time"}, {"frequency", 10}}};
  place.write("scene.json", other.dump());
  REQUIRE(run_it().exit_code == 0);
  CHECK_FALSE(has("o/one.events.csv"));
  CHECK(has("o/one.csv"));
  CHECK(sets_of(place, "o").size() == 2);  // that of the report, too
  place.write("scene.json", one_mass(1).dump());
  REQUIRE(run_it().exit_code == 0);
  const std::string edited = place.read("o/one.events.csv") + "mine\n";
  place.write("o/one.events.csv", edited);
  place.write("scene.json", other.dump());
  REQUIRE(run_it().exit_code == 0);
  CHECK(place.read("o/one.events.csv") == edited);

  // Another study's files are not of this one.
  place.write("scene.json", one_mass(1).dump());
  Json two = one_mass(2);
  two["studies"][0]["name"] = "one_more";
  place.write("two.json", two.dump());
  REQUIRE(run(place, {"run", "two.json", "--out", "o"}, no_gnuplot).exit_code == 0);
  const std::string before = place.read("o/one_more.json");
  REQUIRE(run_it().exit_code == 0);
  CHECK(place.read("o/one_more.json") == before);
  CHECK(sets_of(place, "o").size() == 3);

  // What only looks like a manifest is not replaced.
  for (const char* text :
       {"", "mine", "{}", R"({"format": "arcslip-manifest-1", "sets": [{"name": "one"}]})",
        R"({"format": "arcslip-manifest-1", "sets": [{"name": "x", "program": "", "scene_hash": "",
                               "complete": true, "files": {"../scene.json": null}}]})"}) {
    place.write(std::string("o/") + manifest, text);
    const Ended ended = run_it();
    CAPTURE(text, ended.err);
    CHECK(ended.exit_code == 1);
    CHECK(
        ended.err.find("is no manifest of Arcslip, or is damaged: move it away, or choose another folder") !=
        std::string::npos);
    CHECK(place.read(std::string("o/") + manifest) == text);
  }
}

TEST_CASE("a figure that the user changed stays where it cannot be drawn anew") {
  const Workplace place;
  place.write("scene.json", one_mass(1).dump());
  fs::create_directory(place / "bin");
  // As gnuplot would: what its script sets, with the suffix of its command line.
  place.write("bin/gnuplot", R"(#!/bin/sh
    suffix=$(printf %s "$3" | sed "s/suffix='\(.*\)'/\1/")
    for image in $(sed -n "s/^set output '\(.*\)'.suffix$/\1/p" "$4"); do
      case $image in *.svg) echo '</svg>' ;; *) echo IEND ;; esac > "$image$suffix"
    done)");
  fs::permissions(place / "bin/gnuplot", fs::perms::owner_all);
  REQUIRE(
      run(place, {"run", "scene.json", "--out", "o"}, {{"PATH", (place / "bin").string() + ":/usr/bin:/bin"}})
          .exit_code == 0);
  REQUIRE(fs::exists(place / "o/one_stick.svg"));
  place.write("o/one_amplitude.svg", "<svg>mine</svg>");
  REQUIRE(run(place, {"run", "scene.json", "--out", "o"}, no_gnuplot).exit_code == 0);
  CHECK(place.read("o/one_amplitude.svg") == "<svg>mine</svg>");
  CHECK_FALSE(fs::exists(place / "o/one_stick.svg"));
}

TEST_CASE("what a killed run only meant to write is not removed") {
  const Workplace place;
  place.write("scene.json", one_mass(1).dump());
  REQUIRE(run(place, {"run", "scene.json", "--out", "o"}, no_gnuplot).exit_code == 0);
  Json json = Json::parse(place.read(std::string("o/") + manifest));
  json["sets"][0]["complete"] = false;
  json["sets"][0]["files"]["one_other.svg"] = nullptr;
  json["sets"][0]["files"]["one_other.svg.4711.tmp"] = nullptr;
  place.write(std::string("o/") + manifest, json.dump());
  place.write("o/one_other.svg", "mine");
  place.write("o/one_other.svg.4711.tmp", "half an image");
  REQUIRE(run(place, {"run", "scene.json", "--out", "o"}, no_gnuplot).exit_code == 0);
  CHECK(place.read("o/one_other.svg") == "mine");
  CHECK_FALSE(fs::exists(place / "o/one_other.svg.4711.tmp"));
  CHECK(sets_of(place, "o")[0]["complete"] == true);
}

TEST_CASE("a pipe and a link to a device in a folder of results are written once and not read") {
  const Workplace place;
  place.write("scene.json", one_mass(1).dump());
  fs::create_directory(place / "o");
  REQUIRE(::mkfifo((place / "o/one.csv").c_str(), 0600) == 0);
  fs::create_symlink("/dev/zero", place / "o/one.json");
  const std::string command = "cd '" + place.path() +
                              "' && { cat o/one.csv > x & timeout 60 env PATH=/nonexistent '" +
                              arcslip_program() + "' run scene.json --out o --quiet; echo $? > code; wait; }";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(place.read("code") == "0\n");
  CHECK(place.read("x").starts_with("study,"));
}

TEST_CASE("a study called reduced and a reduced structure keep apart in one folder") {
  const Workplace place;
  write_matrices(place, 4000);
  REQUIRE(run(place, {"reduce", "solid.json", "--out", "r", "--quiet"}).exit_code == 0);
  Json scene = one_mass(1);
  scene["studies"][0]["name"] = "reduced";
  place.write("scene.json", scene.dump());
  REQUIRE(run(place, {"run", "scene.json", "--out", "r"}, no_gnuplot).exit_code == 0);
  for (const char* file : {"r/K.mtx", "r/M.mtx", "r/names.csv"}) CHECK(fs::exists(place / file));
}

TEST_CASE("a study named like the manifest does not replace it") {
  const Workplace place;
  Json scene = one_mass(1);
  scene["studies"][0]["name"] = "arcslip-manifest";
  place.write("scene.json", scene.dump());
  const Ended ended = run(place, {"run", "scene.json", "--out", "o"}, no_gnuplot);
  CHECK(ended.exit_code == 1);
  CHECK(ended.err.find(
            "the manifest of the folder and the results of the study \"arcslip-manifest\" both go to") !=
        std::string::npos);
}

TEST_CASE("temporaries of a living writer stay, those of a killed one go") {
  const Workplace place;
  place.write("scene.json", one_mass(1).dump());
  fs::create_directory(place / "o");
  place.write("o/.arcslip-17-0.tmp", "living");
  place.write("o/.arcslip-18-0.tmp", "killed");
  const int held = ::open((place / "o/.arcslip-17-0.tmp").c_str(), O_RDONLY | O_CLOEXEC);
  REQUIRE(::flock(held, LOCK_SH) == 0);
  CHECK(run(place, {"run", "scene.json", "--out", "o"}, no_gnuplot).exit_code == 0);
  ::close(held);
  CHECK(fs::exists(place / "o/.arcslip-17-0.tmp"));
  CHECK_FALSE(fs::exists(place / "o/.arcslip-18-0.tmp"));
}

TEST_CASE("a gnuplot that cannot be started, or is killed, costs no result and no study") {
  for (const char* script : {"not a script\n", "#!/bin/sh\nkill -9 $$\n"}) {
    const Workplace place;
    Json scene = one_mass(1);
    scene["studies"].push_back({{"name", "two"}, {"kind", "frf"}, {"from", 5}, {"to", 12}});
    place.write("scene.json", scene.dump());
    fs::create_directory(place / "bin");
    place.write("bin/gnuplot", script);
    fs::permissions(place / "bin/gnuplot", fs::perms::owner_all);
    const Ended ended = run(place, {"run", "scene.json", "--out", "o", "--json", "o.json", "--quiet"},
                            {{"PATH", (place / "bin").string() + ":/usr/bin:/bin"}});
    CAPTURE(script, ended.err);
    CHECK(ended.exit_code == 0);
    CHECK(ended.err.find("gnuplot") != std::string::npos);
    CHECK(Json::parse(place.read("o.json"))["branches"].size() == 2);
    for (const char* file : {"o/one.json", "o/one.gp", "o/two.json", "o/two.dat"})
      CHECK(fs::exists(place / file));
  }
}

TEST_CASE("a scene of an interrupted set is refused, and one that was changed since is reported") {
  const Workplace place;
  write_matrices(place, 4000);
  REQUIRE(run(place, {"reduce", "solid.json", "--out", "r", "--quiet"}).exit_code == 0);
  const Ended whole = run(place, {"check", "r/reduced.json", "--quiet"});
  CHECK(whole.exit_code == 0);
  CHECK(whole.err.empty());

  const std::string stiffness = place.read("r/K.mtx");
  place.write("r/K.mtx", stiffness + "\n");
  const Ended changed = run(place, {"check", "r/reduced.json", "--quiet"});
  CHECK(changed.exit_code == 0);
  CHECK(changed.err ==
        "arcslip: r/K.mtx has changed since it was written with the other files of the set \"the reduced "
        "structure\" of "
        "r/arcslip-manifest.json\n");
  place.write("r/K.mtx", stiffness);

  Json json = Json::parse(place.read(std::string("r/") + manifest));
  json["sets"][0]["complete"] = false;
  place.write(std::string("r/") + manifest, json.dump());
  const Ended refused = run(place, {"check", "r/reduced.json", "--quiet"});
  CHECK(refused.exit_code == 2);
  CHECK(refused.err.find("r/reduced.json is of the set \"the reduced structure\" of r/arcslip-manifest.json, "
                         "whose writing was "
                         "interrupted: its files may be of two scenes") != std::string::npos);
  // Written again, they belong together.
  CHECK(run(place, {"reduce", "solid.json", "--out", "r", "--quiet"}).exit_code == 0);
  CHECK(run(place, {"check", "r/reduced.json", "--quiet"}).exit_code == 0);
}

TEST_CASE("killed at any moment, a mix of old and new files is determined by the manifest") {
  const Workplace place;
  write_matrices(place, 4000);
  fs::copy(place / "mesh", place / "mesh2");
  write_matrices(place, 5500);
  Json second = Json::parse(place.read("solid.json"));
  second["structure"]["matrices"]["stiffness"] = "mesh2/K.mtx";
  place.write("solid2.json", second.dump());
  for (const auto& [name, mass] : {std::pair{"a.json", 1.0}, {"b.json", 1.7}}) {
    Json scene = one_mass(mass);
    scene["studies"].push_back({{"name", "two"}, {"kind", "frf"}, {"from", 5}, {"to", 12}});
    scene["studies"].push_back(Json::parse(R"({"name": "best", "kind": "optimum", "over": ["d.normal_load"],
                                               "bounds": [[1, 9]], "frequency": [5, 16]})"));
    place.write(name, scene.dump());
  }
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> verbs{
      {{"reduce", "solid.json", "--out", "r"}, {"reduce", "solid2.json", "--out", "r"}},
      {{"run", "a.json", "--out", "o"}, {"run", "b.json", "--out", "o"}},
      {{"optimize", "a.json", "--out", "p"}, {"optimize", "b.json", "--out", "p"}}};
  test_random::Random random(11);
  std::set<std::string> seen;
  for (const auto& [one, other] : verbs) {
    const std::string folder = one.back();
    const auto began = std::chrono::steady_clock::now();
    const Ended uninterrupted = run(place, one, no_gnuplot);
    CAPTURE(one.front(), uninterrupted.err);
    REQUIRE(uninterrupted.exit_code == 0);
    const double duration = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    for (std::uint64_t i = 0; i < kills.count(); ++i) {
      const std::string before = place.read(folder + "/" + manifest);
      Program program(place, i % 2 == 0 ? other : one, no_gnuplot);
      // At any moment, or soon after the first file was replaced.
      const double pause = random.between(0, i % 4 < 2 ? 1.1 * duration : 0.02);
      if (i % 4 >= 2)
        while (program.is_running() && place.read(folder + "/" + manifest) == before)
          std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::duration<double>(pause));
      program.send(SIGKILL);
      program.wait();
      std::set<std::string> named;
      for (const Json& set : sets_of(place, folder)) {
        for (const auto& [name, hash] : set["files"].items()) named.insert(name);
        CAPTURE(one.front(), i, set["name"].get<std::string>());
        if (set["complete"]) CHECK(wrong_file(place, folder, set) == "");
        seen.insert(set["complete"] ? "whole" : "reported");
      }
      for (const auto& entry : fs::directory_iterator(place / folder)) {
        const std::string name = entry.path().filename();
        CAPTURE(name);
        CHECK((named.contains(name) || name == manifest || name.ends_with(".tmp")));
      }
    }
  }
  CHECK(seen == std::set<std::string>{"reported", "whole"});
}

TEST_CASE("a terminal that is closed keeps the results so far, as SIGTERM does") {
  const Workplace place;
  Json scene = one_mass(1), loads = Json::array();
  for (int k = 0; k < 3000; ++k) loads.push_back(1 + 0.001 * k);
  scene["studies"][0]["for_each"] = {{"d.normal_load", loads}};
  place.write("scene.json", scene.dump());
  Program program(place, {"frf", "scene.json", "--json", "a.json", "--quiet"});
  while (program.is_running() && program.processor_seconds() < 0.3)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.send(SIGHUP);
  const Ended ended = program.wait();
  CHECK(ended.exit_code == 3);
  const Json branches = Json::parse(place.read("a.json"))["branches"];
  CHECK(branches.size() > 1);
  CHECK(branches.size() < 3000);
  CHECK(branches.front()["status"] == "complete");
}

TEST_CASE("too little memory for what BLAS takes is reported") {
  if (ARCSLIP_SANITIZED) return;  // the sanitizers take terabytes of addresses
  const Workplace place;
  place.write("bar.json", R"({"format": "arcslip-scene-1", "structure": {
    "beam": {"elements": 30, "length": 1, "young": 2e11, "density": 7800, "width": 0.05, "height": 0.02,
             "points": {"tip": 1}, "highest_frequency": 800}},
    "excitation": [{"name": "f", "at": "tip", "cosine": 1}], "response": {"at": "tip"},
    "harmonics": {"order": 3}, "studies": [{"kind": "frf", "from": 10, "to": 30}]})");
  for (const int kilobytes : {150'000, 200'000, 250'000, 280'000}) {
    const std::string command = "cd '" + place.path() + "' && (ulimit -v " + std::to_string(kilobytes) +
                                "; OPENBLAS_NUM_THREADS=1 timeout 60 '" + arcslip_program() +
                                "' check bar.json --quiet 2>err; echo $? >code)";
    CHECK(std::system(command.c_str()) == 0);
    CAPTURE(kilobytes, place.read("err"), place.read("code"));
    CHECK((place.read("code") == "0\n" ||
           (place.read("code") == "1\n" && place.read("err").find("out of memory") != std::string::npos)));
  }
}
