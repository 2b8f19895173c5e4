#include "bad_inputs.hpp"
#include "catch.hpp"
#include "program.hpp"

using namespace app_test;

TEST_CASE("each bad input ends with its exit code and a message that says what to do, and leaves no file") {
  for (const BadInput& input : bad_inputs()) {
    CAPTURE(input.name);
    const Workplace place;
    if (!input.file.empty()) place.write(input.file, input.content());
    const auto before = place.files();
    const std::string scene = place.read("scene.json");
    const Ended ended = run(place, input.arguments, {}, input.output);
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
