// What the command prints about itself: help, the version, the manual page and completions.
#include "app/program.hpp"
#include "catch.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace app_test;

namespace {

bool is_there(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// The output of a line of the shell.
std::string output_of(const std::string& line) {
  std::string text;
  std::FILE* pipe = ::popen(line.c_str(), "r");
  REQUIRE(pipe != nullptr);
  char part[4096];
  while (const std::size_t count = std::fread(part, 1, sizeof part, pipe)) text.append(part, count);
  ::pclose(pipe);
  return text;
}

/// What bash offers for these words.
std::string completed(const Workplace& place, const std::string& words) {
  return output_of("cd '" + place.path() + "' && bash -c 'source c.bash; COMP_WORDS=(" + words +
                   "); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _arcslip; echo ${COMPREPLY[*]}'");
}

}  // namespace

TEST_CASE("the version lists commit, BLAS, libraries and licences with --verbose") {
  const Workplace place;
  const Ended plain = run(place, {"--version"});
  CHECK(plain.out.find('\n') == plain.out.size() - 1);
  for (const std::vector<std::string>& order :
       {std::vector<std::string>{"--version", "--verbose"}, {"--verbose", "--version"}}) {
    const Ended ended = run(place, order);
    CHECK(ended.exit_code == 0);
    for (const char* part :
         {"commit: ", "compiler: ", "BLAS: ", "Eigen 3.", ", MPL-2.0", "SuiteSparse (KLU) ", "NLopt 2.",
          "nlohmann/json 3.", "CLI11 ", "D3 in reports: "})
      CHECK(has(ended.out, part));
  }
}

TEST_CASE("help lists the words that an option takes, and options have dashes or underscores") {
  const Workplace place;
  const std::string help = run(place, {"frf", "--help"}).out;
  CHECK(has(help, "--method harmonic_balance|shooting"));
  CHECK(has(help, "--branches one|all"));
  CHECK(has(help, "--for-each,--for_each"));
  for (const std::string option : {"--most-branches", "--most_branches"})
    CHECK(run(place, {"frf", "scene.json", "--harmonics", "1", "--set", "damper.normal_load=3", option, "2"})
              .exit_code == 0);
}

TEST_CASE("all keys of studies are options") {
  const Workplace place;
  const auto frf = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"frf", "scene.json", "--harmonics", "3", "--quiet"});
    return run(place, more);
  };
  const Ended each = frf({"--for-each", "damper.normal_load=2,5"});
  CHECK(has(each.out, " 2   peak"));
  CHECK(has(each.out, " 5   peak"));
  CHECK_FALSE(has(each.out, " 10   peak"));
  const Ended range = frf({"--for-each", "damper.normal_load=1:100:3:log"});
  CHECK(has(range.out, " 10   peak"));
  CHECK(frf({"--for-each", "{\"damper.normal_load\": [3]}"}).exit_code == 0);
  CHECK(has(frf({"--for-each", "damper.normal_load=3", "--stability"}).out, "stable"));
  CHECK(has(frf({"--for-each", "damper.normal_load=3", "--stability=true"}).out, "stable"));
  CHECK_FALSE(has(frf({"--for-each", "damper.normal_load=3", "--stability=false"}).out, "stable"));
  CHECK(has(frf({"--stability=maybe"}).err, "--stability maybe: found \"maybe\""));
  CHECK(has(frf({"--for-each", "damper.normal_load"}).err, "give it as name.field=value,value"));
  CHECK(has(frf({"--for-each", "damper.normal_load=1:2"}).err,
            "must be numbers with commas, or from:to:count"));
  CHECK(has(frf({"--for-each", "damper.normal_load=1,x"}).err, "must be numbers with commas"));
  CHECK(has(frf({"--for-each", "{\"a\""}).err, "--for-each: found no JSON: "));
  CHECK(has(frf({"--for-each", "damper.normal_lod=1"}).err, "did you mean"));
  const auto optimize = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"optimize", "scene.json", "--harmonics", "3", "--quiet"});
    return run(place, more);
  };
  CHECK(has(optimize({"--scatter", "{\"damper.friction_coefficient\": [0.45, 0.55]}"}).out,
            "worst of 2 cases"));
  const Ended limited =
      optimize({"--constraints", "[{\"sum\": {\"damper.normal_load\": 1}, \"at_most\": 3}]", "--json", "-"});
  CHECK(limited.exit_code == 0);
  CHECK(has(limited.out, "\"damper.normal_load\":3.0"));
  CHECK(has(optimize({"--constraints", "nothing"}).err, "--constraints: found no JSON: "));
}

TEST_CASE("misspelt verbs, options and parameters are answered with the nearest") {
  const Workplace place;
  const auto near = [&](const std::vector<std::string>& arguments, const std::string& word) {
    const Ended ended = run(place, arguments);
    CAPTURE(ended.err);
    CHECK(ended.exit_code == 1);
    CHECK(has(ended.err, "did you mean " + word + "?"));
  };
  near({"optimise", "scene.json"}, "optimize");
  near({"frf", "scene.json", "--harmoncs", "3"}, "--harmonics");
  near({"frf", "scene.json", "--stabilty"}, "--stability");
  near({"frf", "scene.json", "--set", "normal_load=3"}, "\"damper.normal_load\"");
  near({"completions", "bsh"}, "bash");
}

TEST_CASE("the manual page has every verb and option and is without errors for troff") {
  const Workplace place;
  const Ended manual = run(place, {"manual"});
  CHECK(manual.exit_code == 0);
  for (const char* part : {".SH NAME", ".SS frf SCENE", ".SS new damper", ".SS compare A B",
                           "\\-\\-stability", ".SH EXIT STATUS"})
    CHECK(has(manual.out, part));
  if (!is_there("groff")) {
    WARN("groff is not there");
    return;
  }
  place.write("arcslip.1", manual.out);
  const std::string file = "'" + (place / "arcslip.1").string() + "'";
  CHECK(output_of("groff -ww -man -Tutf8 " + file + " 2>&1 >/dev/null").empty());
  CHECK(has(output_of("groff -man -Tascii -P-cbou " + file), "arcslip VERB [OPTIONS] SCENE"));
}

TEST_CASE("bash completes verbs, kinds, options, words and files") {
  const Workplace place;
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const Ended ended = run(place, {"completions", shell});
    CHECK(ended.exit_code == 0);
    CHECK(has(ended.out, "optimize"));
    CHECK(has(ended.out, "harmonic_balance shooting"));
    place.write("c." + shell, ended.out);
  }
  CHECK(has(run(place, {"completions", "tcsh"}).err, "unknown shell \"tcsh\", must be bash, zsh or fish"));
  if (!is_there("bash")) {
    WARN("bash is not there");
    return;
  }
  CHECK(completed(place, "arcslip op") == "optimize\n");
  CHECK(completed(place, "arcslip new d") == "damper duffing\n");
  CHECK(completed(place, "arcslip new damper --fri") == "--friction\n");
  CHECK(completed(place, "arcslip frf scene.json --method \"\"") == "harmonic_balance shooting\n");
  CHECK(completed(place, "arcslip frf --most") == "--most-branches\n");
  CHECK(completed(place, "arcslip completions z") == "zsh\n");
  CHECK(completed(place, "arcslip run sc") == "scene.json\n");
}
