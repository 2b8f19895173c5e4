#include "bad_inputs.hpp"
#include "catch.hpp"
#include "program.hpp"

using namespace app_test;

TEST_CASE("each bad input ends with its exit code and a message that says what to do, and leaves no file") {
  for (const BadInput& input : bad_inputs()) {
    CAPTURE(input.name);
    const Workplace place;
    if (!input.file.empty()) {
      place.write(input.file, input.content());
    }
    const auto before = place.files();
    const std::string scene = place.read("scene.json");
    const Ended ended = run(place, input.arguments);
    CAPTURE(ended.err);
    CHECK(ended.exit_code == input.exit_code);
    CHECK(ended.err.find(input.message) != std::string::npos);
    CHECK(place.files() == before);
    CHECK(place.read("scene.json") == scene);
  }
}

TEST_CASE("faults of a scene stand one a line with the file and the pointer") {
  const Workplace place;
  place.write("bad.json", R"({"format": "arcslip-scene-1", "title": "t", "structure": {"dofs": ["x"],
    "masses": [{"name": "m", "at": "x", "value": -1.24}], "springs": [{"name": "k", "at": "y", "value": 1}]},
    "response": {"at": "x"}})");
  const Ended ended = run(place, {"check", "bad.json"});
  CHECK(ended.exit_code == 2);
  CHECK(ended.out.empty());
  CHECK(ended.err.find("bad.json: /structure/masses/0/value: found -1.24, must be ") == 0);
  CHECK(ended.err.find("\nbad.json: /structure/springs/0/at: ") != std::string::npos);
}

TEST_CASE("standard output on a full disk is an error") {
  const Workplace place;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"check", "scene.json"},
        {"--help"},
        {"frf", "scene.json", "--set", "damper.normal_load=3", "--json", "-"}}) {
    CAPTURE(arguments[0]);
    const Ended ended = run(place, arguments, {}, "/dev/full");
    CHECK(ended.exit_code == 1);
    CHECK(ended.err.find("cannot write standard output: No space left on device") != std::string::npos);
  }
}
