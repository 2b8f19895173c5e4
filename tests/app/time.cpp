// arcslip time, and studies of kind "time".

#include "catch.hpp"
#include "environment.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace app_test;
using Json = nlohmann::json;

TEST_CASE("time finds the exact periodic motion, and prints it as a table or as JSON") {
  const Workplace place;
  const std::vector<std::string> arguments{"time", "scene.json", "--frequency",
                                           "20",   "--set",      "damper.normal_load=3"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), more.begin(), more.end());
    return run(place, all);
  };
  const Ended table = with({"--csv", "time.csv"});
  CHECK(table.exit_code == 0);
  CHECK(table.err.empty());
  CHECK(table.out.find("  method  frequency (Hz)") == 0);
  CHECK(table.out.find("A_max (mm)  stick (%)  E_friction (mJ)  E_viscous (\u00b5J)") != std::string::npos);
  CHECK(place.read("time.csv")
            .find("study,motion,time (s),displacement (m),velocity (m/s),damper.displacement (m)") == 0);

  const Ended ended = with({"--json", "-"});
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.empty());
  const Json json = Json::parse(ended.out);
  CHECK(json["format"] == "arcslip-time-1");
  REQUIRE(json["motions"].size() == 1);
  const Json& motion = json["motions"][0];
  CHECK(motion["status"] == "complete");
  CHECK(motion["study"] == "time");
  CHECK(motion["kind"] == "time");
  CHECK(motion["integrator"] == "event-driven");
  // exact_1dof.json, "fixed_frequency"
  CHECK(motion["amplitude"].get<double>() == Approx(0.000884939195111).epsilon(1e-11));
  CHECK(motion["stick_percent"].get<double>() == Approx(48.7055401).epsilon(1e-8));
  CHECK(motion["energy_friction"].get<double>() == Approx(0.002738206599).epsilon(1e-9));
  CHECK(std::abs(motion["energy_defect"].get<double>()) < 1e-12 * motion["energy_input"].get<double>());
  // by differences of the exact motion
  CHECK(motion["multipliers"][0][0].get<double>() == Approx(0.84767).epsilon(1e-5));
  CHECK(motion["multipliers"][1][0].get<double>() == Approx(0.81154).epsilon(1e-5));
  CHECK(motion["stable"] == true);
  CHECK(motion["history"]["time"].size() == 1001);
}

TEST_CASE("each method of time comes to the same motion, as near as its steps allow") {
  const Workplace place;
  for (const std::string method : {"shooting", "newmark-shooting", "newmark", "event-driven"}) {
    CAPTURE(method);
    const Ended ended =
        run(place, {"time", "scene.json", "--frequency", "20", "--set", "damper.normal_load=2", "--method",
                    method, "--steps", "400", "--recorded", "2", "--json", "-"});
    CHECK(ended.exit_code == 0);
    const Json motion = Json::parse(ended.out)["motions"][0];
    CHECK(motion["method"] == method);
    const bool newmark = method.find("newmark") == 0;
    CHECK(motion["integrator"] == (newmark ? "newmark" : "event-driven"));
    const double error = std::abs(motion["amplitude"].get<double>() / 0.000833658419611 - 1);
    CHECK(error < (newmark ? 120.0 / (400 * 400) : 1e-8));
    CHECK(motion["history"]["displacement"].size() == 801);
    CHECK(motion["multipliers"].empty() == (method.find("shooting") == std::string::npos));
  }
}

TEST_CASE("time takes Newmark's steps where a spring is cubic") {
  const Workplace place;
  std::filesystem::copy_file(source_folder() + "/examples/duffing/scene.json", place / "duffing.json");
  const Ended ended =
      run(place, {"time", "duffing.json", "--frequency", "0.9", "--steps", "4000", "--json", "-"});
  CHECK(ended.exit_code == 0);
  const Json motion = Json::parse(ended.out)["motions"][0];
  CHECK(motion["integrator"] == "newmark");
  const Ended balance = run(
      place, {"frf", "duffing.json", "--harmonics", "31", "--from", "0.9", "--to", "0.91", "--json", "-"});
  const double amplitude = Json::parse(balance.out)["branches"][0]["points"][0]["amplitude"];
  CHECK(motion["amplitude"].get<double>() == Approx(amplitude).epsilon(1e-5));

  const Ended impossible =
      run(place, {"time", "duffing.json", "--frequency", "0.9", "--method", "event-driven"});
  CHECK(impossible.exit_code == 3);
  CHECK(impossible.err.find("arcslip: motion 1 failed: ") == 0);
  CHECK(impossible.err.find("use the method newmark") != std::string::npos);
}

TEST_CASE("a transient that is not steady at its limit says so, with exit code 3 and its history") {
  const Workplace place;
  const Ended ended = run(place, {"time", "scene.json", "--frequency", "20", "--set", "damper.normal_load=3",
                                  "--method", "newmark", "--periods", "10", "--json", "a.json"});
  CHECK(ended.exit_code == 3);
  CHECK(ended.err.find(
            "arcslip: motion 1 stopped: after 10 periods (the limit) the state still changes by ") == 0);
  const Json motion = Json::parse(place.read("a.json"))["motions"][0];
  CHECK(motion["status"] == "stopped");
  CHECK(motion["history"]["time"].size() == 1001);
  const Ended all =
      run(place, {"time", "scene.json", "--frequency", "20", "--set", "damper.normal_load=3", "--method",
                  "newmark", "--periods", "10", "--recorded", "10", "--tolerance", "0", "--json", "-"});
  CHECK(all.exit_code == 0);
  CHECK(Json::parse(all.out)["motions"][0]["history"]["time"].size() == 10001);
}

TEST_CASE("run writes motions next to branches, each study into its files, and both into one") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene["studies"].push_back({{"name", "loops"},
                              {"kind", "time"},
                              {"frequency", 20},
                              {"for_each", {{"damper.normal_load", {1, 3}}}}});
  place.write("both.json", scene.dump());
  const Ended ended =
      run(place, {"run", "both.json", "--harmonics", "1", "--out", "results", "--json", "a.json"},
          {{"PATH", "/nonexistent"}});
  CHECK(ended.exit_code == 0);
  const Json json = Json::parse(place.read("a.json"));
  CHECK(json["format"] == "arcslip-results-1");
  CHECK(json["branches"].size() == 13);
  REQUIRE(json["motions"].size() == 2);
  CHECK(json["motions"][1]["study"] == "loops");
  CHECK(json["motions"][1]["set"]["damper.normal_load"] == 3.0);
  CHECK(Json::parse(place.read("results/loops.json"))["format"] == "arcslip-time-1");
  CHECK(place.read("results/loops.csv").find("study,damper.normal_load (N),motion,time (s)") == 0);
  CHECK(std::filesystem::exists(place / "results/loops.gp"));
  CHECK(
      run(place, {"run", "results/loops.scene.json", "--out", "again", "--quiet"}, {{"PATH", "/nonexistent"}})
          .exit_code == 0);
  CHECK(place.read("again/loops.csv") == place.read("results/loops.csv"));
}
