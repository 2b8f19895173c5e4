// The verbs over a parameter or an amplitude: peaks, trace, folds, modes.

#include "catch.hpp"
#include "environment.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace app_test;
using Json = nlohmann::json;

TEST_CASE("peaks finds the load of the least peak, and prints it as a table or as JSON") {
  const Workplace place;
  const Ended table = run(place, {"peaks", "scene.json", "--csv", "peaks.csv"});
  CHECK(table.exit_code == 0);
  CHECK(table.err.empty());
  CHECK(table.out.find("damper.normal_load (N)    event  frequency (Hz) ") == 0);
  CHECK(table.out.find(" A_max (mm)  stick (%)    branch\n") != std::string::npos);
  CHECK(table.out.find(" minimum ") != std::string::npos);
  CHECK(place.read("peaks.csv").find("study,branch,damper.normal_load (N),omega (rad/s),frequency (Hz)") ==
        0);
  CHECK(place.read("peaks.events.csv").find("\r\npeaks,1,minimum,") != std::string::npos);
  CHECK(place.read("peaks.summary.csv").find("\r\npeaks,peaks,1,damper.normal_load,") != std::string::npos);

  const Ended json = run(place, {"peaks", "scene.json", "--json", "-"});
  CHECK(json.exit_code == 0);
  const Json branches = Json::parse(json.out)["branches"];
  REQUIRE(branches.size() == 1);
  CHECK(branches[0]["status"] == "complete");
  CHECK(branches[0]["over"] == "damper.normal_load");
  CHECK(branches[0]["points"][0]["damper.normal_load"] == 0.01);
  CHECK(branches[0]["points"].back()["damper.normal_load"] == 500.0);
  REQUIRE(branches[0]["events"].size() == 1);
  const Json& least = branches[0]["events"][0];
  CHECK(least["kind"] == "minimum");
  // exact_1dof.json, "optima"; 55 harmonics leave some 1e-7 of the amplitude
  CHECK(least["amplitude"].get<double>() == Approx(0.000884191062245254).epsilon(1e-7));
  CHECK(least["damper.normal_load"].get<double>() == Approx(3.0898688585349).epsilon(1e-6));
  CHECK(least["frequency"].get<double>() == Approx(20.029272275727).epsilon(1e-6));
}

TEST_CASE("peaks takes from its options what they say, and the rest from the scene's study") {
  const Workplace place;
  const Ended part =
      run(place, {"peaks", "scene.json", "--harmonics", "7", "--from", "5", "--to", "50", "--json", "-"});
  CHECK(part.exit_code == 0);
  const Json branch = Json::parse(part.out)["branches"][0];
  CHECK(branch["points"][0]["damper.normal_load"] == 5.0);
  CHECK(branch["points"].back()["damper.normal_load"] == 50.0);
  CHECK(branch["events"].empty());

  const Ended another = run(place, {"peaks", "scene.json", "--harmonics", "7", "--over", "c.value", "--from",
                                    "0.1", "--to", "0.2", "--json", "-"});
  CHECK(another.exit_code == 0);
  const Json over_damping = Json::parse(another.out)["branches"][0];
  CHECK(over_damping["over"] == "c.value");
  CHECK(over_damping["points"].back()["c.value"] == 0.2);
}

TEST_CASE("trace goes to the exact response at another load") {
  const Workplace place;
  const Ended ended = run(place, {"trace", "scene.json", "--over", "damper.normal_load", "--from", "0.5",
                                  "--to", "1", "--frequency", "18.5", "--json", "-"});
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.empty());
  const Json points = Json::parse(ended.out)["branches"][0]["points"];
  // exact_1dof.json, "fixed_frequency"; 55 harmonics leave some 1e-7
  CHECK(points[0]["amplitude"].get<double>() == Approx(0.000728056213083).epsilon(1e-7));
  CHECK(points.back()["amplitude"].get<double>() == Approx(0.000406643184661).epsilon(1e-7));
  CHECK(points.back()["damper.normal_load"] == 1.0);
}

TEST_CASE("folds begins at the folds that are known in closed form") {
  const Workplace place;
  std::filesystem::copy_file(source_folder() + "/examples/duffing/scene.json", place / "duffing.json");
  const Ended ended = run(place, {"folds", "duffing.json", "--set", "c.value=0.1", "--set",
                                  "hardening.stiffness=1", "--harmonics", "1", "--over", "force.cosine",
                                  "--from", "0.1", "--to", "0.2", "--frequency", "0.5", "2", "--json", "-"});
  CHECK(ended.exit_code == 0);
  const Json branches = Json::parse(ended.out)["branches"];
  REQUIRE(branches.size() == 2);
  for (const double omega : {1.227095772, 1.157717746}) {  // continuation.json, "duffing_1harmonic"
    CAPTURE(omega);
    CHECK(std::any_of(branches.begin(), branches.end(), [&](const Json& branch) {
      return std::abs(branch["points"][0]["omega"].get<double>() - omega) < 1e-9;
    }));
  }
}

TEST_CASE("with one harmonic the folds of examples/duffing_jenkins are those of its describing function") {
  const Workplace place;  // the numbers: continuation.json, "duffing_jenkins_1harmonic"
  std::filesystem::copy_file(source_folder() + "/examples/duffing_jenkins/scene.json", place / "dj.json");
  const auto events = [&](const std::string& verb) {
    const Ended ended = run(place, {verb, "dj.json", "--harmonics", "1", "--json", "-"});
    CHECK(ended.exit_code == 0);
    Json all = Json::array();
    const Json branches = Json::parse(ended.out)["branches"];
    for (const Json& branch : branches)
      all.insert(all.end(), branch["events"].begin(), branch["events"].end());
    return all;
  };
  const auto only = [](const Json& all, const std::string& kind) {
    const auto is_it = [&](const Json& event) { return event["kind"] == kind; };
    REQUIRE(std::count_if(all.begin(), all.end(), is_it) == 1);
    return *std::find_if(all.begin(), all.end(), is_it);
  };
  const Json turn = only(events("folds"), "turn");
  CHECK(std::abs(turn["omega"].get<double>() - 1.911489205) < 1e-8);
  CHECK(std::abs(turn["damper.normal_load"].get<double>() - 1.215318824) < 1e-7);
  const Json traced = events("trace");
  for (const double load : {0.9169049045, 1.6884695203})
    CHECK(std::count_if(traced.begin(), traced.end(), [&](const Json& event) {
            return event["kind"] == "fold" &&
                   std::abs(event["damper.normal_load"].get<double>() - load) < 1e-9;
          }) == 1);
}

TEST_CASE("the resolved scene that peaks leaves gives the same curve again, with the same hash") {
  const Workplace place;
  CHECK(run(place, {"peaks", "scene.json", "--harmonics", "7", "--from", "1", "--to", "10", "--out", "first"},
            {{"PATH", "/nonexistent"}})
            .exit_code == 0);
  CHECK(run(place, {"peaks", "first/peaks.scene.json", "--out", "second"}, {{"PATH", "/nonexistent"}})
            .exit_code == 0);
  const Json first = Json::parse(place.read("first/peaks.json"));
  const Json second = Json::parse(place.read("second/peaks.json"));
  CHECK(first["scene_hash"] == second["scene_hash"]);
  CHECK(first["branches"][0]["points"] == second["branches"][0]["points"]);
}

TEST_CASE("a study over a parameter that cannot begin is reported, with exit code 3 and whole files") {
  const Workplace place;
  const Ended ended = run(place, {"folds", "scene.json", "--harmonics", "3", "--over", "damper.normal_load",
                                  "--from", "1", "--to", "2", "--frequency", "18", "22", "--json", "a.json"});
  CHECK(ended.exit_code == 3);  // the paper's oscillator has no fold
  CHECK(ended.err.find("arcslip: branch 1 failed: no fold was found") == 0);
  CHECK(Json::parse(place.read("a.json"))["branches"][0]["status"] == "failed");
}

TEST_CASE("modes writes the mode of the describing function, and says which mode there is not") {
  const Workplace place;
  const Ended ended = run(place, {"modes", "scene.json", "--harmonics", "1", "--set", "damper.normal_load=3",
                                  "--amplitude", "1e-5", "1e-2", "--json", "a.json", "--csv", "a.csv"});
  CHECK(ended.exit_code == 0);
  CHECK(ended.out.find("damping ratio") != std::string::npos);
  const Json branch = Json::parse(place.read("a.json"))["branches"][0];
  CHECK(branch["kind"] == "modes");
  REQUIRE(branch["events"].size() == 3);
  CHECK(branch["events"][0]["kind"] == "start");
  CHECK(branch["events"][1]["kind"] == "maximum");
  CHECK(branch["events"][2]["kind"] == "end");
  for (const Json& point : branch["points"])
    for (const char* of_forced : {"phase", "truncation_estimate", "force_per_displacement", "maxima"})
      CHECK_FALSE(point.contains(of_forced));
  // Stuck: sqrt((k + k_d)/m), and c/(2 sqrt((k + k_d) m)).
  const double omega = std::sqrt((17890.0 + 3500) / 1.24);
  CHECK(branch["points"][0]["omega"].get<double>() == Approx(omega).epsilon(1e-12));
  CHECK(branch["points"][0]["damping_ratio"].get<double>() ==
        Approx(0.134 / (2 * 1.24 * omega)).epsilon(1e-10));
  CHECK(branch["points"][0]["energy"].get<double>() == Approx(0.5e-10 * (17890 + 3500)).epsilon(1e-10));
  CHECK(place.read("a.csv").find(",damping_ratio (-),energy (J)") != std::string::npos);
  const Ended none = run(place, {"modes", "scene.json", "--mode", "2", "--amplitude", "1e-5", "1e-2"});
  CHECK(none.exit_code == 3);
  CHECK(none.err.find("mode 2 does not exist: the structure has 1 mode") != std::string::npos);
}
