#include "output_paths.hpp"
#include "catch.hpp"
#include "csv_text.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>

#include <sys/wait.h>

using namespace app_test;
using Json = nlohmann::json;

namespace {

struct Verb {
  std::string name, arguments;
};

const std::vector<Verb> verbs = {
    {"frf", "scene.json --harmonics 5"},
    {"trace", "scene.json --harmonics 5 --over k.value --from 15000 --to 20000 --frequency 20"},
    {"peaks", "scene.json --harmonics 5"},
    {"time", "scene.json --frequency 20 --set damper.normal_load=3"},
    {"optimize", "scene.json --harmonics 5"},
};

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
  return text;
}

/// Runs the script in the place, with what arcslip says in "err" and its exit code in "code". Without
/// gnuplot.
void run_script(const Workplace& place, const OutputPath& row, const Verb& verb) {
  place.write("script", "cd '" + place.path() + "'\narcslip() { timeout 60 env PATH=/nonexistent '" +
                            arcslip_program() + "' \"$@\"; echo $? > code; }\n" +
                            replaced(row.script, "VERB", verb.name + " " + verb.arguments) + "\n");
  const std::string command = std::string(row.needs_mount ? "unshare -rm " : "") + "sh '" + place.path() +
                              "/script' > /dev/null 2> '" + place.path() + "/err'";
  [[maybe_unused]] const int status = std::system(command.c_str());  // the script writes it to a file
}

bool mounts() {
  static const bool can = std::system("unshare -rm sh -c 'mount -t tmpfs none /mnt' 2> /dev/null") == 0;
  return can;
}

/// As long as the one of a run without trouble: times of computing differ, numbers of lines do not.
void check_complete(const std::string& file, const std::string& text, const std::string& model) {
  CAPTURE(file, text.substr(0, 200), text.size(), model.size());
  CHECK(std::count(text.begin(), text.end(), '\n') == std::count(model.begin(), model.end(), '\n'));
  if (file.ends_with(".json")) CHECK_FALSE(Json::parse(text, nullptr, false).is_discarded());
  if (file.ends_with(".csv")) CHECK(is_whole_table(text));
}

}  // namespace

TEST_CASE("whatever a path is, its failure is reported, and costs none of what goes elsewhere") {
  for (const Verb& verb : verbs) {
    std::map<std::string, std::string> models;
    for (const OutputPath& row : output_paths()) {
      const bool writes_little = verb.name == "optimize";
      if ((row.needs_mount && !mounts()) || (row.needs_much && writes_little)) continue;
      CAPTURE(verb.name, row.name);
      const Workplace place;
      run_script(place, row, verb);
      const std::string err = place.read("err");
      CAPTURE(err);
      CHECK(place.read("code") == std::to_string(row.exit_code) + "\n");
      CHECK(err.find(row.message) != std::string::npos);
      CHECK((row.exit_code == 0 || row.message.empty() || !err.empty()));
      for (const std::string& file : row.whole) {
        if (models.empty() || models.count(file) == 0) {
          models[file] = place.read(file);
          CHECK_FALSE(models[file].empty());
        }
        check_complete(file, place.read(file), models[file]);
      }
      if (row.needs_mount) CHECK(place.read("b").find(".arcslip") == std::string::npos);
      for (const std::string& file : place.files()) CHECK(file.find(".arcslip") == std::string::npos);
    }
  }
}
