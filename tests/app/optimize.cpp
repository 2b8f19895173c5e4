// arcslip optimize, and studies of kind "optimum".

#include "catch.hpp"
#include "environment.hpp"
#include "program.hpp"
#include "size.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>

using namespace app_test;
using Json = nlohmann::json;

namespace {

std::vector<std::string> optimize(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"optimize", "scene.json", "--harmonics", "7", "--frequency", "18", "22"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace

TEST_CASE("optimize --json - prints one object with the optimum, its certificate and the direct method") {
  const Workplace place;
  const Ended ended = run(place, optimize({"--over", "damper.normal_load=0.1:100", "--json", "-"}));
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.empty());
  const Json json = Json::parse(ended.out);
  CHECK(json["format"] == "arcslip-optimum-1");
  REQUIRE(json["optima"].size() == 1);
  for (const char* key : {"optimum", "algorithm", "evaluations", "stop"})
    CHECK(json[key] == json["optima"][0][key]);
  const Json& found = json["optima"][0];
  CHECK(found["status"] == "complete");
  CHECK(found["algorithm"] == "LD_SLSQP");
  // exact: 3.0898689 N, 8.84191062e-4 m at 20.029272 Hz, 49.6565 %; seven harmonics leave some 1e-4 of it
  CHECK(found["optimum"]["damper.normal_load"].get<double>() == Approx(3.0898689).epsilon(1e-3));
  CHECK(found["optimum"]["amplitude"].get<double>() == Approx(8.84191062e-4).epsilon(1e-4));
  CHECK(found["optimum"]["frequency"].get<double>() == Approx(20.029272).epsilon(1e-5));
  CHECK(found["optimum"]["stick_percent"].get<double>() == Approx(49.6565).epsilon(1e-3));
  CHECK(found["evaluations"].get<int>() <= 15);
  CHECK(found["course"].size() == found["evaluations"].get<std::size_t>());
  CHECK(found["certificate"]["ranges"]["damper.normal_load"].size() == 2);
  CHECK(found["certificate"]["others_lower"] == true);
  CHECK(found["direct"]["difference"]["design"].get<double>() < 1e-6);
  CHECK(found["direct"]["difference"]["amplitude"].get<double>() < 1e-10);
}

TEST_CASE("optimize prints what an engineer asks for") {
  const Workplace place;
  const Ended ended = run(place, optimize({"--over", "damper.normal_load=0.1:100", "--quiet"}));
  CHECK(ended.exit_code == 0);
  for (const char* part :
       {"damper.normal_load = 3.09 N\n", "A_max = 0.884", "damper sticks 49.6",
        "within 1 % for damper.normal_load from 2.8", "within 5 %", "1 active peak, residual gradient ",
        "the curve of peaks has its minimum at damper.normal_load = 3.09 N"})
    CHECK(ended.out.find(part) != std::string::npos);
}

TEST_CASE("optimize says where the window is too narrow: the stuck damper's amplitude grows to its end") {
  const Workplace place;
  const Ended ended = run(place, {"optimize", "scene.json", "--harmonics", "7", "--frequency", "18", "19",
                                  "--over", "damper.normal_load=0.1:100", "--quiet"});
  CHECK(ended.exit_code == 3);
  CHECK(ended.out.find("at 19.00000000 Hz, damper sticks 100.0000 %") != std::string::npos);
  CHECK(ended.err.find(
            "the amplitude is largest at the upper end of the window, 19 Hz, where it is no resonance "
            "peak; over the bounds resonances may lie, from free to stuck contacts, at ") !=
        std::string::npos);
  CHECK(ended.err.find(": take that window") != std::string::npos);
}

TEST_CASE("a study of kind optimum runs with the others, with files and figures") {
  const Workplace place;
  Json scene = Json::parse(place.read("scene.json"));
  scene["harmonics"]["order"] = 5;
  scene["studies"] = Json::parse(R"([{"name": "best load", "kind": "optimum", "over": ["damper.normal_load"],
    "bounds": [[0.5, 50]], "frequency": [18, 22], "for_each": {"force.cosine": [1, 2]}}])");
  place.write("scene.json", scene.dump());
  const Ended ended = run(place, {"run", "scene.json", "--out", "out", "--quiet"});
  CAPTURE(ended.err);
  CHECK(ended.exit_code == 0);
  const Json json = Json::parse(place.read("out/best_load.json"));
  REQUIRE(json["optima"].size() == 2);
  // By scaling, the optimal load grows in proportion to the force.
  const auto load = [&](std::size_t i) {
    return json["optima"][i]["optimum"]["damper.normal_load"].get<double>();
  };
  CHECK(load(1) == Approx(2 * load(0)).epsilon(1e-6));
  CHECK(json["optima"][1]["set"]["force.cosine"] == 2.0);
  const std::string csv = place.read("out/best_load.csv");
  CHECK(csv.find("study,force.cosine (N),search,damper.normal_load (N),amplitude (m)\r\n") == 0);
  CHECK(csv.find("\r\nbest load,2,2,") != std::string::npos);
  const std::string summary = place.read("out/best_load.summary.csv");
  CHECK(summary.find("study,kind,force.cosine (N),search,status,") == 0);
  CHECK(summary.find(",optimum.damper.normal_load (N),optimum.amplitude (m),") != std::string::npos);
  CHECK(summary.find("\r\nbest load,optimum,2,2,complete,") != std::string::npos);
  const std::string responses = place.read("out/best_load_responses.gp");
  for (const char* of_optimum : {" title '1 N, ", " title '2 N, "})  // a curve of each, at its own load
    CHECK(responses.find(of_optimum) != std::string::npos);
  const std::string data = place.read("out/best_load.dat");
  for (const Json& each : json["optima"])
    for (const Json& range : each["certificate"]["ranges"]["damper.normal_load"]) {
      const std::string from = "\n" + range["lower"].dump() + " ", to = "\n" + range["upper"].dump() + " ";
      CAPTURE(from, to);
      const auto begin = data.find(from);
      CHECK(begin != std::string::npos);
      CHECK(data.find(to, begin) == data.find('\n', begin + 1));
    }
  if (std::system("gnuplot --version >/dev/null 2>&1") == 0) {
    const auto files = place.files();
    for (const char* file : {"out/best_load_amplitude.svg", "out/best_load_responses_amplitude.png"})
      CHECK(std::find(files.begin(), files.end(), file) != files.end());
  }
}

TEST_CASE("the progress of a search reports its phase, its evaluations and the least amplitude so far") {
  const Workplace place;
  std::ifstream two_dampers(source_folder() + "/examples/two_dampers/scene.json");
  Json scene = Json::parse(two_dampers);
  scene["studies"] = {scene["studies"][1]};  // with a limit, so that designs elsewhere are searched from, too
  place.write("scene.json", scene.dump());
  const std::vector<std::string> arguments{
      "optimize", "scene.json", "--harmonics", test_size::sized("31", "7"), "--json", "-"};
  const Ended ended = Program(place, arguments, {}, "", true).wait();
  REQUIRE(ended.exit_code == 0);
  CAPTURE(ended.err);
  const double least = Json::parse(ended.out)["optima"][0]["optimum"]["amplitude"].get<double>();
  const std::regex line(
      R"(\rsearch 1/1  ([a-z ]+?)  (\d+) evaluations?  [\d.]+ Hz(?:  best ([\d.e-]+) m)?  \d+ s)");
  std::set<std::string> phases;
  int evaluations = 0;
  double best = HUGE_VAL;
  for (std::sregex_iterator at(ended.err.begin(), ended.err.end(), line), none; at != none; ++at) {
    const std::smatch& reported = *at;
    phases.insert(reported[1]);
    CHECK(std::stoi(reported[2]) >= evaluations);
    evaluations = std::stoi(reported[2]);
    if (!reported[3].matched) continue;
    CHECK(std::stod(reported[3]) <= best);
    best = std::stod(reported[3]);
  }
  CHECK(phases.contains(
      "the search elsewhere"));  // by far the longest: there is a line every tenth of a second
  CHECK(evaluations <= Json::parse(ended.out)["optima"][0]["evaluations"].get<int>());
  CHECK(best == Approx(least).epsilon(1e-4));  // five digits
}

TEST_CASE("what is asked wrongly of optimize is answered with what is allowed, and exit code 1") {
  const std::vector<std::pair<std::vector<std::string>, std::string>> rows = {
      {{"--over", "damper.normal_load=5:1"},
       "--over damper.normal_load: found 1, must be above the lower bound"},
      {{"--over", "damper.normal_load=5:5"},
       "--over damper.normal_load: found 5, must be above the lower bound"},
      {{"--over", "damper.normal_load=5"}, "found the range \"5\", must be two finite numbers, lower:upper"},
      {{"--over", "k.value"}, "no bounds given; give them as --over k.value=lower:upper"},
      {{"--over", "damper.normal_load=-1:5"}, "--over damper.normal_load: found -1"},
      {{"--over", "damper.load=1:5"}, "--over damper.load: unknown parameter \"damper.load\""},
      {{"--over", "damper.normal_load=1:5", "--over", "damper.normal_load=2:3"}, "again, must be named once"},
      {{"--over", "damper.normal_load=1:5", "--algorithm", "LD_SLSPQ"}, "did you mean \"LD_SLSQP\"?"},
      {{"--algorithm", "G_MLSL"}, "G_MLSL needs a local algorithm, such as LD_SLSQP or LN_BOBYQA"},
      {{"--algorithm", "G_MLSL", "--local", "LN_BOBYQUA"}, "did you mean \"LN_BOBYQA\"?"},
      {{"--evaluations", "0"}, "--evaluations 0: found 0, must be an integer from 1 to 100000000"},
      {{"--evaluations", "many"}, "--evaluations many: must be an integer from 1 to 100000000"},
      {{"--seconds", "-1"}, "--seconds -1: found -1, must be at least 0 s"},
      {{"--seconds", "soon"}, "--seconds soon: must be a number, at least 0 s"},
      {{"--criterion", "wrost"}, "--criterion wrost: found \"wrost\", must be one of \"worst\", \"mean\""},
      {{"--criterion", "mean"}, "--criterion mean: found \"mean\" without \"cases\""},
      {{"--along", "force.cosine"}, "--along force.cosine: no range given; give it as --along force.cosine="},
      {{"--along", "force.cosine=8"},
       "--along force.cosine=8: found the range \"8\", must be two finite numbers"},
      {{"--along", "force.cosine=8:1"},
       "--along force.cosine: found 1, must be above \"from\", which is 8 N"},
      {{"--along", "force.cosin=1:8"}, "did you mean \"force.cosine\"?"},
      {{"--along", "damper.normal_load=1:8"},
       "--along damper.normal_load: found \"damper.normal_load\", which the study is \"over\""},
      {{"--along", "force.cosine=1:8", "--set", "force.cosine=2"},
       "--set force.cosine=2: the study continues the optimum over this parameter; give --along for its "
       "range"},
  };
  for (const auto& [arguments, expected] : rows) {
    const Workplace place;
    const Ended ended = run(place, optimize(arguments));
    INFO(ended.err);
    CHECK(ended.exit_code == 1);
    CHECK(ended.out.empty());
    CHECK(ended.err.find(expected) != std::string::npos);
  }
}

TEST_CASE("bounds without slip are a complete answer: the amplitude does not depend on the load") {
  const Workplace place;
  const Ended ended = run(place, optimize({"--over", "damper.normal_load=400:1000", "--json", "-"}));
  CHECK(ended.exit_code == 0);
  const Json found = Json::parse(ended.out)["optima"][0];
  CHECK(found["stop"]["reason"] == "flat");
  CHECK(found["stop"]["message"].get<std::string>().find("no friction element slips at the peak") !=
        std::string::npos);
}
