// The page that run leaves.

#include "catch.hpp"
#include "contains.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>

using namespace app_test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::map<std::string, std::string> without_gnuplot{{"PATH", "/nonexistent"}};

Ended run_at_order_1(const Workplace& place, std::vector<std::string> more) {
  more.insert(more.begin(), {"run", "scene.json", "--harmonics", "1"});
  return run(place, more, without_gnuplot);
}

}  // namespace

TEST_CASE("run leaves a report in its folder, which the manifest names") {
  const Workplace place;
  const Ended ended = run_at_order_1(place, {"--out", "o"});
  CHECK(ended.exit_code == 0);
  CHECK(contains(ended.out, "\no/report.html\n"));
  const std::string page = place.read("o/report.html");
  for (const char* part : {"Blade to ground with a friction damper", "<h2>frf</h2>", "<h2>peaks</h2>",
                           "<h2>best load</h2>", "Each result is complete"})
    CHECK(contains(page, part));
  bool is_named = false;
  const Json written = Json::parse(place.read("o/arcslip-manifest.json"));
  for (const Json& set : written["sets"])
    is_named = is_named || (set["name"] == "the report" && set["complete"] == true &&
                            set["files"].contains("report.html"));
  CHECK(is_named);
}

TEST_CASE("a report has the optimum with its range and its certificate in words") {
  const Workplace place;
  REQUIRE(run_at_order_1(place, {"--out", "o", "--quiet"}).exit_code == 0);
  const std::string page = place.read("o/report.html");
  const Json best = Json::parse(place.read("o/best_load.json"))["optimum"];
  char load[32];
  std::snprintf(load, sizeof load, "%.5g", best["damper.normal_load"].get<double>());
  CAPTURE(load);
  CHECK(contains(page, "The lowest peak is <strong>"));
  CHECK(contains(page, "<strong>damper.normal_load = " + std::string(load).substr(0, 5)));
  CHECK(contains(page, "1 % above the lowest"));
  CHECK(contains(page, "5 % above the lowest"));
  CHECK(contains(page, "To first order no change of the parameters lowers the peak"));
  CHECK(contains(page, "A second method, the lowest point of the curve of peaks"));
  CHECK(contains(page, "It is a local minimum."));
  CHECK(contains(page, "class=\"band c0\""));
}

TEST_CASE(
    "the option --report writes the report elsewhere and of any study, and one of an earlier run goes") {
  const Workplace place;
  REQUIRE(run_at_order_1(place, {"--out", "o", "--quiet"}).exit_code == 0);
  REQUIRE(fs::exists(place / "o/report.html"));
  CHECK(run_at_order_1(place, {"--out", "o", "--report", "page.html", "--quiet"}).exit_code == 0);
  CHECK(contains(place.read("page.html"), "<h2>frf</h2>"));
  CHECK_FALSE(fs::exists(place / "o/report.html"));

  CHECK(run(place, {"frf", "scene.json", "--harmonics", "1", "--report", "frf.html"}, without_gnuplot)
            .exit_code == 0);
  const std::string page = place.read("frf.html");
  CHECK(contains(page, "<svg class=\"plain\""));
  CHECK_FALSE(contains(page, "<h2>peaks</h2>"));
  CHECK_FALSE(fs::exists(place / "out"));
}

TEST_CASE("a report that the user changed stays where a run writes its own elsewhere") {
  const Workplace place;
  REQUIRE(run_at_order_1(place, {"--out", "o", "--quiet"}).exit_code == 0);
  place.write("o/report.html", "mine");
  CHECK(run_at_order_1(place, {"--out", "o", "--report", "page.html", "--quiet"}).exit_code == 0);
  CHECK(place.read("o/report.html") == "mine");
}

TEST_CASE("a report goes to no file that is taken, to no standard output, and to none without a name") {
  const Workplace place;
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    std::vector<std::string> arguments{"frf", "scene.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = run(place, arguments);
    CAPTURE(ended.err);
    CHECK(ended.exit_code == 1);
    CHECK(contains(ended.err, message));
    CHECK(place.files() == std::vector<std::string>{"scene.json"});
  };
  refused({"--json", "a", "--report", "a"}, "--json and the report both go to a");
  refused({"--report", "scene.json"}, "scene.json is the scene file itself");
  refused({"--report", "-"}, "--report needs the name of a file");
  refused({"--report", ""}, "need a nonempty name");
  refused({"--report", "nowhere/a.html"}, "cannot write nowhere/a.html");
}

TEST_CASE("a report on a full disk costs no other file") {
  const Workplace place;
  const Ended ended = run_at_order_1(place, {"--out", "o", "--report", "/dev/full"});
  CHECK(ended.exit_code == 1);
  CHECK(contains(ended.err, "cannot write /dev/full: No space left on device"));
  CHECK(fs::exists(place / "o/frf.json"));
  CHECK(fs::exists(place / "o/best_load.json"));
}
