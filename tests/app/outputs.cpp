// Where results go: what one output meets costs no other one, no two are the same file, and none deadlocks.

#include "catch.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <sys/stat.h>

using namespace app_test;
using Json = nlohmann::json;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

/// One mass, one damper: each study takes milliseconds.
void write_tiny_scene(const Workplace& place) {
  place.write("tiny.json", R"({"format": "arcslip-scene-1", "structure": {"dofs": ["a"],
    "masses": [{"name": "m", "at": "a", "value": 1}], "springs": [{"name": "k", "at": "a", "value": 4000}],
    "dampers": [{"name": "c", "at": "a", "value": 1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "a", "stiffness": 1000, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "f", "at": "a", "cosine": 5}], "harmonics": {"order": 3}, "response": {"at": "a"},
    "studies": [{"name": "one", "kind": "frf", "from": 5, "to": 16},
                {"name": "two", "kind": "frf", "from": 5, "to": 12}]})");
}

/// gnuplot, as a script.
std::map<std::string, std::string> with_gnuplot(const Workplace& place, const std::string& script) {
  fs::create_directory(place / "bin");
  place.write("bin/gnuplot", "#!/bin/sh\n" + script);
  fs::permissions(place / "bin/gnuplot", fs::perms::owner_all);
  return {{"PATH", (place / "bin").string() + ":/usr/bin:/bin"}};
}

void check_whole(const Workplace& place, const std::string& study) {
  CAPTURE(study);
  CHECK(Json::parse(place.read("results/" + study + ".json"))["branches"][0]["status"] == "complete");
  CHECK(place.read("results/" + study + ".events.csv").find("\r\n" + study + ",1,peak,") !=
        std::string::npos);
}

}  // namespace

TEST_CASE("a full or closed standard output costs no file and no study") {
  for (const std::string screen : {"> /dev/full", ">&-", "| true"}) {
    CAPTURE(screen);
    const Workplace place;
    write_tiny_scene(place);
    const std::string command = std::string("cd '") + place.path() + "' && { PATH=/nonexistent '" +
                                arcslip_program() +
                                "' run tiny.json --json a.json --csv a.csv --out results 2>err; "
                                "echo $? >code; } " +
                                screen;
    CHECK(std::system(command.c_str()) >= 0);
    CHECK(place.read("err").find("arcslip: cannot write standard output: ") != std::string::npos);
    CHECK(place.read("code") == "1\n");
    check_whole(place, "one");
    check_whole(place, "two");
    CHECK(Json::parse(place.read("a.json"))["branches"].size() == 2);
    CHECK(place.read("a.csv").find("\r\ntwo,2,") != std::string::npos);
  }
}

TEST_CASE("a file that cannot be written costs no other one") {
  const Workplace place;
  write_tiny_scene(place);
  const Ended ended =
      run(place, {"run", "tiny.json", "--json", "/dev/full", "--csv", "a.csv", "--out", "results"},
          {{"PATH", "/nonexistent"}});
  CHECK(ended.exit_code == 1);
  CHECK(ended.err.find("cannot write /dev/full: No space left on device") != std::string::npos);
  CHECK(ended.out.find("peak") != std::string::npos);
  check_whole(place, "one");
  check_whole(place, "two");
  CHECK(place.read("a.csv").find("\r\ntwo,2,") != std::string::npos);
}

TEST_CASE("one study alone leaves the files of another whose name begins with its own") {
  const Workplace place;
  write_tiny_scene(place);
  Json scene = Json::parse(place.read("tiny.json"));
  scene["studies"][1]["name"] = "one_fine";
  place.write("tiny.json", scene.dump());
  const std::map<std::string, std::string> nothing{{"PATH", "/nonexistent"}};
  CHECK(run(place, {"run", "tiny.json", "--out", "results"}, nothing).exit_code == 0);
  const auto before = place.files();
  CHECK(std::find(before.begin(), before.end(), "results/one_fine.gp") != before.end());
  CHECK(run(place, {"frf", "tiny.json", "--out", "results"}, nothing).exit_code == 0);
  CHECK(place.files() == before);
}

TEST_CASE("tables of earlier results that these have no counterpart of are reported, and stay") {
  const Workplace place;
  write_tiny_scene(place);
  place.write("a.cases.csv", "my own\n");
  CHECK(run(place, {"frf", "tiny.json", "--csv", "a.csv"}).exit_code == 0);
  CHECK(fs::exists(place / "a.events.csv"));
  const std::string events = place.read("a.events.csv");
  const Ended other = run(place, {"time", "tiny.json", "--frequency", "10", "--csv", "a.csv"});
  CHECK(other.exit_code == 0);
  CHECK(other.err.find("a.events.csv is left from earlier results: these have no such table") !=
        std::string::npos);
  CHECK(place.read("a.csv").find("study,motion,") == 0);
  CHECK(fs::exists(place / "a.summary.csv"));
  CHECK(place.read("a.events.csv") == events);
  CHECK(place.read("a.cases.csv") == "my own\n");
}

TEST_CASE("results are the same in a file that takes them as they come and where they are kept to the end") {
  const Workplace place;
  write_tiny_scene(place);
  // Times of computation differ from run to run.
  const auto parsed = [](const std::string& text) {
    Json all = Json::parse(text);
    for (const char* const list : {"branches", "motions"})
      if (all.contains(list))
        for (Json& each : all[list]) each.erase("solver");
    return all;
  };
  CHECK(run(place, {"run", "tiny.json", "--json", "a.json", "--csv", "a.csv"}).exit_code == 0);
  CHECK(parsed(place.read("a.json")) == parsed(run(place, {"run", "tiny.json", "--json", "-"}).out));
  CHECK(place.read("a.csv") == run(place, {"run", "tiny.json", "--csv", "-"}).out);
  CHECK(parsed(place.read("a.json"))["branches"].size() == 2);

  // Lists of two kinds, in turn: those of a list come one after the other.
  Json scene = Json::parse(place.read("tiny.json"));
  scene["studies"].insert(scene["studies"].begin() + 1,
                          Json{{"name", "between"}, {"kind", "time"}, {"frequency", 10}});
  place.write("mixed.json", scene.dump());
  CHECK(run(place, {"run", "mixed.json", "--json", "b.json"}).exit_code == 0);
  const Json mixed = parsed(place.read("b.json"));
  CHECK(mixed["branches"] == parsed(place.read("a.json"))["branches"]);
  CHECK(mixed["motions"].size() == 1);
}

TEST_CASE("a sweep over many combinations takes no more memory than a short one") {
  const Workplace place;
  write_tiny_scene(place);
  const auto swept = [&](int responses, const std::vector<std::string>& output) {
    Json scene = Json::parse(place.read("tiny.json")), values = Json::array();
    for (int k = 0; k < responses; ++k) values.push_back(3 + 0.01 * k);
    scene["studies"] = {
        {{"name", "s"}, {"kind", "frf"}, {"from", 9}, {"to", 11}, {"for_each", {{"d.normal_load", values}}}}};
    place.write("sweep.json", scene.dump());
    std::vector<std::string> command = {"frf", "sweep.json"};
    command.insert(command.end(), output.begin(), output.end());
    const Ended ended = run(place, command);
    CHECK(ended.exit_code == 0);
    return ended;
  };
  // What the figures of up to 2500 responses show stays in memory, but not of more.
  const std::string undrawn =
      "arcslip: no figure of the study \"s\" is drawn: it has 3000 combinations, and figures show at most "
      "2500";
  const Ended few_in_folder = swept(3, {"--out", "few"}), many_in_folder = swept(2501, {"--out", "many"}),
              more_in_folder = swept(3000, {"--out", "more"});
  CHECK(few_in_folder.err.find("no figure") == std::string::npos);
  CHECK(more_in_folder.err.find(undrawn) != std::string::npos);
  CHECK(fs::exists(place / "few/s.gp"));
  CHECK(!fs::exists(place / "more/s.gp"));
  CHECK(fs::exists(place / "more/s.csv"));
  if (ARCSLIP_SANITIZED) return;  // what is freed is kept
  CHECK(5 * more_in_folder.kilobytes < 6 * many_in_folder.kilobytes);

  const std::vector<std::string> files = {"--json", "s.json", "--csv", "s.csv"};
  const long few = swept(3, files).kilobytes, many = swept(500, files).kilobytes;
  const auto written = static_cast<long>(fs::file_size(place / "s.json") / 1024);
  CAPTURE(few, many, written);
  CHECK(written > 4 * few);
  CHECK(many < 2 * few);
}

TEST_CASE("a named pipe is opened once and gets all, and a scene may come from one") {
  const Workplace place;
  write_tiny_scene(place);
  REQUIRE(::mkfifo((place / "scene.pipe").c_str(), 0600) == 0);
  REQUIRE(::mkfifo((place / "json.pipe").c_str(), 0600) == 0);
  const std::string command = std::string("cd '") + place.path() +
                              "' && { timeout 60 cat json.pipe > a.json & timeout 60 cat tiny.json > "
                              "scene.pipe & timeout 60 '" +
                              arcslip_program() +
                              "' frf scene.pipe --json json.pipe >/dev/null; echo $? > code; wait; }";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(place.read("code") == "0\n");
  CHECK(Json::parse(place.read("a.json"))["branches"][0]["status"] == "complete");
}

TEST_CASE("one signal ends the wait for a pipe's reader or writer, with a sentence") {
  const Workplace place;
  write_tiny_scene(place);
  REQUIRE(::mkfifo((place / "pipe").c_str(), 0600) == 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    Program writing(place, {"frf", "tiny.json", "--quiet", "--json", "pipe", "--csv", "a.csv"});
    while (!fs::exists(place / "a.csv")) std::this_thread::sleep_for(10ms);  // files come first
    std::this_thread::sleep_for(200ms);
    writing.send(signal);
    const Ended ended = writing.wait();
    CHECK(ended.exit_code == 3);
    CHECK(ended.err.find("cannot write pipe: Interrupted system call (nobody read it") != std::string::npos);
    CHECK(ended.err.find("arcslip: interrupted while writing results; not written: pipe\n") !=
          std::string::npos);
    CHECK(ended.out.find("peak") != std::string::npos);
    fs::remove(place / "a.csv");

    Program reading(place, {"check", "pipe", "--quiet"});
    std::this_thread::sleep_for(500ms);
    reading.send(signal);
    const Ended none = reading.wait();
    CHECK(none.exit_code == 3);
    CHECK(none.err == "arcslip: interrupted while pipe was read\n");
  }
}

TEST_CASE("no two outputs go to one file, by whatever names") {
  const Workplace place;
  write_tiny_scene(place);
  fs::create_symlink("a.json", place / "link");
  fs::create_directory(place / "results");
  fs::create_directory_symlink("results", place / "other");
  place.write("b.json", "old");
  fs::create_hard_link(place / "b.json", place / "c.csv");
  const auto refused = [&](std::vector<std::string> options, const std::string& message) {
    options.insert(options.begin(), {"run", "tiny.json"});
    const auto before = place.files();
    const Ended ended = run(place, options);
    CAPTURE(ended.err);
    CHECK(ended.exit_code == 1);
    CHECK(ended.err.find(message) != std::string::npos);
    CHECK(place.files() == before);
  };
  refused({"--out", "results", "--json", "a.json", "--csv", "link"}, "--json and --csv both go to link");
  refused({"--out", "results", "--json", "link", "--csv", "./a.json"},
          "--json and --csv both go to ./a.json");
  refused({"--out", "results", "--json", "b.json", "--csv", "c.csv"}, "--json and --csv both go to c.csv");
  refused({"--out", "results", "--csv", "other/two.csv"},
          "the results of the study \"two\" and --csv both go to other/two.csv");
  fs::create_symlink("../tiny.json", place / "results/one.csv");
  refused({"--out", "results"}, "results/one.csv is the scene file itself");
  fs::remove(place / "results/one.csv");
  const std::string stdout_file = place / "all.txt";
  place.write("all.txt", "");
  const Ended ended = run(place, {"frf", "tiny.json", "--json", "all.txt"}, {}, stdout_file);
  CHECK(ended.exit_code == 1);
  CHECK(ended.err.find("standard output and --json both go to all.txt") != std::string::npos);
  fs::create_symlink("circle", place / "circle");
  const Ended lost = run(place, {"frf", "tiny.json", "--csv", "circle"});
  CHECK(lost.exit_code == 1);
  CHECK(lost.err.find("cannot write circle: ") != std::string::npos);
}

TEST_CASE("a link to what is not there yet is followed") {
  const Workplace place;
  write_tiny_scene(place);
  fs::create_directory(place / "far");
  fs::create_symlink("far/a.json", place / "link");
  fs::create_symlink("link", place / "another");
  CHECK(run(place, {"frf", "tiny.json", "--json", "another"}).exit_code == 0);
  CHECK(fs::is_symlink(place / "link"));
  CHECK(fs::is_symlink(place / "another"));
  CHECK(Json::parse(place.read("far/a.json"))["branches"][0]["status"] == "complete");
}

TEST_CASE("figures of an earlier run do not stand next to other data where gnuplot fails") {
  const Workplace place;
  write_tiny_scene(place);
  // As gnuplot would: what its script sets, with the suffix of its command line.
  const auto working = with_gnuplot(place, R"(suffix=$(printf %s "$3" | sed "s/suffix='\(.*\)'/\1/")
    for image in $(sed -n "s/^set output '\(.*\)'.suffix$/\1/p" "$4"); do
      case $image in *.svg) echo '</svg>' ;; *) echo IEND ;; esac > "$image$suffix"
    done)");
  REQUIRE(run(place, {"run", "tiny.json", "--out", "results"}, working).exit_code == 0);
  for (const char* image : {"one_amplitude.svg", "one_amplitude.png", "one_stick.svg", "two_stick.png"})
    REQUIRE(fs::exists(place / ("results/" + std::string(image))));
  place.write("results/mine.svg", "kept");
  place.write("results/one_of_mine.svg", "kept");
  place.write("results/one_stick.svg.4711.tmp", "of a run that was killed");
  place.write("results/.arcslip-4711-0.tmp", "of a run that was killed");

  place.write("bin/gnuplot", "#!/bin/sh\nprintf 'no \\033[31mred\\n'; exit 3\n");
  const Ended ended =
      run(place, {"run", "tiny.json", "--out", "results", "--set", "d.normal_load=2"}, working);
  CHECK(ended.exit_code == 0);
  CHECK(ended.err.find("gnuplot could not draw the figures (exit code 3)") != std::string::npos);
  CHECK(ended.err.find("\nno \\u001b[31mred") != std::string::npos);
  CHECK(ended.err.find("those of an earlier run were removed") != std::string::npos);
  std::vector<std::string> left;
  for (const std::string& file : place.files())
    if (file.starts_with("results/") && !file.ends_with(".json") && !file.ends_with(".csv") &&
        !file.ends_with(".dat") && !file.ends_with(".gp") && !file.ends_with(".html"))
      left.push_back(file);
  CHECK(left == std::vector<std::string>{"results/mine.svg", "results/one_of_mine.svg",
                                         "results/one_stick.svg.4711.tmp"});
}

TEST_CASE("a signal while figures are drawn ends gnuplot and is reported, with exit code 3") {
  const Workplace place;
  write_tiny_scene(place);
  const auto hanging = with_gnuplot(place, "echo $$ > drawing; exec sleep 600\n");
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::create_directory(place / "results");
    place.write("results/two.csv", "of an earlier run\n");
    Program program(place, {"run", "tiny.json", "--out", "results", "--quiet"}, hanging);
    while (!fs::exists(place / "results/drawing") || place.read("results/drawing").empty())
      std::this_thread::sleep_for(10ms);
    const pid_t gnuplot = std::stoi(place.read("results/drawing"));
    program.send(signal);
    const Ended ended = program.wait();
    CHECK(ended.exit_code == 3);
    CHECK(ended.err.find("arcslip: interrupted before the figures were drawn") != std::string::npos);
    // The study after it may be under way, or at its end.
    CHECK(ended.err.find("run gnuplot -d one.gp in results") != std::string::npos);
    CHECK(::kill(gnuplot, 0) != 0);
    check_whole(place, "one");
    fs::remove_all(place / "results");
  }
}
