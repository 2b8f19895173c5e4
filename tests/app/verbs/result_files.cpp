// show, plot and compare: files of results; --columns and --events.
#include "app/program.hpp"
#include "catch.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <string>
#include <vector>

using namespace app_test;
using Json = nlohmann::json;

namespace {

/// Writes responses with the normal load 3 N to a.json.
void write_responses(const Workplace& place) {
  REQUIRE(run(place, {"frf", "scene.json", "--harmonics", "1", "--set", "damper.normal_load=3", "--json",
                      "a.json", "--quiet"})
              .exit_code == 0);
}

Ended compared(const Workplace& place, const Json& second, const std::vector<std::string>& more = {}) {
  place.write("b.json", second.dump());
  std::vector<std::string> arguments{"compare", "a.json", "b.json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(place, arguments);
}

}  // namespace

TEST_CASE("a file of results is shown as tables, with its units, ends and doubts") {
  const Workplace place;
  write_responses(place);
  const Ended shown = run(place, {"show", "a.json"});
  CHECK(shown.exit_code == 0);
  CHECK(shown.err.empty());
  const Json peak = Json::parse(place.read("a.json"))["branches"][0]["events"][0];
  CHECK(has(shown.out, "Blade to ground with a friction damper"));
  CHECK(has(shown.out, "frequency (Hz)"));
  CHECK(has(shown.out, "amplitude (mm)"));
  CHECK(has(shown.out, std::to_string(1000 * peak["amplitude"].get<double>()).substr(0, 7)));
  const Ended none = run(place, {"show", "a.json", "--events", "none"});
  CHECK(none.exit_code == 0);
  CHECK(none.out.find("peak") == std::string::npos);
  CHECK(run(place, {"show", "a.json", "--events", "peak"}).out == shown.out);
  const Ended chosen = run(place, {"show", "a.json", "--columns", "amplitude,damper.stick_percent"});
  CHECK(has(chosen.out, "amplitude (mm)  damper.stick_percent (%)    branch"));
  CHECK_FALSE(has(chosen.out, "frequency"));
  Json json = Json::parse(place.read("a.json"));
  json["branches"][0]["status"] = "failed";
  json["branches"][0]["stop"]["message"] = "for the test";
  place.write("failed.json", json.dump());
  CHECK(run(place, {"show", "failed.json"}).err == "arcslip: branch 1 failed: for the test\n");
  json["branches"][0]["status"] = "complete";
  json["branches"][0]["doubt"] = "of the test";
  place.write("doubt.json", json.dump());
  CHECK(run(place, {"show", "doubt.json"}).err == "arcslip: branch 1 complete, but of the test\n");
}

TEST_CASE("files that hold no results are refused") {
  const Workplace place;
  place.write("text.json", "none");
  place.write("other.json", "{\"a\": 1}");
  for (const std::string verb : {"show", "plot"}) {
    for (const std::string file : {"scene.json", "text.json", "other.json"}) {
      const Ended ended = run(place, {verb, file});
      CHECK(ended.exit_code == 1);
      CHECK(has(ended.err, file + " holds no results of arcslip"));
    }
    CHECK(has(run(place, {verb, "missing.json"}).err, "cannot open missing.json"));
    CHECK(has(run(place, {verb}).err, "FILE is required"));
  }
  CHECK(has(run(place, {"compare", "scene.json"}).err, "B is required"));
}

TEST_CASE("the same results compare equal, and a changed value, event, end or setting is found") {
  const Workplace place;
  write_responses(place);
  const Json first = Json::parse(place.read("a.json"));
  const Ended same = compared(place, first);
  CHECK(same.exit_code == 0);
  CHECK(has(same.out, "0 differences beyond a relative 1e-06"));
  Json other = first;
  const double amplitude = first["branches"][0]["events"][0]["amplitude"];
  other["branches"][0]["events"][0]["amplitude"] = 1.001 * amplitude;
  const Ended value = compared(place, other);
  CHECK(value.exit_code == 4);
  CHECK(has(value.out, "branches 1 event 1.amplitude: "));
  CHECK(has(value.out, "relative difference 0.001"));
  CHECK(has(value.out, "1 difference beyond"));
  CHECK(compared(place, other, {"--tolerance", "0.01"}).exit_code == 0);
  CHECK(compared(place, other, {"--tolerance", "0.0005"}).exit_code == 4);
  other = first;
  other["branches"][0]["events"][0]["kind"] = "fold";
  CHECK(has(compared(place, other).out, "branches 1 event 1.kind: \"peak\" and \"fold\""));
  other = first;
  other["branches"][0]["events"] = Json::array();
  CHECK(compared(place, other).exit_code == 4);
  other = first;
  other["branches"][0]["status"] = "stopped";
  CHECK(has(compared(place, other).out, "branches 1 status: \"complete\" and \"stopped\""));
  other = first;
  other["branches"][0]["stop"]["reason"] = "user";
  CHECK(has(compared(place, other).out, "branches 1 stop.reason: "));
  other = first;
  other["branches"].push_back(first["branches"][0]);
  CHECK(has(compared(place, other).out, "branches: 1 and 2 results"));
  other = first;
  other["scene_hash"] = "0";
  other["branches"][0]["solver"]["iterations"] = 1;
  const Ended work =
      compared(place, other);  // neither the scene's hash nor the work is a difference of results
  CHECK(work.exit_code == 0);
  CHECK(has(work.out, "the scenes differ"));
  CHECK(has(compared(place, first, {"--tolerance", "-1"}).err,
            "--tolerance -1: must be a number of at least 0"));
}

TEST_CASE("a file of results is drawn over chosen columns") {
  const Workplace place;
  write_responses(place);
  const Ended drawn = run(place, {"plot", "a.json", "--out", "figures"}, {{"PATH", "/nonexistent"}});
  CHECK(drawn.exit_code == 0);
  CHECK(has(drawn.out, "figures/a_plot.gp"));
  const std::string data = place.read("figures/a_plot.dat");
  CHECK(has(data, "frequency (Hz)"));
  CHECK(has(data, "amplitude (mm)"));
  const Ended chosen = run(place, {"plot", "a.json", "--y", "damper.stick_percent", "--x", "omega"},
                           {{"PATH", "/nonexistent"}});
  CHECK(chosen.exit_code == 0);
  CHECK(has(place.read("a_plot_damper.stick_percent_over_omega.dat"), "stick_percent (%)"));
  const Ended none = run(place, {"plot", "a.json", "--y", "nothing"});
  CHECK(none.exit_code == 1);
  CHECK(has(none.err, "a.json has no table with these columns: give --x and --y"));
}

TEST_CASE("columns and kinds of events are chosen for tables") {
  const Workplace place;
  const std::vector<std::string> base{"frf",   "scene.json",           "--harmonics", "1",
                                      "--set", "damper.normal_load=3", "--quiet"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return run(place, more);
  };
  const std::string chosen = with({"--columns", "frequency,amplitude"}).out;
  CHECK(has(chosen, "frequency (Hz)"));
  CHECK(has(chosen, "A_max (mm)"));
  CHECK_FALSE(has(chosen, "event"));
  const Ended csv = with({"--columns", "frequency,damper.stick_percent", "--csv", "-"});
  CHECK(csv.out.starts_with("study,branch,frequency (Hz),damper.stick_percent (%)\r\n"));
  CHECK(has(with({"--events", "fold"}).out, " -  complete"));
  CHECK(has(with({"--events", "peak"}).out, "peak"));
  REQUIRE(with({"--events", "none", "--csv", "a.csv"}).exit_code == 0);
  CHECK(place.read("a.events.csv").find("peak") == std::string::npos);
  CHECK(has(with({"--columns", "amplitud"}).err, "--columns amplitud: must be of omega, frequency, "));
  CHECK(has(with({"--columns", "amplitud"}).err, "did you mean amplitude?"));
  CHECK(has(with({"--columns", "a,,b"}).err, "--columns a,,b: must be names with commas between them"));
  CHECK(has(with({"--events", "peek"}).err, "did you mean peak?"));
  CHECK(has(with({"--events", ""}).err, "--events: found no value"));
}

TEST_CASE("JSON has the units of its columns, and CSV the two largest multipliers in columns of their own") {
  const Workplace place;
  const Ended ended = run(place, {"frf", "scene.json", "--harmonics", "5", "--set", "damper.normal_load=3",
                                  "--stability", "--json", "a.json", "--csv", "a.csv"});
  CHECK(ended.exit_code == 0);
  CHECK(has(ended.out, "largest multipliers"));
  const Json json = Json::parse(place.read("a.json"));
  const Json& units = json["units"]["branches"];
  CHECK(units["points"]["amplitude"] == "m");
  CHECK(units["points"]["frequency"] == "Hz");
  CHECK(units["points"]["elements.damper.stick_percent"] == "%");
  CHECK_FALSE(units["points"].contains("stable"));
  const std::string csv = place.read("a.csv");
  CHECK(has(csv.substr(0, csv.find('\n')),
            "multipliers,multipliers.1.re,multipliers.1.im,multipliers.2.re,multipliers.2.im"));
  const Json& largest = json["branches"][0]["points"][0]["multipliers"][0];
  CHECK(has(csv, "," + largest[0].dump().substr(0, 12)));
}

TEST_CASE("figures have the formats, the size and the style that are asked for") {
  const Workplace place;
  const std::vector<std::string> base{"frf", "scene.json", "--harmonics", "1", "--out", "out", "--quiet"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return run(place, more, {{"PATH", "/nonexistent"}});
  };
  CHECK(with({"--figures", "pdf", "--figure-size", "400x300", "--receptance"}).exit_code == 0);
  std::string script;
  for (const std::string& file : place.files())
    if (file.ends_with(".gp")) script = place.read(file);
  CHECK(has(script, "set terminal pdfcairo size "));
  CHECK(has(script, "_receptance.pdf'"));
  CHECK_FALSE(has(script, "set terminal svg"));
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Case> cases{
      {{"--figures", "gif"}, "--figures gif: must be none, or svg, png and pdf, each once at most"},
      {{"--figures", "svg,svg"}, "--figures svg,svg: must be none, or svg, png and pdf, each once at most"},
      {{"--figures", ""}, "--figures: found no value"},
      {{"--figure-size", "400"},
       "--figure-size 400: must be WIDTHxHEIGHT, from 200 to 10000 each, as 800x500"},
      {{"--figure-size", "100x400"}, "--figure-size 100x400: must be WIDTHxHEIGHT"},
      {{"--figure-size", "400x10001"}, "--figure-size 400x10001: must be WIDTHxHEIGHT"},
      {{"--figure-style", "red"}, "--figure-style red: must be colour or grey"}};
  for (const Case& each : cases) {
    CAPTURE(each.message);
    const Ended refused = with(each.arguments);
    CHECK(refused.exit_code == 1);
    CHECK(has(refused.err, each.message));
  }
}

TEST_CASE("figures of none are their data and scripts, without a word about gnuplot") {
  const Workplace place;
  const Ended ended =
      run(place, {"frf", "scene.json", "--harmonics", "1", "--out", "out", "--figures", "none"},
          {{"PATH", "/nonexistent"}});
  CHECK(ended.exit_code == 0);
  CHECK_FALSE(has(ended.err, "gnuplot"));
  CHECK(has(ended.out, ".gp"));
  CHECK_FALSE(has(ended.out, ".svg"));
}

TEST_CASE("a receptance needs a single force of the first harmonic") {
  const Workplace place;
  auto scene = nlohmann::json::parse(place.read("scene.json"));
  scene["excitation"][0]["harmonic"] = 3;
  place.write("third.json", scene.dump());
  const Ended refused = run(place, {"frf", "third.json", "--receptance"});
  CHECK(refused.exit_code == 1);
  CHECK(has(refused.err,
            "--receptance divides amplitudes by the force of the scene, which has to have a single "
            "excitation: a force of the first harmonic"));
}

TEST_CASE("curves are shown with their parameter, optima with prefixes of units") {
  const Workplace place;
  REQUIRE(run(place, {"peaks", "scene.json", "--harmonics", "1", "--over", "damper.normal_load", "--from",
                      "1", "--to", "10", "--frequency", "18", "22", "--json", "peaks.json", "--quiet"})
              .exit_code == 0);
  const Ended peaks = run(place, {"show", "peaks.json"});
  CHECK(peaks.exit_code == 0);
  CHECK(has(peaks.out, "   kind  damper.normal_load (N)  frequency (Hz)  amplitude (mm)"));
  REQUIRE(run(place, {"optimize", "scene.json", "--harmonics", "1", "--over", "damper.normal_load=1:10",
                      "--frequency", "18", "22", "--json", "best.json", "--quiet"})
              .exit_code == 0);
  const Ended best = run(place, {"show", "best.json"});
  CHECK(best.exit_code == 0);
  for (const char* title :
       {"damper.normal_load (N)", "amplitude (mm)", "frequency (Hz)", "energy_friction (mJ)"}) {
    CAPTURE(title);
    CHECK(has(best.out, title));
  }
}

TEST_CASE("frequencies and amplitudes that differ are shown before what follows from them") {
  const Workplace place;
  write_responses(place);
  REQUIRE(run(place, {"frf", "scene.json", "--harmonics", "1", "--set", "damper.normal_load=3", "--set",
                      "k.value=17000", "--json", "b.json", "--quiet"})
              .exit_code == 0);
  const Ended ended = run(place, {"compare", "a.json", "b.json"});
  CHECK(ended.exit_code == 4);
  const auto parameter = ended.out.find("branches 1.parameters.k.value: "),
             frequency = ended.out.find("branches 1 event 1.frequency: "),
             derived = ended.out.find("branches 1 event 1.energy_friction: ");
  CHECK(parameter < frequency);
  CHECK(frequency < derived);
  CHECK(frequency != std::string::npos);
}
