#include "catch.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <thread>

using namespace app_test;
using Json = nlohmann::json;

namespace {

/// A study that takes minutes, in small steps.
void write_long_scene(const Workplace& place) {
  Json scene = Json::parse(place.read("scene.json"));
  Json loads = Json::array();
  for (int i = 0; i < 20'000; ++i) {
    loads.push_back(2 + 1e-4 * i);
  }
  scene["studies"][0]["for_each"]["damper.normal_load"] = loads;
  place.write("long.json", scene.dump());
}

void wait_a_moment() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
}

}  // namespace

TEST_CASE("Ctrl-C ends a run with exit code 3, partial results in whole files, and nothing half-written") {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Workplace place;
    write_long_scene(place);
    Program program(place, {"run", "long.json", "--out", "results"}, {{"PATH", "/nonexistent"}});
    wait_a_moment();
    program.send(signal);
    const Ended ended = program.wait();
    CAPTURE(ended.err);
    CHECK(ended.exit_code == 3);
    CHECK(ended.err.find("what is computed so far will be written") != std::string::npos);
    CHECK(place.files() == std::vector<std::string>{"long.json", "results", "results/frf.csv",
                                                    "results/frf.dat", "results/frf.gp", "results/frf.json",
                                                    "results/frf.scene.json", "scene.json"});
    const Json json = Json::parse(place.read("results/frf.json"));
    REQUIRE(!json["branches"].empty());
    CHECK(json["branches"].back()["status"] == "stopped");
    CHECK(json["branches"].back()["stop"]["reason"] == "user");
    CHECK(json["branches"].size() < 20'000);
  }
}

TEST_CASE("JSON on standard output is whole after Ctrl-C") {
  const Workplace place;
  write_long_scene(place);
  Program program(place, {"frf", "long.json", "--json", "-"});
  wait_a_moment();
  program.send(SIGINT);
  const Ended ended = program.wait();
  CHECK(ended.exit_code == 3);
  CHECK(Json::parse(ended.out)["branches"].back()["status"] == "stopped");
}

TEST_CASE("a killed run leaves no file") {
  const Workplace place;
  write_long_scene(place);
  Program program(place, {"frf", "long.json", "--json", "a.json", "--csv", "a.csv"});
  wait_a_moment();
  program.send(SIGKILL);
  CHECK(program.wait().signal == SIGKILL);
  CHECK(place.files() == std::vector<std::string>{"long.json", "scene.json"});
}

TEST_CASE("a second Ctrl-C ends the program at once") {
  const Workplace place;
  Program program(place, {"frf", "scene.json", "--harmonics", "2000", "--json", "a.json"});
  wait_a_moment();
  program.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  program.send(SIGINT);
  CHECK(program.wait().signal == SIGINT);
  CHECK(place.files() == std::vector<std::string>{"scene.json"});
}
