// Scenes with MATLAB files: the program that reads them, and how a run ends with it.
#include "catch.hpp"
#include "contains.hpp"
#include "program.hpp"

#include "lib/scene/files/mat_bytes.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

using namespace app_test;
namespace fs = std::filesystem;

namespace {

void write_scene(const Workplace& place) {
  place.write("A.mat", mat_bytes::header() + mat_bytes::full("K", 2, 2, {300, -100, -100, 100}) +
                           mat_bytes::packed(mat_bytes::full("M", 2, 2, {1, 0, 0, 1})));
  place.write("names.csv", "name,row\nroot,1\ntip,2\n");
  place.write("mat.json",
              R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"matrices": {
    "mass": {"file": "A.mat", "variable": "M"}, "stiffness": {"file": "A.mat", "variable": "K"}},
    "names": "names.csv", "dampers": [{"name": "c", "at": "tip", "value": 0.1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "tip", "stiffness": 100, "friction_coefficient": 0.5,
                  "normal_load": 2}],
    "excitation": [{"name": "f", "at": "tip", "cosine": 1}], "response": {"at": "tip"},
    "harmonics": {"order": 3}, "studies": [{"kind": "frf", "from": 8, "to": 9}]})");
}

bool is_program_built() {
  return fs::exists(fs::path(arcslip_program()).parent_path() / "arcslip-mat");
}

// The lookup without what the test's environment says.
std::map<std::string, std::string> nothing_set() {
  return {{"ARCSLIP_MAT", ""}, {"PATH", "/nonexistent"}};
}

void write_program(const Workplace& place, const std::string& commands) {
  place.write("fake", "#!/bin/sh\n" + commands + "\n");
  fs::permissions(place / "fake", fs::perms::owner_all);
}

}  // namespace

TEST_CASE("the command finds the program that reads MATLAB files next to itself, and no other") {
  const Workplace place;
  write_scene(place);
  const Ended checked = run(place, {"check", "mat.json", "--quiet"}, nothing_set());
  if (!is_program_built()) {
    CHECK(checked.exit_code == 2);
    CHECK(contains(checked.err, "is read by the program arcslip-mat, which is not there"));
    return;
  }
  CHECK(checked.err == "");
  CHECK(checked.exit_code == 0);
  // One of this name in the current folder is not taken.
  write_program(place, "kill -KILL $$");
  fs::rename(place / "fake", place / "arcslip-mat");
  CHECK(run(place, {"check", "mat.json", "--quiet"}, nothing_set()).exit_code == 0);
}

TEST_CASE("a damaged MATLAB file of version 7.3 is a fault of the scene, and ends no run by a signal") {
  if (!is_program_built()) return;
  const Workplace place;
  write_scene(place);
  for (const std::string name : {"damaged_accumulator.mat", "damaged_chunk.mat"}) {
    fs::copy_file(source_folder() + "/tests/lib/scene/files/" + name, place / "A.mat",
                  fs::copy_options::overwrite_existing);
    const Ended ended = run(place, {"check", "mat.json"});
    CHECK(ended.signal == 0);
    CHECK(ended.exit_code == 2);
    CHECK(contains(ended.err,
                   "/structure/matrices/stiffness: \"A.mat\": found a file that cannot be read; it may be "
                   "damaged"));
  }
}

TEST_CASE("a signal ends a command whose MATLAB file is not read to its end") {
  const Workplace place;
  write_scene(place);
  write_program(place, "echo $$ > pid.new; /bin/mv pid.new pid; exec /bin/sleep 1000");
  Program program(place, {"frf", "mat.json"}, {{"ARCSLIP_MAT", (place / "fake").string()}});
  while (program.is_running() && !fs::exists(place / "pid"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const auto begin = std::chrono::steady_clock::now();
  program.send(SIGTERM);
  const Ended ended = program.wait();
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(1));
  CHECK(ended.exit_code == 3);
  CHECK(contains(ended.err, "interrupted while \"A.mat\" was read"));
  const std::string pid = place.read("pid");
  CHECK_FALSE(fs::exists("/proc/" + pid.substr(0, pid.find('\n'))));
}
