#include "catch.hpp"
#include "interruptions.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

using namespace app_test;
using Json = nlohmann::json;
using namespace std::chrono_literals;

namespace {

/// Studies that take minutes, in small steps.
void write_long_scene(const Workplace& place) {
  Json scene = Json::parse(place.read("scene.json"));
  Json loads = Json::array();
  Json stiffnesses = Json::array();
  for (int i = 0; i < 20'000; ++i) {
    loads.push_back(2 + 1e-4 * i);
    stiffnesses.push_back(17'890 + 1e-3 * i);
  }
  scene["studies"][0]["for_each"]["damper.normal_load"] = loads;
  scene["studies"][1]["for_each"]["k.value"] = stiffnesses;
  place.write("long.json", scene.dump());
}

/// A signal that comes before the first study has begun would find nothing to keep, on a busy machine too.
std::chrono::milliseconds reading_time(const Workplace& place) {
  const auto began = std::chrono::steady_clock::now();
  Program program(place, {"check", "long.json", "--quiet"}, {});
  CHECK(program.wait().exit_code == 0);
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - began);
}

/// Partial results, which say so.
void check_stopped(const std::string& text) {
  const Json json = Json::parse(text);
  const Json branches = json.contains("motions") ? json["motions"] : json["branches"];
  REQUIRE(!branches.empty());
  CHECK(branches.size() < 20'000);
  CHECK(branches.back()["status"] == "stopped");
  CHECK(branches.back()["stop"]["reason"] == "user");
}

bool is_result(const std::string& file) {
  return file.ends_with(".json") && !file.ends_with("scene.json");
}

}  // namespace

TEST_CASE(
    "each interruption ends with its exit code, partial results in whole files, and nothing half-written") {
  for (const Interruption& interruption : interruptions()) {
    CAPTURE(interruption.name);
    const Workplace place;
    write_long_scene(place);
    auto expected = place.files();
    expected.insert(expected.end(), interruption.files.begin(), interruption.files.end());
    if (std::find(expected.begin(), expected.end(), "results/frf.json") != expected.end())
      expected.push_back("results/arcslip-manifest.json");
    std::sort(expected.begin(), expected.end());
    auto pause = 1500ms + 20 * reading_time(place);
    // Without gnuplot: figures take their time.
    Program program(place, interruption.arguments, {{"PATH", "/nonexistent"}});
    for (const int signal : interruption.signals) {
      std::this_thread::sleep_for(pause);
      program.send(signal);
      pause = 50ms;
    }
    const Ended ended = program.wait();
    CAPTURE(ended.err, ended.out.substr(0, 200));
    CHECK(ended.exit_code == interruption.exit_code);
    CHECK(ended.signal == (interruption.exit_code < 0 ? interruption.signals.back() : 0));
    CHECK(ended.err.find(interruption.message) != std::string::npos);
    CHECK(place.files() == expected);
    for (const std::string& file : interruption.files)
      if (is_result(file)) check_stopped(place.read(file));
    if (!ended.out.empty() && ended.out.front() == '{') check_stopped(ended.out);
  }
}

namespace {

/// A row of masses with a friction damper at its end.
std::string chain(int dofs) {
  Json scene = {{"format", "arcslip-scene-1"}, {"frequency_unit", "rad/s"}};
  Json& structure = scene["structure"];
  for (int i = 0; i < dofs; ++i) {
    const std::string n = std::to_string(i), x = "x" + n;
    structure["dofs"].push_back(x);
    structure["masses"].push_back({{"name", "m" + n}, {"at", x}, {"value", 1}});
    Json spring = {{"name", "k" + n}, {"value", 1e4}}, damper = {{"name", "c" + n}, {"value", 1}};
    for (Json* part : {&spring, &damper})
      if (i > 0)
        (*part)["between"] = {x, "x" + std::to_string(i - 1)};
      else
        (*part)["at"] = x;
    structure["springs"].push_back(spring);
    structure["dampers"].push_back(damper);
  }
  const std::string last = "x" + std::to_string(dofs - 1);
  scene["elements"] = {{{"name", "d"},
                        {"type", "jenkins"},
                        {"at", last},
                        {"stiffness", 1e3},
                        {"friction_coefficient", 0.5},
                        {"normal_load", 2}}};
  scene["excitation"] = {{{"name", "f"}, {"at", "x" + std::to_string(dofs / 2)}, {"cosine", 1}}};
  scene["harmonics"] = {{"order", 7}};
  scene["response"] = {{"at", last}};
  // Ends long after the last signal.
  scene["studies"] = {{{"name", "frf"}, {"kind", "frf"}, {"from", 1}, {"to", 100}}};
  return scene.dump();
}

}  // namespace

TEST_CASE(
    "a structure of many degrees of freedom obeys a signal within a second of work, whatever is under way") {
  const Workplace place;
  place.write("big.json", chain(ARCSLIP_MANY_DOFS));
  for (const auto moment : {20ms, 100ms, 300ms, 1000ms, 3000ms}) {
    CAPTURE(moment.count());
    Program program(place, {"frf", "big.json", "--json", "a.json"});
    while (program.is_running() && !program.handles(SIGTERM)) std::this_thread::yield();
    std::this_thread::sleep_for(moment);
    const double worked = program.processor_seconds();
    const bool was_running = program.is_running();
    program.send(SIGTERM);
    const Ended ended = program.wait();
    CAPTURE(ended.err, was_running);
    CHECK(ended.exit_code == (was_running ? 3 : 0));
    CHECK(ended.processor_seconds - worked < 1);
  }
}
