// Signals at random moments: ARCSLIP_MOMENTS of each row of the table, by default 4, or 1000 with
// ARCSLIP_FULL=1.

#include "catch.hpp"
#include "csv_text.hpp"
#include "environment.hpp"
#include "interruptions.hpp"
#include "program.hpp"
#include "random.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

using namespace app_test;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

namespace {

const std::string old_content = "as it was before\n";

/// With every file of the row already there. Without gnuplot: figures take their time.
struct Run {
  explicit Run(const RandomInterruption& row, std::vector<std::string> more = {}) {
    Json scene;
    std::ifstream(source_folder() + "/examples/" + row.example) >> scene;
    if (!row.patch.empty()) scene.merge_patch(Json::parse(row.patch));
    place.write("scene.json", scene.dump(1));
    for (const std::string& file : row.files) {
      std::filesystem::create_directories((place / file).parent_path());
      place.write(file, old_content);
    }
    before = place.files();
    more.insert(more.begin(), row.arguments.begin(), row.arguments.end());
    program.emplace(place, more, std::map<std::string, std::string>{{"PATH", "/nonexistent"}});
    while (program->is_running() && !program->handles(SIGTERM)) std::this_thread::yield();
  }

  Workplace place;
  std::vector<std::string> before;
  std::optional<Program> program;
};

bool is_whole(const std::string& name, const std::string& text) {
  if (name.ends_with(".json")) return !Json::parse(text, nullptr, false).is_discarded();
  return name.ends_with(".csv") ? is_whole_table(text) : text.ends_with('\n');
}

bool says_stopped_by_user(const Json& results) {
  if (!results.is_structured()) return false;
  if (results.contains("stop") && results["stop"].value("reason", "") == "user") return true;
  return std::any_of(results.begin(), results.end(), says_stopped_by_user);
}

/// Returns whether any of the new files is there.
void check_files(const Run& run, const RandomInterruption& row, int exit_code) {
  // Nothing is left over, and nothing of what was there is gone.
  std::vector<std::string> now = run.place.files();
  std::erase_if(now, [](const std::string& file) { return file.ends_with("arcslip-manifest.json"); });
  CHECK((exit_code == 0 ? now == run.before
                        : std::includes(run.before.begin(), run.before.end(), now.begin(), now.end())));
  for (const std::string& file : row.files) {
    if (exit_code != 0 && !std::binary_search(now.begin(), now.end(), file)) continue;
    const std::string text = run.place.read(file);
    CAPTURE(file, text.substr(0, 300), text.size());
    CHECK((text == old_content || is_whole(file, text)));
    if (exit_code == 0) CHECK(text != old_content);
    if (exit_code == 0 && text != old_content && file.ends_with(".json"))
      CHECK_FALSE(says_stopped_by_user(Json::parse(text, nullptr, false)));
  }
}

}  // namespace

TEST_CASE(
    "a signal at any moment ends with whole files, an exit code and a sentence, and within a second of "
    "work") {
  test_random::Random random(1);
  for (const RandomInterruption& row : random_interruptions()) {
    const auto began = Clock::now();
    Run whole(row);
    const Ended uninterrupted = whole.program->wait();
    CAPTURE(row.arguments.front(), uninterrupted.err);
    REQUIRE((uninterrupted.exit_code == 0 || uninterrupted.exit_code == 3));  // 3: a limit of the study
    const double duration = Seconds(Clock::now() - began).count();
    for (std::uint64_t i = 0; i < random_moments.count(); ++i) {
      const bool quiet = random.one_in(3);
      const int signal = random.one_in(2) ? SIGINT : SIGTERM;
      const double moment = random.between(0, duration);
      CAPTURE(i, quiet, signal, moment, duration);
      Run run(row, quiet ? std::vector<std::string>{"--quiet"} : std::vector<std::string>{});
      std::this_thread::sleep_for(Seconds(moment));
      const double worked = run.program->processor_seconds();
      const bool was_running = run.program->is_running();
      run.program->send(signal);
      const Ended ended = run.program->wait();
      CAPTURE(ended.err, ended.out.substr(0, 200), was_running);
      CHECK(ended.signal == 0);
      CHECK((ended.exit_code == 0 || ended.exit_code == 3));
      if (ended.exit_code == 3) CHECK(ended.err.find("arcslip: ") != std::string::npos);
      if (was_running) CHECK(ended.processor_seconds - worked < 1);
      check_files(run, row, ended.exit_code);
      if (!ended.out.empty() && ended.out.front() == '{')
        CHECK_FALSE(Json::parse(ended.out, nullptr, false).is_discarded());
    }
  }
}

TEST_CASE("a signal before any study is started leaves all files unchanged, and says so") {
  constexpr int moments = 50, most_rounds = 20;
  for (const RandomInterruption& row : random_interruptions()) {
    CAPTURE(row.arguments);
    if (row.arguments.front() == "check") continue;
    // The study begins some time after the scene is read, which is nearly all that check does.
    Run reading({{"check", "scene.json", "--quiet"}, row.example, {}, row.patch});
    const auto began = Clock::now();
    reading.program->wait();
    const double duration = Seconds(Clock::now() - began).count();
    bool met = false;
    for (int i = 0; i < moments * most_rounds && !met; ++i) {
      Run run(row, {"--quiet"});
      std::this_thread::sleep_for(Seconds(2 * duration * (i % moments) / moments));
      run.program->send(SIGTERM);
      const Ended ended = run.program->wait();
      met = ended.err.find("was not started") != std::string::npos &&
            ended.err.find("the results so far") == std::string::npos;
      if (!met) continue;
      CAPTURE(ended.err);
      CHECK(ended.exit_code == 3);
      CHECK(ended.err.find("was not started: its files are unchanged") != std::string::npos);
      CHECK(ended.err.find("interrupted before any study was started: nothing was computed or written") !=
            std::string::npos);
      CHECK(ended.out.empty());
      CHECK(run.place.files() == run.before);
      for (const std::string& file : row.files) CHECK(run.place.read(file) == old_content);
    }
    CHECK(met);
  }
}
