// Where results go when their reader, their folder or the terminal is not as usual.

#include "catch.hpp"
#include "program.hpp"
#include "size.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace app_test;
using Json = nlohmann::json;

TEST_CASE("a reader that goes away early leaves all files and an error, since it has not seen all") {
  const Workplace place;
  const std::string command =
      std::string("cd '") + place.path() + "' && { '" + arcslip_program() +
      "' frf scene.json --harmonics 1 --json - --csv a.csv 2>err; echo $? >code; } | head -c 11 >out";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(place.read("out") == "{\"format\": ");
  CHECK(place.read("err").find("cannot write standard output: Broken pipe") != std::string::npos);
  CHECK(place.read("code") == "1\n");
  CHECK(place.read("a.events.csv").find("\r\nfrf,3,5,peak,") != std::string::npos);
}

TEST_CASE(
    "two runs at once into one folder: the second one is reported, and the first one's files are whole") {
  const Workplace place;
  std::filesystem::create_directory(place.path() + "/out");
  place.write("out/keep", "");
  const int folder = ::open((place.path() + "/out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  REQUIRE(::flock(folder, LOCK_EX) == 0);  // as a run that is not at its end
  const Ended second =
      run(place, {"frf", "scene.json", "--set", "damper.normal_load=3", "--harmonics", "7", "--out", "out"});
  CHECK(second.exit_code == 1);
  CHECK(second.err.find("another run is writing to the folder out: wait until it ends") != std::string::npos);
  CHECK(place.files() == std::vector<std::string>{"out", "out/keep", "scene.json"});
  ::close(folder);
  CHECK(run(place, {"frf", "scene.json", "--set", "damper.normal_load=3", "--harmonics", "7", "--out", "out"})
            .exit_code == 0);
}

TEST_CASE("a closed standard output is an error and no file takes its place") {
  const Workplace place;
  const std::string command = std::string("cd '") + place.path() + "' && '" + arcslip_program() +
                              "' frf scene.json --harmonics 1 --csv a.csv >&- 2>err";
  const int status = std::system(command.c_str());
  CHECK(WEXITSTATUS(status) == 1);
  CHECK(place.read("err").find("cannot write standard output: Bad file descriptor") != std::string::npos);
}

TEST_CASE(
    "progress is a line on a terminal that is cleared at the end, and nothing without one or with --quiet") {
  const Workplace place;
  const std::vector<std::string> slow{"frf",    "scene.json", "--harmonics", test_size::sized("101", "21"),
                                      "--json", "-"};
  const Ended shown = Program(place, slow, {}, "", true).wait();
  CHECK(shown.exit_code == 0);
  CHECK(shown.err.find("\rbranch ") == 0);
  CHECK(shown.err.find("/12  ") != std::string::npos);
  CHECK(shown.err.find(" points  ") != std::string::npos);
  CHECK(shown.err.find(" Hz  step ") != std::string::npos);
  CHECK(shown.err.find('\n') == std::string::npos);
  CHECK(shown.err.back() == '\r');
  CHECK(Json::parse(shown.out)["branches"].size() == 12);

  std::vector<std::string> quiet = slow;
  quiet.emplace_back("--quiet");
  CHECK(Program(place, quiet, {}, "", true).wait().err.empty());
}
