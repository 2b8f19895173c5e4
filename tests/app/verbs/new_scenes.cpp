// arcslip new: scenes that run and mean what their numbers say.
#include "app/program.hpp"
#include "catch.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

using namespace app_test;
using Json = nlohmann::json;
using std::numbers::pi;

namespace {

Json made(const Workplace& place, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "new");
  const Ended ended = run(place, arguments);
  CAPTURE(ended.err);
  REQUIRE(ended.exit_code == 0);
  CHECK(ended.err.empty());
  return Json::parse(ended.out);
}

}  // namespace

TEST_CASE("a new damper has the numbers of the command, and a certified load in two commands") {
  const Workplace place;
  const Ended ended = run(
      place, {"new", "damper", "--mass", "0.8", "--frequency", "47", "--damping-ratio", "0.0015",
              "--contact-stiffness-ratio", "0.12", "--friction", "0.3", "--force", "2", "--out", "d.json"});
  CHECK(ended.exit_code == 0);
  CHECK((ended.out + ended.err).empty());
  const Json scene = Json::parse(place.read("d.json"));
  const Json& damper = scene["elements"][0];
  const double k = std::pow(2 * pi * 47, 2) * 0.8;
  CHECK(damper["stiffness"] == "ratio*k");
  CHECK(scene["constants"]["ratio"]["value"] == 0.12);
  CHECK(damper["normal_load"].get<double>() == Approx(2 / 0.3).epsilon(1e-3));
  CHECK(has(damper["comment"], "normal_load = force/friction"));
  // 3 kappa/(2 pi) = 5.7 % beyond 47 Hz and 47 sqrt(1.12) Hz.
  CHECK(scene["studies"][0]["from"] == "0.943*f0");
  CHECK(scene["studies"][0]["to"] == "1.12*f0");
  CHECK(scene["studies"][2]["bounds"] == Json::parse(R"([["0.05*balance", "20*balance"]])"));
  const Ended ran = run(place, {"run", "d.json"});
  CHECK(ran.exit_code == 0);
  CHECK_FALSE(has(ran.err, ", but "));
  CHECK(std::filesystem::exists(place / "out/d/report.html"));
  // A friction damper at its best load: the peak lies between the curves for free and for stuck.
  const Json found = Json::parse(place.read("out/d/best_load.json"));
  const Json& best = found["optimum"];
  CHECK(found["optima"][0]["status"] == "complete");
  const double free = 2 / (2 * 0.0015 * k), load = best["damper.normal_load"];
  CHECK(best["amplitude"].get<double>() < free / 10);
  CHECK(load > 2 / 0.3);
  CHECK(load < 3 * 2 / 0.3);
}

TEST_CASE("windows and bounds of a new damper follow its force and its stiffness") {
  const Workplace place;
  place.write("d.json", made(place, {"damper"}).dump());
  const auto best = [&](const std::vector<std::string>& set) {
    std::vector<std::string> arguments = {"optimize", "d.json", "--json", "-"};
    arguments.insert(arguments.end(), set.begin(), set.end());
    const Ended ended = run(place, arguments);
    CAPTURE(ended.err);
    REQUIRE(ended.exit_code == 0);
    return Json::parse(ended.out)["optimum"];
  };
  const Json plain = best({});
  const double amplitude = plain["amplitude"], load = plain["damper.normal_load"];
  // Without dimensions the equations stay the same: x ~ force/k, t ~ 1/f0.
  const Json forced = best({"--set", "force.cosine=30"});
  CHECK(forced["amplitude"].get<double>() == Approx(30 * amplitude).epsilon(1e-6));
  CHECK(forced["damper.normal_load"].get<double>() == Approx(30 * load).epsilon(1e-3));
  const double w = 2 * pi * 50, k = w * w, c = 2 * 0.002 * w;
  const Json stiffer =
      best({"--set", "k.value=" + std::to_string(16 * k), "--set", "c.value=" + std::to_string(4 * c)});
  CHECK(stiffer["amplitude"].get<double>() == Approx(amplitude / 16).epsilon(1e-6));
  CHECK(stiffer["frequency"].get<double>() == Approx(4 * plain["frequency"].get<double>()).epsilon(1e-4));
}

TEST_CASE("each kind of new scene runs without a doubt") {
  for (const std::string kind : {"damper", "beam", "duffing", "contact", "joint"}) {
    const Workplace place;
    CAPTURE(kind);
    place.write("scene.json", made(place, {kind}).dump());
    const Ended checked = run(place, {"check", "scene.json"});
    CHECK(checked.exit_code == 0);
    CHECK_FALSE(has(checked.err, "check this"));
    const Ended ran = run(place, {"run", "scene.json", "--out", "out"}, {{"PATH", "/nonexistent"}});
    CAPTURE(ran.err);
    CHECK(ran.exit_code == 0);
    CHECK_FALSE(has(ran.err, ", but "));
    CHECK_FALSE(has(ran.err, "no peak"));
    CHECK(has(place.read("out/report.html"), "No doubts"));
  }
}

TEST_CASE("a new beam has the first frequency of its closed form") {
  const Workplace place;
  place.write("beam.json", made(place, {"beam", "--length", "2", "--height", "0.01"}).dump());
  // 1.8751^2/(2 pi L^2) sqrt(E h^2/(12 rho)) = 2.0888 Hz
  const double first = 1.8751 * 1.8751 / (2 * pi * 4) * std::sqrt(2.1e11 * 1e-4 / (12 * 7850.0));
  const std::string err = run(place, {"check", "beam.json"}).err, before = "with all contacts free: ";
  const auto at = err.find(before);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(err.substr(at + before.size())) == Approx(first).epsilon(1e-4));
}

TEST_CASE("a scene of matrices names their rows, and has damping where no matrix has it") {
  const Workplace place;
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  place.write("M.mtx", head + "2 2 2\n1 1 2\n2 2 2\n");
  place.write("K.mtx", head + "2 2 3\n1 1 5000\n2 2 5000\n2 1 -3000\n");
  const Ended ended = run(place, {"new", "from-matrices", "M.mtx", "K.mtx", "--at", "1", "--response", "2",
                                  "--damping-ratio", "0.02", "--out", "fe.json"});
  CAPTURE(ended.err);
  REQUIRE(ended.exit_code == 0);
  CHECK(place.read("fe.names.csv") == "name,row\nrow1,1\nrow2,2\n");
  // sqrt(2000/2) and sqrt(8000/2) rad/s
  const std::string err = run(place, {"check", "fe.json"}).err;
  CHECK(has(err, "natural frequencies: 5.0329 and 10.066 Hz"));
  CHECK(has(err, "damping ratios of these modes, without friction: 2 % and 2 %"));
  const Ended responses = run(place, {"frf", "fe.json", "--json", "-", "--quiet"});
  CHECK(responses.exit_code == 0);
  const Json peak = Json::parse(responses.out)["branches"][0]["events"][0];
  CHECK(peak["frequency"].get<double>() == Approx(5.03).epsilon(1e-2));
  CHECK(has(run(place, {"new", "from-matrices", "M.mtx", "K.mtx", "--at", "1", "--contact", "2",
                        "--contact-stiffness", "300", "--out", "with.json"})
                .err,
            "") == true);
  CHECK(Json::parse(place.read("with.json"))["elements"][0]["stiffness"] == 300.0);
}

TEST_CASE("what makes no new scene is refused with what to do") {
  const Workplace place;
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  place.write("M.mtx", head + "1 1 1\n1 1 2\n");
  place.write("K.mtx", head + "1 1 1\n1 1 5000\n");
  const auto refused = [&](std::vector<std::string> arguments, const std::string& message, int code = 1) {
    arguments.insert(arguments.begin(), "new");
    const Ended ended = run(place, arguments);
    CAPTURE(ended.err);
    CHECK(ended.exit_code == code);
    CHECK(has(ended.err, message));
    CHECK(ended.out.empty());
  };
  refused({}, "new needs a kind of scene: damper, beam, duffing, contact, joint or from-matrices");
  refused({"dampr"}, "unknown kind of scene \"dampr\"");
  refused({"dampr"}, "did you mean damper?");
  refused({"damper", "--mass", "-1"}, "--mass -1: must be a number above 0");
  refused({"damper", "--mass", "x"}, "--mass x: must be a number above 0");
  refused({"damper", "--damping-ratio", "1.5"},
          "--damping-ratio 1.5: must be a number of at least 0, at most 1");
  refused({"damper", "--mas", "1"}, "did you mean --mass?");
  refused({"damper", "--out", ""}, "--out needs a nonempty name");
  refused({"damper", "--out", "scene.json"},
          "scene.json exists: choose another name for the scene, or remove it");
  const std::vector<std::string> fe = {"from-matrices", "M.mtx", "K.mtx"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = fe;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  refused({"from-matrices", "M.mtx"}, "K.mtx is required");
  refused(fe, "new from-matrices needs --at ROW");
  refused(with({"--at", "1"}), "give --out FILE, or --names FILE");
  refused(with({"--at", "tip", "--out", "a.json"}), "the row \"tip\" is no number: give --names FILE");
  refused(with({"--at", "1", "--contact", "1", "--out", "a.json"}), "--contact needs --contact-stiffness K");
  refused(with({"--at", "9", "--out", "a.json"}), "found the row \"9\", must be an integer from 1 to 1", 2);
  CHECK(place.files() == std::vector<std::string>{"K.mtx", "M.mtx", "scene.json"});
}
